"""Roots of a step polynomial on (0, 1], proven by the signs of its Bernstein coefficients.

A polynomial lies in the convex hull of its Bernstein coefficients, and has at most as many roots
in (0, 1) as these change sign, exactly one if they change once (Descartes' rule in Bernstein's
form: Farin, Curves and Surfaces for CAGD, 5th ed., §6; Mourrain, Rouillier & Roy 2005). More than
one change is halved by de Casteljau's rule until each part has one or none.

Where the polynomial is known to vanish m-fold at 0 (a block that has just landed or lifted off),
the first m Bernstein coefficients are zero, and the others are positive multiples of those of the
quotient by xᵐ: the root is divided out by leaving them out.
"""

import math

import numpy as np

from topheavy.kernel.compiled import compiled

MAX_DEGREE = 20
#: Parts narrower than this which still show two roots hold a touching one, which is no crossing.
MIN_WIDTH = 2.0**-44
MAX_DEPTH = 48
#: At each of the 44 depths at most degree/2 parts change sign twice or more, since halving makes no
#: new change of sign: a mean, rounded or not, never has a sign that neither of its terms has. Each
#: of these parts is visited, and so are its halves.
MAX_PARTS = 1 + 2 * 44 * (MAX_DEGREE // 2)
#: Newton's steps for a root, of which five are usual. As many halvings then leave 2⁻⁶⁴ of a step.
MAX_NEWTON_STEPS = 64
#: CONVERT[n, i, k] = C(i, k) / C(n, k) makes Bernstein coefficients of degree n.
CONVERT = np.array(
    [
        [
            [math.comb(i, k) / math.comb(n, k) if k <= min(i, n) else 0.0 for k in range(21)]
            for i in range(MAX_DEGREE + 1)
        ]
        for n in range(MAX_DEGREE + 1)
    ]
)
#: Stands for a coefficient that is zero and yet has a sign.
TINY = 1e-300


@compiled
def to_bernstein(w, p, degree, b):
    """Write the Bernstein coefficients of Σ w[p, k] xᵏ on [0, 1] to row `b`."""
    for i in range(degree + 1):
        total = 0.0
        for k in range(i + 1):
            total += CONVERT[degree, i, k] * w[p, k]
        w[b, i] = total


@compiled
def sign_changes(w, b, first, last):
    """Return how often w[b, first..last] changes sign; zeros do not count."""
    changes, previous = 0, 0.0
    for i in range(first, last + 1):
        if w[b, i] * previous < 0.0:
            changes += 1
        if w[b, i] != 0.0:
            previous = math.copysign(1.0, w[b, i])
    return changes


@compiled
def first_sign(w, b, first, last):
    """Return the sign of the first of w[b, first..last] that is not zero."""
    for i in range(first, last + 1):
        if w[b, i] != 0.0:
            return math.copysign(1.0, w[b, i])
    return 1.0


@compiled
def isolated_root(w, p, first, degree, low, high, sign):
    """Return the only root in (low, high); `sign` is that of the polynomial just above `low`."""
    x = 0.5 * (low + high)
    if low == 0.0 and w[p, first] * w[p, first + 1] < 0.0:  # a short bounce is a parabola
        x = min(x, -w[p, first] / w[p, first + 1])
    for number in range(2 * MAX_NEWTON_STEPS):
        value, slope = w[p, degree], 0.0
        for k in range(degree - 1, first - 1, -1):
            slope = slope * x + value
            value = value * x + w[p, k]
        if value * sign > 0.0:
            low = x
        else:
            high = x
        trial = x - value / slope if slope != 0.0 else low
        if abs(trial - x) <= 1e-11 * x:  # the next step of Newton's would be below rounding
            return trial if low < trial < high else x
        if number >= MAX_NEWTON_STEPS or not low < trial < high:
            trial = 0.5 * (low + high)
            if trial in (low, high):
                return x
        x = trial
    return x


@compiled
def roots(w, p, first, degree, b, stack, out, limit):
    """Find the roots in (0, 1) at which a polynomial changes sign, in ascending order.

    Parameters
    ----------
    w : array, shape (rows, MAX_DEGREE + 3)
        The working array.
    p : int
        Its row of coefficients by powers of x; those before `first` are zero.
    b : int
        Its row of Bernstein coefficients, as `to_bernstein` gives them.
    stack : int
        The first of `MAX_DEPTH` rows for the parts that wait. The row after them begins with 1
        if `MAX_PARTS` were visited and some still wait.
    out : int
        The row that takes the roots.
    limit : int
        How many are looked for.

    Returns
    -------
    int
        The number of roots found.
    """
    changes = sign_changes(w, b, first, degree)
    if changes == 0:
        return 0
    if changes == 1:
        sign = first_sign(w, b, first, degree)
        w[out, 0] = isolated_root(w, p, first, degree, 0.0, 1.0, sign)
        return 1
    low_at, high_at = degree + 1, degree + 2
    for i in range(degree + 1):
        w[stack, i] = w[b, i] if i >= first else 0.0
    w[stack, low_at], w[stack, high_at] = 0.0, 1.0
    count, part = 0, stack
    for _ in range(MAX_PARTS):
        if part < stack or count == limit:
            return count
        low, high = w[part, low_at], w[part, high_at]
        changes = sign_changes(w, part, 0, degree)
        if changes == 1:
            sign = first_sign(w, part, 0, degree)
            w[out, count] = isolated_root(w, p, first, degree, low, high, sign)
            count += 1
        elif changes > 1 and high - low > MIN_WIDTH:
            halve(w, part, part + 1, degree)
            middle = 0.5 * (low + high)
            w[part, low_at], w[part, high_at] = middle, high
            part += 1
            w[part, low_at], w[part, high_at] = low, middle
            if w[part, degree] == 0.0:  # the middle is itself a root: it belongs to this half
                w[part, degree] = first_sign(w, part - 1, 0, degree) * TINY
            continue
        part -= 1
    if part >= stack:
        w[stack + MAX_DEPTH, 0] = 1.0
    return count


@compiled
def halve(w, b, left, degree):
    """Split row `b` at ½ by de Casteljau's rule: `left` takes the first half, `b` the second."""
    w[left, 0] = w[b, 0]
    for level in range(1, degree + 1):
        for i in range(degree + 1 - level):
            w[b, i] = 0.5 * (w[b, i] + w[b, i + 1])
        w[left, level] = w[b, 0]
