"""Prose with TeX to HTML with MathML and to Typst: all texts of a report in one pandoc call for each target.

pandoc leaves a formula that it can't read behind as raw TeX, with a warning: here that is an error which names the
formula and its place. Its output is mended where it is known to differ from TeX; each mend says what it mends.
"""

import json
import re
import subprocess
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Literal, Protocol, TypeAlias

from atlas.errors import AtlasError
from atlas.report.mathml import mend_all

Target: TypeAlias = Literal["html", "typst"]

_READ = "markdown+smart-implicit_figures-auto_identifiers-citations-raw_tex-yaml_metadata_block"
_WRITE = {"html": ["-t", "html5", "--mathml"], "typst": ["-t", "typst"]}
_MARK = {"html": "<!--text {}-->", "typst": "// text {}\n"}
_TEX = re.compile(r"\$\$(.+?)\$\$|(?<![\\$])\$([^$]+?)\$", re.DOTALL)
_CHAIN = re.compile(r" / [^\s()]*(\((?:[^()]|\([^()]*\))*\))?[^\s()]* / ")
"""How pandoc writes a fraction below a fraction in Typst, which then reads it from left to right."""
SHOWN, NEAR = 90, 20
"""Characters of a formula that a message shows, and of its part from the mistake on."""
_CODE = re.compile(r"`[^`]*`")
_CITATION = re.compile(r"(?<![\w\\])@([a-z]+:[\w-]+|\w+(?:[.-]\w+)*)")


class Memory(Protocol):
    """What was made of a source before, by that source."""

    def __contains__(self, source: str, /) -> bool: ...
    def __getitem__(self, source: str, /) -> str: ...
    def __setitem__(self, source: str, text: str, /) -> None: ...


@dataclass(frozen=True)
class Text:
    """A piece of Markdown, where it stands in the report, and whether it is less than a paragraph."""

    markdown: str
    where: str
    inline: bool


@dataclass
class Manuscript:
    """The texts of one report, collected so that they are set together."""

    texts: list[Text] = field(default_factory=list)
    memory: Memory = field(default_factory=dict[str, str])
    """Texts that were set before are taken from here."""

    def add(self, markdown: str, where: str, *, inline: bool = False) -> int:
        """Take in a text and return its number."""
        self.texts.append(Text(markdown, where, inline))
        return len(self.texts) - 1

    def set(self, target: Target, cite: Callable[[str, str], str]) -> list[str]:
        """Set all texts for a target, in their order.

        `cite` (citation, place) gives the Markdown of a citation such as ``@mf72``. Raises AtlasError for a formula
        that pandoc can't read.
        """
        setting = json.dumps([version("pypandoc_binary"), _READ, _WRITE[target]])
        sources = [_prepared(text, target, cite) for text in self.texts]
        keys = [f"{setting}{text.inline}{source}" for text, source in zip(self.texts, sources, strict=True)]
        new = list({key: number for number, key in enumerate(keys) if key not in self.memory}.values())
        for number, piece in zip(new, _pieces_set([sources[n] for n in new], target, self.texts), strict=True):
            self.memory[keys[number]] = _finished(piece.strip(), target, self.texts[number])
        return [self.memory[key] for key in keys]


def _finished(piece: str, target: Target, text: Text) -> str:
    """Mend what pandoc made of a text."""
    if target == "typst" and _CHAIN.search(piece):
        raise AtlasError(f"{text.where}: a fraction below a fraction is lost in print; write it with a slash.")
    tidy = mend_all(piece) if target == "html" else _tidy_typst(piece)
    return _bare(tidy, target) if text.inline else tidy


def cited(markdown: str, replace: Callable[[str], str]) -> str:
    """Replace the citations of a text; what stands in code or in a formula is none."""
    return "".join(
        piece if kept else _CITATION.sub(lambda match: replace(match[1]), piece) for kept, piece in _pieces(markdown)
    )


def _prepared(text: Text, target: Target, cite: Callable[[str, str], str]) -> str:
    """Resolve the citations, and write TeX as pandoc reads it best."""
    linked = cited(text.markdown, lambda name: cite(name, text.where))
    return "".join(_tex(piece, target) if kept else piece for kept, piece in _pieces(linked))


def _pieces(markdown: str) -> Iterator[tuple[bool, str]]:
    """Cut a text into prose and what is kept as it is: code and formulas."""
    end = 0
    for start, stop in sorted(
        (m.span() for p in (_TEX, _CODE) for m in p.finditer(markdown)), key=lambda span: span[0]
    ):
        if start >= end:
            yield False, markdown[end:start]
            yield True, markdown[start:stop]
            end = stop
    yield False, markdown[end:]


def _tex(tex: str, target: Target) -> str:
    r"""Avoid what pandoc gets wrong: words in ``\mathrm`` are spaced out, a small fraction below a fraction is lost."""
    tex = re.sub(r"\\mathrm\{([A-Za-z]{2,})\}", r"\\text{\1}", tex)
    return re.sub(r"\\[td]frac\b", r"\\frac", tex) if target == "typst" else tex


def _pieces_set(sources: Sequence[str], target: Target, texts: Sequence[Text]) -> list[str]:
    """Set some texts in one call of pandoc, between marks that it leaves alone."""
    if not sources:
        return []
    mark = "\n\n```{{={0}}}\n{1}\n```\n\n"
    marked = (mark.format(target, _MARK[target].format(n).rstrip()) + source for n, source in enumerate(sources))
    output = _pandoc("".join(marked), target, texts)
    return re.split(re.escape(_MARK[target]).replace(r"\{\}", r"\d+").rstrip("\n\\") + r"\s*", output)[1:]


def _pandoc(source: str, target: Target, texts: Sequence[Text]) -> str:
    """Run pandoc once; turn its first warning into an error."""
    with TemporaryDirectory() as folder:
        log = Path(folder) / "log.json"
        command = [_program(), "-f", _READ, *_WRITE[target], "--wrap=none", f"--log={log}"]
        run = subprocess.run(  # noqa: S603  the program is the one inside our own locked package
            command, input=source, capture_output=True, text=True, encoding="utf-8", check=False
        )
        if run.returncode:
            raise AtlasError(f"pandoc could not set the text of the report: {run.stderr.strip().splitlines()[-1]}.")
        warnings = [entry for entry in json.loads(log.read_text("utf-8")) if entry.get("verbosity") == "WARNING"]
    for warning in warnings:
        if warning["type"] == "CouldNotConvertTeXMath":
            tex = warning["contents"]
            place = next((text.where for text in texts if tex.strip() in text.markdown), "somewhere")
            raise AtlasError(f"{place}: the formula {_short(f'${tex.strip()}$')} can't be read: {_reason(warning)}.")
        raise AtlasError(f"pandoc warns of {warning['type']}: {json.dumps(warning, ensure_ascii=False)}.")
    return run.stdout


def _program() -> str:
    """Return the path of the program that its package carries, without loading the package, which takes longer."""
    spec = find_spec("pypandoc")
    place = next(iter(spec.submodule_search_locations or ()), None) if spec else None
    found = next(Path(place or "").glob("files/pandoc*"), None)
    if place is None or found is None:
        raise AtlasError("the package pypandoc_binary with its pandoc is not there: install the locked dependencies.")
    return str(found)


def _reason(warning: dict[str, str]) -> str:
    """Return what pandoc did not expect; the long list of what it did is left out."""
    found = re.search(r"^(.*)\n( *)\^\nunexpected (.+)$", warning["message"], re.MULTILINE)
    if found is None:
        return "it is no TeX"
    if found[3].startswith("eof"):
        return "it breaks off"
    rest = "" if found[3].startswith("control") else found[1][len(found[2]) :]
    return f"unexpected {found[3][:SHOWN]}" + (f" at {rest[:NEAR]}" if rest else "")


def _short(text: str) -> str:
    """Cut a text to what finds room in a line."""
    text = " ".join(text.split())
    return text if len(text) <= SHOWN else f"{text[: SHOWN - 1]}…"


def _tidy_typst(typst: str) -> str:
    r"""Give ``\;`` and ``\!`` their widths, which pandoc rounds to whole ems, and bars their role as delimiters."""
    typst = typst.replace("#h(0em)", "#h(0.278em)").replace("#h(-1em)", "#h(-0.167em)")
    return re.sub(r"\\\| ?(.+?) ?\\\|", r"lr(| \1 |)", typst)


def _bare(markup: str, target: Target) -> str:
    """Take a text out of its paragraph."""
    if target == "html":
        return markup.removeprefix("<p>").removesuffix("</p>")
    return markup.strip()
