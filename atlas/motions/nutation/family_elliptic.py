"""The paper's family for a body with any three moments of inertia, theorem-elliptic."""

from atlas.families.family import RATE, TIME, Command, Family, Parameter, Quantity, Sampled
from atlas.families.parameters import MOMENTS, PRINCIPAL_FIELD, in_brackets, rotation

FAMILY = Family(
    "elliptic",
    "elliptic motion of a charged body of any three moments",
    "motions.nutation.{}_elliptic.EllipticMotion",
    (
        MOMENTS,
        PRINCIPAL_FIELD,
        Parameter(
            "z", "Parameter z of the motion; (z + D/I1) (z + D/I2) (z + D/I3) must not be negative, D = I1 I2 I3.",
            "inertia^2", (1.7,), (-0.2, 4.0),
        ),
        Parameter("branch", "Sign of v in the motion, 1 or -1.", "", (1.0,), (-1.0, 1.0), needed=False, omitted=1.0),
    ),
    (
        Quantity("kind", "type of motion"),
        Quantity("stability", "of the curve of K"),
        Quantity(
            "splitting", "squared frequency of small departures", "1/time^2", checked="elliptic splitting",
            certified=True,
        ),
        Quantity(
            "v", "root of prod(z + D/I_i)", "inertia^3", "theorem-elliptic", checked="elliptic v", certified=True
        ),
        Quantity(
            "omega", "initial angular velocity", RATE, "theorem-elliptic", columns=("omega1", "omega2", "omega3"),
            text=in_brackets, checked="elliptic omega", certified=True,
        ),
        Quantity("period", "period of K", TIME, checked="elliptic period", certified=True),
        Quantity(
            "precession_per_period", "turn about B in one period, of the axis that K goes round", "rad",
            missing="no period", certified=True,
        ),
        Quantity(
            "precession_rate", "mean rate about B of the axis that K goes round", RATE, missing="no period",
            certified=True,
        ),
        Quantity("spin_rate", "mean rate about the axis that K goes round", RATE, missing="no period", certified=True),
        Quantity("modulus", "of the elliptic functions", certified=True),
        Quantity("nome", "of the elliptic functions", certified=True),
    ),
    (
        *rotation("", "elliptic R"),
        Sampled(
            "Omega", "angular_velocity", "angular velocity in the body", RATE, "theorem-elliptic",
            checked="elliptic Omega",
        ),
        Sampled("K", "field_in_body", "field B' in the body", RATE, checked="elliptic K", printed=False),
        Sampled("m", "angular_momentum", "angular momentum", "inertia/time", symbol="m_i", printed=False),
    ),
    {
        "elliptic R": 16, "elliptic R grid": 32, "elliptic Omega": 16, "elliptic K": 16, "elliptic orthogonality": 16,
        "elliptic R(0) = 1": 4, "elliptic v": 4, "elliptic splitting": 4, "elliptic omega": 4, "elliptic period": 4,
    },
    Command(
        "elliptic",
        "Compute elliptic motions of a body with three moments.",
        "Compute the rotation matrix and angular velocity of an elliptic motion of a body with three moments.\n\n"
        "The angular velocity is Omega = -[1 + v (z II + D)^-1] K at all times. K is the field B' in the body, II the "
        "tensor of inertia, D = I1 I2 I3, v^2 = (z + D/I1) (z + D/I2) (z + D/I3). These motions generalise "
        "the motions of the paper, which does not have them.",
        (
            "atlas elliptic --inertia 0.8 1 1.3 --field 0.2 1 0.6 --z 1.7 --times 0 1 1e6",
            "atlas elliptic --inertia 0.8 1 1.3 --field 0.2 1 0.6 --z -1.2 --branch -1 --times 1e12 --digits 40",
            "atlas elliptic --inertia 1 1 1.5 --field 0 1 2 --z 0.3 --grid 0 1 40 --json",
        ),
        "elliptic motion: ",
        "kind",
        undecided=True,
    ),
    at_once=200,
    figures=("elliptic_motion",),
)  # fmt: skip
