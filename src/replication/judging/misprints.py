"""Tell a misprinted number from a wrong one: does one slip of the pen separate two numbers?"""

from decimal import Decimal


def one_slip_apart(printed: float, meant: float, decimals: int) -> bool:
    """Return whether one slip of a writer or typesetter can turn one number into the other.

    A slip is a wrong, lost or added digit; two neighbouring digits that are exchanged; a wrong
    sign; a moved decimal point; or a last digit that is rounded to the wrong side. The number that
    is meant is rounded to the decimals that are printed.
    """
    one, other = f"{printed:.{decimals}f}", f"{meant:.{decimals}f}"
    if one == other:
        return False
    if abs(Decimal(one) - Decimal(other)) == Decimal(1).scaleb(-decimals):
        return True
    figures = Decimal(one).as_tuple().digits
    if figures == Decimal(f"{meant:.{len(figures) - 1}e}").as_tuple().digits:
        return True  # but for the sign or the decimal point
    if len(one) != len(other):
        short, long = sorted((one, other), key=len)
        return any(long[:n] + long[n + 1 :] == short for n in range(len(long)))
    first, *more = (n for n in range(len(one)) if one[n] != other[n])
    exchanged = more == [first + 1] and one[first : first + 2] == other[first : first + 2][::-1]
    return not more or exchanged
