"""Checks of kernels against balls: the promises of the register, and laws beside them.

`check` goes through the quantities of any family; grids and structure, which few have, are checked beside.
"""

from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from functools import partial
from itertools import chain
from typing import Any

import numpy as np
from ulps import BITS, ONE, absolute, approximate, error, of_length, own_ulps, rigidity

from atlas.arithmetic.certified_digits import enclosed
from atlas.motions.register import FAMILIES
from stress import extreme
from stress.extreme import described
from stress.worst import WorstErrors, with_more

Inputs = dict[str, Any]
Truth = Callable[[Callable[[], Any]], Any]
Where = Callable[[float], str]

SHIFTS = (1, -7, 60)
"""Powers of two by which all frequencies are scaled, and times the other way: no bit of R may change."""

GRIDS = 1500, 12_000
"""Matrices on uniform grids, too few and enough for tables; a few of them are checked."""


POINTS = 8
"""Points of each hyperbola."""


def close(function: Callable[[], Any]) -> Any:
    """Return numbers computed to the relative accuracy of the truth."""
    return enclosed(function, BITS)


def check(
    name: str,
    regime: str,
    values: Sequence[Any],
    worst: WorstErrors,
    inputs: Inputs,
    *,
    exactly: Sequence[Any] | None = None,
    times: Sequence[float] = (),
    region: Callable[[Any], Where] | None = None,
    unit: Callable[[str, float], float] | None = None,
    truth: Truth = close,
    more: Callable[[Any, Any, Where], None] | None = None,
) -> None:
    """Check an object of a family made of `values`, by balls made of `exactly` where that differs.

    Numbers are checked in ulps of themselves, matrices in ulps of 1, vectors in ulps of their length, or of
    `unit(name, t)`. `region` gives by the balls the name of the regime of a time; `more` makes further checks.
    """
    family = FAMILIES[name]
    with worst.checking(name, regime, inputs):
        exact, kernel = family.balls()(*(exactly or values)), family.kernels()(*values)
        for q in family.quantities:
            if q.checked:
                true = enclosed(lambda q=q: list(_flat(q.value(exact, exact=True))), BITS)  # type: ignore[misc]
                worst.add(q.checked, regime, own_ulps(np.ravel(q.value(kernel)), true), with_more(inputs))
        place = region(exact) if region else lambda _: regime
        for s in family.sampled:
            for t, value in zip(
                times, s.method_of(kernel)(np.array(times)) if s.checked else (), strict=bool(s.checked)
            ):
                true = truth(partial(s.method_of(exact), t))
                if s.matrix:
                    errors = absolute(value.flat, chain(*true))
                elif unit:
                    errors = [error(x, y, unit(s.name, t)) for x, y in zip(value, true, strict=True)]
                else:
                    errors = [of_length(value, true)]
                worst.add(s.checked, place(t), errors, with_more(inputs, t=t.hex()))
        if more:
            more(kernel, exact, place)


def by_clock(regime: str, *rates: str | float) -> Callable[[Any], Where]:
    """Return a function that names the regime of a time by its largest phase over rates, quantities or numbers."""

    def region(exact: Any) -> Where:
        sizes = (x if isinstance(x, float) else approximate(enclosed(partial(getattr, exact, x), BITS)) for x in rates)
        fastest = max(map(abs, sizes))
        return lambda t: f"{regime}, {extreme.clock(fastest, t)}"

    return region


def check_motion(motion: extreme.Motion, regime: str, worst: WorstErrors) -> None:
    """Check an elementary motion: beside the register, columns, small entries, structure and grids."""
    inputs, times = described(motion), motion.times
    field_and_start = (motion.B2, motion.B3), motion.omega2, motion.omega3

    def compare_more(kernel: Any, exact: Any, where: Where) -> None:
        at = np.array(times)
        R, axis, columns = kernel.rotation(at), kernel.third_axis(at), [kernel.column(j, at) for j in (1, 2)]
        slow = abs(approximate(enclosed(lambda: exact.k, BITS)))
        for i, t in enumerate(times):
            true = enclosed(partial(exact.rotation, t), BITS)
            first, second, third = ([row[j] for row in true] for j in range(3))
            errors = {
                "columns 1, 2": absolute(columns[0][i], first) + absolute(columns[1][i], second),
                "third axis": absolute(axis[i], third),
            }
            if i % 6 == 5:
                errors["R at one time"] = absolute(kernel.rotation(t).flat, chain(*true))
            if abs(slow * t) < 1:
                errors["R13, R23 for |kt| < 1"] = own_ulps([*R[i, :2, 2], *axis[i, :2]], third[:2] * 2)
            for name, values in errors.items():
                worst.add(name, where(t), values, with_more(inputs, t=t.hex()))
        start = np.abs(kernel.rotation(np.array([0.0, -0.0])) - np.eye(3)).max() / ONE
        worst.add("R(0) = 1", regime, [float(start)], with_more(inputs))
        _scaling(motion, kernel, regime, worst, inputs)
        for name, defects in zip(("R orthogonality", "R determinant"), rigidity(R), strict=True):
            worst.add(name, regime, defects, lambda i: inputs | {"t": times[i].hex()})
        for count in GRIDS:
            step = (times[5] - times[4]) / count
            if step and times[4] + count * step != times[4]:
                places = (0, 1, 63, 64, count // 3, count - 33, count - 32, count - 1)
                on_grid("R grid", kernel, exact, (times[4], step, count), places, regime, worst, inputs)

    clock = by_clock(regime, "k", "phi")
    values, exactly = (motion.ratio, *field_and_start), (motion.exact_ratio, *field_and_start)
    check("elementary", regime, values, worst, inputs, exactly=exactly, times=times, region=clock, more=compare_more)


def _scaling(motion: extreme.Motion, kernel: Any, regime: str, worst: WorstErrors, inputs: Inputs) -> None:
    """Check that R does not change when all frequencies are scaled by a power of two."""
    times, make = np.array(motion.times), FAMILIES["elementary"].kernels()
    components = (motion.B2, motion.B3, motion.omega2, motion.omega3 or 0.0)
    for shift in SHIFTS:
        B2, B3, omega2, omega3 = (float(np.ldexp(x, shift)) for x in components)
        slow = np.ldexp(times, -shift)
        if any(np.ldexp(x, -shift) != y for x, y in zip((B2, B3, omega2, omega3), components, strict=True)):
            continue  # a part would leave the range of doubles
        exactly = np.ldexp(slow, shift) == times
        scaled_motion = make(motion.ratio, (B2, B3), omega2, None if motion.omega3 is None else omega3)
        # the same number of times in both: a matrix product may round its last rows in another way
        before, after = kernel.rotation(times[exactly]), scaled_motion.rotation(slow[exactly])
        normal = np.abs(before) >= np.finfo(float).tiny  # smaller entries have lost bits to underflow
        changed = np.abs(after - before).max(initial=0.0, where=normal) / ONE
        worst.add("R under scaling by 2^n", regime, [float(changed)], with_more(inputs, n=shift))


def on_grid(
    name: str, kernel: Any, exact: Any, grid: tuple[float, float, int], places: Iterable[int], regime: str,
    worst: WorstErrors, inputs: Inputs, truth: Truth = close,
) -> None:  # fmt: skip
    """Check a uniform grid (start, step, count) at a few of its exact times start + i step."""
    start, step, count = grid
    R = kernel.rotation_grid(start, step, count)
    for i in places:
        true = truth(partial(exact.rotation, Fraction(start) + i * Fraction(step)))
        grid_inputs = ({"start": start.hex()} if start else {}) | {"step": step.hex(), "count": count, "index": i}
        worst.add(name, regime, absolute(R[i].flat, chain(*true)), with_more(inputs, **grid_inputs))


def check_hyperbola(motion: extreme.Motion, regime: str, worst: WorstErrors) -> None:
    """Check the hyperbola at the motion's omega2: ordinate, frequencies, stability; and points of it."""
    inputs, w2, field = described(motion), motion.omega2, (motion.B2, motion.B3)
    if w2 == -motion.B2 or motion.B2 == 0:
        return

    def compare_more(kernel: Any, exact: Any, _: Where) -> None:
        k, phi = kernel.frequencies(w2)
        true_k, true_phi = enclosed(lambda: exact.frequencies(w2), BITS)
        pairs = (
            ("omega3 of the hyperbola", kernel.omega3(w2), exact.omega3(w2)),
            ("k of the hyperbola", k, true_k),
            ("phi of the hyperbola", phi, true_phi),
            ("stability", kernel.stability(w2), exact.stability(w2)),
        )
        for name, value, true in pairs:
            worst.add(name, regime, own_ulps([value], [true]), with_more(inputs))
        if motion.B3:
            points = [(x, y) for x, y in zip(*kernel.sample(POINTS), strict=True) if np.isfinite(y)]
            errors = own_ulps((y for _, y in points), (exact.omega3(x) for x, _ in points))
            worst.add("points of the hyperbola", regime, errors, lambda i: inputs | {"at": float(points[i][0]).hex()})

    exactly = motion.exact_ratio, field
    check("hyperbola", regime, (motion.ratio, field), worst, inputs, exactly=exactly, more=compare_more)


def check_quadric(motion: extreme.Motion, regime: str, worst: WorstErrors) -> None:
    """Check the quadric of the motion's body and field."""
    field = motion.B2, motion.B3
    exactly = motion.exact_ratio, field
    check("quadric", regime, (motion.ratio, field), worst, described(motion), exactly=exactly)


def check_free(motion: extreme.Free, worst: WorstErrors) -> None:
    """Check a free body with any initial angular velocity."""
    clock = by_clock("free body", "k", "phi")
    check("free", "free body", (motion.I, motion.omega), worst, described(motion), times=motion.times, region=clock)


def check_ball(ball: extreme.Ball, worst: WorstErrors) -> None:
    """Check a charged ball: axis, frequency, matrix, momentum."""
    values, clock = (ball.inertia, ball.larmor, (ball.m2, ball.m3)), by_clock("ball", "gamma", "larmor")
    check("ball", "ball", values, worst, described(ball), times=ball.times, region=clock)


def check_particle(particle: extreme.Particle, worst: WorstErrors) -> None:
    """Check a point charge, in ulps of the largest length (speed) that its start and its forces make by that time."""
    p = particle
    pull, speed = (float(np.linalg.norm(x)) for x in (np.multiply(p.mu, p.E), p.velocity))

    def unit(name: str, t: float) -> float:
        fast = speed + abs(t) * pull
        reach = float(np.linalg.norm(p.position) + abs(t) * fast)
        return float(np.spacing(reach if name == "position" else fast))

    values, clock = (p.mu, p.E, p.B, p.position, p.velocity, p.c), abs(p.mu) * float(np.linalg.norm(p.B))
    check(
        "particle",
        "particle",
        values,
        worst,
        described(p),
        times=p.times,
        region=by_clock("particle", clock),
        unit=unit,
    )


def _flat(value: Any) -> Any:
    """Go through the numbers of nested tuples and lists."""
    return chain(*map(_flat, value)) if isinstance(value, list | tuple) else [value]
