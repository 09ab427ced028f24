"""Lines of motions: their sum is the motion, their squares its mean square, and a transform of samples shows them."""

import json
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import atlas
from atlas.cli.app import atlas as command
from atlas.pictures import Curve
from atlas.pictures.recipes import load

METHODS = {
    "rotation": "rotation", "axis": "third_axis", "angular_velocity": "angular_velocity", "field": "field_in_body",
}  # fmt: skip
WHOLE, TIMES = 1e-13, np.array([0.0, 0.37, -11.3, 60.7])
OBLIQUE = [[2, 0.1, 0], [0.1, 1.5, 0.2], [0, 0.2, 1]]

MOTIONS = {
    "general": lambda: atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2)),
    "oblique field": lambda: atlas.motion(0.6, (0.3, 0.5, 2.0), (0.3, 0.7, 0.2), np.roll(np.eye(3), 1, 0)),
    "free": lambda: atlas.motion(1.5, (0, 0, 0), (0.3, 0.7, 0.2), np.roll(np.eye(3), 1, 0)),
    "ball": lambda: atlas.BallMotion(1.0, 0.5, (0.3, -0.7)),
    "ball that nutates": lambda: atlas.GeneralMotion(1.0, (1.0, 2.0), (0.3, 0.7, 0.2)),
    "elementary": lambda: atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7),
    "at rest": lambda: atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.0),
    "spin along the field": lambda: atlas.GeneralMotion(1.5, (0.0, 1.0), (0.0, 0.0, 0.3)),
    "top": lambda: atlas.TopMotion((2.0, 1.5), (0.3, 0.9), (0.6, -0.8), (0.1, 0.2, 1.0), 0.2, -1.0),
    "pendulum through a pole": lambda: atlas.TopMotion((1.0, 0.5), (0, 0), (0.6, 0.8), (0.3, 0.0, 0.0), -1.0),
    "pendulum that turns over": lambda: atlas.TopMotion((1.0, 0.5), (0, 0), (0.6, 0.8), (3.0, 0.0, 0.0), -1.0),
    "next to a separatrix": lambda: atlas.TopMotion((1.0, 1.0), (0, 0), (1.0, 0.0), (2.0001, 0.0, 0.0), 2.0),
    "elliptic": lambda: atlas.EllipticMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), 1.7),
    "torus": lambda: atlas.motion(OBLIQUE, (0.3, 0, 1), (0.1, 0.2, 3.0)),
    "Euler's top": lambda: atlas.AsymmetricMotion((0.8, 1.0, 1.3), (0, 0, 0), (0.3, 0.7, 0.2)),
    "two equal moments": lambda: atlas.AsymmetricMotion((0.8, 1.0, 1.0), (0.2, 1.0, 0.6), (0.3, 0.7, 0.2)),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", MOTIONS)
def test_lines_add_up_to_the_motion(name: str) -> None:
    """At other times than those it was sampled at, and to the mean square (Parseval), 3 of R and 1 of an axis."""
    motion = MOTIONS[name]()
    for quantity, method in METHODS.items():
        if not hasattr(motion, method):
            continue
        lines, values = motion.spectrum(quantity, least=WHOLE), getattr(motion, method)(TIMES)
        assert np.abs(lines(TIMES) - values).max() <= 2e-12 * max(np.abs(values).max(), 1e-9), quantity
        assert lines.power.sum() == pytest.approx(lines.mean_square, rel=1e-14, abs=1e-300)
        if quantity in ("rotation", "axis"):
            assert lines.mean_square == pytest.approx(3 if quantity == "rotation" else 1, rel=1e-13)
        elif quantity == "field":
            assert lines.mean_square == pytest.approx((values[0] ** 2).sum(), rel=1e-13)
        assert (np.diff(lines.frequencies) > 0).all()
        assert lines.combinations @ lines.rates == pytest.approx(lines.frequencies, rel=1e-15, abs=1e-14)


def test_a_transform_of_a_long_grid_shows_the_lines() -> None:
    """With Hann's window: a maximum at each line, as high as its amplitude, and nothing as high between."""
    motion = MOTIONS["general"]()
    count, step = 1 << 15, 0.25
    x = motion.rotation_grid(0.0, step, count)[:, 0, 2]
    size = 2 * abs(np.fft.rfft(x * np.hanning(count))) / count
    frequencies = np.fft.rfftfreq(count, step) * 2 * np.pi
    lines = motion.spectrum("axis", least=1e-3)
    is_seen = np.zeros(len(size), dtype=bool)
    for f, a in zip(lines.frequencies, abs(lines.amplitudes[:, 0]), strict=True):
        if f >= 0 and a > 1e-3:
            is_near = abs(frequencies - f) < 40 * frequencies[1]
            is_seen |= is_near
            # between two points of the transform a line of Hann's window is lower by 15 % at most
            assert 0.84 * a <= size[is_near].max() <= 1.001 * a
    assert size[~is_seen].max() < 1e-3


def test_an_elementary_motion_has_two_lines() -> None:
    """The axis has one along the field and one of precession, k = omega2 b/B2, (79), cos and sin of their angle."""
    lines = atlas.ElementaryMotion(1.5, (3.0, 4.0), 0.6).spectrum("axis")
    assert lines.names == ("precession",)
    assert lines.frequencies == pytest.approx([-1.0, 0.0, 1.0])
    assert np.sqrt(lines.power) == pytest.approx([0.6 / np.sqrt(2), 0.8, 0.6 / np.sqrt(2)])


def test_motions_without_spectral_lines_are_refused() -> None:
    """A separatrix, arrays, and quantities that no motion has."""
    motion = MOTIONS["general"]()
    with pytest.raises(atlas.DomainError, match="separatrix"):
        atlas.TopMotion((1.0, 1.0), (0.0, 0.0), (1.0, 0.0), (2.0, 0.0, 0.0), 2.0).spectrum()
    with pytest.raises(atlas.AtlasError, match="not of an array"):
        atlas.GeneralMotion([1.5, 1.2], (1.0, 2.0), (0.3, 0.7, 0.2)).spectrum()
    with pytest.raises(atlas.AtlasError, match="choose from rotation, axis"):
        motion.spectrum("spin")
    with pytest.raises(atlas.AtlasError, match="from 1e-13 to 1"):
        motion.spectrum(least=0.0)


@pytest.mark.parametrize(
    "body",
    ["--ratio 1.5 --field 1 2", pytest.param("--tensor 2 1.5 1 0.1 0 0.2 --field 0.3 0 1", marks=pytest.mark.slow)],
)
def test_the_command_prints_the_lines_of_the_motion(body: str) -> None:
    """As a table and in JSON, of the axis unless another function is named."""
    words = ["motion", *body.split(), *"--omega 0.3 0.7 0.2 --least 1e-2 --spectrum".split()]
    lines_printed = json.loads(CliRunner().invoke(command, [*words, "--json"], catch_exceptions=False).stdout)[
        "spectrum"
    ]
    inertia: Any = 1.5 if "ratio" in body else [[2, 0.1, 0], [0.1, 1.5, 0.2], [0, 0.2, 1]]
    lines = atlas.motion(inertia, (0, 1, 2) if "ratio" in body else (0.3, 0, 1), (0.3, 0.7, 0.2)).spectrum("axis", 1e-2)
    assert [x["frequency"] for x in lines_printed["lines"]] == pytest.approx(lines.frequencies.tolist())
    output = CliRunner().invoke(command, words, catch_exceptions=False).stdout
    assert "spectrum of the axis" in output
    assert f"{lines.frequencies.max():.10g}" in output
    refused = CliRunner().invoke(command, [*words, "--digits", "20"])
    assert refused.exit_code == 2
    assert "--digits" in refused.output


@pytest.mark.parametrize(
    "parameters", [{}, {"ratio": 1.0}, {"omega": (0.0, 0.7, 0.6588235294117647)}, {"field": (0, 1)}]
)
def test_the_figure_draws_the_lines(parameters: Any) -> None:
    """One stem for each line that is not negative, as high as its amplitude beside the whole."""
    panels = load("spectrum").scene(**parameters).panels
    parameters_of_motion = {"ratio": 1.5, "field": (1.0, 2.0), "omega": (0.3, 0.7, 0.2), **parameters}
    for panel, quantity in zip(panels, ("axis", "angular_velocity"), strict=True):
        lines = atlas.GeneralMotion(**parameters_of_motion).spectrum(quantity, 1e-4)
        stems = sorted(tuple(x.points[1]) for x in panel.layers if isinstance(x, Curve))
        size = np.sqrt(lines.power / lines.mean_square)[lines.frequencies >= 0]
        assert np.array(stems) == pytest.approx(np.column_stack([lines.frequencies[lines.frequencies >= 0], size]))
