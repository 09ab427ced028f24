"""Bodies with three moments, ordinary and extreme: reduced and direct ways (`make stress`)."""

from random import Random

import pytest
from flint import arb, ctx
from stress.asymmetric import ASYMMETRIC, size_of
from values import EXAMPLES

import atlas
from atlas.motions.torus import certified as asymmetric


@pytest.mark.skipif(not EXAMPLES, reason="a minute for each: in make stress")
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("kind", ASYMMETRIC)
def test_values_by_periods_and_by_taylor_series_agree(kind: str, seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """R at 60 units of 1/rate by the periods, and by Taylor series all the way, 20 digits of both; or not certified."""
    draw = ASYMMETRIC[kind](Random(f"{kind} {seed}"))  # noqa: S311  reproducible, not secret
    t = 60 / size_of(draw)
    with ctx.workprec(110):
        try:
            reduced = asymmetric.AsymmetricMotion(*draw).rotation(t)
        except atlas.NotCertifiedError as reason:
            pytest.xfail(str(reason))
        monkeypatch.setattr(asymmetric, "MAX_DIRECT_TIME", 100)
        direct = asymmetric.AsymmetricMotion(*draw).rotation(t)
        pairs = [
            (x, y)
            for row, row_direct in zip(reduced, direct, strict=True)
            for x, y in zip(row, row_direct, strict=True)
        ]
        assert all(arb(x).overlaps(arb(y)) and arb(x).rad() < 1e-20 for x, y in pairs)
