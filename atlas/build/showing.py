"""The plates of a report's gallery: their words as soon as their scenes are there, their files when they are drawn."""

from collections.abc import Iterable, Mapping
from pathlib import Path

from atlas.build.drawing import KINDS
from atlas.build.plates import Plate, Request
from atlas.build.store import place
from atlas.report.gallery import Gallery
from atlas.report.views import Plate as View


class Showing:
    """The gallery of a report, and for each of its plates what became of it."""

    def __init__(self, gallery: Gallery, targets: tuple[str, ...]) -> None:
        self._views = {Request(view.recipe, view.renderer, view.parameters, targets): view for view in gallery.values()}
        self.requests = [request for request, view in self._views.items() if not view.failure]

    def words(self, plate: Plate) -> None:
        """Let the report know what a plate says and how large it is, or why there is none."""
        view = self._views[plate.request]
        view.failure = plate.failure
        if plate.failure:
            return
        facts = plate.facts
        view.caption, view.alt, view.settings = facts["caption"], facts["alt"], facts["parameters"]
        width, height = facts["size"]
        view.size = (width, height)
        view.files = {target: _name(view, facts["renderer"], target) for target in plate.request.targets}
        if facts["renderer"] != view.renderer and plate.note:
            view.remark = "Drawn by the vector renderer."

    def put(self, plate: Plate, folder: Path) -> None:
        """Put the files of a plate in their places, if it did not fail."""
        if plate.failure:
            return
        for target, name in self._views[plate.request].files.items():
            place(plate.file(target), folder / name)

    def missing(self, plates: Iterable[Plate], target: str) -> Mapping[str, tuple[float, float]]:
        """Return the files for a target that are still to be drawn, with their sizes in millimetres."""
        views = (self._views[plate.request] for plate in plates if target in plate.missing and not plate.failure)
        return {view.files[target]: view.size for view in views}


def _name(view: View, renderer: str, target: str) -> str:
    """Name the file of a plate in the report's folder."""
    return f"figures/{view.stem}.{KINDS[renderer][target]}"
