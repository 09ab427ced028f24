"""A gallery of recipes without a report of the user's: its report file, and the pages built from it."""

from collections.abc import Sequence
from pathlib import Path

from atlas.book.building.cache import Cache
from atlas.book.building.report import Built, Progress, build_report
from atlas.files import write
from atlas.places import cache_folder
from atlas.sources import Sources


def build_gallery(
    names: Sequence[str], out: Path, progress: Progress, *, style: str | None = None, jobs: int | None = None
) -> Built:
    """Build a gallery of recipes, of all when none is named, as out/gallery/gallery.html; return the `Built`.

    The report that it is made from is written to out/gallery.md; a name that ends in .py is the path of a recipe of the
    user's own. `progress`, `style` and `jobs` are those of `build_report`, which raises the errors.
    """
    places = [str(Path(name).absolute()) if name.endswith(".py") else name for name in names] or ["*"]
    sources = Sources(Cache(cache_folder(out)))
    version = sources.closure([Path(place) for place in places if place.endswith(".py")])
    head = (
        f'name = "gallery"\ntitle = "Gallery of figures"\ngallery = {places!r}\n# of recipes with the digest {version}'
    )
    source = out / "gallery.md"
    write(source, f"+++\n{head}\n+++\n\n# All figures\n\nThey stand in the [gallery](gallery.html).\n")
    return build_report(source, out, progress, formats=("html",), style=style, jobs=jobs)
