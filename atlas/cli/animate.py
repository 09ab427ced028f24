"""``atlas animate``: a figure over the values of one of its parameters, as a moving picture."""

from pathlib import Path
from typing import Any

import click

from atlas import files
from atlas.cli.figure import parameters_of, setting
from atlas.cli.options import choice, examples, multiple_option, out_option, style_option
from atlas.cli.present import bar
from atlas.cli.typed import TypedRange
from atlas.cli.words import Command


@click.command(
    "animate",
    cls=Command,
    inputs_of=parameters_of,
    epilog=examples(
        "atlas animate motion --over omega2=0:2:60",
        "atlas animate film_strip --format mp4 --fps 30",
        "atlas animate quadric --over azimuth=0:360:90 --set ratio=0.5",
        "atlas animate stability --over field=1,0.1:1,2:40 --format apng --out movies",
        "atlas animate rolling_cones --help",
    ),
)
@click.argument("name")
@click.option(
    "--over",
    metavar="KEY=START:STOP:COUNT",
    help="Parameter that changes from frame to frame, its first and last value (a number or a list a,b,c) and the "
    "number of frames, such as omega2=0:2:60. Default: the figure's time t.",
)
@multiple_option(
    "set",
    "KEY=VALUE [...]",
    "Fixed parameters of the figure, such as ratio=0.5 field=1,0.1; a list is a,b,c.",
    "settings",
)
@choice("format", ["mp4", "gif", "apng"], "gif", "Format of the file; mp4 needs the program ffmpeg.", "kind")
@click.option(
    "--fps",
    type=click.FloatRange(1, 60),
    default=20.0,
    show_default=True,
    help="Frames per second; a gif takes up to 50.",
)
@click.option(
    "--dpi", type=click.IntRange(20, 600), default=120, show_default=True, help="Resolution, in pixels per inch."
)
@out_option("build/figures")
@style_option
def command(
    name: str,
    over: str | None,
    settings: tuple[str, ...],
    kind: str,
    fps: float,
    dpi: int,
    out: Path,
    style: str | None,
) -> None:
    """Animate a figure: each frame has another value of one parameter, in the same view and at the same scale.

    NAME is a figure of `atlas list figures`, or a recipe FILE.py of your own. `atlas animate NAME --help` explains its
    parameters. Figures of a motion, such as film_strip and rolling_cones, have a time t; by default the frames show it
    from the start to the end of the motion.

    The file is OUT/NAME.FORMAT. A file there that you edited or made yourself is kept: the new one is then
    NAME.new.FORMAT, and the exit status is 2.
    """
    from atlas.pictures.drawing import animation
    from atlas.places import settle_matplotlib

    settle_matplotlib()
    animation.check(kind, fps)
    parameters = dict(setting(text) for text in settings)
    moves = through(over) if over is not None else ("t", None)
    file = out / f"{Path(name).stem}.{kind}"
    files.check(file)
    with bar("frames") as tell:
        moving = animation.animate(name, *moves, fps=fps, style=style, progress=tell, **parameters)
        animation.save(moving, file, kind, fps, dpi)
    click.echo(file)
    if moving.jumps:
        click.echo(f"{file}: the motion does not end as it began, so that it jumps where it is repeated.", err=True)


def through(text: str) -> tuple[str, list[Any]]:
    """Return (key, list of values) from KEY=START:STOP:COUNT or KEY=a,b,c.

    START and STOP are numbers, or lists of numbers of one length, and the COUNT values, floats or tuples of floats,
    have equal steps between them; a, b, c are floats. Raises click.UsageError for anything else.
    """
    import numpy as np

    from atlas.pictures.drawing.animation import MAX_FRAMES

    key, _, values = text.partition("=")
    if (typed_range := TypedRange.of(values, MAX_FRAMES)) is None and "," in values:
        return key, [float(setting(f"{key}={value}")[1]) for value in values.split(",")]
    if typed_range is None or typed_range.is_log:
        raise click.UsageError(f"--over takes KEY=START:STOP:COUNT, such as omega2=0:2:60, or KEY=a,b,c, not {text!r}.")
    ends = [setting(f"{key}={end}")[1] for end in typed_range[:2]]
    try:
        start, stop = np.asarray(ends, dtype=float)
        steps = np.linspace(start, stop, typed_range.length)
    except (TypeError, ValueError) as error:
        raise click.UsageError(
            "--over goes from a number to a number, or from a list to one as long, not from "
            f"{typed_range.start!r} to {typed_range.stop!r}."
        ) from error
    return key, [tuple(map(float, value)) if np.ndim(value) else float(value) for value in steps]
