"""Bodies, points and ratios enter a motion as they are given: nothing is rounded or joined on the way."""

import copy
import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from flint import fmpq

import atlas
from atlas import ChargeMoments, SymmetricBody, TopMotion
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import nearest, rational, workprec
from atlas.bodies.certified_body import shape_moments
from atlas.bodies.integrals import shape_factors
from atlas.book import body_and_field as body_records
from atlas.book.parts import case_of, table_of
from atlas.book.tables.properties import FamilyObject
from atlas.book.tables.table import Request
from atlas.cli.app import atlas as command
from atlas.cli.body_request import COMMANDS
from atlas.cli.body_request import report_request as page_request
from atlas.errors import DomainError, NearlySymmetricWarning
from atlas.motions.elementary.certified_hyperbola import Hyperbola as CertifiedHyperbola
from atlas.motions.elementary.formula_hyperbola import closing
from atlas.motions.nutation.certified_general import GeneralMotion as Certified
from atlas.motions.register import FAMILIES
from atlas.surfaces.certified import Quadric as CertifiedQuadric

FIELD, OMEGA = (1.0, 2.0), (0.3, 0.7, 0.2)
LONG = 1e10
SIZES = {"mass": 0.3, "radius": 0.7, "height": 1.1}


def json_of(words: str) -> dict[str, Any]:
    """Return the JSON that a command prints."""
    answer: dict[str, Any] = json.loads(CliRunner().invoke(command, words.split(), catch_exceptions=False).stdout)
    return answer


def entries(words: str) -> tuple[FloatArray, FloatArray]:
    """Return R at a late time in doubles and by proven digits."""
    matrices = []
    for digits in ("", " --digits 17"):
        (sample,) = json_of(f"{words} --times {LONG:g} --json{digits}")["samples"]
        matrices.append(np.array(sample["R"], dtype=float))
    return matrices[0], matrices[1]


@pytest.mark.parametrize("shape", [SIZES, {**SIZES, "radius": 0.3, "height": 0.7}])
def test_a_shape_moves_as_its_dimensions_say(shape: dict[str, float]) -> None:
    """The motion of a cylinder is that of the exact quotient of its moments, at late times too."""
    I2, I3 = shape_moments("solid_cylinder", **shape)
    exact = Certified(I3 / I2, FIELD, OMEGA)
    motion = atlas.GeneralMotion(SymmetricBody.solid_cylinder(**shape), FIELD, OMEGA)
    motion_array = atlas.GeneralMotion(
        SymmetricBody.solid_cylinder(np.full(3, shape["mass"]), shape["radius"], shape["height"]), FIELD, OMEGA
    )
    with workprec():
        expected = [[nearest(x) for x in row] for row in exact.rotation(LONG)]
    assert np.abs(motion.rotation(LONG) - expected).max() < 1e-14
    assert np.abs(motion_array.rotation(LONG) - expected).max() < 1e-14
    placed = atlas.motion(SymmetricBody.solid_cylinder(**shape), (0.0, *FIELD), OMEGA)
    assert np.abs(placed.rotation(LONG) - expected).max() < 1e-14


def test_a_ratio_that_no_double_holds_is_kept() -> None:
    """I = 1/3 as a Fraction is not the nearest double, in any class of a symmetric body."""
    body, third = SymmetricBody(3.0, 1.0), Fraction(1, 3)
    for motion_a, motion_b in (
        (atlas.GeneralMotion(third, FIELD, OMEGA), atlas.GeneralMotion(body, FIELD, OMEGA)),
        (atlas.ElementaryMotion(third, FIELD, 0.7), atlas.ElementaryMotion(body, FIELD, 0.7)),
        (atlas.FreeMotion(third, OMEGA), atlas.FreeMotion(body, OMEGA)),
        (atlas.motion(third, (0.0, *FIELD), OMEGA), atlas.motion(body, (0.0, *FIELD), OMEGA)),
    ):
        assert np.abs(motion_a.rotation(LONG) - motion_b.rotation(LONG)).max() < 1e-14
        assert copy.deepcopy(motion_a) == motion_a
        assert eval(repr(motion_a), {"Fraction": Fraction, "SymmetricBody": SymmetricBody, **NAMES}) == motion_a  # noqa: S307


NAMES = {name: getattr(atlas, name) for name in ("GeneralMotion", "ElementaryMotion", "FreeMotion", "motion")}


@pytest.mark.parametrize(
    "body",
    [
        "--shape solid-cylinder --radius 0.3 --height 0.7 --density 2 --charge 0.7 --magnetic 1 2",
        "--shape cylindrical-shell --radius 0.3 --height 0.7 --mass 0.7 --charge 0.3 --magnetic 1 2",
        "--points {points} --magnetic 1 2",
        "--points {points} --magnetic 0 1 2",
    ],
)
def test_doubles_and_balls_take_the_same_body_and_field(body: str, tmp_path: Path) -> None:
    """Doubles and proven digits agree at a late time: neither rounds moments, mass or charge on the way."""
    points = tmp_path / "points.csv"
    rows = ["0.3,0,0.1", "-0.3,0,0.1", "0,0.3,0.1", "0,-0.3,0.1"]
    points.write_text("x,y,z,mass,charge\n" + "".join(f"{x},0.7,0.13\n" for x in rows) + "0,0,0.7,1.4,0.26\n")
    computed, expected = entries(f"motion {body.format(points=points)} --omega 0.3 0.7 0.2")
    assert np.abs(computed - expected).max() < 4e-15


def test_moments_are_joined_only_where_they_are_equal() -> None:
    """A body with g1 = g2 keeps its third value, however near; two that differ are joined with a warning."""
    assert SymmetricBody.from_mass_matrix((1, 1, 1 + 5e-10)).ratio != 1
    for matrix in ((1, 1 + 1e-12, 3.0), [[0.3, 1e-16, 0], [1e-16, 0.3, 0], [0, 0, 1.0]]):
        with pytest.warns(NearlySymmetricWarning, match="of the larger, and are joined; say tolerance="):
            SymmetricBody.from_mass_matrix(matrix)
        SymmetricBody.from_mass_matrix(matrix, tolerance=1e-9)
    with pytest.raises(DomainError, match="differ by 1e-07 of the larger"):
        SymmetricBody.from_mass_matrix([[1e-9, 5e-17, 0], [5e-17, 1e-9, 0], [0, 0, 1.0]])


def test_a_density_stands_for_the_mass_of_a_solid() -> None:
    """Moments, ratio and refusals are those of the mass that the volume has."""
    for name, volume, sizes in (
        ("sphere", 4 / 3 * np.pi * 0.7**3, {"radius": 0.7}),
        ("solid_cylinder", np.pi * 0.49 * 1.1, {"radius": 0.7, "height": 1.1}),
        ("spheroid", 4 / 3 * np.pi * 0.49 * 1.1, {"equatorial": 0.7, "polar": 1.1}),
    ):
        make = getattr(SymmetricBody, name)
        dense, heavy = make(density=2.0, **sizes), make(2.0 * volume, **sizes)
        assert np.allclose(dense.inertia, heavy.inertia, rtol=1e-15, atol=0)
        assert np.array_equal(make(density=np.array([2.0, 3.0]), **sizes).I3[:1], [dense.I3])
        with pytest.raises(atlas.AtlasError, match="takes a mass or a density, not both"):
            make(1.0, density=2.0, **sizes)
        with pytest.raises(atlas.AtlasError, match="needs mass"):
            make(**sizes)
        with pytest.raises(DomainError, match="density must be positive"):
            make(density=0.0, **sizes)


def test_a_page_takes_the_field_without_rounding() -> None:
    """B' of a page's charge, mass and B is the exact product, as for the proven digits of a motion."""
    record = body_records.Body("a", ratio=1.5, mass=0.7, charge=0.3)
    case = body_records.body_and_field(record, body_records.Field("b", B=(0.0, 1.0, 2.0)))
    factor = Fraction(0.3) / Fraction(0.7) / 2
    assert case.exact_components == (factor, 2 * factor)
    assert case.components == (float(factor), float(2 * factor))


@pytest.mark.parametrize("ratio", [Fraction(1, 3), Fraction(11, 7), 1 + Fraction(1, 10**20), 1 - Fraction(1, 10**20)])
@pytest.mark.parametrize("field", [(Fraction(-1, 3), Fraction(2, 7)), (Fraction(3, 11), Fraction(1, 30))])
def test_curve_and_surface_have_the_ratio_and_the_field_that_were_given(
    ratio: Fraction, field: tuple[Fraction, Fraction]
) -> None:
    """Numbers of curve and quadric are those of proven digits, rounded once, for one object and in arrays."""
    curve, surface = CertifiedHyperbola(ratio, field), CertifiedQuadric(ratio, field)
    kernel, quadric = atlas.Hyperbola(ratio, field), atlas.Quadric(ratio, field)
    omega2 = [0.7, -1.3, 0.01]
    with workprec():
        for name in ("omega3", "stability"):
            expected = [nearest(getattr(curve, name)(x)) for x in omega2]
            assert getattr(kernel, name)(np.array(omega2)).tolist() == expected
            assert [getattr(kernel, name)(x) for x in omega2] == expected
        assert kernel.least_stability == nearest(curve.least_stability)
        assert kernel.closed(3, 2).k == nearest(closing(*curve._constants, fmpq(3, 2)))
        assert (quadric.a2, quadric.a3) == (nearest(surface.a2), nearest(surface.a3))
        assert quadric.kind == surface.kind
        assert atlas.FreeMotion(ratio, OMEGA).mode == ("long axis" if ratio < 1 else "short axis")
        assert [Fraction(x) for x in shape_factors(ratio)] == [
            Fraction(float(x)) for x in (ratio, 1 - ratio, 2 - ratio)
        ]
        assert quadric.residual((0.1, 0.2, 0.3)) == nearest(surface.residual((0.1, 0.2, 0.3)))


def test_moments_of_charges_are_not_rounded() -> None:
    """A coat, charges at points and a sum of both have exact moments, which the coupling of a top has too."""
    coat = ChargeMoments.shape("cylindrical_shell", -0.3, radius=0.7, height=1.1)
    I2, I3 = shape_moments("cylindrical_shell", mass=0.3, radius=0.7, height=1.1)
    assert [*map(rational, coat.exact)] == [-I2, -I3]
    places = np.array([(0.1, 0, 0), (-0.1, 0, 0), (0, 0.1, 0), (0, -0.1, 0), (0, 0, 0.3), (0, 0, -0.3)])
    points = ChargeMoments.points(np.full(6, 0.7), places)
    e, x2, z2 = Fraction(0.7), Fraction(0.1) ** 2, Fraction(0.3) ** 2
    assert points.exact == (e * (2 * x2 + 2 * z2), e * 4 * x2)
    assert [Fraction(x) for x in (coat + points).exact] == [
        Fraction(a) + Fraction(b) for a, b in zip(coat.exact, points.exact, strict=True)
    ]
    body = SymmetricBody.solid_cylinder(**SIZES)
    top = TopMotion.charged(body, coat, (0.0, 0.3), OMEGA)
    assert [*map(rational, top.arguments["coupling"])] == [rational(J) * rational(0.3) / 2 for J in coat.exact]
    assert [*map(rational, top.arguments["inertia"])] == [*map(rational, body.exact)]
    heavy = TopMotion.heavy(body, 9.81, 0.3, (0.6, 0.8), OMEGA, mass=0.3)
    assert rational(heavy.arguments["inertia"][0]) == rational(body.exact[0]) + rational(0.3) ** 3


def test_a_body_that_is_nearly_a_ball_has_its_pole() -> None:
    """Only a ball moves at the pole omega2 = -B2, one motion as in arrays."""
    for omega2 in (-1.0, np.array([-1.0, -1.0])):
        assert np.all(np.equal(atlas.ElementaryMotion(1.0, FIELD, omega2, 0.5).omega3, 0.5))
        with pytest.raises(DomainError, match="pole"):
            atlas.ElementaryMotion(1 + Fraction(1, 10**20), FIELD, omega2, 0.5)


def test_stability_of_a_motion_is_decided_on_the_given_ratio() -> None:
    """The register takes ratio and field of a motion without rounding, in doubles as in balls."""
    ratio, field = Fraction(11, 7), (Fraction(3, 11), Fraction(1, 30))
    motion, family = atlas.ElementaryMotion(ratio, field, 1.7), FAMILIES["elementary"]
    (quantity,) = (x for x in family.quantities if x.name == "stability")
    with workprec():
        assert quantity.value(motion) == nearest(CertifiedHyperbola(ratio, field).stability(1.7))


@pytest.mark.slow
def test_a_page_of_three_components_takes_the_product_without_rounding() -> None:
    """The tables of a page evaluate mu B/2 of three moments exactly: the report file has the product as a fraction."""
    words = "--inertia .8 1 1.3 --magnetic .2 .7 -.3 --mu 1.3 --omega .3 .7 .2"
    with COMMANDS["asymmetric"].make_context("asymmetric", words.split()) as context:
        request = page_request(FAMILIES["asymmetric"], context.params)
    parameters = table_of(request, "properties", "asymmetric", request.exact_values)["parameters"]
    report_thing = FamilyObject.from_request(Request([body_records.body_and_field(None, None)], parameters, 10))
    product = [Fraction(1.3) * Fraction(B) / 2 for B in (0.2, 0.7, -0.3)]
    assert [Fraction(int(x.p), int(x.q)) for x in report_thing.balls().field] == product
    assert [Fraction(*x.as_integer_ratio()) for x in report_thing.kernels().arguments["field"]] == product
    assert report_thing.numbers["field"] == [*map(float, product)]


def test_a_page_in_natural_units_takes_the_product_without_rounding() -> None:
    """Two components mu B/2 in natural units are fractions in the report file, which its tables evaluate exactly."""
    words = "--ratio 0.873 --magnetic -1.429 1.091 --mu 1.5 --omega -0.1972 -0.7 1"
    with COMMANDS["general"].make_context("general", words.split()) as context:
        request = page_request(FAMILIES["general"], context.params)
    assert case_of(request).exact_components == tuple(Fraction(1.5) * Fraction(B) / 2 for B in (-1.429, 1.091))
    assert "/" not in request.field["title"]


def test_a_page_of_points_takes_their_ratio_without_rounding(tmp_path: Path) -> None:
    """The charge-to-mass ratio of points is a fraction in the report file."""
    file = tmp_path / "points.csv"
    file.write_text(
        "x,y,z,mass,charge\n" + "".join(f"{x},{y},0,0.7,0.3\n" for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1)))
    )
    words = ["--points", str(file), "--magnetic", "0.2", "0.7", "--omega", "0.3", "0.7", "0.2"]
    with COMMANDS["general"].make_context("general", words) as context:
        request = page_request(FAMILIES["general"], context.params)
    factor = Fraction(0.3) / Fraction(0.7) / 2
    assert case_of(request).exact_components == (Fraction(0.2) * factor, Fraction(0.7) * factor)
