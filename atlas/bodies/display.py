"""Representation of an object: one line here; tables, pictures and data frames are made by `atlas.notebook`."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import fields, is_dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from atlas.arithmetic.annotations import RealArrayLike, StyleLike
from atlas.arithmetic.inputs import frozen_property
from atlas.arithmetic.uncertainty import CarriesUncertainty
from atlas.errors import AtlasError, nearest
from atlas.viewers import notebook

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from pandas import DataFrame

MAX_SHOWN_NUMBERS, MAX_COUNTED_OBJECTS = 9, 4096
"""Numbers of an array that are written out; objects whose kinds are counted."""


class Shown(CarriesUncertainty):
    """An object that prints as the call that makes it, in a terminal, and as a table and a picture in a notebook.

    `family` is its name in the register, "" without one; `arguments` maps the names of the constructor's arguments
    to their values, in order; `made_by` names the constructor, where that is not the class. The arguments cannot be
    changed.
    """

    family: ClassVar[str] = ""
    made_by: str = ""
    arguments: Mapping[str, Any]

    def __setattr__(self, name: str, value: Any) -> None:
        """Set an attribute; AttributeError for an argument, a value computed from one, or an unknown public name.

        While the object is made, before it has `arguments`, arguments and unknown names may be set.
        """
        if name in self.__dict__.get("arguments", ()) or isinstance(getattr(type(self), name, None), frozen_property):
            raise AttributeError(f"{name} of a {type(self).__name__} can't be changed: make another one.")
        is_known = name[0] == "_" or name in self.__dict__ or hasattr(type(self), name)
        if "arguments" in self.__dict__ and not is_known:
            raise AttributeError(f"{type(self).__name__} has no attribute {name!r}{nearest(name, self.arguments)}.")
        super().__setattr__(name, value)

    def __eq__(self, other: object) -> bool:
        """Whether both are of one class and made by the same call of the same numbers."""
        if type(other) is not type(self):
            return NotImplemented
        return bool(_key(self) == _key(other))

    def __hash__(self) -> int:
        """Return a hash of the call and its numbers."""
        return hash(_key(self))

    def __reduce__(self) -> tuple[Any, ...]:
        """Return the call that makes the object again, for copy, pickle and other processes."""
        constructor_name = self.made_by.partition(".")[2] if "made_by" in self.__dict__ else ""
        return made, (getattr(type(self), constructor_name) if constructor_name else type(self), dict(self.arguments))

    def __repr__(self) -> str:
        """Return the call that makes the object and, behind a #, its kind, or the shape of an array."""
        kind = _kind(self)
        return call_text(self.made_by or type(self).__name__, self.arguments) + (f"  # {kind}" if kind else "")

    def _repr_html_(self) -> str | None:
        """Return as HTML a table of quantities in proven digits and a small picture, for a notebook; or None."""
        markup: str | None = notebook("show").html(self)
        return markup

    def _repr_latex_(self) -> str | None:
        """Return the table of the quantities as TeX, for a notebook; None without one."""
        markup: str | None = notebook("show").latex(self)
        return markup

    def plot(
        self,
        figure: str | None = None,
        *,
        panel: int | None = None,
        ax: "Axes | None" = None,
        style: StyleLike = None,
        target: str | None = None,
        **parameters: object,
    ) -> "Figure":
        """Matplotlib figure of the object, by a recipe in figures/.

        Parameters
        ----------
        figure : str, optional
            Name of the recipe; by default the first that takes the object.
        panel : int, optional
            Number of a single panel, counted from 1.
        ax : matplotlib.axes.Axes, optional
            Axes that the panel is drawn into, by default the first panel.
        style : str or dict or list, optional
            Matplotlib style, as for `atlas.figure`.
        target : str, optional
            Publication target, as for `atlas.figure`.
        **parameters
            Parameters of the recipe that the object leaves free, such as azimuth.

        Returns
        -------
        matplotlib.figure.Figure
            The figure; with `ax` the figure of these axes.

        Raises
        ------
        AtlasError
            If no such picture of the object exists.
        """
        drawing: Figure = notebook("pictures").plot(self, figure, panel, ax, style, target, parameters)
        return drawing

    def to_dataframe(
        self, times: RealArrayLike | None = None, *, quantities: Sequence[str] | None = None
    ) -> "DataFrame":
        """Table of the object as a `pandas.DataFrame`: one row per object, or one row per time.

        Parameters
        ----------
        times : array_like, shape (N,), optional
            Times of one object; the columns are then rotation matrix, angular velocity and other functions of time.
        quantities : sequence of str, optional
            Names of quantities of the family; by default all numbers.

        Returns
        -------
        pandas.DataFrame
            Parameters and quantities by column; units are in ``frame.attrs["units"]``.

        Raises
        ------
        AtlasError
            Without pandas, and for an unknown quantity.
        """
        table: DataFrame = notebook("frames").frame(self, times, quantities)
        return table


def _key(value: Any) -> Any:
    """Return a hashable value that is equal for equal arguments: numbers by value, in arrays and sequences alike.

    Arrays, lists and tuples become tuples, objects tuples of their class and arguments.
    """
    if isinstance(value, Shown):
        return type(value).__name__, value.made_by, *((name, _key(x)) for name, x in value.arguments.items())
    if isinstance(value, np.ndarray | np.generic):
        return _key(value.tolist())
    if isinstance(value, tuple | list):
        return tuple(map(_key, value))
    if is_dataclass(value) and not isinstance(value, type):
        return type(value).__name__, *(_key(getattr(value, field.name)) for field in fields(value) if field.compare)
    return value


def made(make: Callable[..., Shown], arguments: Mapping[str, Any]) -> Shown:
    """Return the object that ``make`` returns for the named arguments; `Shown.__reduce__` refers to this function."""
    return make(**arguments)


def call_text(name: str, arguments: Mapping[str, Any]) -> str:
    """Return a call as text, "NAME(key=value, ...)"; arguments that are None are left out."""
    keywords = ", ".join(f"{key}={_typed_text(value)}" for key, value in arguments.items() if value is not None)
    return f"{name}({keywords})"


def _typed_text(value: Any) -> str:
    if isinstance(value, Shown):
        return call_text(value.made_by or type(value).__name__, value.arguments)
    if isinstance(value, np.ndarray | np.generic):
        return repr(value.tolist()) if value.size <= MAX_SHOWN_NUMBERS else f"<array {value.shape}>"
    if isinstance(value, tuple):
        return f"({', '.join(map(_typed_text, value))}{',' * (len(value) == 1)})"
    if isinstance(value, list):
        return (
            f"[{', '.join(map(_typed_text, value))}]" if len(value) <= MAX_SHOWN_NUMBERS else f"<list of {len(value)}>"
        )
    return repr(value).partition("  # ")[0]  # a field says beside what B' it is


def _kind(subject: Shown) -> str:
    """Return the kind of an object in words, "" if it has none; of an array its shape, and the count of each kind.

    Of an array above `MAX_COUNTED_OBJECTS` objects only the shape.
    """
    words = []
    for name in ("case", "kind"):
        with suppress(AtlasError):
            words.append(getattr(subject, name, ""))
    shape = getattr(subject, "shape", ())
    if not shape:
        return ", ".join(dict.fromkeys(str(kind) for kind in words if str(kind)))
    if np.prod(shape) > MAX_COUNTED_OBJECTS or not words:
        return f"shape {shape}"
    kinds, counts = np.unique(np.asarray(words[-1] if str(words[-1]) else words[0]), return_counts=True)
    return f"shape {shape}: " + ", ".join(f"{count} {kind}" for kind, count in zip(kinds, counts, strict=True))
