"""Answers of the explorer: the picture of a subject, its numbers with their certainty, and its command."""

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Lock
from typing import Any

import numpy as np

from atlas.arithmetic.certified_digits import MARK, NOT_CERTIFIED, ZERO_WITHIN, certified
from atlas.cli.explorer.subjects import OfFamily, Subject
from atlas.errors import AtlasError, DomainError
from atlas.families.family import Quantity
from atlas.families.sliders import letters
from atlas.pictures import Scene, Space

DIGITS, SPARE = 10, 1 << 10
"""Digits that are proven when the sliders rest, and bits beyond them in which a proof is looked for."""
EXACT = "decided exactly"
"""Certification of a name, such as that of a case or a kind."""
DRAWING = Lock()
"""Matplotlib's settings are one for all threads."""
FILES = {"pdf": "application/pdf", "svg": "image/svg+xml", "png": "image/png"}


def values_of(subject: Subject, texts: Mapping[str, str]) -> dict[str, float]:
    """Return the values of all sliders by name: those in `texts` as floats, else the sliders' starts.

    Raises AtlasError for a name that has no slider, and for a text that is no finite number. `subject` is a family
    or a recipe.
    """
    sliders = {slider.name: slider for slider in subject.sliders}
    values = {name: slider.start for name, slider in sliders.items()}
    for name, text in texts.items():
        if name not in sliders:
            raise AtlasError(f"{subject.name} has no parameter {name!r}; it has {', '.join(sliders)}.")
        try:
            values[name] = float(text)
        except ValueError:
            values[name] = math.nan
        if not math.isfinite(values[name]):
            raise AtlasError(f"{name} must be a finite number, not {text!r}.")
    return values


def state(subject: Subject, values: Mapping[str, float], *, proven: bool) -> dict[str, Any]:
    """Return the answer to the page as a dict: "scene", "size", "alt", "numbers" and "command".

    `values` are those of the sliders by name. "scene" is None for a picture that is not in space; "size" is (width,
    height) in millimetres; "alt" is its alternative text; "numbers" is a list of dicts of texts, see `_numbers`, empty
    for recipes; "command" is the command line. The numbers are certified if `proven`, else doubles.
    """
    with DRAWING:
        from atlas.pictures.drawing import viewer

        scene = subject.scene(values)
        turns = turning(scene) if viewer.deep(scene) else None
        answer = {"scene": turns and viewer.data(turns), "size": (turns or scene).size}
    numbers = list(_numbers(subject, values, proven=proven)) if isinstance(subject, OfFamily) else []
    return answer | {"alt": scene.alt, "numbers": numbers, "command": subject.command(values)}


def turning(scene: Scene) -> Scene:
    """Return a scene with only its panels in space, without titles; the height is that of the remaining rows.

    The scene must have such a panel.
    """
    panels = tuple(replace(panel, title="") for panel in scene.panels if isinstance(panel, Space))
    columns, rows = min(scene.columns, len(panels)), -(-len(scene.panels) // scene.columns)
    width, height = scene.size
    high = height / rows * -(-len(panels) // columns) * scene.columns / columns
    return replace(scene, panels=panels, columns=columns, rows=(), narrow=(), size=(width, high))


def picture(subject: Subject, values: Mapping[str, float], kind: str) -> bytes:
    """Return the picture of a subject, at the sliders' `values` by name, as bytes of a file "svg", "pdf" or "png"."""
    from atlas.pictures.drawing.files import save

    with DRAWING, TemporaryDirectory() as folder:
        file = Path(folder) / f"figure.{kind}"
        save(subject.scene(values), {file: kind})
        return file.read_bytes()


def _numbers(subject: OfFamily, values: Mapping[str, float], *, proven: bool) -> Iterator[dict[str, str]]:
    """Yield for each quantity a dict of texts: name, says, value, sure (its certainty) and unit.

    `values` are those of all sliders by name; "name" is the quantity's letter. Values come from balls where `proven`
    and available, else from doubles; a slow one is "" in doubles. The value is "none", with the reason in "sure", where
    the quantity is not defined.
    """
    family, kernels = subject.family, subject.kernels(values)
    case = family.case(kernels)
    balls = family.balls()(*subject.arguments(values).values()) if proven else None
    for q in family.quantities:
        try:
            if balls is None and q.slow:
                text, certainty = "", "when the sliders rest"
            elif balls is not None and _has(balls, q):
                text, certainty = _certified(q, balls)
            else:
                text, certainty = _double(q, kernels, family.promises.get(q.checked, 0.0))
        except DomainError as reason:
            text, certainty = "none", str(reason)
        says, _ = q.cases.get(case, (q.says, q.equation))
        yield {"name": letters(q.symbol or q.name), "says": says, "value": text, "sure": certainty, "unit": q.unit}


def _has(balls: Any, q: Quantity) -> bool:
    """Return whether the motion in balls has a certified value of this quantity."""
    return bool(q.certified or q.printed or q.checked) and bool(q.exact or q.get or hasattr(balls, q.name))


def _certified(q: Quantity, motion: Any) -> tuple[str, str]:
    """Return (text of a quantity, verdict on its digits) for one motion in balls.

    The verdict is "10 digits proven" (`DIGITS`), "fewer than 10 digits are proven", "no digit is proven", "proven" for
    a bound on a number not told from zero, or "decided exactly" for a text without digits.
    """
    text = _joined(q, certified(lambda: q.value(motion, exact=True), DIGITS, spare=SPARE))
    if NOT_CERTIFIED in text or MARK in text:
        return text, "no digit is proven" if NOT_CERTIFIED in text else f"fewer than {DIGITS} digits are proven"
    if ZERO_WITHIN in text:
        return text, "proven"
    return text, f"{DIGITS} digits proven" if re.search(r"\d", text) else EXACT


def _double(q: Quantity, motion: Any, ulps: float) -> tuple[str, str]:
    """Return (a quantity in doubles as text, words on its error bound of `ulps`; 0 for no promise)."""
    text = _joined(q, _number_text(q.value(motion)))
    if not re.search(r"\d", text):
        return text, EXACT
    return text, f"double, within {ulps:g} ulp" if ulps else "double, no promise"


def _joined(q: Quantity, value: Any) -> str:
    """Return the values of a quantity, texts, as one text, "none" for None; lines are separated by semicolons."""
    if value is None:
        return "none"
    return "; ".join(map(str, map(q.text, value))) if q.lines else str(q.text(value))


def _number_text(value: Any) -> Any:
    """Return a number as text of six digits, a sequence as a nested list of such texts, a complex number as two.

    Text and None are returned unchanged.
    """
    if isinstance(value, complex):
        return [_number_text(value.real), _number_text(value.imag)]
    if isinstance(value, tuple | list) or np.ndim(value):
        return [_number_text(item) for item in value]
    return value if isinstance(value, str | None) else f"{float(value):.6g}"
