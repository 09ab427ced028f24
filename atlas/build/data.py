"""The data of a report: its tables and what its figures draw, without a page."""

import gzip
from pathlib import Path
from typing import TYPE_CHECKING

from atlas.build.composed import Progress, composed
from atlas.build.publish import replace
from atlas.report.find import find

if TYPE_CHECKING:
    from atlas.report.blocks.figure import FigureView

OUT = Path("build/data")


def build_data(
    name: str | Path,
    out: Path = OUT,
    progress: Progress = lambda _done, _total, _what: None,
    *,
    jobs: int | None = None,
    parquet: bool = True,
) -> Path:
    """Write the tables and the drawn data of a report into `out`/NAME, and return the place of their description.

    They are CSV, and Parquet if that is wanted.

    The folder is replaced at once, with what the user has put there. Raises AtlasError for a mistake in the report, a
    figure that fails, a file that was edited, beside which the new one is then, and OSError when something can't be
    written.
    """
    from atlas.report.data_package import DESCRIPTION, package

    place = out / find(str(name)).stem
    document, figures = composed(name, out, lambda _: ("csv.gz",), progress, jobs)
    views: list[FigureView] = document.listed("figure")
    stems = {view.id: view.pictures[0].stem for view in views}
    drawn = {
        name: gzip.decompress(figures[stem].contents["csv.gz"]).decode()
        for name, stem in stems.items()
        if stem in figures
    }
    replace(place, package(document, drawn, parquet=parquet))
    return place / DESCRIPTION
