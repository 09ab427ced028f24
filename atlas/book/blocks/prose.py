"""Paragraphs, a remark set apart from them, and a notebook as paragraphs."""

from dataclasses import dataclass
from pathlib import PurePath

from atlas.book.blocks.composer import Composer
from atlas.book.schema import StrictStruct
from atlas.errors import AtlasError
from atlas.places import folder

CELL = "```{code-cell} ipython3"
"""How a cell with code begins."""


class Prose(StrictStruct, frozen=True, tag_field="kind", tag="prose"):
    """Paragraphs in Markdown with TeX; ``@(67)`` cites an equation, ``@fig:ID`` a figure, ``@tab:ID`` a table.

    ``@cell:ID-3-6`` is the number in row 3 and column 6 of a table, so that a sentence holds the computed number.
    """

    text: str


class Note(StrictStruct, frozen=True, tag_field="kind", tag="note"):
    """A remark in a frame, with a title.

    `text` is paragraphs in Markdown with TeX, `title` one line of the same.
    """

    text: str
    title: str = "Remark"


class Notebook(StrictStruct, frozen=True, tag_field="kind", tag="notebook"):
    """A notebook of the folder ``reports/`` in MyST Markdown, as paragraphs and code with the output of its cells.

    `file` is the file's name; the output stands in the file as text, and no cell is run.
    """

    file: str


@dataclass(frozen=True)
class ProseView:
    """View of prose: index of its text among the document's texts, and index of its heading there, None without one."""

    text: int
    title: int | None = None


def view_prose(block: Prose, composer: Composer) -> ProseView:
    """Return the `ProseView` of a block's paragraphs, which are added to the texts; it has no title."""
    return ProseView(composer.paragraphs(block.text))


def view_notebook(block: Notebook, composer: Composer) -> ProseView:
    """Return the `ProseView` of a notebook's text, without its YAML head.

    Raises AtlasError if there is no such file.
    """
    path = folder("reports") / PurePath(block.file).name
    if not path.is_file():
        raise AtlasError(f"{block.file}: there is no such notebook in {folder('reports')}.")
    _, _, text = path.read_text(encoding="utf-8").removeprefix("---\n").partition("\n---\n")
    return ProseView(composer.paragraphs(text.replace(CELL, "```python")))


def view_note(block: Note, composer: Composer) -> ProseView:
    """Return the `ProseView` of a note: the indices of its paragraphs and of its title among the texts."""
    return ProseView(title=composer.text(block.title, inline=True), text=composer.paragraphs(block.text))
