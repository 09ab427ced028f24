"""A page as a PDF file: Typst sets the drawing that an SVG file holds, without a date, so that the bytes repeat."""

import json
from pathlib import Path
from tempfile import TemporaryDirectory

from atlas.render import svg
from atlas.render.paper import Page

_SHEET = """#set document(title: {title}, date: none)
#set page(width: {width:.2f}pt, height: {height:.2f}pt, margin: 0pt)
#image("page.svg", width: 100%, height: 100%, alt: {alt})
"""


def write(page: Page, path: Path, title: str, description: str) -> None:
    """Write a page into a file; its title and description travel inside."""
    import typst

    with TemporaryDirectory() as folder:
        svg.write(page, Path(folder) / "page.svg", title, description)
        sheet = Path(folder) / "page.typ"
        quoted = {"title": json.dumps(title, ensure_ascii=False), "alt": json.dumps(description, ensure_ascii=False)}
        sheet.write_text(_SHEET.format(width=page.width, height=page.height, **quoted), encoding="utf-8")
        path.write_bytes(typst.compile(str(sheet), root=folder, format="pdf", ignore_system_fonts=True))
