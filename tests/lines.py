"""A scene in lines of text, one a layer or a run of equal ones: compact snapshots that notice a line that has moved.

Numbers in [square] brackets are compared to a billionth of the largest in the bracket, less than any pixel; those in
<angles>, which depend on where a curve is sampled, to a thousandth; counts of its points, in ~tildes~, within a factor
of one and a half. All else is compared as text.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import fields, replace
from itertools import groupby
from operator import itemgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray
from syrupy.extensions.single_file import SingleFileSnapshotExtension, WriteMode

from atlas.pictures import Curve, Image, Layer, Panel, Region, Scene, Space, Surface

FloatArray = NDArray[np.float64]
NUMBERS = re.compile(r"(\[[-+.\de ]+\]|<[-+.\de ]+>|~[-+.\de ]+~)")
MANY = 6
"""More equal layers than these in a row make one line."""

Numbers = dict[str, tuple[str, FloatArray]]
"""The numbers of a layer: by name the brackets and the values."""


class Lines(SingleFileSnapshotExtension):
    """Snapshots of lines of text, whose numbers are compared within their brackets."""

    _write_mode = WriteMode.TEXT
    file_extension = "txt"

    def serialize(self, data: Any, **_: Any) -> str:
        """Return the lines as one text."""
        return "".join(f"{line}\n" for line in data)

    def matches(self, *, serialized_data: Any, snapshot_data: Any) -> bool:
        """Return whether two texts say the same."""
        return alike(serialized_data, snapshot_data)


def alike(a: str, b: str) -> bool:
    """Compare texts: numbers within their brackets, the rest to the letter."""
    tokens, tokens_other = (NUMBERS.split(text) for text in (a, b))
    return len(tokens) == len(tokens_other) and all(map(_same, tokens, tokens_other))


def _same(a: str, b: str) -> bool:
    if a == b or not (NUMBERS.fullmatch(a) and NUMBERS.fullmatch(b) and a[0] == b[0]):
        return a == b
    x, y = (np.array(text[1:-1].split(), dtype=float) for text in (a, b))
    most = {"[": 1e-9 * np.abs(x).max(), "<": 1e-3 * np.abs(x).max(), "~": 0.5 * np.abs(x).max() + 2}[a[0]]
    return x.shape == y.shape and bool((np.abs(x - y) <= most).all())


def scene(picture: Scene, noisy: tuple[int, ...] = (), *, words: bool = True) -> Iterator[str]:
    """Yield the lines of a scene; of noisy panels only the layers, with words only if these are certain."""
    yield f"{picture.title}: {picture.size[0]:g} x {picture.size[1]:g} mm, columns {picture.columns}"
    if words:
        yield from (picture.caption, picture.alt)
    for k, panel in enumerate(picture.panels):
        yield from shown(panel, noise=k in noisy)
    if picture.lasts or picture.rows:
        yield f"lasts and rows {_text('[]', np.array([picture.lasts, *picture.rows]))}"
    for panel in picture.narrow:
        yield f"narrow, {len(panel.layers)} layers: " + next(shown(replace(panel, layers=())))
        if isinstance(panel, Space) and any(panel.span):
            yield "span " + _text("<>", np.array(panel.span))


def shown(panel: Panel, *, noise: bool = False) -> Iterator[str]:
    """Yield the lines of a panel and of its layers."""
    settings = {
        field.name: getattr(panel, field.name) for field in fields(panel) if field.name not in {"layers", "span"}
    }
    yield from grouped_lines([(type(panel).__name__, *_parted(settings, noise=noise))])
    yield from grouped_lines(
        (
            f"{type(layer).__name__} {getattr(layer, 'role', '')}".strip(),
            "".join(f" {text!r}" for name, text in vars(layer).items() if _is_written(name, text)),
            {} if noise else measured(layer),
        )
        for layer in panel.layers
    )


def _is_written(name: str, value: Any) -> bool:
    """Tell whether a field of a layer is words; most layers ride on nothing."""
    return isinstance(value, str) and name != "role" and (name, value) != ("rides", "")


def _parted(settings: dict[str, Any], *, noise: bool) -> tuple[str, Numbers]:
    """Return settings as words, and those that are numbers; the limits of noise are noise."""
    numbers = {name: value for name, value in settings.items() if isinstance(value, float) or "limits" in name}
    words = "".join(f" {name}={value!r}" for name, value in settings.items() if name not in numbers and value)
    arrays = {name: ("[]", np.array(value)) for name, value in numbers.items() if value is not None and not noise}
    return words, arrays


def grouped_lines(parts: Iterable[tuple[str, str, Numbers]]) -> Iterator[str]:
    """Yield a line for each part, or for many of one name in a row, from its name, its words and its numbers."""
    for name, group in groupby(parts, key=itemgetter(0)):
        _, words, numbers = zip(*group, strict=True)
        shapes = {tuple((key, values.size) for key, (_, values) in one.items()) for one in numbers}
        if len(words) > MANY and len(shapes) == 1:
            yield f"{name} x {len(words)}{''.join(dict.fromkeys(words))}{_line(_together(numbers))}"
        else:
            yield from (f"{name}{word}{_line(one)}" for word, one in zip(words, numbers, strict=True))


def _together(numbers: Sequence[Numbers]) -> Numbers:
    """Return the means of many parts' numbers, and those weighted by their place, so that none moves unseen."""
    weights = np.arange(1.0, len(numbers) + 1.0)
    merged = {}
    for name, (brackets, _) in numbers[0].items():
        values = np.stack([numbers_of_layer[name][1].ravel() for numbers_of_layer in numbers])
        merged[name] = brackets, np.concatenate([values.mean(axis=0), weights @ values / weights.sum()])
    return merged


def _line(numbers: Numbers) -> str:
    return "".join(f" {name} {_text(brackets, values)}" for name, (brackets, values) in numbers.items())


def _text(brackets: str, values: FloatArray) -> str:
    """Return numbers in brackets; those that are zero beside the others but for rounding are zero."""
    flat = np.ravel(np.asarray(values, dtype=float))
    size = 1e-10 * np.abs(flat).max(initial=0.0)
    form = {"[]": ".11g", "<>": ".4g", "~~": ".4g"}[brackets]
    return brackets[0] + " ".join(format(0.0 if abs(x) < size else x, form) for x in flat) + brackets[1]


def measured(layer: Layer) -> Numbers:
    """Return the numbers of a layer: its places, box, and some points on the way."""
    if isinstance(layer, Surface):
        return _of_surface(layer)
    if isinstance(layer, Image):
        few = [np.linspace(0, size - 1, 8).round().astype(int) for size in layer.values.shape]
        measures = {"cells": layer.values.shape, "x": layer.x[[0, -1]], "y": layer.y[[0, -1]], "limits": layer.limits}
        measures["values"] = layer.values[np.ix_(*few)]
    elif isinstance(layer, Curve | Region):
        low, extent = layer.points.min(axis=0), np.ptp(layer.points, axis=0)
        box = {"box": ("<>", np.concatenate([low, low + extent])), "count": ("~~", np.array([len(layer.points)]))}
        return {"ends": ("<>", layer.points[[0, -1]])} | (box if len(layer.points) > 2 else {})
    else:
        measures = {name: value for name, value in vars(layer).items() if not isinstance(value, str)}
        if len(points := np.atleast_2d(measures.get("points", 0.0))) > MANY:
            measures["points"] = [len(points), *points[0], *points[-1], *points.mean(axis=0), *points.std(axis=0)]
    return {name: ("[]", np.asarray(value, dtype=float)) for name, value in measures.items() if value is not None}


def _of_surface(layer: Surface) -> Numbers:
    corners = np.concatenate([np.reshape(grid, (-1, 3)) for grid in layer.grids])
    matrix: Numbers = {
        "quadric": ("[]", layer.quadric[np.triu_indices(4)]),
        "box": ("<>", np.array([corners.min(axis=0), corners.max(axis=0)])),
        "count": ("~~", np.array([len(corners)])),
        "lines": ("[]", np.array([len(layer.wires), len(layer.rims)])),
    }
    for name, rows in {"clip": layer.clip, "within": [form[np.triu_indices(4)] for form in layer.within]}.items():
        if len(rows):
            matrix[name] = "[]", np.arange(1.0, len(rows) + 1.0) @ np.asarray(rows)
    for name, lines in {"wires": layer.wires, "rims": layer.rims}.items():
        if lines:
            way = [_at_fractions(line, np.array([0.4]))[0] for line in lines]
            matrix[name] = "<>", np.array([np.mean(way, axis=0), np.arange(1.0, len(way) + 1.0) @ way])
    return matrix


def _at_fractions(points: FloatArray, parts: FloatArray) -> FloatArray:
    """Return the points at these parts of the length of a line, each coordinate counted in its extent if it has one."""
    size = np.ptp(points, axis=0)
    steps = np.diff(points, axis=0) / np.where(size > 1e-12 * np.abs(points).max(), size, np.inf)
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(steps, axis=1))])
    return np.stack([np.interp(parts * length[-1], length, part) for part in points.T], axis=1)
