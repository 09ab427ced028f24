"""Register of agreement: no public quantity without a tie to the ledger, no tie that sees nothing."""

import ast
import dataclasses
import runpy
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from agreement import FLOORS, Floor, Tie, agree, modules, negate, source

import atlas
from atlas.bodies.display import Shown
from atlas.errors import DomainError

TOPICS = [path for path in sorted(Path(__file__).parent.glob("test_agreement_*.py")) if path != Path(__file__)]
TIES: list[Tie] = [tie for path in TOPICS for tie in runpy.run_path(str(path))["TIES"]]

FORMULAS = {
    "kernel": {"body", "euler_poisson", "inertia", "integrals", "units"},
    "certified": {"body"},
}
"""Modules whose functions are public quantities; of the others the classes are."""


TOP = "compared with Taylor series of the equations of a top, in test_top"
GIVEN, AXES, NAME = "what was given, or another way to give it", "a choice of axes, not in the ledger", "no number"
SERIES = "compared with Taylor series in balls, and with the elementary motions, in test_general and test_exact_general"

RATES = ("period", "precession_rate", "spin_rate")

UNTIED = {
    "Quadric.kind": NAME,
    "ElementaryMotion.case": NAME,
    **{f"{name}Motion.kind": NAME for name in ("Ball", "Elementary", "Free")},
    **{f"{name}Motion.mode": NAME for name in ("Asymmetric", "Free")},
    **{f"AsymmetricMotion.{name}": "held against integrated motions, in test_rates" for name in RATES},
    "ElementaryMotion.omega2": GIVEN,
    "ParticleMotion.case": NAME,
    "ParticleMotion.kind": NAME,
    "ParticleMotion.in_field": GIVEN,
    "Field.si": GIVEN,
    "Field.gaussian": GIVEN,
    "Field.frame": GIVEN,
    "LaboratoryFrame.alignment": NAME,
    "LaboratoryFrame.field": AXES,
    "LaboratoryFrame.matrix": AXES,
    "LaboratoryFrame.to_laboratory": AXES,
    "LaboratoryFrame.to_user": AXES,
    "LaboratoryFrame.rotation_to_user": AXES,
    "SymmetricBody.inertia": GIVEN,
    "SymmetricBody.from_point_masses": GIVEN,
    "SymmetricBody.from_mass_matrix": GIVEN,
    "SymmetricBody.exact": GIVEN,
    "ChargeMoments.exact": GIVEN,
    "body.exact_moments": GIVEN,
    "body.excess": GIVEN,
    "Field.pair": "two components of Field.prime, which is tied",
    **{
        f"SymmetricBody.{shape}": "a moment of inertia from a textbook, not in the ledger"
        for shape in "ring disk solid_cylinder thin_rod sphere spherical_shell spheroid".split()
    },
    **{
        f"{name}Motion.{member}": "the rotation, tied or checked, in another form: test_quaternion, test_motion"
        for name in ("Elementary", "Free", "Ball", "General", "Top", "Elliptic", "Asymmetric")
        for member in ("angular_velocity_in_laboratory", "euler_angles", "in_laboratory", "quaternion")
        if (name, member) != ("Elementary", "quaternion")
    },
    **{
        f"{name}Motion.{member}": "a quotient or another name of what is tied or checked: test_motion"
        for name in ("Elementary", "Free", "Ball", "General", "Top", "Elliptic")
        for member in ("precession_rate", "spin_rate")
    },
    **{
        f"{name}Motion.{member}": "held against other ways to it in test_sensitivity, test_spectrum, test_actions"
        for name in ("Elementary", "Free", "Ball", "General", "Top", "Elliptic", "Asymmetric")
        for member in ("sensitivity", "spectrum", "actions")
    },
    **{
        f"GeneralMotion.{name}": SERIES
        for name in (
            "B2 B3 angular_momentum angular_velocity at_state b column complementary_modulus field_in_body "
            "from_frame in_laboratory invariants is_plane is_steady kind modulus nome period precesses_evenly "
            "precession precession_per_period quaternion roots rotation rotation_grid solution sphere "
            "spin_per_period steady_rates swings_evenly third_axis tilt turning_points turning_rate "
            "velocity velocity_sizes"
        ).split()
    },
    **{
        f"TopMotion.{name}": TOP
        for name in (
            "angular_momentum angular_velocity b charged column complementary_modulus field_in_body from_frame heavy "
            "invariants is_plane is_steady kind modulus nome period precesses_evenly precession "
            "precession_per_period quadric quaternion roots rotation rotation_grid sleeping_bands solution sphere "
            "spin_per_period stable steady_precessions steady_rates swings_evenly third_axis tilt "
            "turning_points turning_rate"
        ).split()
    },
    **{
        f"EllipticMotion.{name}": "compared with Taylor series of (12), (16), and with its theorem, in test_elliptic"
        for name in (
            "circled is_middle turn_per_period "
            "frame E angular_momentum angular_velocity b column complementary_modulus field_in_body from_frame "
            "invariants is_plane is_steady kind modulus nome omega period precesses_evenly precession "
            "precession_per_period quaternion rate_of rotation rotation_grid solution sphere spin_per_period "
            "splitting stability steady_rates swings_evenly third_axis tilt turning_rate v"
        ).split()
    },
    **{
        f"AsymmetricMotion.{name}": "compared with Taylor series of (12), (16) and with laws, in test_asymmetric"
        for name in (
            "F H MK elliptic angular_momentum angular_velocity column energy field_in_body invariants kind rotation "
            "rotation_grid third_axis"
        ).split()
    },
    **{
        f"AsymmetricMotion.{name}": "compared with the certified motion and with laws, in test_clebsch_theta"
        for name in ("accuracy", "agreement", "frequencies", "on_torus", "riemann_matrix")
    },
    "AsymmetricMotion.follow": "fills the cache of states, whose values are read by rotation",
    **{
        f"{name}Motion.{member}": AXES
        for name in ("Elliptic", "General", "Top")
        for member in ("places", "turning_axis")
    },
    **dict.fromkeys(
        ("EllipticMotion.cancelled", "GeneralMotion.cancelled", "TopMotion.cancelled"), "a count of digits"
    ),
    **{
        f"{kind}Motion.{name}": reason
        for kind in ("Elementary", "Free", "General", "Top", "Elliptic", "Asymmetric", "Ball")
        for name, reason in (
            ("animate", "a moving picture, in test_animate"),
            ("trace", "the curve of third_axis, in test_notebook"),
        )
    },
    **{
        f"{kind}Motion.{name}": reason
        for kind in ("Elementary", "Free", "General", "Top", "Elliptic", "Asymmetric", "Ball")
        for name, reason in (
            ("axes", AXES),
            ("given", GIVEN),
            ("is_placed", NAME),
            ("own", "the motion itself: test_exact_start"),
            ("input_error", "a bound, held against moved inputs in test_exact_start"),
        )
    },
    "FreeMotion.field_in_body": "zero",
    "Field.exact": "Field.prime, which is tied, without rounding: test_exact_start",
    "Field.exact_pair": "Field.prime, which is tied, without rounding: test_exact_start",
    "AsymmetricMotion.curve": "compared with proven digits, in test_torus",
    "Flight.rotation": "the matrix of its motion in other axes: compared with it in test_flight",
    "Quadric.of_top": "compared with the paper's quadric and with Taylor series of a top, in test_top_quadric",
    "Hyperbola.of_top": "compared with the paper's hyperbola and with Taylor series of a top, in test_top_quadric",
    "ChargeMoments.points": TOP,
    "ChargeMoments.shape": TOP,
    "Hyperbola.closed": "compared with its theorem and with an exact return in test_closed",
    "Hyperbola.escape": "a general motion: compared with an integration in test_general",
    "Hyperbola.growth_rate": "the root of the negative of Hyperbola.stability, which is tied",
    "Hyperbola.stable": NAME,
    "body.moments": GIVEN,
    "body.kept_ratio": GIVEN,
    "body.ratio_of": GIVEN,
    "body.from_shape": GIVEN,
    "body.shape_name": GIVEN,
    "inertia.inertia_tensor": GIVEN,
    "inertia.checked_tensor": GIVEN,
    "inertia.exact_mass_matrix": GIVEN,
    "inertia.sums_over_points": GIVEN,
    "inertia.principal_values": GIVEN,
    "inertia.rational_matrix": GIVEN,
    "inertia.rounded": GIVEN,
    "units.ratio_of": GIVEN,
    "inertia.diagonal_or_matrices": GIVEN,
    "units.system": NAME,
}
"""Public names without a tie, and why."""


def defined(floor: str) -> Iterator[tuple[str, ast.ClassDef | ast.FunctionDef]]:
    """Go through the public classes and functions of a floor, with their modules."""
    for module, name in modules(floor):
        for node in ast.parse(source(name)).body:
            if isinstance(node, ast.ClassDef | ast.FunctionDef) and not node.name.startswith("_"):
                yield module, node


def public_classes(floor: str) -> set[str]:
    """Return the classes whose members are quantities: those that the package exports, and their like on the floor."""
    exported = {
        name
        for name, home in atlas._HOMES.items()
        if home.startswith(("atlas.bodies", "atlas.surfaces", "atlas.motions"))
    } | {"PseudoOscillator"}
    return exported & {node.name for _, node in defined(floor) if isinstance(node, ast.ClassDef)}


def quantities(floor: str) -> set[str]:
    """Return every public quantity of a floor; an object's description of itself, which all have, is none."""
    names = {
        f"{module}.{node.name}"
        for module, node in defined(floor)
        if isinstance(node, ast.FunctionDef) and module in FORMULAS[floor]
    }
    for name in public_classes(floor):
        cls: Any = getattr(Floor(floor), name)
        ours = [base for base in cls.__mro__ if base.__module__.startswith("atlas.")]
        members = {member for base in ours for member in vars(base) if not member.startswith("_")} - {*vars(Shown)}
        if dataclasses.is_dataclass(cls):
            members -= {field.name for field in dataclasses.fields(cls) if field.init}
            members |= {field.name for field in dataclasses.fields(cls) if not field.init}
        names |= {f"{name}.{member}" for member in members}
    return names


@pytest.mark.slow
@pytest.mark.parametrize("floor", FLOORS)
def test_every_public_quantity_is_tied_to_the_ledger(floor: str) -> None:
    """A new kernel needs a tie in the file of its topic, or a reason in UNTIED."""
    tied = {tie.quantity for tie in TIES if floor in tie.floors}
    assert quantities(floor) - tied - set(UNTIED) == set()
    assert tied & set(UNTIED) == set()


@pytest.mark.slow
def test_registered_quantities_exist() -> None:
    """No tie and no reason outlives its quantity."""
    existing = quantities("kernel") | quantities("certified")
    assert {tie.quantity for tie in TIES} | set(UNTIED) <= existing


@pytest.mark.slow
@pytest.mark.parametrize("floor", FLOORS)
def test_a_new_public_property_counts_as_a_quantity(floor: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """One more public property is one more quantity."""
    before = quantities(floor)
    monkeypatch.setattr(Floor(floor).Quadric, "volume", property(lambda _: 1.0), raising=False)
    assert quantities(floor) - before == {"Quadric.volume"}


@pytest.mark.parametrize(
    ("tie", "floor"), [pytest.param(tie, floor, id=f"{floor} {tie}") for tie in TIES for floor in tie.floors]
)
def test_every_tie_fails_for_a_quantity_of_the_opposite_sign(
    tie: Tie, floor: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every tie reads the quantity that it is named after, and cannot do with its opposite: a body even less."""
    negate(monkeypatch, tie.quantity, floor)
    with pytest.raises((AssertionError, DomainError)):
        agree(tie, floor)
