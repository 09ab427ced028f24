"""The Euler–Poisson equations, (12) and (16), by one of SciPy's integrators: a peer of the closed forms."""

import warnings
from dataclasses import dataclass
from time import perf_counter
from typing import Any, Literal, TypeAlias, get_args

import numpy as np

from atlas.arithmetic.annotations import BodyLike, FieldLike, RealArrayLike
from atlas.arithmetic.dimensions import RATE, TIME
from atlas.arithmetic.inputs import FloatArray, positive, real, vector
from atlas.bodies.clebsch_integrals import Clebsch, body_tensor, clebsch
from atlas.bodies.inertia import mass_matrix
from atlas.errors import AtlasError, DomainError
from atlas.motions.euler_poisson import field_in_body, hat

SMALLEST_RTOL = 100 * float(np.finfo(float).eps)
Method: TypeAlias = Literal["DOP853", "RK45", "RK23", "Radau", "BDF", "LSODA"]
"""Integrators of `scipy.integrate.solve_ivp`."""


@dataclass(frozen=True, eq=False)
class Simulation:
    """Numerical solution of the equations of motion at N times, as `atlas.simulate` returns it.

    Attributes
    ----------
    t : ndarray, shape (N,)
        Times.
    R : ndarray, shape (N, 3, 3)
        Rotation matrices, with the body's axes in the laboratory as columns.
    Omega : ndarray, shape (N, 3)
        Angular velocity in the body, in rad/time.
    method : str
        Integrator of `scipy.integrate.solve_ivp`.
    rtol, atol : float
        Relative and absolute tolerance of the integrator.
    evaluations : int
        Number of evaluations of the right-hand side.
    seconds : float
        Wall-clock time of the integration.
    inertia : ndarray, shape (3, 3)
        Inertia tensor.
    field : ndarray, shape (3,)
        B' in the laboratory, in 1/time.
    omega : ndarray, shape (3,)
        Initial angular velocity in the body, in rad/time.
    """

    t: FloatArray
    R: FloatArray
    Omega: FloatArray
    method: str
    rtol: float
    atol: float
    evaluations: int
    seconds: float
    inertia: FloatArray
    field: FloatArray
    omega: FloatArray

    def integrals(self) -> Clebsch:
        """Conserved quantities of `atlas.clebsch` at every time, theorem-clebsch.

        Returns
        -------
        Clebsch
            Attributes are arrays (N,).
        """
        return clebsch(self.inertia, self.Omega, field_in_body(self.R, self.field))

    def drift(self) -> dict[str, float]:
        """Largest deviation of each conserved quantity from its initial value, relative to the size of its terms.

        Returns
        -------
        dict of str to float
            Keys "H", "F", "MK", "K2" and "energy".

        Notes
        -----
        The sizes at t = 0 are |M|^2/I1 + I3 K^2 for H, |M|^2 + I3^2 K^2 for F and |M| |K| for (M, K). Here I1 and I3
        are the least and the largest principal moment, and M is the canonical momentum. K^2 and the energy are relative
        to their initial values.
        """
        now, start = self.integrals(), clebsch(self.inertia, self.omega, self.field)
        I1, *_, I3 = np.linalg.eigvalsh(self.inertia)
        M, K = np.linalg.norm(self.inertia @ (self.omega + self.field)), np.linalg.norm(self.field)
        sizes = {
            "H": M * M / I1 + I3 * K * K,
            "F": M * M + I3 * I3 * K * K,
            "MK": M * K,
            "K2": start.K2,
            "energy": start.energy,
        }
        return {
            name: float(np.abs(getattr(now, name) - getattr(start, name)).max() / (size or 1.0))
            for name, size in sizes.items()
        }


def simulate(
    inertia: BodyLike,
    field: FieldLike,
    omega: RealArrayLike,
    times: RealArrayLike,
    *,
    method: Method = "DOP853",
    rtol: float = 1e-10,
    atol: float = 1e-12,
) -> Simulation:
    """Numerical solution of the Euler-Poisson equations (12), (16) from R = 1 at t = 0.

    Parameters
    ----------
    inertia : float or array_like or SymmetricBody
        Inertia tensor (3, 3) in laboratory axes, principal moments (3,), a body, or the ratio I = I3/I2.
    field : array_like, shape (2,) or (3,)
        B' or its components (B2, B3), in 1/time.
    omega : array_like, shape (3,)
        Initial angular velocity, in rad/time.
    times : array_like, shape (N,)
        Times sorted away from 0, all of one sign.
    method : str
        Integrator of `scipy.integrate.solve_ivp`.
    rtol, atol : float
        Tolerances of the integrator, for R and for Omega in units of the largest frequency.

    Returns
    -------
    Simulation
        `R` (N, 3, 3) in the laboratory and `Omega` (N, 3) in the body at the times `t`; `drift()` has the drift of the
        integrals.

    Raises
    ------
    DomainError
        For `rtol` below 100 machine epsilons, and for a tensor that no body has.
    AtlasError
        If the integrator fails (with its message), for another method, and for an input that is no number.

    Notes
    -----
    The result carries the integrator's error; R is not orthogonalised.

    Examples
    --------
    >>> atlas.simulate(1.5, (1.0, 2.0), (0.0, 0.7, 0.2), [0.0, 1.0]).R.shape
    (2, 3, 3)
    """
    from scipy.integrate import solve_ivp

    moments, B, start, t = body_tensor(inertia), _field(field), vector(omega, "omega", RATE), _times(times)
    tensor = moments / np.abs(moments).max()
    if method not in get_args(Method):
        raise AtlasError(f"The method must be one of {', '.join(get_args(Method))}, not {method!r}.")
    rtol, atol = positive(rtol, "rtol"), positive(atol, "atol")
    if rtol < SMALLEST_RTOL:
        raise DomainError(f"rtol must be at least {SMALLEST_RTOL:.3g}, 100 eps, not {rtol:g}: SciPy goes no lower.")
    # In units of the largest frequency, so that one atol serves R and Omega, whatever the unit of time.
    unit = float(max(np.abs(B).max(), np.abs(start).max())) or 1.0
    inverse, twice_mass, larmor = np.linalg.inv(tensor), 2 * mass_matrix(tensor), B / unit

    def rates(_: float, state: FloatArray) -> FloatArray:
        R, Omega = state[:9].reshape(3, 3), state[9:]
        turn = hat(Omega)
        torque = (tensor @ Omega - twice_mass @ (larmor @ R)) @ turn
        return np.concatenate([(R @ turn).ravel(), inverse @ torque])

    began = perf_counter()
    state = np.concatenate([np.eye(3).ravel(), start / unit])
    # The integrator wants its times distinct, and at least one away from the start.
    distinct, place = np.unique(np.abs(t) * unit, return_inverse=True)
    direction = -1.0 if t.min() < 0 else 1.0
    states, evaluations = state[None], 0
    if distinct[-1] > 0:
        with warnings.catch_warnings(record=True) as notes:
            warnings.simplefilter("always")
            solution = solve_ivp(
                rates, (0.0, direction * distinct[-1]), state, method, direction * distinct, rtol=rtol, atol=atol
            )
        if not solution.success or notes:
            words = "; ".join([str(solution.message), *(str(note.message) for note in notes)])
            raise AtlasError(f"{method} did not reach t = {t[-1]:g}: {words}")
        states, evaluations = solution.y.T, int(solution.nfev)
    R, Omega = states[place, :9].reshape(-1, 3, 3), states[place, 9:] * unit
    return Simulation(t, R, Omega, method, rtol, atol, evaluations, perf_counter() - began, moments, B, start)


def _field(field: Any) -> FloatArray:
    """Return B' (3,) from three components, or from (B2, B3) with B1 = 0. Raises AtlasError for another shape."""
    B = real(field, "The field", RATE)
    if B.shape not in {(2,), (3,)}:
        raise AtlasError(f"The field must be B' (3,) or (B2, B3), not of shape {B.shape}.")
    return B if B.shape == (3,) else np.array([0.0, *B])


def _times(times: Any) -> FloatArray:
    """Return the times as an array (N,). Raises AtlasError unless |t| ascends and all have one sign."""
    t = np.atleast_1d(real(times, "The times", TIME))
    if t.ndim != 1 or not t.size:
        raise AtlasError(f"The times must be one list, not of shape {t.shape}.")
    if (np.diff(np.abs(t)) < 0).any() or (t.min() < 0 < t.max()):
        raise AtlasError(
            "The times must be sorted away from t = 0, all on one side of it, since the integrator starts there."
        )
    return t


TOLERANCE = 1e-11


def flow(
    inertia: FloatArray, W: FloatArray, K: FloatArray, a: float, g: float, times: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return W and K along the flow of a H + g F/2 at times (N,), ascending from 0: two arrays (N, 3).

    `inertia` are the principal moments (3,); W = Omega + K is (3,) and K, the field in the body, (3,) at time 0; H
    is the Hamiltonian and F Clebsch's integral, see `clebsch`. The equations are integrated by DOP853 with
    tolerances of 1e-11.
    """
    from scipy.integrate import solve_ivp

    I, J, L = (float(x) for x in inertia)
    D = I * J * L
    turns = a + g * I, a + g * J, a + g * L
    pulls = a * I - g * D / I, a * J - g * D / J, a * L - g * D / L

    def rates(_: float, state: FloatArray) -> tuple[float, ...]:  # in plain numbers: arrays of three are slow
        w1, w2, w3, k1, k2, k3 = state.tolist()
        v1, v2, v3 = turns[0] * w1, turns[1] * w2, turns[2] * w3
        return (
            (J * w2 * v3 - L * w3 * v2 + (pulls[2] - pulls[1]) * k2 * k3) / I,
            (L * w3 * v1 - I * w1 * v3 + (pulls[0] - pulls[2]) * k3 * k1) / J,
            (I * w1 * v2 - J * w2 * v1 + (pulls[1] - pulls[0]) * k1 * k2) / L,
            k2 * v3 - k3 * v2,
            k3 * v1 - k1 * v3,
            k1 * v2 - k2 * v1,
        )

    solution = solve_ivp(
        rates, (0.0, float(times[-1])), np.concatenate([W, K]), "DOP853", times, rtol=TOLERANCE, atol=TOLERANCE
    )
    return solution.y[:3].T, solution.y[3:].T
