"""The data of a report: its tables and what its figures draw, without a page."""

import gzip
import shutil
from collections.abc import Callable
from pathlib import Path
from tempfile import mkdtemp
from typing import TYPE_CHECKING

from atlas.build import figures
from atlas.build.cache import Cache
from atlas.build.figures import FigureBuild
from atlas.errors import AtlasError
from atlas.places import cache_folder
from atlas.report.find import find
from atlas.sources import Sources

if TYPE_CHECKING:
    from atlas.report.blocks.figure import FigureView

OUT = Path("build/data")
UNFINISHED = ".atlas-data-"
"""How the folder begins that files stand in until all are written, beside the one that they are for."""


def build_data(
    name: str | Path,
    out: Path = OUT,
    progress: Callable[[int, int, str], None] = lambda _done, _total, _what: None,
    *,
    jobs: int | None = None,
) -> Path:
    """Write the tables and the drawn data of a report into `out`/NAME, and return the place of their description.

    The folder is replaced as a whole. Raises AtlasError for a mistake in the report, a figure that fails, a folder that
    holds something else, and OSError when something can't be written.
    """
    from atlas.build.appendices import gather
    from atlas.build.report import describe, outlines
    from atlas.draw import gl
    from atlas.report import bibliography
    from atlas.report.compose import compose
    from atlas.report.data_package import DESCRIPTION, package
    from atlas.report.load import load
    from atlas.report.pictures import pictures

    file = find(str(name))
    report = load(file)
    place = out / report.name
    if place.is_symlink() or (place.exists() and not (place / DESCRIPTION).is_file() and any(place.iterdir())):
        raise AtlasError(f"{place} holds something else than the data of a report: move it, or choose another --out.")
    cache, wanted = Cache(cache_folder(out)), pictures(report)
    builds = {
        FigureBuild(one.recipe, one.parameters, one.renderer, ("csv.gz",)): one
        for one in wanted.values()
        if not one.failure
    }
    figures.find(list(builds), cache, Sources(cache), gl.library())
    figures.draw(list(builds), cache, jobs or figures.cores(), progress)
    for build, picture in builds.items():
        if build.failure:
            raise AtlasError(f"the figure {build.name} failed: {build.failure}")
        describe(build, picture)
    works = bibliography.read(file.parent / report.bibliography) if report.bibliography else None
    document = compose(report, wanted, gather(report), works, outlines(report))
    contents = {picture.stem: build.contents["csv.gz"] for build, picture in builds.items()}
    views: list[FigureView] = document.listed("figure")
    drawn = {
        view.id: gzip.decompress(contents[view.pictures[0].stem]).decode()
        for view in views
        if view.pictures[0].stem in contents
    }
    _replace(place, package(document, drawn))
    return place / DESCRIPTION


def _replace(place: Path, contents: dict[str, bytes]) -> None:
    """Put a folder with these files in the place of the one that is there."""
    place.parent.mkdir(parents=True, exist_ok=True)
    work = Path(mkdtemp(dir=place.parent, prefix=UNFINISHED))
    try:
        for name, content in contents.items():
            (work / "new" / name).parent.mkdir(parents=True, exist_ok=True)
            (work / "new" / name).write_bytes(content)
        if place.exists():
            place.rename(work / "old")
        (work / "new").rename(place)
    finally:
        shutil.rmtree(work, ignore_errors=True)
