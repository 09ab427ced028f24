"""``atlas fit``: the body, the field and the motion out of a user's own measurements."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from atlas.cli.options import TABLE, choice, examples, figure_option, json_option, multiple_option, numbers, stack
from atlas.cli.present import dump, picture
from atlas.cli.typed import REAL
from atlas.cli.words import Command

FAMILIES = ("general", "elementary", "ball", "free", "top", "elliptic", "asymmetric")
KINDS = ("rotation", "quaternion", "axis", "angular_velocity", "field_in_body", "signal")
LOSSES = ("linear", "soft_l1", "huber", "cauchy", "arctan")

fit_options: Callable[[Any], Any] = stack(
    choice("family", FAMILIES, "general", "Family of motions that is fitted."),
    click.option(
        "--of",
        "kind",
        type=click.Choice(KINDS),
        help="Quantity that is fitted, if the file has columns of several quantities.",
    ),
    numbers(
        "sigma",
        "Standard error of each measured number, such as 0.01; of attitudes in radians, or with a unit, 1deg. Default: "
        "a column or line sigma of the file, else estimated.",
    ),
    multiple_option("fix", "NAME=VALUE [...]", "Known parameters, which stay fixed, such as ratio=1.5."),
    multiple_option("start", "NAME=VALUE [...]", "Start values of parameters, such as B3=1.1; none is needed."),
    numbers(
        "epoch",
        "Time at which the fitted initial velocity and attitude hold, as in the column t; in s if that has a unit.",
        default="0",
        show_default=True,
    ),
    choice(
        "loss",
        LOSSES,
        "linear",
        "Loss function of the residuals, as in SciPy; all but linear are robust against outliers.",
    ),
    multiple_option(
        "predict",
        "T [T ...]",
        "Print predictions of the measured quantity at these times, counted as --epoch, with standard errors.",
        type=REAL,
    ),
    numbers(
        "horizon",
        "Print the time until which predictions have a standard error below ERROR, such as 0.1; of attitudes in "
        "radians.",
        "ERROR",
    ),
)


@click.command(
    "fit",
    cls=Command,
    epilog=examples(
        "atlas fit mine.csv",
        "atlas fit mine.csv --sigma 0.01 --fix ratio=1.5",
        "atlas fit mine.csv --of axis --loss soft_l1 --figure mine.pdf",
        "atlas fit mine.csv --predict 1000 --horizon 0.1 --json",
    ),
)
@click.argument("file", type=TABLE, metavar="FILE.csv")
@fit_options
@figure_option("File for a plot of data, curve and residuals: .svg, .pdf or .png.")
@json_option
def command(file: Path, **options: Any) -> int:
    """Find inertia, field and start of a motion from measured attitudes, axes, angular velocities or fields.

    FILE.csv has a column t and one measured quantity: the rotation matrix, R11 to R33; a quaternion, w, x, y, z; the
    axis, R13, R23, R33; a signal, other elements of R; or, along the axes of the body, the angular velocity, Omega1 to
    Omega3, or the field, K1 to K3. A name may have a unit, as t [ms]; results are then in s and 1/s. Other columns,
    and rows without a number, are left out, and a line says so.

    The standard error of the data is --sigma, a line '# sigma = 0.01' at the head of the file, or a column sigma.
    Without any of them it is estimated from the residuals.

    Warnings name the parameters that the data do not determine, and reasons to doubt the family: a reduced chi square
    far from 1, correlated residuals, outliers, or other parameters that give the same data by symmetry. The exit status
    is 1 if there is a warning, and 2 if the file or an option is wrong. In JSON the horizon is null where no time, or
    any time, has such a prediction; the key "missing" says which.
    """
    result = fitted(file, options)
    record, lines = ahead(result, options)
    if options["as_json"]:
        dump({"file": file.name, **result.record(), **record})
    else:
        click.echo("\n".join([f"{file.name}: {result.report()}", *lines]))
    picture(result, options["figure"], silent=options["as_json"])
    return 1 if result.warnings else 0


def fitted(file: Path, options: dict[str, Any]) -> Any:
    """Return the `Fit` of a file with the command's options by name.

    Raises AtlasError for a file or data that cannot be fitted, FileNotFoundError for a file that is not there, and
    click.UsageError for a parameter given twice, by --fix, --start or both.
    """
    from atlas.fitting import fit_file

    return fit_file(file, **arguments(options))


def arguments(options: dict[str, Any]) -> dict[str, Any]:
    """Return the keyword arguments of `fit_file` from the command's options by name.

    Raises click.UsageError for a parameter that is given twice, and for a text that is not NAME=VALUE.
    """
    given_values: dict[str, dict[str, float]] = {"fix": {}, "start": {}}
    for option, values in given_values.items():
        for name, value in map(_pair, options[option]):
            if name in given_values["fix"] or name in values:
                raise click.UsageError(f"{name} is given twice: it is fixed by --fix or sought by --start, once.")
            values[name] = value
    sigma = None if options["sigma"] is None else float(options["sigma"])
    choices = {name: options[name] for name in ("family", "kind", "loss")}
    numbers: dict[str, Any] = {"sigma": sigma, "epoch": float(options["epoch"])}
    return {**choices, **numbers, "fix": given_values["fix"], "params": given_values["start"]}


def ahead(result: Any, options: dict[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """Return (dict for JSON, lines of text): the predictions of a fit at the times --predict, and its horizon.

    The horizon is the time until which the error of a prediction is below --horizon; one that is no finite time is
    None, with words under "missing". Both results are empty without these options.
    """
    record, lines = dict[str, Any](), list[str]()
    for time in map(float, options["predict"]):
        value, error = result.predict(time)
        record.setdefault("predictions", []).append({"t": time, "value": value.tolist(), "sigma": error.tolist()})
        lines.append(f"at t = {time:g}: {value.round(6).tolist()} +- {[float(f'{x:.2g}') for x in error.ravel()]}")
    if options["horizon"] is not None:
        until = result.horizon(float(options["horizon"]))
        when = {-math.inf: "nowhere", math.inf: "at any time"}.get(until, f"until t = {until:.6g}")
        lines.append(f"a prediction is good within {float(options['horizon']):g} {when}")
        record["horizon"] = until if math.isfinite(until) else None
        if record["horizon"] is None:
            record["missing"] = {"horizon": f"a prediction is that good {when}"}
    return record, lines


def _pair(text: str) -> tuple[str, float]:
    """Return (name, value as a float) of NAME=VALUE. Raises click.UsageError for another text."""
    name, equals, value = text.partition("=")
    try:
        return name.strip(), float(value if equals else "")
    except ValueError as error:
        raise click.UsageError(f"{text!r} is not NAME=VALUE, as in ratio=1.5.") from error
