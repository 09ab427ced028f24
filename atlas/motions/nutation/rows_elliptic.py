"""Elliptic motions in arrays: the roots of Q, the sphere of K, and the evaluation at times.

Seen along the axis a about which K does not circle, an elliptic motion nutates like a top: u = -K_a moves between the
roots ±u_t of a quartic that is even in u, see `atlas.motions.nutation.certified_elliptic_quartic`. With x_i = z +
D/I_i, m the axis of the middle e_i = 1/(I_i x_i) and p the third one,

    Q = L (u^2 - u_t^2) (u^2 - w),     L = -v^2 (e_a - e_m) (e_a - e_p),     e_i - e_j = z (I_j - I_i) e_i e_j,
    u_t^2 = K_a^2 + [(I_p - I_m) I_a x_a] / [(I_p - I_a) I_m x_m] K_m^2,
    w     = K_a^2 + [(I_m - I_p) I_a x_a] / [(I_m - I_a) I_p x_p] K_p^2 < 0,

where nothing cancels but w, next to a separatrix. Kinds other than "elliptic" are not certain, and made by themselves.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, cast

import numpy as np

from atlas.arithmetic.double_double import ONE, DoubleDouble, chosen, stacked
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.lazy import cached_property
from atlas.motions.nutation.rows import CayleyKleinAtTimes, MotionsAtTimes
from atlas.motions.nutation.rows_blocks import WEIGHT_RADIUS, Block, Blocks, Constants
from atlas.motions.nutation.rows_pair import SpherePair
from atlas.motions.nutation.rows_roots import TurningPoints, poles_of
from atlas.motions.nutation.rows_scalars import HALF_TURN, Rounded, Scalars, of_period, rounded
from atlas.motions.nutation.rows_spheres import Sphere, half_angles

PLANE_FACTOR = 1 + 1e-12
"""Factor to the largest moment from which on a body is all but plane, and whether it is one is told exactly."""


@dataclass(frozen=True)
class EllipticRoots(TurningPoints):
    """The turning points of u + K_a, u = -K_a(t), a the nutating axis, with further constants, for rows (m,).

    u + K_a, 0 at t = 0, is the variable of `TurningPoints`. Q = (du/dt)^2 is even in u. `turning` is its root u_t > 0,
    where u turns back, and `w` < 0 the square of the other two roots. `K` is the field at t = 0, `axial` K_a and
    `transverse` its part across a, `b` its length; K is along a at the poles u = -b and b, where Q is -`torque`^2.

    `v` is the square root, with the sign of the branch, of the product of the three z + I_j I_k, see `Pencil`, in
    inertia^3. `rates` are E_i - 1, without unit: Omega_i = (E_i - 1) K_i; `precession` is (E_a - 1) b. `sense` are the
    signs, 1 or -1, of E_c less the other E_i, the same for both, and of K_c, c the axis about which K goes round.

    `frame` (3, 3, m) has the axes in which K starts as (0, `transverse`, `axial`), the third one a, as columns.
    `top` and `plane` are None, unlike those of `Roots`. Rates and fields are in 1/time of the scaled unit, `w` and
    `torque` in its square. Only where the mask `elliptic` holds all this is certain to be a motion of that kind.
    """

    turning: DoubleDouble
    w: DoubleDouble
    K: Sequence[DoubleDouble]
    v: DoubleDouble
    axial: DoubleDouble
    transverse: DoubleDouble
    b: DoubleDouble
    torque: DoubleDouble
    precession: DoubleDouble
    rates: Sequence[DoubleDouble]
    sense: tuple[FloatArray, FloatArray]
    frame: FloatArray
    elliptic: Any
    top: None = None
    plane: None = None

    @property
    def width(self) -> DoubleDouble:
        """Difference of the turning points of u + K_a, 2 u_t, (m,), in 1/time of the scaled unit."""
        return self.turning.scaled(1)

    @property
    def discriminant(self) -> DoubleDouble:
        """A quarter of the discriminant of f, the quartic's quadratic factor without turning points, (m,); negative."""
        return self.f[2] * self.f[2] * self.w

    @property
    def ends(self) -> DoubleDouble:
        """Values (2, m) of minus the other quadratic factor f at the turning points low and high; both are alike."""
        ends = self.f[2] * (self.w - self.turning * self.turning)
        return stacked(ends, ends)

    @property
    def is_excluded(self) -> Any:
        """Mask (m,) of the rows that are not certainly elliptic motions."""
        return ~self.elliptic

    @property
    def tilt(self) -> FloatArray:
        """Cosine and sine of the angle between axis and field at the start, (2, m)."""
        return np.array([(self.axial / self.b).hi, (self.transverse / self.b).hi])


class Pencil:
    """Inertia, K and e of elliptic motions, rows (m,), and how nutation depends on them.

    It is made from I1, I2, I3, B1, B2, B3, z and branch: `x` are z + I_j I_k, `square` is their product and `v` its
    root, with the sign of `branch`; `e` are -E_i/v = 1/(I_i x_i), K is (B1, B2, B3) at t = 0. An axis is a number
    0, 1, 2 or an array of them.
    """

    def __init__(self, *inputs: DoubleDouble) -> None:
        *self.I, B1, B2, B3, self.z, self.branch = inputs
        self.K = (B1, B2, B3)
        self.x = [self.z + self.I[i - 2] * self.I[i - 1] for i in range(3)]
        self.square = self.x[0] * self.x[1] * self.x[2]
        self.v = self.square.sqrt() * self.branch
        self.e = [ONE / (a * b) for a, b in zip(self.I, self.x, strict=True)]
        self.shape = np.broadcast_shapes(*(np.shape(y.hi) for y in inputs))

    @cached_property
    def order(self) -> Any:
        """Rank of each e_i among the three, shape (3, m): 0 for the least, 1 for the middle one, 2 for the largest.

        Equal ones have equal rank.
        """
        sign, I, z = [np.sign(y.hi) for y in self.x], self.I, np.sign(self.z.hi)
        above = [
            sum((z * np.sign((I[j] - I[i]).hi) * sign[i] * sign[j] > 0).astype(int) for j in range(3) if j != i)
            for i in range(3)
        ]
        return np.array([np.broadcast_to(y, self.shape) for y in above])

    @staticmethod
    def pick(axis: Any, numbers: Sequence[DoubleDouble]) -> DoubleDouble:
        """Return the one of three ``numbers``, (m,) each, that belongs to ``axis``: 0, 1, 2, or an array of these."""
        K_b, K_c, third = numbers
        return chosen(axis == 0, K_b, chosen(axis == 1, K_c, third))

    def difference(self, i: Any, j: Any) -> DoubleDouble:
        """Return e_j - e_i, (m,), of axes i and j (0, 1, 2, or arrays (m,) of these) without cancellation.

        It is z (I_i - I_j) e_i e_j, with e_i = 1/(z I_i + I1 I2 I3).
        """
        pick = self.pick
        return self.z * (pick(i, self.I) - pick(j, self.I)) * pick(i, self.e) * pick(j, self.e)

    def share(self, third: Any, outer: Any, axis: Any) -> DoubleDouble:
        """Return (e_t - e_o)/(e_t - e_a) K_o^2, (m,) in 1/time^2, a term of u_t^2 or of w, without cancellation.

        t, o and a are the axes ``third``, ``outer`` and ``axis``: 0, 1, 2, or arrays (m,) of these.
        """
        pick, I, x = self.pick, self.I, self.x
        size = pick(outer, self.K)
        up = (pick(third, I) - pick(outer, I)) * pick(axis, I) * pick(axis, x)
        return up / ((pick(third, I) - pick(axis, I)) * pick(outer, I) * pick(outer, x)) * (size * size)

    @cached_property
    def nutation_axis(self) -> tuple[Any, Any, Any]:
        """Three axes, (m,) of 0, 1, 2 each: a, whose K_a nutates; that of the middle e; and the one K goes round.

        The first and the third are those of the least and of the largest e, in either order.
        """
        pick, K, e = self.pick, self.K, self.e
        low, middle, high = (np.argmax(self.order == n, axis=0) for n in range(3))
        # (h - e_m N)/(z e_m), whose sign with that of z e_m says about which of the outer axes K does not circle
        outer = [(pick(middle, self.I) - pick(i, self.I)) * pick(i, e) * pick(i, K) * pick(i, K) for i in (low, high)]
        beyond = (outer[0] + outer[1]).hi * np.sign(self.z.hi) * np.sign(pick(middle, e).hi) > 0
        return np.where(beyond, low, high), middle, np.where(beyond, high, low)

    @cached_property
    def rates(self) -> list[DoubleDouble]:
        """Factors E_i - 1, a list for i = 1, 2, 3 of arrays (m,), without unit: Omega_i = (E_i - 1) K_i."""
        return [-(self.v * y) - ONE for y in self.e]

    def is_elliptic(self, w: DoubleDouble) -> Any:
        """Return a mask (m,) of rows that are certainly elliptic motions, given ``w``, see `EllipticRoots`.

        False also where rounding leaves the kind open, and near rest.
        """
        sizes, rank = np.array([np.broadcast_to(y.hi, self.shape) for y in self.I]), self.order
        conditions = [
            (sizes > 0).all(0) & (2 * PLANE_FACTOR * sizes.max(0) < sizes.sum(0)) & (abs(self.branch.hi) == 1),
            *(y.rel < 0.5 for y in self.x), self.square.hi > 0,
            (rank.max(0) == 2) & (rank.sum(0) == 3),  # no two of e are one
            np.count_nonzero(np.broadcast_arrays(*(y.hi for y in self.K)), axis=0) > 1,
            w.hi < 0, w.rel < 0.5,
            *(y.rel < WEIGHT_RADIUS for y in self.rates),  # next to rest they are 1 - x for x near 1
        ]  # fmt: skip
        return np.logical_and.reduce([np.broadcast_to(y, self.shape) for y in conditions])


def roots_of_elliptic(*inputs: DoubleDouble) -> EllipticRoots:
    """Return the `EllipticRoots` of I1, I2, I3, B1, B2, B3, z and branch (1 or -1), which broadcast to (m,).

    z, in inertia^2, is the family's parameter, as in `Pencil`; the branch is the sign of v. No row raises: where the
    motion is not certainly elliptic, `elliptic` is False and the rest without meaning.
    """
    pencil = Pencil(*inputs)
    pick, I, K, e, v = pencil.pick, pencil.I, pencil.K, pencil.e, pencil.v
    axis, middle, outer = pencil.nutation_axis
    axial = pick(axis, K)
    square_of_axial = axial * axial
    rise, fall = pencil.share(outer, middle, axis), pencil.share(middle, outer, axis)
    w = square_of_axial + fall
    turning = (square_of_axial + rise).sqrt()
    long_way = turning + abs(axial)
    short_way = rise / long_way
    up = axial.hi > 0  # v = u + K_a
    axis_b, axis_c = (axis + 1) % 3, (axis + 2) % 3
    K_b, K_c = pick(axis_b, K), pick(axis_c, K)
    sides = [pencil.difference(i, axis) for i in (axis_b, axis_c)]
    squares = K_b * K_b, K_c * K_c
    flat = squares[0] + squares[1]
    transverse, b = flat.sqrt(), (flat + square_of_axial).sqrt()
    L = -(pencil.square * sides[0] * sides[1])
    return EllipticRoots(
        rate=v * K_b * K_c * pencil.z * (pick(axis_b, I) - pick(axis_c, I)) * pick(axis_b, e) * pick(axis_c, e),
        low=-chosen(up, short_way, long_way),
        high=chosen(up, long_way, short_way),
        f=(-(L * fall), -(L * axial).scaled(1), L),
        poles=poles_of(axial, flat, b),
        turning=turning,
        w=w,
        K=K,
        v=v,
        axial=axial,
        transverse=transverse,
        b=b,
        torque=v * (sides[0] * squares[0] + sides[1] * squares[1]),
        precession=pick(axis, pencil.rates) * b,
        rates=pencil.rates,
        sense=(np.where(outer == (pencil.order == 2).argmax(0), -1.0, 1.0) * np.sign(v.hi), np.sign(pick(outer, K).hi)),
        frame=_frame(axis, (K_b / transverse).hi, (K_c / transverse).hi, pencil.shape),
        elliptic=pencil.is_elliptic(w),
    )


def _frame(axis: Any, x: Any, y: Any, shape: tuple[int, ...]) -> FloatArray:
    """Return axes (3, 3, ...) turned about `axis` so that the transverse vector (x, y) lies along the second one.

    `axis` is an array of 0, 1, 2; x and y are the components, over the length, along the two axes that follow it in
    cyclic order. The axes are columns, `axis` the third one; ``shape`` is that of the motions.
    """
    axes = np.zeros((3, 3, *shape))
    for k in range(3):
        is_axis, axis_b, axis_c = axis == k, (axis + 1) % 3 == k, (axis + 2) % 3 == k
        axes[k] = (
            np.where(axis_b, y, np.where(axis_c, -x, 0.0)),
            np.where(axis_b, x, np.where(axis_c, y, 0.0)),
            is_axis,
        )
    return axes


@dataclass(frozen=True)
class EllipticBlock(Block):
    """A block of elliptic motions; `roots` are `EllipticRoots`."""

    roots: EllipticRoots  # type: ignore[assignment]  # both are TurningPoints

    @cached_property
    def pair(self) -> SpherePair:
        """The `SpherePair` alpha, beta of the nutating axis, on the sphere of K."""
        r = self.roots
        length, half = r.b.hi, r.precession.scaled(-1)
        return SpherePair(
            self.means,
            Sphere(
                roots=r,
                poles=r.poles,
                torques=stacked(r.torque, r.torque),
                amplitudes=half_angles(r.axial, r.transverse, r.b),
                meets=np.zeros((2, length.size), dtype=bool),
                slopes=np.zeros((2, length.size)),
                frames=stacked(half, half),
                azimuth=(np.ones_like(length), np.zeros_like(length)),
                sizes=(length, length),
            ),
        )


class EllipticBlocks(Blocks):
    """Motions I1, I2, I3, B1, B2, B3, z, branch, which broadcast to a shape, iterated by `EllipticBlock`."""

    _unit, _block, _roots = slice(3, 6), EllipticBlock, staticmethod(roots_of_elliptic)


class EllipticScalars(Scalars):
    """Scalars of elliptic motions in arrays, each a `Rounded` by its name, all computed in one pass."""

    def _values(self, name: str) -> Callable[[Block], dict[str, Rounded]]:
        del name
        return _scalars


def _scalars(block: Block) -> dict[str, Rounded]:
    """Return scalars of a block by name, as `Rounded`: those of `of_period`, kind, angles in a period, v and omega.

    Angles are in rad, omega (3, m) in rad/time, v in inertia^3; kind is 0, for "elliptic".
    """
    with np.errstate(all="ignore"):
        r, angles = cast("EllipticRoots", block.roots), block.pair.angles
        mean = angles[0] + angles[1] + r.precession.scaled(1)
        omega = [rounded(rate * K, block, 1) for rate, K in zip(r.rates, r.K, strict=True)]
        shape = r.elliptic.shape
        turn = HALF_TURN.scaled(1) * DoubleDouble(r.sense[0])  # by which the axis that K goes round lags in a period
        scalars = of_period(block) | {
            "kind": Rounded(np.zeros(shape, int), block.is_similar),
            "precession_per_period": rounded((HALF_TURN / block.means.rate).scaled(-1) * mean - turn, block),
            "spin_per_period": rounded(turn * DoubleDouble(r.sense[1]), block),
            "v": rounded(r.v, block),
            "omega": Rounded(
                np.array([np.broadcast_to(x.values, shape) for x in omega]),
                np.logical_and.reduce([np.broadcast_to(x.is_certain, shape) for x in omega]),
            ),
        }
        return {
            name: Rounded(
                np.broadcast_to(x.values, (*x.values.shape[:-1], *shape)), x.is_certain & r.elliptic & r.exact
            )
            for name, x in scalars.items()
        }


class Axes(NamedTuple):
    """Axes in which alpha and beta are given, and the factors from K to Omega, of m elliptic motions.

    `frames` (3, 3, m) has the axes in the body as columns, the nutating axis third; `rates` (3, m) are E_i - 1
    along the principal axes.
    """

    frames: FloatArray
    rates: FloatArray


class EllipticAtTimes(MotionsAtTimes):
    """Elliptic motions paired with times, as `MotionsAtTimes`: row k is one motion at its own time."""

    @staticmethod
    def constants(block: Any) -> tuple[Any, ...]:
        """Return the tuple (`Constants`, `Axes`) of a block of elliptic motions."""
        r = block.roots
        rates = [np.broadcast_to(rate.hi, r.elliptic.shape) for rate in r.rates]
        return block.constants, Axes(r.frame, np.array(rates))

    def _pair(self, constants: Constants, _: Any = None) -> CayleyKleinAtTimes:
        """Return the `CayleyKleinAtTimes` of the selected motions, from the constants of all.

        `extreme` becomes the indices that need the scalar path. The second argument, an `Axes`, is not used.
        """
        return super()._pair(constants)

    @property
    def _frames(self) -> FloatArray:
        """Matrices (m, 3, 3) of the selected motions: the axes of alpha and beta in the body, as columns."""
        return np.moveaxis(self._rows.field[1].frames[..., self._index], -1, 0)

    def rotation(self, t: FloatArray, out: FloatArray) -> None:
        """Write R of each motion at its time into ``out`` (m, 3, 3), along the body's principal axes.

        The argument t is not used: the times are those of this object.
        """
        super().rotation(t, out)
        C = self._frames
        out[:] = C @ out @ C.mT

    def column(self, j: int, t: FloatArray, out: FloatArray) -> None:
        """Write the column R_j, j = 1, 2, 3, of each motion's matrix at its time into ``out`` (m, 3).

        The argument t is not used: the times are those of this object.
        """
        R = np.empty((len(out), 3, 3))
        self.rotation(t, R)
        out[:] = R[:, :, j - 1]

    def quaternion(self, t: FloatArray, out: FloatArray) -> None:
        """Write the unit quaternion (x, y, z, w) of each motion at its time, of either sign, into ``out`` (m, 4).

        The argument t is not used: the times are those of this object.
        """
        super().quaternion(t, out)
        out[:, :3] = np.matvec(self._frames, out[:, :3])

    def field_in_body(self, t: FloatArray, out: FloatArray) -> None:
        """Write K, the field along the body's axes in 1/time, of each motion at its time into ``out`` (m, 3).

        The argument t is not used: the times are those of this object.
        """
        super().field_in_body(t, out)
        out[:] = np.matvec(self._frames, out)

    def angular_velocity(self, t: FloatArray, out: FloatArray) -> None:
        """Write Omega = (E - 1) K, along the body's axes in rad/time, of each motion at its time to ``out`` (m, 3).

        The argument t is not used: the times are those of this object.
        """
        self.field_in_body(t, out)
        out *= self._rows.field[1].rates[:, self._index].T
