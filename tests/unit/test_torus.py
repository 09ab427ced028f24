"""Periods of the torus of a body with three moments: how narrow they are proved, and by which way."""

import json
from functools import cache
from typing import Any

import mpmath
import numpy as np
import pytest
from click.testing import CliRunner
from flint import arb

import atlas
from atlas.arithmetic.numbers import workprec
from atlas.cli.app import atlas as command
from atlas.errors import AtlasError, DomainError, NotCertifiedError
from atlas.motions.torus import certified_torus as torus
from atlas.motions.torus.certified import AsymmetricMotion
from atlas.motions.torus.certified_torus import Torus

QUICK = (1.0, 0.6875, 0.625), (1.25, -0.75, 0.875), (0.5, 0.3125, 0.1875)


@cache
def torus_kept() -> Torus:
    """Return the torus of a motion whose periods are short beside its rates."""
    motion = AsymmetricMotion(*QUICK).on_torus
    assert motion is not None
    return motion.torus


def torus_copy() -> Torus:
    """Return it without cached values but for the lattice."""
    torus = Torus(torus_kept().moments, torus_kept().W, torus_kept().K)
    torus.__dict__["lattice"] = torus_kept().lattice
    return torus


def radii(torus: Torus, bits: int) -> list[float]:
    """Return the radii of both periods and of their angles in units of 2^-bits."""
    return [
        float(x.rad() * arb(2) ** bits) for period in torus.periods(bits) for x in (period.H, period.F, period.angle)
    ]


def test_a_period_that_is_too_long_is_tried_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """With GOOD bits at last; that fewer do not do is known then, and more are tried when they are asked for."""
    found, tried = torus_copy(), list[int]()

    def without_path(_torus: Torus, _start: Any, bits: int) -> Any:
        tried.append(bits)
        raise NotCertifiedError("not certified: too long.")

    monkeypatch.setattr(Torus, "_enclosed", without_path)
    for bits in (128, 160, torus.PERIOD_BITS, 2 * torus.PERIOD_BITS, 2 * torus.PERIOD_BITS):
        with pytest.raises(NotCertifiedError, match="too long"):
            found.periods(bits)
    assert tried == [128, torus.PERIOD_BITS, 2 * torus.PERIOD_BITS]


@pytest.mark.slow
def test_more_bits_come_by_newtons_method(monkeypatch: pytest.MonkeyPatch) -> None:
    """Beyond GOOD bits a start is improved, each time to nearly twice the bits; a way without a proof costs less."""
    true, gone, real = torus_kept().periods(128), list[tuple[int, bool]](), torus.Flow.go

    def go(flow: Any, H: Any, F: Any, bits: int, *, proven: bool = True) -> Any:
        gone.append((bits, proven))
        return real(flow, H, F, bits, proven=proven)

    monkeypatch.setattr(torus.Flow, "go", go)
    monkeypatch.setattr(torus, "PERIOD_BITS", 96)
    monkeypatch.setattr(torus, "FIRST_FLOW_BITS", 90)
    periods = torus_copy().periods(150)
    assert gone == [(90, False), (140, False), (200, True)] * 2
    for x, y in zip(periods, true, strict=True):
        assert all(p.overlaps(q) and p.rad() < q.rad() for p, q in ((x.H, y.H), (x.F, y.F), (x.angle, y.angle)))


BODY, FIELD, OMEGA = (0.8, 1.0, 1.3), (0.2, 1.0, 0.6), (0.3, 0.7, 0.2)
TYPED = "motion --inertia 0.8 1 1.3 --field 0.2 1 0.6 --omega 0.3 0.7 0.2 --curve --decimal --json"


@pytest.fixture(scope="module")
def numbers() -> dict[str, Any]:
    """Return the command's output, with 40 digits, of the decimals as typed."""
    result = CliRunner().invoke(command, [*TYPED.split(), "--digits", "40"])
    assert result.exit_code == 0, result.output
    return dict(json.loads(result.stdout)["curve"])


def complex_of(pair: list[str]) -> mpmath.mpc:
    """Read a pair of texts."""
    return mpmath.mpc(*map(mpmath.mpf, pair))


def test_branch_points_lie_on_the_curve(numbers: dict[str, Any]) -> None:
    """At each v^2 = P(z) and g(z) + 2 c v = 0, of coefficients made here of the inputs, within their digits."""
    with mpmath.workdps(60):
        I, K, W = (
            [mpmath.mpf(x) for x in triple]
            for triple in (("0.8", "1", "1.3"), ("0.2", "1", "0.6"), ("0.5", "1.7", "0.8"))
        )
        M = [x * w for x, w in zip(I, W, strict=True)]
        D, e2 = I[0] * I[1] * I[2], I[0] * I[1] + I[0] * I[2] + I[1] * I[2]
        H = sum(m * m / x + x * k * k for m, x, k in zip(M, I, K, strict=True)) / 2
        F = sum(m * m for m in M) - sum(D * k * k / x for x, k in zip(I, K, strict=True))
        c, b2 = sum(m * k for m, k in zip(M, K, strict=True)), sum(k * k for k in K)
        assert len(numbers["branch_points"]) == 4
        for point in numbers["branch_points"]:
            z, v = map(complex_of, point)
            assert abs(v * v - (z + D / I[0]) * (z + D / I[1]) * (z + D / I[2])) < 1e-36
            assert abs(b2 * z * z + (F + e2 * b2) * z + 2 * D * H + 2 * c * v) < 1e-36


@pytest.mark.slow
def test_periods_and_frequencies_belong_together(numbers: dict[str, Any]) -> None:
    """(f1, f2) is dual to the periods; f3 turns R about B: the other turn of K in the laboratory has f1 and f2."""
    motion = atlas.AsymmetricMotion(BODY, FIELD, OMEGA)
    f = np.array([float(x) for x in numbers["frequencies"]])
    assert f == pytest.approx(motion.frequencies, rel=1e-13)
    assert [float(x) for x in numbers["winding_numbers"]] == pytest.approx((f[1:] / f[0]).tolist(), rel=1e-13)
    (p, q), b = [[float(x) for x in period] for period in numbers["periods"]], np.linalg.norm(FIELD)
    turns = [period[2] - 2 * np.pi * round(period[2] / (2 * np.pi)) for period in (p, q)]
    G = np.linalg.solve([p[:2], q[:2]], np.column_stack([[2 * np.pi, 0], [0, 2 * np.pi], turns]))
    assert G[0] - [0, 0, b] == pytest.approx(f, rel=1e-12)


def test_the_riemann_matrix_agrees_with_the_motion(numbers: dict[str, Any]) -> None:
    """Two paths give each entry beside the diagonal, to all digits; it is the one that the kernel sums with."""
    assert "riemann_matrix" not in numbers["not_proved"]
    with mpmath.workdps(60):
        (a, b), (c, d) = ([complex_of(x) for x in row] for row in numbers["riemann_matrix"])
        assert abs(b - c) < 1e-39
    tau = np.array([[complex(x) for x in row] for row in ((a, b), (c, d))])
    assert (np.linalg.eigvalsh(tau.imag) > 0).all()
    assert tau == pytest.approx(atlas.AsymmetricMotion(BODY, FIELD, OMEGA).riemann_matrix, abs=1e-12)


@pytest.mark.parametrize(
    ("inertia", "field", "omega"),
    [
        pytest.param((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), (3.0, 0.7, 0.2), marks=pytest.mark.slow),
        ((822.0, 857.0, 1150.0), (-2.8e-4, 1.29e-3, 1.0e-3), (-5.42e-3, -3.78e-3, -3.5e-4)),
        pytest.param((0.79, 0.86, 1.28), (-0.12, 2.1, -1.1), (-0.76, 4.1, 1.3), marks=pytest.mark.slow),
    ],
)
def test_actions_and_riemann_matrix_agree_with_the_motion(inertia: Any, field: Any, omega: Any) -> None:
    """In any units, also where paths are long: means over the torus, and the matrix that the kernel sums with."""
    motion = atlas.AsymmetricMotion(inertia, field, omega)
    record = motion.curve.record(16)
    assert [float(x) for x in record["actions"]] == pytest.approx(motion.actions.values, rel=1e-12)
    tau = np.array([[complex(*map(float, x)) for x in row] for row in record["riemann_matrix"]])
    assert tau == pytest.approx(motion.riemann_matrix, abs=1e-12)


@pytest.mark.slow
def test_actions_have_as_many_digits_as_are_asked_for() -> None:
    """On paths that leave a cell of wp too, whose ends are first known to some 50 digits."""
    curve = atlas.AsymmetricMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), (3.0, 0.7, 0.2)).curve
    with workprec(500):
        assert min(J.rel_accuracy_bits() for J in curve.actions) > 490


@pytest.mark.slow
def test_more_digits_begin_with_fewer(numbers: dict[str, Any]) -> None:
    """Digits of 20 are those of 40, but for the last, which is rounded; in Python they are those of the doubles."""
    short = atlas.AsymmetricMotion(BODY, FIELD, OMEGA).curve.record(14)
    for name in ("frequencies", "winding_numbers"):
        for digits_short, digits_long in zip(short[name], numbers[name], strict=True):
            assert float(digits_short) == pytest.approx(float(digits_long), rel=2e-13)


def test_motions_without_a_torus_have_no_curve() -> None:
    """A symmetric body, a motion at rest, an array: each is told."""
    for inertia, omega in (((1.0, 1.0, 1.3), OMEGA), (BODY, (0.0, 0.0, 0.0))):
        with pytest.raises(DomainError, match="no torus with a spectral curve"):
            _ = atlas.AsymmetricMotion(inertia, FIELD, omega).curve
    with pytest.raises(AtlasError, match="one motion"):
        _ = atlas.AsymmetricMotion(BODY, FIELD, (np.array([0.3, 0.4]), 0.7, 0.2)).curve


def test_frequencies_of_a_torus_without_a_lattice_are_positive() -> None:
    """Real periods alone, whose signs came by chance: f1 and f2 by either of their pairs."""
    for sign in (1, -1):
        found = Torus(torus_kept().moments, torus_kept().W, torus_kept().K)
        found._no_lattice = "none"
        (H1, F1), (H2, F2) = torus._signed([(sign * x, sign * y) for x, y in found._approximate()])
        area = H1 * F2 - H2 * F1
        assert F2 / area > 0 > F1 / area
        assert found._approximate() == [(H1, F1), (H2, F2)]
