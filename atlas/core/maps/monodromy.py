"""Monodromy of a symmetric top: what becomes of the periods on a loop round a focus-focus value, theorem-residue.

At regular values of (M3, p, g) the motion lies on a torus. Its periods are the lattice of all (s, t, u) for which the
turn by s about n, the turn by t about the body's axis and the motion for the time u, one after the other, bring the
top back. A basis is

    g1 = (2 pi, 0, 0),     g2 = (0, 2 pi, 0),     g3 = (-Delta psi, -Delta chi, T),

T the period of nutation and Delta psi, Delta chi the angles of precession and spin in it. g1 and g2 are the same
everywhere; g3 continued along a loop comes back as another vector of the lattice. Of a body with three moments two
pairs of times (T_H, T_F) of a torus are carried round the values of an isolated spin. Not in the paper.
"""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from flint import arb

from atlas.core.arithmetic.words import exact
from atlas.core.bodies.symmetric_top import inputs_of_top
from atlas.core.inputs import FloatArray, number, whole
from atlas.core.maps.bifurcation import Bifurcation
from atlas.core.maps.wells import Wells
from atlas.errors import DomainError, NotCertifiedError
from atlas.exact.motions.top import TopMotion
from atlas.exact.motions.torus import Torus
from atlas.formulas.numbers import workprec

PRECISION = 128
"""Binary digits of the balls of period and angles."""

NEWTON = 40
"""Steps to a state with given values."""

LEAST = 1e-280
"""Least square of a rate, beside which an energy keeps its digits."""


@dataclass(frozen=True, eq=False)
class Monodromy:
    """What became of the lattice of periods on one loop."""

    p: FloatArray
    g: FloatArray
    """The loop in the plane of p and g, arrays (N + 1,) whose last point is the first, at one M3."""
    period: FloatArray
    """T on it."""
    turns: FloatArray
    """Delta psi and Delta chi over 2 pi, continued along the loop, shape (N + 1, 2)."""
    step: float
    """The largest change of a turn between neighbours, below 1/2: what continuing from one to the next rests on."""
    radius: float
    """The largest radius of the balls of the turns."""

    @property
    def matrix(self) -> tuple[tuple[int, int, int], ...]:
        """Rows of the new g1, g2, g3 in the old."""
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
    """Carry the periods of a top once round an unstable spin, theorem-residue.

    The top is that of `TopMotion`: `inertia` (I2, I3), `coupling` (k2, k3), `linear` and `quadratic`. The loop has
    `points` points of momentum p along n and energy g, counter-clockwise, at one momentum `M3` along the axis; in its
    middle is the spin with the momentum `p`, M3 if left out, in units of inertia/time. The `matrix` of what is returned
    has as rows what became of g1 (one turn about n), g2 (one about the axis) and g3 (one nutation, less its turns):
    `monodromy((1.0, 0.5), 0.5, linear=1.0).matrix`. Angles are balls; that the integers are these rests on no angle
    changing by half a turn between neighbours, see `step`.

    Raises AtlasError for what are no numbers; DomainError for no body, a spin that is stable or no isolated value,
    rates out of the range of floats, and too few points; NotCertifiedError where the balls tell nothing.
    """
    top = inputs_of_top(inertia, coupling, (0.0, 1.0), linear, quadratic)
    unit, *rest = (number(x, "A parameter of the top") for x in (*top[:4], *top[6:], M3, M3 if p is None else p))
    I, *twist, weight, lean, along, middle = (x / unit for x in rest)
    wells = Wells.at(along, I, (twist[0], twist[1]), weight, lean)
    size = 4 * (abs(wells.A) + abs(wells.a)) + along * along
    if size and not LEAST < max(size, abs(middle)) < math.inf:
        raise DomainError("The rates of this top are too large or too small for floats: choose another unit of time.")
    whole(points, "The number of points", 3)
    loop = on_loop(I, (twist[0], twist[1]), along, around(wells, middle, points), weight, lean)
    return replace(loop, p=loop.p * unit, g=loop.g * unit)


def on_loop(
    I: float,
    coupling: tuple[float, float],
    M3: float,
    loop: FloatArray,
    linear: float = 0.0,
    quadratic: float = 0.0,
) -> Monodromy:
    """Carry the periods of a top round a `loop` (N, 2) of values (p, g) at one M3, closed by its first point.

    `I` = I3/I2, `coupling` = (k2/I2, k3/I2), `linear` and `quadratic` over I2 as in `TopMotion`. Period and angles are
    balls, formed at each point from the theta functions; between neighbours the angles are continued to the nearest.
    Raises DomainError for a value that no motion has, or that is critical, and for a loop so coarse that an angle
    changes by more than a quarter of a turn in one step: give it more points, or keep it from critical values.
    NotCertifiedError where the balls tell nothing.
    """
    wells = Wells.at(M3, I, coupling, linear, quadratic)
    whole(len(loop), "The number of points", 3)
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
        turns = [(rows[0][1] / turn, rows[0][2] / turn)]
        for _, *angles in [*rows[1:], rows[0]]:
            fresh = []
            for before, angle in zip(turns[-1], angles, strict=True):
                here = angle / turn
                here -= round(float(here - before))
                step = max(step, float(abs(here - before).upper()))
                fresh.append(here)
            turns.append((fresh[0], fresh[1]))
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


def state(wells: Wells, p: float, g: float, I: float, coupling: tuple[float, float]) -> tuple[Any, Any]:
    """Return a direction (n2, n3) and an angular velocity that have these values, as near as floats are."""
    k2, k3 = coupling
    nu = np.linspace(-1.0, 1.0, 2001)[1:-1]
    depth = (g - wells.potential(p, nu)) * (1 - nu) * (1 + nu)
    best = int(np.argmax(depth))
    if not depth[best] > 0:
        raise DomainError(f"No motion has p = {p:g} and g = {g:g} at M3 = {wells.M3:g}.")
    r = float(nu[best])
    s = float(np.sqrt((1 - r) * (1 + r)))
    omega = float(np.sqrt(depth[best])) / s, (p - wells.M3 * r) / s - k2 * s, (wells.M3 - k3 * r) / I
    return (s, r), omega


def around(wells: Wells, p: float, points: int = 48) -> FloatArray:
    """Return a loop (points, 2) of regular values (p, g), counter-clockwise, round the one at p and g = a + A.

    It is an ellipse with half the room that the least energies of all motions leave it, below and to both sides.
    Raises DomainError where there is no room, for then the value is no isolated one.
    """
    g = float(wells.energy(np.sign(p * wells.M3) or 1.0, 0.0))
    nu = np.linspace(-1.0, 1.0, 2001)[1:-1]

    def room(x: float) -> float:
        return g - float(np.min(wells.potential(x, nu)))

    if not room(p) > 0:
        raise DomainError(f"The value p = {p:g}, g = {g:g} at M3 = {wells.M3:g} is no isolated one: D is not negative.")
    widths = []
    for sense in (1, -1):
        near, far = 0.0, 1.0
        while room(p + sense * far) > 0:
            near, far = far, 2 * far
        for _ in range(40):
            middle = (near + far) / 2
            near, far = (middle, far) if room(p + sense * middle) > 0 else (near, middle)
        widths.append(near)
    t = 2 * np.pi * (np.arange(points) + 0.5) / points
    return np.stack([p + min(widths) / 2 * np.cos(t), g + room(p) / 2 * np.sin(t)], axis=-1)


def carried(bifurcation: Bifurcation, axis: int, loop: FloatArray) -> tuple[tuple[tuple[int, ...], ...], float]:
    """Carry two periods of the tori of a body round a `loop` (N, 2) of values (F, H), closed by its first point.

    The tori are those next to the spin about an `axis`, 0 to 2. Their periods, pairs of times (T_H, T_F), are proved in
    balls at each point and continued to the nearest basis. Returns the rows of the new basis in the old, and the
    largest distance of a continued basis from the next in units of that, which must be below 1/4. Raises DomainError
    for a coarser loop, NotCertifiedError where no periods are found.
    """
    state = np.zeros(6)
    state[[axis, axis + 3]] = bifurcation.c / bifurcation.b, bifurcation.b
    state += 0.1 * bifurcation.b * np.array([0.5, 0.8, -0.3, 1.0, 0.5, -0.1])
    bases: list[FloatArray] = []
    step = 0.0
    for F, H in [*loop.tolist(), loop[0].tolist()]:
        state = _with_values(bifurcation, state, np.array([H, F, bifurcation.b * bifurcation.b, bifurcation.c]))
        I, W, K = (exact(*x) for x in (bifurcation.inertia, state[:3] / bifurcation.inertia, state[3:]))
        torus = Torus(I, W, K)
        basis = np.array([[float(period.H), float(period.F)] for period in torus.periods(64)])
        if bases:
            part = bases[-1] @ np.linalg.inv(basis)
            step = max(step, float(np.abs(part - np.rint(part)).max()))
            basis = np.rint(part) @ basis
        bases.append(basis)
    if not step < 1 / 4:
        raise DomainError(f"A period changes by {step:.3g} of itself from one point of the loop to the next.")
    turned = np.rint(bases[-1] @ np.linalg.inv(bases[0])).astype(int).tolist()
    return tuple(tuple(row) for row in turned), step


def _with_values(bifurcation: Bifurcation, state: FloatArray, wanted: FloatArray) -> FloatArray:
    """Return (M, K) near a state with the values (H, F, K^2, (M, K)), by Newton's method to the nearest."""
    I, a = bifurcation.inertia, bifurcation.a
    for _ in range(NEWTON):
        M, K = state[:3], state[3:]
        values = np.array([(M @ (M / I) + K @ (I * K)) / 2, M @ M - K @ (a * K), K @ K, M @ K])
        slopes = np.array([[*(M / I), *(I * K)], [*(2 * M), *(-2 * a * K)], [0, 0, 0, *(2 * K)], [*K, *M]])
        state = state - np.linalg.lstsq(slopes, values - wanted)[0]
    return state
