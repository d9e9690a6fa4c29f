"""The digits of a number in print: agreement and disagreement can be seen."""

from dataclasses import replace

import pytest

from replication.judging.claim import Claim
from replication.judging.digits import beside_print, by_error, numbers
from replication.judging.ledger import with_verdict

CLAIM = Claim(id="n", where="p. 1", statement="It is so.", expected="confirmed")
ROW = replace(with_verdict(CLAIM, {}), computed=3.449489742783178, error=4e-16)


def found(**fields):
    return numbers(replace(ROW, **fields))


@pytest.mark.parametrize(
    ("value", "printed", "tolerance", "shown"),
    [
        (3.449489742783178, 3.4495, 5e-5, "3.44949"),  # four figures would be 3.449
        (1.180340599016096, 1.18, 5e-3, "1.180"),
        (0.27549, 0.275, 5e-4, "0.27549"),  # 0.2755 might be rounded to 0.276
        (0.27551, 0.275, 5e-4, "0.27551"),  # and to 0.275
        (0.2755, 0.275, 5e-4, "0.2755"),
        (265.02, 265, 0.5, "265.0"),
        (-0.2, -0.2, 0.05, "-0.20"),
        (1.2345678e-7, 1.2e-7, 5e-9, "0.000000123"),
    ],
)
def test_number_beside_a_printed_one_is_shown_to_a_tenth_of_the_tolerance(
    value, printed, tolerance, shown
):
    assert beside_print(value, printed, tolerance).rstrip("0") == shown.rstrip("0")


def test_a_whole_number_beside_a_whole_print_has_no_point():
    assert [beside_print(n, 20001, 0.5) for n in (20001.0, 20003.0)] == ["20001", "20003"]
    assert beside_print(20001.0, 20001.0, 0.5) == "20001.0"


@pytest.mark.parametrize(
    ("value", "error", "shown"),
    [
        (12.3456789, 0.3, "12.3"),
        (12.3456789, 0.0, "12.3457"),
        (12.3456789, 1e-12, "12.3457"),
        (1234.5, 30.0, "1234"),
        (0.5, 1e-16, "0.5"),
        (0.0, 0.0, "0"),
        (0.0, 1e-3, "0.000"),
        (2000000.0, 0.0, "2000000"),
        (0.0123, 2e-4, "0.0123"),
    ],
)
def test_any_other_number_has_the_digits_that_its_error_justifies(value, error, shown):
    assert by_error(value, error) == shown


def test_print_keeps_its_own_digits_and_stands_beside_what_is_meant():
    fields = {"printed": 3.4945, "tolerance": 5e-5, "meant": 3.4495}
    assert found(**fields) == {"printed": "3.4945", "computed": "3.44949", "meant": "3.44950"}
    assert found(printed=1e-05)["printed"] == "0.00001"
    assert found(printed="6/1") == {"computed": "3.44949"}
    assert found(computed=True) == {}
