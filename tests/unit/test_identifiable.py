"""Which body a motion tells: the rank of the equations of motion in the moments and their products with the field."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from atlas.book.tables import compute
from atlas.book.tables.table import Request

ATTITUDES = 40
"""Attitudes of a motion at which the equations are set up."""


def rates(moments: np.ndarray, Omega: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Return dOmega/dt by (16)."""
    mass = moments.sum() / 2 - moments
    return np.asarray((np.cross(moments * Omega, Omega) - 2 * np.cross(mass * K, Omega)) / moments)


def states(moments: np.ndarray, field: np.ndarray, omega: np.ndarray) -> np.ndarray:
    """Return Omega and K, shape (6, ATTITUDES), along a motion, by a general integrator."""

    def flow(_t: float, state: np.ndarray) -> np.ndarray:
        return np.concatenate([rates(moments, state[:3], state[3:]), np.cross(state[3:], state[:3])])

    times = np.linspace(0, 12, ATTITUDES)
    solved = solve_ivp(flow, (0, 12), [*omega, *field], method="DOP853", rtol=1e-12, atol=1e-12, t_eval=times)
    return np.asarray(solved.y)


def rank(moments: np.ndarray, field: np.ndarray, omega: np.ndarray) -> int:
    """Return the rank of the equations in (x_i, y_i), each written out without the formula of the theorem."""
    rows = []
    for state in states(moments, field, omega).T:
        Omega, K = state[:3], state[3:]
        turn = rates(moments, Omega, K)
        columns = [
            *(axis * turn - np.cross(axis * Omega, Omega) for axis in np.eye(3)),
            *(np.cross((1 - 2 * axis) * K, Omega) for axis in np.eye(3)),
        ]
        rows.append(np.stack(columns, axis=-1))
    sizes = np.linalg.svd(np.concatenate(rows), compute_uv=False)
    return int((sizes > 1e-8 * sizes[0]).sum())


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_a_general_motion_determines_its_body_up_to_a_factor(seed: int) -> None:
    """The six unknowns are determined but for one factor, with three moments and with two equal ones."""
    chance = np.random.default_rng(seed)
    a1, second, third = chance.uniform(0.2, 1, 3)
    for moments in (np.array([second + third, a1 + third, a1 + second]), np.array([1.0, 1.0, 0.3 + a1])):
        assert rank(moments, chance.normal(size=3), chance.normal(size=3)) == 5


@pytest.mark.parametrize("moments", [(0.5, 1.0, 1.25), (1.0, 1.0, 0.6), (0.9, 0.9, 1.5)])
@pytest.mark.parametrize("z", [1.0, 0.3, -0.2])
def test_motions_of_the_family_leave_three_numbers_free(moments: tuple[float, float, float], z: float) -> None:
    """Elliptic motions, elementary ones among them, leave three numbers free."""
    inertia, field = np.array(moments), np.array([0.3, 0.75, 0.5])
    places = z + inertia.prod() / inertia
    E = -np.sqrt(places.prod()) / (inertia * places)
    assert rank(inertia, field, (E - 1) * field) == 3


def test_plane_motions_leave_three_numbers_free() -> None:
    """With M along an axis and K across it three numbers are free, too."""
    inertia, field = np.array([0.5, 1.0, 1.25]), np.array([0.6, 0.8, 0.0])
    assert rank(inertia, field, np.array([-0.6, -0.8, 0.9])) == 3


@pytest.mark.slow
def test_the_table_of_open_combinations_agrees_with_ranks_and_the_theorem() -> None:
    """A general motion leaves the common factor, and a fit nothing; one of the family three numbers, and a fit one."""
    field, omega = [0.3, 0.75, 0.5], [0.3, -0.5, 0.8]
    bodies = [[0.5, 1.0, 1.25], [1.0, 1.0, 0.6]]
    parameters = {"bodies": bodies, "field": field, "omega": omega, "z": 0.3}
    rows = compute("identified", Request((), parameters, 2)).rows
    counts = [(int(row[2].digits), int(row[4].digits)) for row in rows]
    assert counts == [(1, 0), (3, 1)] * 2
    assert [6 - rank(np.array(body), np.array(field), np.array(omega)) for body in bodies] == [1, 1]
