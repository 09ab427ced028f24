"""The spectral curve of a motion: its numbers against mpmath, and against the motion."""

import json
from typing import Any

import mpmath
import numpy as np
import pytest
from click.testing import CliRunner

import atlas
from atlas.cli.app import atlas as command
from atlas.errors import AtlasError, DomainError

BODY, FIELD, OMEGA = (0.8, 1.0, 1.3), (0.2, 1.0, 0.6), (0.3, 0.7, 0.2)
TYPED = "motion --inertia 0.8 1 1.3 --field 0.2 1 0.6 --omega 0.3 0.7 0.2 --curve --decimal --json"


@pytest.fixture(scope="module")
def found() -> dict[str, Any]:
    """Return what the command prints, with 40 digits, of the decimals as typed."""
    result = CliRunner().invoke(command, [*TYPED.split(), "--digits", "40"])
    assert result.exit_code == 0, result.output
    return dict(json.loads(result.stdout)["curve"])


def complex_of(pair: list[str]) -> mpmath.mpc:
    """Read a pair of texts."""
    return mpmath.mpc(*map(mpmath.mpf, pair))


def test_branch_points_lie_on_the_curve(found: dict[str, Any]) -> None:
    """At each v^2 = P(z) and g(z) + 2 c v = 0, of coefficients made here of the inputs, within their digits."""
    with mpmath.workdps(60):
        I, K, W = (
            [mpmath.mpf(x) for x in several]
            for several in (("0.8", "1", "1.3"), ("0.2", "1", "0.6"), ("0.5", "1.7", "0.8"))
        )
        M = [x * w for x, w in zip(I, W, strict=True)]
        D, e2 = I[0] * I[1] * I[2], I[0] * I[1] + I[0] * I[2] + I[1] * I[2]
        H = sum(m * m / x + x * k * k for m, x, k in zip(M, I, K, strict=True)) / 2
        F = sum(m * m for m in M) - sum(D * k * k / x for x, k in zip(I, K, strict=True))
        c, b2 = sum(m * k for m, k in zip(M, K, strict=True)), sum(k * k for k in K)
        assert len(found["branch_points"]) == 4
        for point in found["branch_points"]:
            z, v = map(complex_of, point)
            assert abs(v * v - (z + D / I[0]) * (z + D / I[1]) * (z + D / I[2])) < 1e-36
            assert abs(b2 * z * z + (F + e2 * b2) * z + 2 * D * H + 2 * c * v) < 1e-36


def test_periods_and_frequencies_belong_together(found: dict[str, Any]) -> None:
    """(f1, f2) is dual to the periods; f3 turns R about B: what is left of K's turn in the laboratory has f1 and f2."""
    motion = atlas.AsymmetricMotion(BODY, FIELD, OMEGA)
    f = np.array([float(x) for x in found["frequencies"]])
    assert f == pytest.approx(motion.frequencies, rel=1e-13)
    assert [float(x) for x in found["winding_numbers"]] == pytest.approx((f[1:] / f[0]).tolist(), rel=1e-13)
    (p, q), b = [[float(x) for x in one] for one in found["periods"]], np.linalg.norm(FIELD)
    turns = [one[2] - 2 * np.pi * round(one[2] / (2 * np.pi)) for one in (p, q)]
    G = np.linalg.solve([p[:2], q[:2]], np.column_stack([[2 * np.pi, 0], [0, 2 * np.pi], turns]))
    assert G[0] - [0, 0, b] == pytest.approx(f, rel=1e-12)


def test_the_riemann_matrix_is_that_of_the_motion(found: dict[str, Any]) -> None:
    """It is symmetric with a positive imaginary part, the one that the kernel sums with; it is not called proved."""
    tau = np.array([[complex(complex_of(x)) for x in row] for row in found["not_proved"]["riemann_matrix"]])
    assert tau == pytest.approx(tau.T, abs=1e-28)
    assert (np.linalg.eigvalsh(tau.imag) > 0).all()
    assert tau == pytest.approx(atlas.AsymmetricMotion(BODY, FIELD, OMEGA).riemann_matrix, abs=1e-12)


def test_more_digits_begin_with_fewer(found: dict[str, Any]) -> None:
    """Digits of 20 are those of 40, but for the last, which is rounded; in Python they are those of the doubles."""
    short = atlas.AsymmetricMotion(BODY, FIELD, OMEGA).curve.record(14)
    for name in ("frequencies", "winding_numbers"):
        for one, more in zip(short[name], found[name], strict=True):
            assert float(one) == pytest.approx(float(more), rel=2e-13)


def test_what_has_no_torus_has_no_curve() -> None:
    """A symmetric body, a motion at rest, an array: each is told."""
    for inertia, omega in (((1.0, 1.0, 1.3), OMEGA), (BODY, (0.0, 0.0, 0.0))):
        with pytest.raises(DomainError, match="no torus with a spectral curve"):
            _ = atlas.AsymmetricMotion(inertia, FIELD, omega).curve
    with pytest.raises(AtlasError, match="one motion"):
        _ = atlas.AsymmetricMotion(BODY, FIELD, (np.array([0.3, 0.4]), 0.7, 0.2)).curve
