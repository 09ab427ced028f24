"""``atlas page``: some parts of the report of a body as one file to mail, and a PDF; and the page of a fit."""

import os
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from atlas.cli.axes import in_principal_axes
from atlas.cli.body_request import (
    COMMANDS,
    OWN,
    PAGE,
    ByOptions,
    file_name,
    report_options,
    report_request,
    typed_options_of,
)
from atlas.cli.fit import ahead, arguments, fit_options, fitted
from atlas.cli.options import FILE, examples
from atlas.cli.present import status_of
from atlas.cli.words import Command
from atlas.cli.your_body import build, write_and_print

if TYPE_CHECKING:
    from atlas.book.parts import ReportRequest

FORMATS = ("single", "pdf")


@click.command("fit", cls=Command, help="Make a page of the motion that atlas fit finds from measured data.")
@click.option(
    "--fit", "file", type=FILE, required=True, metavar="FILE.csv", help="File of measured data, as for atlas fit."
)
@fit_options
@report_options("build/pages")
def of_fit(file: Path, **options: Any) -> int:
    """Fit a file, and make the page of the motion found; return 1 if a figure failed or the fit warns, else 0.

    `options` are the command's, by name. Paths of page and PDF are printed, warnings on standard error.
    """
    from atlas.book.fit_report import Fitted
    from atlas.fitting import fit_file

    typed_options = typed_options_of((options.keys() - OWN) | {"file"}, {"file": file, **options})
    stem, fit_arguments = file_name(options), dict(arguments(options))
    parameters = {name: p for name, p in fitted(file, options).parameters.items() if not p.expr}
    fit_arguments["fix"] = {name: p.value for name, p in parameters.items() if not p.vary}
    fit_arguments["params"] = {name: p.value for name, p in parameters.items() if p.vary}
    result = fit_file(file, **fit_arguments)  # as the recipe of the page's picture finds it
    request = Fitted(
        result, os.path.relpath(file, options["out"]), sha256(file.read_bytes()).hexdigest()[:12], typed_options,
        fit_arguments, motion_of(result.motion), tuple(ahead(result, options)[1]), options["title"], stem,
    )  # fmt: skip
    built = build(request.name, request.sources(), options["out"], options["jobs"], FORMATS)
    click.echo(f"{built.single}\n{built.pdf}")
    status = status_of(built)
    for warning in result.warnings:
        click.echo(f"atlas: {warning}", err=True)
    return status or (1 if result.warnings else 0)


def motion_of(motion: Any) -> Any:
    """Return the request, a `ReportRequest`, of a report on a motion object of Python, along its principal axes."""
    principal = in_principal_axes(motion, fitted=True)
    with COMMANDS[principal.family.page].make_context(principal.family.name, principal.options) as context:
        return report_request(principal.family, context.params)


@click.group(
    "page",
    cls=ByOptions,
    commands={**COMMANDS, "fit": of_fit},
    context_settings={
        "default_map": {"out": "build/pages", **{name: {"out": "build/pages", "only": PAGE} for name in COMMANDS}}
    },
    epilog=examples(
        "atlas page --ratio 1.3 --field 1 2 --omega2 0.7",
        "atlas page --ratio 1.3 --field 1 2 --omega 0.3 0.7 0.2 --digits 30",
        "atlas page --shape ring --radius 1e-6 --mass 1e-15 --charge 2e-15 --magnetic 0.75 1.3",
        "atlas page top --inertia 1 0.5 --direction 0.6 0.8 --omega 0.1 0.2 5 --linear 3",
        "atlas page elliptic --inertia 0.8 1 1.3 --field 0.2 1 0.6 --z 1.7",
        "atlas page --fit mine.csv --sigma 0.01",
    ),
)
def command() -> None:
    """Make a page of one object: a body in a field, a motion, a top, or the motion that fits measured data.

    The page is one file to mail, NAME.html, beside a PDF: a card of numbers, the motion with the proven digits of its
    quantities, its figures and the nearest closed motions, how to get the same numbers, and the neglected effects. It
    has the parts card, motion, elsewhere and left-out of atlas report your_body. NAME.md is the report that both are
    made from, which you may change. A page or PDF that you edited, or that another command made, is kept: the new one
    is then NAME.new.html, and the exit status is 2.

    With --fit FILE.csv and the options of atlas fit the page has the parameters with their errors, the parameters that
    the data do not determine, data, curve and residuals, the time until which predictions hold, and the figures of the
    motion.

    COMMAND is the command of a family, such as top, with its options. Without COMMAND the options decide: --omega2
    makes the page of an elementary motion, --omega of any motion, and a body and a field without a start that of their
    quadric.
    """


@command.result_callback()
def make(request: "int | tuple[ReportRequest, dict[str, Any]]") -> int:
    """Write the page of a request, (`ReportRequest`, options), and print where it is; return the exit status.

    An int is the exit status of a page of a fit, which is already made.
    """
    if isinstance(request, int):
        return request
    return write_and_print(*request, FORMATS)
