"""Lanes: each one is a float of its own, whatever the width of the registers."""

import numpy as np
import pytest
from numba import njit

from topheavy.kernel.lanes.vectors import (
    HAS_FMA,
    WIDTH,
    absolute,
    among,
    bits,
    exponential,
    first_lane,
    fma,
    load,
    maximum,
    minimum,
    rough_power,
    rows,
    select,
    square_root,
    store,
    take,
)

RNG = np.random.default_rng(7)


def given(*values):
    """Rows of lanes with these values."""
    table = rows(len(values))
    table[:] = values
    return table


@njit
def arithmetic(x, out):
    a, b, c = load(x, 0), load(x, 1), load(x, 2)
    store(out, 0, a + b)
    store(out, 1, a - 2.0)
    store(out, 2, 3 * a)
    store(out, 3, 1.0 / b)
    store(out, 4, -a)
    store(out, 5, fma(a, b, c))
    store(out, 6, absolute(a))
    store(out, 7, square_root(absolute(a)))
    store(out, 8, minimum(a, b))
    store(out, 9, maximum(a, 0.25))


def test_each_lane_is_a_float():
    a, b, c = (RNG.normal(size=WIDTH) for _ in range(3))
    out = rows(10)
    arithmetic(given(a, b, c), out)
    exact = (a + b, a - 2, 3 * a, 1 / b, -a, None, abs(a), np.sqrt(abs(a)), np.minimum(a, b))
    for row, expected in zip(out, (*exact, np.maximum(a, 0.25)), strict=True):
        if expected is not None:
            np.testing.assert_array_equal(row, expected)
    np.testing.assert_allclose(out[5], a * b + c, rtol=1e-13)


def test_fma_rounds_once_where_the_cpu_can():
    """(1 + ε)² − 1 − 2ε is ε², which a rounded product loses."""
    tiny, out = 2.0**-30, rows(10)
    one = np.full(WIDTH, 1.0 + tiny)
    arithmetic(given(one, one, np.full(WIDTH, -1.0 - 2 * tiny)), out)
    np.testing.assert_array_equal(out[5], tiny**2 if HAS_FMA else 0.0)


@njit
def choices(x, out):
    a, b = load(x, 0), load(x, 1)
    store(out, 0, select((a < b) & ~(a <= -1.0), a, b))
    store(out, 1, select((a > b) | (a >= 1.0), 1.0, 0.0))
    store(out, 2, select(among(5), a, b))
    return bits(a < b)


def test_masks_choose_lane_by_lane():
    a, b = RNG.normal(size=WIDTH), RNG.normal(size=WIDTH)
    a[0] = b[0]
    out = rows(3)
    found = choices(given(a, b), out)
    assert [found >> lane & 1 for lane in range(WIDTH)] == (a < b).astype(int).tolist()
    assert found >> WIDTH == 0
    np.testing.assert_array_equal(out[0], np.where((a < b) & ~(a <= -1), a, b))
    np.testing.assert_array_equal(out[1], (a > b) | (a >= 1))
    np.testing.assert_array_equal(out[2], [a[i] if i in (0, 2) else b[i] for i in range(WIDTH)])


@njit
def number_of_lowest(chosen):
    return first_lane(chosen)


@pytest.mark.parametrize(("chosen", "lane"), [(1, 0), (6, 1), (1 << 15, 15), (0b1010000, 4)])
def test_lowest_bit(chosen, lane):
    assert number_of_lowest(chosen) == lane


@njit
def functions(x, exponent, out):
    store(out, 0, rough_power(load(x, 0), exponent))
    store(out, 1, exponential(load(x, 1)))


@pytest.mark.parametrize("exponent", [1 / 7, 1 / 13, 1 / 14])
def test_rough_power_is_near(exponent):
    out = rows(2)
    for _ in range(200):
        x = 10.0 ** RNG.uniform(-30, 190, WIDTH)
        functions(given(x, x * 0.0), exponent, out)
        np.testing.assert_allclose(out[0], x**exponent, rtol=0.07)


@njit
def taken(array, x, out):
    store(out, 0, take(array, load(x, 0)))


def test_take_reads_an_element_for_each_lane():
    array, out = RNG.normal(size=50), rows(1)
    places = RNG.integers(0, 50, WIDTH)
    taken(array, given(places), out)
    np.testing.assert_array_equal(out[0], array[places])
