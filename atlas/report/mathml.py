"""MathML as browsers set it best: pandoc's output mended where Chromium shows it unlike TeX, and no more than that."""

import re
from xml.etree import ElementTree as ET

_NAMESPACE = ' xmlns="http://www.w3.org/1998/Math/MathML"'
_ACCENTS = {"\u0302": "\u02c6", "\u0303": "\u02dc", "\u0307": "\u02d9", "\u0308": "\u00a8", "\u0305": "\u00af"}
"""Combining accents, which stretch, and those of the same shape that don't."""
_PRIMES = "\u2032\u2033\u2034"
_APPLY = "\u2061"
_FACTORS = {"mi", "mn", "msub", "msup", "msubsup", "mover", "mfrac", "msqrt"}


def mend_all(html: str) -> str:
    """Mend every formula of a piece of HTML; what touches it stands on its line: a comma, a bracket, a unit."""

    def together(match: re.Match[str]) -> str:
        before, formula, sign = match[1], mend(match[2]), match[3]
        inline = (before or sign) and 'display="inline"' in formula
        words = before + formula + sign
        return f'<span class="together">{words}</span>' if inline else words

    return re.sub(r"([\w(]*)(<math.*?</math>)([,.;:)]*)", together, html, flags=re.DOTALL)


def mend(math: str) -> str:
    r"""Mend one formula.

    The TeX repeated inside it goes. ``\mathbf`` is upright, as in print. Accents don't stretch. A prime, which the math
    font draws raised, isn't raised again, and stands above an index. What ``\boxed`` marks gets its class. Function
    names get the thin spaces that TeX gives them.
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
    """Return what stands in the place of one element."""
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
        beside = ET.Element("mrow")
        if element.tag == "msup":
            beside.extend([base, prime])
            return beside
        above = ET.Element("mpadded", {"width": "0"})
        above.append(prime)
        beside.extend([base, above])
        indexed = ET.Element("msub")
        indexed.extend([beside, element[1]])
        return indexed
    return element


def _space_functions(parent: ET.Element) -> None:
    """Put a thin space before a function name that follows a factor, and after one that no bracket follows."""
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
    """Tell whether an element is the name of a function: pandoc marks it as one, but not inside growing brackets."""
    while element.tag in {"msup", "msub"} or (
        element.tag == "mrow" and len(element) == 2 and element[1].text == _APPLY
    ):
        element = element[0]
    return element.tag == "mi" and element.get("mathvariant") == "normal" and len(element.text or "") > 1


def _upright(letter: str) -> str:
    """Move a Latin letter from the bold italic to the bold upright alphabet of Unicode; leave Greek ones."""
    return chr(ord(letter) - 0x1D468 + 0x1D400) if 0x1D468 <= ord(letter) < 0x1D49C else letter
