"""pandoc: Markdown with TeX to its tree, and trees to HTML with MathML, Typst or LaTeX; one run for many texts.

What can be written is a choice of Markdown in which nothing is passed through: HTML, TeX outside formulas, attributes
and metadata are text like any other. A formula that pandoc can't read is left as TeX with a warning: here that is an
error which names the formula.
"""

import hashlib
import json
import re
import subprocess
from collections.abc import Sequence
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Literal, TypeAlias

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
"""What pandoc may take: seconds of a processor, one more for so many characters, and memory. A book takes a third."""
_HEAP = 251
"""Exit status of a program in Haskell that would need more memory."""
_ENDLESS = "pandoc can't set the texts of the report with {}: brackets, braces or macros are nested too deeply."
SHOWN, NEAR = 90, 20
"""Characters of a formula that a message shows, and of its part from the mistake on."""


class FormulaError(AtlasError):
    """A formula that can't be read, in one sentence; `tex` is the formula."""

    def __init__(self, tex: str, reason: str) -> None:
        shown = " ".join(f"${tex.strip()}$".split())
        shown = shown if len(shown) <= SHOWN else f"{shown[: SHOWN - 1]}…"
        super().__init__(f"the formula {shown} can't be read: {reason}.")
        self.tex = tex


def release() -> str:
    """Return what the output depends on besides the texts: the version of pandoc and how it reads and writes."""
    return json.dumps([libraries.release("pypandoc_binary"), MARKDOWN, _WRITE])


def read(texts: Sequence[tuple[str, bool]]) -> list[Tree]:
    """Return the trees of some texts (Markdown, inline): inlines of an inline text, else blocks.

    Each is a string of a YAML header, so that none can reach into another; one that ends a line is read as blocks.
    """
    sources = [" ".join(markdown.split()) if inline else f"{markdown.strip()}\n" for markdown, inline in texts]
    header = f"---\n{json.dumps({'texts': sources}, ensure_ascii=True)}\n---\n"
    tree = json.loads(run(["-f", f"{MARKDOWN}+yaml_metadata_block", "-t", "json"], header))
    return [value["c"] for value in tree["meta"]["texts"]["c"]]


def write(trees: Sequence[tuple[Tree, bool]], target: Target) -> list[str]:
    """Return trees (tree, inline) as HTML, Typst or LaTeX. Raises FormulaError for a formula that can't be read."""
    mark = _MARK[target].format(hashlib.sha256(json.dumps(trees).encode()).hexdigest())
    blocks: list[Any] = []
    for tree, inline in trees:
        blocks += [{"t": "RawBlock", "c": [target, mark]}, *([{"t": "Plain", "c": tree}] if inline else tree)]
    document = {"pandoc-api-version": api(), "meta": {}, "blocks": blocks}
    output = run(["-f", "json", *_WRITE[target], "--wrap=none"], json.dumps(document))
    return [piece.strip() for piece in output.split(mark)[1:]]


@cache
def api() -> list[int]:
    """Return the version of pandoc's trees."""
    found: list[int] = json.loads(run(["-f", "markdown", "-t", "json"], ""))["pandoc-api-version"]
    return found


def run(arguments: Sequence[str], source: str) -> str:
    """Run pandoc once; turn its first warning into an error, and a text that it can't finish."""
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
            raise AtlasError(f"pandoc could not set the text of the report: {run.stderr.strip().splitlines()[-1]}.")
        warnings = [entry for entry in json.loads(log.read_text("utf-8")) if entry.get("verbosity") == "WARNING"]
    for warning in warnings:
        if warning["type"] == "CouldNotConvertTeXMath":
            raise FormulaError(warning["contents"], _reason(warning["message"]))
        raise AtlasError(f"pandoc warns of {warning['type']}: {json.dumps(warning, ensure_ascii=False)}.")
    return run.stdout


@cache
def _program() -> str:
    """Return the path of the program that its package carries, without loading the package, which takes longer."""
    spec = find_spec("pypandoc")
    place = next(iter(spec.submodule_search_locations or ()), None) if spec else None
    found = next(Path(place or "").glob("files/pandoc*"), None)
    if place is None or found is None:
        raise AtlasError("the package pypandoc_binary with its pandoc is not there: install the locked dependencies.")
    return str(found)


def _reason(message: str) -> str:
    """Return what pandoc did not expect; the long list of what it did is left out."""
    found = re.search(r"^(.*)\n( *)\^\nunexpected (.+)$", message, re.MULTILINE)
    if found is None:
        return "it is no TeX"
    if found[3].startswith("eof"):
        return "it breaks off"
    rest = "" if found[3].startswith("control") else found[1][len(found[2]) :]
    return f"unexpected {found[3][:SHOWN]}" + (f" at {rest[:NEAR]}" if rest else "")


PARAGRAPHS = {"Para", "Plain"}


def kept(blocks: list[Any]) -> list[Any]:
    """Return the blocks of a text, pandoc's, with Typst's `leading` about each paragraph that leads in to something."""
    found: list[Any] = []
    for before, block in zip([None, *blocks], blocks, strict=False):
        if leads(block):
            indented = before is not None and before["t"] in PARAGRAPHS
            found += [_raw(f"#leading({str(indented).lower()})["), block, _raw("]")]
        else:
            found.append(block)
    return found


def leads(block: Any) -> bool:
    """Tell whether a block is a paragraph that ends with a colon."""
    if block["t"] != "Para":
        return False
    last = block["c"][-1]
    return last["t"] == "Str" and str(last["c"]).endswith(":")


def _raw(typst: str) -> dict[str, Any]:
    return {"t": "RawBlock", "c": ["typst", typst]}
