"""Animations: one scene after the other in one figure, all frames in one view and at one scale."""

from base64 import b64encode
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from os import PathLike
from pathlib import Path
from subprocess import CalledProcessError
from tempfile import TemporaryDirectory
from typing import Any, TypeAlias

import numpy as np
from matplotlib.animation import FFMpegWriter, FuncAnimation, PillowWriter
from matplotlib.backends.backend_agg import FigureCanvasAgg

from atlas import files
from atlas.arithmetic.annotations import StyleLike
from atlas.arithmetic.inputs import positive
from atlas.errors import AtlasError, unknown
from atlas.pictures import any_motion, movement, recipes
from atlas.pictures.drawing.panels import laid_out, to_figure
from atlas.pictures.drawing.style import context
from atlas.pictures.drawing.view import Placement, hold, named
from atlas.pictures.layers import Label, Panel, Plane, Points, Scene, Space, cloud, frame

FASTEST = {"mp4": 60, "gif": 50, "apng": 60}
"""Largest number of frames per second, by kind of file."""
FPS, FRAMES, MAX_FRAMES = 20.0, 60, 2000
MAX_PERIODS = 8
"""Largest number of periods of a motion in its animation, whether the motion is closed or not."""
_SCREEN = 96
Progress: TypeAlias = Callable[[int, int, str], None]
Extent: TypeAlias = Space | tuple[tuple[float, float], tuple[float, float]]
"""Data that decide a panel's view: in space a panel of extreme points and names, else the limits of both axes."""


class Frames:
    """Frames of an animation in one figure; `make(k)` returns the scene of frame k, 0 <= k < `count`.

    `style` is as for `atlas.figure`; `progress` is called with (steps done, steps, "view" or "frames"). Each scene
    is made twice, first to find a view that contains all scenes, so that no scene stays in memory. `figure` is the
    Matplotlib figure. Raises AtlasError for scenes with different panels.
    """

    def __init__(self, make: Callable[[int], Scene], count: int, style: Any, progress: Progress) -> None:
        self.make, self.count, self.style, self.progress = make, count, style, progress
        self.extents: list[tuple[Extent, ...]] = []
        for k in range(count):
            scene = make(k)
            with context(style):
                self.extents.append(tuple(_extents(scene)))
            if [*map(type, self.extents[k])] != [*map(type, self.extents[0])]:
                raise AtlasError("the panels of this figure change, so that it can't be one that moves")
            progress(k + 1, 2 * count, "view")
        self.figure = to_figure(self._scene(0), style)
        FigureCanvasAgg(self.figure)  # whose renderer keeps the texts that it has typeset
        self._placements: dict[tuple[int, tuple[float, float]], Placement] = {}

    def draw(self, k: int) -> None:
        """Clear the figure and draw frame k, 0 <= k < `count`, into it; report progress."""
        boxes = [axes.get_position(original=True) for axes in self.figure.axes]
        self.figure.clear()
        to_figure(self._scene(k), self.style, figure=self.figure, boxes=boxes, hold=self._hold)
        self.progress(self.count + k + 1, 2 * self.count, "frames")

    def _scene(self, k: int) -> Scene:
        """Return the scene of frame k; its panels with two axes have the limits that hold all frames."""
        scene = self.make(k)
        return replace(scene, panels=tuple(self._limited(i, panel) for i, panel in enumerate(scene.panels)))

    def _limited(self, i: int, panel: Panel) -> Panel:
        if isinstance(panel, Space):
            return panel
        ends = np.array([extent[i] for extent in self.extents])
        x, y = ((float(ends[:, j].min()), float(ends[:, j].max())) for j in (0, 1))
        return replace(panel, x_limits=x, y_limits=y)

    def _hold(self, i: int, window: tuple[float, float]) -> Placement:
        """Return the `Placement` of panel i in space, common to all frames, in a window (width, height) in points."""
        if (i, window) not in self._placements:
            self._placements[i, window] = hold([extent[i] for extent in self.extents], window)
        return self._placements[i, window]


class Moving(FuncAnimation):
    """A Matplotlib animation that a notebook shows as a GIF, since Matplotlib's player loads icons from another host.

    `fps` is the number of frames a second; `jumps` is True where the last frame certainly does not lead back to the
    first.
    """

    fps = FPS
    jumps = False

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        """Return the animation as a GIF for a notebook, {"image/gif": base 64, "text/plain": text}."""
        with TemporaryDirectory() as folder:
            path = Path(folder) / "moving.gif"
            save(self, path, "gif", fps=min(max(self.fps, 1.0), FASTEST["gif"]), dpi=_SCREEN)
            return {"image/gif": b64encode(path.read_bytes()).decode(), "text/plain": repr(self)}


def _extents(scene: Scene) -> Iterator[Extent]:
    """Yield for each panel the extent that fixes its view: a `Space` of few points, or the limits of a `Plane`.

    Limits are ((low, high) in x, (low, high) in y); those that the panel leaves open are those that Matplotlib chooses.
    """
    is_open = any(isinstance(plane, Plane) and not (plane.x_limits and plane.y_limits) for plane in scene.panels)
    all_axes = [axes for axes, _ in laid_out(scene)[1]] if is_open else [None] * len(scene.panels)
    for panel, axes in zip(scene.panels, all_axes, strict=True):
        if isinstance(panel, Space):
            yield _reduced(panel)
        else:
            yield (axes.get_xlim(), axes.get_ylim()) if axes else (panel.x_limits, panel.y_limits)


def _reduced(panel: Space) -> Space:
    """Return a panel with the same extent and few points: the extremes along the axes and on paper, and the names."""
    eye = frame(panel)
    points = cloud(panel)
    heights = points @ np.concatenate([np.eye(3), eye[:2]]).T
    extremes = points[np.unique(np.concatenate([heights.argmin(axis=0), heights.argmax(axis=0)]))]
    names = filter(None, (named(layer, eye) for layer in panel.layers))
    labels = (Label(place, text, role, offset) for text, place, offset, role in names)
    return replace(panel, layers=(Points(extremes, "origin"), *labels))


def animation(
    make: Callable[[int], Scene],
    count: int,
    *,
    fps: float = FPS,
    style: StyleLike = None,
    progress: Progress | None = None,
) -> Moving:
    """Return the scenes `make(k)`, 0 <= k < count, as a Matplotlib animation of `fps` frames a second.

    `style` is as for `atlas.figure`; `progress`, if given, is called with (steps done, steps, "view" or "frames").
    Raises AtlasError unless 2 <= count <= 2000, for `fps` that is not positive, and for scenes with different
    panels.
    """
    if not 2 <= count <= MAX_FRAMES:
        raise AtlasError(f"an animation has from 2 to {MAX_FRAMES} frames, not {count}")
    fps = positive(fps, "fps")
    frames = Frames(make, count, style, progress or (lambda _done, _total, _what: None))
    options = {"init_func": lambda: None, "interval": 1000.0 / fps, "blit": False}
    moving = Moving(frames.figure, frames.draw, frames=count, **options)
    moving.fps = fps
    return moving


def animate(
    name: str | PathLike[str],
    over: str = "t",
    values: Sequence[Any] | None = None,
    *,
    fps: float = FPS,
    style: StyleLike = None,
    progress: Progress | None = None,
    **parameters: object,
) -> Moving:
    """Matplotlib animation of a recipe's figure over one parameter, or over the time t.

    Parameters
    ----------
    name : str or PathLike
        Name of the recipe, or a file NAME.py of your own.
    over : str
        Parameter that varies, "t" for the time of a figure with a motion.
    values : sequence, optional
        Values of the parameter, one per frame; for the time by default the duration of the motion.
    fps : float
        Frames per second.
    style : str or dict or list, optional
        Matplotlib style, as for `atlas.figure`.
    progress : callable, optional
        Called as ``progress(steps done, steps, "view" or "frames")``: two steps a frame.
    **parameters
        Parameters of the recipe; others keep their defaults.

    Returns
    -------
    matplotlib.animation.FuncAnimation
        ``.save("x.gif")`` writes a file; ``jumps`` is true where a figure's motion does not end as it began.

    Raises
    ------
    DomainError
        If the recipe has no picture at these parameters.
    AtlasError
        For an unknown name or parameter, and for a value out of its range.
    """
    recipe = recipes.load(name)
    if over == "t" and "t" not in recipe.parameters:
        scene = recipe.scene(**parameters)
        moving = animation(*_in_time(scene, recipe, values), fps=fps, style=style, progress=progress)
        moving.jumps = values is None and not movement.closes(scene)
        return moving
    if values is None:
        raise AtlasError(f"say through which values {over} goes")
    if over in parameters:
        raise AtlasError(f"the animation goes over {over}, which can't have the value {parameters[over]!r} too")
    if over not in recipe.parameters:
        time = ["t"] if recipe.scene(**parameters).paths else []
        raise unknown("parameter", over, [*recipe.parameters, *time], f"in the figure {recipe.name!r}")

    values = list(values)

    def make(k: int) -> Scene:
        try:
            return recipe.scene(**parameters, **{over: values[k]})
        except AtlasError as error:
            raise type(error)(f"{over} = {values[k]}: {error}") from error

    return animation(make, len(values), fps=fps, style=style, progress=progress)


def of_motion(motion: Any, times: Sequence[float] | None = None, **options: Any) -> Moving:
    """Return the animation of a motion, a frame for each of the `times`; `options` as for `animation`.

    Without times the animation lasts the least number of periods, up to `MAX_PERIODS`, that brings the body back to
    its attitude; if no number does, one period, and `jumps` is True. The period is that of `any_motion.period`. If the
    body comes back, every frame has the whole path of the axis; otherwise, and for given `times`, a frame has the path
    of the last period, from t = 0 on. Raises AtlasError as `animation` does, and for an array of motions.
    """
    length, count, closed = any_motion.period(motion), 1, False
    if times is None:
        ends = motion.rotation(length * np.arange(MAX_PERIODS + 1))
        back = np.flatnonzero(np.abs(ends[1:] - ends[0]).max(axis=(1, 2)) < movement.SEAM)
        closed, count = bool(back.size), int(back[0]) + 1 if back.size else 1
    length *= count
    moments = np.linspace(0.0, length, count * FRAMES, endpoint=False) if times is None else times

    def make(k: int) -> Scene:
        t = float(moments[k])
        return any_motion.scene_at(motion, t, t - length if closed else max(0.0, t - length))

    moving = animation(make, len(moments), **options)
    moving.jumps = times is None and not closed
    return moving


def _in_time(scene: Scene, recipe: recipes.Recipe, times: Sequence[float] | None) -> tuple[Callable[[int], Scene], int]:
    """Return (function of k that makes the scene of frame k, number of frames) of a scene with paths.

    `times` are those of the frames, by default `FRAMES` equal steps from 0 to the scene's `lasts`, which is left out;
    `recipe` is for the message. Raises AtlasError for a scene without paths.
    """
    if not scene.paths:
        raise AtlasError(
            f"the figure {recipe.name!r} has no time t; say which of its parameters moves, and through which values "
            f"(at the shell, --over KEY=START:STOP:COUNT). It has {', '.join(recipe.parameters)}."
        )
    moments = np.linspace(0.0, scene.lasts, FRAMES, endpoint=False) if times is None else times
    return lambda k: movement.scene_at(scene, float(moments[k])), len(moments)


def save(moving: FuncAnimation, path: Path, kind: str, fps: float, dpi: float) -> None:
    """Write an animation as a `kind` "mp4", "gif" or "apng"; the file at `path` is replaced only by a complete one.

    `fps` is the number of frames a second, `dpi` the resolution. Raises AtlasError where `check` does, and where
    the new file was written beside an edited one, see `atlas.files.keeping`; OSError where the file can't be
    written.
    """
    check(kind, fps)
    writer = FFMpegWriter(fps=fps, codec="h264") if kind == "mp4" else PillowWriter(fps=fps)
    moving._fig.set_dpi(dpi)  # noqa: SLF001  # one renderer then measures and draws all frames
    with files.named(path), files.keeping(path) as unfinished:
        try:
            moving.save(unfinished, writer=writer, dpi=dpi)
        except CalledProcessError as error:
            complaint = next(iter(error.stderr.splitlines()), "it does not say why")
            raise OSError(f"ffmpeg could not write {path}: {complaint}") from error


def check(kind: str, fps: float) -> None:
    """Raise AtlasError for a `kind` of file that cannot be written here, or not at `fps` frames a second.

    The kinds are "mp4", which needs ffmpeg, "gif" and "apng".
    """
    if not 1 <= fps <= FASTEST[kind]:
        raise AtlasError(f"{kind} has from 1 to {FASTEST[kind]} frames a second, not {fps:g}")
    if kind == "mp4" and not FFMpegWriter.isAvailable():
        raise AtlasError("an mp4 is written by the program ffmpeg, which is not installed; gif and apng need nothing")
