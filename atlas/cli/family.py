"""``atlas classify|motion|general|ball|particle``: quantities of an object of a family, and its samples at times."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import chain
from math import hypot, inf, isfinite, pi
from typing import Any

import click

from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.uncertainty import mapped
from atlas.cli import body
from atlas.cli.axes import OWN_AXES, axes_text, motion_in_given_axes
from atlas.cli.options import chosen_times, examples, given_options, numbers, output_options, stack, times_options
from atlas.cli.present import (
    NOT_ASKED,
    TABLE_DIGITS,
    Line,
    Printout,
    answer,
    at_times,
    certificate,
    dump,
    in_threes,
    samples,
    show,
)
from atlas.cli.spectrum import check_spectrum, recorded, show_lines, spectrum_of, spectrum_options
from atlas.cli.table import out_option, write_table
from atlas.cli.top import chosen_top, given_otherwise, needs_no_way, parameters_of_top, top_options, top_units
from atlas.cli.typed import exactly, measured, parts_of
from atlas.cli.uncertain import UncertainAnswer, uncertain
from atlas.cli.words import Command, Words
from atlas.errors import AtlasError, DomainError, NotCertifiedError
from atlas.families.family import RATE, ROUNDING, TIME
from atlas.motions.register import FAMILIES, Family, Parameter, Quantity, Sampled
from atlas.motions.register import Command as Described

SPARE = 1 << 12
"""Bits beyond those asked for in which digits are looked for, where a zero may have no proof."""

AT_ONCE = 200
"""Times whose rows of a table are computed together, then printed."""

SMALL = "proven to be smaller than that in size; that it is zero does not follow from a symmetry of the motion."

CHARGE = ("mass", "charge")
"""Options that may stand for the charge-to-mass ratio of a point charge."""

OF_BODY: Mapping[str, Callable[[Any], Any]] = {
    "ratio": body.chosen_body, "inertia": body.chosen_moments, "field": body.chosen_field,
}  # fmt: skip
"""Arguments of a family's classes from options of body and field."""

SHORT = 6.0
"""Phase below which an exponential of the largest rate does not take rounding to 1e-12."""

UNITS = {
    "natural": {},
    "gaussian": {"1/time": "rad/s", "length/time": "cm/s", "length": "cm"},
    "si": {"1/time": "rad/s", "length/time": "m/s", "length": "m"},
}
"""Systems of units of a family with a speed of light, and the names of their units."""

units_option: Callable[[Any], Any] = click.option(
    "--units",
    type=click.Choice(list(UNITS)),
    help="Units of numbers that are typed without one: si (V/m, tesla, m, s, C, kg), gaussian (statvolt/cm, gauss, cm, "
    "s, esu, g), natural (c = 1). Default: si with --charge or a typed unit, else natural.",
)

charge_options = stack(
    numbers("mass", "Mass, such as 9.11e-31kg; goes with --charge, instead of --mu."),
    numbers("charge", "Charge, of either sign, such as -1e; goes with --mass, instead of --mu."),
)


def command(name: str) -> click.Command:
    """Return the click command of this name, of one family or, as "motion", of several."""
    commands_by_key = {
        key: _command_of(family, family.command)
        for key, family in FAMILIES.items()
        if family.command and family.command.name == name
    }
    return next(iter(commands_by_key.values())) if len(commands_by_key) == 1 else any_motion(name, commands_by_key)


def any_motion(name: str, commands: Mapping[str, click.Command]) -> click.Command:
    """Return one command for several families, with all their options, that hands over to the family they belong to.

    `commands` are those of the families by name; the first one's help is shown.
    """
    params = dict[str, click.Parameter]()
    for param in (copy(param) for command in commands.values() for param in command.params):
        option = params.setdefault(str(param.name), param)
        option.required = False
        if param.metavar and param.metavar not in str(option.metavar):
            option.metavar = f"{option.metavar} or {param.metavar}"
    lines = [line.strip() for command in commands.values() for line in str(command.epilog).split("\n")[2:]]
    return Command(
        name,
        params=list(params.values()),
        help=next(iter(commands.values())).help,
        epilog=examples(*lines),
        delegate=lambda words: None if _is_for_all(words, params.values()) else commands[family_of(words)],
    )


def _is_for_all(words: Words, params: Iterable[click.Parameter]) -> bool:
    """Return whether the common command answers: help is requested, or an option is unknown to all families.

    `params` are the options of all families.
    """
    return not words.names - {"--"} <= {name for param in params for name in param.opts}


def family_of(words: Words) -> str:
    """Return "elementary", "general" or "asymmetric": the family to which options belong, by body, field and start.

    Raises click.UsageError where there is no start, or there are two.
    """
    names = words.names
    if not names & {"--omega2", "--omega3", "--omega", "--spin"}:
        raise click.UsageError(
            "the start is missing: give --omega2 W2 for an elementary motion, or --omega W1 W2 W3 or --spin W3 for any."
        )
    if names & {"--omega2", "--omega3"}:
        if misplaced := sorted(names & {"--omega", "--spin", "--curve", "--attitude", "--tensor"}):
            raise click.UsageError(
                f"{misplaced[0]} does not go with --omega2, the start of an elementary motion: leave it out, or give "
                "--omega W1 W2 W3 or --spin W3 instead of --omega2."
            )
        if "--omega2" not in names:
            raise click.UsageError("--omega3 goes with --omega2: add --omega2 W2; a spin alone is --spin W3.")
        return "elementary"
    return "asymmetric" if words.are_of_any_body else "general"


def _command_of(family: Family, described: Described) -> click.Command:
    """Return the click command of a family, with its name, help and examples from `described`."""
    has_lines = any(s.matrix for s in family.sampled)
    decorators = [
        *object_options(family),
        *([times_options] if family.sampled else []),
        *([spectrum_options] if has_lines else []),
        *([out_option] if family.sampled else []),
        output_options,
    ]

    def run(**options: Any) -> None:
        check_spectrum(options)
        body.check_speeds(options)
        times = chosen_times(options) if family.sampled else []
        Question(family, described, options, times).show()

    texts = {"help": described.help, "epilog": examples(*described.examples)}
    return click.command(described.name, cls=Command, carries=True, **texts)(stack(*decorators)(run))


class Best(dict[tuple[str, Any], Any]):
    """Samples certified at the highest precision reached so far, in balls, by (name of the function of time, time).

    `reason` says why no higher precision was reached, "" if it was.
    """

    reason = ""


@dataclass(frozen=True)
class Question:
    """Request to the command of a family: `options` by name, which define an object, and the `times` of its samples.

    `described` holds the command's texts, `best` the best samples in balls so far.
    """

    family: Family
    described: Described
    options: dict[str, Any]
    times: Sequence[float]
    best: Best = field(default_factory=Best)

    @property
    def named(self) -> dict[str, str]:
        """Record {"family": name} where the command serves several families, else {}."""
        return {"family": self.family.name} if self.described.name == "motion" else {}

    @property
    def sampled(self) -> list[Sampled]:
        """Functions of time of the family that the command prints."""
        return [s for s in self.family.sampled if s.printed]

    def floats(self) -> dict[str, Any]:
        """Return the record of the object in doubles, a dict: quantities by name, "samples", spectrum, input error."""
        family, times = self.family, self.times
        motion = _kernel(family, self.options)
        lines = recorded(spectrum_of(motion, self.options))
        return self.named | _answers(family, motion, times, self.sampled) | lines | _input_error(family, motion, times)

    @cached_property
    def reference_quaternions(self) -> list[Any]:
        """List of quaternions [x, y, z, w] in doubles at the times, for the signs of certified ones.

        Each is None where the motion cannot be computed in doubles.
        """
        try:
            motion = motion_in_given_axes(self.options) if self.family.in_given_axes else None
            return list(at_times((motion or _kernel(self.family, self.options)).quaternion, self.times))
        except NotCertifiedError:
            return [None for _ in self.times]

    def balls(self, times: Sequence[float], quantities: Family) -> dict[str, Any]:
        """Return the record of the object in balls, a dict by name: quantities, and samples at these times.

        `quantities` is the family with the quantities that are wanted. Raises NotCertifiedError if no sample at all
        can be certified.
        """
        motion, options, best = _balls(self.family, self.options), self.options, self.best
        moments = [exactly(t, options) for t in times]
        values = {s.name: [sample(s, motion, t, best) for t in moments] for s in self.sampled if not s.uncertified}
        if moments and not best:
            raise NotCertifiedError(best.reason)
        if options["as_json"] and "R" in values:
            values["q"] = [
                _quaternion(motion, *row) for row in zip(moments, values["R"], self.reference_quaternions, strict=True)
            ]
        columns = {s.name: values[s.name] for s in self.sampled if s.name in values}
        return self.named | _quantities(quantities, motion, times, columns, exact=True)

    def show(self) -> None:
        """Print the result as JSON, or as a table with later times in blocks, or in a form of `shown_otherwise`.

        Raises click.UsageError for options that do not go together, DomainError for an object that cannot be.
        """
        family, options, times = self.family, self.options, self.times
        parameters = _parameters(family, options)
        if self.shown_otherwise(parameters):
            return
        first_times = times if options["as_json"] else times[:AT_ONCE]
        spare = SPARE if self.described.undecided else 1 << 16
        texts = answer(options, parameters, self.floats, partial(self.balls, first_times, family), spare)
        if texts is None:
            return
        texts["samples"] = chain(texts.get("samples", []), later(times, partial(self.digits, spare)))
        self.finish(self.printout(texts, certificate(options), _in_hertz(family, texts, options)))

    def finish(self, printout: Printout, motion: Any = None) -> None:
        """Print a printout with a note on rounded inputs, then the spectrum if one is asked for.

        `motion` is the object in doubles, made from the options if None.
        """
        family, options = self.family, self.options
        rounding = _of_rounding(family, options, self.times, motion)
        show(replace(printout, notes=chain(printout.notes, rounding)))
        if options.get("spectrum"):
            motion = _kernel(family, options) if motion is None else motion
            show_lines(spectrum_of(motion, options), _units(family, options).get(RATE, RATE))

    def digits(self, spare: int, times: Sequence[float]) -> Any:
        """Return the samples at some times as a list of dicts by name, with certified digits as texts.

        Beyond `spare` bits of further precision a number is called undecided. The number of digits is that of
        --digits, else ten.
        """
        from atlas.arithmetic.certified_digits import certified

        block = partial(self.balls, times, replace(self.family, quantities=()))
        return certified(block, self.options["digits"] or TABLE_DIGITS, spare=spare)["samples"]

    def shown_otherwise(self, parameters: dict[str, Any]) -> bool:
        """Show a file, a curve, uncertain results or a motion in given axes; return whether the options ask for one.

        These are not in the list of quantities, or have no certified counterpart. `parameters` are the inputs by
        name for JSON.
        """
        family, options = self.family, self.options
        if options.get("out") is not None:
            _write_table(family, options, self.times)
            return True
        if options.get("curve"):
            _show_curve(family, options, parameters)
            return True
        if uncertain(options):
            self.with_sigma(parameters)
            return True
        if not family.in_given_axes or options["digits"] is not None or options["decimal"]:
            return False
        motion = motion_in_given_axes(options)
        if motion is not None:
            self.in_doubles(motion, parameters)
        return motion is not None

    def with_sigma(self, parameters: dict[str, Any]) -> None:
        """Print the results with standard deviations, as JSON or as a table.

        `parameters` are the inputs by name for JSON.
        Raises click.UsageError for --digits, --decimal and --spectrum.
        """
        family, options = self.family, self.options
        if options["digits"] is not None or options["decimal"] or options.get("spectrum"):
            raise click.UsageError(
                "--digits, --decimal and --spectrum go without an uncertainty: leave out one of both."
            )
        answers = spread_of(family, options, self.times, self.described.name)
        if options["as_json"]:
            dump({"parameters": parameters, **answers.record()})
            return
        texts, lines = answers.texts(), list[Line]()
        if "larmor" in texts:
            lines.append(Line("larmor", "Larmor frequency |B'|", texts["larmor"], "1/s", "(27)"))
        if body.units_of(options):
            rates = answers.rates([q.name for q in family.quantities if q.unit == RATE] + ["larmor"])
            lines += [Line(f"{name}/2 pi", "in turns a second", text, "Hz") for name, text in rates.items()]
        printout = self.printout(texts, "", lines)
        show(replace(printout, notes=chain(filter(None, printout.notes), answers.notes)))

    def in_doubles(self, motion: Any, parameters: dict[str, Any]) -> None:
        """Print the quantities and samples of a motion in given axes, in doubles, as JSON or as a table.

        `parameters` are the inputs by name for JSON.
        """
        from atlas.motions.start import body_of

        options, times, family = self.options, self.times, FAMILIES[motion.family]
        as_json = options["as_json"]
        sampled = [s for s in family.sampled if s.printed and not (s.uncertified and not as_json)]
        record = {"family": family.name} | _answers(family, motion, times if as_json else times[:AT_ONCE], sampled)
        record |= recorded(spectrum_of(motion, options))
        body_given = body_of(motion.arguments["inertia"])
        if as_json:
            principal = {"principal_moments": body_given.moments, "principal_axes": body_given.axes}
            dump({"parameters": parameters, **principal, **record, **_input_error(family, motion, times)})
            return
        described = family.command or Described("motion", "", "", (), family.says)
        bare = replace(family, quantities=())
        texts = _rounded(record)
        texts["samples"] = chain(
            texts.get("samples", []),
            later(times, lambda block: _rounded(_answers(bare, motion, block, sampled)["samples"])),
        )
        moments = [] if body.given_tensor(options) is None else [
            Line(f"I{i}", f"principal, about {axes_text([axis])}", f"{moment:.{TABLE_DIGITS}g}", "inertia")
            for i, (moment, axis) in enumerate(zip(body_given.moments, body_given.axes, strict=True), 1)
        ]  # fmt: skip
        question = replace(self, family=family, described=described)
        printout = question.printout(texts, NOT_ASKED, [*moments, *_in_hertz(family, texts, options)])
        axes = axes_text(motion.axes)
        if axes != OWN_AXES:
            says = f"Quantities are along the axes {axes} of the body{family.last_axis}; columns along the axes given."
            printout = replace(printout, notes=chain([says], printout.notes))
        question.finish(printout, motion)

    def printout(self, texts: dict[str, Any], worth: str, more_lines: Iterable[Line]) -> Printout:
        """Return the texts of quantities and samples as a `Printout`: lines of quantities, three rows for each time.

        `texts` are by name, `worth` is the note on which digits are proven, `more_lines` follow the quantities.
        Rows and notes are made while they are printed.
        """
        from atlas.arithmetic.certified_digits import ZERO_WITHIN

        family, described, options = self.family, self.described, self.options
        is_small = False

        def rows() -> Iterator[list[str]]:
            nonlocal is_small
            for row in in_threes(texts.get("samples", [])):
                is_small |= any(text.startswith(ZERO_WITHIN) for text in row)
                yield row

        def notes() -> Iterator[str]:
            yield from (f"{x.text} is {x:.10g} rad/s." for _, x in measured(options) if "Hz" in x.text)
            yield from dict.fromkeys(texts.get("missing", {}).values())
            yield worth.replace("printed", "printed, but of rounded lines,") if units else worth
            yield from [self.best.reason] * bool(self.best.reason)
            if is_small or any(ZERO_WITHIN in line.value for line in lines):
                yield f"{ZERO_WITHIN}1e-k: {SMALL}"

        case = texts[described.named] if described.named else ""
        units = _units(family, options)
        lines = lines_of_quantities(family, texts, options, described.named)
        heading = [
            head.replace(f"[{s.unit}]", f"[{units.get(s.unit, s.unit)}]")
            for s in family.sampled
            if s.printed and not s.uncertified
            for head in s.heading
        ]
        return Printout(described.title + case, [*lines, *more_lines], ("t", *heading), rows(), notes())


def later(times: Sequence[float], recorded_at: Callable[[Sequence[float]], Any]) -> Iterator[dict[str, Any]]:
    """Yield the records of the times after the first 200, `AT_ONCE`, one for each time.

    `recorded_at` returns a list of the records for a block of at most 200 times, so that a table prints while the next
    block is computed.
    """
    for start in range(AT_ONCE, len(times), AT_ONCE):
        yield from recorded_at(times[start : start + AT_ONCE])


def _rounded(record: Any) -> Any:
    """Return a record, nested dicts and lists, with its numbers as texts of ten digits."""
    return mapped(record, lambda x, _: f"{x:.{TABLE_DIGITS}g}")


def _write_table(family: Family, options: dict[str, Any], times: Sequence[float]) -> None:
    """Write the samples at all times, in doubles, into the file --out, and print its path.

    `options` are the command's, by name. Raises click.UsageError for --digits, --decimal, --json and uncertain numbers.
    """
    if options["digits"] is not None or options["decimal"] or options["as_json"] or uncertain(options):
        raise click.UsageError("--out writes doubles: leave out --digits, --decimal, --json and uncertainties.")
    motion = motion_in_given_axes(options) if family.in_given_axes else None
    write_table(motion or _kernel(family, options), times, options["out"], _units(family, options))
    click.echo(str(options["out"]))


def _show_curve(family: Family, options: dict[str, Any], parameters: dict[str, Any]) -> None:
    """Print the spectral curve of a motion on a torus, as JSON or as lines "name = value".

    `options` are the command's, `parameters` the inputs for JSON, both by name. Raises click.UsageError for uncertain
    numbers, a tensor and an attitude.
    """
    from atlas.motions.torus.certified_spectral_curve import SpectralCurve

    if uncertain(options) or body.given_tensor(options) is not None or options["attitude"] is not None:
        raise click.UsageError("--curve is proven: give numbers without an uncertainty, along principal axes.")
    curve = SpectralCurve(_balls(family, options))
    record = curve.record(options["digits"] or TABLE_DIGITS)
    if options["as_json"]:
        dump({"parameters": parameters, "curve": record})
        return
    guessed = record.pop("not_proved")
    notes = ["The numbers are proven, but for " + ", ".join(name.replace("_", " ") for name in guessed) + "."]
    click.echo(
        "\n".join([*(f"{name} = {value}" for name, value in (record | guessed).items()), *notes]).replace("'", "")
    )


def spread_of(family: Family, options: dict[str, Any], times: Sequence[float] = (), named: str = "") -> UncertainAnswer:
    """Return the `UncertainAnswer` of a family's object: quantities and samples at times, with standard deviations.

    `options` are the command's, by name; `named` is the name of the command, whose record has the name of the
    family where several share it.
    """
    sampled = [s for s in family.sampled if s.printed and not (s.uncertified and not options.get("as_json"))]
    middle = dict[str, Any]()

    def answered(values: dict[str, Any]) -> dict[str, Any]:
        motion = motion_in_given_axes(values) if family.in_given_axes else None
        answering = family if motion is None else FAMILIES[motion.family]
        motion = _kernel(answering, values) if motion is None else motion
        answers = {"family": answering.name} if named == "motion" else {}
        if values is not options:  # a proof that is a sentence is said once
            answering = replace(answering, quantities=tuple(_quantities_of_draws(answering, middle)))
        answers |= _answers(answering, motion, times, [s for s in sampled if times and hasattr(motion, s.method)])
        middle.update(answers if values is options else {})
        larmor = in_field(family) and values["magnetic"] is not None
        return answers | ({"larmor": hypot(*body.chosen_field(values))} if larmor else {})

    return UncertainAnswer.of(answered, options)


def _quantities_of_draws(family: Family, middle: Mapping[str, Any]) -> Iterator[Quantity]:
    """Yield the `Quantity` definitions for an object at drawn inputs, without slow quantities that are in no table.

    `middle` holds the values at the given inputs, by name. If a quantity with a `drawn` has a value there, its `get`
    becomes `drawn` with this value as `reference`.
    """
    for q in family.quantities:
        if q.tabled or not q.slow:
            yield replace(q, get=partial(q.drawn, reference=middle[q.name]) if q.drawn and q.name in middle else q.get)


def lines_of_quantities(family: Family, texts: dict[str, Any], options: dict[str, Any], named: str = "") -> list[Line]:
    """Return the printed `Line`s of a family's quantities, whose values as text are in `texts` by name.

    `options` decide on the units. The quantity called `named` has no line: its text is the case, such as the kind of
    motion, that selects the lines.
    """
    case = texts.get(named, "") if named else ""
    quantities = [q for q in family.quantities if q.name in texts and q.name != named]
    return [line for q in quantities for line in _lines(q, texts[q.name], case, _units(family, options))]


def _parameters(family: Family, options: dict[str, Any]) -> dict[str, Any]:
    """Return the given options of a family's object by name, for the record in JSON.

    A top also with its coefficients.
    """
    if family.takes("coupling") and given_otherwise(options):
        return parameters_of_top([p.name for p in family.parameters], options)
    parameters = body.body_parameters(options) if in_field(family) else {}
    parameters |= given_options(options, [*(p.name for p in family.parameters if p.option), "spin"])
    if family.takes("c"):
        parameters |= given_options(options, CHARGE) | {"units": body.system_of(options)}
    return parameters


def _input_error(family: Family, motion: Any, times: Sequence[float]) -> dict[str, float]:
    """Return {"input_error": angle}, the largest angle in rad by which rounded inputs turn the body at the times.

    {} without times, where the angle is not known, and below `ROUNDING`. `motion` is the object in doubles.
    """
    error = _turn_by_rounding(family, motion, times)[0] if times else None
    return {"input_error": error} if error is not None and error > ROUNDING else {}


def _turn_by_rounding(family: Family, motion: Any, times: Sequence[float]) -> tuple[float | None, float]:
    """Return (largest bound in rad of the angle by which rounded inputs turn the body, its time).

    Where no derivatives are at hand the bound is None and the time the one furthest from 0. `motion` is the object
    in doubles.
    """
    moments = [*map(float, times)]
    with suppress(AtlasError):
        if family.is_sensitive:
            return max(zip(map(float, motion.input_error(moments)), moments, strict=True))
    return None, max(moments, key=abs)


def _rates(options: dict[str, Any]) -> list[float]:
    """Return the numbers, in 1/time, that bound a motion's rates: of --field, --omega, --omega2 and --spin.

    [inf] for a field given as --magnetic and for tops, whose rates are not known from these. `options` are the
    command's, by name.
    """
    rates = [x for name in ("field", "omega", "omega2", "spin") for x in parts_of(options.get(name) or 0.0)]
    return rates if options.get("magnetic") is None and options.get("linear") is None else [inf]


def is_short(rates: Iterable[float], times: Iterable[float]) -> bool:
    """Return whether |rate t| is below 6 (`SHORT`) for all rates and times, so that rounded inputs do not matter."""
    return max(map(abs, rates)) * max(map(abs, times), default=0.0) < SHORT


def _of_rounding(family: Family, options: dict[str, Any], times: Sequence[float], motion: Any = None) -> Iterator[str]:
    """Yield at most one sentence: the angle by which rounded inputs turn the body, if it may exceed `ROUNDING`.

    Nothing with --digits or --decimal, and for short times. `motion` is the object in doubles, made from the options if
    None.
    """
    rounded = options["digits"] is None and not options["decimal"] and (family.is_sensitive or family.in_given_axes)
    if not rounded or not times or is_short(_rates(options), times):
        return
    for sentence in of_rounding(family, motion or _kernel(family, options), times):
        yield f"{sentence}; --digits with --decimal takes them as typed."


def of_rounding(family: Family, motion: Any, times: Sequence[float]) -> Iterator[str]:
    """Yield at most one clause: the angle in rad by which rounded inputs turn a motion, if it may exceed `ROUNDING`.

    The angle is the largest at the times; a clause says so where it is not known.
    """
    error, t = _turn_by_rounding(family, motion, times)
    if error is None or error > ROUNDING:
        turn = "an angle that is not known" if error is None else f"up to {error:.1g} rad"
        yield f"Rounding the inputs to floats turns the body by {turn} at t = {t:g}"


def _kernel(family: Family, options: dict[str, Any]) -> Any:
    """Return the family's object in doubles, made from the command's options by name."""
    return family.kernels()(*values_of(family, options))


def _balls(family: Family, options: dict[str, Any]) -> Any:
    """Return the certified object of a family that the command's options describe.

    Where a tensor or an attitude is given and the family takes them, it is the `PlacedMotion` along the given axes.
    """
    if family.in_given_axes and (body.given_tensor(options) is not None or options["attitude"] is not None):
        from atlas.motions.torus.certified_placed import PlacedMotion

        body.given_attitude(options)  # raises for wrong values
        typed_options = body.as_typed(options)
        attitude = typed_options["attitude"] or (0, 0, 0, 1)
        tensor, field = body.tensor_or_moments(typed_options), body.chosen_field(typed_options)
        return PlacedMotion(tensor, field, body.start_of(typed_options), attitude)
    return family.balls()(*values_of(family, options))


def _answers(family: Family, motion: Any, times: Sequence[float], sampled: Sequence[Sampled]) -> dict[str, Any]:
    """Return the quantities of a motion in doubles by name, and under "samples" a record for each of the times.

    `sampled` are the functions of time. A motion in given axes returns the momentum m itself: the record has m/I2, in
    1/time, where the family's unit is that. `motion` is the object of `family`.
    """
    columns = {s.name: at_times(s.method_of(motion), times) for s in sampled}
    placed = getattr(motion, "is_placed", False)
    I2 = getattr(motion.own.arguments.get("ratio"), "I2", 1.0) if placed else 1.0
    columns |= {s.name: columns[s.name] / I2 for s in sampled if s.name == "m" and s.unit == RATE}
    return _quantities(family, motion, times, columns, exact=False)


def object_options(family: Family) -> list[Callable[[Any], Any]]:
    """Return the decorators of click that add all options which define an object of a family."""
    return [
        *([body.body_options] if family.takes("ratio") else []),
        *([body.field_options] if in_plane(family) else []),
        *([body.any_body_options] if of_any_body(family) else []),
        *(
            _option(p, is_required=p.needed and p.name not in family.instead)
            for p in family.parameters
            if p.option and not (of_any_body(family) and p.name in OF_BODY)
        ),
        *([body.spin_option] if "omega" in family.instead else []),
        *([body.tensor_option, body.attitude_option, body.curve_option] if family.in_given_axes else []),
        *([top_options] if family.takes("coupling") else []),
        *([charge_options, units_option] if family.takes("c") else []),
    ]


def in_plane(family: Family) -> bool:
    """Return whether a family's field is (0, B2, B3), with the options for B and the charge-to-mass ratio."""
    return any(p.name == "field" and not p.option for p in family.parameters)


def of_any_body(family: Family) -> bool:
    """Return whether a family takes three moments of inertia, and a field of three components."""
    return any(p.name == "inertia" and len(p.names) == len("123") for p in family.parameters)


def in_field(family: Family) -> bool:
    """Return whether a family's field may be given as B with a charge-to-mass ratio."""
    return of_any_body(family) or family.takes("ratio")


def _option(p: Parameter, *, is_required: bool) -> Callable[[Any], Any]:
    """Return the decorator of a parameter's option, with the register's default unless it `is_required`."""
    settings: dict[str, Any] = {"required": True} if is_required else {}
    if not is_required and p.omitted is not None:
        default, count = f"{p.omitted:g}", len(p.names)
        settings = {"default": (default,) * count} if count > 1 else {"default": default, "show_default": True}
    quantity, semicolon, condition = p.says.rstrip(".").partition(";")
    unit = f", in {p.unit}" if "/" in p.unit or "^" in p.unit else ""
    return numbers(p.name, f"{quantity}{unit}{semicolon}{condition}.", p.metavar or "", **settings)


def values_of(family: Family, options: dict[str, Any]) -> Iterator[Any]:
    """Yield the arguments of a family's classes in their order, from the command's options by name.

    Numbers are doubles, or exact fractions with --decimal. A top given by --heavy or --magnetic yields its computed
    coefficients. Raises click.UsageError and DomainError for faulty options, when the arguments are taken.
    """
    if family.takes("coupling"):
        if given_otherwise(options):
            top = chosen_top(options)
            yield from (top.arguments[p.name] for p in family.parameters)
            return
        needs_no_way(options)
    yield from (value_of(family, p, options) for p in family.parameters)


def value_of(family: Family, p: Parameter, options: dict[str, Any]) -> Any:
    """Return the argument of a family's class for its parameter `p`, from the command's options by name.

    Numbers are doubles, or exact fractions with --decimal; None for an option that may be missing.
    """
    typed_options = body.as_typed(options)
    if p.name in OF_BODY and (not p.option or of_any_body(family)):
        return OF_BODY[p.name](typed_options)
    if p.name == "mu":
        return body.charge_to_mass_of(typed_options, "A point charge")
    if p.name == "c":
        return body.speed_of_light(options)
    return body.start_of(typed_options) if p.name == "omega" and "spin" in options else typed_options[p.name]


def sample(s: Sampled, motion: Any, t: Any, best: Best) -> Any:
    """Return s(t), a matrix (3, 3) or a vector (3,) in balls; if the current precision fails, the best one so far.

    That one is in `best`, which is updated in place. Without any, the entries are the text `NOT_CERTIFIED`, so that
    a time out of reach does not keep the others from printing. `motion` is the object in balls.
    """
    try:
        best[s.name, t] = s.method_of(motion)(t)
    except NotCertifiedError as reason:
        best.reason = str(reason)
        from atlas.arithmetic.certified_digits import NOT_CERTIFIED

        none = [NOT_CERTIFIED] * 3
        return best.get((s.name, t), [none] * 3 if s.matrix else none)
    return best[s.name, t]


def _quaternion(motion: Any, t: Any, R: Any, quaternion_near: Any) -> Any:
    """Return the quaternion [x, y, z, w] of R (3, 3) at time t in balls, with the sign of `quaternion_near`.

    `quaternion_near` is the same in floats. Four times "not certified" if the entries of R are, or if it is None.
    """
    from flint import fmpq

    from atlas.arithmetic.certified_digits import NOT_CERTIFIED
    from atlas.motions.nutation.certified_cayley_klein import quaternion

    if quaternion_near is None or isinstance(R[0][0], str):
        return [NOT_CERTIFIED] * 4
    q = quaternion(R, quaternion_near)
    if not hasattr(motion, "quaternion"):
        return q
    w, *vector = motion.quaternion(t)  # a component that is zero at all times is exactly zero in one of both
    motion_quaternion, i = [*vector, w], max(range(4), key=lambda i: abs(quaternion_near[i]))
    motion_quaternion = (
        motion_quaternion if (motion_quaternion[i] > 0) == (quaternion_near[i] > 0) else [-x for x in motion_quaternion]
    )
    return [x if isinstance(x, fmpq) or x.rad() < y.rad() else y for x, y in zip(motion_quaternion, q, strict=True)]


def _quantities(
    family: Family, motion: Any, times: Sequence[float], columns: Mapping[str, Any], *, exact: bool
) -> dict[str, Any]:
    """Return quantities by name, and under "samples" a list of records for the times, from arrays by name.

    `columns` has a value for each time of each function; values of quantities are exact or in balls if `exact`. A
    quantity that may be missing is left out where it has no value, others are None; the reason stands under
    "missing". `motion` is the object of `family`, in doubles or balls.
    """
    values, reasons = dict[str, Any](), dict[str, str]()
    for q in family.quantities:
        if not q.printed:
            continue
        try:
            values[q.name] = q.value(motion, exact=exact)
        except DomainError as reason:
            reasons[q.name] = str(reason)
            if not q.missing:
                values[q.name] = None
        else:
            if q.unit == TIME and values[q.name] == float("inf"):
                values[q.name] = "infinite"
    return (
        values | ({"missing": reasons} if reasons else {}) | ({"samples": samples(times, **columns)} if columns else {})
    )


def _units(family: Family, options: dict[str, Any]) -> dict[str, str]:
    """Return other names of units by the register's names, such as {"1/time": "1/s"}; {} where no unit is known.

    `options` are the command's, by name.
    """
    if family.takes("coupling"):
        return top_units(options)
    if family.takes("c"):
        return UNITS[body.system_of(options)]
    return body.units_of(options)


def _lines(q: Quantity, texts: Any, case: str, units: dict[str, str]) -> Iterator[Line]:
    """Yield the `Line` of a quantity, or one for each component; "-" for a value None.

    `case` selects words and equation, `units` replaces names of units. `texts` is the value as text, or a list with
    one for each component.
    """
    says, equation = q.cases.get(case, (q.says, q.equation))
    count = len(q.lines)
    components = [texts] if not q.lines else [None] * count if texts is None else texts
    for (symbol, words), component in zip(q.lines or [(q.symbol or q.name, says)], components, strict=True):
        unit = "" if component is None else units.get(q.unit, q.unit)
        yield Line(symbol, words, "-" if component is None else q.text(component), unit, equation)


def _in_hertz(family: Family, texts: dict[str, Any], options: dict[str, Any]) -> Iterator[Line]:
    """Yield lines of the rates in hertz and of Larmor's frequency, rounded to six digits, if units are known.

    The lines of rates, in rad/s, have them divided by 2 pi; Larmor's frequency |B'| has a line in 1/s and one in
    Hz, only with --magnetic. `texts` are the quantities by name; those that are no number are left out. `options`
    are the command's, by name.
    """
    if not _units(family, options):
        return
    texts_of_rates = {q.name: texts[q.name] for q in family.quantities if q.unit == RATE and q.name in texts}
    rates = {name: float(text) for name, text in texts_of_rates.items() if _is_number(text)}
    if in_field(family) and options["magnetic"] is not None:
        larmor = hypot(*body.chosen_field(options))
        yield Line("larmor", "Larmor frequency |B'|, rounded", f"{larmor:.6g}", "1/s", "(27)")
        rates["larmor"] = larmor
    for name, rate in rates.items():
        yield Line(f"{name}/2 pi", "in turns a second, rounded", f"{rate / (2 * pi):.6g}", "Hz")


def _is_number(text: Any) -> bool:
    """Return whether `text` is a text of one finite number."""
    try:
        return isinstance(text, str) and isfinite(float(text))
    except ValueError:
        return False
