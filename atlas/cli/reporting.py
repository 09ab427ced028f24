"""`atlas.report`: a report of a body, or of a name or a file, as `atlas report` builds it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from html import escape
from os import PathLike
from pathlib import Path
from typing import Any

from atlas.arithmetic.annotations import BodyLike, FieldLike, RealArrayLike
from atlas.arithmetic.inputs import real
from atlas.cli.body_request import NAME
from atlas.cli.present import bar
from atlas.cli.your_body import built, places_of, request_of, text_of, words_of
from atlas.errors import AtlasError
from atlas.trial.ledger.plain import html_table


@dataclass(frozen=True)
class Report:
    """A report that was built, its files, and of a body its card.

    Attributes
    ----------
    name : str
        Name of the files.
    files : tuple of Path
        First page and PDF; of a body also card and inputs.
    card : mapping
        Of each number of the card `value`, `sigma`, `unit`, `digits`, `equation` and `reason`, by key, such as "turn";
        empty where the report is not that of a body.
    failures : tuple of str
        Figures that could not be drawn, with the reason.
    """

    name: str
    files: tuple[Path, ...]
    card: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    failures: tuple[str, ...] = ()

    def _repr_html_(self) -> str:
        from atlas.book.several_bodies import value_of

        rows = [(record["says"], value_of(record), record["reason"] or "") for record in self.card.values()]
        table = html_table(self.name, ("number", "value", "why none"), rows) if rows else ""
        links = " ".join(f'<a href="{escape(str(file))}">{escape(str(file))}</a>' for file in self.files)
        return f"{table}<p>{links}</p>"


def report(
    name: str | PathLike[str] = "atlas",
    /,
    *,
    body: BodyLike | None = None,
    field: FieldLike | None = None,
    omega: RealArrayLike | None = None,
    out: str | PathLike[str] | None = None,
    **inputs: str | RealArrayLike,
) -> Report:
    """Build a report: pages, PDF, and of a body its card; the files are those of the command `atlas report`.

    Parameters
    ----------
    name : str or path, optional
        Name of a report, such as "your_body", or a file in Markdown or TOML; by default the atlas itself.
    body : float, SymmetricBody or array_like, optional
        Of "your_body": ratio I3/I2, a `SymmetricBody`, three moments (I1, I2, I3) or an inertia tensor (3, 3).
    field : array_like or Field, optional
        Of "your_body": components (B2, B3) or (B1, B2, B3) of B' = mu B/(2c), in 1/time, or a `Field`.
    omega : array_like, shape (3,), optional
        Of "your_body": initial angular velocity along the axes of the body, in rad/time.
    out : path, optional
        Folder for the files, by default build/report.
    **inputs : str, number or array_like
        Of "your_body" the options of its command by their names, ``radius="1.2um"``, ``omega2=0.7``; numbers with a
        standard deviation too. Of another report the inputs that it declares.

    Returns
    -------
    Report
        Its `files`, the `card` of a body, and `failures` of figures. A notebook shows the card.

    Raises
    ------
    AtlasError
        For an unknown report, body or input, and for a mistake in a report's file, in one sentence each.
    OSError
        When a file cannot be written.

    Examples
    --------
    >>> report = atlas.report("your_body", body=0.7, field=(1, 2), omega2=0.7)  # doctest: +SKIP
    >>> report.card["turn"]["value"]  # doctest: +SKIP
    4.014179846308986
    """
    place = Path("build/report" if out is None else out)
    arguments: dict[str, Any] = {"field": field, "omega": omega} | inputs
    arguments = {key: value for key, value in arguments.items() if value is not None}
    if name == NAME:
        words = [] if body is None else words_of_body(body)
        for key, value in arguments.items():
            words += words_of(key, getattr(value, "exact_pair", value))
        request, _ = request_of(words)
        build, card = built(request, place, None)
        files = tuple(places_of(build))
    else:
        from atlas.book.building.report import build_report
        from atlas.book.inputs import text_of as text_of_input

        if body is not None:
            arguments["body"] = body  # which is an input like any other
        texts = {
            key: text_of_input([*value] if isinstance(value, tuple) else value) for key, value in arguments.items()
        }
        with bar(Path(name).stem) as tell:
            build = build_report(str(name), place, tell, inputs=texts)
        card, files = {}, (build.index, build.pdf)
    return Report(build.name, files, card, tuple(f"{figure}: {reason}" for figure, reason in build.failures))


def words_of_body(body: Any) -> list[str]:
    """Return the words of the option of a body: --ratio, --inertia or --tensor, with its numbers.

    Raises AtlasError for an array that is no ratio, moments (2,) or (3,), or tensor (3, 3).
    """
    if hasattr(body, "I2"):
        return words_of("inertia", (body.I2, body.I3))
    shape = getattr(body, "shape", None) if not hasattr(body, "__len__") else real(body, "body").shape
    if shape in {None, ()}:
        return words_of("ratio", body)
    if shape in {(2,), (3,)}:
        return words_of("inertia", body)
    if shape != (3, 3):
        raise AtlasError(f"body: a ratio, three moments or a tensor (3, 3) is wanted, not an array {shape}.")
    return ["--tensor", *(text_of(body[i][j]) for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)))]
