"""Files of records: AT2, CSV, plain columns, those of the repository, and what is refused."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from replication.config import components
from tests.cases import MOTION, RECORDS, TIME
from tests.ground import national
from topheavy import Record, read_record
from topheavy.ground.reading import READERS

VALUES = "\n".join(f"{a:.7E}" for a in MOTION)
AT2 = f"A title\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 400, DT= .0100 SEC\n{VALUES}\n"
HEADER = "time (s),acceleration (g)"
BOTH = list(zip(TIME, MOTION, strict=True))
CSV = f"{HEADER}\n" + "".join(f"{t:.2f},{a:.6f}\n" for t, a in BOTH)


def timed(text):
    """The CSV with other times: `text` makes one of each."""
    return re.sub(r"(?m)^(\d\.\d\d),", lambda time: f"{text(float(time[1]))},", CSV)


COARSE = timed(lambda t: f"{t / 2:.2f}")


@pytest.fixture
def write(tmp_path):
    def write(text, name="motion.AT2"):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return write


@pytest.mark.filterwarnings("error")
def test_records_of_the_repository_have_the_numbers_that_their_readme_states():
    text = (RECORDS / "README.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (\w+\.AT2) \|.*?\| (\d+) \| ([\d.]+) \| ([\d.]+) \|", text, re.M)
    assert sorted(path.name for path in RECORDS.glob("*.AT2")) == sorted(row[0] for row in rows)
    for file, *numbers in rows:
        record, (samples, step, peak) = read_record(RECORDS / file), map(float, numbers)
        assert (record.acceleration.size, record.time_step) == (samples, step)
        assert record.peak_acceleration == pytest.approx(peak, abs=5e-4)


NPTS = "NPTS= 400, DT= .0100 SEC"
IN_G = "ACCELERATION TIME SERIES IN UNITS OF G"
RSPMATCH = f"Matched\n#Misfit: 0.1\nFile Type: Accelerations (g)\n#Id: x\n{NPTS}\n{VALUES}\n"


FILES = [
    ("an-UP.AT2", AT2),
    ("rspmatch.at2", RSPMATCH),
    ("two-lines.AT2", AT2.replace(NPTS, "NPTS= 400\nDT= .01 SEC")),
    ("old.AT2", AT2.replace(NPTS, " 400  .0100  NPTS, DT")),
    ("ms.AT2", AT2.replace(NPTS, "NPTS=400 DT= 10 MSEC, 5E15.7")),
    ("before.AT2", AT2.replace(NPTS, "NPTS: 400, DT(MSEC)= 10")),
    ("reversed.AT2", AT2.replace(NPTS, "DT= 1.0D-02 NPTS= 400").replace("E-", "D-")),
    ("peak.AT2", AT2.replace("A title", "Peak (cm/s2) 277 at Unit 4\nTIME UNITS: SEC")),
    ("text-behind.AT2", AT2 + "END OF FILE 12\n"),
    ("lines.AT2", AT2.replace("\n", "\r\n")),
    ("mark.AT2", "\ufeff" + AT2),
    ("windows.AT2", AT2.replace("A title", "Kütahya").encode("cp1254")),
    ("plain.csv", CSV),
    ("quoted.csv", CSV.replace(HEADER, '"time (s)","acceleration (g)"')),
    ("empty-rows.csv", CSV + "\n,\n,\n"),
    ("sep.csv", "sep=;\n" + CSV.replace(",", ";")),
    ("decimal-commas.csv", CSV.replace(",", ";").replace(".", ",")),
    ("tabs.csv", CSV.replace(",", "\t")),
    ("in.csv", CSV.replace(HEADER, "Time in sec,acceleration in g")),
    ("comments.csv", "% a site\n# " + CSV),
    ("above.csv", "Station,ABC\nPeak,0.28\n\n" + CSV),
    ("utf-16.csv", CSV.replace(",", "\t").encode("utf-16")),
    ("big-endian.AT2", b"\xfe\xff" + AT2.encode("utf-16-be")),
    ("fortran.csv", HEADER + "".join(f"\n{t:.2f},{a:.7E}".replace("E", "D") for t, a in BOTH)),
    ("computed.csv", timed(lambda t: repr(t * 1000.0)).replace("time (s)", "t [ms]")),
]  # fmt: skip


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(("name", "text"), FILES)
def test_file_of_the_motion_is_read(write, name, text):
    record = read_record(write(text, name))
    assert record.time_step == pytest.approx(0.01, rel=1e-12)
    np.testing.assert_allclose(record.acceleration, MOTION, atol=6e-7)
    assert (record.name, record.start) == (name.rpartition(".")[0], 0.0)


IN_GAL = [
    "UNITS: CM/S/S",
    "The units are (cm/s²)",
    "ACCELERATION IN gal",
    "ACCELERATION HISTORY IN UNITS OF CM/SEC2.  FILTER POINTS: HP=0.1 Hz",
    "points of accel data equally spaced at .010 sec, in cm/sec2. (8f10.4)",
    "Accel. [cm/s^2]",
    "UNITS OF CM/SEC/SEC (GAL)",
    "UNITS gal (g = 980.665 cm/s2)",
]


@pytest.mark.parametrize("header", IN_GAL)
def test_unit_is_read_where_the_header_states_it(write, header):
    record = read_record(write(AT2.replace(IN_G, header)))
    np.testing.assert_allclose(record.acceleration, MOTION / 981.0, atol=1e-9)


REFUSED = [
    (AT2.replace(IN_G, "ACCELERATION"), "the header states no unit; expected one of g, %g"),
    (AT2.replace(IN_G, "UNITS: COUNTS (g)"), "the header states 'COUNTS' and 'g'"),
    (AT2.replace("A title", "A (cm/s²)"), "the header states 'cm/s²' and 'G'"),
    (AT2.replace("NPTS= 400", "NPTS= 401"), "NPTS is 401, and 400 values follow"),
    (AT2.replace("NPTS= 400", "N= 400"), "expected 'NPTS= n, DT= s SEC' in the first ten"),
    (AT2.replace(".0100 SEC", "10"), "DT is 10 ; expected SEC or MSEC"),
    (AT2.replace(VALUES[:13], "x"), "value 1 is 'x'; expected numbers"),
    (AT2.replace("E-01", "E+01"), r"largest acceleration is 28\.\d+ g; .* at most 5 g"),
    (AT2.replace(VALUES, "0\n" * 400), "largest acceleration is 0 g"),
    (CSV.replace(HEADER, "Period (s),Sa (g)"), "is of a response spectrum"),
    (CSV.replace("0.03,", "0.034,"), "0.034 follows 0.02; .* is a sample missing"),
    (re.sub("2.00,.*\n", "", CSV), "2.01 follows 1.99; .* is a sample missing"),
    (COARSE, "0.01 follows 0.01; .* printed to 0.01 only, so give `time_step`"),
    (timed(lambda t: f"{t * 1000:.0f}"), "the time step is 10 s; .* 0.2 s: is it in ms"),
    (CSV.replace("(s)", ""), r"expected a header such as 'time \(s\),acceleration \(g\)'"),
    (CSV.replace("(g)", "(g),b (g)"), r"as `column` .* 'acceleration' \(2\), 'b' \(3\)"),
    (AT2.replace(VALUES[:13], "1_0"), "value 1 is '1_0'; expected numbers"),
    (AT2.replace("A title", "From DT= .0050 SEC"), "0.005 and 0.01 as DT; expected one value"),
    (AT2.replace(".0100 SEC", ".01_00"), "DT is '.01_00'; expected a number with a point"),
    (AT2.replace(".0100", "0,0100"), "DT is '0,0100'; expected a number with a point"),
    (AT2 + AT2, "line 406 is a second header; expected one record"),
    (CSV.replace("0.02,", "0.02,nan,"), "line 4 is '0.02,nan,.*, with more cells than line 1"),
    (CSV.replace(".", ","), "line 2 is '0,00,.* if its commas are decimal, separate .* semicolons"),
    (f"{HEADER}\n" + "".join(CSV.splitlines(True)[:0:-1]), "row 2: .*; expected times that rise"),
    (re.sub(r"(?m)^1\.5\d,.*\n", "", CSV), "row 151: the time 1.6 follows 1.49; .* steps of 0.01:"),
    (CSV.replace("0.05,", "0.05;"), r"line 7 is '0\.05;.*; expected numbers"),
    (HEADER, "0 samples; expected at least two"),
    ("", "expected a header such as"),
]


def name_of(text):
    """The name of a file of this text."""
    return "motion.AT2" if re.search("NPTS|DT=", str(text)) else "motion.csv"


@pytest.mark.parametrize(("text", "says"), REFUSED)
def test_bad_file_is_refused_with_its_name_and_the_reason(write, text, says):
    with pytest.raises(ValueError, match=rf"(?s){name_of(text)}: .*{says}"):
        read_record(write(text, name_of(text)))


def test_column_is_named_or_numbered_and_a_start_in_ms_is_scaled(write):
    text = "Zeit;Time [s];N (gal);E (gal)\n0:0;2;0;0\n0:0;2,1;9;1\n0:0;2,2;-9;2\n"
    in_ms = re.sub(r"(?m):0;2,?(\d)?", lambda m: f":0;2{m[1] or 0}00", text).replace("[s]", "[ms]")
    for content in (text, in_ms, text.replace("E (gal)", "N (gal)")):
        for column in ("n", 3)[content.count("N (gal)") - 1 :]:
            record = read_record(write(content, "a.csv"), column)
            assert record.peak_acceleration == pytest.approx(9 / 981.0)
            assert (record.start, record.time_step) == (2.0, pytest.approx(0.1))
    with pytest.raises(ValueError, match=r"name or number of one of 'N' \(3\), 'N' \(4\)"):
        read_record(write(content, "a.csv"), "n")


ONE = "".join(f"{981.0 * a!r}\n" for a in MOTION.tolist())
TWO = "".join(f"{a:.6f} {a / 2:.6f}\n" for a in MOTION)
TIMED = "".join(f"{t + 5.0:.2f} {a / 2:.6f} {a:.6f}\n" for t, a in BOTH)
ACROSS = "".join(f"{a:.6f}" + " \n"[k % 8 == 7] for k, a in enumerate(MOTION[:-1]))
GAL, IN_STEPS = {"unit": "gal", "time_step": 0.01}, {"unit": "g", "time_step": 0.01}
FILLED = [
    ("# a site\n" + ONE, GAL),
    ("Station 7\n\n" + ONE.replace("e", "D"), GAL),
    ("A title\nDT= .01 SEC\n" + TWO, {"unit": "g", "column": 1}),
    (TWO, IN_STEPS | {"column": 1}),
    (TIMED, {"unit": "g", "column": 3}),
    (TIMED.replace(" ", ","), IN_STEPS | {"column": "3"}),
    (TIMED.replace(" ", ";").replace(".", ","), {"unit": "g", "column": 3}),
    (CSV.replace(HEADER, "time,acceleration"), {"unit": "g"}),
    (CSV.replace("(g)", ""), {"unit": "g"}),
    (CSV, IN_STEPS),
    (COARSE.replace("(g)", ""), {"unit": "g", "time_step": 0.005}),
    (AT2.replace(IN_G, "A site"), IN_STEPS),
]


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(("text", "options"), FILLED)
def test_unit_step_and_column_fill_what_the_file_does_not_state(write, text, options):
    for name in (name_of(text), "g.csv")[: 1 if "NPTS" in text else 2]:
        record = read_record(write(text, name), **options)
        np.testing.assert_allclose(record.acceleration, MOTION, atol=6e-7)
        assert record.time_step == pytest.approx(options.get("time_step", 0.01))
        assert record.start == 5.0 * text.startswith("5")
    assert record.name == ("motion" if "NPTS" in text else "g.csv")


UNSTATED = [
    (f"400\n{ONE}", GAL, "line 1 is '400', as if it were the number of values that follow"),
    (f"0.01\n{ONE}", GAL, "line 1 is '0.01', .* or the time step: remove it"),
    (f"399\n{ACROSS}", IN_STEPS, "line 1 is '399', as if it were the number of values"),
    (TWO, IN_STEPS, "2 columns, none of times; expected as `column` the number of one"),
    (TIMED, IN_STEPS, "3 columns, the first of times; expected as `column` the number of one"),
    (TIMED, {"unit": "g", "time_step": 0.02, "column": 3}, "row 2: .* which is `time_step`"),
    (ONE, {"unit": "gal"}, "no column has times; expected `time_step`, in s"),
    (ONE.replace(".", ","), GAL, "line 1 is '0,0': are its commas decimal"),
    ("no numbers", GAL, "no line has numbers only"),
    (f"UNITS: counts\n{ONE}", GAL, "header and `unit` state 'gal' and 'counts'; expected one of"),
    (f"DT= .02 SEC\n{ONE}", GAL, "0.02 and 0.01 as DT and `time_step`"),
    (AT2, {"time_step": 0.02}, "0.01 and 0.02 as DT and `time_step`; expected one value"),
    (AT2, {"column": 2}, "column is 2; expected none"),
    (CSV.replace("acceleration (g)", "velocity (m/s)"), {"unit": "g"}, "names no acceleration"),
    (CSV, {"time_step": 0.02}, "row 2: .* expected steps of 0.02, which is `time_step`: leave"),
    (re.sub("2.00,.*\n", "", CSV), {"time_step": 0.01}, "row 201: .*: is a sample missing"),
]


@pytest.mark.parametrize(("text", "options", "says"), UNSTATED)
def test_numbers_that_nobody_explains_or_that_contradict_are_refused(write, text, options, says):
    with pytest.raises(ValueError, match=rf"(?s){name_of(text)}: .*{says}"):
        read_record(write(text, name_of(text)), **options)


@pytest.mark.parametrize("text", [ACROSS, "A site\n" + ACROSS, ACROSS.rsplit("\n", 1)[0]])
def test_line_that_a_message_gives_reads_samples_across_the_rows(write, text):
    with pytest.raises(ValueError, match="the samples run across the lines") as error:
        read_record(write(text, "rows.g3"), **IN_STEPS)
    lines = "\n".join(str(error.value).splitlines()[1:]).replace("\nRecord", "\nrecord = Record")
    exec(lines, names := {"Record": Record, "np": np})
    record = names["record"]
    size = record.acceleration.size
    assert size == len(text.removeprefix("A site").split())
    assert (record.time_step, *record.acceleration) == (0.01, *MOTION[:size].round(6))


def test_table_that_is_cut_within_its_last_line_is_doubted(write):
    with pytest.warns(UserWarning, match="the last line, '3.99,-0.0000', has no line end"):
        read_record(write(CSV[:-3], "motion.csv"))


def test_usual_names_of_vertical_components_are_known(tmp_path):
    up = ["CLC_UP", "a_up", "RSN6_I-ELC-UP", "X-DWN", "TCU052-V", "AMT.HNZ", "AOM001.UD", "b-Z"]
    across = ["CLC_090", "ELC180", "GILROY-V1", "STA_HNE", "GROUP", "CUP", "AOM001.EW"]
    for name in (*up, *across, "README"):
        (tmp_path / f"{name}.{'md' if name == 'README' else 'csv'}").touch()
    stems = [{Path(path).stem for path in paths} for paths in components(str(tmp_path))]
    assert stems == [set(across), set(up)]


@pytest.mark.parametrize(
    ("network", "head", "package"),
    [
        ("K-NET or KiK-net", national.knet(), "obspy"),
        ("ESM", "EVENT_NAME: X\nEVENT_ID: X\n", "gmprocess"),
        ("GeoNet", "Corrected accelerogram X\nSite X\n", "gmprocess"),
        ("AFAD", "STRONG GROUND MOTION RECORDS OF TURKIYE\nÜ\n".encode("cp1254"), "gmprocess"),
        ("CSMIP .of a known azimuth. or USC", national.csmip(), "gmprocess"),
        ("RENADIC", national.renadic(), "RENADIC"),
        ("COSMOS", "Corrected acceleration    (Format v01.20) Src: x\n", "gmprocess"),
        ("SMC .of a free field.", national.smc(), "gmprocess"),
        ("most national networks", " 0.000E+00 6.599E-16-4.444E-01-9.310E-01\n", "gmprocess"),
    ],
)
def test_national_format_is_refused_by_its_name_with_a_way_to_read_it(
    write, network, head, package
):
    for name in ("x.EW", "x.AT2", "x.csv")[: 1 if network.startswith("most") else 3]:
        with pytest.raises(ValueError, match=f"read a file of {network}; for any other") as error:
            read_record(write(head, name))
        assert str(error.value).endswith(READERS[package])
    with pytest.raises(ValueError, match=r"the first lines are those of|no line has numbers only"):
        read_record(write(head, "x.txt"), time_step=0.01, unit="gal")


GAP = """
trace.data, begin = trace.data.astype("int32"), trace.stats.starttime
pieces = [trace.slice(endtime=begin + 1), trace.slice(starttime=begin + 2)]
obspy.Stream(pieces).write("FILE.gap", format="MSEED")
"""


MADE = {
    "obspy": {"X.EW": national.knet(), "X.EW1": national.knet("2"), "X.EW2": national.knet("5")},
    "gmprocess": {"X.EW": national.knet(), "X.EW1": national.knet("2"), "X.EW2": national.knet("5")}
    | {"X.V1": national.csmip(), "X.smc": national.smc()},
    "RENADIC": {"X.v1": national.renadic()},
}


@pytest.mark.sampled(0)
@pytest.mark.parametrize("package", READERS)
def test_lines_that_read_a_national_format_run(write, package):
    assert READERS[package] in (RECORDS / "README.md").read_text(encoding="utf-8")
    python = sys.executable if package == "obspy" else os.environ.get("GMPROCESS_PYTHON")
    if python is None:
        pytest.skip(
            "NOT RUN: the lines that read national formats. Install gmprocess 2.8.0 and topheavy "
            "in an environment of their own, and name its Python in GMPROCESS_PYTHON"
        )
    lines = ["from topheavy import Record"]
    for name, text in MADE[package].items():
        recipe = READERS[package].replace("FILE", str(write(text, name)))
        lines += [recipe, "print(record.start > 9e8, record)"]
    if package == "obspy":
        lines += [GAP, READERS[package].replace("FILE", "FILE.gap")]
    lines = "\n".join(lines).replace("FILE", str(write(national.knet(), "X.EW")))
    run = subprocess.run([python, "-c", lines], capture_output=True, text=True, check=False)
    peaks = r"400 samples, time step 0\.01 s, PGA 0\.282\d g, PGV 0\.39\d+ m/s"
    names = re.findall(rf"^True (.*): {peaks}$", run.stdout, re.M)
    assert len({*names}) == len(MADE[package]), run
    assert ("Trace with masked values found" in run.stderr) == (package == "obspy")
