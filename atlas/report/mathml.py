"""MathML as browsers set it best: pandoc's output mended where it is known to look unlike TeX."""

import re
from xml.etree import ElementTree as ET

_NAMESPACE = ' xmlns="http://www.w3.org/1998/Math/MathML"'
_ACCENTS = {"\u0302": "\u02c6", "\u0303": "\u02dc", "\u0307": "\u02d9", "\u0308": "\u00a8", "\u0305": "\u00af"}
_PRIMES = "\u2032\u2033\u2034"
_APPLY = "\u2061"
_SIGNS = {"\N{MINUS SIGN}", "\N{PLUS-MINUS SIGN}"}
_SPACE = "0.167em"
_CLOSING = {"mi", "mn", "msub", "msup", "msubsup", "mover", "mfrac", "msqrt"}


def mend_all(html: str) -> str:
    """Mend every formula of a piece of HTML, and keep a comma or a full stop on the line of what it follows."""

    def together(match: re.Match[str]) -> str:
        formula, sign = mend(match[1]), match[2]
        return (
            f'<span class="together">{formula}{sign}</span>'
            if sign and 'display="inline"' in formula
            else formula + sign
        )

    return re.sub(r"(<math.*?</math>)([,.;:)]*)", together, html, flags=re.DOTALL)


def mend(math: str) -> str:
    r"""Mend one formula.

    The TeX repeated inside it goes. ``\mathbf`` is upright, as in print. Accents don't stretch. A prime, which the math
    font draws raised, isn't raised again. The rows of ``aligned`` are in display style. Function names get the thin
    spaces that TeX gives them. How cells are aligned is left to the stylesheet, since browsers differ.
    """
    root = ET.fromstring(math.replace(_NAMESPACE, ""))  # noqa: S314  pandoc's output, not a stranger's
    semantics = root.find("semantics")
    if semantics is not None:
        root[:] = semantics[:1]
    _mend_children(root)
    return ET.tostring(root, encoding="unicode", short_empty_elements=False)


def _mend_children(parent: ET.Element) -> None:
    """Mend what stands inside an element, and then the element itself."""
    for child in parent:
        _mend_children(child)
    for place, child in enumerate(list(parent)):
        parent[place] = _mended(child)
    _space_functions(parent)


def _mended(element: ET.Element) -> ET.Element:
    """Return what stands in the place of one element."""
    variant = element.get("mathvariant")
    if variant and variant != "normal":
        del element.attrib["mathvariant"]
    if variant == "bold-italic" and element.tag == "mi":
        element.text = _upright(element.text or "")
    if element.tag == "mover" and element[1].get("accent"):
        element.set("accent", "true")
        mark = element[1]
        mark.text = _ACCENTS.get(mark.text or "", mark.text)
        mark.attrib = {"stretchy": "false"}
    if element.tag == "mtd":
        align, tight = element.get("columnalign", "center"), "padding" in element.get("style", "")
        element.attrib = {"class": align + " tight" * tight}
    if element.tag == "mtable" and element.find("mtr/mtd[@class='right tight']") is not None:
        element.set("displaystyle", "true")
    if element.tag in {"msup", "msubsup"} and (element[-1].text or " ") in _PRIMES:
        return _primed(element)
    return element


def _primed(element: ET.Element) -> ET.Element:
    """Put the prime of x' beside x instead of above it."""
    base, prime = element[0], element[-1]
    prime.attrib = {"lspace": "0", "rspace": "0"}
    row = ET.Element("mrow")
    row.extend([base, prime])
    if element.tag == "msup":
        return row
    indexed = ET.Element("msub")
    indexed.extend([row, element[1]])
    return indexed


def _space_functions(parent: ET.Element) -> None:
    """Give a function name a thin space before, if a factor stands there, and after, unless a bracket opens there."""
    children = list(parent)
    for place, child in enumerate(children):
        name = _function(child)
        before, after = children[place - 1] if place else None, (*children, None)[place + 1]
        if name is None or (after is not None and after.text == _APPLY):
            continue
        row = ET.Element("mrow")
        factor = before is not None and (before.tag in _CLOSING or before.get("form") == "postfix")
        if before is not None and factor and before.text not in _SIGNS:
            row.append(_thin())
        row.append(name)
        if after is not None and after.get("form") != "prefix":
            row.append(_thin())
        parent[place] = row


def _function(element: ET.Element) -> ET.Element | None:
    """Return the name of a function: pandoc marks it as one, but not inside growing brackets."""
    if element.tag == "mrow" and len(element) == 2 and element[1].text == _APPLY:
        return element[0]
    named = element.tag == "mi" and element.get("mathvariant") == "normal" and len(element.text or "") > 1
    return element if named else None


def _thin() -> ET.Element:
    return ET.Element("mspace", {"width": _SPACE})


def _upright(text: str) -> str:
    """Move Latin letters from the bold italic to the bold upright alphabet of Unicode; leave Greek ones."""
    return "".join(chr(ord(x) - 0x1D468 + 0x1D400) if 0x1D468 <= ord(x) < 0x1D49C else x for x in text)
