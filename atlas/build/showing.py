"""The plates of a report: known before anything heavy is loaded, so that what draws them can get ready at once.

Their words go into the report as soon as their scenes are there, their files into its folder when they are drawn.
"""

from collections.abc import Mapping
from pathlib import Path

from atlas.build.drawers import Drawers
from atlas.build.drawing import KINDS, PICTURE
from atlas.build.plates import Plate, Request, survey
from atlas.build.sources import Sources
from atlas.build.store import Store, place
from atlas.render import gl
from atlas.report.gallery import gallery
from atlas.report.records import Report


class Showing:
    """The `gallery` of a report as its pages see it, and its `plates`: what became of each."""

    def __init__(self, report: Report, store: Store, sources: Sources, drawers: Drawers) -> None:
        self.gallery = gallery(report)
        views = self.gallery.values()
        self._views = {Request(view.recipe, view.renderer, view.parameters): view for view in views}
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
            view.file = ""
            return
        facts = plate.facts
        view.caption, view.alt, view.settings = facts["caption"], facts["alt"], facts["parameters"]
        width, height = facts["size"]
        view.size = (width, height)
        view.file = f"figures/{view.stem}.{KINDS[facts['renderer']][PICTURE]}"
        if facts["renderer"] != view.renderer and plate.note:
            view.remark = "Drawn by the vector renderer."

    def put(self, plate: Plate, folder: Path) -> None:
        """Put the file of a plate in its place, if it did not fail."""
        if not plate.failure:
            place(plate.file(PICTURE), folder / self._views[plate.request].file, folder)

    def missing(self) -> Mapping[str, tuple[float, float]]:
        """Return the files that are still to be drawn, with their sizes in millimetres."""
        views = (self._views[plate.request] for plate in self.plates if plate.missing and not plate.failure)
        return {view.file: view.size for view in views}
