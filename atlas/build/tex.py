"""A report as LaTeX: numbers, tables, figures and references to be taken into a manuscript."""

from pathlib import Path
from typing import TYPE_CHECKING

from atlas.build.composed import Progress, composed
from atlas.build.publish import replace
from atlas.report.find import find

if TYPE_CHECKING:
    from atlas.report.blocks.figure import FigureView

OUT = Path("build/tex")
TARGETS = ("aps", "aps-double")
"""What the figures of a paper in REVTeX are made for: a column, or both."""


def build_tex(
    name: str | Path,
    out: Path = OUT,
    progress: Progress = lambda _done, _total, _what: None,
    *,
    jobs: int | None = None,
) -> Path:
    """Write a report as LaTeX into `out`/NAME, and return the place of the paper.

    The folder is replaced at once, with what the user has put there. Raises AtlasError for a mistake in the report, a
    figure that fails, a file that was edited, beside which the new one is then, and OSError when something can't be
    written.
    """
    from atlas.report.latex import PAPER, sources

    place = out / find(str(name)).stem
    document, figures = composed(
        name, out, lambda picture: ("png" if picture.renderer == "shaded" else "pdf",), progress, jobs, TARGETS
    )
    document.set("latex")
    pictures = {}
    views: list[FigureView] = document.listed("figure")
    for view in views:
        for number, picture in enumerate(view.pictures, 1):
            if picture.stem in figures:
                ((kind, content),) = figures[picture.stem].contents.items()
                more = f"-{number}" if len(view.pictures) > 1 else ""
                pictures[f"figures/{view.id.removeprefix('fig-')}{more}.{kind}"] = content
    replace(place, sources(document, pictures))
    return place / PAPER
