"""A motion to measure: its exact parameters, its equations, its true values and its closed forms."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

FloatArray: TypeAlias = NDArray[np.float64]
Parameters: TypeAlias = Mapping[str, Any]


Solve: TypeAlias = Callable[[FloatArray], FloatArray]
"""Values at times (N,): (N, 3, 3) for a rotation, (N, 6) for position and velocity."""


@dataclass(frozen=True)
class Method:
    """A closed form: ``prepare`` does once all work independent of the times, with ``modules`` loaded before."""

    name: str
    prepare: Callable[[], Solve]
    modules: tuple[str, ...] = ()


@dataclass(frozen=True)
class Case:
    """A motion. Its parameters are floats and taken as exact.

    ``rates(state, parameters)`` are the equations of motion in any arithmetic that adds and multiplies: Python
    floats for SciPy, expressions for heyoka, power series of balls for the check of the reference. ``initial()`` is the
    state at t = 0 and ``exact(t)`` the value at t, certified numbers both; the values come first in the state.
    ``scale(values)`` is the size to which an error at each sample is compared.
    """

    name: str
    parameters: Parameters
    shape: tuple[int, ...]
    rates: Callable[[Sequence[Any], Parameters], list[Any]]
    initial: Callable[[], list[Any]]
    exact: Callable[[float], list[Any]]
    scale: Callable[[FloatArray], FloatArray]
    closed: tuple[Method, ...]
    base: Callable[[], Solve] | None = None
    """The reference of the times, if none of the closed forms is plain NumPy."""
    checked: int | None = None
    """At how many of the times values are compared with true ones, where these take long."""
    from_omega: bool = False
    """Whether the state is R and Omega in the body, so that a quaternion can stand in the place of R."""

    @property
    def size(self) -> int:
        """How many numbers a value has."""
        return int(np.prod(self.shape))

    def values(self, states: FloatArray) -> FloatArray:
        """Return the values in states (N, ...)."""
        return states[:, : self.size].reshape(-1, *self.shape)


class QuaternionCase(Case):
    """A case of a rotation whose state is a quaternion, the scalar first, and Omega: seven numbers, not twelve."""

    def values(self, states: FloatArray) -> FloatArray:
        """Return the matrices of states (N, 7)."""
        from scipy.spatial.transform import Rotation

        return np.asarray(Rotation.from_quat(states[:, :4], scalar_first=True).as_matrix())


def in_quaternions(case: Case) -> Case:
    """Return a case whose state is R and Omega with a quaternion in the place of R."""

    def rates(state: Sequence[Any], p: Parameters) -> list[Any]:
        w, x, y, z, a, b, c = state
        R = [
            w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),
            2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),
            2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z,
        ]  # fmt: skip
        turning = [-x * a - y * b - z * c, w * a + y * c - z * b, w * b + z * a - x * c, w * c + x * b - y * a]
        return [*(rate / 2 for rate in turning), *case.rates([*R, a, b, c], p)[9:]]

    same = {field.name: getattr(case, field.name) for field in fields(case)}
    return QuaternionCase(**same | {"initial": lambda: [1, 0, 0, 0, *case.initial()[9:]], "rates": rates})


def even(horizon: float, count: int) -> FloatArray:
    """Return ``count`` times from 0 up to, but without, ``horizon``; with a power of two no time is rounded."""
    return np.asarray(horizon / count * np.arange(count))


def rotation_case(make: Callable[[], Any], exact: Any, momentum: Sequence[Any], *others: Method, **facts: Any) -> Case:
    """Return the case of a rotation R(t): the motion that `make` makes, in balls `exact`, and other closed forms.

    The state is R, row by row, and after it ``momentum``, the other variables of the equations of motion, at t = 0.
    """

    def made() -> Any:
        """Make the motion with its first value, which much of it is made for."""
        motion = make()
        motion.rotation(1.0)
        return motion

    def ours_on_grid() -> Solve:
        motion = made()
        return lambda times: motion.rotation_grid(float(times[0]), float(times[1] - times[0]), len(times))

    return Case(
        shape=(3, 3),
        initial=lambda: [1, 0, 0, 0, 1, 0, 0, 0, 1, *momentum],
        exact=lambda t: [x for row in exact.rotation(t) for x in row],
        scale=lambda values: np.ones((len(values), 1, 1)),
        closed=(*others, Method("ours", lambda: made().rotation), Method("ours_grid", ours_on_grid)),
        **facts,
    )


def cross(a: Sequence[Any], b: Sequence[Any]) -> list[Any]:
    """Vector product [a, b] of triples of anything."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
