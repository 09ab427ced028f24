"""The scalars of many tops in arrays: kind, turning points, period, moduli, nome and the angles of a period.

What two words do not hold for certain is not `sure`, and is left to the top made alone, as are the roots.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from atlas.core.nutation.blocks import Block
from atlas.core.nutation.roots import part
from atlas.core.nutation.scalars import HALF_TURN, Found, Scalars, of_period, rounded

KINDS = "nutation, two real roots", "nutation, four real roots", "nutation, three real roots", "regular nutation"
"""Kinds that are decided in arrays."""


class TopScalars(Scalars):
    """Scalars of many tops."""

    def values(self, name: str) -> Callable[[Block], dict[str, Found]]:
        """Return what evaluates a scalar, with others, in a block."""
        return _angles if name.endswith("per_period") else _scalars


def _scalars(block: Block) -> dict[str, Found]:
    """Return them of a block."""
    with np.errstate(all="ignore"):
        r = block.roots
        found = of_period(block)
        low, high = (rounded(r.nu - x, block) for x in (r.high, r.low))
        found["turning_points"] = Found(np.array([low.values, high.values]), low.sure & high.sure)
        cubic, even = r.A.hi == 0, (r.a.hi == 0) & (r.A.hi == 0)
        codes = np.select([even, cubic, r.discriminant.hi > 0], [3, 2, 1], 0)
        certain = (cubic | (r.discriminant.rel < 0.5)) & r.moving
        found["kind"] = Found(codes, block.fine & certain)
        known = r.exact & r.moving
        return {name: Found(x.values, x.sure & known) for name, x in found.items()}


def _angles(block: Any) -> dict[str, Found]:
    """Return the angles of precession and of spin in one period."""
    with np.errstate(all="ignore"):
        r = block.roots
        first, second = part(block.pair.angles, 0), part(block.pair.angles, 1)
        half = (HALF_TURN / block.means.rate).scaled(-1)
        both = {
            "precession_per_period": half * (first + second - r.k2.scaled(1)),
            "spin_per_period": half * (first - second + (r.spin + block.swing_rate).scaled(1)),
        }
        found = {name: rounded(x, block) for name, x in both.items()}
        return {name: Found(x.values, x.sure & r.exact & r.moving) for name, x in found.items()}
