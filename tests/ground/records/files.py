"""One table of odd and bad files of ground motions, on which both readers are tested.

What is expected of the library's reader is expected of the page's (`src/explorer/records.js`), too.
"""

import re
from typing import NamedTuple

SAMPLES = (0.1, -0.2, 0.4, 0.0, -0.3)
HEADER = "A site, a day\nan instrument\nACCELERATION IN UNITS OF G\nNPTS= {n}, DT= .0200 SEC\n"
VALUES = "  0.1 -0.2  0.4\n  0.0 -3.0E-01\n"
AT2 = HEADER.format(n=5) + VALUES
CSV = "time (s),acceleration (g)\n0.00,0.1\n0.02,-0.2\n0.04,0.4\n0.06,0.0\n0.08,-3.0E-01\n"
READ = (0.02, SAMPLES)
PEAK = "line 5: the largest acceleration is "
LONGEST = 1000  # characters of a line of a header
MOST = 2_000_000  # samples
LARGEST = 100_000_000  # bytes of a file
TEMPLE = "🏛"  # one character, of two units of JavaScript

STEPS = [
    # the last line of a header with 5 samples at 0.02 s
    "NPTS=  5, DT= .02000 SEC",
    "NPTS= 5 DT= .02",
    "NPTS=5,DT=2.0D-02",
    "NPTS=5, DT=2.0E-2 SEC,",
    "npts= 5, dt= 2.d-2sec",
    "NPTS= 5, DT= 20 MSEC",
    "NPTS= 5, DT=20ms",
    "NPTS= 5, DT= 20.0D0 Milliseconds",
    "NPTS= 5, DT= .02 S, 8F10.5",
    "NPTS: 5, DT (s): 0.02",
    "NPTS= 5, DT(MSEC)= 20",
    "NPTS= 5, DT= .02 (SEC)",
    "DT= .02 NPTS= 5",
    "NPTS= 5 DT= .02 UNITS: G",
    "DT= .02 SEC, NPTS= 5",
    "  5 0.02 NPTS, DT",
    "     5    .0200    NPTS, DT",
    "5, 2.0D-02, NPTS, DT (SEC)",
    "5 20 MSEC NPTS, DT",
]
UNCERTAIN_STEPS = [
    *("NPTS= 5, DT= 1e", "NPTS= 5, DT= .02 MIN", "NPTS= 5, DT= 50 HZ", "NPTS= 5, DT= .02 D"),
    *("NPTS= 5, DT(MSEC)= 20 SEC", "NPTS= 5, DT= x", "NPTS= 5, DT=", "NPTS= 5, DT= 1e-"),
    *("NPTS= 5, DT= 0,02", "NPTS= 5, DT= .02.1", "NPTS= 5, DT= 1/50", "NPTS= 5, DT= 20 ms/2"),
    *("NPTS= 5, DT= 20", "NPTS= 5, DT= 5", "5 20 NPTS, DT", "NPTS, DT", "NPTS= five, DT= .02"),
    *("NPTS= 5.5, DT= .02", "NPTS= 5,000, DT= .02", "NPTS= -5, DT= .02", "NPTS= 5", "5 NPTS"),
    *("NPTS= 5, DT= 0.1 MIN", "NPTS= 5, DT= 0.01.5", "NPTS= 5, DT= 1e300", "5 0.1 MIN NPTS, DT"),
    *("NPTS= 5, DT= .02 s²", "NPTS= 5, DT= .02 constructor", "NPTS= 5, DTS= .02"),
    *("NPTS= 5, DT= .02.", "NPTS= 5., DT= .02"),
]


def longest(samples: int = MOST) -> bytes:
    """Return a file of PEER's kind with the most samples, or with so many."""
    return HEADER.format(n=samples).encode() + b"0.3141592 -.1414214\n" * (samples // 2)


OTHER_DIGITS = ["०.१", "０.１", "0.٢", "²"]

REPEATED = [
    # parts of a header that cost a reader much, if it looks at them again for each one
    *("UNITS ", "IN ", "data in ", "(", "(m   ", "units of ", "units of acc", "m per s ", "max "),
    *("( .5", "1.5 (", "1.", "1", " ", "a ", "a", "acc: ", "NPTS ", "DT ", "DT=1", "DT(", ", "),
]


class File(NamedTuple):
    """A row: what is odd or wrong, the ending of the name, the content, and what is expected.

    `expected` is the time step (s) and the samples (g), or a regular expression of the message.
    """

    what: str
    ending: str
    content: str | bytes
    expected: tuple[float, tuple[float, ...]] | str

    @property
    def encoded(self) -> bytes:
        """The content as it is in the file."""
        return self.content if isinstance(self.content, bytes) else self.content.encode()


def at2(line: str) -> str:
    """Return an AT2 file with another last line of its header."""
    return AT2.replace("NPTS= 5, DT= .0200 SEC", line)


def rows(ending: str, *given: tuple) -> list[File]:
    return [File(what, ending, content, expected) for what, content, expected in given]


FILES = [
    *rows(".AT2", *((f"the line {line!r}", at2(line), READ) for line in STEPS)),
    *rows(
        ".AT2",
        *(
            (f"the line {line!r}", at2(line), rf"line 4 .*{re.escape(repr(line))}")
            for line in UNCERTAIN_STEPS
        ),
    ),
    *rows(
        ".AT2",
        ("as it should be", AT2, READ),
        ("lines that end in CR", AT2.replace("\n", "\r"), READ),
        ("lines that end in CR LF, no end of the last", AT2.rstrip().replace("\n", "\r\n"), READ),
        ("empty lines at the end", AT2 + "\n  \n", READ),
        ("a mark of byte order", "\ufeff" + AT2, READ),
        ("a count after it", "\ufeff5 0.02 NPTS, DT, UNITS: G\n" + VALUES, READ),
        ("percent", AT2.replace("UNITS OF G", "%G"), (0.02, (1e-3, -2e-3, 4e-3, 0.0, -3e-3))),
        (
            "no break between title and unit",
            "UNITS OF G\nNPTS= 2, DT= 0.01\n1.0D-1 .2",
            (0.01, (0.1, 0.2)),
        ),
        ("fewer values than NPTS", HEADER.format(n=8) + VALUES, r"line 4 says 8 .* hold 5; .* cut"),
        ("more values than NPTS", HEADER.format(n=3) + VALUES, r"line 4 says 3 .* 5; .* too many"),
        ("no header", VALUES * 4, r"no NPTS in lines 1 to 4"),
        ("no DT", AT2.replace("DT=", "XX="), r"line 4 is 'NPTS= 5, XX= \.0200 SEC'; expected .*DT"),
        ("no NPTS", AT2.replace("NPTS=", "XX="), r"no NPTS in lines 1 to 4"),
        ("NPTS in the fifth line", "\n" + AT2, r"no NPTS in lines 1 to 4"),
        (
            "NPTS of 900 digits",
            at2(f"NPTS= {'1' * 900}, DT= .02"),
            r"line 4 gives NPTS as 1{900}; expected at most 2000000 samples: shorten the record",
        ),
        (
            "NPTS of 5000 digits",
            at2(f"NPTS= {'1' * 5000}, DT= .02"),
            r"line 4 has 5015 characters, 'NPTS= 1{74}'…; expected at most 1000 in a line of the",
        ),
        ("NPTS beyond the limit", at2(f"NPTS= {MOST + 1}, DT= .02"), r"gives NPTS as 2000001; exp"),
        ("NPTS at the limit", at2(f"NPTS= {MOST}, DT= .02"), r"line 4 says 2000000 .* hold 5"),
        ("NPTS with a digit of another script", at2("NPTS= 5०, DT= .02"), r"line 4 is 'NPTS= 5०"),
        ("zeros before NPTS", at2("NPTS= 0005, DT= .02"), READ),
        (
            "a long line of the header",
            AT2.replace("an", "x " * 501),
            r"line 2 has 10\d\d characters, '(?:x ){40}'…; expected at most 1000 in a line of",
        ),
        ("a long line of blanks and NPTS", at2(" " * LONGEST + "NPTS= 5, DT= .02"), r"line 4 has"),
        ("as many words as are a record", AT2.replace("day", "UNITS " * 20000), r"line 1 has 120"),
        ("the longest line of a header", AT2.replace("an instrument", TEMPLE * LONGEST), READ),
        (
            "one character more",
            AT2.replace("an instrument", TEMPLE * (LONGEST + 1)),
            rf"line 2 has 1001 characters, '{TEMPLE}{{80}}'…; expected",
        ),
        ("a time step of a microsecond", at2("NPTS= 5, DT= 1e-6 SEC"), (1e-6, SAMPLES)),
        (
            "a shorter time step",
            at2("NPTS= 5, DT= 9.9e-7 SEC"),
            r"the time step is 9\.9e-07 s; expected at least 1e-06 s: is its unit another\?",
        ),
        (
            "a time step that is no normal float",
            at2("NPTS= 5, DT= 1e-320"),
            r"step is 9\.99989e-321",
        ),
        ("an exponent of five digits", at2("NPTS= 5, DT= 1e-00002"), r"line 4 is 'NPTS= 5, DT= 1e"),
        (
            "a long DT without unit",
            at2("NPTS= 5, DT= 123456789"),
            r"line 4 gives a DT of 1\.23457e\+08",
        ),
        ("a time step of minus zero", at2("NPTS= 5, DT= -0"), r"time_step is -0 s; expected more"),
        (
            "no motion",
            HEADER.format(n=3) + "0.0 -0.0 1E-400",
            r"all 3 accelerations are zero; expected a ground motion: is it another file or column",
        ),
        ("time step of zero", AT2.replace(".0200", ".0000"), r"time_step is 0 s; expected more"),
        ("time step below zero", AT2.replace(".0200", "-.02"), r"time_step is -0\.02 s; expected"),
        (
            "a word",
            AT2.replace("0.0 ", "o.o "),
            r"line 6: 'o\.o' is not a number; expected acc.* G",
        ),
        ("merged columns", AT2.replace("0.1 -", "0.1-"), r"line 5: '0\.1-0\.2' is not a number"),
        ("not a number", AT2.replace("0.4", "NaN"), r"line 5: 'NaN' is not a number"),
        ("infinite", AT2.replace("0.4", "inf"), r"line 5: 'inf' is not a number"),
        ("too large for a float", AT2.replace("0.4", "1E999"), r"line 5: '1E999' is not a number"),
        ("Python's digits", AT2.replace("0.4", "0_4"), r"line 5: '0_4' is not a number"),
        ("JavaScript's digits", AT2.replace("0.4", "0x4"), r"line 5: '0x4' is not a number"),
        ("the end of a file of DOS", AT2 + "\x1a", r"line 7: '\\x1a' is not a number"),
        (
            "a mark of byte order within",
            AT2.replace("0.0", "\ufeff0"),
            r"line 6: '\\ufeff0' is not",
        ),
        ("blanks of other scripts", AT2.replace("0.1 ", "0.1\x1f\x85\u2028\u3000"), READ),
        ("a huge exponent", AT2.replace("0.0 ", "0e99999 "), r"line 6: '0e99999' is not a number"),
        (
            "a long word",
            AT2.replace("0.4", "x" * 5000),
            r"line 5: 'x{80}'… is not a number; expected accelerations in G",
        ),
        ("an apostrophe", AT2.replace("0.4", "0.4'"), r"line 5: \"0\.4'\" is not a number"),
        (
            "two kinds of quotes",
            AT2.replace("0.4", "\"0.4'"),
            r"line 5: '\"0\.4\\'' is not a number",
        ),
        ("a backslash", AT2.replace("0.4", "0\\4"), r"line 5: '0\\\\4' is not a number"),
        (
            "invisible letters",
            AT2.replace("0.4", "\u00ad\u200b\U000e0061"),
            r"line 5: '\\xad\\u200b\\U000e0061' is not a number",
        ),
        ("header alone", HEADER.format(n=5), r"line 4 says 5 .* hold 0"),
        (
            "one sample",
            HEADER.format(n=1) + "0.1\n",
            r"line 4 says 1 samples; expected at least two",
        ),
        ("no sample", HEADER.format(n=0), r"line 4 says 0 samples; expected at least two"),
        ("cut in the header", "\n".join(HEADER.split("\n")[:2]), r"no NPTS"),
        ("empty", "", r"no NPTS"),
        ("not UTF-8", AT2.encode().replace(b"site", b"st\xe9"), r"line 1 is .* at byte 5 \(0xe9\)"),
        (
            "a letter of UTF-8 cut short, behind others",
            AT2.encode().replace(b"an", "é\ufffd".encode() + b"\xef\xbf"),
            r"line 2 is not UTF-8 at byte 6 \(0xef\); expected a UTF-8 file: save it as such",
        ),
        (
            "not UTF-8 behind a mark of byte order",
            b"\xef\xbb\xbf" + AT2.encode().replace(b"site", b"\x80"),
            r"line 1 is not UTF-8 at byte 3 \(0x80\)",
        ),
        ("UTF-16", AT2.encode("utf-16-le").join([b"\xff\xfe", b""]), r"line 1 .* byte 1 \(0xff\)"),
        (
            "another unit",
            AT2.replace("OF G", "OF FT/S2"),
            r"line 3 states .* 'ACCELERATION .* FT/S2'",
        ),
        (
            "velocity",
            AT2.replace("OF G", "OF CM/S"),
            r"line 3 states a unit that is not understood",
        ),
        (
            "no unit",
            AT2.replace(" IN UNITS OF G", ""),
            r"lines 1 to 4 state no .*line 3 is 'ACCELER",
        ),
        (
            "unit in words alone",
            AT2.replace("ACCELERATION IN UNITS OF G", "IN G"),
            r"state no unit .*no line names one",
        ),
        (
            "unit of the peak",
            AT2.replace("ACCELERATION IN UNITS OF G", "PEAK (G)"),
            r"state no unit",
        ),
        ("unit of one value", AT2.replace("day", "largest 39.2 (gal)"), READ),
        ("unit of time", AT2.replace("day", "TIME UNITS: SEC"), READ),
        (
            "no unit of time",
            AT2.replace("day", "UNITS: S^2"),
            r"line 1 states a unit .*'A site, a ",
        ),
        ("two units", AT2.replace("day", "day (gal)"), r"line 1 states 'gal' .*line 3 states 'G'"),
        ("beyond 5 g", AT2.replace("0.4", "341.7"), r"line 5: .* 341\.7 G, .*at most 5 g.* line 3"),
        ("far beyond 5 g", AT2.replace("0.4", "1E10"), PEAK + r"1e\+10 G, 1e\+10 g; expected at"),
    ),
    *rows(
        ".AT2",
        *(
            row
            for digits in OTHER_DIGITS
            for count in [digits.replace(".", "")]
            for row in [
                (f"a value {digits}", AT2.replace("0.4", digits), r"line 5: .* is not a number"),
                (f"DT {digits}", at2(f"NPTS= 5, DT= {digits} SEC"), r"line 4 is 'NPTS= 5"),
                (f"NPTS {count}", at2(f"NPTS= {count}, DT= .02"), r"line 4 is 'NPTS="),
                (f"{count} before NPTS", at2(f"{count} 0.02 NPTS, DT"), rf"line 4 is '{count}"),
            ]
        ),
    ),
    *rows(
        ".csv",
        ("as it should be", CSV, READ),
        ("a mark of byte order, CR LF", "\ufeff" + CSV.replace("\n", "\r\n"), READ),
        ("empty lines", CSV.replace("\n", "\n\n"), READ),
        ("semicolons", CSV.replace(",", ";"), READ),
        ("semicolons, decimal commas", CSV.replace(",", ";").replace(".", ","), READ),
        ("tabs", CSV.replace(",", "\t"), READ),
        ("tabs, decimal commas", CSV.replace(",", "\t").replace(".", ","), READ),
        ("comments above the header", "# a site, a day\n% by (hand)\n" + CSV, READ),
        (
            "a comment of the other kind",
            "// a site\n" + CSV,
            r"line 1 is '// a site'; expected, for",
        ),
        (
            "a fault below comments",
            "# a\n" + CSV + "0.1,x\n",
            r"line 8 is '0.1,x'; expected a time",
        ),
        ("comments alone", "# a\n% b\n", r"line 3 is ''; expected, for example"),
        (
            "three columns, one of acceleration",
            "no;time (s);velocity (m/s);a (m/s²)\n1;0,0;9;0\n2;0,5;9;0,981\n3;1;9;-1,962\n",
            (0.5, (0.0, 0.1, -0.2)),
        ),
        (
            "three columns, two of acceleration",
            "t (s),NS (g),EW (g)\n0,.1,.2\n1,.1,.2\n",
            r"line 1 is .*; expected one column of acceleration; those are 'NS', 'EW': name one",
        ),
        (
            "three columns without an acceleration",
            "t (s),v (m/s),u (m)\n0,1,2\n1,1,2\n",
            r"line 1 is .*, with the units s, m/s, m; expected s or ms",
        ),
        (
            "a column too few in a line",
            "t (s);v (m/s);a (g)\n0;1;.2\n1;.2\n",
            r"line 3 is '1;.2'; expected a time and an acceleration, 3 columns with a semicolon",
        ),
        (
            "a decimal comma between commas",
            CSV.replace("0.04", "0,04"),
            r"line 4 is '0,04,0.4'; exp",
        ),
        ("blanks of other scripts", CSV.replace("0.04,0", "\u30000.04\x1f,\x850"), READ),
        ("milliseconds", "t [ms], a [m/s²]\n0,0\n5,.981\n10,-1.962\n", (0.005, (0.0, 0.1, -0.2))),
        (
            "three decimals of a third",
            "time (s),acceleration (g)\n0.000,0\n0.003,.1\n0.007,.2\n0.010,.1\n0.013,0\n0.017,.1\n",
            (0.0034, (0.0, 0.1, 0.2, 0.1, 0.0, 0.1)),
        ),
        (
            "digits of several kinds",
            "time (s),acceleration (g)\n0,0\n5.00E-1,.1\n1.00E+0,.2\n1.5,.1\n2,0\n",
            (0.5, (0.0, 0.1, 0.2, 0.1, 0.0)),
        ),
        (
            "times with the exponent of Fortran",
            "time (s),acceleration (g)\n0.D0,.1\n2.D-2,.2\n4.D-2,.1\n",
            (0.02, (0.1, 0.2, 0.1)),
        ),
        ("empty", "", r"line 1 is ''; expected, for example, 'time"),
        (
            "no header",
            "0.00,0.1\n0.02,0.2\n",
            r"line 1 is '0\.00,0\.1'; expected, for example, 'time",
        ),
        ("no units", "t,a\n0,0\n1,1\n", r"line 1 is 't,a'; expected, for example, 'time"),
        (
            "a third column",
            "time (s),a (g),b (g)\n",
            r"line 1 is 'time \(s\),a \(g\),b \(g\)'; expected",
        ),
        (
            "a third column without a unit",
            "time (s),a (g),b\n0,.1,x\n",
            r"holds 1 samples; expected at least two",
        ),
        ("two units of a column", CSV.replace("(g)", "(g) (gal)"), r"line 1 is 'time .*; expected"),
        (
            "a word behind a unit",
            CSV.replace("(g)", "(g) NS"),
            r"line 1 is 'time .*; expected, for",
        ),
        (
            "a long header",
            CSV.replace("time", "time" + " " * LONGEST),
            r"line 1 has 1025 characters, 'time {76}'…; expected at most 1000 in a line of",
        ),
        ("velocity", CSV.replace("(g)", "(m/s)"), r"with the units s and m/s; expected s or ms"),
        ("minutes", CSV.replace("(s)", "(min)"), r"with the units min and g; expected s or ms"),
        (
            "a property of JavaScript",
            CSV.replace("(s)", "(constructor)"),
            r"the units constructor and",
        ),
        (
            "a missing sample",
            CSV.replace("0.04,0.4\n", ""),
            r"line 4: the time 0\.06 follows 0\.02 of line 3; expected equal steps",
        ),
        (
            "a missing sample behind empty lines",
            CSV.replace("0.04,0.4\n", "\n\n"),
            r"line 6: the time 0\.06 follows 0\.02 of line 3",
        ),
        (
            "a time that goes back",
            CSV.replace("0.04,", "0.01,"),
            r"line 4: the time 0\.01 follows 0\.02",
        ),
        (
            "a time twice",
            CSV.replace("0.04,", "0.02,"),
            r"line 4: the time 0\.02 follows 0\.02 of line 3",
        ),
        (
            "times that go back",
            "\n".join([CSV.split("\n")[0], *CSV.split("\n")[-2:0:-1]]),
            r"line 3: the time 0\.06 follows 0\.08",
        ),
        (
            "uneven times",
            "time (s),acceleration (g)\n0,0\n0.010,.1\n0.024,.1\n0.034,0\n0.048,.1\n0.058,0",
            r"line 3: the time 0\.010 follows 0 of line 2; expected equal steps",
        ),
        (
            "a step below a microsecond",
            "time (s),acceleration (g)\n0,.1\n1e-320,0\n2e-320,0\n",
            r"the time step is 9\.99989e-321 s; expected at least 1e-06 s: is its unit another\?",
        ),
        (
            "a time with a huge exponent",
            CSV.replace("0.00,", "0e99999999999999999999,"),
            r"line 2 is '0e99999999999999999999,0\.1'; expected a time and an acceleration",
        ),
        (
            "no time but zeros",
            "time (s),acceleration (g)\n0e9999,.1\n0e9999,.2\n",
            r"line 3: the time 0e9999 follows 0e9999 of line 2; expected equal steps of 0,",
        ),
        (
            "a step beyond the largest float",
            "time (s),acceleration (g)\n-1e308,.1\n1e308,.2\n",
            r"line 3: the time 1e308 follows -1e308 of line 2; expected equal steps of inf,",
        ),
        (
            "a duration beyond the largest float",
            "time (s),acceleration (g)\n-1.5e308,.1\n-.5e308,.2\n.5e308,.1\n1.5e308,.1\n",
            r"time_step is inf; expected a finite number",
        ),
        (
            "a time that is no number",
            CSV.replace("0.04,", "nan,"),
            r"line 4 is 'nan,0\.4'; expected a time and an acc",
        ),
        ("a word", CSV.replace("0.4", "four"), r"line 4 is '0\.04,four'; expected a time and"),
        ("a third value", CSV.replace("0.4", "0.4,1"), r"line 4 is '0\.04,0\.4,1'"),
        ("not a number", CSV.replace("0.4", "nan"), r"line 4 is '0\.04,nan'"),
        (
            "a long word",
            CSV.replace("0.4", "x" * 5000),
            r"line 4 is '0\.04,x{75}'…; expected a time and an acceleration, two numbers with",
        ),
        ("no motion", CSV[:26] + "0,0\n1,0\n2,0\n", r"all 3 accelerations are zero; expected a gr"),
        ("no value", CSV.replace("0.4", ""), r"line 4 is '0\.04,'"),
        ("beyond 5 g", CSV.replace("0.4", "39.2"), r"line 4: the largest acceleration is 39\.2 g"),
        (
            "metres",
            CSV.replace("(g)", "(m/s2)").replace("0.4", "60"),
            r"acceleration is 60 m/s2, 6\.116",
        ),
        ("one sample", CSV[:35], r"holds 1 samples; expected at least two"),
        ("not UTF-8", CSV.encode().replace(b"0.4", b"\xff"), r"line 4 is .* at byte 6 \(0xff\)"),
        *(
            row
            for digits in OTHER_DIGITS
            for row in [
                (f"a value {digits}", CSV.replace("0.4", digits), rf"line 4 is '0\.04,{digits}'"),
                (f"a time {digits}", CSV.replace("0.04", digits), rf"line 4 is '{digits},"),
            ]
        ),
    ),
    *rows(".txt", ("another ending", AT2, r"expected a file whose name ends in \.AT2 or \.csv")),
    *rows("", ("no ending", AT2, r"expected a file whose name ends in \.AT2 or \.csv")),
]
