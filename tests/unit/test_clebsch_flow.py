"""The flow of a body with three moments by Taylor series: its error is proved, and what is stated of it."""

from typing import Any

import numpy as np
import pytest
from flint import ctx, fmpq

from atlas.errors import NotCertifiedError
from atlas.exact.motions import clebsch_flow
from atlas.exact.motions.clebsch_flow import Flow

BODIES = {
    "quick": ((1.0, 0.6875, 0.625), (1.75, -0.4375, 1.0625), (1.25, -0.75, 0.875)),
    "flat": ((1.0, 2.0, 3.0), (0.75, 0.125, 1.25), (0.25, -0.5, 0.5)),
    "rod": ((1.0, 1.001, 0.01), (2.4375, 0.9375, -1.875), (1.375, -0.25, -1.0)),
    "still": ((1.0, 0.75, 0.5), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
}
"""Moments, W = Omega + K, and K."""


def flow(name: str) -> Flow:
    """Return the flow of a body."""
    return Flow(*([fmpq(*x.as_integer_ratio()) for x in part] for part in BODIES[name]))


@pytest.mark.parametrize(
    ("name", "times", "bits", "steps", "state", "turn"),
    [
        ("quick", (3, -2), 128, 14, 7.90339e5, 1.56101e6),
        ("flat", (-2, fmpq(1, 2)), 192, 14, 5.49572e5, 8.41054e5),
        ("rod", (0, 3), 96, 49, 1.58129e6, 3.27915e6),
        ("quick", (fmpq(1, 1000), 0), 100, 1, 5233, 677.3),
        ("still", (8, 1), 128, 4, 2.857e5, 7.179e8),
    ],
)
def test_the_error_of_a_way_is_what_is_stated(
    name: str, times: tuple[Any, Any], bits: int, steps: int, state: float, turn: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """So many steps, and radii, in units, of (W, K) and of q: no less than what a way with 120 more bits differs by."""
    count, step = [0], clebsch_flow._Way.step
    H, F = map(fmpq, times)
    with monkeypatch.context() as patch:
        patch.setattr(clebsch_flow._Way, "step", lambda way: (count.append(0), step(way))[1])
        found = flow(name).go(H, F, bits)
    true = flow(name).go(H, F, bits + 120, proven=False)
    assert len(count) - 1 == steps
    with ctx.workprec(bits + 200):
        for part, radius in (("W", state), ("K", state), ("q", turn)):
            for x, y in zip(getattr(found, part), getattr(true, part), strict=True):
                assert abs(x.mid() - y.mid()) <= x.rad()
                assert float(x.rad()) * 2.0**bits == pytest.approx(radius, rel=1e-3)


def test_errors_that_grow_too_far_are_said() -> None:
    """In steps of few bits errors beyond a fourth of the bits have no bound; nor have steps that are too many."""
    with pytest.raises(NotCertifiedError, match="grow beyond their bounds"):
        flow("quick").go(fmpq(1), fmpq(0), 60)


def test_a_way_of_too_many_steps_is_not_gone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of one with fourteen steps the limit may be fourteen, not thirteen."""
    monkeypatch.setattr(clebsch_flow, "MOST", 14)
    flow("quick").go(fmpq(3), fmpq(-2), 128, proven=False)
    monkeypatch.setattr(clebsch_flow, "MOST", 13)
    with pytest.raises(NotCertifiedError, match="more than 13 steps"):
        flow("quick").go(fmpq(3), fmpq(-2), 128, proven=False)


def test_the_derivative_of_a_step_is_within_its_bound() -> None:
    """That of (W, K) after h = 1/8 by differences of starts that are 2^-90 apart."""
    h, bits, start = fmpq(1, 8), 128, flow("quick").start
    way = clebsch_flow._Way(flow("quick").rates(fmpq(1), fmpq(2)), [int(x * 2**bits) for x in start], bits, proven=True)
    rows = way._series(h)
    found, bound = way._derivative(rows, h, 4.0)
    true = np.empty((6, 6))
    with ctx.workprec(400):
        for i in range(6):
            ends = []
            for sign in (1, -1):
                near = [x + sign * fmpq(int(i == j), 2**90) for j, x in enumerate(start)]
                end = Flow(flow("quick").moments, near[:3], near[3:]).go(h, 2 * h, 300, proven=False)
                ends.append([*end.W, *end.K])
            true[:, i] = [float((x - y) * 2**89) for x, y in zip(*ends, strict=True)]
    assert np.linalg.norm(found - true) < bound
    assert bound == pytest.approx(2.91432e-10, rel=1e-3)
