"""A charged point particle in constant E and B, (89) to (99)."""

from atlas.families.family import RATE, Command, Family, Parameter, Quantity, Sampled
from atlas.families.parameters import in_brackets

SPEED = "length/time"


def _vector(name: str, letter: str, unit: str, default: tuple[float, float, float], says: str) -> Parameter:
    columns = (f"{letter}1", f"{letter}2", f"{letter}3")
    return Parameter(
        name, says, unit, default, (-3.0, 3.0), needed=False, omitted=0.0, columns=columns, metavar="X Y Z", last=True,
    )  # fmt: skip


FAMILY = Family(
    "particle",
    "motion of a point charge in constant fields",
    "motions.particle.{}.ParticleMotion",
    (
        Parameter("mu", "Charge-to-mass ratio; either sign.", "charge/mass", (1.0,), (-3.0, 3.0)),
        _vector("electric", "E", "electric field", (0.2, 0.5, 0.0), "Electric field E, such as 100V/m; default 0 0 0."),
        _vector("magnetic", "B", "magnetic field", (0.0, 0.0, 1.0), "Magnetic field B, such as 0.8T; default 0 0 0."),
        _vector("position", "y", "length", (0.0, 0.0, 0.0), "Position at t = 0, such as 2mm; default 0 0 0."),
        _vector("velocity", "v", SPEED, (1.0, 0.0, 0.0), "Velocity at t = 0; default 0 0 0."),
        Parameter(
            "c",
            "Speed of light, 1 in SI.",
            "speed of light",
            (1.0,),
            (0.5, 2.0),
            needed=False,
            omitted=1.0,
            option=False,
        ),
    ),
    (
        Quantity("case", "name of the case", printed=False),
        Quantity("kind", "name of the path across B", printed=False),
        Quantity(
            "cyclotron_frequency",
            "cyclotron frequency mu |B|/c, with the sign of mu",
            RATE,
            "(97)",
            symbol="omega",
            certified=True,
        ),
        Quantity(
            "radius", "radius of the circle about the drifting centre", "length", "(97)", printed=False, certified=True
        ),
        Quantity(
            "drift",
            "c [E, B]/B^2",
            SPEED,
            "(94)",
            text=in_brackets,
            tabled=False,
            get=lambda motion: motion.drift if motion.cyclotron_frequency != 0 else None,
        ),
    ),
    (
        Sampled("position", "position", "position", "length", "(101)", "y_i", checked="particle y"),
        Sampled("velocity", "velocity", "velocity", SPEED, "(90)", "v_i", checked="particle v"),
    ),
    command=Command(
        "particle",
        "Compute the path of a point charge.",
        "Compute position and velocity of a point charge in constant fields E and B, (93) to (99).",
        (
            "atlas particle --mu 1 --electric 0 0.5 0 --magnetic 0 0 1 --velocity 1 0 0 --times 0 1 2",
            "atlas particle --mass 9.11e-31 --charge -1.602e-19 --magnetic 0 0 1e-3 --velocity 1e5 0 0 --times 1e-9",
        ),
        "point charge in constant fields",
    ),
    figures=("particle_motion",),
    instead=("mu",),
)
