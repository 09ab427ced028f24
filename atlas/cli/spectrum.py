"""The lines of a motion's spectrum on the command line: the options, a table, and a record for JSON."""

from typing import Any

import click

from atlas.cli.options import numbers, stack
from atlas.cli.present import Line, Printout, show

spectrum_options = stack(
    click.option(
        "--spectrum", type=click.Choice(["axis", "rotation", "angular_velocity", "field"]), is_flag=False,
        flag_value="axis", metavar="[axis|rotation|angular_velocity|field]",
        help="Print frequencies and amplitudes of the Fourier series of the body's axis (the default), the rotation "
        "matrix, the angular velocity or the field in the body.",
    ),
    numbers("least", "Leave out lines of --spectrum with amplitudes below this fraction of the root mean square.",
            default="1e-3", show_default=True),
)  # fmt: skip


def check_spectrum(options: dict[str, Any]) -> None:
    """Raise click.UsageError for --spectrum with --digits or --decimal, and for --least outside (0, 1).

    `options` are the command's, by name.
    """
    if options.get("spectrum") and not 0 < options["least"] < 1:
        raise click.UsageError(f"--least is a fraction between 0 and 1, not {options['least'].text}.")
    if options.get("spectrum") and (options["digits"] is not None or options["decimal"]):
        raise click.UsageError("--spectrum is computed in doubles: leave out --digits and --decimal.")


def spectrum_of(motion: Any, options: dict[str, Any]) -> Any:
    """Return the `Spectrum` of a motion that the command's options ask for, or None."""
    if not options.get("spectrum"):
        return None
    return motion.spectrum(options["spectrum"], least=options["least"])


def recorded(lines: Any) -> dict[str, Any]:
    """Return {"spectrum": ...} of a `Spectrum` for JSON, an amplitude as real and imaginary part; {} for None."""
    if lines is None:
        return {}
    line = zip(lines.frequencies, lines.combinations, lines.amplitudes, strict=True)
    keys = "frequency", "combination", "amplitude"
    return {"spectrum": {
        "of": lines.of, "rates": dict(zip(lines.names, lines.rates, strict=True)), "mean_square": lines.mean_square,
        "lines": [dict(zip(keys, (f, c, {"real": a.real, "imaginary": a.imag}), strict=True)) for f, c, a in line],
    }}  # fmt: skip


def show_lines(lines: Any, unit: str) -> None:
    """Print the rates, then a row for each spectral line with a frequency >= 0: integers, frequency, amplitude.

    `lines` is the `Spectrum`; `unit` is that of its angular frequencies and rates, such as 1/s. The integers
    multiply the rates. The amplitude is the norm of the complex amplitudes of all components.
    """
    rows = [
        [*map(str, c), f"{f:.10g}", f"{size:.6g}"]
        for f, c, size in zip(lines.frequencies, lines.combinations, lines.power**0.5, strict=True)
        if f >= 0
    ]
    show(Printout(
        f"spectrum of the {lines.of.replace('_', ' ')}",
        [Line(name, "rate", f"{rate:.10g}", unit) for name, rate in zip(lines.names, lines.rates, strict=True)],
        [*lines.names, f"frequency [{unit}]", "amplitude"], rows,
        [
            "In doubles. Each line stands for the opposite frequency, with the conjugate amplitude, too.",
            "An amplitude is the norm of the complex ones of all components: one swings by twice the size of its own.",
        ],
    ))  # fmt: skip
