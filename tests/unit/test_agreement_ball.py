"""Charged ball: core and exact agree with the ledger's (26) to (30)."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import sympy
from agreement import Floor, Ledger, Tie, agree, each, length, letters, matrices, of, signed, unit

from atlas.trial.proofs.model import rodrigues


def launches(seed: int, count: int, *, is_along: bool = False) -> list[Any]:
    """Return balls: inertia I0, Larmor frequency alpha, momentum (m2, m3) of either sign; m2 = 0 if `is_along`."""
    draw, points = np.random.default_rng(seed), []
    for _ in range(count):
        I0, alpha, m2, m3 = abs(signed(draw)), signed(draw), 0.0 if is_along else signed(draw), signed(draw)
        points.append(SimpleNamespace(I0=I0, alpha=alpha, m2=m2, m3=m3, t=5 * signed(draw)))
    return points


POINTS = launches(38, 8)
ALONG = launches(40, 5, is_along=True)
REST = [SimpleNamespace(I0=1.5, alpha=alpha, m2=0.0, m3=-1.5 * alpha, t=3.1) for alpha in (0.75, -2.0)]
SAME_SENSE = [p for p in launches(41, 40, is_along=True) if p.alpha > 0 and p.m3 > 0][:5]


def motion(f: Floor, p: Any) -> Any:
    """Return the motion of a point on a floor."""
    return f.BallMotion(p.I0, p.alpha, (p.m2, p.m3))


def about_z(angle: Any) -> Any:
    """Return the turn about e3 by an angle."""
    return rodrigues(sympy.Matrix([0, 0, 1]), sympy.cos(angle), sympy.sin(angle))


def constants(say: Ledger, p: Any) -> dict[str, Any]:
    """Return gamma, k2 and k3 of (29)."""
    return {name: say("(29)", name, **letters(p, "m2 m3 alpha I0")) for name in ("gamma", "k2", "k3")}


def rotation(say: Ledger, p: Any, t: Any) -> Any:
    """Return R(t) of (28)."""
    return say("(28)", "R", alpha=p.alpha, t=t, **constants(say, p))


def momentum(say: Ledger, p: Any) -> Any:
    """Return m(t) of (26)."""
    return say("(26)", "m", **letters(p, "alpha t m2 m3"))


def spin(say: Ledger, p: Any) -> Any:
    """Return Omega(t), from m = I0 R Omega."""
    return rotation(say, p, p.t).T * momentum(say, p) / sympy.Rational(p.I0)


MATRIX = "(28) (29)"

of_motion = of(motion, POINTS)

TIES = (
    of_motion("BallMotion.gamma", "(29)", lambda say, p: constants(say, p)["gamma"]),
    of_motion(
        "BallMotion.gamma",
        "text-ball-parallel",
        lambda say, p: say("text-ball-parallel", "gamma", **letters(p, "alpha m3 I0")),
        [*SAME_SENSE, *REST],
    ),
    of_motion(
        "BallMotion.k_hat", "(29)", lambda say, p: [constants(say, p)[name] for name in ("k2", "k3")], size=length
    ),
    of_motion("BallMotion.k_hat", "(29)", lambda say, p: [constants(say, p)[name] for name in ("k2", "k3")], ALONG),
    of_motion(
        "BallMotion.k_hat",
        "text-ball-parallel",
        lambda say, _: say("text-ball-parallel", "axis")[1:],
        SAME_SENSE,
    ),
    *matrices("BallMotion", MATRIX, motion, rotation, POINTS),
    of_motion(
        "BallMotion.rotation", "(30)", lambda say, p: say("(30)", "R", **letters(p, "m3 I0 t")), ALONG, size=unit
    ),
    of_motion(
        "BallMotion.rotation",
        "theorem-ball-rest",
        lambda say, p: say("theorem-ball-rest", "R", about_z=about_z, **letters(p, "alpha t")),
        REST,
        size=unit,
    ),
    of_motion("BallMotion.angular_momentum", "(26)", momentum, [*POINTS, *ALONG, *REST], size=length),
    of_motion(
        "BallMotion.field_in_body",
        f"{MATRIX} (32)",
        lambda say, p: say("(32)", "K", Bp=[0, 0, p.alpha], R=rotation(say, p, p.t)),
        size=length,
        ulps=8,
        floors=("kernel",),
    ),
    of_motion("BallMotion.angular_velocity", f"{MATRIX} (26)", spin, size=length, ulps=8),
)


@each(TIES)
def test_the_ball_agrees_with_the_ledger(tie: Tie, floor: str) -> None:
    """Its axis, its frequency, its matrix and its vectors, for a momentum along the field too."""
    agree(tie, floor)
