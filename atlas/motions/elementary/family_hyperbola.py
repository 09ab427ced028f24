"""The hyperbola of elementary motions, (67) to (72)."""

from atlas.families.family import RATE, Family, Quantity
from atlas.families.parameters import FIELD, RATIO

FAMILY = Family(
    "hyperbola",
    "curve of elementary motions of a body in a field",
    "motions.elementary.{}_hyperbola.Hyperbola",
    (RATIO, FIELD),
    (
        Quantity("pole", "pole of omega3(omega2)", RATE, "(71)", symbol="-B2", tabled=False),
        Quantity(
            "unstable_band", "((omega2 + B2)/B2)^2 where the motion is unstable", symbol="y", text=" to ".join,
            tabled=False,
        ),
        Quantity("least_stability", "least of the squared frequencies of small nutations", "1/time^2", printed=False),
    ),
    promises={
        "omega3 of the hyperbola": 4, "stability": 4, "k of the hyperbola": 4, "phi of the hyperbola": 4,
        "points of the hyperbola": 4,
    },
    figures=("hyperbola", "frequencies", "stability"),
    typed=("hyperbola",),
)  # fmt: skip
