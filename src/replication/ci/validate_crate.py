"""Is a folder a valid Workflow Run RO-Crate 0.5? Needs the group `crate`, and no network."""

import gzip
import sys
import tempfile
from pathlib import Path

from requests_cache import CachedRequest, CachedResponse, CachedSession
from rocrate_validator.services import validate

CONTEXT = "https://w3id.org/ro/crate/1.1/context"
COPY = Path(__file__).with_name("ro-crate-1.1-context.jsonld.gz")
"""The context, as the package rocrate 0.13.0 has it (Apache 2.0), without white space."""


def faults(crate: str) -> list[str]:
    """Return what the validator finds that a crate must have and has not.

    The copy of the context lies where the validator looks for pages that it has fetched.
    """
    with tempfile.TemporaryDirectory() as folder:
        cache = Path(folder, "cache")
        with CachedSession(str(cache), backend="sqlite") as session:
            page = CachedResponse(
                content=gzip.decompress(COPY.read_bytes()),
                headers={"Content-Type": "application/ld+json"},
                request=CachedRequest(method="GET", url=CONTEXT),
                status_code=200,
                url=CONTEXT,
            )
            session.cache.save_response(page)
        settings = {
            "rocrate_uri": crate,
            "profile_identifier": "workflow-run-crate-0.5",
            "requirement_severity": "REQUIRED",
            "offline": True,
            "cache_path": cache,
        }
        result = validate(settings)
    found = {f"{each.message} ({each.violatingEntity})" for each in result.get_issues()}
    return sorted(found) if found or result.passed() else ["the validator gives no reason"]


if __name__ == "__main__":
    if found := faults(sys.argv[1]):
        sys.exit("\n".join([f"{sys.argv[1]} is no valid RO-Crate:", *found]))
    print(f"{sys.argv[1]} is a valid Workflow Run RO-Crate")
