"""Reference pages: the works that are cited, and public names of the package with their docstrings."""

import re
from dataclasses import dataclass
from textwrap import indent

from atlas.book.appendices import Described
from atlas.book.blocks.composer import Composer
from atlas.book.schema import StrictStruct
from atlas.errors import AtlasError, unknown


class Bibliography(StrictStruct, frozen=True, tag_field="kind", tag="bibliography"):
    """The works that the report cites, by author and year; once in a report that names a BibTeX file.

    The block has no fields.
    """


def view_bibliography(block: Bibliography, composer: Composer) -> Bibliography:
    """Return the block itself as its view, and make the current page the target of citations of works.

    Raises AtlasError if the report names no BibTeX file, and for a second list.
    """
    document = composer.document
    if not document.report.bibliography:
        raise AtlasError('there is no BibTeX file: name one at the top, bibliography = "references.bib".')
    if document.listed_on:
        raise AtlasError("the works are listed already: a report has one list.")
    document.listed_on = composer.slug
    return block


_CODE = re.compile(r"(`+)(.+?)\1", re.DOTALL)
_SIGN = re.compile(r"((?!(?<=[a-z])'s\b|(?<=s)' )[!-/:-@\[-_{-~])")
"""Signs that would be markup, and primes; the apostrophe of a genitive is left to become typographic."""
_SECTION = re.compile(r"^(\w[\w ]*)\n-{3,}\n", re.MULTILINE)
_ENTRY = re.compile(r"^(\S.*)((?:\n(?: .*)?)*)", re.MULTILINE)
_TABLES = frozenset({"Parameters", "Attributes", "Returns", "Raises", "Warns"})
"""Sections of a docstring that list names or types, with their meanings indented below."""


class Reference(StrictStruct, frozen=True, tag_field="kind", tag="reference"):
    """Public names of the package, such as "Quadric", in the order of the reference.

    The block shows the docstring of each, and of the members of classes.
    """

    names: tuple[str, ...]


@dataclass(frozen=True)
class DescribedView:
    """A public name of the package as a page shows it, with its arguments as text, such as "(a, b=1)".

    `text` is the index of its docstring among the document's texts, `members` are the views of its members.
    """

    name: str
    arguments: str
    text: int
    members: tuple["DescribedView", ...] = ()


@dataclass(frozen=True)
class ReferenceView:
    """View of the reference: a `DescribedView` for each public name that a block lists."""

    entries: tuple[DescribedView, ...]


def view_reference(block: Reference, composer: Composer) -> ReferenceView:
    """Return the `ReferenceView` of the names that a block lists. Raises AtlasError for a name that `atlas` lacks."""
    records = composer.recorded.reference

    def described(name: str, member: Described) -> DescribedView:
        members = tuple(described(inner, item) for inner, item in member.members.items())
        return DescribedView(name, member.arguments, composer.text(markdown_of_sections(member.docstring)), members)

    for name in block.names:
        if name not in records:
            raise unknown("public name", name, records, "in atlas")
    return ReferenceView(tuple(described(name, records[name]) for name in block.names))


def outline(_block: Reference, _composer: Composer) -> None:
    """Do nothing: no citation leads to the names of a reference, so an outline needs none of them."""


def markdown_of_sections(docstring: str) -> str:
    """Return a numpydoc docstring as Markdown: parameters, attributes, results, errors and warnings each in a table.

    Other sections keep their text below a bold heading.
    """
    summary, *sections = _SECTION.split(docstring)
    pieces = [markdown(summary.strip())]
    for title, body in zip(sections[::2], sections[1::2], strict=True):
        if title in _TABLES:
            pieces.append(_table(title, body))
        else:
            pieces += [f"**{title}**", markdown(body.strip())]
    return "\n\n".join(pieces)


def _table(title: str, body: str) -> str:
    """Return the entries `name : type` or `type` of a section's `body`, with meanings, as a Markdown table.

    `title` is the head of the first column.
    """
    rows = [f"| {title} | Meaning |", "|:----|:--------|"]
    for entry, meaning in _ENTRY.findall(body.strip()):
        name, _, kind = entry.partition(" : ")
        rows.append(f"| `{name}` {markdown(kind)} | {markdown(' '.join(meaning.split()))} |")
    return "\n".join(rows)


def markdown(docstring: str) -> str:
    """Return text as Markdown: examples, indented paragraphs and names in backticks as code, other markup escaped."""
    paragraphs = []
    for paragraph in docstring.split("\n\n"):
        if all(line.startswith("    ") for line in paragraph.splitlines()):
            paragraphs.append(paragraph)
            continue
        if paragraph.startswith(">>> "):
            paragraphs.append(indent(paragraph, "    "))
            continue
        pieces = _CODE.split(paragraph)  # text, backticks, code, text, ...
        words = "".join(
            f"`{piece}`" if place % 3 == 2 else _SIGN.sub(r"\\\1", piece)
            for place, piece in enumerate(pieces)
            if place % 3 != 1
        )
        paragraphs.append(re.sub(r"^\\- ", "- ", words, flags=re.MULTILINE))
    return "\n\n".join(paragraphs)
