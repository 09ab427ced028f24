"""``atlas check``: a user's own trajectory, graded against the certified one."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from atlas.cli.body import BODY, body_options, chosen_body, chosen_field, field_options
from atlas.cli.options import REAL, Command, Place, examples
from atlas.cli.present import Printout, dump, show

if TYPE_CHECKING:
    from atlas.study.check import Check


@click.command(
    "check",
    cls=Command,
    epilog=examples(
        "atlas check mine.csv --ratio 1.5 --field 1 2 --omega2 0.7",
        "atlas check mine.csv --ratio 1.5 --field 1 2 --omega 0.3 0.7 0.2",
        "atlas check mine.csv --figure mine.pdf --json",
    ),
)
@click.argument("file", type=click.Path(exists=True, dir_okay=False, path_type=Path), metavar="FILE.csv")
@body_options
@field_options
@click.option("--omega", type=REAL, nargs=3, metavar="W1 W2 W3", help="Initial angular velocity, of a general motion.")
@click.option("--omega2", type=REAL, help="Its second component alone, of an elementary motion.")
@click.option("--omega3", type=REAL, help="Third component, where (71) leaves it free.")
@click.option(
    "--threshold", type=REAL, default="6", show_default=True, help="Correct digits below which a column fails."
)
@click.option(
    "--figure", type=Place(dir_okay=False, path_type=Path), help="Draw the error against time: svg, pdf, png."
)
@click.option("--json", "as_json", is_flag=True, help="JSON on standard output, and nothing else there.")
def command(file: Path, **options: Any) -> int:
    """Count the correct digits of a trajectory computed elsewhere, column by column.

    FILE.csv has a column t and any of R11 to R33, Omega1 to Omega3, or a quaternion w, x, y, z. The parameters are
    options, or lines such as '# field = 1 2' at the head of the file.

    A body without symmetry is one with a line '# inertia = 1 1.7 2.2' (or with the six elements J11 J22 J33 J12 J13
    J23): its integrals H, F, (M,K), K^2 and T are watched. Its digits are not counted: `atlas asymmetric` has them.

    The exit status is 1 if a column has fewer correct digits somewhere than the threshold, 2 if the file or an
    option is wrong.
    """
    from atlas.study.check import check

    body = any(options[name] is not None for name in BODY)
    field = any(options[name] is not None for name in ("field", "magnetic"))
    found = check(
        file,
        ratio=chosen_body(options) if body else None,
        field=chosen_field(options) if field else None,
        omega2=options["omega2"],
        omega3=options["omega3"],
        omega=options["omega"],
        threshold=options["threshold"],
    )
    if options["figure"] is not None:
        from atlas.draw.files import save

        save(found.scene(), {options["figure"]: options["figure"].suffix.lstrip(".")})
    if options["as_json"]:
        dump(found.record())
    else:
        tables(found)
        if options["figure"] is not None:
            click.echo(options["figure"])
    failed = [f"{column.name} from t = {column.fails_at:g}" for column in found.columns if column.fails_at is not None]
    if failed:
        click.echo(f"atlas: fewer than {found.threshold:g} correct digits in {', '.join(failed)}", err=True)
    return 1 if failed else 0


def tables(found: "Check") -> None:
    """Show the grades of the columns, and what drifts."""
    title = f"{found.file}: {found.rows} row{'s' * (found.rows != 1)}, case {found.case}"
    heading, rows = found.column_table()
    if rows:
        show(Printout(title, heading=heading, rows=rows))
    else:
        click.echo(f"{title}: nothing to compare with, so no column is graded")
    heading, rows = found.drift_table()
    if rows:
        show(Printout("what should not change", heading=heading, rows=rows, justify="left"))
