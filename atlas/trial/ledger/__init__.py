r"""The ledger: the equations of the paper, the claims that it makes in words, and our own theorems.

The paper: A. A. Deriglazov, *Rotation matrix of a charged symmetrical body: one-parameter family of solutions in
elementary functions*, arXiv 2403.12089, Universe 2024, 10(6), 250. One file of TOML holds one topic, in the paper's
order: a table for each entry, with the words of its trial: premises, slip, corrected TeX, and a false sentence beside
it. `atlas.trial.proofs` decides whether an entry is true.

The numbers are those that LaTeX prints: a row of `eqnarray` that ends in `\\` or closes the environment takes a number
unless it says `\nonumber`; a row that ends in the primitive `\cr` takes none.
"""

import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from atlas.errors import AtlasError, unknown
from atlas.trial.ledger.equation import ASSUMPTIONS, Equation, Kind, Section, slug

__all__ = ["EQUATIONS", "Equation", "Kind", "Section", "equation", "find", "topic"]

_SECTIONS: Mapping[Section, tuple[str, ...]] = {
    "II": ("lagrangian", "euler_poisson"),
    "III": ("ball",),
    "IV": ("pseudo_oscillator", "quadric"),
    "V": ("hyperbola", "elementary"),
    "VII": ("particle",),
    "Atlas": ("theorems", "clebsch", "elliptic", "general", "separatrix", "closed", "top", "top_map"),
}
APPENDIX = 88
"""Number of the last equation before the appendix, whose equations the published versions number (A1), (A2), ..."""
_KINDS: Mapping[str, Kind] = {"text": "claim", "theorem": "theorem"}


def _entries() -> Iterator[tuple[str, Equation]]:
    """Yield pairs (stem of the ledger file, `Equation`) in the paper's order; line breaks in the file become spaces."""
    for section, topics in _SECTIONS.items():
        for stem in topics:
            file = Path(__file__).with_name(f"{stem}.toml")
            entries: dict[str, dict[str, Any]] = tomllib.loads(file.read_text("utf-8"))
            shared = ASSUMPTIONS | entries.pop("assumptions", {})
            for name, record in entries.items():
                assumptions = tuple(_joined(shared.get(x, x)) for x in record.pop("assumptions", ()))
                outside = tuple(record.pop("outside", ()))
                kind = record.pop("kind", _KINDS.get(name.partition("-")[0], "derivation step"))
                texts: dict[str, Any] = {key: _joined(text) for key, text in record.items()}
                texts |= {"assumptions": assumptions, "outside": outside}
                yield stem, Equation(name=name, section=section, kind=kind, **texts)


def _joined(text: str) -> str:
    return text.strip("\n").replace("\n", " ")


_PLACED = tuple(_entries())
_TOPICS = {entry.name: stem for stem, entry in _PLACED}
EQUATIONS: Mapping[str, Equation] = MappingProxyType({entry.name: entry for _, entry in _PLACED})
"""The entries by name: "(72)" for an equation with a number in print."""

_ALIASES = {
    alias: tuple(entry for entry in EQUATIONS.values() if entry.alias == alias)
    for alias in {entry.alias: None for entry in EQUATIONS.values() if entry.alias}
}
_NUMBERS = [entry.number for entry in EQUATIONS.values() if entry.number is not None]


def find(word: str) -> tuple[Equation, ...]:
    """Return a tuple of the ledger's entries that a word means: 72, (72), A5, a name, or a LaTeX label of the source.

    A5 is the fifth equation of the appendix, (93). The tuple has one `Equation`, or two for a label that stands
    twice in the paper's source. Raises AtlasError with the nearest number or name if nothing is meant.
    """
    number = slug(word)
    if number[:1] == "A" and number[1:].isdecimal() and f"({APPENDIX + int(number[1:4])})" in EQUATIONS:
        number = str(APPENDIX + int(number[1:4]))
    name = f"({number})" if number.isdecimal() else word
    entries = (EQUATIONS[name],) if name in EQUATIONS else _ALIASES.get(name, ())
    if not entries and number.isdecimal():
        target = min(float(number), max(_NUMBERS))  # of any number of digits
        nearest = min(_NUMBERS, key=lambda candidate: abs(candidate - target))
        raise AtlasError(f"there is no equation ({number}) in the ledger; the nearest is ({nearest}).")
    if not entries:
        raise unknown("equation", word, [*EQUATIONS, *_ALIASES], "in the ledger")
    return entries


def equation(word: str) -> Equation:
    """Return the one entry of the ledger, an `Equation` of any kind, that a word means, which is read as by `find`.

    Raises AtlasError if there is none, or if two have this label.
    """
    entries = find(word)
    if len(entries) > 1:
        raise AtlasError(f"{word} is the label of {' and of '.join(entry.name for entry in entries)}: say which.")
    return entries[0]


def topic(name: str) -> str:
    """Return the topic of an equation, such as "quadric": the stem of its ledger file and of its file of proofs.

    ``name`` is any word that `equation` takes; raises AtlasError as `equation` does.
    """
    return _TOPICS[equation(name).name]
