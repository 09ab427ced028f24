"""Small things that several test files need."""

import math
from fractions import Fraction


def ulps_apart(found: float, certified: str, size: float) -> float:
    """Return the distance of a float from a decimal text, in units in the last place of a number of that size."""
    if size == 0:
        return 0.0 if found == 0 else math.inf
    return abs(float(Fraction(found) - Fraction(certified))) / math.ulp(size)
