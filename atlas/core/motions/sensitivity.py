"""How a motion depends on its inputs: R(t) by the vector v, dR/dp = [v]x R, Omega, the field in the body, and scalars.

The inputs of a class are what its twin in balls is made of, with the field and the angular velocity in the body at
t = 0. What a user may ask for moves several of them: with R(0) = L C, C the axes of the class as rows in those of the
body, the field B of the laboratory is K = L^T B there, and turning the body at t = 0 by a turns it by -L^T [a, B]. All
else follows from v and dv/dt: dOmega/dp = R^T dv/dt, dK/dp = R^T (dB/dp - [v, B]).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from flint import arb, fmpq

from atlas.core.inputs import FloatArray, common_shape, real
from atlas.core.motions.clebsch_theta import ThetaKernel
from atlas.core.motions.clebsch_variations import TorusVaried
from atlas.core.nutation.variations import Varied
from atlas.core.quantities import TIME, bare
from atlas.errors import AtlasError, DomainError
from atlas.exact.motions.asymmetric import AsymmetricMotion
from atlas.exact.motions.elliptic import EllipticMotion
from atlas.exact.motions.general import GeneralMotion
from atlas.exact.motions.top import TopMotion
from atlas.exact.nutation.cayley_klein import steady
from atlas.exact.nutation.nutating import Nutating
from atlas.exact.nutation.variations import Constants, constants, variations
from atlas.formulas import ball, elementary
from atlas.formulas.numbers import direction, rational, workprec

VECTORS = ("rotation", "angular_velocity", "field")
"""What varies with time."""

NUTATION = ("period", "precession_per_period", "spin_per_period", "precession_rate", "spin_rate", "modulus", "nome")
"""Scalars of motions that nutate, and of the others."""


@dataclass(frozen=True)
class Inputs:
    """Exact inputs of one motion by name, their sizes, what makes its twin, and scalars of that.

    `form` is what the twin depends on besides; `parts` are moments, coupling, and the potential's linear and quadratic
    part, from which the angular acceleration follows; `field` is the field in the body at t = 0 with its derivatives in
    the inputs.
    """

    names: tuple[str, ...]
    values: tuple[fmpq, ...]
    scales: tuple[fmpq, ...]
    twin: Callable[..., Any]
    scalars: Mapping[str, Callable[[Any], Any]]
    parts: tuple[FloatArray, FloatArray, float, float]
    field: FloatArray
    fields: Mapping[str, FloatArray]

    def varied(self, names: Sequence[str]) -> Any:
        """Return what gives v and dv/dt for some of the inputs."""
        return Varied(variations(self._constants, self.values, self._places(names), self.scales))

    def of_scalar(self, name: str, names: Sequence[str]) -> FloatArray:
        """Return the derivatives of a scalar, (len(names),)."""

        def make(*x: fmpq) -> Constants:
            return Constants((), {name: [arb(self.scalars[name](self.twin(*x)))]})

        found = variations(make, self.values, self._places(names), self.scales)
        return np.array([float(x.slopes[name][0].mid()) for x in found])

    def _constants(self, *x: fmpq) -> Constants:
        twin = self.twin(*x)
        if isinstance(twin, Turns):
            return twin.constants()
        return constants(twin.tilt(), twin.solution, getattr(twin, "places", (0, 1, 2)))

    def _places(self, names: Sequence[str]) -> list[int]:
        return [self.names.index(x) for x in names]


class Turns(NamedTuple):
    """A motion R_n(k t) R_z(phi t), n along a vector."""

    along: Any
    k: Any
    phi: Any

    def constants(self) -> Constants:
        """Return its constants."""
        axis = self.along if len(self.along) == 3 else (fmpq(0), *self.along)
        n1, n2, n3 = (arb(y) for y in direction(axis))
        across = (n1 * n1 + n2 * n2).sqrt() if not axis[0] == axis[1] == 0 else arb(0)
        C, S = (n2 / across, n1 / across) if across != 0 else (arb(1), arb(0))
        longer = ((1 + abs(n3)) / 2).sqrt()
        shorter = across / (2 * longer)
        tilt = (longer, shorter, C, S) if axis[2] >= 0 else (shorter, longer, C, S)
        return constants(tilt, steady(tilt, self.k, self.phi, arb("inf")))


def _size(*rates: fmpq) -> fmpq:
    """Return the largest, 1 if all are zero."""
    return max((abs(x) for x in rates), default=fmpq(0)) or fmpq(1)


def _floats(values: Sequence[fmpq]) -> FloatArray:
    with workprec():
        return np.array([float(arb(x).mid()) for x in values])


def _nutation() -> dict[str, Callable[[Nutating], Any]]:
    """Return the scalars of a motion that nutates."""
    found: dict[str, Callable[[Nutating], Any]] = {
        name: lambda twin, name=name: getattr(twin, name)  # type: ignore[misc]
        for name in NUTATION
    }
    for name in ("precession", "spin"):
        found[f"{name}_rate"] = lambda twin, name=name: getattr(twin, f"{name}_per_period") / twin.period  # type: ignore[misc]
    return found


def _general(I: fmpq, K: Sequence[fmpq], omega: Sequence[fmpq]) -> Inputs:
    """Return the inputs of a body in a field: the ratio, and field and angular velocity in the body at t = 0."""
    size, J = _size(*K, *omega), np.array([1.0, 1.0, *_floats([I])])
    return Inputs(
        ("ratio", "K1", "K2", "K3", "omega1", "omega2", "omega3"), (I, *K, *omega), (I, *[size] * 6),
        lambda I, *x: GeneralMotion.at_state(I, x[3:], x[:3]),
        _nutation(), (J, J, 0.0, 0.0), _floats(K), _units(("K1", "K2", "K3")),
    )  # fmt: skip


def _units(names: Sequence[str]) -> dict[str, FloatArray]:
    """Return unit vectors by name."""
    return dict(zip(names, np.eye(3)[3 - len(names) :], strict=True))


def _top(row: Sequence[float]) -> Inputs:
    """Return the inputs of a top."""
    values = tuple(rational(float(x)) for x in row)
    I2, I3, k2, k3, n2, n3, w1, w2, w3 = values[:9]
    pull, push = (rational(float(np.sqrt(abs(x / row[0])))) for x in row[9:])
    w, n = _size(k2 / I2, k3 / I3, w1, w2, w3, pull, push), _size(n2, n3)
    unit = np.array([0.0, row[4], row[5]]) / np.hypot(row[4], row[5])
    across = np.outer(np.array([0.0, -unit[2], unit[1]]), [-unit[2], unit[1]]) / np.hypot(row[4], row[5])
    return Inputs(
        ("I2", "I3", "k2", "k3", "n2", "n3", "omega1", "omega2", "omega3", "linear", "quadratic"), values,
        (I2, I3, I2 * w, I2 * w, n, n, w, w, w, I2 * w * w, I2 * w * w),
        lambda *x: TopMotion(x[:2], x[2:4], x[4:6], x[6:9], *x[9:]), _nutation(),
        (np.array([row[0], row[0], row[1]]), np.array([row[2], row[2], row[3]]), row[9], row[10]),
        unit, {"n2": across[:, 0], "n3": across[:, 1]},
    )  # fmt: skip


def _elliptic(exact: EllipticMotion) -> Inputs:
    """Return the inputs of an elliptic motion."""
    size, (I1, I2, I3), J = _size(*exact.field), exact.inertia, _floats(exact.inertia)
    return Inputs(
        ("I1", "I2", "I3", "K1", "K2", "K3", "z"), (*exact.inertia, *exact.field, exact.z),
        (I1, I2, I3, size, size, size, _size(exact.z, I1 * I2)),
        lambda *x: EllipticMotion(x[:3], x[3:6], x[6], exact.branch),
        _nutation(), (J, J, 0.0, 0.0), _floats(exact.field), _units(("K1", "K2", "K3")),
    )  # fmt: skip


@dataclass(frozen=True)
class OnTorus(Inputs):
    """The inputs of a motion on a torus."""

    kernel: ThetaKernel
    exact: AsymmetricMotion
    known: dict[tuple[str, ...], TorusVaried]

    def varied(self, names: Sequence[str]) -> TorusVaried:
        """Return what gives v and R dOmega/dp for some of the inputs, kept for what is asked for next."""
        key = tuple(names)
        if key not in self.known:
            self.known[key] = TorusVaried(self.exact, self.kernel, self._places(names))
        return self.known[key]

    def of_scalar(self, name: str, names: Sequence[str]) -> FloatArray:
        """Return the derivatives of a frequency, (len(names),)."""
        return np.asarray(self.varied(names).of_frequencies[:, int(name[1]) - 1])


def _asymmetric(one: Any) -> Inputs:
    """Return the inputs of a body with three moments."""
    exact, kernel = one.exact, one.closed
    if not isinstance(kernel, ThetaKernel):
        raise DomainError(
            f"The motion has no theta functions whose constants could be differentiated: it is {exact.kind!r}."
        )
    size, J = _size(*exact.field, *exact.omega), _floats(exact.inertia)
    return OnTorus(
        ("I1", "I2", "I3", "K1", "K2", "K3", "omega1", "omega2", "omega3"),
        (*exact.inertia, *exact.field, *exact.omega), (*exact.inertia, *[size] * 6),
        AsymmetricMotion, {f"f{i}": lambda x, i=i: x.frequencies[i] for i in (1, 2, 3)},  # type: ignore[misc]
        (J, J, 0.0, 0.0), _floats(exact.field), _units(("K1", "K2", "K3")), kernel, exact, {},
    )  # fmt: skip


TURNS: dict[str, Callable[[Turns], Any]] = {
    "k": lambda x: x.k,
    "phi": lambda x: x.phi,
    "precession_rate": lambda x: x.k,
    "spin_rate": lambda x: x.phi,
    "period": lambda x: 2 * arb.pi() / abs(arb(x.k)),
}
BALL: dict[str, Callable[[Turns], Any]] = {
    "gamma": lambda x: x.k,
    "precession_rate": lambda x: -x.phi,
    "spin_rate": lambda x: -x.k,
}


def _elementary(case: str, row: Sequence[float], given: bool) -> Inputs:
    """Return the inputs of an elementary motion."""
    I2, I3, B2, B3, w2, w3 = (rational(float(x)) for x in row)
    size = _size(B2, B3, w2, w3)
    case, J = "precession" if case == "at rest" else case, np.array([1.0, 1.0, row[1] / row[0]])
    count = 5 if given else 4
    return Inputs(
        ("ratio", "B2", "B3", "omega2", "omega3")[:count],
        (I3 / I2, B2, B3, w2, w3)[:count], (I3 / I2, *[size] * 4)[:count],
        lambda *x: Turns(*elementary.turning(case, fmpq(1), *x, *[fmpq(0)] * (5 - count))),
        TURNS, (J, J, 0.0, 0.0), np.array([0.0, row[2], row[3]]), _units(("B2", "B3")),
    )  # fmt: skip


def _free(row: Sequence[float]) -> Inputs:
    """Return the inputs of a free body."""
    I2, I3, *omega = (rational(float(x)) for x in row)
    J = np.array([1.0, 1.0, row[1] / row[0]])
    return Inputs(
        ("ratio", "omega1", "omega2", "omega3"), (I3 / I2, *omega), (I3 / I2, *[_size(*omega)] * 3),
        lambda ratio, *w: Turns(*elementary.free(fmpq(1), ratio, *w)), TURNS, (J, J, 0.0, 0.0), np.zeros(3), {},
    )  # fmt: skip


def _ball(row: Sequence[float]) -> Inputs:
    """Return the inputs of a ball, in its field along e3."""
    inertia, larmor, *m = (rational(float(x)) for x in row)
    size, J = _size(larmor, *(x / inertia for x in m)), np.ones(3)
    return Inputs(
        ("inertia", "larmor", "m2", "m3"), (inertia, larmor, *m), (inertia, size, size * inertia, size * inertia),
        lambda *x: Turns(*ball.turning(*x)), BALL, (J, J, 0.0, 0.0), np.array([0.0, 0.0, row[1]]), _units(("larmor",)),
    )  # fmt: skip


class Moved(NamedTuple):
    """How a name moves the inputs: by weights, by a turn of the laboratory, and of the body about its third axis."""

    weights: Mapping[str, float]
    turn: FloatArray = np.zeros(3)
    spin: float = 0.0


def of(motion: Any, t: Any, names: Any, of: str) -> FloatArray:
    """Return derivatives of a motion, or of an array of them, see `Motion.sensitivity`."""
    names = [names] if isinstance(names, str) else list(names)
    if hasattr(motion, "winding"):
        raise DomainError(
            "A closed motion has p/q in the place of omega2: ask ElementaryMotion(ratio, field, omega2) for what "
            "depends on it."
        )
    known: dict[int, One] = vars(motion).setdefault("_differentiated", {})
    each = range(int(np.prod(motion.shape)))
    ones = (known.get(i) or known.setdefault(i, One(motion, i)) for i in each)
    if of not in VECTORS:
        return np.array([one.scalar(names, of) for one in ones]).reshape(*motion.shape, len(names))
    times = real(bare(t, "The time", TIME), "The time")
    full = common_shape(motion.shape, times.shape)
    out, times = np.empty((*full, len(names), 3)), np.broadcast_to(times, full)
    own = np.broadcast_to(np.arange(len(each)).reshape(motion.shape), full)
    for i, one in enumerate(ones):
        out[own == i] = one.vectors(times[own == i], names, of)
    return out


class One:
    """The i-th motion of an array, its inputs, and how names move them."""

    def __init__(self, motion: Any, i: int) -> None:
        self.motion, self.one = motion, motion._single(i)  # noqa: SLF001  of the same floor
        family, turned = motion.family, hasattr(motion, "own")
        self.sides = self.left, self.axes = self._sides(i) if turned else (np.eye(3), np.eye(3))
        row = [np.broadcast_to(x, motion.shape).flat[i] for x in getattr(motion, "_inputs", ())]
        if family == "general":
            exact = self.one.exact
            self.inputs = _general(exact.I, exact.field, exact.omega)
            if not turned:
                self.sides = self.left, _ = self.one.rotation(np.zeros(1))[0], self.axes
        elif turned and family in ("elementary", "free", "ball"):
            self.inputs = self._any_start(i, row)
        elif family == "asymmetric":
            self.inputs = _asymmetric(self.one)
        elif family in ("top", "elliptic"):
            self.inputs = _top([float(x) for x in row]) if family == "top" else _elliptic(self.one.exact)
        elif family == "elementary":
            self.inputs = _elementary(self.one.case, [0.0 if x is None else float(x) for x in row], row[5] is not None)
        else:
            self.inputs = (_free if family == "free" else _ball)([float(x) for x in row])
        self.moved, self._known = self._moved(turned), dict[tuple[str, ...], Any]()

    def _sides(self, i: int) -> tuple[FloatArray, FloatArray]:
        """Return L and C of a motion in given axes."""
        left, right = (np.eye(3) if x is None else x for x in self.motion._sides)  # noqa: SLF001
        shape = (*self.motion.shape, 3, 3)
        return tuple(np.broadcast_to(x, shape).reshape(-1, 3, 3)[i] for x in (left, right))

    def _any_start(self, i: int, row: Sequence[Any]) -> Inputs:
        """Return the inputs of a motion in elementary functions among all of its body."""
        shape, one = (*self.motion.shape, 3), self.motion.family == "ball"
        R, w = self.motion._start  # noqa: SLF001
        start = np.broadcast_to(R, (*shape, 3)).reshape(-1, 3, 3)[i]
        self.axes = np.eye(3) if one else self.axes
        self.left = start @ self.axes.T
        B, w = (np.broadcast_to(x, shape).reshape(-1, 3)[i] for x in (self.motion._given_field, w))  # noqa: SLF001
        ratio = fmpq(1) if one else rational(float(row[1])) / rational(float(row[0]))
        K, omega = ([rational(x) for x in v.tolist()] for v in (B @ self.left, self.axes @ w))
        return _general(ratio, K, omega)

    def _moved(self, turned: bool) -> dict[str, Moved]:
        """Return how each name that a user may ask for moves the inputs."""
        own, L, C = self.inputs.names, self.left, self.axes
        found = {x: Moved({x: 1.0}) for x in own if x[0] not in ("Kn" if turned else "K")}
        if "K1" in own or (turned and "n2" in own):
            K = [x for x, name in zip(self.inputs.values, own, strict=True) if name[0] in "Kn"]
            B = L @ _floats([fmpq(0)] * (3 - len(K)) + K)
            for j, e in enumerate(np.eye(3)):
                for name, turn, change in ((f"B{j + 1}", np.zeros(3), L[j]), (f"a{j + 1}", e, -L.T @ np.cross(e, B))):
                    found[name] = self._of_field(change, turn)
        if turned and "omega1" in own:
            found |= {f"omega{j + 1}": Moved({f"omega{k + 1}": C[k, j] for k in range(3)}) for j in range(3)}
        return found

    def _of_field(self, change: FloatArray, turn: FloatArray) -> Moved:
        """Return what a change of the field in the axes of the class at t = 0 moves, and a turn of the body."""
        if "K1" in self.inputs.names:
            return Moved({f"K{k + 1}": change[k] for k in range(3)}, turn)
        # a top's direction has no first component: its axes turn with that about the third
        n2, _, w1, w2 = _floats(self.inputs.values[4:8])
        spin = change[0] / n2 if n2 else np.nan if change[0] else 0.0
        weights = {"n2": change[1], "n3": change[2], "omega1": -spin * w2, "omega2": spin * w1}
        return Moved(weights, turn - spin * self.left[:, 2], spin)

    def _asked(self, names: Sequence[str]) -> list[str]:
        """Return the inputs that names move. Raises AtlasError for another name."""
        allowed = [*self.moved, "t"]
        for name in names:
            if name not in allowed:
                raise AtlasError(f"There is no input {name!r} of this motion: choose from {', '.join(allowed)}.")
            if name != "t" and np.isnan(self.moved[name].spin):
                raise DomainError(f"The top's axis is along n, where its inputs have no derivative in {name}.")
        return [x for x in self.inputs.names if any(x in self.moved[name].weights for name in names if name != "t")]

    def scalar(self, names: Sequence[str], of: str) -> FloatArray:
        """Return the derivatives of a scalar, (len(names),)."""
        if of not in self.inputs.scalars:
            raise AtlasError(
                f"A {self.motion.family} motion has no derivative of {of!r}: choose from "
                f"{', '.join((*VECTORS, *self.inputs.scalars))}."
            )
        needed = self._asked(names)
        found = dict(zip(needed, self.inputs.of_scalar(of, needed), strict=True)) if needed else {}
        return np.array([
            0.0 if name == "t" else sum(w * found[x] for x, w in self.moved[name].weights.items()) for name in names
        ])  # fmt: skip

    def vectors(self, t: FloatArray, names: Sequence[str], of: str) -> FloatArray:
        """Return derivatives at times (m,), (m, len(names), 3)."""
        needed, own = self._asked(names), self.one.rotation(t)
        R, Omega = self.sides[0] @ own @ self.sides[1], _omega(self.one, self.motion, t) @ self.sides[1]
        turning = np.matvec(R, Omega)
        faster, none = of == "angular_velocity", [np.empty((t.size, 0, 3))] * 2
        found, slopes = [*(self._varied(needed).vectors(t, faster) if needed else none), none[0]][:2]
        if self.motion.family == "ball" and "larmor" in self.inputs.names:  # the matrix is the transposed one
            if faster:
                slopes = -np.matvec(R[:, None], slopes + np.cross(Omega[:, None], found))
            found = -np.matvec(R[:, None], found)
        found, slopes, third = found @ self.left.T, slopes @ self.left.T, R @ self.axes[2]
        B = self.left @ self.inputs.field
        out = np.empty((t.size, len(names), 3))
        for j, name in enumerate(names):
            if name == "t":
                out[:, j] = turning if of == "rotation" else self._rate(of, R, Omega, B)
                continue
            weights, turn, spin = self.moved[name]
            moved = np.array([weights.get(x, 0.0) for x in needed])
            if faster:
                out[:, j] = np.vecmat(moved @ slopes + spin * np.cross(turning, third), R)
                continue
            out[:, j] = moved @ found + turn + spin * third
            if of == "field":
                change = moved @ np.array([self.inputs.fields.get(x, np.zeros(3)) for x in needed]).reshape(-1, 3)
                change = self.left @ change + np.cross(turn, B)
                out[:, j] = np.vecmat(change - np.cross(out[:, j], B), R)
        return out

    def _varied(self, names: Sequence[str]) -> Any:
        """Return the derivatives in some of the inputs, kept for the next times."""
        key = tuple(names)
        if key not in self._known:
            self._known[key] = self.inputs.varied(names)
        return self._known[key]

    def _rate(self, of: str, R: FloatArray, Omega: FloatArray, B: FloatArray) -> FloatArray:
        """Return dK/dt, or dOmega/dt: I dOmega/dt = [I Omega + k b, Omega] + [k Omega - U' e3, b] - k [b, Omega]."""
        J, k, linear, quadratic = self.inputs.parts
        w, b = Omega @ self.axes.T, (B @ R) @ self.axes.T
        if of == "field":
            return np.asarray(np.cross(b, w) @ self.axes)
        push = np.outer(linear + quadratic * b[:, 2], (0.0, 0.0, 1.0))
        change = np.cross(J * w + k * b, w) + np.cross(k * w - push, b) - k * np.cross(b, w)
        return np.asarray((change / J) @ self.axes)


def _omega(one: Any, motion: Any, t: FloatArray) -> FloatArray:
    """Return Omega(t) of one motion, (m, 3)."""
    if hasattr(one, "angular_velocity"):
        return np.asarray(one.angular_velocity(t))
    spin = one.turned if motion.family == "ball" else one.swung
    return np.asarray(spin(one.vector("Omega"), t, None))
