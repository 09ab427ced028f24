"""Bodies with three moments, ordinary and hostile: reduced and direct ways, closed form and twin (`make stress`)."""

from fractions import Fraction
from random import Random

import numpy as np
import pytest
from flint import arb, ctx, fmpq
from values import EXAMPLES

import atlas
from atlas.core.asymmetric import SingleAsymmetric
from atlas.exact import asymmetric

KINDS = (
    *("ordinary", "nearly symmetric", "weak field", "strong field", "fast spin", "flat", "rod", "field along an axis"),
    *("nearly at rest", "disk"),
)


def drawn(kind: str, random: Random) -> list[list[fmpq]]:
    """Return moments, field and initial angular velocity, exact."""
    x, y, z = (random.uniform(0.05, 1) for _ in range(3))
    I = [y + z, x + z, x + y]
    B, w = ([random.uniform(-1.5, 1.5) for _ in range(3)] for _ in range(2))
    I = {
        "nearly symmetric": [I[0], I[0] * (1 + 2.0 ** -random.choice((4, 8, 12))), I[2]],
        "flat": [I[0], I[1], I[0] + I[1]],
        "rod": [1.0, 1.003, 10 ** random.uniform(-2, -1)],
        "disk": [1.0, 1.25, 2.0],
    }.get(kind, I)
    if kind == "field along an axis":
        B = [0.0, 0.0, B[2]]
    size = {"weak field": (-4, -1), "strong field": (1, 2)}.get(kind, (0, 0))
    spin = {"nearly at rest": (-5, -2), "fast spin": (1, 2)}.get(kind, (0, 0))
    vectors = (I, [b * 10 ** random.uniform(*size) for b in B], [v * 10 ** random.uniform(*spin) for v in w])
    return [[fmpq(*Fraction(value).as_integer_ratio()) for value in vector] for vector in vectors]


@pytest.mark.skipif(not EXAMPLES, reason="a minute for each: in make stress")
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("kind", KINDS)
def test_both_ways_meet(kind: str, seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """R at 60 units of 1/rate by the periods, and by Taylor series all the way, 20 digits of both; or not certified."""
    moments, field, start = drawn(kind, Random(f"{kind} {seed}"))  # noqa: S311  reproducible, not secret
    t = 60 / max(abs(x) for x in field + start)
    with ctx.workprec(110):
        try:
            reduced = asymmetric.AsymmetricMotion(moments, field, start).rotation(t)
        except atlas.NotCertifiedError as reason:
            pytest.xfail(str(reason))
        monkeypatch.setattr(asymmetric, "DIRECT", 100)
        direct = asymmetric.AsymmetricMotion(moments, field, start).rotation(t)
        pairs = [(x, y) for row, other in zip(reduced, direct, strict=True) for x, y in zip(row, other, strict=True)]
        assert all(arb(x).overlaps(arb(y)) and arb(x).rad() < 1e-20 for x, y in pairs)


DRAWN = [("ordinary", seed) for seed in range(100)] + [(kind, seed) for seed in range(5) for kind in KINDS[1:]][:40]


@pytest.mark.skipif(not EXAMPLES, reason="half a minute for each: in make stress")
@pytest.mark.parametrize(("kind", "seed"), DRAWN)
def test_the_closed_form_is_the_certified_twin(kind: str, seed: int) -> None:
    """R, K and Omega at 200 times up to 1e12 units of 1/rate, within 16 ulp; or no closed form, by name and reason."""
    random = Random(f"{kind} {seed}")  # noqa: S311  reproducible, not secret
    one = SingleAsymmetric(asymmetric.AsymmetricMotion(*drawn(kind, random)))
    if one.closed is None:
        pytest.xfail(one.agreement)
    times = np.array([random.choice((-1, 1)) * 10 ** random.uniform(-1, 12) for _ in range(200)]) / one.size
    for name, size in (("rotation", 1.0), ("field_in_body", one.size), ("angular_velocity", one.size)):
        apart = np.abs(getattr(one.closed, name)(times) - getattr(one.certified, name)(times))
        assert apart.max() <= min(16 * 2.0**-52, one.closed.accuracy) * size
