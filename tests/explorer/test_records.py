"""The page's reader of records against the library's."""

from base64 import b64encode
from pathlib import Path

import numpy as np
import pytest

from tests.ground.records.files import CSV, FILES, LARGEST, REPEATED, STEPS, UNCERTAIN_STEPS, at2
from tests.ground.records.test_records import HEADERS, SPELLINGS
from topheavy import read_record

EDITED = 2000  # files
ODD = "é²−%;\t\x1f\u2028\ufeff٢１🏛'\"\\"  # letters that they get, too
READER = Path(__file__).parents[2] / "src/explorer/records.js"

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

# Milliseconds that a reader of headers takes for a line that it refuses, the least of five.
COSTS = """(() => {
  const [readers, parts, numbers] = [{
    unit: (line) => statedAcceleration([`data ${line}x`]),
    step: (line) => countAndStep(`NPTS= 5, ${line}x`, 4),
    oldStep: (line) => countAndStep(`5 .01 NPTS${line}x`, 4),
    column: (line) => COLUMN.test(`${line}x`),
  }, {0}, {1}];
  const taken = (reader, line) => {
    const begun = performance.now();
    try { reader(line); } catch (error) { if (!/^line/.test(error.message)) throw error; }
    return performance.now() - begun;
  };
  const least = (reader, line) => Math.min(...Array.from({length: 5}, () => taken(reader, line)));
  return Object.entries(readers).flatMap(([name, reader]) => parts.map(
    (part) => [name, part, numbers.map((number) => least(reader, part.repeat(number)))]));
})()"""


# What the page's own worker answers of a chosen file: step, number and hash of samples; or why not.
IN_A_WORKER = """new Promise(resolve => {
  const worker = new Worker(READER);
  worker.onmessage = async ({data: {read, error}}) => {
    worker.terminate();
    if (error) return resolve(error);
    const bytes = await read.samples.arrayBuffer();
    const hash = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
    const digits = [...hash].map(byte => byte.toString(16).padStart(2, "0")).join("");
    resolve([read.step, bytes.byteLength / 8, digits]);
  };
  worker.postMessage(window.chosen);
})"""


@pytest.fixture
def reading(browser):
    """The page, and in it what otherwise only its worker runs: the reader of records."""
    browser.open_to_compute()
    browser.do("typeof readRecord") == "function" or browser.do(READER.read_text(encoding="utf-8"))
    return browser


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


def by_both(browser, path, files):
    """What the page reads of files, which has to be what the library reads of each."""
    answers = by_the_page(browser, files)
    for file, found in zip(files, answers, strict=True):
        assert found == by_the_library(path, *file), file
    return answers


def test_file_of_the_table_is_read_or_refused_as_by_the_library(reading, tmp_path):
    by_both(reading, tmp_path, [(row.ending, row.encoded) for row in FILES])


def edited(number):
    """Seeded files: headers that are read or refused, with up to two letters of them changed."""
    random = np.random.default_rng(2014)
    units = sorted(SPELLINGS)
    letters = sorted(set("".join(HEADERS + STEPS + UNCERTAIN_STEPS + units)) | set(ODD))

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


def test_edited_file_is_read_or_refused_as_by_the_library(reading, tmp_path):
    answers = by_both(reading, tmp_path, list(edited(EDITED)))
    assert 0.2 < sum(isinstance(found, list) for found in answers) / EDITED < 0.8


def test_every_record_is_read_as_the_library_reads_it(reading, request, tmp_path):
    paths = sorted((request.config.rootpath / "data" / "records").glob("*.AT2"))
    assert len(paths) > 5
    by_both(reading, tmp_path, [(path.suffix, path.read_bytes()) for path in paths])


def test_file_that_is_too_large_is_refused_before_it_is_read(reading, tmp_path):
    path = tmp_path / "motion.AT2"
    with path.open("wb") as file:
        file.truncate(LARGEST + 1)  # without a block on the disk
    reading.choose(path)
    found = reading.do(IN_A_WORKER)
    with pytest.raises(ValueError, match="100000001 bytes; expected at most") as error:
        read_record(path)
    assert found == str(error.value).replace(str(path), path.name)


def test_cost_of_a_header_grows_in_proportion_to_its_length(reading):
    costs = reading.do(COSTS, REPEATED, [500, 4000])
    assert len(costs) == 4 * len(REPEATED)
    for reader, part, (short, long) in costs:
        assert long < 3 * 8 * short + 2.0, (reader, part)  # ms; in proportion it is 8
