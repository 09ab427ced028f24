"""Slow change of the motion of a body with three moments, by averages over its torus: an approximation, not certified.

The state x = (M, K) moves on the torus of the integrals y = (H, F, c, K^2) with c = (M, K), those of a free body on a
curve of y = (H, F). Drag N = -(d_i I_i Omega_i) and a field that grows by a part g of itself in a unit of time change

    M by N and K by g K,    hence    dy/dt = the mean over the torus of (grad y, (N, g K)).

The torus is held as a grid of states, periodic in two angles. For other integrals each state goes to the new torus by
Newton's method, which keeps the grid smooth but moves the angles. The flows X_H and X_F commute and are tangent: hence

    dx/d angle_i = a_iH X_H + a_iF X_F,

by Fourier series, has the times a along both flows: det a is the density of the invariant measure, and the mean of a_i
over the angles, times 2 pi, the pair of times of the period i. Means by the trapezoidal rule converge exponentially.
The part of the times that is periodic is flowed back, so that the angles stay those of the motion, and the grid small.
Beyond a separatrix the states of one grid lie on no common torus, and Fourier series do not converge.
"""

from dataclasses import dataclass

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.motions.torus.kernel import AsymmetricMotion

FIRST_NODES, MAX_NODES = 16, 128
"""Nodes along an angle at first, and the most: a torus that needs more is next to a separatrix."""

COARSE, FINE = 1e-8, 1e-11
"""Relative change of means, from every second node to all, above which nodes are added, and below which taken out."""

ON_TORUS, NEAR_TORUS = 1e-12, 1e-6
"""Relative error of the integrals of a state of the grid, and of one that is flowed on."""

MAX_NEWTON, MAX_EVENING, UNEVEN = 12, 4, 1e-5
"""Steps of Newton's method and of the flows that even the angles, and relative spread of the density that is even."""

TOLERANCE, BRACKET = 1e-7, 1e-3
"""Relative error of the steps in time, and relative change of the integrals within which a torus is lost."""

FIRST_CHANGE = 0.05
"""Change of the integrals, in sizes of H, over the first step; SciPy's own is tiny, for the phases are fast."""

SMOOTH = 0.4
"""Waves per node that are kept in a grid."""


class LostTorusError(DomainError):
    """No smooth torus is found near a grid of states."""


@dataclass(frozen=True)
class AsymmetricDrift:
    """Slow change of a body with three moments at m times, as `atlas.drift` returns it; arrays (m,) unless noted.

    Attributes
    ----------
    t : ndarray
        Times.
    energy : ndarray
        Kinetic energy, in inertia/time^2.
    H, F : ndarray
        Integrals of `AsymmetricMotion`, in inertia/time^2 and inertia^2/time^2.
    p : ndarray
        Canonical momentum along the field; of a free body |m|, in inertia/time.
    action : ndarray, shape (m, 3)
        Actions of the angles, in inertia/time, as in `Motion.actions`; of a free body the second is 0.
    frequencies : ndarray, shape (m, 3)
        Mean rates f1, f2, f3, in rad/time; of a free body f2 = 0.
    phases : ndarray, shape (m, 3)
        Total angles of f1, f2 and f3 since t = 0, in rad.
    inertia : ndarray, shape (3,)
        Principal moments.
    momentum : ndarray, shape (m, 3)
        Canonical momentum M = I (Omega + K) of one state with these integrals, along the principal axes.
    field_in_body : ndarray, shape (m, 3)
        Field K of that state, in 1/time.
    """

    t: FloatArray
    energy: FloatArray
    H: FloatArray
    F: FloatArray
    p: FloatArray
    action: FloatArray
    frequencies: FloatArray
    phases: FloatArray
    inertia: FloatArray
    momentum: FloatArray
    field_in_body: FloatArray

    def motion(self, i: int) -> AsymmetricMotion:
        """Motion with the integrals of the time t[i], at some phases.

        Parameters
        ----------
        i : int
            Index of the time.

        Returns
        -------
        AsymmetricMotion
            Motion along the principal axes.
        """
        K = self.field_in_body[i]
        return AsymmetricMotion(self.inertia, K, self.momentum[i] / self.inertia - K)


class TorusGrid:
    """Grid of states (M, K) on the torus of one motion, (6, n1, n2); `follow` moves it to a torus of other integrals.

    It is made from the `motion` alone, an `AsymmetricMotion`, on whose torus it is at first, with FIRST_NODES along
    each angle. `states` is the grid, n2 = 1 for a free body. `integrals` (r,) are the motion's [H, F, c, K^2], c =
    (M, K), of a free body [H, F]; `follow` takes such an array, and leaves `integrals` as they are. `angles` (1 or
    2,) are the angles in rad about the field, or M, in each period; in a field they are 0 before the first
    `follow`. Times are in units of 1/`rate`, moments in units of `unit`: powers of two. Raises DomainError for a
    motion without a torus in closed form.
    """

    def __init__(self, motion: AsymmetricMotion) -> None:
        I, B, omega = (np.array(x, dtype=np.float64) for x in (motion.inertia, motion.field, motion.omega))
        self.rate, self.unit = (2.0 ** np.frexp(abs(x).max())[1] for x in (np.append(B, omega), I))
        self.I = (I / self.unit)[:, None, None]
        self.is_free, angle = not B.any(), 2 * np.pi * np.arange(FIRST_NODES) / FIRST_NODES
        if self.is_free:
            period = self.rate * float(motion.period)
            Omega = motion.angular_velocity(angle / (2 * np.pi) * motion.period)
            K, size = 0 * Omega, (FIRST_NODES, 1)
            self.angles = np.array([float(motion.precession_rate) / self.rate * period])
        else:
            try:
                wheels, size = motion._wheels(), (FIRST_NODES, FIRST_NODES)  # noqa: SLF001  of the same folder
            except DomainError:
                raise DomainError(
                    f"The motion has no torus in closed form to average over; it is {motion.agreement} Start beside it."
                ) from None
            phases = np.stack(np.meshgrid(angle, angle, indexing="ij")).reshape(2, -1)
            Omega, K = (wheels.at(name, phases) for name in ("angular_velocity", "field"))
            self.angles = np.zeros(2)
        Omega, K = (x.T.reshape(3, *size) / self.rate for x in (Omega, K))
        self.states: FloatArray = np.concatenate([self.I * (Omega + K), K])
        self.stored_states = self.states
        self.integrals = self._gradients(self.states)[1][:, 0, 0]

    def _gradients(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return (gradients of the r integrals at states x, (r, 6, n1, n2), their values (r, n1, n2)).

        The integrals are H and F, and in a field (M, K) and K^2.
        """
        (M, K), I = np.split(x, 2), self.I
        rows = [(M / I, I * K), (2 * M, -2 * I.prod() / I * K)]
        rows += [] if self.is_free else [(K, M), (0 * K, 2 * K)]
        gradients = np.array([np.concatenate(row) for row in rows])
        return gradients, (gradients * x).sum(1) / 2

    def _flows(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return (gradients of H and F, rates of states x (6, n1, n2) along their flows), each (2, 6, n1, n2).

        For a free body they are of H alone, (1, 6, n1, n2).
        """
        gradients = self._gradients(x)[0][: 1 if self.is_free else 2]
        M, K = np.split(x, 2)
        of_M, of_K = np.split(gradients, 2, axis=1)
        flows = [np.concatenate([_cross(M, u) + _cross(K, v), _cross(K, u)]) for u, v in zip(of_M, of_K, strict=True)]
        return gradients, np.array(flows)

    def _projected(self, y: FloatArray, x: FloatArray, tolerance: float) -> FloatArray:
        """Return states x (6, n1, n2) moved to the torus of the integrals y (r,), to a relative ``tolerance``.

        The method is Newton's. Raises LostTorusError where it does not converge.
        """
        size = abs(y[0]) * np.array([1.0, 2 * self.I.max(), 2.0, 1.0][: len(y)])
        size[2:] += y[3:] * [self.I.max(), 1.0][: len(y) - 2]
        for _ in range(MAX_NEWTON):
            gradients, values = self._gradients(x)
            residual = y[:, None, None] - values
            error = float((abs(residual).max((1, 2)) / size).max())
            if error <= tolerance:
                return x
            if not error < 1 / tolerance:
                break
            rows = np.moveaxis(gradients.reshape(*gradients.shape[:2], -1), -1, 0)
            columns = rows.swapaxes(1, 2)
            try:
                weights = np.linalg.solve(rows @ columns, residual.reshape(len(y), -1).T[..., None])
            except np.linalg.LinAlgError:
                break
            x = x + (columns @ weights)[..., 0].T.reshape(x.shape)
        raise LostTorusError("no torus")

    def _times(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return (flow times a per radian of each phase, (phases, flows, n1, n2); determinant of a, (n1, n2)).

        x (6, n1, n2) are the states. Raises LostTorusError where the flows are parallel.
        """
        flows = np.moveaxis(self._flows(x)[1], (0, 1), (-1, -2))
        slopes = np.fft.ifft2(1j * _waves(x)[: flows.shape[-1], None] * np.fft.fft2(x)).real
        try:
            right_side = flows.mT @ np.moveaxis(slopes, (0, 1), (-1, -2))
            a: FloatArray = np.asarray(np.linalg.solve(flows.mT @ flows, right_side), dtype=np.float64)
        except np.linalg.LinAlgError:
            raise LostTorusError("flows along each other") from None
        return np.moveaxis(a, (-1, -2), (0, 1)), np.linalg.det(a)

    def _evened(self, y: FloatArray, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return states on the torus y at equal steps of both phases, and their times as in `_times`.

        x (6, n1, n2) are states near that torus. Raises LostTorusError where the grid folds.
        """
        x = self._projected(y, x, NEAR_TORUS)
        a, density = self._times(x)
        for _ in range(MAX_EVENING):
            k = _waves(x)[: len(a)]
            late = np.einsum("dij,dfij->fij", k, np.fft.fft2(a)) / np.maximum((k * k).sum(0), 1)
            periodic = np.fft.ifft2(1j * late).real
            x = self._projected(y, _smoothed(self._flowed(x, periodic - periodic[:, :1, :1])), ON_TORUS)
            a, density = self._times(x)
            if np.ptp(density) <= UNEVEN * abs(density).max():
                break
        if not density.min() * density.max() > 0:
            raise LostTorusError("folded grid")
        return x, a

    def _flowed(self, x: FloatArray, times: FloatArray) -> FloatArray:
        """Return states x (6, n1, n2) moved along the flows by small times (flows, n1, n2), by one Runge-Kutta step."""

        def slope(x: FloatArray) -> FloatArray:
            return np.asarray((self._flows(x)[1] * times[:, None]).sum(0))

        k1 = slope(x)
        k2 = slope(x + k1 / 2)
        k3 = slope(x + k2 / 2)
        return x + (k1 + 2 * k2 + 2 * k3 + slope(x + k3)) / 6

    @staticmethod
    def _change_by_half(x: FloatArray, axis: int) -> float:
        """Return the largest relative change of the means of M_i^2, K_i^2 and M_i K_i if half the nodes are used.

        Every second node along ``axis``, 0 or 1, of the grid x is left out. The change is relative to the largest of
        the nine means.
        """
        products = np.concatenate([x * x, x[:3] * x[3:]])
        means, half_means = (y.mean((1, 2)) for y in (products, products[:, :, ::2] if axis else products[:, ::2]))
        return float(abs(half_means - means).max() / abs(means).max())

    def follow(self, y: FloatArray) -> None:
        """Move the grid to the torus of the integrals y (r,): from the last torus, or else from `stored_states`.

        Raises LostTorusError if both fail.
        """
        try:
            self._follow(y, self.states)
        except LostTorusError:
            self._follow(y, self.stored_states)

    def _follow(self, y: FloatArray, states: FloatArray) -> None:
        """Move the grid ``states`` to the torus of the integrals y (r,), and change its nodes until means converge.

        The results are stored in `states`, `x`, `a` and `angles`. Raises LostTorusError beyond `MAX_NODES`.
        """
        x, a = self._evened(y, states)
        while True:
            changes = np.array([self._change_by_half(x, axis) for axis in range(len(a))])
            if changes.max() <= COARSE:
                break
            for axis in np.flatnonzero(changes > COARSE).tolist():
                x = _doubled(x, axis + 1)
            if max(x.shape) > MAX_NODES:
                raise LostTorusError("long period")
            x, a = self._evened(y, x)
        self.x, self.a = x, a
        for axis in np.flatnonzero(changes < FINE).tolist():
            x = x[:, ::2] if axis == 0 else x[:, :, ::2]
        self.states, self.angles = x, self._turns()

    def change(self, growth: float, drag: FloatArray) -> FloatArray:
        """Return the mean rates of the integrals, (r,), in scaled units, for a growth rate of the field and a drag.

        Both are in units of `rate`; the drag (3,) has the rates along the principal axes.
        """
        M, K = np.split(self.x, 2)
        push = np.concatenate([-drag[:, None, None] * (M - self.I * K), growth * K])
        return np.asarray((self._gradients(self.x)[0] * push).sum(1).mean((1, 2)))

    def _turns(self) -> FloatArray:
        """Return the angle in rad of the body about the field in each period, (1 or 2,), nearest to the angles before.

        For a free body it is the angle about M, in the one period.
        """
        (M, K), turns = np.split(self.x, 2), []
        axis, spins = (M if self.is_free else K), self._flows(self.x)[0][:, :3]
        square = (axis * axis).sum(0)
        transverse = square - axis * axis  # off each principal axis, where Euler's angle of precession fails
        rates = ((axis * spins).sum(1)[:, None] - axis * spins) * np.sqrt(square) / transverse
        for i, (a, before) in enumerate(zip(self.a, self.angles, strict=True)):
            margin = transverse.min(1 + i)
            pole, line = np.unravel_index(margin.argmax(), margin.shape)
            turn = 2 * np.pi * np.take((a * rates[:, pole]).sum(0), line, 1 - i).mean()
            turns.append(turn - 2 * np.pi * np.round((turn - before) / (2 * np.pi)))
        return np.array(turns)

    def rates(self, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return (frequencies f1, f2, f3, actions), (3,) each, in scaled units, on the torus of the integrals y (r,).

        The torus is the one that `follow` went to. For a free body f2 and the second action are 0.
        """
        M, spins = self.x[:3], self._flows(self.x)[0][:, :3]
        periods = 2 * np.pi * self.a.mean((2, 3))
        line = np.linalg.inv(periods)[0]
        b, p = (0.0, np.sqrt(y[1])) if self.is_free else (np.sqrt(y[3]), y[2] / np.sqrt(y[3]))
        work = (self.a * (M * spins).sum(1)).sum(1).mean((1, 2)) - self.angles * p / (2 * np.pi)
        zeros = [0.0] * self.is_free
        return np.array([*(2 * np.pi * line), *zeros, self.angles @ line - b]), np.array([*work, *zeros, p])


def of_torus(motion: AsymmetricMotion, t: FloatArray, field: float, drag: FloatArray) -> AsymmetricDrift:
    """Return the `AsymmetricDrift` at times t (m,), see `atlas.drift`.

    ``field`` is its relative growth rate and ``drag`` (3,) the rates along the principal axes, all in 1/time. Raises
    DomainError at a separatrix, and where the motion has no torus to average over.
    """
    from scipy.integrate import DOP853

    torus = TorusGrid(motion)
    rate, unit, count = torus.rate, torus.unit, len(torus.integrals)
    start, end = np.append(torus.integrals, np.zeros(3)), float(t[-1] * rate)

    def slopes(time: float, y: FloatArray) -> FloatArray:
        try:
            torus.follow(y[:count])
        except LostTorusError:
            if (abs(y - reached)[:count] <= BRACKET * abs(reached[0])).all():
                raise DomainError(
                    f"The motion comes to a separatrix, or its torus to an end, at t = {time / rate:.4g}, where "
                    "averages fail: ask for earlier times."
                ) from None
            return np.full_like(y, np.nan)
        growth = field / rate / (1 + field / rate * time)
        return np.append(torus.change(growth, drag / rate), torus.rates(y[:count])[0])

    reached, records = start, []
    try:
        torus.follow(start[:count])
    except LostTorusError as fault:
        raise DomainError(
            f"The motion has no torus wide enough to average over ({fault}): it is at a separatrix, or has one "
            "nutation. Start beside it."
        ) from None
    spread = abs(torus.rates(start[:count])[0]).max() * end + 1.0
    least = TOLERANCE * np.array([abs(start[0])] * count + [spread] * 3)
    pace = abs(slopes(0.0, start)[:count]).max()
    first_step = float(min(end, FIRST_CHANGE * abs(start[0]) / pace)) if pace else end
    solver, dense = None, None
    if end:
        solver = DOP853(slopes, 0.0, start, end, rtol=TOLERANCE, atol=least, first_step=first_step)
    for time in (t * rate).tolist():
        while solver and solver.t < time:
            message, dense = solver.step(), None
            if solver.status == "failed":
                raise DomainError(
                    f"The averaged motion can't be followed further than t = {solver.t / rate:.6g}: {message}"
                )
            reached, torus.stored_states = solver.y, torus.states
        if solver and time:
            dense = dense or solver.dense_output()
        y = dense(time) if dense else start
        torus.follow(y[:count])
        records.append([*y, *np.concatenate(torus.rates(y[:count])), *torus.states[:, 0, 0]])
    rows = np.array(records)
    H, F, c = rows[:, 0], rows[:, 1], 0.0 if torus.is_free else rows[:, 2]
    phases, f, J, M, K = np.split(rows[:, count:], 5, axis=1)
    size = unit * rate
    return AsymmetricDrift(
        t, (H - c) * size * rate, H * size * rate, F * size**2, J[:, 2] * size, J * size, f * rate, phases,
        np.array(motion.inertia), M * size, K * rate,
    )  # fmt: skip


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the vector products [a, b] of vectors (3, ...), the components along the first axis."""
    return a[[1, 2, 0]] * b[[2, 0, 1]] - a[[2, 0, 1]] * b[[1, 2, 0]]


def _waves(x: FloatArray) -> FloatArray:
    """Return the wave numbers (integers) of a grid x (6, n1, n2) along both angles, (2, n1, n2).

    The Nyquist wave has 0.
    """
    numbers = [np.fft.fftfreq(n, 1 / n) * (abs(np.fft.fftfreq(n)) < 0.5) for n in x.shape[1:]]
    return np.array(np.meshgrid(*numbers, indexing="ij"))


def _smoothed(x: FloatArray) -> FloatArray:
    """Return a grid x (6, n1, n2) without waves shorter than the fraction `SMOOTH` of its nodes."""
    masks = [abs(np.fft.fftfreq(n)) <= SMOOTH for n in x.shape[1:]]
    return np.fft.ifft2(np.fft.fft2(x) * np.outer(*masks)).real


def _doubled(x: FloatArray, axis: int) -> FloatArray:
    """Return a grid x (6, n1, n2) with twice the nodes along ``axis``, 1 or 2, by Fourier interpolation."""
    from scipy.signal import resample

    return np.asarray(resample(x, 2 * x.shape[axis], axis=axis))
