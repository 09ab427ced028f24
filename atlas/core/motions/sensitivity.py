"""Derivatives of a rotation matrix in the inputs of its motion: the vector v in the laboratory, dR/dp = [v]x R.

Every motion of one nutation is R = exp(lambda t n) S(s) exp(sigma t e3), s = t + origin less whole periods T, so

    v = t lambda_p n + t sigma_p R e3 + (origin_p - count T_p) v_s + (what is bounded and periodic).

Whatever grows with time is in three derivatives of frequencies, which `atlas.exact.nutation.variations` makes in balls
with all other constants; v_s and the bounded part are those of the pair (alpha, beta) at a fixed place s in the period.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from flint import acb, arb, fmpq

from atlas.core.arithmetic.phase import EVEN, Phases, room
from atlas.core.arithmetic.words import TURN
from atlas.core.inputs import FloatArray, real
from atlas.core.quantities import TIME, bare
from atlas.errors import AtlasError, DomainError
from atlas.exact.motions.elliptic import EllipticMotion
from atlas.exact.motions.general import GeneralMotion
from atlas.exact.motions.top import TopMotion
from atlas.exact.nutation.cayley_klein import steady
from atlas.exact.nutation.nutating import Nutating
from atlas.exact.nutation.variations import Constants, Tables, Variation, constants, variation
from atlas.formulas import ball, elementary
from atlas.formulas.numbers import direction, rational, workprec

BLOCK = 4096
"""Times at once."""

NEGLIGIBLE = 2.0**-64
"""Part of the largest term of a sum below which a term is left out."""

SERIES, SMALL = 14, 0.1
"""Terms of the series in A u^2 of the derivative in A of the integral of nu, and up to where it is taken."""

Array: TypeAlias = np.ndarray[Any, Any]


class Pair:
    """alpha and beta of one motion in doubles, with their derivatives in several inputs, at any time."""

    def __init__(self, variations: Sequence[Variation]) -> None:
        form, places, _, kinds, *_ = variations[0].form
        self.steady, self.hyperbolic = form == "steady", form == "hyperbolic"
        self.doubled, self.order = [doubled for doubled, _ in kinds], np.eye(3)[list(places)]
        value, slopes = variations[0].values, [x.slopes for x in variations]
        self.rates = _doubles(slopes, "rates").real
        with workprec():
            cells = 1 if self.hyperbolic else 2
            half, origin = value["times"] or (arb(1), arb(0))
            self.cell = 2 * cells * half
            turns, starts = [value["rates"][0].mid() / TURN], [arb(0)]
            if not self.steady:
                turns, starts = [*turns, (1 / self.cell).mid()], [*starts, (origin / self.cell).mid()]
            self.phases = Phases(turns, starts, rounder=EVEN)
            self.start = float((origin / self.cell).mid())
            self.cell, self.origin = float(self.cell.mid()), float(origin.mid())
        times = np.zeros((len(slopes), 2)) if self.steady else _doubles(slopes, "times").real
        self.cells, self.origins = 2 * cells * times[:, 0], times[:, 1]
        self.tilt, self.tilts = _double(value["tilt"]).real, _doubles(slopes, "tilt").real
        with workprec():
            self._weigh(value, slopes)
        self.swing = Swing(value, slopes, self) if "swing" in value else None

    def _weigh(self, value: Tables, slopes: Sequence[Tables]) -> None:
        """Keep the weights of S, C, s S, s C in alpha and beta, in their slopes by s, and in their derivatives."""
        rate, *twists = value["slopes"]
        self.rate, self.twist = float(rate.mid()), float((twists[0] + twists[1]).mid())
        self.tables: list[Array] = []
        self.frequencies: list[FloatArray] = []
        sign = 1 if self.hyperbolic else -1
        for i in range(2):
            row, changes, twist = value[f"sum {i}"], [x[f"sum {i}"] for x in slopes], twists[i] * acb(0, 1)
            k = [n - n % 2 + (not self.doubled[i]) for n in range(len(row))]
            # S and C change places: the derivative by rate s is odd C -+ even S
            turned = [k[n] * (row[n - 1] if n % 2 else sign * row[n + 1]) for n in range(len(row))]
            slope = [twist * x + rate * y for x, y in zip(row, turned, strict=True)]
            still, moving = [slope], [[acb(0)] * len(row)]
            for x, change in zip(slopes, changes, strict=True):
                origin = x["times"][1] if x["times"] else arb(0)
                more, own = x["slopes"][0], x["slopes"][1 + i] * acb(0, 1)
                # in balls: next to a steady motion the origin moves fast, and the weights against it
                still.append([y + origin * z for y, z in zip(change, slope, strict=True)])
                moving.append([own * y + more * z for y, z in zip(row, turned, strict=True)])
            table = np.concatenate([[_double(x) for x in (row, *still)], [_double(x) for x in (row, *moving)]], 1)
            table[0, len(row) :] = 0
            self._keep(table, np.array(k[::2], dtype=float))

    def _keep(self, table: Array, k: FloatArray) -> None:
        """Keep the terms that matter. DomainError where none but huge ones do."""
        reach = self.rate * self.cell / 2 if self.hyperbolic else 0.0
        size = abs(table).max(0).reshape(2, -1, 2).max((0, 2))
        with np.errstate(over="ignore", invalid="ignore"):
            grown = size * np.exp(k * reach)
            count = int(np.flatnonzero(grown > NEGLIGIBLE * grown.max()).max(initial=0)) + 1
        if not np.isfinite(grown).all():
            raise DomainError("The motion is too near to a separatrix for derivatives in floats.")
        self.tables.append(table.reshape(len(table), 2, -1, 2)[:, :, :count].reshape(len(table), -1))
        self.frequencies.append(k[:count])

    def places(self, t: FloatArray) -> tuple[Array, FloatArray, FloatArray]:
        """Return exp(i lambda t), s, and the count of whole cells."""
        half, rest, *_ = self.phases.reduced(t, room(1 + (not self.steady), t.size))
        turn = 2 * (half + rest)
        if self.steady:
            return np.exp(1j * turn[0]), np.zeros(t.size), np.zeros(t.size)
        parts = turn[1] / float(TURN)
        return np.exp(1j * turn[0]), parts * self.cell, np.rint(t / self.cell + self.start - parts)

    def rows(self, s: FloatArray, i: int) -> tuple[Array, Array]:
        """Return alpha (i = 0) or beta with its slope by s, (2, m), and the derivatives in the inputs, (P, m)."""
        if self.steady:
            found = self.tables[i][:, 1:2] * np.ones(s.size)
        else:
            functions = _functions(self.rate * s, self.frequencies[i], self.hyperbolic)
            basis = np.concatenate([functions, functions * s])
            found = self.tables[i] @ basis
        return found[:2], found[2:]

    def vectors(self, t: FloatArray) -> Array:
        """Return v of each input at times (m,), (P, m, 3), in the frame of the motion's body at t = 0."""
        turn, s, count = self.places(t)
        (a, a_s), a_p = self.rows(s, 0)
        (b, b_s), b_p = self.rows(s, 1)
        along = count * self.cells[:, None]
        a_p, b_p = a_p - along * a_s, b_p - along * b_s
        square = (a * a.conj() + b * b.conj()).real
        turn = turn * np.exp(1j * self.twist * s)
        across = (b_p * a - a_p * b) * (2 * turn / square)
        third = (a_p * a.conj() + b_p * b.conj()).imag * (2 / square)
        e, e3 = -2j * a * b * turn / square, (a * a.conj() - b * b.conj()).real / square
        c, sine, C, S = self.tilt
        dc, ds, dC, dS = self.tilts.T
        chi = C * dS - S * dC
        spin = t * self.rates[:, 1:] + chi[:, None]
        if self.swing:
            spin = spin + self.swing.change(s, count)
        across, third = across + spin * e, third + spin * e3 + t * self.rates[:, :1]
        # out of the frame of the field: R_z(-chi) R_x(-theta)
        cos, sin = c * c - sine * sine, 2 * c * sine
        y, z = cos * across.imag + sin * third, cos * third - sin * across.imag
        x = across.real - 2 * (c * ds - sine * dc)[:, None]
        return np.stack([C * x + S * y, C * y - S * x, z - chi[:, None]], -1) @ self.order


class Swing:
    """What the integral of nu adds to the turn about a top's axis, and its derivatives."""

    def __init__(self, value: Tables, slopes: Sequence[Tables], pair: Pair) -> None:
        self.pair, self.A = pair, float(value["A"][0].mid())
        self.kappa, self.twist = (_double(value[x]).real[0] for x in ("swing", "twist"))
        self.kappas, self.twists = (_doubles(slopes, x).real[:, 0] for x in ("swing", "twist"))
        self.As = _doubles(slopes, "A").real[:, 0]
        self.rates = _doubles(slopes, "slopes").real[:, 0]
        names = ("sum 2", "sum 3")
        self.sums = [_double(value[x]).reshape(-1, 2).real for x in names]
        self.changes = [_doubles(slopes, x).reshape(len(slopes), -1, 2).real for x in names]
        zero = np.zeros(1)
        at_start = self._terms(zero + pair.origin)
        self.start = at_start[0] + pair.origins[:, None] * at_start[1]

    def _terms(self, s: FloatArray) -> tuple[Array, Array]:
        """Return the derivatives of the angle at a fixed place, (P, m), and its slope by s."""
        parts, bys, changes = [], [], []
        for i, (both, change) in enumerate(zip(self.sums, self.changes, strict=True)):
            doubled, hyperbolic = self.pair.doubled[2 + i], self.pair.hyperbolic
            k = np.arange(len(both), dtype=float) * 2 + (not doubled)
            f = _functions(self.pair.rate * s, k, hyperbolic)
            turned = np.stack([(1 if hyperbolic else -1) * k * both[:, 1], k * both[:, 0]], 1).ravel() @ f
            parts.append(both.ravel() @ f)
            bys.append(self.pair.rate * turned)
            changes.append(change.reshape(len(change), -1) @ f + self.rates[:, None] * s * turned)
        (o, e), (o_s, e_s), (o_p, e_p), A = parts, bys, changes, self.A
        square = e * e - A * o * o
        size = np.sqrt(abs(A))
        bent = 2 * o / e
        if A:
            bent = 2 * (np.arctanh(o / e * size) if A > 0 else np.arctan2(o * size, e)) / size
        by_A = (o * e / square - bent / 2) / A if A else 2 * (o / e) ** 3 / 3
        near = abs(A) * o * o < SMALL * e * e
        u = o[near] / e[near]
        by_A[near] = sum(2 * n / (2 * n + 1) * A ** (n - 1) * u ** (2 * n + 1) for n in range(1, SERIES))
        part = 2 * (o_p * e - o * e_p) / square + self.As[:, None] * by_A
        whole = self.kappas[:, None] * (self.twist * s + bent) + self.kappa * (self.twists[:, None] * s + part)
        return whole, self.kappa * (self.twist + 2 * (o_s * e - o * e_s) / square)

    def change(self, s: FloatArray, count: FloatArray) -> Array:
        """Return the derivatives of the angle, but for what grows with time."""
        p = self.pair
        fixed, slope = self._terms(s)
        return np.asarray(fixed + (p.origins[:, None] - count * p.cells[:, None]) * slope - self.start)


def _functions(x: FloatArray, k: FloatArray, hyperbolic: bool) -> Array:
    """Return S and C of k x by turns, (2 len(k), m)."""
    out = np.empty((2 * len(k), x.size))
    for i, n in enumerate(k.tolist()):
        out[2 * i], out[2 * i + 1] = (np.sinh(n * x), np.cosh(n * x)) if hyperbolic else (np.sin(n * x), np.cos(n * x))
    return out


def _double(row: Sequence[Any]) -> Array:
    """Return balls as complex doubles."""
    return np.array([complex(acb(x).mid()) for x in row], dtype=complex)


def _doubles(tables: Sequence[Tables], name: str) -> Array:
    return np.array([_double(x[name]) for x in tables])


@dataclass(frozen=True)
class Inputs:
    """Exact inputs of one motion by name, their sizes, and what makes its constants."""

    names: tuple[str, ...]
    values: tuple[fmpq, ...]
    scales: tuple[fmpq, ...]
    make: Callable[..., Constants]

    def vectors(self, names: Sequence[str], t: FloatArray) -> FloatArray:
        """Return v at times (m,), (m, len(names), 3)."""
        found = [variation(self.make, self.values, self.names.index(x), self.scales) for x in names]
        out = np.empty((t.size, len(names), 3))
        for group in _alike(found):
            pair = Pair([found[i] for i in group])
            for i in range(0, t.size, BLOCK):
                out[i : i + BLOCK, group] = pair.vectors(t[i : i + BLOCK]).swapaxes(0, 1)
        return out


def _alike(found: Sequence[Variation]) -> list[list[int]]:
    """Return the places of variations with the same constants: on a border each input has its own."""
    groups: list[list[int]] = []
    for i, x in enumerate(found):
        for group in groups:
            other = found[group[0]]
            same = other.form == x.form and all(
                len(row) == len(x.values[name]) and all(map(_same, row, x.values[name]))
                for name, row in other.values.items()
            )
            if same:
                group.append(i)
                break
        else:
            groups.append([i])
    return groups


def _same(x: Any, y: Any) -> bool:
    return complex(acb(x).mid()) == complex(acb(y).mid())


def _size(*rates: fmpq) -> fmpq:
    """Return the largest, 1 if all are zero."""
    return max((abs(x) for x in rates), default=fmpq(0)) or fmpq(1)


def _nutating(twin: Nutating) -> Constants:
    """Return the constants of a motion in balls."""
    return constants(twin.tilt(), twin.solution, getattr(twin, "places", (0, 1, 2)))


def general(exact: GeneralMotion) -> Inputs:
    """Return the inputs of a general motion: the ratio, and field and angular velocity in the body at t = 0."""
    size = _size(*exact.field, *exact.omega)
    return Inputs(
        ("ratio", "K1", "K2", "K3", "omega1", "omega2", "omega3"),
        (exact.I, *exact.field, *exact.omega),
        (exact.I, *[size] * 6),
        lambda I, *x: _nutating(GeneralMotion.at_state(I, x[3:], x[:3])),
    )


def top(row: Sequence[float]) -> Inputs:
    """Return the inputs of a top."""
    values = tuple(rational(float(x)) for x in row)
    I2, I3, k2, k3, n2, n3, w1, w2, w3, linear, quadratic = values
    rates = (k2 / I2, k3 / I3, w1, w2, w3)
    pull = rational(float(np.sqrt(abs(float(linear.p) / float(linear.q) / row[0])))) if linear != 0 else fmpq(0)
    push = rational(float(np.sqrt(abs(float(quadratic.p) / float(quadratic.q) / row[0])))) if quadratic != 0 else 0
    w = _size(*rates, pull, fmpq(push))
    n = _size(n2, n3)
    return Inputs(
        ("I2", "I3", "k2", "k3", "n2", "n3", "omega1", "omega2", "omega3", "linear", "quadratic"),
        values,
        (I2, I3, I2 * w, I2 * w, n, n, w, w, w, I2 * w * w, I2 * w * w),
        lambda *x: _nutating(TopMotion(x[:2], x[2:4], x[4:6], x[6:9], *x[9:])),
    )


def elliptic(exact: EllipticMotion) -> Inputs:
    """Return the inputs of an elliptic motion."""
    size, (I1, I2, I3) = _size(*exact.field), exact.inertia
    return Inputs(
        ("I1", "I2", "I3", "B1", "B2", "B3", "z"),
        (*exact.inertia, *exact.field, exact.z),
        (I1, I2, I3, size, size, size, _size(exact.z, I1 * I2)),
        lambda *x: _nutating(EllipticMotion(x[:3], x[3:6], x[6], exact.branch)),
    )


def two_turns(names: Sequence[str], values: Sequence[fmpq], scales: Sequence[fmpq], turning: Any) -> Inputs:
    """Return the inputs of a motion R_n(k t) R_z(phi t), whose axis and frequencies `turning` has."""

    def make(*x: fmpq) -> Constants:
        along, k, phi = turning(*x)
        axis = along if len(along) == 3 else (fmpq(0), *along)
        n1, n2, n3 = (arb(y) for y in direction(axis))
        across = (n1 * n1 + n2 * n2).sqrt() if not axis[0] == axis[1] == 0 else arb(0)
        C, S = (n2 / across, n1 / across) if across != 0 else (arb(1), arb(0))
        longer = ((1 + abs(n3)) / 2).sqrt()
        shorter = across / (2 * longer)
        tilt = (longer, shorter, C, S) if axis[2] >= 0 else (shorter, longer, C, S)
        return constants(tilt, steady(tilt, k, phi, arb("inf")))

    return Inputs(tuple(names), tuple(values), tuple(scales), make)


def _elementary(case: str, row: Sequence[float], given: bool) -> Inputs:
    """Return the inputs of an elementary motion."""
    I2, I3, B2, B3, w2, w3 = (rational(float(x)) for x in row)
    size = _size(B2, B3, w2, w3)
    case = "precession" if case == "at rest" else case
    count = 5 if given else 4
    names = ("ratio", "B2", "B3", "omega2", "omega3")[:count]
    return two_turns(
        names, (I3 / I2, B2, B3, w2, w3)[:count], (I3 / I2, *[size] * 4)[:count],
        lambda *x: elementary.turning(case, fmpq(1), *x, *[fmpq(0)] * (5 - count)),
    )  # fmt: skip


def _free(row: Sequence[float]) -> Inputs:
    """Return the inputs of a free body."""
    I2, I3, *omega = (rational(float(x)) for x in row)
    return two_turns(
        ("ratio", "omega1", "omega2", "omega3"), (I3 / I2, *omega), (I3 / I2, *[_size(*omega)] * 3),
        lambda ratio, *w: elementary.free(fmpq(1), ratio, *w),
    )  # fmt: skip


def _ball(row: Sequence[float]) -> Inputs:
    """Return the inputs of a ball."""
    inertia, larmor, *m = (rational(float(x)) for x in row)
    size = _size(larmor, *(x / inertia for x in m))
    return two_turns(
        ("inertia", "larmor", "m2", "m3"), (inertia, larmor, *m), (inertia, size, size * inertia, size * inertia),
        ball.turning,
    )  # fmt: skip


def of(motion: Any, t: Any, names: Any) -> FloatArray:
    """Return v of a motion, or of an array of them, for each name; shape (..., len(names), 3)."""
    names = [names] if isinstance(names, str) else list(names)
    times = real(bare(t, "The time", TIME), "The time")
    full = np.broadcast_shapes(motion.shape, times.shape)
    if not motion.shape:
        return _of_one(motion, 0, times.ravel(), names).reshape(*times.shape, len(names), 3)
    out, times = np.empty((*full, len(names), 3)), np.broadcast_to(times, full)
    own = np.broadcast_to(np.arange(int(np.prod(motion.shape))).reshape(motion.shape), full)
    for i in range(int(np.prod(motion.shape))):
        out[own == i] = _of_one(motion, i, times[own == i], names)
    return out


def _of_one(motion: Any, i: int, t: FloatArray, names: list[str]) -> FloatArray:
    """Return v of the i-th motion at times (m,)."""
    one = motion._single(i)  # noqa: SLF001  of the same floor
    out = np.empty((t.size, len(names), 3))
    inputs, chain = _inputs(motion, i, one)
    allowed = [*chain, "t"]
    for name in names:
        if name not in allowed:
            raise AtlasError(f"There is no input {name!r} of this motion: choose from {', '.join(allowed)}.")
    needed = [x for x in inputs.names if any(x in chain[name][0] for name in names if name != "t")]
    found = inputs.vectors(needed, t) if needed else np.empty((t.size, 0, 3))
    if motion.family == "ball":  # the matrix is the transposed one
        found = -found @ one.rotation(t).swapaxes(1, 2)
    A = np.eye(3) if motion.family != "general" else one.rotation(np.zeros(1))[0]
    for j, name in enumerate(names):
        if name == "t":
            out[:, j] = np.matvec(one.rotation(t), _omega(one, motion, t))
            continue
        factors, constant = chain[name]
        out[:, j] = constant + sum(w * (found[:, needed.index(x)] @ A.T) for x, w in factors.items())
    return out


def _omega(one: Any, motion: Any, t: FloatArray) -> FloatArray:
    """Return Omega(t) of one motion, (m, 3)."""
    if hasattr(one, "angular_velocity"):
        return np.asarray(one.angular_velocity(t))
    spin = one.turned if motion.family == "ball" else one.swung
    return np.asarray(spin(one.vector("Omega"), t, None))


Chain = dict[str, tuple[dict[str, float], FloatArray]]
"""For each name what it moves, and what it adds."""


def _inputs(motion: Any, i: int, one: Any) -> tuple[Inputs, Chain]:
    """Return the inputs of one motion, and how the names that a user may ask for move them."""
    family, none = motion.family, np.zeros(3)
    if family == "general":
        inputs = general(one.exact)
        A, K = one.rotation(np.zeros(1))[0], np.array([float(x.p) / float(x.q) for x in one.exact.field])
        chain: Chain = {x: ({x: 1.0}, none) for x in ("ratio", "omega1", "omega2", "omega3")}
        for j in range(3):
            chain[f"B{j + 1}"] = {f"K{k + 1}": A[j, k] for k in range(3)}, none
            turned = -A.T @ np.cross(np.eye(3)[j], A @ K)
            chain[f"a{j + 1}"] = {f"K{k + 1}": turned[k] for k in range(3)}, np.eye(3)[j]
        return inputs, chain
    row = [np.broadcast_to(x, motion.shape).flat[i] for x in motion._inputs]  # noqa: SLF001  of the same floor
    if family == "top":
        inputs = top(row)
    elif family == "elliptic":
        inputs = elliptic(one.exact)
    elif family == "elementary":
        inputs = _elementary(one.case, [0.0 if x is None else float(x) for x in row], row[5] is not None)
    elif family in ("free", "ball"):
        inputs = (_free if family == "free" else _ball)(row)
    else:
        raise DomainError(f"The {family} motion has no sensitivity here.")
    return inputs, {x: ({x: 1.0}, none) for x in inputs.names}
