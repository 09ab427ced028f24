"""State shared by the blocks of a report while they are composed in order: counts, texts, names, uses."""

from collections.abc import Iterable
from typing import Any, NamedTuple

from atlas.book.appendices import Appendices
from atlas.book.texts import citations
from atlas.trial.ledger import EQUATIONS
from atlas.trial.ledger.equation import slug


class Use(NamedTuple):
    """A place that cites an entry of the ledger: title of its page, HTML file, anchor, and words such as "Figure 3"."""

    page: str
    file: str
    anchor: str
    words: str


class Composer:
    """Composes the views of a report's blocks, and collects their texts, numbers and names in its `document`.

    It is made from an empty `Document` and the recorded results; its fields are

    slug, title      slug and title of the current page
    place            the place that an error names, such as "file, line 3: page 'x', block 2 (figure)"
    figures, tables  how many there are so far
    parameters       the `BodiesAndFields` of the report
    recorded         the `Appendices`, recorded results that its blocks show
    ledger           slug of the page that holds each entry of the ledger, by name
    uses             list of `Use` of each equation, by name
    cited, sentences  names of equations cited and sentences said on the current page
    """

    def __init__(self, document: Any, recorded: Appendices) -> None:
        self.document, self.recorded = document, recorded
        self.place = self.slug = self.title = ""
        self.figures = self.tables = 0
        self.uses, self.ledger, self.parameters = document.uses, document.ledger, document.report.parameters

    def begin(self, slug: str, title: str) -> None:
        """Begin a page with this slug and title; citations and sentences of the page before are forgotten."""
        self.slug, self.title = slug, title
        self.cited: set[str] = set()
        self.sentences: set[str] = set()

    def text(self, markdown: str, *, inline: bool = False) -> int:
        """Add a Markdown text and return its index among the document's texts.

        `inline` says that it is no paragraph.
        """
        return int(self.document.texts.add(markdown, self.place, inline=inline))

    def paragraphs(self, markdown: str) -> int:
        """Add paragraphs in Markdown to the document and return their index among its texts.

        The first citation of an equation on a page becomes an anchor and counts as a use, unless the page holds the
        equation's entry of the ledger.
        """
        anchors = {}
        for name in citations(markdown):
            if name in EQUATIONS and name not in self.cited and self.ledger.get(name) != self.slug:
                self.cited.add(name)
                anchors[name] = f"cite-{self.slug}-{slug(name)}"
                self.use(name, anchors[name], "text")
        return int(self.document.texts.add(markdown, self.place, anchors=anchors))

    def caption(self, markdown: str, anchor: str, words: str) -> int:
        """Add a caption and return its index among the texts; each equation cited in it gets a `Use`.

        `anchor` is that of the figure or table, `words` are its name, such as "Figure 3".
        """
        for name in citations(markdown):
            if name in EQUATIONS:
                self.use(name, anchor, words)
        return self.text(markdown, inline=True)

    def once(self, sentence: str) -> str:
        """Return the sentence if this method was not given it before on this page, else ""."""
        new = sentence not in self.sentences
        self.sentences.add(sentence)
        return sentence if new else ""

    def anchors(self, names: Iterable[str]) -> list[str]:
        """Return the anchors in the PDF of cited names, in order; names of other reports have none and are left out.

        Raises AtlasError for a name that is not defined.
        """
        find, targets = self.document.cite("typst"), self.document.targets
        anchors = (targets[name][1] if name in targets else find(name, self.place).anchor for name in names)
        return [anchor for anchor in anchors if anchor]

    def use(self, name: str, anchor: str, words: str) -> None:
        """Record in `uses` that the item at ``anchor`` of this page, called `words` ("Figure 3"), cites an equation.

        An equal `Use` is recorded once.
        """
        place = Use(self.title, f"{self.slug}.html", anchor, words)
        if place not in self.uses[name]:
            self.uses[name].append(place)

    def uses_of(self, name: str) -> list[Use]:
        """Return the uses of an equation by its name, a list of `Use`, those in related reports first.

        It is the list in `uses`, to which later uses of this report are added.
        """
        uses: list[Use] = self.uses[name]
        answers = self.document.related.ask("uses", name)
        uses[:0] = [use for answer in answers for use in (Use(*words) for words in answer) if use not in uses]
        return uses

    def target(self, name: str, anchor: str, words: str) -> bool:
        """Make an anchor of this page, in `words` such as "Figure 3", the target of citations of a name; return True.

        Return False, and change nothing, if another place is the target of the name already.
        """
        is_first = name not in self.document.targets
        if is_first:
            self.document.targets[name] = (f"{self.slug}.html", anchor, words)
        return is_first

    def anchor(self, kind: str, ident: str | None, word: str, number: int) -> str:
        """Return the anchor "kind-ID" of a figure or table, and make it the target of citations of kind:ID.

        `kind` is "fig" or "tab"; ID is ``ident``, or `number` if that is None; citations read "word number", such as
        "Figure 3". An earlier target of the same name stays.
        """
        name = ident or f"{number}"
        self.target(f"{kind}:{name}", f"{kind}-{name}", f"{word} {number}")
        return f"{kind}-{name}"
