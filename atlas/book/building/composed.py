"""A report composed with its figures drawn in some format: its data, and the same as LaTeX, without a page."""

import gzip
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from atlas.book.building import figures
from atlas.book.building.cache import Cache
from atlas.book.building.figures import FigureBuild, Progress
from atlas.book.building.publish import replace
from atlas.book.files import find
from atlas.book.inputs import evaluated, name_of
from atlas.errors import AtlasError
from atlas.places import cache_folder
from atlas.sources import Sources

if TYPE_CHECKING:
    from atlas.book.blocks.figure import FigureView, Picture
    from atlas.book.document import Document

NO_INPUTS: Mapping[str, str] = MappingProxyType({})


def composed(
    name: str | Path,
    out: Path,
    kinds: "Callable[[Picture], tuple[str, ...]]",
    progress: Progress,
    jobs: int | None,
    targets: tuple[str, ...] = (),
    style: str | None = None,
    inputs: Mapping[str, str] = NO_INPUTS,
) -> "tuple[Document, dict[str, FigureBuild], Path]":
    """Return (report with computed tables, figures by the stems of their pictures, the report's folder in `out`).

    The figures are drawn, by `jobs` processes (None: one a core), in the formats that `kinds` returns for a
    picture, each for the first of the `targets` that is wide enough. `progress` is called with (figures done, their
    number, name); `inputs` are texts by name. `style`, or that of the report, is a style sheet of Matplotlib, a
    file or a name; None means the package's own. Raises AtlasError for a mistake in the report and for a figure
    that fails.
    """
    from atlas import gl
    from atlas.book.building.report import check_style, document_of
    from atlas.book.load import load
    from atlas.book.pictures import pictures

    file = find(str(name))
    values = evaluated(file, inputs)
    report = load(file, values)
    check_style(style := style or report.style or None)
    cache, pictures_by_key = Cache(cache_folder(out)), pictures(report)
    builds = {
        FigureBuild(drawing.recipe, drawing.parameters, drawing.renderer, kinds(drawing), style, targets): drawing
        for drawing in pictures_by_key.values()
        if not drawing.failure
    }
    figures.find(list(builds), cache, sources := Sources(cache), gl.library())
    figures.draw(list(builds), cache, jobs or figures.cores(), progress)
    for build in builds:
        if build.failure:
            raise AtlasError(f"the figure {build.name} failed: {build.failure}")
    document = document_of(report, file, pictures_by_key, builds, cache, sources)
    return document, {picture.stem: build for build, picture in builds.items()}, out / name_of(file, values)


def build_data(
    name: str | Path,
    out: Path,
    progress: Progress = lambda _done, _total, _what: None,
    *,
    jobs: int | None = None,
    parquet: bool = True,
    style: str | None = None,
    inputs: Mapping[str, str] = NO_INPUTS,
) -> Path:
    """Write tables and drawn data of a report into `out`/NAME; return the path of the JSON file that describes them.

    They are CSV, and with `parquet` also Parquet. `name` is a report of the package or the path of a file;
    `progress` is called with (figures done, their number, name); `jobs`, `style` and `inputs` are those of
    `composed`.

    The folder is replaced at once; files that the user put there stay. Raises AtlasError for a mistake in the
    report, for a figure that fails, and for a file that the user edited: it stays, and the new one is written
    beside it. Raises OSError when something can't be written.
    """
    from atlas.book.data_package import DESCRIPTION, package

    document, figures, place = composed(name, out, lambda _: ("csv.gz",), progress, jobs, style=style, inputs=inputs)
    views: list[FigureView] = document.listed("figure")
    stems = {view.id: view.pictures[0].stem for view in views}
    tables = {
        name: gzip.decompress(figures[stem].contents["csv.gz"]).decode()
        for name, stem in stems.items()
        if stem in figures
    }
    replace(place, package(document, tables, parquet=parquet))
    return place / DESCRIPTION


TARGETS = ("aps", "aps-double")
"""Targets of the figures of a paper in REVTeX: one column, or both."""


def build_tex(
    name: str | Path,
    out: Path,
    progress: Progress = lambda _done, _total, _what: None,
    *,
    jobs: int | None = None,
    style: str | None = None,
    inputs: Mapping[str, str] = NO_INPUTS,
) -> Path:
    """Write a report as LaTeX, with its figures, into `out`/NAME; return the path of the .tex file.

    `name` is a report of the package or the path of a file; `progress` is called with (figures done, their number,
    name); `jobs`, `style` and `inputs` are those of `composed`.

    The folder is replaced at once; files that the user put there stay. Raises AtlasError for a mistake in the
    report, for a figure that fails, and for a file that the user edited: it stays, and the new one is written
    beside it. Raises OSError when something can't be written.
    """
    from atlas.book.latex import PAPER, sources

    document, figures, place = composed(
        name, out, lambda picture: ("png" if picture.renderer == "shaded" else "pdf",), progress, jobs, TARGETS, style,
        inputs,
    )  # fmt: skip
    document.set(
        "latex", "typst"
    )  # what print cannot read is refused here, too: no \input, no \write reaches the paper
    pictures = {}
    views: list[FigureView] = document.listed("figure")
    for view in views:
        for number, picture in enumerate(view.pictures, 1):
            if picture.stem in figures:
                ((kind, content),) = figures[picture.stem].contents.items()
                suffix = f"-{number}" if len(view.pictures) > 1 else ""
                pictures[f"figures/{view.id.removeprefix('fig-')}{suffix}.{kind}"] = content
    replace(place, sources(document, pictures))
    return place / PAPER
