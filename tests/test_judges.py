"""One change of what is published, whose checksum is renewed, is named in one line."""

import gzip
import hashlib
import json
import shutil

import pytest

from documents import check
from replication.sources import checksums
from replication.verdicts import unexpected
from tests.cases import ROOT, published


@pytest.fixture
def tree(tmp_path, monkeypatch):
    """A copy of what is published, with the parameters of the config as it is."""
    for name in ("src", "data", "figures", "paper"):
        (tmp_path / name).symlink_to(ROOT / name)
    for name in ("docs", "tests/reference", "config"):
        shutil.copytree(ROOT / name, tmp_path / name)
    monkeypatch.chdir(tmp_path)
    checksums.__globals__["_checksum"].cache_clear()  # of the same paths elsewhere
    yield tmp_path
    checksums.__globals__["_checksum"].cache_clear()


def sealed(tree):
    """Renew the checksums, as sha256sum does."""
    lines = check.SUMS.read_text("utf-8").splitlines()
    paths = [line.split("  ", 1)[1] for line in lines]
    made = [f"{hashlib.sha256((tree / p).read_bytes()).hexdigest()}  {p}\n" for p in paths]
    check.SUMS.write_text("".join(made), "utf-8")


def named(part):
    return set(part(check.published(published())) if part is check.rewritten else part())


@pytest.mark.parametrize(
    ("path", "old", "new", "part"),
    [
        ("tests/reference/vase.csv", "0.272822711", "0.282822711", check.of_another_run),
        ("tests/reference/friction_pulses.csv", "0.168595309", "0.5", check.of_another_run),
        ("tests/reference/trilith_map.csv", "no uplift", "rests", check.of_another_run),
        ("tests/reference/settings.json", '"mass_ratio": 0.434', '"mass_ratio": 0.443',
         check.of_another_run),
        ("tests/reference/rules.json", '"mass_ratio": 0.434', '"mass_ratio": 0.443',
         check.of_another_run),
        ("docs/verdicts.md", "refuted", "confirmed", check.rewritten),
        ("docs/explorer.html", "9.81", "8.91", check.rewritten),
        ("docs/certificates.jsonl.gz", '"survives"', '"overturns"', check.mislabelled),
        ("docs/certificates.jsonl.gz", "0.272822", "0.272823", check.mislabelled),
        ("tests/reference/proven.csv", "survives", "overturns", check.mislabelled),
    ],
)  # fmt: skip
def test_change_is_named_although_its_checksum_is_renewed(tree, path, old, new, part):
    before, file = named(part), tree / path
    read = gzip.decompress if path.endswith(".gz") else bytes
    text = read(file.read_bytes()).decode()
    assert old in text
    changed = text.replace(old, new, 1).encode()
    file.write_bytes(gzip.compress(changed) if path.endswith(".gz") else changed)
    assert any(path in line for line in check.unsealed())
    sealed(tree)
    checksums.__globals__["_checksum"].cache_clear()
    assert not any(path in line for line in check.unsealed())
    assert any(file.name in line for line in named(part) - before)


def test_file_without_checksum_and_checksum_without_file_are_named(tree):
    (tree / "docs/new.svg").touch()
    (tree / "docs/vase.svg").unlink()
    lines = "\n".join(check.unsealed())
    assert "docs/new.svg is not in docs/SHA256SUMS" in lines
    assert "names docs/vase.svg, which is not there" in lines


def test_certificate_that_proves_nothing_is_refused_by_its_own_program(tree, monkeypatch):
    line = gzip.decompress(check.CERTIFICATES.read_bytes()).decode().splitlines()[0]
    one = json.loads(line) | {"outcome": "overturns"}
    check.CERTIFICATES.write_bytes(gzip.compress(json.dumps(one).encode() + b"\n"))
    for part in ("unsealed", "of_another_run", "mislabelled"):
        monkeypatch.setattr(check, part, list)
    monkeypatch.setattr(check, "rewritten", lambda rows: [])
    (line,) = check.faults([])
    assert "line 1 is refused" in line


@pytest.mark.parametrize(
    ("verdict", "differs", "is_named"),
    [("confirmed", "sign", False), ("confirmed", "", True), ("refuted", "sign", True)],
)
def test_claim_is_named_where_its_verdict_or_its_flag_is_another(verdict, differs, is_named):
    row = {"id": "a", "file": "claims.yaml", "shown": "", "computed": True, "verdict": verdict}
    row |= {"differs": differs, "expected": "confirmed", "expected_differs": "sign"}
    assert len(unexpected([row])) == is_named
