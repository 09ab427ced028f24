"""The list of the works that a report cites."""

from dataclasses import dataclass

from atlas.report.blocks.composer import Composer
from atlas.report.schema import StrictStruct


class Bibliography(StrictStruct, frozen=True, tag_field="kind", tag="bibliography"):
    """The works that the report cites, by author and year; once in a report that names a BibTeX file."""


@dataclass(frozen=True)
class BibliographyView:
    """It has no texts of its own: the works are those of the document."""


def view(_block: Bibliography, composer: Composer) -> BibliographyView:
    """Let citations of works lead to this page."""
    composer.list_works()
    return BibliographyView()
