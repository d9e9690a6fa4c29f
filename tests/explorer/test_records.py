"""The page's reader of records against the library's."""

import re
from base64 import b64encode

import numpy as np
import pytest

from tests.records.files import CSV, FILES, STEPS, UNCERTAIN_STEPS, at2
from tests.records.test_units import HEADERS, SPELLINGS
from topheavy import read_record

EDITED = 4000  # files
MANY = 300_000  # samples: of 50 minutes at 100 Hz; more than a call takes as arguments

# Of files, each its name and its bytes: step and samples, or the message that refuses it.
READ = """{0}.map(([name, bytes]) => {
  try {
    const content = Uint8Array.from(atob(bytes), each => each.charCodeAt(0));
    const {step, samples} = readRecord(name, content);
    return [step, [...samples]];
  } catch (error) {
    return error.message;
  }
})"""


def by_the_page(browser, files):
    """What the page reads of files, each the ending of its name and its bytes."""
    given = [[f"motion{ending}", b64encode(content).decode()] for ending, content in files]
    return browser.do(READ, given)


def by_the_library(path, ending, content):
    """What the library reads of a file, or its message with the name of the file alone."""
    path = path / f"motion{ending}"
    path.write_bytes(content)
    try:
        record = read_record(path)
    except ValueError as error:
        return str(error).replace(str(path), path.name)
    return [record.time_step, record.acceleration.tolist()]


def test_file_of_the_table_is_read_or_refused_as_by_the_library(browser):
    browser.open(settled=False)
    answers = by_the_page(browser, [(row.ending, row.encoded) for row in FILES])
    for row, found in zip(FILES, answers, strict=True):
        if isinstance(row.expected, str):
            assert isinstance(found, str), (row, found)
            assert re.match(rf"motion{re.escape(row.ending)}: .*{row.expected}", found), row
        else:
            assert found[0] == pytest.approx(row.expected[0], rel=1e-13), row
            np.testing.assert_allclose(found[1], row.expected[1], rtol=1e-13)


def edited(number):
    """Seeded files: headers that are read or refused, with up to two letters of them changed."""
    random = np.random.default_rng(2014)
    units = sorted(SPELLINGS)
    letters = sorted(set("".join(HEADERS + STEPS + UNCERTAIN_STEPS + units)) | set("é²−%;"))

    def pick(of):
        return of[random.integers(len(of))]

    def edit(line):
        for _ in range(random.choice([0, 0, 1, 2])):
            place = random.integers(len(line) + 1)
            line = line[:place] + pick(["", pick(letters)]) + line[place + random.integers(2) :]
        return line

    for _ in range(number):
        statement = pick(HEADERS[:-1]).format(pick(units))
        if random.random() < 0.3:
            lines = CSV.split("\n", 2)
            lines[0] = edit(f"time ({pick(['s', 'ms', 'sec'])}),acceleration ({pick(units)})")
            lines[1] = edit(lines[1])
            yield ".csv", "\n".join(lines).encode()
        else:
            text = at2(edit(pick(STEPS if random.random() < 0.8 else UNCERTAIN_STEPS)))
            yield ".AT2", text.replace("ACCELERATION IN UNITS OF G", edit(statement)).encode()


def test_edited_file_is_read_or_refused_as_by_the_library(browser, tmp_path):
    browser.open(settled=False)
    files = list(edited(EDITED))
    answers = by_the_page(browser, files)
    was_read = 0
    for (ending, content), found in zip(files, answers, strict=True):
        ours = by_the_library(tmp_path, ending, content)
        if isinstance(ours, str):
            assert isinstance(found, str), (content, ours, found)
            assert found == ours.replace('"', "'"), content  # Python's choice of quotes
        else:
            was_read += 1
            assert found == ours, content
    assert 0.2 < was_read / EDITED < 0.8


def test_every_record_is_read_as_the_library_reads_it(browser, request, tmp_path):
    browser.open(settled=False)
    paths = sorted((request.config.rootpath / "data" / "records").glob("*.AT2"))
    assert len(paths) > 5
    files = [(path.suffix, path.read_bytes()) for path in paths]
    for file, found in zip(files, by_the_page(browser, files), strict=True):
        assert found == by_the_library(tmp_path, *file)


def test_long_record_is_read(browser, tmp_path):
    browser.open(settled=False)
    samples = [f"{0.3 * np.sin(0.1 * k):.5f}" for k in range(MANY)]
    values = "\n".join(samples)
    rows = "".join(f"{k / 100:.2f},{a}\n" for k, a in enumerate(samples))
    files = [
        (".AT2", f"UNITS OF G\nNPTS= {MANY}, DT= .01 SEC\n{values}\n".encode()),
        (".csv", f"time (s),acceleration (g)\n{rows}".encode()),
    ]
    for file in files:
        (found,) = by_the_page(browser, [file])
        assert isinstance(found, list), found
        assert len(found[1]) == MANY
        assert found == by_the_library(tmp_path, *file)
