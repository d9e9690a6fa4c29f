"""Copy what is published from results/ to docs/ and tests/reference/: `make publish`."""

from replication.commands import pages
from replication.pages.edition import publish
from replication.pages.seal import seal

TABLES = ("period",)
"""Those with which later runs are compared."""

if __name__ == "__main__":
    publish(TABLES)
    pages.write()
    seal()
