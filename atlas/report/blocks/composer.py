"""What a block may ask of what composes a report: counts, texts, names, uses."""

from collections.abc import Mapping
from typing import Any, Protocol

from atlas.report.appendices import Appendices
from atlas.report.given import BodiesAndFields
from atlas.report.picture import Picture
from atlas.report.trial import Use


class Composer(Protocol):
    """Goes through the blocks of a report in order.

    slug             the page
    figures, tables  how many there are so far
    parameters       the bodies and fields of the report
    recorded         the recorded results that its blocks show
    ledger           the page of each entry of the ledger that the report has
    uses             the places that use each equation
    """

    slug: str
    figures: int
    tables: int
    parameters: BodiesAndFields
    recorded: Appendices
    ledger: Mapping[str, str]
    uses: Mapping[str, list[Use]]

    def text(self, markdown: str, *, inline: bool = False) -> int:
        """Take in a text and return its number."""

    def paragraphs(self, markdown: str) -> int:
        """Take in paragraphs, whose first citations are anchors."""

    def caption(self, markdown: str, anchor: str, words: str) -> int:
        """Take in a caption; what it cites is used by its figure or table."""

    def once(self, sentence: str) -> str:
        """Return a sentence that has not been said on this page, else nothing."""

    def use(self, name: str, anchor: str, words: str) -> None:
        """Note that a place of this page uses an equation."""

    def target(self, name: str, anchor: str, words: str) -> bool:
        """Let a name lead to an anchor of this page; return whether it is the first to do so."""

    def anchor(self, kind: str, given: str | None, word: str, number: int) -> str:
        """Return the anchor of a figure or table, and let citations lead there."""

    def number(self, name: str) -> str:
        """Return the number of an equation."""

    def entry(self, name: str) -> str:
        """Return the page of an equation's entry in the ledger, here or beside this report."""

    def pictures(self, block: Any) -> tuple[Picture, ...]:
        """Return the pictures of a figure block."""

    def hold_errata(self) -> None:
        """Let this page be that of the errata."""

    def list_works(self) -> None:
        """Let citations of works lead to this page. AtlasError where there are none, or another page lists them."""
