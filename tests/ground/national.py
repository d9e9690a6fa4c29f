"""Small files in the layouts of national networks, made of the motion of the tests."""

import numpy as np

from tests.cases import MOTION

GAL = 981.0 * MOTION


def rows(texts, number):
    """Lines of so many texts each."""
    return ["".join(texts[k : k + number]) for k in range(0, len(texts), number)]


def knet(direction="E-W"):
    """K-NET; KiK-net has the directions 1 to 3 in the borehole and 4 to 6 at the surface."""
    head = (
        "Origin Time       2001/01/01 00:00:00\nLat.              35.0\nLong.             135.0\n"
        "Depth. (km)       10\nMag.              6.0\nStation Code      XXX001\n"
        "Station Lat.      35.1000\nStation Long.     135.1000\nStation Height(m) 10\n"
        "Record Time       2001/01/01 00:00:15\nSampling Freq(Hz) 100Hz\nDuration Time(s)  4\n"
        f"Dir.              {direction}\nScale Factor      3920(gal)/6182761\n"
        "Max. Acc. (gal)   277.207\nLast Correction   2001/01/01 00:00:15\nMemo.             "
    )
    counts = np.rint((GAL - 7.66) * 6182761 / 3920).astype(int)
    return "\n".join([head, *rows([f"{n:9d}" for n in counts], 8), ""])


def renadic():
    """RENADIC: three components one after the other, times (s) and g/10 in pairs."""
    lines = []
    for number, name in enumerate("LVT", 1):
        lines += [
            "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 06/30/2011",
            "1002271",
            "27/02/2010 6:34:00 (GMT)                (ORIGIN: 02/27/2010 6:34:00 GMT)",
            "                                   TRIGGER TIME: 2/27/2010 6:35:00.000 GMT",
            "STATION NO.          0.000N    0.000E  SMA-1     S/N 1234 (3  CHNS OF 3  AT STA)",
            "EXAMPLE S/N 1234",
            f"CHAN  {number}: {name}        (STA CHN:  {number})               ",
            "UNIVERSIDAD DE CHILE - RENADIC",
            "HYPOCENTER:   0.000N    0.000E  H=   0.0KM   ML= 0.00",
            "INSTR PERIOD = 0.0400 SEC,  DAMPING =0.6000,  SENSITIVITY =1.000 VDC/G",
            "NO. OF POINTS =    400  RECORD LENGTH = 3.990 SEC",
            "UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  =  0.283 G, AT   1.800 SEC",
            "RMS ACCEL OF COMPLETE RECORD = 0.002 G",
            *7 * ["    0" * 16],
            *7 * ["   0.000" * 10],
            *rows([f"{x:7.3f}" for k, a in enumerate(MOTION) for x in (0.01 * k, 10 * a)], 10),
            "/&",
        ]
    return "\n".join(lines) + "\n"


def csmip():
    """CSMIP, volume 1: one component towards 90 degrees, in g."""
    whole, real = np.zeros(100, int), np.zeros(100)
    whole[[26, 27, 32]], real[:3] = (90, 400, 400), (0.04, 0.6, 3.99)
    text = [
        "UNCORRECTED ACCELEROGRAM DATA           PROCESSED: 06/30/01, CDMG",
        "EXAMPLE",
        "",
        "TRIGGER TIME: 01/01/01, 00:00:00.0 GMT",
        "STATION NO. 12345   35.100N, 117.100W  SMA-1   S/N 1234",
        "EXAMPLE",
        "CHAN  1:  90 DEG                              FREE FIELD",
        *4 * [""],
        "UNITS OF UNCOR ACCEL ARE G",
        "",
    ]
    text += rows([f"{n:5d}" for n in whole], 16) + rows([f"{x:10.3f}" for x in real], 8)[:7]
    text += ["ACCELERATION OF 400 POINTS", *rows([f"{a:9.6f}" for a in MOTION], 8), "/&"]
    return "\n".join(text) + "\n"


def smc():
    """SMC: a corrected free-field record towards 90 degrees, in cm/s²."""
    missing = -32768
    whole, real = np.full(48, missing), np.full(50, 1.7e38)
    whole[:7] = missing, 2001, 1, 0, 0, 0, 0
    whole[[13, 15, 16, 17]], real[[1, 10, 11, 21]] = (90, 0, 400, 0), (100.0, 35.1, -117.1, 25.0)
    text = ["2 CORRECTED ACCELEROGRAM", "*", "XXX1", *6 * ["*"], *2 * ["*"]]
    text += rows([f"{n:10d}" for n in whole], 8) + rows([f"{x:15.7E}" for x in real], 5)
    return "\n".join([*text, *rows([f"{a:10.4f}" for a in GAL], 8), ""])
