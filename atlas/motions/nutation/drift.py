"""Slow change of a symmetric body's motion, by averaging over its fast phases: an approximation, not certified.

A field whose strength changes by a part f of itself in a unit of time, and drag, a torque -I (d2, d2, d3) Omega, change
energy h, M3 and p = (M, n) slowly. Averaged over a nutation their rates are functions of these three alone,

    dh/dt = <N, Omega> - f <Omega, k b> + <dU/dt>,      dM3/dt = <N3>,      dp/dt = <N, b>,

N being the drag; the canonical momenta do not feel the field's change. Averages are means over the angle s between the
turning points, nu = (mid) - (half) cos s, in which the integrand is periodic: the midpoint rule has them to rounding.
So the averaged equations are stepped over thousands of turns at once. With e the rates of change beside those of the
motion, h, M3, p and the actions are right to the order of e for times of the order of 1/e, and so are the mean rates;
the phases, which add up over such a time, are right but for an angle of the order of one. (Averaging over one fast
phase: Arnold, Mathematical Methods of Classical Mechanics, section 52.) Near a separatrix it does not hold.
"""

from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.bodies.body import moments
from atlas.errors import AtlasError, DomainError
from atlas.motions.nutation.kernel_top import TopMotion

FIRST_NODES, MAX_NODES = 16, 4096
"""Points of the midpoint rule that are tried first, and most of them."""

TOLERANCE, SETTLED = 1e-9, 1e-12
"""Relative error of the steps, and of the averages."""

MIN_WIDTH, WITHIN_A_STEP = 1e-6, 1e-2
"""Width of a nutation below which a motion is steady, and relative energy that a steady motion may lack in a step."""


class Body(NamedTuple):
    """Moments I2, I3, coupling k2, k3 and potential `linear`, `quadratic` of a top, in the units of `TopMotion`.

    For a body in a field the coupling is |B'| (I2, I3), and the potential is zero.
    """

    I2: float
    I3: float
    k2: float
    k3: float
    linear: float
    quadratic: float


@dataclass(frozen=True)
class Drift:
    """Slow change of a motion at m times, as `atlas.drift` returns it; arrays have the shape (m,) unless noted.

    For a body given by its ratio I3/I2, energy, momenta and action are divided by I2.

    Attributes
    ----------
    t : ndarray
        Times.
    energy : ndarray
        Kinetic energy plus the potential of a top, in inertia/time^2.
    M3, p : ndarray
        Canonical momentum along the body's axis, and along the field (for a top along its direction), in inertia/time.
    action : ndarray
        Action of the nutation, in inertia/time.
    nutation, precession, spin : ndarray
        Mean rates, in rad/time.
    phases : ndarray, shape (m, 3)
        Total angles of nutation, precession and spin since t = 0, in rad.
    nu : ndarray, shape (m, 2)
        Least and largest cos theta, theta from the field to the body's axis.
    bodies : tuple of Body
        Moments, coupling and potential at each time.
    """

    t: FloatArray
    energy: FloatArray
    M3: FloatArray
    p: FloatArray
    action: FloatArray
    nutation: FloatArray
    precession: FloatArray
    spin: FloatArray
    phases: FloatArray
    nu: FloatArray
    bodies: tuple[Body, ...]

    def motion(self, i: int) -> TopMotion:
        """Motion with the constants of the time t[i].

        Parameters
        ----------
        i : int
            Index of the time.

        Returns
        -------
        TopMotion
            Motion that starts at the least cos theta with R(0) = 1. Its time 0 is not t[i], whose phases are left out.
        """
        b, nu = self.bodies[i], float(self.nu[i, 0])
        transverse = float(np.sqrt(max(1 - nu * nu, 0.0)))
        w2 = ((self.p[i] - self.M3[i] * nu) / transverse - b.k2 * transverse) / b.I2 if transverse else 0.0
        w3 = (self.M3[i] - b.k3 * nu) / b.I3
        return TopMotion((b.I2, b.I3), (b.k2, b.k3), (transverse, nu), (0.0, w2, w3), b.linear, b.quadratic)


def of_nutation(motion: Any, times: FloatArray, rates: list[float], drag: FloatArray) -> Drift:
    """Return the `Drift` of a symmetric body at ``times`` (m,), ascending from 0, see `atlas.drift`.

    ``motion`` is one motion. ``rates`` are the growth rates of field (1/time) and of the potential's linear and
    quadratic coefficients (inertia/time^3), ``drag`` an array of one rate, two or three, in 1/time. Raises
    DomainError where the averaged motion cannot be followed.
    """
    from scipy.integrate import solve_ivp

    body, state, nu = _start(motion)
    d2, d3 = _drag_of(motion, drag)

    def body_at(time: float) -> Body:
        growth = 1 + rates[0] * time
        return body._replace(
            k2=body.k2 * growth, k3=body.k3 * growth,
            linear=body.linear + rates[1] * time, quadratic=body.quadratic + rates[2] * time,
        )  # fmt: skip

    def slopes(time: float, y: FloatArray) -> FloatArray:
        nonlocal nu
        b, f = body_at(time), rates[0] / (1 + rates[0] * time)
        x = Averages(b, y[:3], nu, WITHIN_A_STEP)
        nu, third, axial = x.middle, x.Omega3, x.axial
        h = -d2 * b.I2 * x.mean(x.square) - d3 * b.I3 * x.mean(third**2)
        h -= f * x.mean(b.k2 * axial + b.k3 * third * x.nu)
        h += rates[1] * x.mean(x.nu) + rates[2] * x.mean(x.nu**2) / 2
        p = x.mean(-d2 * b.I2 * axial - d3 * b.I3 * third * x.nu)
        return np.array([h, -d3 * b.I3 * x.mean(third), p, *x.rates])

    start = np.array([*state, 0.0, 0.0, 0.0])
    if times[-1] > 0:
        solution = solve_ivp(
            slopes, (0.0, times[-1]), start, "DOP853", dense_output=True, rtol=TOLERANCE,
            atol=np.array([*(TOLERANCE * np.abs(state) + 1e-300), *[TOLERANCE] * 3]),
        )  # fmt: skip
        if not solution.success:
            raise DomainError(f"The averaged motion can't be followed further than t = {solution.t[-1]:.6g}.")
        rows = solution.sol(times).T
    else:
        rows = np.tile(start, (times.size, 1))
    nu, records, bodies = nu if times[-1] == 0 else _start(motion)[2], [], tuple(map(body_at, times.tolist()))
    for b, y in zip(bodies, rows, strict=True):
        x = Averages(b, y[:3], nu)
        nu = x.middle
        records.append([x.action, *x.rates, *x.ends])
    action, nutation, precession, spin, *ends = np.array(records).T
    h, M3, p = rows[:, :3].T
    return Drift(times, h, M3, p, action, nutation, precession, spin, rows[:, 3:], np.array(ends).T, bodies)


def _drag_of(motion: Any, drag: FloatArray) -> tuple[float, float]:
    """Return the drag (across the axis, along it) of a ``motion`` in 1/time, two floats.

    ``drag`` has one rate, two, or three along the principal axes. Raises AtlasError for two different rates across the
    axis.
    """
    order = _order(motion) if drag.shape == (3,) else [0, 0, 1]
    rates = np.broadcast_to(drag, (3,) if drag.shape == (3,) else (2,))[order]
    if rates[0] != rates[1]:
        raise AtlasError("The drag has different rates across the axis of a symmetric body: give (d2, d3).")
    return float(rates[0]), float(rates[2])


def _order(motion: Any) -> list[int]:
    """Return the indices 0, 1, 2 of a motion's principal axes in cyclic order, the axis of symmetry last.

    It is [0, 1, 2] for a ``motion`` without three moments.
    """
    inertia = tuple(getattr(motion, "inertia", ()))
    axis = next((i for i in (2, 0, 1) if inertia[i - 1] == inertia[i - 2]), 2) if len(inertia) == 3 else 2
    return [(axis + 1) % 3, (axis + 2) % 3, axis]


def _start(motion: Any) -> tuple[Body, FloatArray, float]:
    """Return (`Body`, array (energy, M3, p), nu = cos theta) of a motion at t = 0.

    Raises DomainError without a field, and where the axis is along it.
    """
    names = set(motion.arguments)
    order = _order(motion)
    Omega, b = motion.angular_velocity(0.0)[order], motion.field_in_body(0.0)[order]
    if "coupling" in names:
        (I2, I3), (k2, k3) = motion.inertia, motion.coupling
        body = Body(I2, I3, k2, k3, motion.linear, motion.quadratic)
    else:
        size = float(np.linalg.norm(b))
        if not size:
            raise DomainError("A body without a field has no direction: take a TopMotion with no coupling.")
        if "inertia" in names:
            I2, I3 = (motion.inertia[i] for i in order[1:])
        else:
            I2, I3 = 1.0, float(np.divide(*reversed(moments(motion.ratio))))
        body, b = Body(I2, I3, size * I2, size * I3, 0.0, 0.0), b / size
    if np.hypot(b[0], b[1]) < MIN_WIDTH:
        raise DomainError("The axis stands along the field, where a nutation has no phase to average over.")
    J, k, nu = np.array([body.I2, body.I2, body.I3]), np.array([body.k2, body.k2, body.k3]), float(b[2])
    h = (J * Omega * Omega).sum() / 2 + body.linear * nu + body.quadratic * nu * nu / 2
    M = J * Omega + k * b
    return body, np.array([h, M[2], M @ b]), nu


class Averages:
    """One nutation of a ``body`` with a given ``state`` (energy, M3, p), and its means over time.

    `nu` and `weights` are cos theta at the nodes of the midpoint rule and their weights in time, `ends` its least
    and largest value, `middle` the mean of these. `Omega3`, `axial` (Omega1 b1 + Omega2 b2) and `square` (Omega1^2
    + Omega2^2) are arrays at the nodes; `period`, `action` and `rates` (nutation, precession, spin, in rad/time)
    are floats. ``guess`` and ``deficit`` are those of `_turning_points`. Raises DomainError near a separatrix or a
    pole.
    """

    def __init__(self, body: Body, state: FloatArray, guess: float, deficit: float = MIN_WIDTH) -> None:
        self.body, self.state = body, state
        (I2, I3, k2, k3, a, A), (h, M3, p) = body, state
        # I2 nu'^2/(1 - nu^2) + ..., by powers of nu
        g = [
            k2 * k2 - I2 * (A + k3 * k3 / I3),
            2 * I2 * (M3 * k3 / I3 - a) - 2 * k2 * M3,
            2 * I2 * (h - M3 * M3 / (2 * I3)) + 2 * k2 * p - k2 * k2,
        ]
        Q = np.polysub(np.polymul([-1.0, 0.0, 1.0], g), [M3 * M3, -2 * p * M3, p * p]) / I2**2
        self.ends = _turning_points(Q, guess, deficit)
        low, high = self.ends
        self.middle, half = (low + high) / 2, (high - low) / 2
        cofactor = np.polydiv(Q, np.polymul([1.0, -low], [-1.0, high]))[0]
        count, before = FIRST_NODES, np.full(3, np.nan)
        scales = np.array([0.0, abs(k2 / I2) + abs(M3 / I2), abs(M3) + abs(p)])
        while True:
            s = (np.arange(count) + 0.5) * (np.pi / count)
            self.nu = self.middle - half * np.cos(s)
            root = np.sqrt(np.maximum(np.polyval(cofactor, self.nu), 0.0))
            with np.errstate(divide="ignore"):
                self.weights = 1 / root
            self.period = float(2 * np.pi * self.weights.mean())
            sine2 = 1 - self.nu * self.nu
            self.action = float(I2 * np.mean((half * np.sin(s)) ** 2 * root / sine2))
            turning = (p - M3 * self.nu) / (I2 * sine2) - k2 / I2
            means = np.array([self.period, self.mean(turning), self.action])
            if np.all(abs(means - before) <= SETTLED * (abs(means) + scales)):
                break
            count, before = 2 * count, means
            if count > MAX_NODES or not np.isfinite(self.period):
                raise DomainError(
                    "The motion comes to a separatrix or a pole, where averaging over its nutation fails."
                )
        self.Omega3 = (M3 - k3 * self.nu) / I3
        self.axial = (p - M3 * self.nu - k2 * sine2) / I2
        potential = a * self.nu + A * self.nu**2 / 2
        self.square = 2 / I2 * (h - potential - I3 * self.Omega3**2 / 2)
        self.rates = 2 * np.pi / self.period, float(means[1]), self.mean(self.Omega3 - self.nu * turning)

    def mean(self, values: FloatArray) -> float:
        """Return the mean over time of values (n,) at the nodes."""
        return float((values * self.weights).mean() / self.weights.mean())


def _turning_points(Q: FloatArray, guess: float, deficit: float) -> tuple[float, float]:
    """Return the roots (low, high) of Q in [-1, 1] that enclose ``guess``, or are nearest; equal for a steady motion.

    Q (n,) are polynomial coefficients in nu, the highest power first. Raises DomainError where the maxima of Q in
    (-1, 1) are negative by more than ``deficit`` of its largest coefficient.
    """
    roots = np.roots(Q)
    inside = np.sort(roots.real[(abs(roots.imag) < MIN_WIDTH) & (abs(roots.real) < 1 + MIN_WIDTH)].clip(-1.0, 1.0))
    pairs = [(float(x), float(y)) for x, y in pairwise(inside) if np.polyval(Q, (x + y) / 2) > 0 or y - x < MIN_WIDTH]
    if not pairs:  # a step may leave a steady motion less energy than the least
        extremes = np.roots(np.polyder(Q))
        tops = [
            x.real for x in extremes if abs(x.imag) < MIN_WIDTH and abs(x) < 1 and np.polyval(np.polyder(Q, 2), x) < 0
        ]
        if not tops or np.polyval(Q, tops).max() < -deficit * abs(Q).max():
            raise DomainError("There is no motion with these constants: the drift is too fast for averages.")
        top = float(min(tops, key=lambda x: abs(x - guess)))
        return top, top
    return min(pairs, key=lambda x: max(x[0] - guess, guess - x[1]))
