"""Published benchmarks of a turning body: the reference values are met, and the guide's table has computed values."""

import re
from decimal import Decimal
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

import atlas
from atlas.book.files import find
from atlas.book.load import load
from atlas.pictures import Curve
from atlas.pictures.layers import FloatArray
from atlas.pictures.recipes import load as recipe

BRICK = (0.00189422, 0.006211019, 0.007194665)


def heavy_top() -> FloatArray:
    """Return the displacement of the centre of mass of the fast heavy top at t = 2 s, in Kynema's axes."""
    body = atlas.SymmetricBody(0.234375, 0.46875)
    top = atlas.TopMotion.heavy(body, 9.81, 1.0, (1.0, 0.0), (0.0, -4.61538, 150.0), mass=15.0)
    x, y, z = np.subtract(top.rotation(2.0)[:, 2], [0.0, 0.0, 1.0])
    return np.array([-x, z, y])


def kane() -> FloatArray:
    """Return the quaternion at t = 4 of the free body of revolution with moments 0.04 and 0.02."""
    return atlas.motion((0.04, 0.04, 0.02), (0, 0, 0), (2.0, 4.0, 6.0)).quaternion(4.0)


def orekit() -> FloatArray:
    """Return the largest angles from a uniform rotation up to |t| = 0.1 and 1."""
    omega = 0.05, 0.0, 0.04
    body = atlas.motion((3 / 8, 1 / 2, 5 / 8), (0, 0, 0), omega)
    t = np.linspace(-1.0, 1.0, 2001)
    angle = (Rotation.from_matrix(body.rotation(t)).inv() * Rotation.from_rotvec(np.outer(t, omega))).magnitude()
    return np.array([angle[np.abs(t) < 0.1005].max(), angle.max()])


def toutatis() -> FloatArray:
    """Return the periods of rotation and precession of Toutatis, in days."""
    body: Any = atlas.motion((1, 3.0836, 3.235), (0, 0, 0), np.deg2rad([-98.5, 14.5, 33.7]))
    return np.array([body.period, 2 * np.pi / body.precession_rate])


def brick() -> FloatArray:
    """Return the angular velocity of NASA's tumbling brick at 30 s, in degrees a second."""
    return np.rad2deg(atlas.motion(BRICK, (0, 0, 0), np.deg2rad([10, 20, 30])).angular_velocity(30.0))


CASES = {
    "heavy top": (heavy_top, 2e-6),
    "revolution": (kane, 1e-11),
    "3/8": (orekit, 1e-7),
    "Toutatis": (toutatis, 0.03),
    "brick": (brick, 4e-10),
}


def numbers(cell: str) -> list[float]:
    """Return the numbers of a cell, those before the word within."""
    return [float(text) for text in re.findall(r"-?\d+\.\d+(?:e-?\d+)?", cell.replace("−", "-").split("both")[0])]


@pytest.mark.parametrize("case", CASES)
def test_published_values_are_reproduced(case: str) -> None:
    """Within the error of the source; the guide prints the reference, and the computed value to its last digit."""
    computed, tolerance = CASES[case][0](), CASES[case][1]
    tables: list[Any] = [
        block for page in load(find("guide")).pages for block in page.blocks if getattr(block, "id", "") == "published"
    ]
    (row,) = [row for row in tables[0].rows if case in row[0]]
    assert_allclose(computed, numbers(row[2]), rtol=0, atol=tolerance)
    for value, printed in zip(computed, re.findall(r"−?\d+\.\d+(?:e-?\d+)?", row[3]), strict=True):
        value_printed = Decimal(printed.replace("−", "-"))
        assert abs(value_printed - Decimal(float(value))) <= Decimal(
            (0, (6,), int(value_printed.as_tuple().exponent) - 1)
        )


def test_the_free_body_of_kane_is_reproduced() -> None:
    """By the formulas of section 1.13 of Spacecraft Dynamics, whose phases of up to 70 rad lose 1e-14 in doubles."""
    body, (x, y, z) = atlas.motion((0.04, 0.04, 0.02), (0, 0, 0), (2.0, 4.0, 6.0)), (2.0, 4.0, 6.0)
    t = np.linspace(0.0, 10.0, 20)
    spin, precession = z / 2, np.sqrt(x * x + y * y + z * z / 4)
    s, c, sp, cp = np.sin(spin * t / 2), np.cos(spin * t / 2), np.sin(precession * t / 2), np.cos(precession * t / 2)
    axial = z / (2 * precession) * sp
    expected = [
        sp / precession * (x * c + y * s),
        sp / precession * (y * c - x * s),
        axial * c + cp * s,
        cp * c - axial * s,
    ]
    sign = np.sign((np.transpose(expected) * body.quaternion(t)).sum(axis=1))
    assert_allclose(body.quaternion(t), sign[:, None] * np.transpose(expected), rtol=0, atol=1e-14)


def test_two_of_five_published_simulators_are_reproduced() -> None:
    """Simulators 1 and 4 of NASA's brick, in angular velocity and attitude; the others lose it by their steps."""
    rates, angles = (
        [layer for layer in panel.layers if isinstance(layer, Curve)] for panel in recipe("simulators").scene().panels
    )
    errors_of = {
        rate.label[-1]: (rate.points[:, 1].max(), angle.points[:, 1].max())
        for rate, angle in zip(rates, angles, strict=True)
    }
    for simulator in "14":
        assert np.less(errors_of[simulator], [4e-10, 6e-9]).all()
    of_rates, of_angles = np.transpose([errors_of[simulator] for simulator in "562"])
    assert_allclose(of_rates, [5.0e-5, 4.7e-3, 1.3e-3], rtol=0.05)
    assert_allclose(of_angles, [8.7e-5, 1.04e-2, 3.71], rtol=0.01)
