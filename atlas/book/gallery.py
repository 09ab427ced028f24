"""The gallery: a page of pictures of all recipes in rows, each leading to the figure, its code and its command."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from atlas.book.blocks.figure import FigureView, Picture
from atlas.book.document import PageView
from atlas.errors import AtlasError
from atlas.pictures import recipes
from atlas.targets import TARGETS
from atlas.trial.ledger import EQUATIONS
from atlas.trial.ledger.citation import marked

if TYPE_CHECKING:
    from atlas.book.blocks.composer import Composer


@dataclass(frozen=True)
class Plate:
    """A figure of the gallery: `picture`, index of its `sentence` among the document's texts, and its `page`.

    `page` is the address of the figure in the report, such as "motions.html#fig-cusp", or "" if no page shows it.
    """

    picture: Picture
    sentence: int
    page: str = ""

    @property
    def anchor(self) -> str:
        """Id of the large figure in the page, "figure-NAME"."""
        return f"figure-{Path(self.picture.recipe).stem}"

    @property
    def python(self) -> str:
        """Python source of the call of `atlas.figure` that draws the figure; parameters that are None are left out."""
        settings = (f", {key}={value!r}" for key, value in self.picture.parameters.items() if value is not None)
        return f'atlas.figure("{self.picture.called}"{"".join(settings)})'


@dataclass(frozen=True)
class GalleryView:
    """Plates by heading of their row, and the width of each target of figures by its name, as text such as "86 mm"."""

    rows: dict[str, list[Plate]]
    widths: dict[str, str]

    @property
    def plates(self) -> list[Plate]:
        """All plates, in the order of the rows."""
        return [plate for row in self.rows.values() for plate in row]

    @property
    def pictures(self) -> tuple[Picture, ...]:
        """Pictures of all plates, in order; the page loads their scripts."""
        return tuple(plate.picture for plate in self.plates)


def page(composer: "Composer") -> PageView:
    """Return the `PageView` of a report's gallery, one block with a `Plate` for each recipe that did not fail.

    The sentence of a plate is that of its recipe, or the first one of the picture's caption.
    """
    composer.place, document = "the gallery", composer.document
    places: dict[int, str] = {}
    for view_of_page in document.pages:
        for block in view_of_page.blocks:
            for picture in block.pictures if isinstance(block, FigureView) else ():
                places.setdefault(id(picture), f"{view_of_page.file}#{block.id}")
    rows: dict[str, list[Plate]] = {row: [] for row in (*recipes.ROWS, "")}
    for name in document.report.gallery:
        picture = min(
            (candidate for candidate in document.pictures.values() if candidate.recipe == name),
            key=lambda candidate: candidate.renderer != "vector",
        )
        if not picture.failure:
            recipe = recipes.load(name)
            sentence = recipe.seen or marked(picture.caption, EQUATIONS).partition(". ")[0].removesuffix(".") + "."
            plate = Plate(picture, composer.text(sentence, inline=True), places.get(id(picture), ""))
            rows[recipe.row].append(plate)
    view = GalleryView(
        {row or "Other figures": plates for row, plates in rows.items() if plates},
        {name: f"{target.width:g} mm" for name, target in TARGETS.items()},
    )
    return PageView("", "gallery", "Gallery", composer.text("Gallery", inline=True), (view,), ("gallery",))


def chosen(names: Sequence[str], folder: Path) -> tuple[str, ...]:
    """Return the distinct recipes of a gallery as names, or paths for files.

    "*" stands for all names in figures/, "NAME.py" for files in ``folder``, also as a pattern. Raises AtlasError for a
    name or a file that does not exist.
    """
    chosen_names = list[str]()
    for name in names:
        if name == "*":
            chosen_names += recipes.names()
        elif name.endswith(".py") and not Path(name).is_absolute():
            files = sorted(map(str, folder.glob(name)))
            if not files:
                raise AtlasError(f"gallery: no recipe {name} in {folder}.")
            chosen_names += files
        else:
            chosen_names.append(name if recipes.source(name) else "")
    return tuple(dict.fromkeys(chosen_names))
