"""Elementary motion and the free body beside it: core and exact agree with the ledger's (71) to (88)."""

from functools import partial
from typing import Any

import sympy
from agreement import (
    Floor,
    Ledger,
    Tie,
    agree,
    bodies,
    each,
    elementary,
    length,
    letters,
    matrices,
    of,
    rotation,
    unit,
    unit_field,
)

from atlas.trial.proofs.model import rodrigues

POINTS = bodies(76, 8)
REST = bodies(90, 1, omega=(0.0, 0.0, 0.0))
BALL = bodies(1, 4, body=1.0, omega=lambda p: (0.0, -p.B2, p.omega[2]))
EQUATOR = bodies(2, 4, B3=0.0, omega=lambda p: (0.0, -p.B2, p.omega[2]))
FREE = bodies(92, 6, B2=0.0, B3=0.0)
ALONG = bodies(3, 2, B2=0.0, omega=lambda p: (0.0, 0.0, p.omega[2]))
SPINS = bodies(4, 6)

CONSTANTS = "(71) (72) (79)"


def motion(f: Floor, p: Any) -> Any:
    """Return the elementary motion of a point on a floor."""
    return f.ElementaryMotion(p.body, p.field, p.omega2)


def with_spin(f: Floor, p: Any) -> Any:
    """Return the same where omega3 is free, and given."""
    return f.ElementaryMotion(p.body, p.field, p.omega2, p.omega3)


def free_motion(f: Floor, p: Any) -> Any:
    """Return the free body of a point on a floor, from the whole of omega."""
    return f.FreeMotion(p.body, p.omega)


def spin(say: Ledger, p: Any, t: Any) -> Any:
    """Return Omega(t), (73)."""
    constants = elementary(say, p)
    return say("(73)", "Omega", omega2=p.omega2, omega3=constants["omega3"], phi=constants["phi"], t=t)


def field(say: Ledger, p: Any) -> Any:
    """Return K(t), (62) and (60)."""
    Omega = spin(say, p, p.t)
    inputs = {"omega1": 0, "Omega1": Omega[0], "Omega2": Omega[1], **letters(p, "omega2 B2 B3")}
    return [say("(62)", "K1", **inputs), say("(62)", "K2", **inputs), say("(60)", "K3", **inputs)]


def field_seen(say: Ledger, p: Any) -> Any:
    """Return K(t) = B' R, (32)."""
    return say("(32)", "K", Bp=[0, *p.field], R=rotation(say, p, p.t))


def momentum(say: Ledger, p: Any, t: Any) -> Any:
    """Return m/I2 = R I Omega."""
    return say("text-momentum", "m", R=rotation(say, p, t), I=sympy.diag(1, 1, p.I), Omega=spin(say, p, t))


def invariants(say: Ledger, p: Any) -> list[Any]:
    """Return E', K^2, c3, c5 and (m, B')/I2 at t = 0."""
    inputs = {"omega1": 0, "omega3": elementary(say, p)["omega3"], **letters(p, "omega2 I B2 B3")}
    four = [("(36)", "at0(E)"), ("(37)", "at0(K^2)"), ("(40)", "at0(c3)"), ("(41)", "at0(c5)")]
    m = sympy.Matrix(momentum(say, p, 0))
    component = say("(88)", "0", d=lambda x: x, m=m, Bp=[0, *p.field])
    return [*(say(name, side, **inputs) for name, side in four), component]


def two_turns(say: Ledger, axis: Any, k: Any, phi: Any, t: Any) -> Any:
    """Return R = P Q of (85), both factors by Rodrigues' formula."""
    P = say("text-precession", "P", hat_B=axis, k=k, t=t)
    Q = say("text-precession", "Q", rod=rodrigues, e3=[0, 0, 1], phi=phi, t=t)
    return say("(85)", "R", P=P, Q=Q)


def lost_constants(say: Ledger, p: Any) -> dict[str, Any]:
    """Return k and phi where (71) has no value: on the ball's extra line, and on that of a transverse field."""
    b = sympy.sqrt(sympy.Rational(p.B2) ** 2 + sympy.Rational(p.B3) ** 2)
    name, axis = ("theorem-equatorial-field", "about_y") if p.B3 == 0 else ("theorem-ball-line", "about_B")
    inputs = {**letters(p, "omega3 B2 B3"), "b": b, "t": sympy.Integer(1)}
    sense = sympy.sign(sympy.Rational(p.B2)) if p.B3 == 0 else 1  # of the field beside e2
    turns = {axis: lambda angle: angle * sense, "about_z": lambda _: sympy.Integer(1)}
    spins = {axis: lambda _: sympy.Integer(1), "about_z": lambda angle: angle}
    return {"k": say(name, "R", **inputs, **turns), "phi": say(name, "R", **inputs, **spins)}


def lost_rotation(say: Ledger, p: Any) -> Any:
    """Return R(t) there."""
    axis = sympy.Matrix([0, *unit_field(p).values()])
    return two_turns(say, axis, t=p.t, **lost_constants(say, p))


def free_constants(say: Ledger, p: Any, *, has_omega1: bool = False) -> dict[str, Any]:
    """Return axis, k and phi of the free body, by its m; with omega1 = 0 or the whole of omega."""
    omega = [sympy.Rational(x) for x in p.omega]
    m = sympy.Matrix([omega[0] if has_omega1 else 0, omega[1], p.I * omega[2]])
    size = sympy.sqrt(m.dot(m))
    transverse = sympy.sqrt(m[0] ** 2 + m[1] ** 2)
    k = say("text-free-frequency", "k", omega2=transverse, hB2=transverse / size)
    return {"axis": m / size, "k": k, "phi": say("(87)", "phi", I2=1, I3=p.I, hB3=m[2] / size, kB=k)}


def free_rotation(say: Ledger, p: Any, t: Any, *, has_omega1: bool = False) -> Any:
    """Return R(t) of the free body."""
    return two_turns(say, t=t, **free_constants(say, p, has_omega1=has_omega1))


def free_spin(say: Ledger, p: Any) -> Any:
    """Return Omega(t) of the free body: m = R I Omega does not move."""
    J, R = sympy.diag(1, 1, p.I), free_rotation(say, p, p.t, has_omega1=True)
    m = say("text-momentum", "m", R=sympy.eye(3), I=J, Omega=p.omega)
    return J.inv() * R.T * m


def quaternion_rotation(f: Floor, p: Any) -> list[Any]:
    """Return the matrix of the unit quaternion, which has its scalar first in balls and is 1 at t = 0."""
    order = {} if f.name == "certified" else {"scalar_first": True}
    (w_start, *_), (w, x, y, z) = (motion(f, p).quaternion(t, **order) for t in (0.0, p.t))
    w, x, y, z = (
        (w_start * component for component in (w, x, y, z)) if w_start > 0 else (w_start, w_start, w_start, w_start)
    )
    return [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]


def axis(say: Ledger, p: Any) -> Any:
    """Return the unit vector along (B2, B3), of which (77) gives the slope."""
    slope = say("(77)", "hB3/hB2", B2=p.B2, B3=p.B3)
    cosine = 1 / sympy.sqrt(1 + slope**2) * (1 if p.B2 > 0 else -1)
    return [cosine, cosine * slope]


def strongest(_true: list[Any], p: Any) -> float:
    """Return the square of the largest frequency at t = 0, that of which the invariants are made."""
    return (
        float(max(abs(x) for x in (*p.field, p.omega2, Floor("kernel").Hyperbola(p.body, p.field).omega3(p.omega2))))
        ** 2
    )


LOST = ((BALL, "theorem-ball-line"), (EQUATOR, "theorem-equatorial-field"))
TWO_TURNS = "(85) text-precession"
MATRIX = f"{CONSTANTS} (84)"
FREE_LABELS = "(87) text-free-frequency"

of_motion, of_spun, of_free = of(motion, POINTS), of(with_spin, POINTS), of(free_motion, SPINS)

PRECESSION = (
    *(
        of_motion(
            f"ElementaryMotion.{name}", CONSTANTS, lambda say, p, name=name: elementary(say, p)[name], [*POINTS, *REST]
        )
        for name in ("omega3", "k", "phi")
    ),
    of_motion("ElementaryMotion.period", CONSTANTS, lambda say, p: 2 * sympy.pi / abs(elementary(say, p)["k"])),
    *matrices("ElementaryMotion", MATRIX, motion, rotation, [*POINTS, *REST], ("kernel", "certified")),
    Tie(
        "ElementaryMotion.quaternion",
        MATRIX,
        quaternion_rotation,
        lambda say, p: rotation(say, p, p.t),
        POINTS,
        size=unit,
    ),
    of_motion("ElementaryMotion.axis", "(77)", axis, floors=("certified",)),
    of_motion("ElementaryMotion.angular_velocity", f"{CONSTANTS} (73)", lambda say, p: spin(say, p, p.t), size=length),
    of_motion("ElementaryMotion.field_in_body", f"{CONSTANTS} (73) (62) (60)", field, size=length),
    of_motion("ElementaryMotion.field_in_body", f"{MATRIX} (32)", field_seen, size=length),
    of_motion(
        "ElementaryMotion.angular_momentum",
        f"{MATRIX} (73) text-momentum",
        lambda say, p: momentum(say, p, p.t),
        size=length,
    ),
    of_motion(
        "ElementaryMotion.invariants",
        f"{MATRIX} (36) (37) (40) (41) (73) (88) text-momentum",
        invariants,
        size=strongest,
        ulps=8,
    ),
    Tie(
        "ElementaryMotion.beside",
        "text-affirmation-free",
        lambda f, p: motion(f, p).beside.angular_velocity(0.0),
        lambda say, p: say("text-affirmation-free", "at0(Omega)", **letters(p, "omega2 I2 I3 B2 B3")),
        POINTS,
        size=length,
        floors=("kernel",),
    ),
)

SPECIAL = (
    *(
        of_spun(f"ElementaryMotion.{name}", entry, lambda say, p, name=name: lost_constants(say, p)[name], points)
        for name in ("k", "phi")
        for points, entry in LOST
    ),
    *(
        of_spun("ElementaryMotion.rotation", f"{entry} {TWO_TURNS}", lost_rotation, points, size=unit)
        for points, entry in LOST
    ),
    *(
        of_spun(f"ElementaryMotion.{name}", FREE_LABELS, lambda say, p, name=name: free_constants(say, p)[name], FREE)
        for name in ("k", "phi")
    ),
    of(free_motion, [p for p in SPINS if p.I != 1])(  # of a ball Omega is constant
        "FreeMotion.period",
        FREE_LABELS,
        lambda say, p: 2 * sympy.pi / abs(free_constants(say, p, has_omega1=True)["phi"]),
    ),
    of_spun(
        "ElementaryMotion.rotation",
        f"{FREE_LABELS} {TWO_TURNS}",
        lambda say, p: free_rotation(say, p, p.t),
        FREE,
        size=unit,
    ),
    of_spun(
        "ElementaryMotion.rotation",
        TWO_TURNS,
        lambda say, p: two_turns(say, sympy.Matrix([0, 0, 1]), 0, p.omega3, p.t),
        ALONG,
        size=unit,
    ),
)

ALONE = (
    *(
        of_free(
            f"FreeMotion.{name}", FREE_LABELS, lambda say, p, name=name: free_constants(say, p, has_omega1=True)[name]
        )
        for name in ("k", "phi")
    ),
    *matrices("FreeMotion", f"{FREE_LABELS} {TWO_TURNS}", free_motion, partial(free_rotation, has_omega1=True), SPINS),
    of_free("FreeMotion.angular_velocity", f"{FREE_LABELS} {TWO_TURNS} text-momentum", free_spin, size=length),
)

TIES = (*PRECESSION, *SPECIAL, *ALONE)


@each(PRECESSION)
def test_a_precession_agrees_with_the_ledger(tie: Tie, floor: str) -> None:
    """Constants, matrix and vectors of the one-parameter family, at rest too."""
    agree(tie, floor)


@each(SPECIAL)
def test_the_motions_that_equation_71_loses_agree_with_the_ledger(tie: Tie, floor: str) -> None:
    """Where omega3 is free: the lines of the ball and of a transverse field, no field, and a spin along it."""
    agree(tie, floor)


@each(ALONE)
def test_the_free_body_agrees_with_the_ledger(tie: Tie, floor: str) -> None:
    """Any launch, with omega1 too."""
    agree(tie, floor)
