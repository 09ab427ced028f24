"""A nutating or steady motion as two uniform rotations and a function of one phase, for its spectrum."""

from typing import Any

import numpy as np
from flint import arb, fmpq

from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.inputs import FloatArray, finite, scaled
from atlas.arithmetic.numbers import nearest
from atlas.errors import DomainError
from atlas.motions.nutation.certified_cayley_klein import infinite
from atlas.motions.nutation.single import BITS
from atlas.motions.spectrum import Wheels, function_of, rodrigues


def of_nutation(motion: Any, exact: Any) -> Wheels:
    """Return the `Wheels` of a motion with one phase, of nutation, or with none if it is steady.

    ``exact`` is its certified counterpart. Raises DomainError on a separatrix, and for a period beyond all floats.
    """
    (L, C), rates = motion._sides, enclosed(lambda: _rates(exact), BITS)  # noqa: SLF001  of a motion
    half, p, s = (float(x.mid()) for x in rates)
    finite(2 * half, "The period")
    n, third = (np.array([nearest(x) for x in v]) for v in (exact.field, exact.omega))
    if not n.any():  # a free body precesses about its momentum
        n = third * (1.0, 1.0, nearest(getattr(exact, "I", fmpq(1))))
    n = L @ scaled(n)[0]
    n /= np.linalg.norm(n) or 1.0
    a = np.eye(3)[getattr(exact, "places", (0, 1, 2))[2]] @ C
    if exact.is_steady:
        return Wheels(n, p, a, s, np.empty(0), lambda quantity, _: function_of(motion, quantity)(0.0)[None])
    M = np.pi / half
    t = np.linspace(0.0, 2 * half, 4)  # a passage through a pole counts half a turn less: then S would change its sign
    before, after = motion.rotation(t), motion.rotation(t + 2 * half)
    p, s = min(
        ((p + k * M / 2, s + k * M / 2) for k in (0, 1)),
        key=lambda x: float(abs(rodrigues(n, 2 * x[0] * half) @ before @ rodrigues(a, 2 * x[1] * half) - after).max()),
    )

    def at(quantity: str, x: FloatArray) -> FloatArray:
        t = x[0] / M
        values, back = function_of(motion, quantity)(t), rodrigues(a, s * t)
        if values.ndim == 2:
            return np.asarray(np.matvec(back, values))
        return np.asarray(rodrigues(n, -p * t) @ values @ np.swapaxes(back, -1, -2))

    return Wheels(n, p, a, s, np.array([M]), at)


def _rates(exact: Any) -> list[arb]:
    """Return [half the period of nutation, rate about the field, rate about the body's axis] as balls.

    ``exact`` is the certified motion; rates are in rad/time. For a steady motion the first is 1. Raises DomainError
    on a separatrix.
    """
    solution = exact.solution
    if exact.is_steady:
        first, second = arb(solution.alpha.rate), arb(solution.beta.rate)
        return [arb(1), first + second, first - second]
    if infinite(solution.lattice.half):
        raise DomainError("On a separatrix the axis comes to rest: the motion has no lines.")
    T = exact.period
    # of an elliptic motion the spin is that of the nutation
    return [T / 2, exact.precession_rate, arb(0) if exact.swings_evenly else exact.spin_rate]
