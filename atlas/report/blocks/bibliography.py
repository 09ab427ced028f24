"""The list of the works that a report cites."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from atlas.errors import AtlasError
from atlas.report.schema import StrictStruct

if TYPE_CHECKING:
    from atlas.report.compose import Composer


class Bibliography(StrictStruct, frozen=True, tag_field="kind", tag="bibliography"):
    """The works that the report cites, by author and year; once in a report that names a BibTeX file."""


@dataclass(frozen=True)
class BibliographyView:
    """It has no texts of its own: the works are those of the document."""


def view(_block: Bibliography, composer: "Composer") -> BibliographyView:
    """Let citations of works lead to this page."""
    if not composer.report.bibliography:
        raise AtlasError('there is no BibTeX file: name one at the top, bibliography = "references.bib".')
    if composer.document.listed_on:
        raise AtlasError("the works are listed already: a report has one list.")
    composer.document.listed_on = composer.page.slug
    return BibliographyView()
