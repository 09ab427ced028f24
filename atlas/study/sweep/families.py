"""What can be swept: the parameters and quantities of each family of motions, by kernels and by balls."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.errors import AtlasError, DomainError

Row = Mapping[str, Any]
NAME = "U28"
"""Text in a table: the names of cases and kinds, none of which is longer."""


PERIODIC = ("period", "precession_per_period", "spin_per_period", "modulus", "nome")
"""Numbers of a general motion that belong to its nutation."""

MISSING = "missing"
"""Column that says why a quantity of a row has no value."""


@dataclass(frozen=True)
class Family:
    """A family: parameters needed, and others with the value that they have when left out (None: left out).

    `make` takes the parameters, arrays or numbers, and returns the kernels' objects; each quantity is got from these
    and the parameters. `exact` does the same with `atlas.exact` for certified digits, of the quantities in `certified`.
    So many motions as `at_once` are there at a time. `missing` says why a quantity may have no value in a row; its cell
    is empty there: NaN, or no text.
    """

    needed: tuple[str, ...]
    optional: Mapping[str, float | None]
    make: Callable[[Row], Any]
    quantities: Mapping[str, Callable[[Any, Row], Any]]
    exact: Callable[[Row], Any] | None = None
    certified: tuple[str, ...] = ()
    at_once: int = 50_000
    missing: Mapping[str, str] = field(default_factory=dict)

    def columns(self, parameters: Mapping[str, NDArray[Any]], names: Sequence[str]) -> dict[str, NDArray[Any]]:
        """Return the quantities of rows of parameters, arrays of floats or of text."""
        size = next(iter(parameters.values())).size
        found: dict[str, list[NDArray[Any]]] = {name: [] for name in names}
        for start in range(0, size, self.at_once):
            rows = {name: x[start : start + self.at_once] for name, x in parameters.items()}
            made, count = self.make(rows), min(self.at_once, size - start)
            for name, column in found.items():
                values = np.broadcast_to(self.quantities[name](made, rows), count)
                column.append(values.astype(NAME if values.dtype.kind == "U" else np.float64))
        return self._explained({name: np.concatenate(column) for name, column in found.items()})

    def digits(self, parameters: Mapping[str, NDArray[Any]], names: Sequence[str], digits: int) -> dict[str, Any]:
        """Return the quantities as text with certified digits, row by row."""
        from atlas.exact.digits import certified

        texts: dict[str, list[str]] = {name: [] for name in names}
        for values in zip(*(x.tolist() for x in parameters.values()), strict=True):
            row = dict(zip(parameters, values, strict=True))
            for name, text in certified(partial(self._balls, row, names), digits).items():
                texts[name].append(text)
        return self._explained({name: np.array(column, dtype=f"U{digits + 12}") for name, column in texts.items()})

    def _balls(self, row: Row, names: Sequence[str]) -> dict[str, Any]:
        made = self.exact(row) if self.exact else None
        return {name: self._ball(name, made, row) for name in names}

    def _ball(self, name: str, made: Any, row: Row) -> Any:
        """Return a quantity as a ball, or as text where it is infinite or has no value."""
        from flint import arb

        try:
            value = self.quantities[name](made, row)
        except DomainError:
            if name not in self.missing:
                raise
            return ""
        return "inf" if isinstance(value, arb) and value == arb("inf") else value

    def _explained(self, found: dict[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
        """Return the quantities, and beside those that may have no value a column that says why they have none."""
        lacking = [name for name in found if name in self.missing]
        if lacking:
            reasons = np.zeros(found[lacking[0]].shape, dtype=NAME)
            for reason in dict.fromkeys(self.missing.values()):
                gone = np.zeros(reasons.shape, dtype=bool)
                for name in lacking:
                    gone |= (self.missing[name] == reason) & empty(found[name])
                reasons[gone] = [f"{text}, {reason}" if text else reason for text in reasons[gone].tolist()]
            found[MISSING] = reasons
        return found

    def check(self, given: Sequence[str], names: Sequence[str], digits: int | None) -> None:
        """Raise AtlasError for parameters or quantities that the family does not have, or that are missing."""
        known = (*self.needed, *self.optional)
        lists = (
            ("parameter", [x for x in given if x not in known], known),
            ("quantity", [x for x in names if x not in self.quantities], self.quantities),
            (
                "quantity with certified digits",
                [x for x in names if digits and x not in self.certified],
                self.certified,
            ),
        )
        for what, wrong, there in lists:
            if wrong:
                raise AtlasError(f"There is no {what} {wrong[0]!r} here; there is {', '.join(there) or 'none'}.")
        missing = [name for name in self.needed if name not in given]
        if missing:
            raise AtlasError(f"The parameter {missing[0]} is missing; needed are {', '.join(self.needed)}.")
        if not names:
            raise AtlasError(f"Name at least one quantity: {', '.join(self.quantities)}.")


def empty(column: NDArray[Any]) -> NDArray[np.bool]:
    """Return where a column of a table has no value."""
    return np.asarray(column == "" if column.dtype.kind == "U" else np.isnan(column))


def _elementary(p: Row) -> Any:
    from atlas.core.elementary import ElementaryMotion

    return ElementaryMotion(p["ratio"], (p["B2"], p["B3"]), p["omega2"], p.get("omega3"))


def _exact_elementary(p: Row) -> Any:
    from atlas.exact.elementary import ElementaryMotion

    return ElementaryMotion(p["ratio"], (p["B2"], p["B3"]), p["omega2"], p.get("omega3"))


def _general(p: Row) -> Any:
    from atlas.core.general import GeneralMotion

    return GeneralMotion(p["ratio"], (p["B2"], p["B3"]), (p["omega1"], p["omega2"], p["omega3"]))


def _exact_general(p: Row) -> Any:
    from atlas.exact.general import GeneralMotion

    return GeneralMotion(p["ratio"], (p["B2"], p["B3"]), (p["omega1"], p["omega2"], p["omega3"]))


def _turning_point(i: int, made: Any, _: Row) -> Any:
    return made.turning_points[i]


def _stability(_: Any, p: Row) -> Any:
    return _hyperbola(p).stability(p["omega2"])


def _error(made: Any, p: Row) -> Any:
    from atlas.study.sweep.errors import error

    return error(made, p)


def _plain_error(made: Any, p: Row) -> Any:
    from atlas.study.sweep.errors import plain_error

    return plain_error(made, p)


def _hyperbola(p: Row) -> Any:
    from atlas.core.hyperbola import Hyperbola

    return Hyperbola(p["ratio"], (p["B2"], p["B3"]))


def _free(p: Row) -> Any:
    from atlas.core.elementary import FreeMotion

    return FreeMotion(p["ratio"], (p["omega1"], p["omega2"], p["omega3"]))


def _quadric(p: Row) -> Any:
    from atlas.core.quadric import Quadric

    return Quadric(p["ratio"], (p["B2"], p["B3"]))


def _exact_quadric(p: Row) -> Any:
    from atlas.exact.quadric import Quadric

    return Quadric(p["ratio"], (p["B2"], p["B3"]))


def _ball(p: Row) -> Any:
    from atlas.core.ball import BallMotion

    return BallMotion(p["inertia"], p["larmor"], (p["m2"], p["m3"]))


def _particle(p: Row) -> Any:
    from atlas.core.particle import ParticleMotion

    E, B, y, v = (np.stack([p[f"{letter}{i}"] for i in (1, 2, 3)], -1) for letter in "EByv")
    return ParticleMotion(p["mu"], E, B, y, v, p["c"])


def _of(name: str) -> Callable[[Any, Row], Any]:
    return lambda made, _: getattr(made, name)


def _entry(i: int, j: int, made: Any, p: Row) -> Any:
    return made.column(j, p["t"])[..., i - 1]


def _component(method: str, i: int, made: Any, p: Row) -> Any:
    return getattr(made, method)(p["t"])[..., i - 1]


def _semi_axis(i: int, made: Any, _: Row) -> Any:
    return np.asarray(made.semi_axes)[..., i - 1]


def _matrix() -> dict[str, Callable[[Any, Row], Any]]:
    """Return the entries of R at the time t."""
    return {f"R{i}{j}": partial(_entry, i, j) for i in (1, 2, 3) for j in (1, 2, 3)}


def _vector(letter: str, method: str) -> dict[str, Callable[[Any, Row], Any]]:
    """Return the components of a vector at the time t."""
    return {f"{letter}{i}": partial(_component, method, i) for i in (1, 2, 3)}


FAMILIES: Mapping[str, Family] = {
    "elementary": Family(
        ("ratio", "B2", "B3", "omega2"),
        {"omega3": None, "t": 0.0},
        _elementary,
        {name: _of(name) for name in ("case", "omega3", "k", "phi")}
        | {"stability": _stability, "error": _error, "plain_error": _plain_error}
        | _matrix()
        | _vector("Omega", "angular_velocity")
        | _vector("K", "field_in_body")
        | _vector("m", "angular_momentum"),
        _exact_elementary,
        ("omega3", "k", "phi"),
        missing=dict.fromkeys(("error", "plain_error"), "phase beyond 2^50"),
    ),
    "general": Family(
        ("ratio", "B2", "B3", "omega1", "omega2", "omega3"),
        {"t": 0.0},
        _general,
        {name: _of(name) for name in ("kind", *PERIODIC)}
        | {"least": partial(_turning_point, 0), "largest": partial(_turning_point, 1)}
        | _matrix()
        | _vector("Omega", "angular_velocity")
        | _vector("K", "field_in_body")
        | _vector("m", "angular_momentum"),
        _exact_general,
        (*PERIODIC, "least", "largest"),
        at_once=20_000,
        missing=dict.fromkeys(("precession_per_period", "spin_per_period"), "no period")
        | dict.fromkeys(("modulus", "nome"), "triple root"),
    ),
    "free": Family(
        ("ratio", "omega1", "omega2", "omega3"),
        {"t": 0.0},
        _free,
        {name: _of(name) for name in ("k", "phi")} | _matrix() | _vector("Omega", "angular_velocity"),
    ),
    "hyperbola": Family(("ratio", "B2", "B3"), {}, _hyperbola, {"least_stability": _of("least_stability")}),
    "quadric": Family(
        ("ratio", "B2", "B3"),
        {},
        _quadric,
        {name: _of(name) for name in ("kind", "beta", "a2", "a3")}
        | {f"C{i}": partial(_semi_axis, i) for i in (1, 2, 3)},
        _exact_quadric,
        ("beta", "a2", "a3"),
    ),
    "ball": Family(
        ("inertia", "larmor", "m2", "m3"),
        {"t": 0.0},
        _ball,
        {"gamma": _of("gamma"), "k2": lambda made, _: made.k_hat[0], "k3": lambda made, _: made.k_hat[1]}
        | _matrix()
        | _vector("m", "angular_momentum")
        | _vector("Omega", "angular_velocity"),
    ),
    "particle": Family(
        ("mu",),
        {"c": 1.0} | {f"{letter}{i}": 0.0 for letter in "EByv" for i in (1, 2, 3)} | {"t": 0.0},
        _particle,
        {name: _of(name) for name in ("case", "kind", "cyclotron_frequency", "radius")}
        | _vector("position", "position")
        | _vector("velocity", "velocity"),
    ),
}
