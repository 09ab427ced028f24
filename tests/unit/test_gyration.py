import mpmath
import numpy as np
from mpmath import mp
from numpy.typing import NDArray

from atlas.motions.particle.rows import Gyration, gyration

EPS = float(np.finfo(float).eps)


def functions(x: NDArray[np.float64]) -> Gyration:
    """Return the functions at phases that are floats themselves."""
    return gyration(x, np.cos(x), np.sin(x), 2 * np.sin(x / 2) ** 2)


def test_the_functions_keep_their_digits_from_zero_to_many_turns() -> None:
    """Each agrees with mpmath to 4 ulp of its own size, down to x = 1e-300 and through x = 2."""
    x = np.concatenate(
        [np.logspace(-300, -1, 60), np.linspace(0.1, 3.2, 200), [np.nextafter(2, 0), 2.0, 7.7, 1e3, 1e5]]
    )
    x = np.concatenate([-x[::7], x])
    got = functions(x)
    with mp.workdps(700):
        for i, value in enumerate(x):
            y = mp.mpf(float(value))
            c, s = mp.cos(y), mp.sin(y)
            true = {"s": s / y, "f": (1 - c) / y**2, "g": (1 - c) / y, "h": (y - s) / y**2}
            for name, want in true.items():
                assert abs(float(getattr(got, name)[i]) - want) <= 4 * EPS * abs(want), (name, value)


def test_zero_and_the_smallest_phases_give_the_limits() -> None:
    """At x = 0, of either sign, and at the smallest float, the limits stand, without a warning."""
    for x in (0.0, -0.0, 5e-324, 1e-308):
        got = functions(np.array([x]))
        assert (got.s[0], got.f[0], got.g[0]) == (1, 0.5, x / 2)
        assert mpmath.almosteq(float(got.h[0]), x / 6, abs_eps=5e-324, rel_eps=EPS)
