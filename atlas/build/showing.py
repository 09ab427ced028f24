"""The plates of a report: known before anything heavy is loaded, so that what draws them can get ready at once.

Their words go into the report as soon as their scenes are there, their files into its folder when they are drawn.
"""

from collections.abc import Mapping
from pathlib import Path

from atlas.build.drawers import Drawers
from atlas.build.drawing import KINDS
from atlas.build.plates import Plate, Request, survey
from atlas.build.sources import Sources
from atlas.build.store import Store, place
from atlas.render import gl
from atlas.report.gallery import gallery
from atlas.report.records import Report
from atlas.report.views import Plate as View


class Showing:
    """The `gallery` of a report as its pages see it, and its `plates`: what became of each."""

    def __init__(
        self, report: Report, targets: tuple[str, ...], store: Store, sources: Sources, drawers: Drawers
    ) -> None:
        self.gallery = gallery(report)
        views = self.gallery.values()
        self._views = {Request(view.recipe, view.renderer, view.parameters, targets): view for view in views}
        library = gl.library()
        requests = [request for request, view in self._views.items() if not view.failure]
        self.plates = survey(requests, store, sources, library)
        drawers.load([plate.request.renderer if library else "vector" for plate in self.plates if plate.missing])
        sources.save()

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

    def missing(self, target: str) -> Mapping[str, tuple[float, float]]:
        """Return the files for a target that are still to be drawn, with their sizes in millimetres."""
        views = (self._views[plate.request] for plate in self.plates if target in plate.missing and not plate.failure)
        return {view.files[target]: view.size for view in views}


def _name(view: View, renderer: str, target: str) -> str:
    """Name the file of a plate in the report's folder."""
    return f"figures/{view.stem}.{KINDS[renderer][target]}"
