"""The works that a report cites: a BibTeX file, set by pandoc's citeproc in the pages and by Typst in the PDF.

Both set them by author and year, so that a citation reads the same wherever it stands.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import atlas
from atlas.book import pandoc
from atlas.errors import AtlasError

NAME = "references.bib"
"""Name of the file beside the source of the PDF."""
_MODES = ("AuthorInText", "NormalCitation")


@dataclass(frozen=True)
class Bibliography:
    """The works of a BibTeX file, as three mappings by key in the order of the list.

    `named` holds a work's citation in a sentence, "Author (1990)", `bracketed` that in brackets, without the brackets,
    `entries` the work's entry as HTML. `source` is the text of the BibTeX file.
    """

    source: str = ""
    named: Mapping[str, str] = field(default_factory=dict)
    bracketed: Mapping[str, str] = field(default_factory=dict)
    entries: Mapping[str, str] = field(default_factory=dict)


def read(path: Path) -> Bibliography:
    """Return the `Bibliography` of a BibTeX file. Raises AtlasError if it can't be read or has no entry."""
    try:
        source = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise AtlasError(f"the bibliography {path} can't be read: {error}.") from error
    keys = [entry["id"] for entry in json.loads(pandoc.run(["-f", "biblatex", "-t", "csljson"], source))]
    if not keys:
        raise AtlasError(f"the bibliography {path} has no entry.")
    cited = [{"t": "Cite", "c": [[_citation(key, mode)], []]} for mode in _MODES for key in keys]
    document = pandoc.document([{"t": "Plain", "c": [citation]} for citation in cited])
    arguments = ["-f", "json", "-t", "json", "--citeproc", f"--bibliography={path}"]
    *plain, listed = json.loads(pandoc.run(arguments, document))["blocks"]
    words = [_words(citation["c"][0]["c"][1]) for citation in plain]
    entries = {citation["c"][0][0].removeprefix("ref-"): citation["c"][1] for citation in listed["c"][1]}
    html = pandoc.write([(tree, False) for tree in entries.values()], "html")
    return Bibliography(
        source,
        dict(zip(keys, words, strict=False)),
        {key: citation[1:-1] for key, citation in zip(keys, words[len(keys) :], strict=True)},  # without its brackets
        dict(zip(entries, html, strict=True)),
    )


def software() -> str:
    """Return the BibTeX entry of this version of the atlas."""
    return f"""@software{{atlas,
  author  = {{{{The atlas developers}}}},
  title   = {{atlas: exact motion of a charged symmetric body in constant electric and magnetic fields}},
  version = {{{atlas.__version__}}},
}}
"""


def _citation(key: str, mode: str) -> dict[str, Any]:
    """Return pandoc's node, a dict, of a citation of the work `key`; `mode` is "AuthorInText" or "NormalCitation"."""
    nothing: dict[str, Any] = {"citationPrefix": [], "citationSuffix": [], "citationNoteNum": 0, "citationHash": 0}
    return {"citationId": key, "citationMode": {"t": mode}, **nothing}


def _words(nodes: list[Any]) -> str:
    """Return the text of pandoc's inline nodes, nested ones included; a node without text is a space."""
    inner = (node.get("c", " ") for node in nodes)
    return "".join(words if isinstance(words, str) else _words(words[-1]) for words in inner)
