"""Monodromy of a symmetric top: change of the periods on a loop round a focus-focus value, theorem-residue.

At regular values of (M3, p, g) the motion lies on a torus. Its periods are the lattice of all (s, t, u) for which the
turn by s about n, the turn by t about the body's axis and the motion for the time u, one after the other, bring the
top back. A basis is

    g1 = (2 pi, 0, 0),     g2 = (0, 2 pi, 0),     g3 = (-Delta psi, -Delta chi, T),

T the period of nutation and Delta psi, Delta chi the angles of precession and spin in it. g1 and g2 are the same
everywhere; g3 continued along a loop comes back as another vector of the lattice. Not in the paper.
"""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from flint import arb

from atlas.arithmetic.inputs import FloatArray, integer, number
from atlas.arithmetic.numbers import nearest, workprec
from atlas.arithmetic.words import exact
from atlas.bodies.symmetric_top import inputs_of_top
from atlas.errors import DomainError, NotCertifiedError
from atlas.maps.wells import Wells
from atlas.motions.nutation.certified_top import TopMotion

PRECISION = 128
"""Binary digits of the balls of period and angles."""

GRID = np.concatenate([np.geomspace(1e-12, 1e-3, 400)[:-1], 1 - np.linspace(1.0, -1.0, 2001)[1:-1]])
"""Places 1 - end nu at which the potential is looked at, from the pole nu = end, where they are dense, to the other."""

MIN_LOOP_SIZE = 2.0**-40
"""Least size of a loop, relative to momentum and energy of the spin."""

MAX_ELLIPSES = 12
"""Upper limit of the number of ellipses tried, each half as large as the one before."""

MIN_RATE_SQUARE = 1e-280
"""Least square of a rate, beside which an energy keeps its digits."""


@dataclass(frozen=True, eq=False)
class Monodromy:
    """Periods of a top continued round a closed loop of its constants, as `atlas.monodromy` returns them.

    Attributes
    ----------
    p, g : ndarray, shape (N + 1,)
        Loop: the momentum p along n, in inertia/time, and g = I2 (dtheta/dt)^2 + V with the potential V of
        theorem-every-top, in inertia/time^2. The last point is the first.
    period : ndarray, shape (N + 1,)
        Period T of the nutation.
    turns : ndarray, shape (N + 1, 2)
        Precession and proper rotation in one period, divided by 2 pi, continued along the loop.
    step : float
        Largest change of `turns` between neighbours, after the change of T times the rate at the first point is taken
        off; below 1/4, so that the continuation is unique.
    radius : float
        Largest radius of the certified enclosures of `turns`.
    """

    p: FloatArray
    g: FloatArray
    period: FloatArray
    turns: FloatArray
    step: float
    radius: float

    @property
    def matrix(self) -> tuple[tuple[int, int, int], ...]:
        """Monodromy matrix (3, 3) of integers: rows are g1, g2, g3 after the loop in terms of those before."""
        m, n = (round(float(x)) for x in self.turns[-1] - self.turns[0])
        return (1, 0, 0), (0, 1, 0), (-m, -n, 1)


def monodromy(
    inertia: tuple[float, float],
    M3: float,
    *,
    coupling: tuple[float, float] = (0.0, 0.0),
    linear: float = 0.0,
    quadratic: float = 0.0,
    p: float | None = None,
    points: int = 48,
) -> Monodromy:
    """Monodromy of the periods of a top around an unstable spin, theorem-residue.

    Parameters
    ----------
    inertia : (I2, I3)
        Moments across and along the axis.
    M3 : float
        Momentum along the axis, in inertia/time.
    coupling : (k2, k3)
        Gyroscopic coupling, in inertia/time.
    linear, quadratic : float
        Coefficients of the potential, in inertia/time^2, as in `TopMotion`.
    p : float, optional
        Momentum of the spin along n: M3 (default) or -M3. For M3 = 0 the spin along n if unstable, else against n.
    points : int
        Number of points on the loop, at least 3.

    Returns
    -------
    Monodromy
        Integer `matrix`, the loop `p`, `g` and the largest `step` of an angle.

    Raises
    ------
    DomainError
        For no body, for a spin that is stable or no isolated value, for rates out of range, and for too few points.
    NotCertifiedError
        If the balls do not determine the integers.
    AtlasError
        For an input that is no number.

    Notes
    -----
    The loop runs counter-clockwise in momentum p and energy g. The rows of `matrix` are the images of g1 (one turn
    about n), g2 (one about the axis) and g3 (one nutation, less its turns). Angles are balls. The integers assume that
    no angle changes by half a turn between neighbouring points.

    Examples
    --------
    >>> len(atlas.monodromy((1.0, 0.5), 0.5, linear=1.0).matrix)
    3
    """
    top = inputs_of_top(inertia, coupling, (0.0, 1.0), linear, quadratic)
    parameters = [number(x, "A parameter of the top") for x in (*top[:4], *top[6:], M3, M3 if p is None else p)]
    unit, *scaled_values = parameters
    I, *twist, weight, lean, momentum, middle = (x / unit for x in scaled_values)
    wells = Wells.at(momentum, I, (twist[0], twist[1]), weight, lean)
    size = 4 * (abs(wells.A) + abs(wells.a)) + momentum * momentum
    if size and not MIN_RATE_SQUARE < max(size, abs(middle)) < math.inf:
        raise DomainError("The rates of this top are too large or too small for floats: choose another unit of time.")
    integer(points, "The number of points", 3)
    end, D = unstable_spin(*parameters)
    values = around(wells, middle, points, end, D, slope=middle)
    loop = on_loop(I, (twist[0], twist[1]), momentum, values, weight, lean)
    return replace(loop, p=loop.p * unit, g=loop.g * unit)


def unstable_spin(*inputs: float) -> tuple[int, float]:
    """Return (end, D/I2^2) of an unstable spin about n: end is 1 along n and -1 against it, D < 0; decided exactly.

    ``inputs`` are I2, I3, k2, k3, linear, quadratic, M3 and p, as in `monodromy`; D is that of theorem-focus. Raises
    DomainError for a momentum p of no spin, and for a stable spin.
    """
    if abs(inputs[-2]) != abs(inputs[-1]):
        raise DomainError(
            f"p: a spin about n has the momentum M3 or -M3, {inputs[-2]:g} or {-inputs[-2]:g}, not {inputs[-1]:g}."
        )
    I, k2, k3, linear, quadratic, M3, p = (x / exact(inputs[0])[0] for x in exact(*inputs[1:]))
    A, a = k3 * k3 / I - k2 * k2 + quadratic, M3 * (k2 - k3 / I) + linear
    ends = (1, -1) if M3 == 0 else (1 if p == M3 else -1,)
    D = {end: M3 * M3 - 4 * (A + end * a) for end in ends}
    for end in ends:
        if D[end] < 0:
            return end, nearest(D[end])
    raise DomainError(
        f"M3: the value of the spin, M3 = {inputs[-2]:g} and p = {inputs[-1]:g}, is no isolated one: D is not "
        f"negative, but {nearest(D[ends[0]]):.6g}: the spin is stable, or at the border."
    )


def on_loop(
    I: float, coupling: tuple[float, float], M3: float, loop: FloatArray, linear: float = 0.0, quadratic: float = 0.0
) -> Monodromy:
    """Return the `Monodromy` of periods carried round a ``loop`` (N, 2) of (p, g) at one M3, closed by its first point.

    ``I`` = I3/I2, ``coupling`` = (k2/I2, k3/I2), ``linear`` and ``quadratic`` over I2 as in `TopMotion`. Period and
    angles are balls, formed at each point from the theta functions; between neighbours the angles, less T times
    their mean rates at the first point, are continued to the nearest. Where a value belongs to two tori, that of
    the deeper well is carried. Raises DomainError for a value that no motion has, or that is critical, and for a
    loop so coarse that an angle changes by more than a quarter of a turn in one step: give it more points, or keep
    it from critical values. Raises NotCertifiedError where the balls are too wide.
    """
    wells = Wells.at(M3, I, coupling, linear, quadratic)
    integer(len(loop), "The number of points", 3)
    rows = []
    with workprec(PRECISION):
        for p, g in loop.tolist():
            top = TopMotion((1.0, I), coupling, *state(wells, p, g, I, coupling), linear, quadratic)
            if not top.kind.startswith(("nutation", "regular")):
                raise DomainError(f"At p = {p:g}, g = {g:g} the motion is a {top.kind}: a loop keeps off such values.")
            rows.append((top.period, top.precession_per_period, top.spin_per_period))
            if not all(x.is_finite() for x in rows[-1]):
                raise NotCertifiedError(f"not certified: the periods of the motion at p = {p:g}, g = {g:g}.")
        T, turn, step = [float(row[0]) for row in rows], 2 * arb.pi(), 0.0
        means = [
            arb((angle / rows[0][0]).mid()) for angle in rows[0][1:]
        ]  # T comes back, and what it takes off with it
        previous_times, turns = [arb(0), arb(0)], []
        for time, *angles in [*rows, rows[0]]:
            for i, (angle, mean) in enumerate(zip(angles, means, strict=True)):
                angle_in_turns = (angle - mean * time) / turn
                angle_in_turns -= round(float(angle_in_turns - previous_times[i]))
                step = max(step, float(abs(angle_in_turns - previous_times[i]).upper()))
                previous_times[i] = angle_in_turns
            turns.append([x + mean * time / turn for x, mean in zip(previous_times, means, strict=True)])
        if not step < 1 / 4:
            raise DomainError(
                f"An angle changes by {step:.3g} of a turn from one point of the loop to the next: give more points."
            )
        radius = max(float(x.rad()) for row in turns for x in row)
    closed = np.concatenate([loop, loop[:1]])
    return Monodromy(
        closed[:, 0], closed[:, 1], np.array([*T, T[0]]), np.array([[float(x) for x in row] for row in turns]),
        step, radius,
    )  # fmt: skip


def _depth(wells: Wells, p: float, end: int, D: float) -> FloatArray:
    """Return the energy of the spin at nu = ``end`` less the potential V, (N,), at the distances `GRID` of nu from it.

    In 1/time^2, for the momentum ``p``; ``D`` is that of the spin, see `Wells.spin`. No digits cancel near that pole.
    """
    d, offset = GRID, p - end * wells.M3
    level = -D / 2 - d * (wells.A + wells.M3 * wells.M3 / (2 * (2 - d)))
    return np.asarray(d * level - offset * (offset + 2 * end * wells.M3 * d) / (d * (2 - d)))


def _room(depth: FloatArray) -> float:
    """Return the depth of a well above its highest barrier, from ``depth`` (N,) of `_depth`.

    0 without a well, and where there are two.
    """
    ends = np.flatnonzero(np.diff(depth > 0, prepend=False, append=False))
    if len(ends) != 2:
        return 0.0
    well = depth[ends[0] : ends[1]]
    barriers = well[1:-1][(well[1:-1] < well[:-2]) & (well[1:-1] < well[2:])]
    return float(barriers.min() if barriers.size else well.max())


def state(wells: Wells, p: float, g: float, I: float, coupling: tuple[float, float]) -> tuple[Any, Any]:
    """Return (direction (n2, n3), angular velocity (3,) in rad/time) of a state with momentum p and energy g.

    Both are tuples, right up to rounding. The moments are those of the wells' top in units of I2, with I = I3/I2 and
    ``coupling`` (k2/I2, k3/I2). Raises DomainError where no motion has these values.
    """
    (k2, k3), end = coupling, int(np.sign(p * wells.M3) or 1)
    _, spin, D = wells.spin(end)
    depth = (_depth(wells, p, end, D) + (g - spin)) * GRID * (2 - GRID)
    best = int(np.argmax(depth))
    if not depth[best] > 0:
        raise DomainError(f"No motion has p = {p:g} and g = {g:g} at M3 = {wells.M3:g}.")
    r = end * (1 - float(GRID[best]))
    s = float(np.sqrt(GRID[best] * (2 - GRID[best])))
    omega = float(np.sqrt(depth[best])) / s, (p - wells.M3 * r) / s - k2 * s, (wells.M3 - k3 * r) / I
    return (s, r), omega


def around(
    wells: Wells, p: float, points: int = 48, end: int = 0, D: float | None = None, slope: float = 0.0
) -> FloatArray:
    """Return a loop (points, 2) of regular values (p, g), counter-clockwise, round that of the spin at nu = ``end``.

    The loop is an ellipse, sheared along the line dg = slope dp, half as wide and high as the critical energies of the
    well allow, below and to both sides; smaller where that ellipse leaves the well. ``p`` is the momentum of the spin,
    ``end`` is 1 if p is M3, else -1, and 0 to find it; ``D`` may be given where floats lose its digits.
    Raises DomainError where no loop fits: the value is not isolated, or floats do not tell it from its neighbours.
    """
    end = end or int(np.sign(p * wells.M3) or 1)
    _, g, rounded = wells.spin(end)
    D = rounded if D is None else D

    def room(dp: float, dg: float = 0.0) -> float:
        return _room(_depth(wells, p + dp, end, D) + slope * dp + dg)

    high = room(0.0)
    if not high > 0:
        raise DomainError(f"The value p = {p:g}, g = {g:g} at M3 = {wells.M3:g} is no isolated one: D is not negative.")
    widths = []
    for sense in (1, -1):
        inner, outer = 0.0, 1.0
        while room(sense * outer) > 0:
            inner, outer = outer, 2 * outer
        for _ in range(80):
            middle = (inner + outer) / 2
            inner, outer = (middle, outer) if room(sense * middle) > 0 else (inner, middle)
        widths.append(inner)
    wide = min(widths)
    if not (high > MIN_LOOP_SIZE * abs(g) and wide > MIN_LOOP_SIZE * abs(p)):
        raise DomainError(
            f"The spin, D = {D:.3g}, is too nearly stable for a loop round its value in doubles: choose another M3."
        )
    t = 2 * np.pi * (np.arange(points) + 0.5) / points
    for size in 2.0 ** -np.arange(1, MAX_ELLIPSES):
        x, y = size * wide * np.cos(t), size * high * np.sin(t)
        if all(room(dp, dg) > 0 for dp, dg in zip(x, y, strict=True)):
            break
    return np.stack([p + x, g + slope * x + y], axis=-1)
