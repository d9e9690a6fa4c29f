"""A number of a document has a source, or a reason; one without is named with its sentence."""

import math

import pytest

from documents.quotes import Numbers
from replication.marks import inputs, without_marks

SETTINGS = {
    "vase": {"period": 1.5, "amplitude": 0.005, "mass_ratios": [0.5, 2.0, math.inf]},
    "motions": {"structures": ["low", "tall"]},
    "structures": {
        "low": {"half_width": 0.25, "half_height": 1.5},
        "tall": {"half_width": 0.5, "half_height": 3.0},
    },
}


@pytest.mark.parametrize(
    ("text", "marked", "printed"),
    [
        ("{vase[period]:g} s", "⟨config:vase.period|1.5⟩ s", "1.5 s"),
        ("{vase[amplitude]:1000*g} mm", "⟨config:vase.amplitude|5⟩ mm", "5 mm"),
        (
            "{vase[mass_ratios]:g}",
            "⟨config:vase.mass_ratios.0|0.5⟩, ⟨config:vase.mass_ratios.1|2⟩ and "
            "⟨config:vase.mass_ratios.2|∞⟩",
            "0.5, 2 and ∞",
        ),
        ("{vase[mass_ratios][last]:g}", "⟨config:vase.mass_ratios.2|∞⟩", "∞"),
        (
            "{column[low]}",
            "⟨config:structures.low.half_height|3⟩ m by ⟨config:structures.low.half_width|0.5⟩ m",
            "3 m by 0.5 m",
        ),
        ("{column[motions.structures]:2*}", None, "6 m by 1 m and 12 m by 2 m"),
        ("γ = ⟨as heavy as both|1⟩", "γ = ⟨as heavy as both|1⟩", "γ = 1"),
    ],
)
def test_a_text_names_inputs_and_their_source(text, marked, printed):
    filled = text.format(**inputs(SETTINGS))
    assert marked in (None, filled)
    assert without_marks(filled) == printed


@pytest.mark.parametrize(
    ("html", "expected"),
    [
        ("<p>It fell. It took 12.3&nbsp;s, e.g.</p>", [("12.3", "It took 12.3 s, e.g.")]),
        (
            '<p>It took <a class="number" title="vase.time" href="">12</a> s, or 3.</p>',
            [("3", None)],
        ),
        ('<p>Order <span class="typed" title="a name">8</span>.</p>', []),
        ('<div class="typed"><p>Frame 1.</p><p>Frame 2.</p></div><p>7</p>', [("7", "7")]),
        ("<p>At <math><mi>γ</mi><mo>=</mo><mn>0.5</mn></math>.</p>", [("0.5", "At γ=0.5.")]),
        ("<p><math><mn>1</mn><mo>+</mo><mn>3</mn><mi>γ</mi></math></p>", []),
        ("<p><math><mi>a</mi><mo>=</mo><mn>12.3</mn><mi>y</mi></math></p>", [("12.3", None)]),
        ("<p>Eqs. (19), (22) and (23), Fig. 2, p. 4 of Allen et al. (1986)</p>", []),
        ("<h2>5 Results</h2><p><code>x1</code> <a>Table 3</a></p>", []),
    ],
)
def test_a_number_without_a_source_is_named_with_its_sentence(html, expected):
    without = Numbers(f"<html><body>{html}</body></html>").without
    assert [number for number, _ in without] == [number for number, _ in expected]
    for (_, sentence), (_, words) in zip(without, expected, strict=True):
        assert words in (None, sentence)
