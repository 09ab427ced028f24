"""Numbers of the card against an integration of the equations of motion, from the words of the command on."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from atlas.book.card import card
from atlas.cli.your_body import request_of

SPEED_OF_LIGHT = 2.99792458e10
L = (0.3, 0.7, 0.2)


def cross(a: Any, b: Any) -> Any:
    """Return the vector product, faster than NumPy does for one."""
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def torque_free(moments: Any, Omega: Any, K: Any) -> Any:
    """Return I Omega' in a field."""
    W = Omega + K
    return cross(moments * W, W) - cross(moments * K, K) - moments * cross(K, Omega)


def axes_rate(y: Any) -> Any:
    """Return R' of a state, whose rows r have r' = r x Omega."""
    return np.concatenate([cross(row, y[:3]) for row in y[6:].reshape(3, 3)])


def integrated(
    I: Any, centre: Any, omega: Any, end: float, field: float = 0.0, weight: float = 0.0
) -> Mapping[str, float]:
    """Return mean rates of the axis about `centre`, a direction in the body at t = 0, and the period of its nodding.

    I W' = I W x W - I K x K with W = Omega + K, K = field centre; a weight has the torque weight centre x e3. The
    state is Omega, the centre in the body, and R, whose last column is the axis.
    """
    moments, c0 = np.array(I, float), np.array(centre, float) / np.linalg.norm(centre)

    def slope(_: float, y: Any) -> Any:
        Omega, K = y[:3], field * y[3:6]
        torque = weight * cross(y[3:6], (0.0, 0.0, 1.0))
        return np.concatenate([(torque + torque_free(moments, Omega, K)) / moments, cross(y[3:6], Omega), axes_rate(y)])

    def nodding(_: float, y: Any) -> float:
        return float(y[3] * y[1] - y[4] * y[0])

    nodding.direction = 1  # type: ignore[attr-defined]
    start = np.concatenate([np.array(omega, float), c0, np.eye(3).ravel()])
    solution = solve_ivp(slope, (0, end), start, "DOP853", rtol=1e-12, atol=1e-13, dense_output=True, events=nodding)
    times = solution.t_events[0]
    t_first, t_last = (times[0], times[-1]) if len(times) > 1 else (0.0, end)
    y = solution.sol(np.linspace(t_first, t_last, 40_001))
    axis, horizontal = y[[8, 11, 14]], cross(c0, (1.0, 0.0, 0.0))
    angle_about = np.unwrap(np.arctan2(cross(c0, horizontal) @ axis, horizontal @ axis))
    angle_own = np.unwrap(np.arctan2(y[3], y[4]))
    rate, spin = ((angle[-1] - angle[0]) / (t_last - t_first) for angle in (angle_about, angle_own))
    return {
        "turn": 2 * np.pi / abs(rate),
        "spin": spin,
        "nutation": (t_last - t_first) / max(len(times) - 1, 1),
    }


def in_field(I: float, K: Any, omega: Any = L, end: float = 60.0) -> Mapping[str, float]:
    """Return the numbers of a symmetric body, with its field as a rate and the angle between axis and field."""
    b = float(np.linalg.norm(K))
    tilt = float(np.arctan2(np.hypot(K[0], K[1]), K[2]))
    return {"ratio": I, "larmor": b, "tilt": tilt, **integrated((1, 1, I), K, omega, end, b)}


def of_asteroid(*start: Any) -> Mapping[str, float]:
    """Return the numbers of a free body, which nods twice while its angular velocity goes round once."""
    numbers = integrated(*start, 1000.0)
    return {**numbers, "nutation": 2 * numbers["nutation"]}


SHELL = 1 / (1 / 2 + 0.9**2 / 12)
GAUSS = -2e-2 / 1e-12 / 2 / SPEED_OF_LIGHT
W3 = 2 * 0.7 * (0.7 + 1.6) / (0.4 * 1.7)
CASES = {
    "--ratio 0.4 --field 1 2 --omega 0.3 0.7 0.2": lambda: in_field(0.4, (0, 1, 2)),
    "--shape cylindrical-shell --radius 1um --height 0.9um --mass 1.5e-15kg --charge 2e-15C --magnetic 0.8T "
    "--angle 30deg --spin 2Hz": lambda: in_field(
        SHELL, np.array([0, 0.5, 0.75**0.5]) * 2 / 1.5 * 0.4, (0, 0, 4 * np.pi)
    ),
    "--shape disk --radius 1e-6 --mass 1e-15 --charge -2e-15 --magnetic 0.75 1.3 --omega 0.3 0.7 0.2": lambda: in_field(
        2.0, (0, -0.75, -1.3)
    ),
    "--shape disk --radius 1e-4 --mass 1e-12 --charge -2e-2 --magnetic 750 1300 --units gaussian --omega 0.3 0.7 0.2": (
        lambda: in_field(2.0, np.array([0, 750, 1300]) * GAUSS, end=3.0)
    ),
    "--ratio 1 --field 1 2 --omega 0.3 0.7 0.2": lambda: in_field(1.0, (0, 1, 2)),
    "--ratio 1.001 --field 1 2 --omega 0.3 0.7 0.2": lambda: in_field(1.001, (0, 1, 2)),
    "--ratio 0.001 --field 1 2 --omega 0.3 0.7 2": lambda: in_field(0.001, (0, 1, 2), (0.3, 0.7, 2)),
    "--ratio 0.7 --field 2 0 --omega 0.3 0.7 0.2": lambda: in_field(0.7, (0, 2, 0)),
    "--ratio 0.7 --field 2 0.1 --omega 0.001 -1 0": lambda: in_field(0.7, (0, 2, 0.1), (0.001, -1, 0), 200.0),
    "--ratio 0.4 --field 1 2 --omega2 0.7": lambda: (
        in_field(0.4, (0, 1, 2), (0, 0.7, W3)) | {"nutation": in_field(0.4, (0, 1, 2), (1e-5, 0.7, W3))["nutation"]}
    ),
    "--ratio 1.5 --omega 0.3 0.7 0.2": lambda: (
        {**integrated((1, 1, 1.5), (0.3, 0.7, 0.3), L, 60.0)} | {"nutation": 2 * np.pi / 0.1}
    ),
    "top --inertia 1 0.5 --direction 0.6 0.8 --omega 0.1 0.2 5 --linear 3": lambda: integrated(
        (1, 1, 0.5), (0, 0.6, 0.8), (0.1, 0.2, 5), 30.0, weight=3.0
    ),
    "--inertia 1 3.0836 3.235 --omega 0.02 0 0.1": lambda: of_asteroid(
        (1, 3.0836, 3.235), (0.02, 0, 0.3235), (0.02, 0, 0.1)
    ),
    "--inertia 1 3.0836 3.235 --omega 0.2 0 0.01": lambda: of_asteroid(  # its long axis comes last
        (3.0836, 3.235, 1), (0, 0.03235, 0.2), (0, 0.01, 0.2)
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("words", CASES)
def test_numbers_of_a_card_agree_with_an_integration(words: str) -> None:
    """Long, short, disk, ball, rod, negative charge, SI, Gaussian, near a separatrix, on the curve, free, a top."""
    numbers = card(request_of(words.split())[0])
    for key, value in CASES[words]().items():
        assert numbers[key]["value"] == pytest.approx(value, rel=1e-8, abs=1e-9), key


@pytest.mark.slow
def test_frequencies_of_the_card_agree_with_the_motion() -> None:
    """B in the body is a sum of lines at m f1 + n f2, and the axis across B at f3 more; at other places it is not."""
    numbers = card(request_of("--inertia 1 1.5 2.2 --field 0.2 1 0.6 --omega 0.3 0.7 0.2".split())[0])
    f1, f2, f3 = (numbers[key]["value"] for key in ("f1", "f2", "f3"))
    I, K0 = np.array([1, 1.5, 2.2]), np.array([0.2, 1, 0.6])

    def slope(_: float, y: Any) -> Any:
        return np.concatenate([torque_free(I, y[:3], y[3:6]) / I, cross(y[3:6], y[:3]), axes_rate(y)])

    t = np.linspace(0, 150, 1001)
    start = np.concatenate([L, K0, np.eye(3).ravel()])
    y = solve_ivp(slope, (0, 150), start, "DOP853", t_eval=t, rtol=1e-10, atol=1e-11).y
    horizontal = cross(K0, (1.0, 0.0, 0.0))
    horizontal_other = cross(K0, horizontal) / np.linalg.norm(K0)
    axis = y[[8, 11, 14]]
    turning = axis.T @ horizontal + 1j * (axis.T @ horizontal_other)

    def missed(signal: Any, f1: float, f2: float, f3: float) -> float:
        orders = range(-6, 7)
        lines = np.exp(1j * np.outer(t, [f3 + m * f1 + n * f2 for m in orders for n in orders]))
        residual = signal - lines @ np.linalg.lstsq(lines, signal, rcond=None)[0]
        return float(np.linalg.norm(residual) / np.linalg.norm(signal))

    assert max(missed(y[5], f1, f2, 0.0), missed(turning, f1, f2, f3)) < 1e-3
    assert min(missed(y[5], f1, f2 * 1.01, 0.0), missed(turning, f1, f2, -f3)) > 0.05
