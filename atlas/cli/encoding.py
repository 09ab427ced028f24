"""Letters that the terminal's encoding does not have: written in ASCII, as near as it gets; and what it would obey."""

import codecs
import sys
from collections.abc import Mapping

NAME = "atlas"
NEAR: Mapping[str, str] = {
    "−": "-",
    "–": "-",
    "—": "-",
    "×": "x",
    "·": "*",
    "→": "->",
    "≤": "<=",
    "≥": ">=",
    "′": "'",
    "µ": "u",
}


def write_plainly() -> None:
    """Let standard output and standard error never fail over a letter, and write each line when it ends.

    Where the encoding is ASCII, click writes through a stream of its own, which would overtake lines that wait.
    """
    codecs.register_error(NAME, _replaced)
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)
        if reconfigure is not None:
            reconfigure(errors=NAME, line_buffering=True)


def _replaced(error: UnicodeError) -> tuple[str, int]:
    """Return what is written in the place of the letters that can't be."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    from unicodedata import normalize

    letters = error.object[error.start : error.end].translate(str.maketrans(dict[str, str | int | None](NEAR)))
    near = "".join(normalize("NFKD", letter).encode("ascii", "ignore").decode() or "?" for letter in letters)
    return near, error.end
