"""Are derivatives right? Motions of every kind, hostile ones too, against variations that an integrator follows.

In the folder tests, `python -m stress.derivatives --samples 40 --seed 1` draws motions of the regimes of `stress`, of
bodies in the laboratory with any attitude as well, moves all of their inputs by random amounts at once, and integrates
the equations of motion with their variations by heyoka's Taylor series in numbers of 64 binary digits: no formula is
shared. It prints for each regime the worst error of v, dOmega/dp and dK/dp, in parts of 1 + |v|, and the refusals.
General motions and tops are followed to t = 1e6 too, by differences of balls. The exit status is 1 if an error is
above 1e-12. It needs heyoka (requirements-bench.lock), and a processor whose long double has 64 digits.
"""

import argparse
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from random import Random
from typing import Any, NamedTuple

import click
import heyoka
import numpy as np

import atlas
from stress.asymmetric import ASYMMETRIC
from stress.regimes import GENERAL
from stress.tops import TOPS, rate_of

Long = np.longdouble
BOUND, FAR = 1e-12, 1e6
ONE, E = np.eye(3), np.eye(3)


class Case(NamedTuple):
    """A motion, its state by name, the change of the state per unit of each input; sizes of the inputs, and a time."""

    regime: str
    motion: Any
    state: Mapping[str, Any]
    ways: Mapping[str, Mapping[str, Any]]
    sizes: Mapping[str, float]
    t: float


class Dual(NamedTuple):
    """An expression and its derivative."""

    x: Any
    d: Any

    def __add__(self, other: Any) -> "Dual":
        return Dual(self.x + other.x, self.d + other.d)

    def __sub__(self, other: Any) -> "Dual":
        return Dual(self.x - other.x, self.d - other.d)

    def __mul__(self, other: Any) -> "Dual":
        return Dual(self.x * other.x, self.x * other.d + self.d * other.x)


def _cross(a: Sequence[Any], b: Sequence[Any]) -> list[Any]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _times(A: Any, v: Sequence[Any]) -> list[Any]:
    return [row[0] * v[0] + row[1] * v[1] + row[2] * v[2] for row in A]


@cache
def integrator() -> Any:
    """Return the integrator of Omega, R and their variations.

    Its parameters are the inertia tensor, its inverse, the coupling, B, and the potential's linear and quadratic part.
    """
    w, *rows = ([Dual(*heyoka.make_vars(f"{n}{i}", f"d{n}{i}")) for i in "123"] for n in "wxyz")
    pars = [Dual(heyoka.par[i], heyoka.par[i + 1]) for i in range(0, 64, 2)]
    triples = [pars[i : i + 3] for i in range(0, 30, 3)]
    J, inverse, k, B, (linear, quadratic) = triples[:3], triples[3:6], triples[6:9], triples[9], pars[30:]
    b = [rows[0][j] * B[0] + rows[1][j] * B[1] + rows[2][j] * B[2] for j in range(3)]
    M = [x + y for x, y in zip(_times(J, w), _times(k, b), strict=True)]
    force = _times(k, w)
    force[2] = force[2] - linear - quadratic * b[2]
    sums = zip(_cross(M, w), _cross(force, b), _times(k, _cross(b, w)), strict=True)
    rates = [*_times(inverse, [x + y - z for x, y, z in sums]), *(x for row in rows for x in _cross(row, w))]
    places = [*w, *(x for row in rows for x in row)]
    equations = [pair for x, rate in zip(places, rates, strict=True) for pair in zip(x, rate, strict=True)]
    return heyoka.taylor_adaptive(
        equations, np.zeros(24, Long), pars=np.zeros(64, Long), fp_type=Long, tol=Long("1e-20"), compact_mode=True
    )


def followed(case: Case, way: Mapping[str, Any]) -> tuple[np.ndarray, ...]:
    """Return v, dOmega and dK at the time of a case for a change of its state."""

    def value_and_slope(name: str, *shape: int) -> tuple[Any, Any]:
        value = np.array(case.state.get(name, np.zeros(shape)), Long)
        return value, np.broadcast_to(np.array(way.get(name, 0.0), Long), value.shape)

    J, dJ = value_and_slope("J", 3, 3)
    k, dk = value_and_slope("k", 3, 3) if "k" in case.state else (J, dJ)
    (B, dB), (w, dw), (R, dR), (linear, d_linear), (quadratic, d_quadratic) = (
        value_and_slope(name, *shape) for name, *shape in (("B", 3), ("w", 3), ("R", 3, 3), ("linear",), ("quadratic",))
    )
    dR = dR + np.cross(np.array(way.get("a", np.zeros(3)), Long), R.T).T
    if "k" in case.state:  # a top, of whose direction only the direction counts
        size = np.sqrt((B * B).sum())
        B, dB = B / size, (dB - B * (B @ dB) / size**2) / size
    adjoint = np.array([np.cross(J[:, (i + 1) % 3], J[:, (i + 2) % 3]) for i in range(3)])
    inverse = adjoint / (adjoint[0] @ J[:, 0])
    rate = Long(2) ** int(np.floor(np.log2(1 / abs(case.t))))
    units = (1, 1, 1 if k is J else rate, rate if k is J else 1, rate**2, rate**2, rate, 1)
    values = [J, inverse, k, B, linear, quadratic, w, R]
    changes = [dJ, -inverse @ dJ @ inverse, dk, dB, d_linear, d_quadratic, dw, dR]
    values, changes = ([x / unit for x, unit in zip(y, units, strict=True)] for y in (values, changes))
    scale = max(abs(x).max() for x in changes) or Long(1)
    flat = [np.stack([np.ravel(x), np.ravel(y / scale)], 1).ravel() for x, y in zip(values, changes, strict=True)]
    solver = integrator()
    solver.pars[:], solver.state[:], solver.time = np.concatenate(flat[:6]), np.concatenate(flat[6:]), Long(0)
    solver.propagate_until(Long(case.t) * rate)
    x, d = np.array(solver.state).reshape(12, 2).T
    R, dR = x[3:].reshape(3, 3), d[3:].reshape(3, 3)
    spin = dR @ R.T
    v = np.array([spin[2, 1] - spin[1, 2], spin[0, 2] - spin[2, 0], spin[1, 0] - spin[0, 1]]) / 2
    return tuple((y * scale).astype(float) for y in (v, d[:3] * rate, dR.T @ B + R.T @ (dB / scale)))


def _vectors(*names: str) -> dict[str, dict[str, Any]]:
    """Return the changes per unit of each component of a vector: of B, omega and a."""
    return {f"{name}{i + 1}": {{"omega": "w"}.get(name, name): E[i]} for name in names for i in range(3)}


def _time(rate: float, random: Random) -> float:
    return random.choice((1, -1)) * random.uniform(1.0, 4.0) / (rate or 1.0)


def general(random: Random) -> Case:
    """Draw a general motion."""
    regime = random.choice(list(GENERAL))
    I, B, w = GENERAL[regime](random)
    rate = max(map(abs, (*B, *w))) or 1.0
    ways = {"ratio": {"J": np.diag(E[2])}, **_vectors("B", "omega", "a")}
    sizes = {"ratio": I, **{name: 1.0 if name[0] == "a" else rate for name in ways if name != "ratio"}}
    state = {"J": np.diag([1, 1, I]), "B": (0, *B), "w": w, "R": ONE}
    return Case(regime, atlas.GeneralMotion(I, B, w), state, ways, sizes, _time(rate, random))


def top(random: Random) -> Case:
    """Draw a top."""
    regime = random.choice(list(TOPS))
    x = TOPS[regime](random)
    rate, across_axis = rate_of(x), np.diag([1.0, 1.0, 0.0])
    ways: dict[str, Any] = {
        "I2": {"J": across_axis},
        "I3": {"J": np.diag(E[2])},
        "k2": {"k": across_axis},
        "k3": {"k": np.diag(E[2])},
    }
    ways |= {"n2": {"B": E[1]}, "n3": {"B": E[2]}, **_vectors("omega"), "linear": {"linear": 1.0}}
    ways["quadratic"] = {"quadratic": 1.0}
    units = {"I": 1.0, "n": 1.0, "k": rate, "o": rate, "l": rate**2, "q": rate**2}
    (k2, k3), potential = x.coupling, {"linear": x.linear, "quadratic": x.quadratic}
    state = {
        "J": np.diag([1, 1, x.inertia[1]]),
        "k": np.diag([k2, k2, k3]),
        "B": (0, *x.direction),
        "w": x.omega,
        "R": ONE,
    }
    sizes = {name: units[name[0]] for name in ways}
    return Case(regime, atlas.TopMotion(*x), state | potential, ways, sizes, _time(rate, random))


def _rotation(random: Random) -> np.ndarray:
    Q, _ = np.linalg.qr([[random.gauss(0, 1) for _ in range(3)] for _ in range(3)])
    return Q * np.sign(np.linalg.det(Q))


def _in_laboratory(regime: str, J: np.ndarray, start: Any, third: np.ndarray, random: Random) -> Case:
    """Draw a field, a start and an attitude, some of them along each other, of a body with a tensor."""
    R, size = _rotation(random), random.choice((0.1, 1.0, 10.0))
    B, w = (np.array([random.gauss(0, 1) for _ in range(3)]) * x for x in (size, 1.0))
    special = random.choice(
        ("", "", "", ", field along the axis", ", spin about the axis", ", spin about the field", ", free")
    )
    if "field along" in special:
        B = R @ third * size
    if special.endswith("about the axis"):
        w = third * w[0]
    if special.endswith("about the field"):
        w = B @ R * 1.1
    if special == ", free":
        B = np.zeros(3)
    motion = atlas.motion(start, B, w, R)
    ways, rate = _vectors("B", "omega", "a"), max(abs(B).max(), abs(w).max())
    axes = np.asarray(motion.axes)
    if motion.family == "asymmetric":
        ways = ways if B.any() else _vectors("omega", "a")
        ways |= {f"I{i + 1}": {"J": np.outer(axes[i], axes[i])} for i in range(3)}
    else:
        axis = E[2] if motion.family == "ball" else axes[2]
        ways["ratio"] = {"J": np.outer(axis, axis)}
    sizes = {name: rate if name[0] in "Bo" else 1.0 for name in ways}
    return Case(regime + special, motion, {"J": J, "B": B, "w": w, "R": R}, ways, sizes, _time(rate, random))


def turned_case(random: Random) -> Case:
    """Draw a symmetric body by its ratio, its moments or its tensor."""
    I = random.choice((1.0, 0.5, random.uniform(0.1, 2.0), 1 + random.choice((1, -1)) * 10 ** random.uniform(-6, -1)))
    order = random.randrange(3)
    moments, C = np.roll([1.0, 1.0, I], order), _rotation(random)
    tensor = C @ np.diag(moments) @ C.T
    tensor = (tensor + tensor.T) / 2
    forms = (
        ("by ratio", np.diag([1.0, 1.0, I]), I, E[2]),
        ("by moments", np.diag(moments), tuple(moments), np.roll(E[2], order)),
        ("by a tensor", tensor, tensor, C[:, (order + 2) % 3]),
    )
    name, J, start, third = random.choice(forms)
    return _in_laboratory(f"in the laboratory {name}", J, start, third, random)


def asymmetric(random: Random) -> Case:
    """Draw a body with three moments, which takes seconds."""
    regime = random.choice(list(ASYMMETRIC))
    moments = np.array(ASYMMETRIC[regime](random).inertia)
    return _in_laboratory(regime, np.diag(moments), tuple(moments), E[random.randrange(3)], random)


KINDS: Mapping[str, Callable[[Random], Case]] = {
    "general": general, "top": top, "turned": turned_case, "asymmetric": asymmetric,
}  # fmt: skip


def errors(case: Case, random: Random) -> Iterator[tuple[str, float]]:
    """Yield errors in parts of 1 + |v|, for changes of all inputs at once, and of each far from the start."""
    names, t = list(case.ways), np.array([case.t])
    shares = np.array([random.choice((1, -1)) * random.uniform(0.5, 2) * case.sizes[x] for x in names])
    way: dict[str, Any] = {}
    for name, share in zip(names, shares, strict=True):
        for key, change in case.ways[name].items():
            way[key] = way.get(key, 0.0) + share * np.asarray(change, float)
    true, vectors = followed(case, way), [case.motion.sensitivity(t, names)[0]]
    size = abs(shares) @ (1 + abs(vectors[0]).max(1))
    rate = 1 + max(np.abs(case.state["w"]).max(), np.abs(case.state["B"]).max())
    yield "R", np.abs(shares @ vectors[0] - true[0]).max() / size
    for i, start in enumerate(("angular_velocity", "field"), 1):
        change = case.motion.sensitivity(t, names, start)[0]
        yield start, np.abs(shares @ change - true[i]).max() / (size * rate + abs(shares) @ abs(change).max(1))
    derivatives = next(iter(vars(case.motion).get("_differentiated", {}).values()))
    varied = next((x for x in derivatives._varied.values() if hasattr(x, "differences")), None)
    if varied and not hasattr(case.motion, "own"):
        t = FAR * case.t
        varied_names = [x for x in derivatives.inputs.names if x in case.ways]
        apart = derivatives.inputs.varied(varied_names)
        change_at, true_far = case.motion.sensitivity(t, varied_names), apart.differences.at(t)[0]
        yield "R, far", (np.abs(change_at - true_far).max(1) / (1 + abs(true_far).max(1))).max()


def main() -> int:
    """Draw motions, and print the worst error of each regime."""
    parser = argparse.ArgumentParser(prog="stress.derivatives", description=__doc__.partition("\n")[0])
    parser.add_argument("--samples", type=int, default=40)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--kinds", nargs="+", choices=[*KINDS], default=["general", "top", "turned"])
    options = parser.parse_args()
    worst, refused = dict[tuple[str, str], float](), dict[str, int]()
    for kind in options.kinds:
        for i in range(options.samples):
            random = Random(f"{kind} {options.seed} {i}")  # noqa: S311  reproducible, not secret
            case = KINDS[kind](random)
            try:
                for start, error in errors(case, random):
                    key = case.regime, start
                    worst[key] = max(worst.get(key, 0.0), error if np.isfinite(error) else np.inf)
                    if not error <= BOUND:
                        click.echo(f"{error:.1e} of {start}: {kind} {options.seed} {i}, {case.regime}", err=True)
            except atlas.DomainError as error:
                refused[f"{case.regime}: {error}"] = refused.get(f"{case.regime}: {error}", 0) + 1
    for (regime, start), error in sorted(worst.items()):
        click.echo(f"{regime:64} {start:18} {error:.1e}")
    for why, count in sorted(refused.items()):
        click.echo(f"refused {count} times, {why}")
    return int(any(not error <= BOUND for error in worst.values()))


if __name__ == "__main__":
    sys.exit(main())
