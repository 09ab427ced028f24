"""An object as HTML and as LaTeX: its quantities from the register, in proven digits, and a small picture."""

import re
from base64 import b64encode
from collections.abc import Sequence
from contextlib import suppress
from html import escape
from io import BytesIO

from atlas.core.shown import Shown
from atlas.errors import AtlasError
from atlas.families import FAMILIES
from atlas.notebook.pictures import plot
from atlas.report.digits import Number
from atlas.report.tables.layout import NONE
from atlas.report.tables.properties import SPACE, Thing, rows_of

DIGITS = 10
WIDTH = 300
"""How wide the picture is shown, in pixels of CSS, each of which has two of its own."""
SIDES = dict.fromkeys(("Quantity", "Name", "Value", "Unit", "Equation", "Proven"), "left") | {"Value": "right"}
"""Where the text of a column stands; JupyterLab puts all to the right where nothing is said."""
Row = tuple[str, str, str | Number, str, str, str]


def html(shown: Shown) -> str:
    """Return what makes an object, the picture, and the table; arrays and what has no family have no table."""
    found = rows(shown)
    heads, *body = (_line(tag, cells) for tag, cells in [("th", [*SIDES]), *(("td", _cells(row)) for row in found)])
    table = f"<table><thead>{heads}</thead><tbody>{''.join(body)}</tbody></table>" if found else ""
    beside = f"{table}{picture(shown)}"
    flow = '<div style="display:flex;flex-wrap:wrap;gap:1em;align-items:flex-start">'
    head = f'<pre style="word-break:normal">{escape(repr(shown))}</pre>'
    return f"{head}{f'{flow}{beside}</div>' if beside else ''}"


def latex(shown: Shown) -> str | None:
    """Return the values as an array in LaTeX."""
    lines = [
        rf"\text{{{_words(says)}}} & {value.tex()[1:-1] if isinstance(value, Number) else _text(value)} & "
        rf"{_unit(unit)} \\"
        for says, _, value, unit, _, _ in rows(shown)
    ]
    return "\n".join([r"$$\begin{array}{lrl}", *lines, r"\end{array}$$"]) if lines else None


def rows(shown: Shown) -> Sequence[Row]:
    """Return the rows of the table of one object that the register knows."""
    family = FAMILIES.get(shown.family)
    given = tuple(shown.arguments.values())
    several = bool(getattr(shown, "shape", ()))
    if family is None or several or shown.made_by or len(given) != len(family.parameters):
        return ()
    thing = Thing(family, {}, given, given, "time", described=False)
    return [row for q in family.quantities for row in rows_of(thing, q, DIGITS) if row[2] != NONE]


def picture(shown: Shown) -> str:
    """Return the first panel of the figure of an object, small; nothing where there is none."""
    with suppress(AtlasError):
        file, figure = BytesIO(), plot(shown, None, 1, None, None, None, {})
        figure.savefig(file, dpi=2 * WIDTH / figure.get_figwidth())
        return f'<img width="{WIDTH}" alt="" src="data:image/png;base64,{b64encode(file.getvalue()).decode()}">'
    return ""


def _line(tag: str, cells: Sequence[str]) -> str:
    sides = zip(cells, SIDES.values(), strict=True)
    return "<tr>" + "".join(f'<{tag} style="text-align:{side}">{cell}</{tag}>' for cell, side in sides) + "</tr>"


def _cells(row: Row) -> list[str]:
    says, name, value, unit, equation, sure = row
    number = value.words() if isinstance(value, Number) else value
    return [_html(part) for part in (says, name, number, "" if unit == "1" else unit, equation, sure)]


def _html(markdown: str) -> str:
    """Set what the register's tables have of Markdown; formulas stay between dollars, which MathJax sets."""
    text = escape(markdown.replace(SPACE, "\N{NO-BREAK SPACE}"), quote=False)
    for pattern, replacement in ((r"`([^`]+)`", r"<code>\1</code>"), (r"\^([^^$]+)\^", r"<sup>\1</sup>"), (r"@", "")):
        text = re.sub(pattern, replacement, text)
    return text


def _words(markdown: str) -> str:
    return re.sub(r"\^([^^$]+)\^", r"$^{\1}$", markdown.replace(SPACE, "~").replace("\N{MINUS SIGN}", "-"))


def _text(value: str) -> str:
    return rf"\text{{{_words(value)}}}"


def _unit(unit: str) -> str:
    return "" if unit in {"", "1"} else _text(unit)
