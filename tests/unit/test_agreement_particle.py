"""Point particle and flight: core and exact agree with the ledger's (89) to (99), for either sign of the charge."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import sympy
from agreement import (
    Floor,
    Ledger,
    Tie,
    agree,
    bodies,
    disagree,
    each,
    elementary,
    length,
    of,
    rotation,
    signed,
    unit,
    vector,
)

from atlas.motions.particle import rows as charge


def launches(seed: int, count: int, **fixed: Any) -> list[Any]:
    """Return particles in oblique fields: mu of either sign, c, E, B, position y, velocity v and radius a."""
    draw, points = np.random.default_rng(seed), []
    for _ in range(count):
        p = SimpleNamespace(mu=signed(draw), c=abs(signed(draw)), E=vector(draw), B=vector(draw), t=signed(draw))
        p.y, p.v, p.a = vector(draw), vector(draw), abs(signed(draw))
        for name, value in fixed.items():
            setattr(p, name, value)
        points.append(p)
    return points


POINTS = launches(10, 8)
DARK = launches(2, 3, B=(0.0, 0.0, 0.0))
BODIES = bodies(
    17,
    4,
    mu=2.0,
    c=1.0,
    y=(0.5, -1.0, 2.0),
    v=(1.0, 0.25, -0.5),
    a=0.0,
    E=(0.75, 1.5, -0.5),
    B=lambda p: (0.0, p.B2, p.B3),
)
"""Bodies that fly in the laboratory frame, mu/(2c) = 1."""


def exact(values: Any) -> Any:
    """Return a vector of rationals."""
    return sympy.Matrix([sympy.Rational(x) for x in values])


def split(p: Any) -> dict[str, Any]:
    """Return the fields in the letters of the appendix: parts along B and across it, and their sizes."""
    B, E = exact(p.B), exact(p.E)
    E_parallel = B * B.dot(E) / B.dot(B)
    E_transverse = E - E_parallel
    b, E2 = sympy.sqrt(B.dot(B)), sympy.sqrt(E_transverse.dot(E_transverse))
    return {"Bf": B, "E": E, "Epar": E_parallel, "Eperp": E_transverse, "b": b, "E2": E2}


def frame(say: Ledger, p: Any) -> Any:
    """Return e1, e2, e3 of figure Magn: text-drift-direction gives e1."""
    s = split(p)
    e1 = say("text-drift-direction", "norm(Eperp)*norm(Bf)*e1", Eperp=s["Eperp"], Bf=s["Bf"]) / (s["E2"] * s["b"])
    return [e1, s["Eperp"] / s["E2"], s["Bf"] / s["b"]]


def frequency(say: Ledger, p: Any) -> Any:
    """Return omega of (97), with the sign of the charge."""
    return say("(97)", "omega", mu=p.mu, Bf=split(p)["Bf"], c=p.c)


def drift(say: Ledger, p: Any) -> Any:
    """Return c [E, B]/B^2."""
    s = split(p)
    return say("text-drift", "drift", c=p.c, E=s["E"], Bf=s["Bf"])


def constants(say: Ledger, p: Any) -> Any:
    """Return C of (90) in its two parts, from y and v at t = 0."""
    s = split(p)
    C = exact(p.v) - say("(90)", "dy", mu=p.mu, E=s["E"], t=0, c=p.c, y=p.y, Bf=s["Bf"], C=[0, 0, 0])
    parallel = s["Bf"] * s["Bf"].dot(C) / s["Bf"].dot(s["Bf"])
    return parallel, C - parallel


def transverse_path(say: Ledger, p: Any, t: Any, a: Any, omega0: Any) -> Any:
    """Return y_perp(t) of (98), on a circle of radius a that begins at the angle omega0."""
    s = split(p)
    e1, e2, _ = frame(say, p)
    given = {"Cperp": constants(say, p)[1], "omega": frequency(say, p), "e1": e1, "e2": e2, "mu": p.mu, "c": p.c}
    return say("(98)", "yperp", a=a, omega0=omega0, t=t, **given, Bf=s["Bf"], Eperp=s["Eperp"])


def circle(say: Ledger, p: Any) -> tuple[Any, Any]:
    """Return a and omega0 of (98) from the position at t = 0."""
    y, B = exact(p.y), exact(p.B)
    arm = y - B * B.dot(y) / B.dot(B) - transverse_path(say, p, 0, 0, 0)
    e1, e2, _ = frame(say, p)
    return sympy.sqrt(arm.dot(arm)), sympy.atan2(arm.dot(e1).evalf(80), arm.dot(e2).evalf(80))


def parallel_path(say: Ledger, p: Any) -> Any:
    """Return y_par(t) of (93)."""
    y, B = exact(p.y), exact(p.B)
    C, start = constants(say, p)[0], B * B.dot(y) / B.dot(B)
    return say("(93)", "ypar", ypar0=start, Cpar=C, t=p.t, mu=p.mu, Epar=split(p)["Epar"])


def place(say: Ledger, p: Any) -> Any:
    """Return y(t), (101)."""
    return say("(101)", "y", ypar=parallel_path(say, p), yperp=transverse_path(say, p, p.t, *circle(say, p)))


def velocity(say: Ledger, p: Any) -> Any:
    """Return dy/dt, (90)."""
    s, C = split(p), sum(constants(say, p), sympy.zeros(3, 1))
    return say("(90)", "dy", mu=p.mu, E=s["E"], t=p.t, c=p.c, y=place(say, p), Bf=s["Bf"], C=C)


def centre(say: Ledger, p: Any) -> Any:
    """Return O(t): y(t) on a circle of radius 0."""
    return say("(101)", "y", ypar=parallel_path(say, p), yperp=transverse_path(say, p, p.t, 0, 0))


def trochoid(say: Ledger, p: Any) -> Any:
    """Return y(t) of (99), and (93) from rest."""
    s = split(p)
    e1, e2, _ = frame(say, p)
    yperp = say("(99)", "yperp", mu=p.mu, Eperp=s["Eperp"], omega=frequency(say, p), t=p.t, a=p.a, e1=e1, e2=e2)
    ypar = say("(93)", "ypar", ypar0=[0, 0, 0], Cpar=[0, 0, 0], t=p.t, mu=p.mu, Epar=s["Epar"])
    return say("(101)", "y", ypar=ypar, yperp=yperp)


def fall(say: Ledger, p: Any) -> Any:
    """Return y(t) without a magnetic field."""
    return say("text-no-magnetic-field", "y", y0=p.y, C=p.v, t=p.t, mu=p.mu, E=p.E)


def rotated_arm(say: Ledger, p: Any) -> Any:
    """Return R(t) x of a point of the body."""
    return rotation(say, p, p.t) * exact(p.point)


def swept(say: Ledger, p: Any) -> Any:
    """Return dR/dt x, (12), with Omega of (73)."""
    constants = elementary(say, p)
    Omega = say("(73)", "Omega", omega2=p.omega2, omega3=constants["omega3"], phi=constants["phi"], t=p.t)
    return say("(12)", "d(R[i,j])", R=rotation(say, p, p.t), Omega=Omega) * exact(p.point)


def motion(f: Floor, p: Any) -> Any:
    """Return the motion of a point on a floor."""
    return f.ParticleMotion(p.mu, p.E, p.B, p.y, p.v, p.c)


def flight(f: Floor, p: Any) -> Any:
    """Return the flight of a point of an elementary motion's body, the field B' = B its own."""
    return f.Flight(motion(f, p), f.ElementaryMotion(p.body, p.field, p.omega2), p.point)


def travelled(_true: list[Any], p: Any) -> float:
    """Return the size of the terms of which a path is made."""
    y, v, E, B = (float(np.linalg.norm(x)) for x in (p.y, p.v, p.E, p.B))
    drifting = p.c * E / B + p.a * abs(p.mu) * B / p.c if B else 0.0
    return y + p.a + (v + drifting + abs(p.mu) * E * abs(p.t)) * abs(p.t)


def quick(_true: list[Any], p: Any) -> float:
    """Return the size of the terms of which a velocity is made."""
    v, E, B = (float(np.linalg.norm(x)) for x in (p.v, p.E, p.B))
    return v + p.c * E / B + abs(p.mu) * E * abs(p.t)


def swinging(true: list[Any], p: Any) -> float:
    """Return the same with the velocity of the point about the centre."""
    return quick(true, p) + 3 * float(max(map(abs, p.point))) * float(
        max(abs(x) for x in (*p.field, p.omega2, Floor("kernel").Hyperbola(p.body, p.field).omega3(p.omega2)))
    )


ACROSS = "(90) (97) (98) text-drift-direction"
PATH = f"{ACROSS} (93) (101)"
MATRIX = "(71) (72) (79) (84)"

of_motion, of_flight = of(motion, POINTS), of(flight, BODIES)

TIES = (
    of_motion("ParticleMotion.cyclotron_frequency", "(97)", frequency),
    of_motion("ParticleMotion.period", "(97)", lambda say, p: 2 * sympy.pi / abs(frequency(say, p))),
    of_motion(
        "ParticleMotion.prime", "(32)", lambda say, p: say("(32)", "Bp", mu=p.mu, c=p.c, Bf=p.B), floors=("kernel",)
    ),
    of_motion("ParticleMotion.drift", "text-drift", drift, size=length),
    of_motion("ParticleMotion.radius", ACROSS, lambda say, p: circle(say, p)[0]),
    of_motion("ParticleMotion.axes", "text-drift-direction", frame, size=unit, floors=("kernel",)),
    of_motion("ParticleMotion.position", PATH, place, size=travelled),
    of_motion("ParticleMotion.position", "text-no-magnetic-field", fall, DARK, size=travelled),
    of_motion("ParticleMotion.velocity", PATH, velocity, size=quick, ulps=8),
    of_motion("ParticleMotion.guiding_centre", PATH, centre, size=travelled),
    Tie(
        "ParticleMotion.trochoid",
        "(93) (97) (101) (99) text-drift-direction",
        lambda f, p: f.ParticleMotion.trochoid(p.mu, p.E, p.B, p.a, p.c).position(p.t),
        trochoid,
        POINTS,
        size=travelled,
        floors=("kernel",),
    ),
    of_flight("Flight.arm", MATRIX, rotated_arm, size=length, floors=("kernel",)),
    of_flight(
        "Flight.position", f"{PATH} {MATRIX}", lambda say, p: place(say, p) + rotated_arm(say, p), size=travelled
    ),
    of_flight(
        "Flight.velocity",
        f"{PATH} {MATRIX} (73) (12)",
        lambda say, p: velocity(say, p) + swept(say, p),
        size=swinging,
        ulps=8,
        floors=("kernel",),
    ),
)


@pytest.mark.slow
@each(TIES)
def test_the_particle_agrees_with_the_ledger(tie: Tie, floor: str) -> None:
    """Its path, the circle and the drift of which it is made, and the path of a point of a body."""
    agree(tie, floor)


def test_the_paper_s_sense_of_rotation_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """(97) as printed, omega = |mu B|/c: right for mu > 0 only."""
    monkeypatch.setattr(charge.Charge, "cyclotron_frequency", property(lambda self: self.rate))
    disagree(TIES, "ParticleMotion.cyclotron_frequency", "ParticleMotion.trochoid")
