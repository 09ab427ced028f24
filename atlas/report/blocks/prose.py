"""Paragraphs, and a remark set apart from them."""

from dataclasses import dataclass

from atlas.report.blocks.composer import Composer
from atlas.report.schema import StrictStruct


class Prose(StrictStruct, frozen=True, tag_field="kind", tag="prose"):
    """Paragraphs in Markdown with TeX; ``@(67)`` cites an equation, ``@fig:ID`` a figure, ``@tab:ID`` a table.

    ``@cell:ID-3-6`` is the number in row 3 and column 6 of a table, so that what a sentence says is what was computed.
    """

    text: str


class Note(StrictStruct, frozen=True, tag_field="kind", tag="note"):
    """A remark set apart from the text."""

    text: str
    title: str = "Remark"


@dataclass(frozen=True)
class ProseView:
    """The number of its text."""

    text: int


@dataclass(frozen=True)
class NoteView:
    """The numbers of its heading and its text."""

    title: int
    text: int


def view_prose(block: Prose, composer: Composer) -> ProseView:
    """Take in the text."""
    return ProseView(composer.paragraphs(block.text))


def view_note(block: Note, composer: Composer) -> NoteView:
    """Take in the heading and the text."""
    return NoteView(composer.text(block.title, inline=True), composer.paragraphs(block.text))
