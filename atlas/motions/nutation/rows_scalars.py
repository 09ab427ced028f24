"""The scalars of many motions in arrays: kind, turning points, roots, period, moduli, nome and the angles of a period.

Values that double-double does not hold for certain are left to single motions: next to a separatrix or
a triple root, where theta is all but constant, where the inputs are of very different sizes; and a top's roots.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from atlas.arithmetic.double_double import DoubleDouble, chosen
from atlas.motions.nutation.rows_blocks import Block, Blocks
from atlas.motions.nutation.rows_roots import plus

IN_ARRAYS = (
    "kind",
    "turning_points",
    "period",
    "modulus",
    "complementary_modulus",
    "nome",
    "precession_per_period",
    "spin_per_period",
)
"""Scalars of motions of any kind that are made in arrays."""

KINDS = (
    "nutation, two real roots",
    "nutation, four real roots",
    "ball",
    "at rest",
    "precession",
    "spin along the field",
    "free body",
)
"""Types of motion that are decided in arrays; a motion nearer to a border than the error is none of them."""

TOP_KINDS = "nutation, two real roots", "nutation, four real roots", "nutation, three real roots", "regular nutation"
"""Scalars of tops that are evaluated in arrays."""

HALF_TURN = DoubleDouble(np.float64(np.pi), np.float64(1.2246467991473532e-16), 2.0**-106)


class Rounded(NamedTuple):
    """`values` (..., m) of m motions as doubles, and the mask `is_certain` (m,) of certainly nearest doubles."""

    values: Any
    is_certain: Any


class Scalars:
    """Scalars of the motions of ``blocks`` by name, each a `Rounded`; a pass computes several at once.

    Names and units are those of the public classes; "kind" is an index into KINDS or TOP_KINDS.
    """

    def __init__(self, blocks: Blocks) -> None:
        self.blocks = blocks
        self._cached_results: dict[str, Rounded] = {}

    def __getitem__(self, name: str) -> Rounded:
        """Return the `Rounded` of a scalar by its name."""
        if name not in self._cached_results:
            self._fill(self._values(name))
        return self._cached_results[name]

    def _values(self, name: str) -> Callable[[Block], dict[str, Rounded]]:
        """Return the function from a `Block` to the scalar ``name`` and all others of its pass, by name."""
        return _angles if name.endswith("per_period") else _scalars

    def _fill(self, values: Callable[[Block], dict[str, Rounded]]) -> None:
        """Evaluate the scalars that ``values`` gives of a `Block` for all blocks, and cache them."""
        rounded_roots: dict[str, list[Rounded]] = {}
        count = self.blocks.count
        for block in self.blocks if count else type(self.blocks)((1.0,) * len(self.blocks.inputs), (1,)):
            for name, scalar in values(block).items():
                rounded_roots.setdefault(name, []).append(scalar)
        for name, all_of_it in rounded_roots.items():
            columns = (np.concatenate(x, axis=-1)[..., :count] for x in zip(*all_of_it, strict=True))
            self._cached_results[name] = Rounded(*columns)


def rounded(x: DoubleDouble, block: Block, degree: int = 0) -> Rounded:
    """Return numbers x (m,) of a block as `Rounded`, in the given unit.

    x is in the scaled unit and homogeneous of ``degree`` in the frequencies. Values of extreme size are not certain.
    """
    values, is_sure = x.nearest()
    values = np.ldexp(values, degree * block.exponents)
    return Rounded(
        values, is_sure & block.is_similar & ((values == 0) | ((abs(values) > 2.0**-1000) & (abs(values) < np.inf)))
    )


def _scalars(block: Block) -> dict[str, Rounded]:
    """Return kind, turning points, period, moduli, nome and, except of tops, roots of a block: `Rounded` by name."""
    with np.errstate(all="ignore"):
        r = block.roots
        is_field = r.top is None
        is_known = r.exact & (~r.is_excluded if is_field else r.moving)
        scalars = of_period(block) | ({} if is_field else _of_tops(block))
        scalars = {name: Rounded(x.values, x.is_certain & is_known) for name, x in scalars.items()}
        return scalars | _kinds(block) | _all_roots(block) if is_field else scalars


def _of_tops(block: Block) -> dict[str, Rounded]:
    """Return the turning points of the tops of a block, (2, m), and their kinds, each a `Rounded` by name.

    A kind is an index into TOP_KINDS. ``block`` is a `Block` of m tops.
    """
    r = block.roots
    low, high = (rounded((r.n3 - x) / r.b, block) for x in (r.high, r.low))
    cubic, even = r.A.hi == 0, (r.a.hi == 0) & (r.A.hi == 0) if r.a else np.False_
    codes = np.select([even, cubic, r.discriminant.hi > 0], [3, 2, 1], 0)
    is_sure = (cubic | (r.discriminant.rel < 0.5)) & r.moving
    ends = Rounded(np.array([low.values, high.values]), low.is_certain & high.is_certain)
    return {"turning_points": ends, "kind": Rounded(codes, block.is_similar & is_sure)}


def of_period(block: Block) -> dict[str, Rounded]:
    """Return period (time), modulus, complementary modulus and nome of a block, each a `Rounded` (m,) by name."""
    means, nome = block.means, block.means.nome
    return {
        "period": rounded(HALF_TURN / means.rate, block, -1),
        "modulus": rounded(means.moduli[0], block),
        "complementary_modulus": rounded(means.moduli[1], block),
        "nome": rounded(chosen(means.four, nome, nome * nome), block),
    }


def _kinds(block: Block) -> dict[str, Rounded]:
    """Return {"kind": `Rounded` of indices into KINDS} of a block of bodies in a field."""
    r = block.roots
    steady = np.select([r.at_rest, r.starts_on_field], [3, 5], 4)
    fieldless, moving = np.where(r.at_rest, 3, 6), np.where(r.discriminant.hi > 0, 1, 0)
    codes = np.select([r.is_excluded, r.steady, r.ball], [fieldless, steady, 2], moving)
    separate = r.exact & (r.discriminant.rel < 0.5)
    return {"kind": Rounded(codes, block.is_similar & (r.is_excluded | r.steady | (r.moving & (r.ball | separate))))}


def _all_roots(block: Block) -> dict[str, Rounded]:
    """Return the turning points (2, m) and the complex roots of Q (4, m) of ``block``, each a `Rounded` by name.

    They are in rad/time. Real roots come first, ascending; a root at infinity is inf.
    """
    r = block.roots
    root_1, root_2, imaginary = r.other_roots
    low, high = (rounded(r.omega[2] + x, block, 1) for x in (r.low, r.high))
    ends = Rounded(np.array([low.values, high.values]), low.is_certain & high.is_certain & r.exact)
    rounded_roots = [rounded(x, block, 1) for x in (r.omega[2] + root_1, r.omega[2] + root_2, imaginary)]
    x, y, z = (x.values for x in rounded_roots)
    two = (r.discriminant.hi <= 0) & ~r.ball
    gone = r.ball | two
    roots = np.sort([*ends.values, np.where(gone, np.inf, x), np.where(gone, np.inf, y)], axis=0).astype(complex)
    roots[2:, two] = np.array([x - 1j * z, x + 1j * z])[:, two]
    is_certain = np.logical_and.reduce([x.is_certain for x in rounded_roots]) & (r.discriminant.rel < 0.5)
    return {"turning_points": ends, "roots": Rounded(roots, ends.is_certain & (r.ball | is_certain) & ~r.is_excluded)}


def _angles(block: Block) -> dict[str, Rounded]:
    """Return the total angles of precession and spin in one period of a block, in rad, `Rounded` (m,) by name.

    The names are "precession_per_period" and "spin_per_period".
    """
    with np.errstate(all="ignore"):
        r = block.roots
        sphere, angles = block.pair.sphere, block.pair.angles
        angle_of_alpha, angle_of_beta = angles[0], angles[1]
        half = (HALF_TURN / block.means.rate).scaled(-1)
        spin = half * (angle_of_alpha - angle_of_beta + plus(block.swing_rate, r.less * r.c3).scaled(1))
        # the two angles of a ball are half a turn each, or none, and must not cancel
        half_turns = HALF_TURN * DoubleDouble(np.sign(sphere.torques.hi[0]) - np.sign(sphere.torques.hi[1]))
        angles_by_name = {
            "precession_per_period": half * (angle_of_alpha + angle_of_beta - r.frame.scaled(1)),
            "spin_per_period": chosen(r.ball & (sphere.torques.rel < 0.5).all(axis=0), half_turns, spin),
        }
        is_known = r.exact & (~r.is_excluded & ~(r.steady & r.starts_on_field) if r.top is None else r.moving)
        of_period = {name: rounded(x, block) for name, x in angles_by_name.items()}
        return {name: Rounded(x.values, x.is_certain & is_known) for name, x in of_period.items()}
