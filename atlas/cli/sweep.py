"""``atlas sweep``: quantities over a grid or a list of parameters, as a table in a file."""

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from math import inf
from pathlib import Path
from typing import Any

import click

from atlas.arithmetic.uncertainty import is_uncertain
from atlas.cli import body
from atlas.cli.axes import along_principal_axes, motion_in_given_axes
from atlas.cli.family import is_short, of_rounding
from atlas.cli.options import Place, examples, given_options, jobs_option_of, multiple_option, numbers, pair, stack
from atlas.cli.points import measured_columns
from atlas.cli.present import bar
from atlas.cli.typed import REAL, Typed, TypedRange, check_units
from atlas.cli.uncertain import UncertainAnswer, uncertain
from atlas.cli.words import Command, check_bare_numbers
from atlas.families.family import TIME
from atlas.motions.register import FAMILIES

NAMES = " or ".join(", ".join(FAMILIES).rsplit(", ", 1))
HELP = f"""Compute quantities of a FAMILY over all combinations of parameters, or over the rows of a list.

FAMILY is {NAMES}; or motion, and the parameters choose the family. `atlas list families` and `atlas list quantities`
name parameters and quantities. A row takes microseconds; in the family general tens of microseconds, in asymmetric up
to seconds.

The heading of a CSV file has units, as k [1/time]. A quantity without a value leaves its cell empty, and the column
missing says why. If inputs have an uncertainty, as 1.50(2), a column NAME_sigma has the standard deviation. A row
outside the domain, such as a pole, ends the sweep with status 2; the error names the row.

A sweep that was stopped continues when it is called again: finished parts are kept in the folder OUT.parts. With a
folder or an address such as s3://bucket/table.parquet (and the package of fsspec for it), the table is a Parquet data
set, which pandas and Dask read as one table. A file that you edited or made yourself is kept: the new table is then
OUT.new.csv, and the exit status is 2.
"""


class Out(click.ParamType):  # type: ignore[type-arg]  # which takes one since click 8.4
    """Destination of a table as click's type: a file; a folder, if the name ends in /; or an address with "://"."""

    name = "path"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the destination as typed.

        Raises click.UsageError for one that cannot be written, and for memory://.
        """
        from atlas.sweeps.store import MEMORY

        text = str(value)
        if MEMORY in text:
            self.fail(f"a table at {text} is gone when the command ends: name a file, a folder or another address.")
        if "://" not in text:
            folder = text.endswith("/") or Path(text).is_dir()
            Place(file_okay=not folder, dir_okay=folder).convert(text, param, ctx)
        return text


OUT = Out()


def options_of(*of_body: Any) -> Callable[[Any], Any]:
    """Return the decorator of a sweep's argument and options; `of_body` are the decorators of body, field and start."""
    return stack(
        click.argument("family", required=False),
        multiple_option(
            "set",
            "NAME=VALUES [...]",
            "Values of a parameter: a number, numbers with commas, or START:STOP:COUNT (:log for even steps of the "
            "logarithm).",
            "settings",
        ),
        *of_body,
        click.option(
            "--list",
            "listing",
            type=click.Path(dir_okay=False, path_type=Path),
            help="CSV file of parameters: a heading with their names, and a row for each row of the table.",
        ),
        multiple_option("quantity", "NAME [NAME ...]", "Quantities to compute, such as k, R11 or R.", "quantities"),
        click.option(
            "--out",
            type=OUT,
            help="Table to write: a file .csv, .npz or .parquet, a folder table.parquet/, or an address.",
        ),
        click.option(
            "--digits",
            type=click.IntRange(1, 1000),
            help="Compute this many certified significant digits, such as 30; the cells are then text.",
        ),
        click.option(
            "--rows",
            type=click.IntRange(1),
            help="Number of rows that are computed as one part; by default, as many as take some seconds.",
        ),
        jobs_option_of("processes"),
    )


def requested(options: dict[str, Any]) -> tuple[str, dict[str, Any], str]:
    """Return (family, values of its parameters by name, text of a tensor's principal axes in terms of the given ones).

    `options` are the command's, by name. Values are numbers, or texts as typed; the text is "" where the axes are the
    given ones. Raises click.UsageError for parameters that do not fit the family.
    """
    if options["family"] is None:
        raise click.UsageError(f"FAMILY is missing: name the family to sweep, {NAMES}.")
    settings = [pair(text, "NAME=VALUES, as in ratio=0.5:2:100") for text in options["settings"]]
    fixed, axes = (_uncertain_body(options), "") if uncertain(options) else _body(options)
    names = [*fixed, *(name.strip() for name, _ in settings)]
    _once(names, "--set" + " and the options of body and field" * bool(fixed))
    family = _family_of(options["family"], {*names})
    _check_moments(family, fixed, options)
    return family, fixed | {name.strip(): values for name, values in settings}, axes


def _check_moments(family: str, fixed: Mapping[str, Any], options: Mapping[str, Any]) -> None:
    """Raise click.UsageError for three moments of inertia, I1 in `fixed`, in a family that has two.

    `fixed` are numbers by name; `options`, the command's, give the option named in the message.
    """
    parameter_names = {name for p in FAMILIES[family].parameters for name in p.names} if family in FAMILIES else {"I1"}
    if "I1" in fixed and "I1" not in parameter_names:
        components = {"inertia": "I2 I3", "magnetic": "B2 B3", "field": "B2 B3"}
        option = next((name for name in components if options[name] is not None), "")
        raise click.UsageError(
            (f"--{option} takes 2 numbers, {components[option]}, " if option else "a tensor has no place ")
            + f"in the family {family}; a body with three moments of inertia is the family asymmetric, with "
            "--set I1=0.8 and so on, or motion, which finds it."
        )


def swept(**options: Any) -> None:
    """Compute quantities of a family over parameters, write the table, and print its path.

    `options` are the command's, by name. Raises click.UsageError for options that do not fit, AtlasError for a row
    outside the domain.
    """
    from atlas.sweeps.plan import Plan
    from atlas.sweeps.run import write_plan

    family, requested_values, axes = requested(options)
    listing = options["listing"]
    option_names = {name: option for name, (option, _) in _options(family).items()}
    typed_numbers = {
        name: _numbers(name, option_names.get(name, name), text)
        for name, text in requested_values.items() if isinstance(text, str)
    }  # fmt: skip
    check_bare_numbers(options, ((name, option_names.get(name, name), x) for name, x in typed_numbers.items()))
    parameters = {
        name: _values(name, values, typed_numbers[name]) if name in typed_numbers else values
        for name, values in requested_values.items()
    }
    columns, units = _listed(family, listing) if listing else ({}, set())
    _once([*columns, *parameters], f"{listing} and elsewhere")
    inputs = columns | parameters
    typed_starts = [_parameter_values(inputs.get(f"omega{i}", 0.0)) for i in (1, 2, 3)]
    start = [max((abs(float(getattr(x, "n", x))) for x in values), default=0.0) for values in typed_starts]
    body.check_speeds(options, start if any(start) else None)
    if options["out"] is None:
        raise click.UsageError("--out is missing: name the file of the table, such as --out table.csv.")
    has_units = bool(units) or any(x.unit for numbers in typed_numbers.values() for x in numbers)
    time = "s" if has_units else body.units_of(options).get("time", "time")
    plan = Plan.of(
        family, inputs, options["quantities"],
        listed=listing is not None, digits=options["digits"], time=time, axes=axes,
    )  # fmt: skip
    _tell_rounding(plan)
    with bar("sweep", every=60) as tell:
        path = write_plan(
            plan,
            options["out"],
            options["rows"],
            jobs=options["jobs"],
            progress=lambda done, total: tell(done, total, ""),
        )
    click.echo(str(path))


def _tell_rounding(plan: Any) -> None:
    """Print on standard error the angle in rad by which rounded inputs turn the body of a `Plan` in its row `latest`.

    That is the first row with the largest |t|. If the angle is not known, the sentence says so. Nothing is printed for
    an angle up to `ROUNDING`, for certified digits, and without times or at short ones, see `is_short`.
    """
    from atlas.sweeps.families import FAMILIES as SWEPT
    from atlas.sweeps.plan import LAUNCH

    family, row = SWEPT[plan.family], plan.latest
    rates = [inf] if family.family.takes("coupling") else [row.get(name, 0.0) for name in LAUNCH]
    if plan.digits is not None or not row or is_short(rates, [row["t"]]):
        return
    for clause in of_rounding(family.family, family.make({**family.optional, **row}), [row["t"]]):
        click.echo(f"atlas: {clause}, in the first row at that time.", err=True)


def of_three_moments() -> click.Command:
    """Return the click command of sweeps over bodies with three moments of inertia."""
    options = options_of(body.any_body_options, body.tensor_option, body.start_option, body.spin_option)
    command: click.Command = click.command("sweep", cls=Command, carries=True, help=HELP)(options(swept))
    return command


@click.command(
    "sweep",
    cls=Command,
    carries=True,
    delegate=lambda words: of_three_moments() if words.are_of_any_body else None,
    help=HELP,
    epilog=examples(
        "atlas sweep elementary --set ratio=0.1:2:500 --set B2=1 --set B3=0.2 --set omega2=-0.9:3:1000 "
        "--quantity stability --out map.npz",
        "atlas sweep ball --list launches.csv --quantity gamma --digits 30 --out gamma.csv",
        "atlas sweep elementary --shape ring --radius 1e-6 --mass 1e-15 --charge 2e-15 --magnetic 0.75 1.3 "
        "--set omega2=-0.7:2:271 --quantity k --out ring.csv",
        "atlas sweep general --ratio 1.5 --field 1kHz 2kHz --set omega1=0 omega2=0 omega3=1kHz:2MHz:100:log --quantity "
        "precession_rate --out spins.csv",
        "atlas sweep asymmetric --tensor 2 1.5 1 0.1 0 0.2 --field 0.3 0 1 --spin 3 --quantity f1 --out f.csv",
    ),
)
@options_of(
    body.body_options,
    body.field_options,
    body.start_option,
    body.spin_option,
    numbers("omega2", "Second component of the initial angular velocity of an elementary motion, in 1/time."),
)
def command(**options: Any) -> None:
    """Sweep over symmetric bodies, with the command's options by name; see `swept`."""
    swept(**options)


def _family_of(family: str, names: set[str]) -> str:
    """Return the family to sweep: `family` itself, or for "motion" the one that has the parameters `names`.

    I1 is that of asymmetric, else omega1 that of general; without both the family is elementary.
    """
    if family != "motion":
        return family
    if "I1" in names:
        return "asymmetric"
    return "general" if "omega1" in names else "elementary"


def _parameter_values(values: Any) -> Any:
    """Return the values of a parameter as they are, a list or an array; a single number in a list."""
    return [values] if isinstance(values, float | int | Fraction) or is_uncertain(values) else values


def _plain(x: float | Fraction) -> float | Fraction:
    """Return a typed number as a float; a Fraction, which no float equals, unchanged."""
    return x if isinstance(x, Fraction) else float(x)


def _uncertain_body(options: dict[str, Any]) -> dict[str, Any]:
    """Return the numbers of `_body` by name with standard deviations, correlated by the inputs of the options.

    They are numbers of the package uncertainties. Raises click.UsageError for a tensor.
    """
    if "tensor" in options and body.given_tensor(options) is not None:
        raise click.UsageError("a sweep takes no uncertainties of a tensor, whose axes change with its elements: give "
                               "principal moments; atlas motion carries those of a tensor.")  # fmt: skip
    from uncertainties import ufloat

    answer = UncertainAnswer.of(lambda shifted: {name: float(x) for name, x in _body(shifted)[0].items()}, options)
    units = [ufloat(0.0, 1.0) for _ in uncertain(options)]
    return {
        name: sum((slope * unit for slope, unit in zip(answer.spread.slopes[name,], units, strict=True)), x)
        for name, x in answer.answer.items()
    }


def _body(options: dict[str, Any]) -> tuple[dict[str, float | Fraction], str]:
    """Return (numbers of body, field and start by the names of a table's columns; axes as text) from the options.

    `options` are the command's, by name. Numbers of a tensor are along its principal axes; the text describes these, ""
    where they are the axes given.
    """
    has_three, values = "tensor" in options, dict[str, float | Fraction]()
    if has_three and body.given_tensor(options) is not None:
        principal = along_principal_axes(motion_in_given_axes(options))
        click.echo(principal.note, err=True, nl=bool(principal.note))
        names = {p.name: p.names for p in principal.family.parameters}
        for name, components in principal.values.items():
            values |= zip(names[name], components, strict=True)
        return values, principal.axes if principal.note else ""
    if given_options(options, body.BODY):
        if has_three:
            values |= zip(("I1", "I2", "I3"), map(float, body.chosen_moments(options)), strict=True)
        else:
            chosen = body.chosen_body(options)
            values["ratio"] = float(getattr(chosen, "ratio", chosen))
    weighed = ("mass", "density") if options["shape"] is None else ()
    if given_options(options, ("field", "magnetic", "mu", "charge", "units", *weighed)):
        values |= zip(("B1", "B2", "B3")[not has_three :], map(_plain, body.chosen_field(options)), strict=True)
    start = body.start_of(options, is_required=False)
    if start is not None:
        values |= zip(("omega1", "omega2", "omega3"), map(float, start), strict=True)
    return values | {name: float(x) for name, x in given_options(options, ["omega2"]).items()}, ""


def _once(names: Sequence[str], source: str) -> None:
    """Raise click.UsageError for a parameter that stands twice in `names`.

    `source` says in words where they are given.
    """
    for name, count in Counter(names).items():
        if count > 1:
            raise click.UsageError(f"{name} is given {count} times, by {source}: give it once.")


def _options(family: str) -> dict[str, tuple[str, str]]:
    """Return (option without dashes, unit) by column name, for the parameters of all families and for "t".

    Where several families have a name, that of `family` counts.
    """
    parameters = [p for key in (*FAMILIES, family) if key in FAMILIES for p in FAMILIES[key].parameters]
    return {name: (p.name, p.unit) for p in parameters for name in p.names} | {"t": ("times", TIME)}


def _listed(family: str, path: Path) -> tuple[dict[str, list[float]], set[str]]:
    """Return (columns, units) of a CSV list: floats by name, in SI where the heading has units, and these units.

    The units are a set without the register's own. Raises click.UsageError, with the line, for other cells.
    `family` decides which options the names are.
    """
    options = _options(family)
    plain = {name: (unit, unit.replace(TIME, "s")) for name, (_, unit) in options.items()}
    columns, units = measured_columns(path, {name: option for name, (option, _) in options.items()}, plain)
    return columns, units - {"", "1", *(unit for _, unit in options.values())}


def _numbers(name: str, option_name: str, text: str) -> tuple[Typed, ...]:
    """Return the numbers in the text of a parameter's values, of a range its two ends, in the units of an option.

    `name` is the parameter's. Raises click.UsageError for another text, and for a number without a unit beside one
    with a unit.
    """
    option = click.Option([f"--{option_name}"])  # which says the unit
    option.opts = [name]
    typed_range = TypedRange.of(text)
    words = text.split(",") if typed_range is None else typed_range[:2]
    numbers = tuple(REAL.convert(x.strip(), option, click.get_current_context()) for x in words)
    check_units(name, numbers)
    return numbers


def _values(name: str, text: str, numbers: Sequence[Typed]) -> Any:
    """Return the values of the parameter `name`: a list of floats, an array of START:STOP:COUNT[:log], or a number.

    `numbers` are those in the text; the number is one with an uncertainty. Raises click.UsageError for a range
    whose ends have no logarithm, and for several values with an uncertainty.
    """
    from atlas.sweeps.plan import Range

    if (typed_range := TypedRange.of(text)) is None:
        if not any(x.sigma for x in numbers):
            return [*map(float, numbers)]
        if len(numbers) > 1:
            raise click.UsageError(f"{name} = {text}: a parameter with an uncertainty has one value, not several.")
        from uncertainties import ufloat

        return ufloat(float(numbers[0]), numbers[0].sigma)
    start, stop = map(float, numbers)
    typed_range.check(start, stop)
    return Range(start, stop, typed_range.length, log=typed_range.is_log).values
