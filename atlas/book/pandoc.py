"""pandoc: Markdown with TeX to its tree, and trees to HTML with MathML, Typst or LaTeX; one run for many texts.

Texts are a subset of Markdown in which nothing is passed through: HTML, TeX outside formulas, attributes
and metadata are text like any other. A formula that pandoc can't read is left as TeX with a warning: here that is an
error which names the formula.
"""

import hashlib
import json
import re
import subprocess
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Literal, TypeAlias
from xml.etree import ElementTree as ET

from atlas import libraries, programs
from atlas.errors import AtlasError

Target: TypeAlias = Literal["html", "typst", "latex"]
Tree: TypeAlias = list[Any]
"""Inlines or blocks as pandoc writes them in JSON."""

MARKDOWN = (
    "markdown_strict-raw_html+smart+citations+tex_math_dollars+superscript+subscript+strikeout+pipe_tables+fancy_lists"
    "+startnum+backtick_code_blocks+all_symbols_escapable+intraword_underscores+escaped_line_breaks"
    "+blank_before_header+space_in_atx_header+blank_before_blockquote+shortcut_reference_links"
)
_WRITE = {
    "html": ["-t", "html5", "--mathml", "--syntax-highlighting=none"],
    "typst": ["-t", "typst"],
    "latex": ["-t", "latex", "--natbib"],
}
_MARK = {"html": "<!--{}-->", "typst": "//{}", "latex": "%{}"}
SECONDS, SPEED, MEMORY = 8, 50_000, "1000m"
"""Limits of pandoc: seconds of a processor, characters per further second, and memory. A book takes a third."""
_HEAP = 251
"""Exit status of a program in Haskell that would need more memory."""
_ENDLESS = "pandoc can't set the texts of the report with {}: brackets, braces or macros are nested too deeply."
FORMULA_LETTERS, LETTERS_FROM_MISTAKE = 90, 20
"""Characters of a formula that a message shows, and of its part from the mistake on."""


class FormulaError(AtlasError):
    """A formula that can't be read, and the reason, as one sentence; the field `tex` is the formula."""

    def __init__(self, tex: str, reason: str) -> None:
        formula = " ".join(f"${tex.strip()}$".split())
        formula = formula if len(formula) <= FORMULA_LETTERS else f"{formula[: FORMULA_LETTERS - 1]}…"
        super().__init__(f"the formula {formula} can't be read: {reason}.")
        self.tex = tex


def release() -> str:
    """Return the version of pandoc and its options as text: with the texts these determine the output."""
    return json.dumps([libraries.release("pypandoc_binary"), MARKDOWN, _WRITE])


def read(texts: Sequence[tuple[str, bool]]) -> list[Tree]:
    """Return the trees of some texts (Markdown, inline): a list of inlines for an inline text, else of blocks.

    Each text is read as a string of a YAML header, so that none can reach into another; a text that ends a line is
    read as blocks. Raises AtlasError where pandoc warns, fails, or needs too much time or memory.
    """
    sources = [" ".join(markdown.split()) if inline else f"{markdown.strip()}\n" for markdown, inline in texts]
    header = f"---\n{json.dumps({'texts': sources}, ensure_ascii=True)}\n---\n"
    tree = json.loads(run(["-f", f"{MARKDOWN}+yaml_metadata_block", "-t", "json"], header))
    return [value["c"] for value in tree["meta"]["texts"]["c"]]


def write(trees: Sequence[tuple[Tree, bool]], target: Target) -> list[str]:
    """Return trees (tree, inline) as HTML, Typst or LaTeX, a text for each.

    `target` is "html", "typst" or "latex". Raises FormulaError for a formula that can't be read, AtlasError where
    pandoc fails otherwise, or needs too much time or memory.
    """
    mark = _MARK[target].format(hashlib.sha256(json.dumps(trees).encode()).hexdigest())
    blocks: list[Any] = []
    for tree, inline in trees:
        blocks += [{"t": "RawBlock", "c": [target, mark]}, *([{"t": "Plain", "c": tree}] if inline else tree)]
    output = run(["-f", "json", *_WRITE[target], "--wrap=none"], document(blocks))
    return [piece.strip() for piece in output.split(mark)[1:]]


def document(blocks: Tree) -> str:
    """Return pandoc's JSON, as text, of a document of these blocks."""
    return json.dumps({"pandoc-api-version": api(), "meta": {}, "blocks": blocks})


@cache
def api() -> list[int]:
    """Return the version of pandoc's document trees, a list of integers."""
    version: list[int] = json.loads(run(["-f", "markdown", "-t", "json"], ""))["pandoc-api-version"]
    return version


def run(arguments: Sequence[str], source: str) -> str:
    """Return pandoc's standard output for the text `source`; `arguments` are options of its command.

    Raises FormulaError for an unreadable formula, and AtlasError for any other warning, where pandoc fails or is
    missing, and for too much time or memory.
    """
    with TemporaryDirectory() as folder:
        log = Path(folder) / "log.json"
        command = [_program(), "+RTS", f"-M{MEMORY}", "-RTS", *arguments, f"--log={log}"]
        try:
            run = programs.run(command, SECONDS + len(source) // SPEED, source)
        except subprocess.TimeoutExpired as error:
            raise AtlasError(_ENDLESS.format(f"{SECONDS} seconds")) from error
        if run.returncode == _HEAP:
            raise AtlasError(_ENDLESS.format(f"{MEMORY[:-1]} MB"))
        if run.returncode:
            reason = next(iter(run.stderr.strip().splitlines()), f"it ended with status {run.returncode}")
            raise AtlasError(f"pandoc could not set the text of the report: {reason.removesuffix('.')}.")
        warnings = [entry for entry in json.loads(log.read_text("utf-8")) if entry.get("verbosity") == "WARNING"]
    for warning in warnings:
        if warning["type"] == "CouldNotConvertTeXMath":
            raise FormulaError(warning["contents"], _reason(warning["message"]))
        raise AtlasError(f"pandoc warns of {warning['type']}: {json.dumps(warning, ensure_ascii=False)}.")
    return run.stdout


@cache
def _program() -> str:
    """Return the path of pandoc in its package. Raises AtlasError if it is missing."""
    program = libraries.package_file("pypandoc", "files/pandoc*")
    if program is None:
        raise AtlasError("the package pypandoc_binary with its pandoc is not there: install the locked dependencies.")
    return str(program)


def _reason(message: str) -> str:
    """Return the reason why pandoc refused a formula, as a clause.

    It is "it breaks off", "unexpected X at Y" with the first letters of both, or "it is no TeX".
    """
    matched = re.search(r"^(.*)\n( *)\^\nunexpected (.+)$", message, re.MULTILINE)
    if matched is None:
        return "it is no TeX"
    if matched[3].startswith("eof"):
        return "it breaks off"
    tail = "" if matched[3].startswith("control") else matched[1][len(matched[2]) :]
    return f"unexpected {matched[3][:FORMULA_LETTERS]}" + (f" at {tail[:LETTERS_FROM_MISTAKE]}" if tail else "")


PARAGRAPHS = {"Para", "Plain"}


def with_leading(blocks: list[Any]) -> list[Any]:
    """Return pandoc's blocks of a text with Typst's `leading` about each paragraph that ends with a colon.

    Its argument says whether a paragraph precedes, so that this one is indented.
    """
    leading: list[Any] = []
    for before, block in zip([None, *blocks], blocks, strict=False):
        if leads(block):
            indented = before is not None and before["t"] in PARAGRAPHS
            leading += [_raw(f"#leading({str(indented).lower()})["), block, _raw("]")]
        else:
            leading.append(block)
    return leading


def leads(block: Any) -> bool:
    """Return whether a block of pandoc is a paragraph, not a plain text, whose last word ends with a colon."""
    if block["t"] != "Para":
        return False
    previous = block["c"][-1]
    return previous["t"] == "Str" and str(previous["c"]).endswith(":")


def _raw(typst: str) -> dict[str, Any]:
    return {"t": "RawBlock", "c": ["typst", typst]}


_NAMESPACE = ' xmlns="http://www.w3.org/1998/Math/MathML"'
_ACCENTS = {"\u0302": "\u02c6", "\u0303": "\u02dc", "\u0307": "\u02d9", "\u0308": "\u00a8", "\u0305": "\u00af"}
"""Combining accents, which stretch, and those of the same shape that don't."""
_PRIMES = "\u2032\u2033\u2034"
_APPLY = "\u2061"
_FACTORS = {"mi", "mn", "msub", "msup", "msubsup", "mover", "mfrac", "msqrt"}


def mend_all(html: str) -> str:
    """Return HTML whose formulas are corrected by `mend`.

    An inline formula is put into a span with adjacent letters, commas and brackets, so that a line does not break
    there.
    """

    def together(match: re.Match[str]) -> str:
        before, formula, sign = match[1], mend(match[2]), match[3]
        inline = (before or sign) and 'display="inline"' in formula
        words = before + formula + sign
        return f'<span class="together">{words}</span>' if inline else words

    return re.sub(r"([\w(]*)(<math.*?</math>)([,.;:)]*)", together, html, flags=re.DOTALL)


def mend(math: str) -> str:
    r"""Return the MathML of one formula, corrected for browsers.

    The TeX repeated inside it is removed. ``\mathbf`` is upright, as in print. Accents don't stretch. A prime,
    which the math font draws raised, isn't raised again, and stands above an index. A formula marked by ``\boxed``
    gets its class. Function names get the thin spaces that TeX gives them.
    """
    root = ET.fromstring(math.replace(_NAMESPACE, ""))  # noqa: S314  pandoc's output, not a stranger's
    semantics = root.find("semantics")
    if semantics is not None:
        root[:] = semantics[:1]
    for parent in reversed(list(root.iter())):
        parent[:] = [_mended(child) for child in parent]
        _space_functions(parent)
    return ET.tostring(root, encoding="unicode", short_empty_elements=False)


def _mended(element: ET.Element) -> ET.Element:
    """Return an element of MathML corrected as `mend` says: the element, changed in place, or a new one for a prime."""
    if element.get("mathvariant") == "bold-italic":
        del element.attrib["mathvariant"]
        element.text = "".join(map(_upright, element.text or ""))
    if element.tag == "mover" and element[1].get("accent"):
        element.set("accent", "true")
        element[1].text = _ACCENTS.get(element[1].text or "", element[1].text)
        element[1].attrib = {"stretchy": "false"}
    if element.tag == "menclose":
        element.tag, element.attrib = "mrow", {"class": "changed"}
    if element.tag in {"msup", "msubsup"} and (element[-1].text or " ") in _PRIMES:
        base, prime = element[0], element[-1]
        prime.attrib = {"lspace": "0", "rspace": "0"}
        neighbour = ET.Element("mrow")
        if element.tag == "msup":
            neighbour.extend([base, prime])
            return neighbour
        above = ET.Element("mpadded", {"width": "0"})
        above.append(prime)
        neighbour.extend([base, above])
        indexed = ET.Element("msub")
        indexed.extend([neighbour, element[1]])
        return indexed
    return element


def _space_functions(parent: ET.Element) -> None:
    """Put thin spaces, in place, about the function names among an element's children.

    One stands before a name that follows a factor, one after a name that no bracket follows.
    """
    spaced: list[ET.Element] = []
    for place, child in enumerate(parent):
        if not _is_function(child) or parent.tag not in {"mrow", "mtd", "math", "msqrt"}:
            spaced.append(child)
            continue
        before, after = parent[place - 1] if place else None, parent[place + 1] if place + 1 < len(parent) else None
        if before is not None and (before.tag in _FACTORS or before.get("form") == "postfix"):
            spaced.append(ET.Element("mspace", {"width": "0.167em"}))
        spaced.append(child)
        if after is not None and after.text != _APPLY and after.get("form") != "prefix":
            spaced.append(ET.Element("mspace", {"width": "0.167em"}))
    parent[:] = spaced


def _is_function(element: ET.Element) -> bool:
    """Return whether an element is a function's name, also with an index or power.

    pandoc marks such names, except inside growing brackets.
    """
    while element.tag in {"msup", "msub"} or (
        element.tag == "mrow" and len(element) == 2 and element[1].text == _APPLY
    ):
        element = element[0]
    return element.tag == "mi" and element.get("mathvariant") == "normal" and len(element.text or "") > 1


def _upright(letter: str) -> str:
    """Return the bold upright letter of Unicode for a bold italic Latin one; other letters unchanged."""
    return chr(ord(letter) - 0x1D468 + 0x1D400) if 0x1D468 <= ord(letter) < 0x1D49C else letter
