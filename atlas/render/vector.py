"""A scene on paper: one page for SVG, PDF and PNG, its panels row by row."""

from collections.abc import Callable, Mapping
from pathlib import Path

from atlas.render.frame import title_room
from atlas.render.house import POINTS_PER_MM, house_style
from atlas.render.paper import Page, Sheet
from atlas.render.plane import Drawing
from atlas.render.space import draw_space
from atlas.scene.layers import Panel, Plane, Scene

FORMATS = ("svg", "pdf", "png")
DPI = 300.0

_EDGE, _BETWEEN = 2.88, 0.015
_ROUNDS = 3


def save(scene: Scene, files: Mapping[Path, str], *, dpi: float = DPI, paint: Callable[..., None] = draw_space) -> None:
    """Draw a scene once into files, each of its kind; ``paint`` draws the panels in space."""
    page = compose(scene, dpi=dpi, paint=paint)
    for path, kind in files.items():
        if kind == "svg":
            from atlas.render import svg

            svg.write(page, path, scene.title, scene.alt)
        elif kind == "pdf":
            from atlas.render import pdf

            pdf.write(page, path, scene.title, scene.alt)
        else:
            from atlas.render import canvas

            canvas.write(page, path, scene.title)


def compose(scene: Scene, *, dpi: float = DPI, paint: Callable[..., None] = draw_space) -> Page:
    """Return the page with its panels."""
    page = blank(scene, dpi)
    with house_style():
        for panel, drawing, sheet in panels(scene, page):
            if drawing is None:
                paint(sheet, panel)
            else:
                drawing.draw(sheet)
    return page


def blank(scene: Scene, dpi: float = DPI) -> Page:
    """Return an empty page of the size of a scene."""
    width, height = (length * POINTS_PER_MM for length in scene.size)
    return Page(width, height, dpi)


def panels(scene: Scene, page: Page) -> list[tuple[Panel, Drawing | None, Sheet]]:
    """Return the panels, the drawings of those with two axes, and the place of each on the page."""
    drawings = [Drawing(panel) if isinstance(panel, Plane) else None for panel in scene.panels]
    heads = [title_room(panel.title) for panel in scene.panels]
    return list(zip(scene.panels, drawings, sheets(page, drawings, heads, scene.columns), strict=True))


def sheets(page: Page, drawings: list[Drawing | None], heads: list[float], columns: int) -> list[Sheet]:
    """Return the place of each panel: all inner rectangles equally large, with room for the words around them.

    The room depends on the numbers at the ticks, and these on the size; so it is found in rounds. A panel in space has
    its title alone around it, and ``heads`` says how far titles reach.
    """
    rows = -(-len(drawings) // columns)
    flat = any(drawings)
    edges = (_edges(page.width, columns, flat=flat), _edges(page.height, rows, flat=flat))
    width, height = page.width / columns, page.height / rows
    for _ in range(_ROUNDS):
        rooms = [
            drawing.margins(width, height) if drawing else (0.0, 0.0, 0.0, head)
            for drawing, head in zip(drawings, heads, strict=True)
        ]
        left = [edges[0][0][c] + max(room[0] for room in rooms[c::columns]) for c in range(columns)]
        right = [edges[0][1][c] + max(room[2] for room in rooms[c::columns]) for c in range(columns)]
        lines = [rooms[r * columns : (r + 1) * columns] for r in range(rows)]
        below = [edges[1][1][r] + max(room[1] for room in lines[r]) for r in range(rows)]
        above = [edges[1][0][r] + max(room[3] for room in lines[r]) for r in range(rows)]
        width = max((page.width - sum(left) - sum(right)) / columns, 1.0)
        height = max((page.height - sum(below) - sum(above)) / rows, 1.0)
    found = []
    for index in range(len(drawings)):
        row, column = divmod(index, columns)
        x = sum(left[: column + 1]) + sum(right[:column]) + column * width
        y = page.height - sum(above[: row + 1]) - sum(below[:row]) - (row + 1) * height
        found.append(Sheet(page, (x, y), (width, height)))
    return found


def _edges(length: float, count: int, *, flat: bool) -> tuple[list[float], list[float]]:
    """Return the air before and after each of ``count`` panels side by side; a page of pictures in space needs none."""
    if not flat:
        return [0.0] * count, [0.0] * count
    between = max(_EDGE, _BETWEEN * length / count)
    return [_EDGE] + [between] * (count - 1), [between] * (count - 1) + [_EDGE]
