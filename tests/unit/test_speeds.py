"""Speeds beside that of light: where units are known, one line above a tenth of it, and no drift at or above it."""

import subprocess
import sys
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import atlas
from atlas.bodies.speeds import fastest_point
from atlas.book.body_and_field import Body, Field, body_and_field
from atlas.errors import RelativisticWarning

C = 299792458.0  # m/s
CHARGE = "particle --mu 1 --times 1 --magnetic 0 0 1 --electric"
SPHERE = "motion --shape sphere --radius 1 --mass 1 --charge 1e-9 --times 1 --magnetic 0 1 --omega 0 0"


def run(words: str) -> tuple[int, str]:
    """Return the status of a command and its lines on standard error."""
    done = subprocess.run(
        [sys.executable, "-m", "atlas", *words.split()], capture_output=True, text=True, check=False, timeout=120
    )
    return done.returncode, done.stderr


@pytest.mark.parametrize(
    ("words", "status", "says"),
    [
        (f"{CHARGE} 0 1e9 0 --units si", 2, "3.33564 times the speed of light"),
        (f"{CHARGE} 0 1 0 --units gaussian", 2, "1 times the speed of light"),
        (f"{CHARGE} 0 1e8 1e7 --units si", 0, "the drift c [E, B]/B^2 is 0.334 times"),
        (f"{CHARGE} 0 2e7 0 --units si", 0, ""),
        (f"{CHARGE} 0 2 0", 0, ""),
        (f"{CHARGE} 0 0 0 --units si --velocity 6e7 0 0", 0, "the velocity at t = 0 is 0.2 times"),
        (f"{CHARGE} 0 0 6e7 --units si", 0, "the velocity at t = 1 is 0.2 times"),
        (f"{CHARGE} 6e7 0 0 --units si --magnetic 0 0 0", 0, "the velocity at t = 1 is 0.2 times"),
        (f"{SPHERE} 1e8", 0, "the surface at t = 0 is 0.334 times"),
        (f"{SPHERE} 1e7", 0, ""),
    ],
)
def test_speeds_near_light_are_reported_in_one_line(words: str, status: int, says: str) -> None:
    """In natural units nothing is known; above a tenth of c there is a line, and a superluminal drift has no answer."""
    status_found, errors = run(words)
    assert status_found == status
    assert errors.count("\n") == bool(says)
    assert says in errors


@pytest.mark.parametrize("mu", [1.0, -3e7])
def test_fields_with_known_units_know_their_drift(mu: float) -> None:
    """The part of E across B counts: E = c B in SI, E = B in Gaussian units is the border."""
    make: Any
    for make, light in ((atlas.Field.si, C), (atlas.Field.gaussian, 1.0)):
        transverse, parallel = np.array([0.0, 0.6, 0.8]) * 2.0, np.array([0.0, -0.8, 0.6])
        for share in (1.0 + 1e-9, 3.0):
            with pytest.raises(atlas.DomainError, match="must stay below"):
                make(parallel * 2.0, share * light * transverse, mu=mu)
        with pytest.warns(RelativisticWarning, match="is 0.5 times the speed of light"):
            make(parallel * 2.0, 0.5 * light * transverse + 7 * light * parallel, mu=mu)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            make(parallel * 2.0, 0.099 * light * transverse + 7 * light * parallel, mu=mu)
            make((0, 0, 0), transverse, mu=mu)


def test_a_report_refuses_a_field_that_drifts_faster_than_light() -> None:
    """Where its field is given in SI."""
    body = Body(title="a grain", shape="sphere", radius=1e-6, mass=1e-15, charge=1e-15)
    with pytest.raises(atlas.DomainError, match="electric field: the drift"):
        body_and_field(body, Field(title="a trap", B=(0.0, 0.0, 1.0), E=(0.0, 1e9, 0.0), system="SI"))


@pytest.mark.parametrize(
    ("shape", "sizes"),
    [
        ("sphere", {"radius": 2.0}),
        ("spheroid", {"equatorial": 2.0, "polar": 0.5}),
        ("spheroid", {"equatorial": 0.5, "polar": 3.0}),
        ("solid_cylinder", {"radius": 1.0, "height": 4.0}),
        ("disk", {"radius": 1.5}),
        ("thin_rod", {"length": 3.0}),
    ],
)
def test_the_fastest_point_of_a_body_is_the_fastest_of_many(shape: str, sizes: dict[str, float]) -> None:
    """Points drawn at random on the surface come near, and none is faster."""
    random = np.random.default_rng(7)
    u = random.normal(size=(200_000, 3))
    u /= np.linalg.norm(u, axis=1)[:, None]
    r, half = sizes.get("radius", 0.0), sizes.get("height", sizes.get("length", 0.0)) / 2
    if shape in ("sphere", "spheroid"):
        x = u * [sizes.get("equatorial", r), sizes.get("equatorial", r), sizes.get("polar", r)]
    else:
        flat = u[:, :2] / np.linalg.norm(u[:, :2], axis=1)[:, None]
        x = np.column_stack([r * flat, half * np.sign(u[:, 2])])
    for omega in ((0.0, 0.0, 2.0), (0.3, -0.7, 0.4), (1.0, 0.0, 0.0)):
        fastest = np.linalg.norm(np.cross(omega, x), axis=1).max()
        assert fastest_point(shape, sizes, omega) == pytest.approx(fastest, rel=2e-3)


@pytest.mark.slow
def test_points_and_sweeps_know_their_speed_too(tmp_path: Path) -> None:
    """The point farthest from the axis counts, and of a sweep the largest angular velocity, in one line."""
    points = tmp_path / "p.csv"
    square = ["1,0,0,1,1", "-1,0,0,1,1", "0,1,0,1,1", "0,-1,0,1,1", "0,0,9,1,1", "0,0,-9,1,1"]
    points.write_text("\n".join(["x,y,z,mass,charge", *square]) + "\n", encoding="utf-8")
    field, out = "--magnetic 1 2", f"--quantity kind --out {tmp_path / 's.csv'}"
    status, errors = run(f"motion --points {points} {field} --spin 1e8")
    assert (status, errors.count("\n")) == (0, 1)
    assert "a point of the body at t = 0 is 0.334 times" in errors
    sphere = f"sweep general --shape sphere --radius 1 --mass 1 --charge 1 {field} {out} --set omega1=0 omega2=0"
    status, errors = run(f"{sphere} omega3=1,1e8,-2e8")
    assert (status, errors.count("\n")) == (0, 1)
    assert "the surface at t = 0 is 0.667 times" in errors
    assert run(f"{sphere} omega3=1,2 --jobs 1") == (0, "")
