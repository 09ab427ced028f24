r"""A bound on the width in print of a formula or a line of text, from its TeX alone.

Only what may be too wide is measured: a layout that measures sets everything twice, and most formulas end far from the
margin. The bound adds up, for each sign, the widest of its class in the faces of the PDF with the space around it, and
takes of a fraction the wider part, of a matrix the widest cell of each column. It may be half as large again as the
formula, but is never smaller; what it does not know has no bound.
"""

import math
import re
from collections.abc import Iterator

ROOM = 152.0
"""Width of the text in millimetres."""
DISPLAY, LABEL, ENTRY, TABLE = 10.5, 7.5, 9.2, 9.0
"""Sizes of type in points: displayed equations and their labels, formulas of the ledger, tables."""
HALF, COLUMN = 73.0, 130.0
"""Widths in millimetres: of two formulas side by side, and of a corrected formula of the ledger."""
SPACE = 1.3
"""Ems between the columns of a table, and for the star of a number that is not proven."""
MILLIMETRES = 25.4 / 72
"""Millimetres of a point."""

_SIGN_OF_TEX = re.compile(r"\\(?:begin|end)\{(\w+\*?)\}|\\[A-Za-z]+|\\.|\s+|.", re.DOTALL)
_SPACES = {r"\quad": 1.0, r"\qquad": 2.0, r"\,": 0.17, r"\:": 0.23, r"\;": 0.28, r"\!": 0.0, r"\ ": 0.34}
_WIDE = {r"\implies": 2.2, r"\iff": 2.2, r"\sum": 1.6, r"\int": 1.0, r"\ldots": 1.2, r"\prod": 1.5}
_NOTHING = {"displaystyle", "limits", "nolimits"}
_GROWING = {"left", "right", "big", "Big", "bigl", "bigr", "Bigl", "Bigr", "biggl", "biggr", "Biggl", "Biggr"}
_WRAPS = {
    *("mathbf", "boldsymbol", "mathbb", "mathcal"),
    *("hat", "dot", "ddot", "bar", "tilde", "vec", "overline"),
}
_WORDS = {"text", "textit", "mathrm", "operatorname"}
_NAMES = {"sin", "cos", "tan", "exp", "ln", "log", "det", "max", "min"}
_SIGNS = {
    *("equiv", "pm", "mp", "in", "ne", "neq", "le", "leq", "ge", "geq", "times", "cdot", "setminus", "approx", "sim"),
    *("ll", "gg", "to", "rightarrow", "perp", "parallel", "propto", "notin", "subset", "wedge"),
}
_LETTERS = {
    *("alpha", "beta", "gamma", "delta", "epsilon", "varepsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda"),
    *("mu", "nu", "xi", "pi", "rho", "sigma", "tau", "phi", "varphi", "chi", "psi", "omega"),
    *("lvert", "rvert", "lVert", "rVert", "Vert", "vert", "prime", "langle", "rangle", "ell", "hbar", "partial"),
}
_CAPITALS = {
    *("Gamma", "Delta", "Theta", "Lambda", "Xi", "Pi", "Sigma", "Phi", "Psi", "Omega", "bot", "nabla", "infty"),
}
_SCRIPT, _GAP, _BRACKET, _GROWN = 0.75, 1.0, 0.55, 0.7
_UNKNOWN = 0x2200
"""Code point from which on a character may be of any width."""
_ALIGNED = re.compile(r"\\begin\{(?!\w?matrix)")
_CITED = re.compile(r"@([a-z]+:)?[\w.-]+")


def formula(tex: str) -> float:
    """Return a bound on the width of a displayed formula, in ems; infinity where there is none.

    Lines that are aligned have one only where they are the whole formula: in print, all of a formula are aligned on one
    another.
    """
    if _ALIGNED.search(tex.strip(), 1):
        return math.inf
    signs = [match[0] for match in _SIGN_OF_TEX.finditer(tex)]
    return sum(_widths(iter(signs), ""))


def line(markdown: str) -> float:
    """Return a bound on the width of a line of text with formulas, in ems; infinity where there is none."""
    total = 0.0
    for place, piece in enumerate(re.split(r"\$([^$]+)\$", markdown)):
        if place % 2:
            total += formula(piece)
        else:
            cited = [math.inf if match[1] else 0.4 for match in _CITED.finditer(piece)]
            total += sum(map(_plain, piece)) + sum(cited)
    return total


def fits(ems: float, size: float, room: float = ROOM) -> bool:
    """Tell whether so many ems of type of a size in points surely find room, in millimetres."""
    return ems * size * MILLIMETRES <= room


def _widths(signs: Iterator[str], until: str) -> Iterator[float]:
    """Go through the signs of a formula up to the end of a group, and give the width of each."""
    for sign in signs:
        if sign == until:
            return
        yield _width(sign, signs)


def _width(sign: str, signs: Iterator[str]) -> float:  # noqa: PLR0911  one line for each class of signs
    """Return the width of a sign with all that belongs to it."""
    name = sign[1:]
    if sign.isspace() or sign == "&":
        return 0.0
    if sign == "{":
        return sum(_widths(signs, "}"))
    if sign in "_^":
        return _SCRIPT * _width(_next(signs), signs)
    if sign.startswith(r"\begin{"):
        return _matrix(signs, sign.replace("begin", "end"))
    if sign in {r"\frac", r"\tfrac", r"\dfrac"}:
        return max(_width(_next(signs), signs), _width(_next(signs), signs)) + 0.4
    if sign == r"\sqrt":
        return 1.2 + _width(_next(signs), signs)
    if sign in _SPACES or sign in _WIDE:
        return _SPACES.get(sign) or _WIDE.get(sign, 0.0)
    if sign.startswith("\\") and name.isalpha():
        return _named(name, signs)
    if sign in {r"\{", r"\}", r"\|"}:
        return _BRACKET
    return math.inf if sign.startswith("\\") else _sign(sign)


def _named(name: str, signs: Iterator[str]) -> float:
    """Return the width of a macro with a name."""
    if name in _NOTHING:
        return 0.0
    if name in _WRAPS:
        return 0.2 + 1.1 * _width(_next(signs), signs)
    if name in _WORDS:
        return 0.6 + 1.1 * _width(_next(signs), signs)
    if name in _NAMES:
        return 0.9 * len(name) + 0.4
    for names, width in ((_SIGNS, 1.5), (_CAPITALS, 1.0), (_LETTERS, 0.75), (_GROWING, _GROWN)):
        if name in names:
            return width
    return math.inf


def _next(signs: Iterator[str]) -> str:
    """Return the next sign that is no blank; a formula that ends here has no bound."""
    return next((sign for sign in signs if not sign.isspace()), r"\?")


def _matrix(signs: Iterator[str], end: str) -> float:
    """Return the width of an environment: of each column the widest cell."""
    columns: list[float] = [0.0]
    place, cell = 0, 0.0
    for sign in signs:
        if sign in {"&", r"\\", end}:
            columns[place] = max(columns[place], cell)
            place, cell = (place + 1 if sign == "&" else 0), 0.0
            columns += [0.0] * (place + 1 - len(columns))
            if sign == end:
                return sum(columns) + _GAP * (len(columns) - 1) + 2 * (_BRACKET + _GROWN)
        else:
            cell += _width(sign, signs)
    return math.inf


def _sign(character: str) -> float:
    """Return the width of a character of a formula with the space around it."""
    if character.isdigit() or character in ".'!":
        return 0.55
    if character in "()[]|/":
        return _BRACKET
    if character in "+-=<>*:":
        return 1.35
    if character in ",;":
        return 0.5
    return _letter(character) + 0.1


def _plain(character: str) -> float:
    """Return the width of a character of text."""
    return 0.5 if character.isdigit() or character in " .,;:()[]'" else _letter(character)


def _letter(character: str) -> float:
    """Return the width of a letter, bold or not; a character that is none of ours has no bound."""
    if character.isascii() and character.islower():
        return 0.85 if character in "mw" else 0.45 if character in "fijlrst" else 0.6
    if character.isascii() and character.isupper():
        return 1.0 if character in "MW" else 0.85
    return 1.1 if ord(character) < _UNKNOWN else math.inf
