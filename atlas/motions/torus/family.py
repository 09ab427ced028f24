"""Any motion of a charged body with three different moments of inertia."""

from atlas.families.family import RATE, TIME, Command, Family, Quantity, Sampled
from atlas.families.parameters import MOMENTS, OMEGA, PRINCIPAL_FIELD, rotation

FAMILY = Family(
    "asymmetric",
    "any motion of a charged body of any three moments",
    "motions.torus.{}.AsymmetricMotion",
    (
        MOMENTS,
        PRINCIPAL_FIELD,
        OMEGA,
    ),
    (
        Quantity("kind", "type of motion"),
        Quantity("agreement", "of R, K, Omega", exact=lambda _: "every digit is proven", tabled=False, slow=True),
        Quantity(
            "frequencies", "of the torus", RATE, columns=("f1", "f2", "f3"), missing="no torus", certified=True,
            slow=True, drawn=lambda motion, reference: motion._frequencies_near(reference),  # noqa: SLF001  of this folder
            lines=(
                ("f1", "first frequency of M and K, in a chosen basis"),
                ("f2", "second frequency of M and K, in a chosen basis"),
                ("f3", "frequency about B (of a free body about m), modulo f1 and f2"),
            ),
        ),
        Quantity("mode", "axis that the momentum goes round", tabled=False, missing="in a field"),
        Quantity("period", "period of Omega and K", TIME, missing="no one period", certified=True),
        Quantity(
            "precession_rate", "mean rate of the axis that m, or K, goes round", RATE, missing="no one period",
            certified=True,
        ),
        Quantity("spin_rate", "mean rate about that axis", RATE, missing="no one period", certified=True),
        Quantity("H", "Hamiltonian", "inertia/time^2", "theorem-lie-poisson", certified=True),
        Quantity("F", "integral of Clebsch", "(inertia/time)^2", "theorem-clebsch", certified=True),
        Quantity("MK", "(M, K)", "inertia/time^2", "theorem-lie-poisson", certified=True),
        Quantity("energy", "kinetic energy", "inertia/time^2", "theorem-kinetic-energy", certified=True),
    ),
    (
        *rotation("", "asymmetric R"),
        Sampled("Omega", "angular_velocity", "angular velocity in the body", RATE, checked="asymmetric Omega"),
        Sampled("K", "field_in_body", "field B' in the body", RATE, checked="asymmetric K", printed=False),
        Sampled("m", "angular_momentum", "angular momentum", "inertia/time", symbol="m_i", printed=False),
    ),
    {
        "asymmetric R": 16, "asymmetric Omega": 16, "asymmetric K": 16, "asymmetric orthogonality": 16,
        "asymmetric R(0) = 1": 0,
    },
    Command(
        "motion",
        "",
        "",
        (
            "atlas motion --inertia 0.8 1 1.3 --field 0.2 1 0.6 --omega 0.3 0.7 0.2 --times 1e12 --digits 30",
            "atlas motion --inertia 0.8 1 1.3 --field 0 0 0 --omega 0.3 0.7 0.2 --times 1e6 --json",
            "atlas motion --tensor 2 1.5 1 0.1 0 0.2 --field 0.3 0 1 --spin 3 --times 0 1 100",
        ),
        "motion of a body with three moments: ",
        "kind",
        undecided=True,
    ),
    at_once=1,
    figures=("asymmetric_motion", "torus_of_flows"),
    instead=("omega",),
    in_given_axes=True,
)  # fmt: skip
