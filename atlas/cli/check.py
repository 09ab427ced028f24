"""``atlas check``: a user's own trajectory, graded against the certified one."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from atlas.cli import body
from atlas.cli.options import TABLE, examples, figure_option, given_options, json_option, numbers, stack
from atlas.cli.present import dump, picture
from atlas.cli.words import Command

OF_TOPS = ("direction", "coupling", "linear", "quadratic")
"""Options that only a top has."""

file_argument = click.argument("files", type=TABLE, metavar="FILE.csv...", nargs=-1, required=True)
graded_options: Callable[[Any], Any] = stack(
    numbers(
        "threshold", "Number of correct digits below which a column fails, such as 3.", default="6", show_default=True
    ),
    figure_option("File for a plot of the error against time: .svg, .pdf or .png."),
    click.option(
        "--order",
        is_flag=True,
        help="Print the order of convergence, from files of one motion with different steps; --figure plots it.",
    ),
    json_option,
)


@click.command(
    "check",
    cls=Command,
    help="Count the correct digits of a trajectory of a body with three moments of inertia, column by column.",
    epilog=examples(
        "atlas check mine.csv --inertia 0.8 1 1.3 --field 0.2 1 0.6 --omega 0.3 0.7 0.2",
        "atlas check mine.csv --tensor 2 1.5 1 0.1 0 0.2 --field 0.3 0 1 --spin 3 --attitude 0.6 0 0 0.8",
    ),
)
@file_argument
@body.any_body_options
@body.tensor_option
@body.attitude_option
@body.start_option
@body.spin_option
@graded_options
def three_moments(files: tuple[Path, ...], **options: Any) -> int:
    """Grade files against the motion of a body with three moments of inertia; return 1 if a column fails, else 0.

    `options` are the command's, by name; the grades are printed.
    """
    J = body.given_tensor(options)
    inertia = body.chosen_moments(options) if J is None else (J[0][0], J[1][1], J[2][2], J[0][1], J[0][2], J[1][2])
    return _graded(files, options, {"inertia": inertia, "attitude": options["attitude"]})


@click.command(
    "check",
    cls=Command,
    delegate=lambda words: three_moments if words.are_of_any_body else None,
    epilog=examples(
        "atlas check mine.csv --ratio 1.5 --field 1 2 --omega2 0.7",
        "atlas check mine.csv --ratio 1.5 --field 1 2 --omega 0.3 0.7 0.2",
        "atlas check mine.csv --inertia 0.8 1 1.3 --field 0.2 1 0.6 --omega 0.3 0.7 0.2",
        "atlas check mine.csv --inertia 1 0.5 --direction 0.6 0.8 --linear 3 --omega 0.1 0.2 5",
        "atlas check rk4.csv leapfrog.csv --ratio 1.5 --field 1 2 --omega2 0.7 --figure errors.pdf",
        "atlas check coarse.csv fine.csv finest.csv --order --figure order.pdf",
    ),
)
@file_argument
@body.body_options
@body.field_options
@body.start_option
@body.spin_option
@numbers("omega2", "Second component of the initial angular velocity of an elementary motion, in 1/time.")
@numbers("omega3", "Third component, in 1/time; goes with --omega2, only where (71) leaves it free.")
@numbers("direction", "Direction n of a top's field at t = 0, across and along the axis, as in atlas top.", "N2 N3")
@numbers(
    "coupling", "Coefficients k of a top, M = I Omega + k b, in inertia/time, as in atlas top; default 0 0.", "K2 K3"
)
@numbers("linear", "Linear coefficient of a top's potential, in inertia/time^2: m g l of a heavy top; default 0.")
@numbers("quadratic", "Quadratic coefficient of a top's potential, in inertia/time^2; default 0.")
@graded_options
def command(files: tuple[Path, ...], **options: Any) -> int:
    """Count the correct digits of a trajectory computed elsewhere, column by column.

    FILE.csv has a column t and columns of the rotation matrix, R11 to R33, of the angular velocity in the body, Omega1
    to Omega3, or of a quaternion, w, x, y, z. A name may have a unit, as t [ms] or t (ms). Other columns, and rows
    without a number, are left out, and a line says so. Parameters are options, or lines at the head of the file, such
    as '# field = 1 2'.

    The trajectory is compared with the exact motion: of a symmetric body in a field, of a top (--direction, as in
    atlas top), or of a body with three moments of inertia (--inertia I1 I2 I3, --field B1 B2 B3, --omega). Without an
    initial angular velocity, or with a tensor '# inertia = J11 J22 J33 J12 J13 J23' in the file, only the drifts of the
    integrals H, F, (M,K), K^2 and T are printed. Errors of Omega are relative to its length; for tops and for three
    moments, to the largest rate of the motion.

    Several files are graded one after the other, and --figure plots all their errors. With --order the files are
    runs of one integrator with different steps, read from '# step = 0.01' or else from the times.

    The exit status is 1 if a column has fewer correct digits than the threshold at some time, and 2 if a file or an
    option is wrong.
    """
    parameters = given_options(options, ("inertia", "omega2", "omega3", *OF_TOPS))
    if options["inertia"] is None and given_options(options, body.BODY):
        parameters["ratio"] = body.chosen_body(options)
    return _graded(files, options, parameters)


def _graded(files: tuple[Path, ...], options: dict[str, Any], parameters: dict[str, Any]) -> int:
    """Grade trajectories, print the grades, and return the status: 1 if a column fails, else 0, and 0 with --order.

    `options` are the command's, by name; `parameters` are those of the motion, by name, to which start and field of the
    options are added in place.
    """
    from atlas.checking.check import check_file
    from atlas.checking.comparison import Comparison
    from atlas.checking.order import convergence

    parameters["omega"] = body.start_of(options, is_required=False)
    if given_options(options, ("field", "magnetic")):
        parameters["field"] = body.chosen_field(options)
    checks = tuple(check_file(file, threshold=options["threshold"], **parameters) for file in files)
    grades = convergence(checks) if options["order"] else checks[0] if len(checks) == 1 else Comparison(checks)
    if options["as_json"]:
        dump(grades.record())
    else:
        click.echo(str(grades))
    picture(grades, options["figure"], silent=options["as_json"])
    if options["order"]:
        return 0
    failed = [
        f"{column.name}{f' of {check.file}' * (len(checks) > 1)} from t = {column.fails_at:g}"
        for check in checks
        for column in check.columns
        if column.fails_at is not None
    ]
    if failed:
        click.echo(f"atlas: fewer than {checks[0].threshold:g} correct digits in {', '.join(failed)}", err=True)
    return 1 if failed else 0
