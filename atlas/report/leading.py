"""Paragraphs that lead in to what comes next, with a colon at their end: in a PDF they stand on one page with it."""

from typing import Any

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
