"""The texts of a report: collected while its blocks are gone through, checked, and set together.

A text is Markdown with TeX between dollars. Its links lead to http, https, mailto, doi or a page of the report, it
holds no pictures, and a citation such as ``@(67)`` becomes a link.
"""

import hashlib
import json
import re
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any, NamedTuple, TypeAlias

from atlas.book import pandoc
from atlas.book.pandoc import FormulaError, Target, Tree, mend_all, with_leading
from atlas.errors import AtlasError
from atlas.trial.ledger.plain import words as plain_words

_CITED = re.compile(
    r"\$\$.+?\$\$|(?<![\\$])\$[^$]+?\$|`[^`]*`|(?<![\w\\])@(\([\w.-]+\)|[a-z]+:[\w-]+|\w+(?:[.-]\w+)*)", re.DOTALL
)
"""A citation, in the first group; formulas and code, in which there is none, are passed over."""
MAX_DEPTH = 10
"""How deeply parts of a text may be nested."""
_OUTSIDE = re.compile(r"(?:https?|mailto|doi):[!-~]+")
_INSIDE = re.compile(r"(?:\w[\w.+-]*/)?\w[\w.+-]*\.html(?:#[\w.-]+)?|#[\w.-]+")
_CHAIN = re.compile(r" / [^\s()]*(\((?:[^()]|\([^()]*\))*\))?[^\s()]* / ")
"""How pandoc writes a fraction below a fraction in Typst, which then reads it from left to right."""
_COUNTED = {"Section", "Sections", "Part", "Volume", "Figure", "Table"}
_COUNT = re.compile(r"\d|[IVX]+\b")
"""Words for kinds of numbered items, and the beginnings of the names of these items."""
_UNIT = re.compile(r"(?:s|m|T|V|J|C|K|W|kg|mm|rad|[kM]?Hz|degrees|V/m|C/kg)\b[.,;:)]*")
_ATTRIBUTES = {"Code": 0, "CodeBlock": 0, "Header": 1, "Table": 0}
"""Where in a node of a tree its attributes are."""


_APOSTROPHE = re.compile(r"(?<=[a-z])'")
"""In a title a straight apostrophe behind a small letter; behind a capital it is a prime, as in B'."""
_FORMULA = re.compile(r"((?<!\\)\$(?=\S)[^$]+(?<=\S)\$(?!\d))")
"""A formula of a title, as pandoc finds it."""


class Link(NamedTuple):
    """A citation resolved: words to show, the page ("" in the PDF) and the anchor that they lead to.

    `says` is a summary of the target, shown on hovering, or ""; `bracketed` are the words in brackets if a work is
    cited, else "".
    """

    words: str
    page: str = ""
    anchor: str = ""
    says: str = ""
    bracketed: str = ""


Cite: TypeAlias = Callable[[str, str], Link]
"""A function (name, place) that returns the link of a citation, or raises AtlasError, which begins with the place."""


@dataclass(frozen=True)
class Text:
    """A piece of Markdown, its place in the report for messages (`place`), and whether it is no whole paragraph.

    `anchors` are the ids to give to the first citations of some names.
    """

    markdown: str
    place: str
    inline: bool
    anchors: Mapping[str, str]


@dataclass
class Texts:
    """The texts of one report, typeset together; `texts` are those added so far.

    `memory` holds results of earlier builds by text and target: the links of the text's citations by name, and the text
    typeset. `used` holds those that this build took or made.
    """

    texts: list[Text] = field(default_factory=list)
    memory: dict[str, Any] = field(default_factory=dict)
    used: dict[str, Any] = field(default_factory=dict)

    def add(self, markdown: str, place: str, *, inline: bool = False, anchors: Mapping[str, str] | None = None) -> int:
        """Add a Markdown text and return its index among the texts.

        `place` is named by error messages; `inline` says that the text is no paragraph; `anchors` are ids for the first
        citations of some names.
        """
        self.texts.append(Text(markdown, place, inline, anchors or {}))
        return len(self.texts) - 1

    def __getitem__(self, number: int) -> Text:
        """Return the `Text` at this index."""
        return self.texts[number]

    def set(self, cites: Mapping[Target, Cite]) -> dict[Target, list[str]]:
        """Return all texts typeset for each target, in order.

        `cites` has for each target the function (name, place) that returns the link of a citation. A text whose links
        are as in `memory` is taken from there. Raises AtlasError, with the place, for an unreadable formula, a link
        that is not allowed, a picture, and a text nested too deeply.
        """
        keys = {
            target: [
                json.dumps([pandoc.release(), target, text.markdown, text.inline, text.anchors]) for text in self.texts
            ]
            for target in cites
        }
        for target, cite in cites.items():
            for key, text in zip(keys[target], self.texts, strict=True):
                links, _ = self.memory.get(key, (None, ""))
                if links is not None and all([*cite(name, text.place)] == [*link] for name, link in links.items()):
                    self.used[key] = self.memory[key]
        new: dict[Target, dict[str, Text]] = {target: {} for target in cites}
        for target in cites:
            for key, text in zip(keys[target], self.texts, strict=True):
                if key not in self.used:
                    new[target].setdefault(key, text)
        trees = _read([text for texts in new.values() for text in texts.values()])
        with ThreadPoolExecutor(len(cites)) as threads:
            for typeset_texts in threads.map(lambda target: _typeset(new[target], target, cites[target], trees), cites):
                self.used |= typeset_texts
        return {target: [self.used[key][1] for key in keys[target]] for target in cites}


def _read(texts: Sequence[Text]) -> dict[tuple[str, bool], Tree]:
    """Return pandoc's trees of texts by (Markdown, inline). Raises AtlasError for a text nested too deeply.

    The time that pandoc takes for such a text doubles with each level.
    """
    for text in texts:
        if deepest(text.markdown) > MAX_DEPTH:
            raise AtlasError(f"{text.place}: brackets, braces or quotations are nested more than {MAX_DEPTH} deep.")
    sources = dict.fromkeys((text.markdown, text.inline) for text in texts)
    trees = pandoc.read([(_braced(markdown), inline) for markdown, inline in sources]) if sources else []
    return dict(zip(sources, trees, strict=True))


def _typeset(
    texts: Mapping[str, Text], target: Target, cite: Cite, trees: Mapping[tuple[str, bool], Tree]
) -> dict[str, Any]:
    """Return for each key the links of a text's citations, by name, and the text typeset from its tree."""
    links: dict[str, dict[str, Link]] = {key: {} for key in texts}

    def checked(key: str, text: Text) -> Tree:
        def noted(name: str, place: str) -> Link:
            return links[key].setdefault(name, cite(name, place))

        tree = _Checked(text, target, noted).tree(trees[text.markdown, text.inline])
        return with_leading(tree) if target == "typst" and not text.inline else tree

    nodes = {key: checked(key, text) for key, text in texts.items()}
    try:
        pieces = pandoc.write([(nodes[key], text.inline) for key, text in texts.items()], target) if texts else []
    except FormulaError as error:
        key = next(key for key in texts if json.dumps(error.tex) in json.dumps(nodes[key]))
        raise AtlasError(f"{texts[key].place}: {error}") from error
    return {
        key: [links[key], _finished(piece, target, text)]
        for (key, text), piece in zip(texts.items(), pieces, strict=True)
    }


def deepest(markdown: str) -> int:
    """Return the greatest depth to which brackets, braces, quotations or list items are nested, also in code.

    Brackets are counted by paragraph, closed or not; an escaped one does not count.
    """
    max_depth = 0
    for paragraph in re.split(r"\n\s*\n", re.sub(r"\\[\\\[\]{}]", "", markdown)):
        for start, end in ("[]", "{}"):
            depth = 0
            for mark in re.findall(rf"[\{start}\{end}]", paragraph):
                depth = depth + 1 if mark == start else max(0, depth - 1)
                max_depth = max(max_depth, depth)
    for quoted in re.findall(r"^[ >]*>", markdown, re.MULTILINE):
        max_depth = max(max_depth, quoted.count(">"))
    for indent in re.findall(r"^[ \t]+(?=[-*+\d])", markdown, re.MULTILINE):
        max_depth = max(max_depth, len(indent.expandtabs(4)) // 4)
    return max_depth


def title(text: str) -> str:
    """Return a title as Markdown: formulas between dollars are kept, everything else is escaped as plain words."""
    words, formulas = r"([!-/:-@\[-`{-~])", _FORMULA.split(_APOSTROPHE.sub("’", text))
    return "".join(piece if k % 2 else re.sub(words, r"\\\1", piece) for k, piece in enumerate(formulas))


def title_words(text: str) -> str:
    """Return a title in plain words, formulas too, for bookmarks and navigation."""
    return _FORMULA.sub(lambda formula: plain_words(formula[1]), _APOSTROPHE.sub("’", text))


def citations(markdown: str) -> list[str]:
    """Return the names that a text cites, in order and as often, except in code and formulas; "(72)" for ``@(72)``."""
    return [name for name in _CITED.findall(markdown) if name]


def _braced(markdown: str) -> str:
    """Return Markdown in which ``@(72)`` is written as pandoc reads citations, ``@{(72)}``.

    Other names stay as they are.
    """
    return _CITED.sub(
        lambda matched: f"@{{{matched[1]}}}" if (matched[1] or "").startswith("(") else matched[0], markdown
    )


class _Checked:
    """Checker of a text's tree for a target: only text and formulas reach a page; citations are resolved by `cite`."""

    def __init__(self, text: Text, target: Target, cite: Cite) -> None:
        self.text, self.target, self.cite = text, target, cite
        self.anchors = dict(text.anchors)

    def tree(self, nodes: Tree) -> Tree:
        """Return pandoc's nodes checked and replaced by `node`, nested lists included.

        Spaces before units don't break lines.
        """
        problem: Tree = []
        for node in nodes:
            if isinstance(node, list):
                problem.append(self.tree(node))
            elif isinstance(node, dict) and "t" in node:
                problem += self.node(node["t"], node.get("c"))
            else:
                problem.append(node)
        return _tied(problem) if all(isinstance(node, dict) for node in problem) else problem

    def node(self, kind: str, content: Any) -> Tree:
        """Return the list of nodes that replaces a node of pandoc, given its type `kind` and its content or None.

        Raises AtlasError for pictures and raw text, and for links and citations that are not allowed.
        """
        if kind in {"Image", "RawInline", "RawBlock"}:
            raise AtlasError(f"{self.text.place}: a text holds no pictures; make a figure block of it.")
        if kind == "Cite":
            return self.citation(content[0])
        if kind == "Math":
            formula = {"t": kind, "c": [content[0], _tex(content[1], self.target)]}
            if self.target != "typst":
                return [formula]
            mark = {"t": "RawInline", "c": [self.target, _mark(self.text)]}
            joiner = [{"t": "Str", "c": "\u2060"}] if content[1].lstrip().startswith("^") else []  # s$^{-1}$
            return [*joiner, mark, formula, mark]
        if kind == "Link":
            return [_link(self.tree(content[1]), self.address(content[2][0]))]
        if kind in _ATTRIBUTES:
            content = [["", [], []] if place == _ATTRIBUTES[kind] else piece for place, piece in enumerate(content)]
        if kind == "Header":
            content[0] = max(content[0], 2)  # the first level is that of the page
        if content is None:
            return [{"t": kind}]
        return [{"t": kind, "c": self.tree(content) if isinstance(content, list) else content}]

    def citation(self, pieces: Any) -> Tree:
        """Return the nodes of a citation's links, in brackets with the surrounding words if written so.

        `pieces` are pandoc's citations, dicts. Works for Typst and LaTeX stay a citation. Raises AtlasError for an
        unknown name.
        """
        links = [self.cite(work["citationId"], self.text.place) for work in pieces]
        works = self.are_works(pieces, links)
        if works and self.target != "html":  # Typst and BibTeX set their own bibliography
            return [{"t": "Cite", "c": [[work | self.around(work) for work in pieces], []]}]
        bracketed = pieces[0]["citationMode"]["t"] == "NormalCitation"
        nodes: Tree = []
        for work, link in zip(pieces, links, strict=True):
            prefix, suffix = self.around(work).values()
            space = [{"t": "Space"}] if prefix else []
            nodes += [*(_words("; ") if nodes else ()), *prefix, *space, *self.cited(work, link, bracketed), *suffix]
        start, end = "()" if works else "[]"
        return [*_words(start), *nodes, *_words(end)] if bracketed else nodes

    def are_works(self, citations: Any, links: Sequence[Link]) -> bool:
        """Return whether pandoc's citations are of works, not of equations.

        Raises AtlasError for a mixture, and for words before a work in brackets. `links` are those of the
        citations, in the same order.
        """
        works = {bool(link.bracketed) for link in links}
        if len(works) > 1:
            raise AtlasError(f"{self.text.place}: works and equations are cited in brackets of their own.")
        if works == {True} and any(work["citationPrefix"] for work in citations):
            raise AtlasError(f"{self.text.place}: words before a work in brackets are lost in print; put them outside.")
        return works == {True}

    def cited(self, work: Any, link: Link, bracketed: bool) -> Tree:
        r"""Return the nodes of one citation's link; the first one of a name in `anchors` gets its id, except in LaTeX.

        `work` is pandoc's citation, a dict; `bracketed` says that it stands in brackets: then a work is shown by the
        link's `bracketed`, anything else by `words`. In LaTeX the names "fig:..." and "tab:..." become
        Figure~\ref{anchor} and Table~\ref{anchor}, "cell:KEY" becomes \atlascell{KEY}{words}, others are words.
        """
        name = work["citationId"]
        words = self.tree(_words(link.bracketed if bracketed and link.bracketed else link.words))
        if self.target == "latex":  # figures and tables are numbered by the paper that they stand in
            if name.startswith("cell:"):  # a number of a table is written by its key
                return [{"t": "RawInline", "c": ["latex", rf"\atlascell{{{name[5:]}}}{{{link.words}}}"]}]
            counted = f"{link.words.partition(' ')[0]}~\\ref{{{link.anchor}}}"
            return [{"t": "RawInline", "c": ["latex", counted]}] if name.startswith(("fig:", "tab:")) else words
        says = link.says if self.target == "html" else ""
        node = [_link(words, f"{link.page}#{link.anchor}", says)] if link.anchor else words
        anchor = self.anchors.pop(name, None)
        return [{"t": "Span", "c": [[anchor, [], []], node]}] if anchor is not None else node

    def around(self, work: Any) -> dict[str, Tree]:
        """Return {"citationPrefix": nodes, "citationSuffix": nodes}: words before and after a citation in brackets.

        `work` is pandoc's citation, a dict.
        """
        return {key: self.tree(work[key]) for key in ("citationPrefix", "citationSuffix")}

    def address(self, url: str) -> str:
        """Return the URL of a link, "doi:" expanded.

        Raises AtlasError unless it is outside or a page beside this one.
        """
        if _OUTSIDE.fullmatch(url):
            return url.replace("doi:", "https://doi.org/", 1) if url.startswith("doi:") else url
        if not _INSIDE.fullmatch(url):
            raise AtlasError(
                f"{self.text.place}: a link to {url[:60]!r} is not allowed; it leads to http:, https:, mailto:, doi: "
                "or to a page beside it, such as index.html."
            )
        return url


def _tied(nodes: Tree) -> Tree:
    """Return pandoc's inlines with unbreakable spaces before units, and between "Section" and its number."""
    before, tied = "", list[Any]()
    for node, after in zip(nodes, [*nodes[1:], {}], strict=False):
        counted = before in _COUNTED and _COUNT.match(_element_text(after))
        measured = before[-1:].isdigit() and _UNIT.fullmatch(_element_text(after))
        ties = node == {"t": "Space"} and (counted or measured)
        tied.append({"t": "Str", "c": "\u00a0"} if ties else node)
        before = before if node.get("t") == "RawInline" else _element_text(node)
    return tied


def _element_text(node: Any) -> str:
    """Return the text of a word, the TeX of a formula, or the last word of a link; "" for any other node of pandoc."""
    content = node.get("c")
    match node.get("t"):
        case "Str":
            return str(content)
        case "Math":
            return str(content[1])
        case "Link":
            return _element_text(content[1][-1]) if content[1] else ""
    return ""


def _words(text: str) -> Tree:
    """Return words as pandoc's nodes: $formulas$ as mathematics, ^text^ raised, "Figure 3" without a line break."""
    text = re.sub(r"^(Figure|Table) (?=\d)", "\\1\u00a0", text)
    nodes: Tree = []
    for k, piece in enumerate(_FORMULA.split(text)):
        if k % 2:
            nodes.append({"t": "Math", "c": [{"t": "InlineMath"}, piece[1:-1]]})
            continue
        low, *raised = re.split(r"\^([^^\s]+)\^", piece)
        nodes.append({"t": "Str", "c": low})
        for up, after in zip(raised[::2], raised[1::2], strict=True):
            nodes += [{"t": "Superscript", "c": [{"t": "Str", "c": up}]}, {"t": "Str", "c": after}]
    return nodes


def _link(words: Tree, url: str, title: str = "") -> dict[str, Any]:
    """Return pandoc's node, a dict, of a link: its words as nodes, its URL, and a title shown on hovering."""
    return {"t": "Link", "c": [["", [], []], words, [url, title]]}


def _tex(tex: str, target: Target) -> str:
    r"""Return TeX in a form that pandoc writes correctly.

    Words in ``\mathrm``, which it would space out, become ``\text``; for Typst \tfrac and \dfrac, which it would
    lose in a fraction, become \frac.
    """
    tex = re.sub(r"\\mathrm\{([A-Za-z]{2,})\}", r"\\text{\1}", tex)
    return re.sub(r"\\[td]frac\b", r"\\frac", tex) if target == "typst" else tex


def _mark(text: Text) -> str:
    """Return a Typst comment with the digest of a text, to stand before and after each of its formulas."""
    return f"/*{hashlib.sha256(text.markdown.encode(errors='surrogatepass')).hexdigest()}*/"


def _finished(piece: str, target: Target, text: Text) -> str:
    """Return a text written by pandoc with corrected formulas; LaTeX is unchanged.

    `target` is "html", "typst" or "latex". In Typst the formulas are the parts between the marks of `_mark`; a space is
    added behind a backslash at the end.
    """
    if target != "typst":
        return mend_all(piece) if target == "html" else piece
    pieces = piece.split(_mark(text))
    pieces[1::2] = [_mended(formula, text) for formula in pieces[1::2]]
    piece = "".join(pieces)
    return f"{piece} " if piece.endswith("\\") else piece  # else the bracket after it would be escaped


def _mended(formula: str, text: Text) -> str:
    r"""Return a Typst formula with the widths of ``\;`` and ``\!``, which pandoc rounds to ems, and with norm bars.

    A formula marked by ``\boxed`` gets its colour. Raises AtlasError for a fraction below a fraction.
    """
    if _CHAIN.search(formula):
        raise AtlasError(f"{text.place}: a fraction below a fraction is lost in print; write it with a slash.")
    formula = re.sub(r"#box\(stroke: black, inset: 3pt, \[\$ (.+?) \$\]\)", r"#changed[$\1$]", formula)
    formula = formula.replace("#h(0em)", "#h(0.278em)").replace("#h(-1em)", "#h(-0.167em)")
    return re.sub(r"\\\| ?(.+?) ?\\\|", r"lr(| \1 |)", formula)
