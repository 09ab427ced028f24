"""The quadric of initial data with constant Omega3, (51) to (57)."""

from atlas.families.family import RATE, Command, Family, Quantity
from atlas.families.parameters import FIELD, RATIO, in_brackets

FAMILY = Family(
    "quadric",
    "surface of initial data with constant Omega3",
    "surfaces.{}.Quadric",
    (RATIO, FIELD),
    (
        Quantity("kind", "name of the surface"),
        Quantity("beta", "angle from e2 to I^-1 B'", "rad", "(53)", checked="beta", certified=True),
        Quantity("a2", "2 sin(beta)/(1 - sin(beta))", "", "(54)", checked="a2", certified=True),
        Quantity("a3", "2 sin(beta)/(1 + sin(beta))", "", "(54)", checked="a3", certified=True),
        Quantity(
            "semi_axes", "semi-axes along omega'_1..3", RATE, "(55), (57)", columns=("C1", "C2", "C3"),
            lines=tuple((f"C{i}", f"semi-axis along omega'_{i}") for i in (1, 2, 3)), checked="semi-axes",
            certified=True,
        ),
        Quantity("centre", "-B', the centre", RATE, "(51)", text=in_brackets, tabled=False),
        Quantity(
            "axes", "canonical axes", "", "(53)", text=in_brackets,
            lines=tuple((f"e'_{i}", "canonical axis") for i in (1, 2, 3)), checked="canonical axes", tabled=False,
        ),
    ),
    promises={"beta": 4, "a2": 4, "a3": 4, "semi-axes": 4, "canonical axes": 4},
    command=Command(
        "classify",
        "Classify the surface of starts with constant Omega3.",
        "Name the quadric of initial angular velocities with constant Omega3, and print its canonical form.\n\n"
        "The kind of quadric is decided from I2, I3 and the components of the field as typed, without rounding.",
        (
            "atlas classify --ratio 1.5 --field 1 2",
            "atlas classify --shape cylindrical-shell --radius 1 --height 0.5 --field 1 2 --json",
        ),
        "",
        "kind",
    ),
    figures=("quadric", "hyperbola", "frequencies", "stability"),
)  # fmt: skip
