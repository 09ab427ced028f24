"""How a motion depends on its inputs: R(t) by the vector v, dR/dp = [v]x R, Omega, the field in the body, and scalars.

The inputs of a class are those of its twin in balls, with the field and the angular velocity in the body at
t = 0. A parameter of a user moves several of them: with R(0) = L C, C the axes of the class as rows in those of the
body, the field B of the laboratory is K = L^T B there, and turning the body at t = 0 by a turns it by -L^T [a, B]. All
else follows from v and dv/dt: dOmega/dp = R^T dv/dt, dK/dp = R^T (dB/dp - [v, B]).
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from flint import fmpq

from atlas.arithmetic.dimensions import TIME, bare
from atlas.arithmetic.inputs import FloatArray, common_shape, finite, real
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import nearest
from atlas.arithmetic.words import floats
from atlas.errors import AtlasError, DomainError

VECTORS = ("rotation", "angular_velocity", "field")
"""Quantities of `derivatives` that are functions of time."""

MAX_UPRIGHT_ANGLE = 1e-3
"""Angle of a top's axis with n from which its inputs have derivatives in all components of n."""


MAX_RATE = 1e140
"""Rates between its inverse and this have products, with those by which they change, that floats hold."""


class Moved(NamedTuple):
    """Change of a motion's inputs per unit of one parameter of the user, such as "B1".

    ``weights`` holds d(input)/d(parameter) by the input's name, without zeros. ``turn`` (3,) is the rotation vector
    of the laboratory, ``spin`` the rotation about the third axis of the class, both in rad per unit of the
    parameter; a NaN spin says that there is no derivative.
    """

    weights: Mapping[str, float]
    turn: FloatArray = np.zeros(3)
    spin: float = 0.0


def derivatives(motion: Any, t: Any, names: Any, quantity: str, *, certified: bool = True) -> FloatArray:
    """Return derivatives of a ``quantity`` of ``motion``, one or an array, in ``names``; see `Motion.sensitivity`.

    The shape is (..., names, 3) for vectors at times t, (..., names) for a scalar. Without `certified` eight digits are
    enough, and DomainError is raised where only balls, in milliseconds a time, have eight.
    """
    names = [names] if isinstance(names, str) else list(names)
    singles = _singles(motion)
    if quantity not in VECTORS:
        return np.array([single.scalar(names, quantity) for single in singles]).reshape(*motion.shape, len(names))
    times = real(bare(t, "The time", TIME), "The time")
    if not motion.shape:
        values = singles[0].vectors(times.ravel(), names, quantity, certified=certified)
        return values.reshape(*times.shape, len(names), 3)
    shape = common_shape(motion.shape, times.shape)
    out, times = np.empty((*shape, len(names), 3)), np.broadcast_to(times, shape)
    places = np.broadcast_to(np.arange(len(singles)).reshape(motion.shape), shape)
    for i, single in enumerate(singles):
        out[places == i] = single.vectors(times[places == i], names, quantity, certified=certified)
    return out


def of_rounding(motion: Any, t: Any) -> FloatArray:
    """Return the bound of `Motion.input_error`, angles in rad in an array of the shape of ``motion`` and times t."""
    probe = _singles(motion)
    names = list(probe[0].rounded) if probe else []
    v = derivatives(motion, t, names, "rotation")
    halves = np.array([[x.rounded[name] for name in names] for x in probe]).reshape(*motion.shape, len(names))
    return np.asarray((np.sqrt((v * v).sum(-1)) * halves).sum(-1))


def _singles(motion: Any) -> list["SingleMotion"]:
    """Return a `SingleMotion` for each motion of an array, cached with the array."""
    cache: dict[int, SingleMotion] = vars(motion).setdefault("_differentiated", {})
    return [cache.get(i) or cache.setdefault(i, SingleMotion(motion, i)) for i in range(int(np.prod(motion.shape)))]


class SingleMotion:
    """The i-th motion of an array, counted flattened, with all that its derivatives need.

    Its `inputs` are the class's `Inputs`, `sides` the constant rotations (left, axes) of its placement, (3, 3)
    each, and `changes` has, by each name that `sensitivity` takes, the `Moved` inputs. `scalar` and `vectors`
    return the derivatives.
    """

    def __init__(self, motion: Any, i: int) -> None:
        self.motion, self.place, self.single = motion, i, motion._single(i)  # noqa: SLF001  of the same folder
        shape, placed = (*motion.shape, 3, 3), motion.is_placed
        self.sides = self.left, self.axes = [np.broadcast_to(x, shape).reshape(-1, 3, 3)[i] for x in motion._sides]  # noqa: SLF001
        self.inputs = motion._inputs_of(i)  # noqa: SLF001  of the same folder
        if self.inputs.along_body:
            self.left, self.axes = self.left @ self.axes, np.eye(3)
        self.changes = self._changes_by_name(placed, i)
        self._cache, self._varied = dict[tuple[str, ...], tuple[Any, ...]](), dict[tuple[str, ...], Any]()

    def _changes_by_name(self, placed: bool, i: int) -> dict[str, Moved]:
        """Return a `Moved` for each name that `sensitivity` takes, except "t".

        ``placed`` is true for a motion with given axes or attitude; i is its index in the flattened array.
        """
        names, L, C = self.inputs.names, self.left, self.axes
        changes = {x: Moved({x: 1.0}) for x in names if x[0] not in ("Kn" if placed else "K")}
        if "K1" in names or (placed and "n2" in names):
            K = [x for x, name in zip(self.inputs.values, names, strict=True) if name[0] in "Kn"]
            B = L @ floats([fmpq(0)] * (3 - len(K)) + K)
            transverse = np.eye(3)
            if "n2" in names:  # of a top only the direction matters, and along it nothing, not even rounding
                field = np.broadcast_to(self.motion.given[1], (*self.motion.shape, 3)).reshape(-1, 3)[i]
                u = field / abs(field).max()
                transverse = np.cross(np.cross(u, transverse), u) / (u @ u)
            for j, e in enumerate(np.eye(3)):
                moves = (f"B{j + 1}", np.zeros(3), L.T @ transverse[j]), (f"a{j + 1}", e, -L.T @ np.cross(e, B))
                for name, turn, change in moves:
                    changes[name] = self._of_field(change, turn)
        elif "I1" in names:  # Euler's top, free
            changes |= {f"a{j + 1}": Moved({}, e) for j, e in enumerate(np.eye(3))}
        if placed and "omega1" in names:
            changes |= {f"omega{j + 1}": Moved({f"omega{k + 1}": C[k, j] for k in range(3)}) for j in range(3)}
        # no derivative has to be made in inputs without weight
        return {name: x._replace(weights={y: w for y, w in x.weights.items() if w != 0}) for name, x in changes.items()}

    @cached_property
    def rounded(self) -> dict[str, float]:
        """Half an ulp of each input, by name, in the input's unit; the names are those in `changes`.

        An attitude has no entry.
        """
        values = {x: nearest(value) for x, value in zip(self.inputs.names, self.inputs.values, strict=True)}
        if self.motion.is_placed:
            shape = (*self.motion.shape, 3)
            _, B, _, w = self.motion.given
            for letter, x in (("B", B), ("omega", w)):
                row = np.broadcast_to(x, shape).reshape(-1, 3)[self.place].tolist()
                values |= {f"{letter}{j + 1}": x for j, x in enumerate(row)}
        elif "K1" in self.inputs.names:
            values |= {f"B{j}": values[f"K{j}"] for j in (1, 2, 3)}
        return {name: float(np.spacing(abs(values[name]))) / 2 for name in self.changes if name in values}

    def _of_field(self, change: FloatArray, turn: FloatArray) -> Moved:
        """Return the `Moved` inputs for a change (3,) of the field and a rotation ``turn`` (3,) of the body in space.

        The change is along the class's axes at t = 0, the rotation vector in the laboratory. For a top along its
        field the spin is NaN: there is no derivative.
        """
        if "K1" in self.inputs.names:
            return Moved({f"K{k + 1}": change[k] for k in range(3)}, turn)
        # a top's direction has no first component: its axes turn with that about the third
        n2, n3, w1, w2 = floats(self.inputs.values[4:8])
        spin = 0.0 if not change[0] else change[0] / n2 if abs(n2) > MAX_UPRIGHT_ANGLE * abs(n3) else np.nan
        weights = {"n2": change[1], "n3": change[2], "omega1": -spin * w2, "omega2": spin * w1}
        return Moved(weights, turn - spin * self.left[:, 2], spin)

    def _inputs_behind(self, names: Sequence[str]) -> list[str]:
        """Return the names of the class's inputs on which ``names`` depend, in the class's order.

        Raises AtlasError for an unknown name, and DomainError for a component of n in ``names`` of a top whose axis
        is along n.
        """
        allowed = [*self.changes, "t"]
        for name in names:
            if name not in allowed:
                raise AtlasError(f"There is no input {name!r} of this motion: choose from {', '.join(allowed)}.")
            if name != "t" and np.isnan(self.changes[name].spin):
                raise DomainError(f"The top's axis is along n, where its inputs have no derivative in {name}.")
        return [x for x in self.inputs.names if any(x in self.changes[name].weights for name in names if name != "t")]

    def scalar(self, names: Sequence[str], quantity: str) -> FloatArray:
        """Return the derivatives of a scalar ``quantity``, as "period", in ``names``, shape (len(names),); 0 in "t".

        Raises AtlasError for an unknown scalar, DomainError for an infinite one or a derivative that no float holds.
        """
        if quantity not in self.inputs.scalars:
            raise AtlasError(
                f"A {self.motion.family} motion has no derivative of {quantity!r}: choose from "
                f"{', '.join((*VECTORS, *self.inputs.scalars))}."
            )
        inputs = self._inputs_behind(names)
        value = getattr(self.motion, quantity, 0.0)
        if np.isinf(np.broadcast_to(value, self.motion.shape).flat[self.place]):
            raise DomainError(f"The {quantity} is infinite and has no derivatives.")
        derivatives = dict(zip(inputs, self.inputs.of_scalar(quantity, inputs), strict=True)) if inputs else {}
        with np.errstate(over="ignore", invalid="ignore"):
            values = [
                0.0 if name == "t" else sum(w * derivatives[x] for x, w in self.changes[name].weights.items())
                for name in names
            ]
        return np.asarray(finite(np.array(values), f"A derivative of the {quantity}"))

    def vectors(self, t: FloatArray, names: Sequence[str], quantity: str, *, certified: bool) -> FloatArray:
        """Return derivatives of a vector ``quantity`` at times t (m,) in ``names``, shape (m, len(names), 3).

        See `Motion.sensitivity` for the quantities, `derivatives` for ``certified``. Raises DomainError for rates
        beyond `MAX_RATE`.
        """
        faster, inverse = quantity == "angular_velocity", "larmor" in self.inputs.names
        if not 1 / MAX_RATE < self.inputs.rate < MAX_RATE:
            raise DomainError(
                "The rates of this motion are too large or too small for derivatives: choose other units."
            )
        moving = [x for x in names if x != "t"]
        varied, weights, turns, spins, cached = self._weighted(moving)
        v = slopes = np.broadcast_to(turns, (t.size, *turns.shape))
        if varied:
            v, *rates = varied.vectors(t, faster, self.left, weights, turns, spins, cached, certified=certified)
            slopes = rates[0] if rates else v
        elif faster:
            slopes = np.zeros_like(v)
        needs_rotation = quantity != "rotation" or inverse or len(moving) < len(names)
        R = self.sides[0] @ self.single.rotation(t) @ self.sides[1] if needs_rotation else np.empty(0)
        Omega = self.single.angular_velocity(t) @ self.sides[1] if inverse or len(moving) < len(names) else np.empty(0)
        if inverse:  # the matrix is the transposed one
            if faster:
                slopes = -np.matvec(R[:, None], slopes + np.cross(Omega[:, None], v))
            v = -np.matvec(R[:, None], v)
        vectors, B = v, self.left @ self.inputs.field
        if faster:
            vectors = slopes @ R
        elif quantity == "field":
            inputs, none = self._inputs_behind(moving), np.zeros(3)
            fields = np.array([self.inputs.fields.get(x, none) for x in inputs]).reshape(-1, 3)
            vectors = (weights @ fields @ self.left.T + np.cross(turns, B) - np.cross(v, B)) @ R
        if len(moving) == len(names):
            return np.asarray(vectors)
        out = np.empty((t.size, len(names), 3))
        out[:, [x != "t" for x in names]] = vectors
        rate = np.matvec(R, Omega) if quantity == "rotation" else self._rate(quantity, R, Omega, B)
        out[:, [x == "t" for x in names]] = rate[:, None]
        return out

    def _weighted(self, names: Sequence[str]) -> tuple[Any, ...]:
        """Return derivatives in the inputs behind ``names``, and how the inputs are weighted; cached by ``names``.

        The tuple is (`Varied` evaluator or None, weights (names, inputs), turns (names, 3), spins (names,), what
        `Varied.weighted` makes of these or None); see `Moved`.
        """
        key = tuple(names)
        if key not in self._cache:
            inputs = self._inputs_behind(names)
            changes = [self.changes[x] for x in names]
            weights = np.array([[x.weights.get(y, 0.0) for y in inputs] for x in changes]).reshape(
                len(names), len(inputs)
            )
            turns, spins = (
                np.array([x.turn for x in changes]).reshape(len(names), 3),
                np.array([x.spin for x in changes]),
            )
            if tuple(inputs) not in self._varied:
                self._varied[tuple(inputs)] = self.inputs.varied(inputs) if inputs else None
            varied = self._varied[tuple(inputs)]
            cached = varied.weighted(self.left, weights, turns, spins) if varied else None
            self._cache[key] = varied, weights, turns, spins, cached
        return self._cache[key]

    def _rate(self, quantity: str, R: FloatArray, Omega: FloatArray, B: FloatArray) -> FloatArray:
        """Return dK/dt if ``quantity`` is "field", else dOmega/dt, (m, 3), along the body's axes, in 1/time^2.

        R (m, 3, 3) are the rotations, Omega (m, 3) the angular velocities in the body, and B (3,) is the field in
        the laboratory. I dOmega/dt = [I Omega + k b, Omega] + [k Omega - U' e3, b] - k [b, Omega], with the moments
        I, the coupling k, three numbers each, and the potential U of `Inputs.dynamics`, U' by b3; b = R^T B is the
        field in the body, which K is, [,] the vector product, and I and k multiply component by component.
        """
        J, k, linear, quadratic = self.inputs.dynamics
        w, b = Omega @ self.axes.T, (B @ R) @ self.axes.T
        if quantity == "field":
            return np.asarray(np.cross(b, w) @ self.axes)
        push = np.outer(linear + quadratic * b[:, 2], (0.0, 0.0, 1.0))
        change = np.cross(J * w + k * b, w) + np.cross(k * w - push, b) - k * np.cross(b, w)
        return np.asarray((change / J) @ self.axes)
