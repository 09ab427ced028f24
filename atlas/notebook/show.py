"""An object as HTML and as LaTeX: its quantities from the register, in proven digits, and a small picture."""

import re
from base64 import b64encode
from collections.abc import Callable, Sequence
from contextlib import suppress
from html import escape
from io import BytesIO
from typing import Any

from atlas.bodies.body import SymmetricBody
from atlas.bodies.display import Shown
from atlas.book.digits import Number
from atlas.book.tables.elementary import NONE
from atlas.book.tables.properties import SPACE, FamilyObject, Row, rows_of
from atlas.errors import AtlasError
from atlas.motions.register import FAMILIES
from atlas.notebook.pictures import plot
from atlas.pictures.drawing import figure
from atlas.trial.ledger.plain import plain

DIGITS = 10
WIDTH, COLOURS = 300, 40
"""How wide the picture is shown, in pixels of CSS, each of which has two of its own; a notebook that keeps many of
them stays light."""
SIDES = dict.fromkeys(("Quantity", "Name", "Value", "Unit", "Equation", "Proven"), "left") | {"Value": "right"}
"""Where the text of a column stands; JupyterLab puts all to the right where nothing is said."""
FLOW = '<div style="display:flex;flex-wrap:wrap;gap:1em;align-items:flex-start">'


def html(subject: Shown) -> str:
    """Return an object as HTML: its `repr`, a table of its quantities, and a small picture.

    Table and picture are left out where `rows` is empty, or where there is no figure.
    """
    lines = rows(subject)
    heads, *body = (_line(tag, cells) for tag, cells in [("th", [*SIDES]), *(("td", _cells(row)) for row in lines)])
    table = f"<table><thead>{heads}</thead><tbody>{''.join(body)}</tbody></table>" if lines else ""
    content = f"{table}{picture(subject)}"
    head = f'<pre style="word-break:normal">{escape(repr(subject))}</pre>'
    return f"{head}{f'{FLOW}{content}</div>' if content else ''}"


def latex(subject: Shown) -> str | None:
    """Return a LaTeX array with a line (meaning, value, unit) for each of an object's quantities; None without any."""
    lines = [
        rf"\text{{{_words(says)}}} & {value.tex()[1:-1] if isinstance(value, Number) else _text(value)} & "
        rf"{_unit(unit)} \\"
        for says, _, value, unit, _, _ in rows(subject)
    ]
    return "\n".join([r"$$\begin{array}{lrl}", *lines, r"\end{array}$$"]) if lines else None


def rows(subject: Shown) -> Sequence[Row]:
    """Return the table's rows: meaning, name, value (a text or `Number`), unit, equation, whether proven.

    () for several objects, for one without a family, and for one not made from its family's parameters.
    """
    family = FAMILIES.get(subject.family)
    values = tuple(subject.arguments.values())
    count = bool(getattr(subject, "shape", ()))
    if family is None or count or subject.made_by or len(values) != len(family.parameters):
        return ()
    item = FamilyObject(family, {}, values, values, {}, described=False)
    return [row for q in family.quantities for row in rows_of(item, q, DIGITS) if row[2] != NONE]


def body(subject: SymmetricBody) -> str:
    """Return a body's `repr`, I2, I3 and I3/I2 and a small picture of such a cylinder as HTML.

    An array of bodies has only the `repr`, a body with I3 = 0 no picture.
    """
    if hasattr(subject.I2, "shape"):
        return f"<pre>{escape(repr(subject))}</pre>"
    lines = [("I<sub>2</sub>, across the axis", subject.I2), ("I<sub>3</sub>, along it", subject.I3)]
    lines.append(("I = I<sub>3</sub>/I<sub>2</sub>", subject.ratio))
    table = "".join(f"<tr><td>{says}</td><td>{value:.10g}</td></tr>" for says, value in lines)
    image = _image(lambda: figure("lssc", ratio=subject, field=(0.0, 0.0))) if subject.I3 else ""
    return f"<pre>{escape(repr(subject))}</pre>{FLOW}<table>{table}</table>{image}</div>"


def picture(subject: Shown) -> str:
    """Return the first panel of an object's figure as an HTML img element; "" where there is no figure."""
    return _image(lambda: plot(subject, None, 1, None, None, None, {}))


def _image(draw: Callable[[], Any]) -> str:
    """Return an HTML img element with the Matplotlib figure that `draw()` returns, as an inlined PNG of few colours.

    "" if `draw` raises AtlasError.
    """
    from PIL import Image

    with suppress(AtlasError):
        file, small, figure = BytesIO(), BytesIO(), draw()
        figure.savefig(file, dpi=2 * WIDTH / figure.get_figwidth())
        with Image.open(file) as image:
            white = Image.new("RGBA", image.size, "white")
            white.alpha_composite(image.convert("RGBA"))
        reduced = white.convert("RGB").quantize(COLOURS, kmeans=3, dither=Image.Dither.NONE)
        reduced.save(small, "png", optimize=True)
        return f'<img width="{WIDTH}" alt="" src="data:image/png;base64,{b64encode(small.getvalue()).decode()}">'
    return ""


def _line(tag: str, cells: Sequence[str]) -> str:
    sides = zip(cells, SIDES.values(), strict=True)
    return "<tr>" + "".join(f'<{tag} style="text-align:{side}">{cell}</{tag}>' for cell, side in sides) + "</tr>"


def _cells(row: Row) -> list[str]:
    says, name, value, unit, equation, proof = row
    number = value.words() if isinstance(value, Number) else value
    return [_html(cell) for cell in (says, name, number, "" if unit == "1" else unit, equation, proof)]


def _html(markdown: str) -> str:
    """Return Markdown of the register (code, exponents, formulas) as HTML.

    Formulas become plain letters, since a notebook may lack TeX.
    """
    text = escape(markdown.replace(SPACE, "\N{NO-BREAK SPACE}"), quote=False)
    text = re.sub(r"\$([^$]+)\$", lambda formula: _letters(formula[1]), text)
    for pattern, replacement in ((r"`([^`]+)`", r"<code>\1</code>"), (r"\^([^^$]+)\^", r"<sup>\1</sup>"), (r"@", "")):
        text = re.sub(pattern, replacement, text)
    return text


def _letters(tex: str) -> str:
    r"""Return a short formula in TeX as HTML letters, italic or bold for \mathbf, with subscripts."""
    kind = "b" if r"\mathbf" in tex else "i"
    letters = re.sub(r"_\{?(\w+)\}?", r"<sub>\1</sub>", plain(f"${tex}$")).replace("'", "\N{PRIME}")
    return f"<{kind}>{letters}</{kind}>"


def _words(markdown: str) -> str:
    return re.sub(r"\^([^^$]+)\^", r"$^{\1}$", markdown.replace(SPACE, "~").replace("\N{MINUS SIGN}", "-"))


def _text(value: str) -> str:
    return rf"\text{{{_words(value)}}}"


def _unit(unit: str) -> str:
    return "" if unit in {"", "1"} else _text(unit)
