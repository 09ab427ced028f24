"""Moving figures: layers on a path go as the kernels say, frames share one view, files are whole or absent."""

import re
from base64 import b64decode
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner
from PIL import Image, ImageSequence
from tests_support import names

import atlas
from atlas import AtlasError, ElementaryMotion
from atlas.cli.app import atlas as command_line
from atlas.pictures import Arrow, Curve, Label, Plane, Points, Surface, movement, recipes
from atlas.pictures.any_motion import Upright
from atlas.pictures.drawing import animation
from atlas.pictures.drawing.panels import to_figure

MOVING = ["escape", "film_strip", "flight", "rolling_cones", "tipping_disk"]


def layers(scene: atlas.pictures.Scene, kind: type[Any]) -> list[Any]:
    """Return the layers of a kind in all panels of a scene."""
    return [layer for panel in scene.panels for layer in panel.layers if isinstance(layer, kind)]


def test_each_body_of_the_film_strip_moves_to_the_place_of_the_next() -> None:
    """A step later each stands as the next was drawn, in the wide and the narrow figure, and none is a start still."""
    scene = recipes.load("film_strip").scene()
    later = movement.scene_at(scene, scene.lasts / 7)
    for panels, panels_later in ((scene.panels, later.panels), (scene.narrow, later.narrow)):
        tips, after = (
            [
                layer.tip - layer.tail
                for panel in panels_either
                for layer in panel.layers
                if getattr(layer, "role", "") == "body_axis"
            ]
            for panels_either in (panels, panels_later)
        )
        assert len(tips) == 8
        assert np.allclose(after[:-1], tips[1:], atol=1e-13)
    assert "start" not in {label.text for label in layers(scene, Label)}


@pytest.mark.slow
@pytest.mark.parametrize("name", MOVING)
def test_the_command_reports_an_animation_that_does_not_close(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where the paths of a figure do not end as the identity, the command tells it beside the file's name."""
    monkeypatch.setattr(animation, "FRAMES", 2)
    scene = recipes.load(name).scene()
    ends = [path(np.array([scene.lasts])) for path in scene.paths.values()]
    closed = all(np.abs(R[0] - np.eye(len(R[0]))).max() < 1e-4 and np.abs(s[0]).max() < 1e-4 for R, s in ends)
    assert closed == (name == "film_strip")
    done = CliRunner().invoke(command_line, ["animate", name, "--dpi", "20", "--out", str(tmp_path)])
    file = tmp_path / f"{name}.gif"
    assert done.stdout == f"{file}\n"
    assert done.stderr == (
        "" if closed else f"{file}: the motion does not end as it began, so that it jumps where it is repeated.\n"
    )


def test_the_film_of_the_readme_closes_and_is_small() -> None:
    """Its last frame leads to its first by no more than one frame to the next does; it has at most a megabyte."""
    readme = Path(__file__).parents[2] / "README.md"
    (name,) = re.findall(r"\]\((\S+\.gif)\)", readme.read_text(encoding="utf-8"))
    file = readme.parent / name
    with Image.open(file) as film:
        frames = np.array([np.asarray(frame.convert("L"), dtype=float) for frame in ImageSequence.Iterator(film)])
    steps = np.abs(np.roll(frames, -1, axis=0) - frames).mean(axis=(1, 2))
    assert len(frames) >= 30
    assert 0.0 < steps[-1] <= 1.2 * steps[:-1].max()
    assert file.stat().st_size <= 1_000_000


def jumps(motion: Any, times: Any = None) -> bool:
    """Return whether the animation of a motion says that its loop jumps; its frames are not written."""
    moving = motion.animate(times)
    moving._draw_was_started = True  # Matplotlib warns of animations that nobody sees
    return moving.jumps


@pytest.mark.slow
@pytest.mark.parametrize(("p", "q", "periods"), [(-1, 1, 1), (2, 3, 3)])
def test_an_animation_of_a_closed_motion_closes(p: int, q: int, periods: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """It lasts until the body is back; a frame after the last would be the first, its trace included."""
    monkeypatch.setattr(animation, "FRAMES", 4)
    times_made: list[float] = []
    draw = animation.any_motion.scene_at
    monkeypatch.setattr(
        animation.any_motion, "scene_at", lambda motion, t, begin: times_made.append(t) or draw(motion, t, begin)
    )
    motion = atlas.Hyperbola(1.5, (1.0, 2.0)).closed(p, q)
    assert not jumps(motion)
    times = np.unique(times_made)
    after = times[-1] + times[1]
    assert after == pytest.approx(periods * abs(2 * np.pi / motion.k))
    assert np.abs(motion.rotation(after) - np.eye(3)).max() < 1e-12
    tips_first, second = (
        [
            points
            for kind in (Curve, Arrow)
            for layer in layers(draw(motion, t, t - after), kind)
            for points in movement.points_of(layer)
        ]
        for t in (0.0, after)
    )
    assert len(tips_first) > 2
    assert all(np.abs(a - b).max() < 1e-9 for a, b in zip(tips_first, second, strict=True))


def test_an_animation_warns_if_the_motion_does_not_close(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without times; with times of the user's own nothing is said."""
    monkeypatch.setattr(animation, "FRAMES", 2)
    motion = atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2))
    assert jumps(motion)
    assert not jumps(motion, [0.0, 0.4])


def test_cones_touch_along_omega_at_every_time() -> None:
    """The arrow of omega lies on the cone of the body and on that of space, and is along R(t) Omega."""
    scene, motion = recipes.load("rolling_cones").scene(), ElementaryMotion(1.5, (1.0, 2.0), -1.4)
    for t in (0.9, 4.0):
        panel = movement.scene_at(scene, t).panels[0]
        (omega,) = (arrow.tip for arrow in panel.layers if getattr(arrow, "role", "") == "velocity")
        true = motion.rotation(t) @ motion.angular_velocity(t)
        assert np.linalg.norm(np.cross(omega, true)) < 1e-12 * np.linalg.norm(true)
        for cone in (layer for layer in panel.layers if isinstance(layer, Surface)):
            assert abs(np.array([*omega, 1.0]) @ cone.quadric @ [*omega, 1.0]) < 1e-12


@pytest.mark.parametrize("name", MOVING)
def test_moving_layers_have_a_path_and_start_where_they_are_drawn(name: str) -> None:
    """Each path is followed by a layer and is rigid; at t = 0 nothing is moved; surfaces take their form along."""
    scene = recipes.load(name).scene()
    rides = {
        layer.rides for panel in (*scene.panels, *scene.narrow) for layer in panel.layers if hasattr(layer, "rides")
    }
    assert rides - {""} == {*scene.paths}
    assert scene.lasts > 0.0
    for path in scene.paths.values():
        R, s = path(np.array([0.0, 0.3 * scene.lasts]))
        assert np.abs(R[0] - np.eye(len(s[0]))).max() < 1e-13
        assert np.abs(s[0]).max() < 1e-12
        assert np.abs(R @ R.swapaxes(1, 2) - np.eye(len(s[0]))).max() < 1e-13
    for surface in layers(movement.scene_at(scene, 0.3 * scene.lasts), Surface):
        grid = np.concatenate([np.reshape(grid_points, (-1, 3)) for grid_points in surface.grids])
        homogeneous = np.concatenate([grid, np.ones((len(grid), 1))], axis=1)
        assert np.abs(np.einsum("ni,ij,nj->n", homogeneous, surface.quadric, homogeneous)).max() < 1e-9
        assert (grid @ surface.clip[:, :3].T <= surface.clip[:, 3] + 1e-9).all()


def test_dots_stay_on_their_curves() -> None:
    """At any time the dots of the tipping disk are at the angle of its axis then."""
    scene = recipes.load("tipping_disk").scene()
    motion = atlas.GeneralMotion(2.0, (0.0, 1.0), (1e-3, 0.0, -1.0))
    dots = [layer for layer in movement.scene_at(scene, 7.0).panels[-1].layers if isinstance(layer, Points)]
    for dot in dots:
        ((t, degrees),) = dot.points
        x, y, z = motion.third_axis(t)
        assert degrees == pytest.approx(np.degrees(np.arctan2(np.hypot(x, y), z)), abs=1e-9)


def test_a_cone_as_flat_as_a_disk_is_drawn() -> None:
    """With omega3 = 0 the body's cone has a right angle: it is the disk across its axis."""
    scene = recipes.load("rolling_cones").scene(omega2=-0.5)
    disk = next(surface for surface in layers(scene, Surface) if surface.within)
    assert np.abs(disk.rims[0][:, 2]).max() < 1e-12
    assert np.linalg.norm(disk.rims[0], axis=1).min() == pytest.approx(1.0)


def test_values_of_frames_may_be_a_series(tmp_path: Path) -> None:
    """Whatever its index."""
    moving = atlas.animate("cone", "azimuth", pd.Series([10.0, 20.0], index=["a", "b"]))
    file = tmp_path / "cone.gif"
    animation.save(moving, file, "gif", 10.0, 20)
    with Image.open(file) as film:
        assert film.n_frames == 2


@pytest.mark.slow
def test_frames_share_one_view() -> None:
    """Over omega2 the arrow of the field, which is the same in all frames, is drawn at the same place in all."""
    moving = animation.Frames(
        lambda k: recipes.load("rolling_cones").scene(omega2=-1.2 - 0.6 * k), 2, None, lambda *_: None
    )
    places = []
    for k in range(2):
        moving.draw(k)
        (head,) = moving.figure.findobj(
            lambda artist: str(artist.get_gid()).startswith("field-1-") and hasattr(artist, "get_xy")
        )
        places.append(head.get_xy())
    assert np.ptp(places, axis=0).max() < 1e-9
    figures = [atlas.figure("rolling_cones", omega2=-1.2 - 0.6 * k) for k in (0, 1)]
    heads = [
        figure.findobj(lambda o: str(o.get_gid()).startswith("field-1-") and hasattr(o, "get_xy"))[0].get_xy()
        for figure in figures
    ]
    assert np.ptp(heads, axis=0).max() > 1.0


@pytest.mark.slow
@pytest.mark.parametrize("name", ["rolling_cones", "tipping_disk"])
def test_a_frame_has_the_pixels_of_a_still_figure_of_its_time(name: str) -> None:
    """Layout and texts are kept from frame to frame: a figure made anew in the same view shows no difference."""
    scene = recipes.load(name).scene()
    moving = animation.Frames(lambda k: movement.scene_at(scene, 0.3 * k * scene.lasts), 3, None, lambda *_: None)
    pictures = []
    for k in range(3):
        moving.draw(k)
        figure_still = to_figure(moving._scene(k), hold=moving._hold)
        for figure in (moving.figure, figure_still):
            file = BytesIO()
            figure.savefig(file, format="raw", dpi=60)
            pictures.append(file.getvalue())
    assert pictures[::2] == pictures[1::2]
    assert len(set(pictures)) == 3


@pytest.mark.slow
def test_limits_of_axes_are_equal_in_all_frames() -> None:
    """Limits that a recipe chooses for each value are those that hold all of them."""
    moving = animation.Frames(
        lambda k: recipes.load("frequencies").scene(field=(1.0, 0.2 + k)), 2, None, lambda *_: None
    )
    limits = []
    for k in range(2):
        moving.draw(k)
        limits.append([(axes.get_xlim(), axes.get_ylim()) for axes in moving.figure.axes])
    assert limits[0] == limits[1]
    for k in range(2):
        scene = recipes.load("frequencies").scene(field=(1.0, 0.2 + k))
        for panel, (x, y) in zip(scene.panels, limits[0], strict=True):
            assert isinstance(panel, Plane)
            for limits_given, limits_held in ((panel.x_limits, x), (panel.y_limits, y)):
                assert limits_given is None or (limits_held[0] <= limits_given[0] and limits_given[1] <= limits_held[1])


def run(words: str, folder: Path) -> Any:
    """Run `atlas animate` in process; its output goes to a folder."""
    return CliRunner().invoke(command_line, ["animate", *words.split(), "--dpi", "40", "--out", str(folder)])


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["gif", "apng"])
def test_a_file_has_as_many_frames_as_requested(tmp_path: Path, kind: str) -> None:
    """So many frames as asked for, which differ, and nothing else in the folder."""
    done = run(f"cone --over azimuth=0:80:3 --fps 10 --format {kind}", tmp_path)
    assert done.output == f"{tmp_path / f'cone.{kind}'}\n"
    assert names(tmp_path) == [f"cone.{kind}"]
    with Image.open(tmp_path / f"cone.{kind}") as picture:
        assert picture.n_frames == 3
        frames = []
        for k in range(3):
            picture.seek(k)
            frames.append(np.asarray(picture.convert("RGB"), dtype=int))
        assert picture.info["duration"] == 100
    assert np.abs(frames[0] - frames[1]).mean() > 0.5


@pytest.mark.slow
def test_an_mp4_is_encoded_by_ffmpeg_from_the_frames(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Matplotlib's writer gives raw frames to the program; here one that keeps them stands for it."""
    program, out = tmp_path / "ffmpeg", tmp_path / "out"
    program.write_text('#!/bin/sh\nfor last; do :; done\ncat > "$last"\n')
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    done = run("cone --over azimuth=0:80:2 --format mp4", out)
    assert done.exit_code == 0, done.exception
    (file,) = (out / name for name in names(out))
    width, height = (2 * int(length / 25.4 * 40 / 2) for length in recipes.load("cone").scene().size)
    assert abs(file.stat().st_size / (2 * 4 * width * height) - 1) < 0.05


def test_without_ffmpeg_an_mp4_is_refused_in_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An mp4 is refused before anything is drawn."""
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(AtlasError, match="ffmpeg, which is not installed"):
        animation.check("mp4", 20)


@pytest.mark.slow
def test_animate_draws_the_body_at_its_position(tmp_path: Path) -> None:
    """`animate` of a symmetric body, of a top and of one with three moments; of an array it says why not."""
    motion = atlas.EllipticMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), 1.7)
    scene = animation.any_motion.scene_at(motion, 0.8, 0.0)
    (axis,) = (arrow for arrow in layers(scene, Arrow) if arrow.role == "body_axis")
    assert np.allclose(axis.tip / np.linalg.norm(axis.tip), motion.third_axis(0.8))
    for t, start in ((0.8, 0.5), (0.2, -0.1)):  # the trace of its tip over the time before
        (trace,) = (curve.points for curve in layers(animation.any_motion.scene_at(motion, t, start), Curve))
        ends = np.array([motion.third_axis(start), motion.third_axis(t)])
        assert np.allclose(trace[[0, -1]], np.linalg.norm(axis.tip) * ends)
    corners = np.unique(np.round(np.concatenate([surface.rims[0] for surface in layers(scene, Surface)]), 9), axis=0)
    second = np.einsum("ni,nj->ij", corners, corners)  # of a brick along its axes, as its moments are
    in_body = motion.rotation(0.8).T @ second @ motion.rotation(0.8)
    spread = np.diag(in_body)
    assert np.allclose(in_body, np.diag(spread), atol=1e-8)
    moments = spread.sum() - spread
    assert np.allclose(moments / moments[1], np.array([0.8, 1.0, 1.3]), atol=1e-8)
    moving = atlas.TopMotion((1, 0.5), (0, 0), (0.6, 0.8), (0.1, 0.2, 5.0), linear=3.0).animate([0.0, 0.4])
    animation.save(moving, tmp_path / "top.gif", "gif", 10, dpi=30)
    gif = Image.open(BytesIO(b64decode(moving._repr_mimebundle_()["image/gif"])))  # in a notebook
    assert (gif.format, gif.n_frames) == ("GIF", 2)
    assert np.abs(np.array(gif.size) - 96 * moving._fig.get_size_inches()).max() <= 1  # as large as on paper
    assert gif.info["duration"] == 1000 / 20  # without a wish twenty frames a second, as by the command
    with pytest.raises(AtlasError, match="not an array"):
        ElementaryMotion(1.5, (1.0, 2.0), [0.1, 0.2]).animate()


def test_the_upward_direction_is_the_given_one_or_the_field_or_the_momentum() -> None:
    """Of a free body, I2 = 1 across the axis, whichever way it turns; of a body at rest the axis itself."""
    upright = Upright.of_motion(atlas.FreeMotion(1.5, (0.3, -0.7, 0.2)))
    np.testing.assert_allclose(upright.vector, (0.3, -0.7, 0.2 * 1.5), rtol=1e-15)
    assert upright.letter == r"\mathbf{m}"
    assert Upright.of_motion(atlas.FreeMotion(1.5, (0.0, 0.0, 0.0))).vector == (0.0, 0.0, 1.0)
    assert Upright.of_motion(atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7)).vector == (0.0, 1.0, 2.0)
