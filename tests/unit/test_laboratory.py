"""Bodies that could exist: their charge and radiation, against sums over point charges."""

from math import pi, sqrt
from typing import Any

import mpmath
import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.spatial.transform import Rotation

import atlas
from atlas import BallMotion, DomainError
from atlas.bodies import laboratory
from atlas.bodies.laboratory import demagnetization, demagnetization_difference
from atlas.bodies.units import ELECTRIC_CONSTANT, MAGNETIC_CONSTANT, SPEED_OF_LIGHT
from atlas.book.tables import compute
from atlas.book.tables.laboratory import Dipole
from atlas.book.tables.table import Data, Request
from atlas.errors import AtlasError

EPS = float(np.finfo(float).eps)


def derivative(values: np.ndarray, rate: float, order: int) -> np.ndarray:
    """Return a derivative of samples over one period 2 pi/rate along the first axis, by their harmonics."""
    n = np.fft.fftfreq(len(values), 1 / len(values)) * rate
    shape = (-1, *(1 for _ in values.shape[1:]))
    return np.fft.ifft(((1j * n) ** order).reshape(shape) * np.fft.fft(values, axis=0), axis=0).real


def test_the_charge_makes_the_field_and_the_mass_is_that_of_the_ball() -> None:
    """E = e/(4 pi eps0 r^2), and e/mu is 4/3 pi r^3 rho, within 8 eps."""
    r, rho, E = 3e-7, 2500.0, 1e9
    e, mu = laboratory.greatest_charge(r, E), laboratory.greatest_ratio(r, rho, E)
    assert abs(e / (4 * np.pi * ELECTRIC_CONSTANT * r**2) / E - 1) <= 8 * EPS
    assert abs(e / mu / (4 / 3 * np.pi * r**3 * rho) - 1) <= 8 * EPS
    with pytest.raises(DomainError, match="radius"):
        laboratory.greatest_charge(0.0, E)


def test_the_dipole_of_a_flying_charge_loses_energy_at_the_rate_of_larmor() -> None:
    """The second derivative of e x(t) on a circle, put into Larmor's formula, over m v^2/2: 1e-12 of it."""
    mu, mass, omega, radius = 2.0, 3.0, 5.0, 0.7
    t = np.arange(32) * 2 * np.pi / omega / 32
    dipole = mu * mass * radius * np.stack([np.cos(omega * t), np.sin(omega * t)], axis=1)
    power = (derivative(dipole, omega, 2) ** 2).sum(1).mean() / (6 * np.pi * ELECTRIC_CONSTANT * SPEED_OF_LIGHT**3)
    rate = laboratory.damping_of_flight(mu, mass, omega)
    assert abs(rate / (power / (mass * (radius * omega) ** 2 / 2)) - 1) <= 1e-12


def test_the_magnetic_moment_of_a_ball_radiates_by_its_precession() -> None:
    """The second derivative of mu m(t)/2 of the ball's motion (26) gives the power, 1e-12 of it."""
    mu, alpha = 3.0, 0.8
    ball = BallMotion(2.0, alpha, momentum=(1.3, -0.4))
    t = np.arange(32) * 2 * np.pi / alpha / 32
    second = derivative(mu / 2 * ball.angular_momentum(t), alpha, 2)
    power = (second**2).sum(1).mean() / (6 * np.pi * ELECTRIC_CONSTANT * SPEED_OF_LIGHT**5)
    assert abs(laboratory.magnetic_power(mu, 1.3, alpha) / power - 1) <= 1e-12


@pytest.mark.parametrize("angle", [0.3, 1.2, np.pi / 2])
def test_the_quadrupole_of_point_charges_radiates_as_the_formula_says(angle: float) -> None:
    """Six charges mu m_N on the axes of a body that goes round a cone: sum e(3 x x - x^2) gives the power, 1e-11."""
    mu, k, g1, g3 = 2.0, 0.9, 0.7, 1.9
    body = np.concatenate([np.eye(3), -np.eye(3)])
    masses = np.tile([g1 / 2, g1 / 2, g3 / 2], 2)
    c, s = np.cos(angle), np.sin(angle)
    tilt = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
    t = np.arange(64) * 2 * np.pi / k / 64
    turn = np.zeros((64, 3, 3))
    turn[:, 0, 0] = turn[:, 1, 1] = np.cos(k * t)
    turn[:, 1, 0], turn[:, 0, 1], turn[:, 2, 2] = np.sin(k * t), -np.sin(k * t), 1.0
    x = (turn @ tilt @ body.T).swapaxes(1, 2)
    e = mu * masses
    assert np.abs((e[:, None] * x).sum(1)).max() <= 8 * EPS  # no electric dipole
    D = 3 * np.einsum("n,tni,tnj->tij", e, x, x) - np.einsum("n,tni,tni->t", e, x, x)[:, None, None] * np.eye(3)
    third = derivative(D, k, 3)
    power = (third**2).sum((1, 2)).mean() / (720 * np.pi * ELECTRIC_CONSTANT * SPEED_OF_LIGHT**5)
    moments = (g1 + g3, 2 * g1)
    assert abs(laboratory.quadrupole_power(mu, moments, angle, k) / power - 1) <= 1e-11
    assert laboratory.quadrupole_power(mu, (1.0, 1.0), angle, k) == 0.0


@pytest.mark.parametrize("shape", ["ring", "disk", "cylindrical_shell", "thin_rod", "spherical_shell"])
def test_the_demagnetising_factors_are_means_over_the_wall(shape: str) -> None:
    """The mean of n n^T over a wall, of (1 - t t^T)/2 along a wire, has the trace 1; by a sum over points, 1e-12."""
    w = (np.arange(64) + 0.5) * 2 * np.pi / 64
    circle = np.stack([np.cos(w), np.sin(w), 0 * w], axis=1)
    u, weight = np.polynomial.legendre.leggauss(8)
    sphere = np.concatenate([np.c_[np.sqrt(1 - z * z) * circle[:, :2], np.full(64, z)] for z in u])
    axis, tangents = np.array([[0.0, 0.0, 1.0]]), np.cross([0.0, 0.0, 1.0], circle)
    walls = {"disk": axis, "cylindrical_shell": circle, "spherical_shell": sphere}
    wires = {"ring": tangents, "thin_rod": axis}
    weights = np.repeat(weight / 2, 64) / 64 if shape == "spherical_shell" else None
    if shape in walls:
        N = np.average(np.einsum("ni,nj->nij", walls[shape], walls[shape]), axis=0, weights=weights)
    else:
        N = np.mean((np.eye(3) - np.einsum("ni,nj->nij", wires[shape], wires[shape])) / 2, axis=0)
    assert abs(np.trace(N) - 1) <= 1e-12
    assert abs(N[0, 0] - N[2, 2] - laboratory.DEMAGNETIZATION[shape]) <= 1e-12


@pytest.mark.parametrize("N_along", [0.0, 0.1, 1 / 3, 0.4, 0.9, 1.0])
@pytest.mark.parametrize("gaussian", [False, True])
def test_a_susceptibility_is_taken_while_no_moment_is_infinite(N_along: float, gaussian: bool) -> None:
    """Down to -1/N, N the larger of both factors, over 4 pi in Gaussian units, and no factor outside 0 ... 1.

    The anisotropy is the difference of the two polarizabilities V chi/(1 + chi N).
    """
    scale = 4 * np.pi if gaussian else 1.0
    border, N_across = -1 / max(N_along, (1 - N_along) / 2) / scale, (1 - N_along) / 2
    chi, unit = border * (1 - 1e-6), 1.0 if gaussian else MAGNETIC_CONSTANT
    difference = laboratory.anisotropy(chi, 2.0, N_along, gaussian)
    chi_along, second = (2.0 * chi / (unit * (1 + scale * chi * n)) for n in (N_along, N_across))
    assert difference == pytest.approx(chi_along - second, rel=1e-9, abs=1e-9 * abs(chi_along))
    with pytest.raises(AtlasError, match="is not positive"):
        laboratory.anisotropy(border * (1 + 1e-6), 2.0, N_along, gaussian)
    for outside in (-1e-9, 1 + 1e-9):
        with pytest.raises(AtlasError, match=r"in 0 \.\.\. 1"):
            laboratory.anisotropy(chi, 2.0, outside, gaussian)


def test_the_energy_of_a_magnetised_body_is_that_of_its_moment() -> None:
    """-(m, B)/2 with m = chi V (1 - chi N) B/mu_0, along the field less across it: 1e-9, either sign of chi."""
    chi, V, B = -0.01, 3e-6, 2.0
    N = {"along": 0.0, "across": 0.5}  # a cylindrical surface
    energy = {name: -chi * V * (1 - chi * n) * B * B / (2 * MAGNETIC_CONSTANT) for name, n in N.items()}
    difference = laboratory.diamagnetic_energy(chi, V, B, "cylindrical_shell")
    assert abs(difference / (energy["along"] - energy["across"]) - 1) <= 1e-9
    assert difference == laboratory.diamagnetic_energy(-chi, V, B, "cylindrical_shell") < 0
    assert laboratory.diamagnetic_energy(chi, V, B, "sphere") == 0
    assert abs(MAGNETIC_CONSTANT * ELECTRIC_CONSTANT * SPEED_OF_LIGHT**2 - 1) <= 2e-10
    with pytest.raises(AtlasError, match="cylindrical_shell"):
        laboratory.diamagnetic_energy(chi, V, B, "cylindrical")


BALL = {"radius": 2.4e-6, "density": 1850.0, "dipole": 100.0, "field": 3e4, "inclination": 0.3}
DESIGN = {"aspect": 0.5, "density": 2500.0, "susceptibility": -1.2e-5, "surface_field": 1e9, "magnet": 10.0}


def table(name: str, **parameters: Any) -> Data:
    """Compute a table without a body."""
    return compute(name, Request((), parameters, 10))


def cells(data: Data) -> list[list[float]]:
    """Return the numbers of a table, zero for a dash."""
    return [[float(getattr(x, "digits", 0) or 0) for x in row] for row in data.rows]


def test_a_dipole_swings_as_a_pendulum_and_precesses_as_a_gyroscope() -> None:
    """Of small libration sqrt(dE/I)/2 pi, of which the inclination has twice; of fast spin dE/4 pi^2 I spin."""
    I = 0.4 * 1850 * 4 / 3 * pi * (2.4e-6) ** 5
    energy = 100e-6 * 1.602176634e-19 * 3e4
    small, fast = cells(table("levitated", **(BALL | {"spins": [0.0, 1e5], "inclination": 0.01})))
    assert small[1] == pytest.approx(2 * sqrt(energy / I) / (2 * pi), rel=2e-3)
    assert small[1] == pytest.approx(2 * small[2], rel=2e-3)
    assert fast[3] == pytest.approx(-energy / (4 * pi**2 * I * 1e5), rel=5e-3)
    assert fast[4] == pytest.approx(fast[3], rel=5e-3)


@pytest.mark.slow
@pytest.mark.parametrize("spin", [0.0, 500.0])
def test_lines_say_how_far_a_component_swings(spin: float) -> None:
    """Fourier integrals of one component along the field, and of that across it that each line moves most: 1 %."""
    from scipy.signal.windows import blackmanharris  # loads slowly, and only this test needs it

    motion, rows = Dipole(**BALL, spins=()).motion(spin), cells(table("lines", **BALL, spins=[spin], least=3e-3))
    t = np.arange(1 << 14) * 60 / (1 << 14) * motion.period
    window, axis, n = blackmanharris(t.size), motion.column(3, t), np.array([0.0, *motion.direction])
    components = np.stack([axis[:, 0], axis @ np.cross(n, [1.0, 0.0, 0.0])], 1)
    for _, f, _, swing, component_along in rows:
        kernel = (1 + (f > 0)) * window / window.sum() * np.exp(-2j * pi * f * t)
        sides = [abs(kernel @ components @ [np.cos(w), np.sin(w)]) for w in np.linspace(0, pi, 180)]
        amplitudes = max(sides), abs(kernel @ (axis @ n))
        assert (swing, component_along) == pytest.approx(amplitudes, rel=1e-2, abs=2e-4)


def test_tables_of_the_levitated_ball_have_one_precession() -> None:
    """The rate of the first table is a line of the second, without a spin too; its sign is that of a fast spin."""
    for spin in (0.0, 500.0):
        ((_, _, _, rate, slow),) = cells(table("levitated", **BALL, spins=[spin]))
        frequencies = [f for _, f, _, amplitude, _ in cells(table("lines", **BALL, spins=[spin])) if amplitude > 0.1]
        assert frequencies == [abs(rate)]
        assert rate * slow > 0 or spin == 0


@pytest.mark.slow
@pytest.mark.parametrize("spin", [0.0, 500.0])
def test_deviations_agree_with_a_fit(spin: float) -> None:
    """A fit to noisy looks has the errors of the table, by differences of motions; it tells I3 where the table does."""
    data = table("inferred", **BALL, spins=[spin], samples=400, seconds=0.05, noise=0.01)
    expected = [getattr(row[1], "digits", "") for row in data.rows]
    motion = Dipole(**BALL, spins=()).motion(spin)
    rng, tilt = np.random.default_rng(1), Rotation.from_rotvec([0.3, 0.0, 0.0]).as_matrix()  # the field is along e3
    t = np.sort(rng.uniform(0, 0.05, 400))
    axis = motion.column(3, t) @ tilt.T + rng.normal(0, 0.01, (400, 3))
    values_fixed = dict.fromkeys(["k2", "k3", "quadratic"], 0.0) | {"I3": 1.0}
    params = {name: {"value": value, "vary": False} for name, value in values_fixed.items()}
    torque, omega3 = motion.linear / motion.inertia[0], 2 * pi * spin
    start = dict.fromkeys(["n1", "n2", "omega1", "omega2", "a2"], 0.0)
    start |= {"linear": torque, "omega3": omega3, "a1": 0.3}
    params |= {name: {"value": value, "vary": True} for name, value in start.items()}
    fit = atlas.fit(t, "top", axis=axis, sigma=0.01, params=params)
    errors = {name: p.stderr for name, p in fit.params.items()}
    indices = [fit.names.index(name) for name in ("a1", "n2")]  # the axis is at (0, -sin a1, cos a1), n at (0, n2, 1)
    inclination = np.sqrt(fit.covariance[np.ix_(indices, indices)].sum())
    assert [errors["linear"] / abs(torque), inclination, errors["omega3"] / (2 * pi)] == pytest.approx(
        [float(expected[i]) for i in (0, 1, 4)], rel=0.12
    )
    fit_free = atlas.fit(t, "top", axis=axis, sigma=0.01, params=params | {"I3": {"value": 1.0, "vary": True}})
    assert (fit_free.params["I3"].stderr is None) == (expected[2] == "")


def test_the_precession_beyond_larmors_turn_agrees_with_the_general_motion() -> None:
    """By the charge alone; without a susceptibility there is no other, and the charge makes all of it."""
    parameters = {"radii": [1e-6], "spin": 3.0, "inclination": 0.7}
    ((_, larmor, precession, *_),) = cells(table("beyond_larmor", **DESIGN, **parameters))
    body = atlas.SymmetricBody.spheroid(mass=1.0, equatorial=1.0, polar=0.5)
    B = np.sin(0.7), np.cos(0.7)
    motion = atlas.GeneralMotion(body, B, (0.0, -B[0], 3 - B[1]))
    assert precession / larmor == pytest.approx(motion.precession_rate + 1, rel=5e-3)
    ((_, _, one, none, two, changed, quotient, *_),) = cells(
        table("beyond_larmor", **(DESIGN | {"susceptibility": 0.0}), **parameters)
    )
    assert one == two == precession == changed
    assert none == quotient == 0


@pytest.mark.slow
def test_the_charge_changes_less_than_its_own_precession() -> None:
    """Rates do not add: one of two tops in Larmor's frame less the other, by steps of Runge and Kutta, 2 % of it.

    The potentials A nu^2/2 and (A + A_own) nu^2/2 act on one momentum; A is scaled down until a step can follow.
    """
    parameters = {"radii": [1e-6], "spin": 3.0, "inclination": 0.7}
    design = DESIGN | {"susceptibility": -1.2e-6}
    ((_, larmor, precession, induced, precession_both, changed, quotient, _, pressure),) = cells(
        table("beyond_larmor", **design, **parameters)
    )
    assert changed < precession / 2
    assert precession_both > induced > precession
    I = atlas.SymmetricBody.spheroid(mass=1.0, equatorial=1.0, polar=0.5).ratio
    rates = [integrated_precession(3 * I, 0.7, (I - 1) * x) for x in (1.0, quotient, quotient + 1)]
    expected = rates[0], rates[1], rates[2], rates[2] - rates[1]
    assert np.array([precession, induced, precession_both, changed]) / larmor == pytest.approx(expected, rel=2e-2)
    ((*_, least),) = cells(table("beyond_larmor", **(design | {"susceptibility": 0.0}), **parameters))
    assert pressure / least == pytest.approx(changed / precession, rel=1e-2)


def integrated_precession(M3: float, inclination: float, A: float) -> float:
    """Return the mean rate psi' = (p - M3 nu)/(1 - nu^2) of a top that starts with its spin alone, by an integrator."""
    p = M3 * np.cos(inclination)

    def rates(_: float, y: Any) -> list[float]:
        nu, slope, _ = y
        potential = (p - M3 * nu) / (1 - nu * nu)
        force = -A * nu + M3 * potential - nu * potential**2
        return [slope, (1 - nu * nu) * force - nu * slope**2 / (1 - nu * nu), potential]

    def bottom(_: float, y: Any) -> float:
        return float(y[1])

    end = solve_ivp(rates, (0, 200), [np.cos(inclination), 0, 0], rtol=1e-11, atol=1e-12, events=bottom)
    times, states = end.t_events[0], end.y_events[0]
    whole = 2 * ((len(times) - 1) // 2)
    return float((states[whole, 2] - states[0, 2]) / (times[whole] - times[0]))


@pytest.mark.parametrize("aspect", [0.3, 1.0, 2.5])
def test_demagnetizing_factors_are_their_integral(aspect: float) -> None:
    """N = (a^2 c/2) times the integral of ds/[(s + c^2)^(3/2) (s + a^2)], Osborn's."""
    integral, _ = quad(lambda s: (s + aspect**2) ** -1.5 / (s + 1), 0, np.inf)
    assert demagnetization(aspect) == pytest.approx(aspect / 2 * integral, rel=1e-8)


@pytest.mark.parametrize("aspect", [0.2, 0.94, 1 - 1e-5, 1 + 1e-9, 1.0000001, 1.06, 40.0])
def test_difference_of_demagnetizing_factors_keeps_its_digits(aspect: float) -> None:
    """N2 - N3 is (1 - 3 N3)/2 of the closed form in 60 digits, also where all but the last of a double's cancel."""
    with mpmath.workdps(60):
        a = mpmath.mpf(aspect)
        e = mpmath.sqrt(1 - 1 / a**2)  # imaginary of an oblate one
        N3 = (1 - e**2) / e**3 * (mpmath.atanh(e) - e)
        assert demagnetization_difference(aspect) == pytest.approx(float(mpmath.re(1 - 3 * N3) / 2), rel=1e-13)
