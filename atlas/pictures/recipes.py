"""Recipes of figures, those in figures/ and files of the user's own: the parameters of each, and the scene it makes.

Title, constants and parameters of a recipe, with their defaults and ranges, are read from its source; it
runs only when its scene is wanted. A name stands for a file in figures/, a path that ends with ``.py`` for itself.
"""

import ast
import sys
import traceback
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from functools import lru_cache
from os import PathLike
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any, get_type_hints

from atlas.errors import AtlasError, unknown
from atlas.pictures.parameters import RANGES, fitted
from atlas.places import folder
from atlas.sources import syntax_tree

if TYPE_CHECKING:
    from atlas.pictures.layers import Scene

ROWS = ("a body", "its axis", "its map", "tops", "three moments")
"""Rows of the gallery, in their order."""


@dataclass(frozen=True)
class Recipe:
    """A figure that can be made: name, title, parameters with their defaults, and the constants of the recipe's file.

    Attributes
    ----------
    source : Path
        The recipe's file.
    seen : str
        ``SEEN = "..."``: one sentence, true for all parameters, that states the picture's point and begins the caption.
    row : str
        ``ROW = "its axis"``: the row of the gallery, one of `ROWS`; empty where the file names none.
    records : tuple of str
        ``RECORDS = ("bench.json",)``: files of reports/data that the recipe reads.
    ranges : dict
        Least and greatest value of each number: those common to all recipes and ``RANGES = {"count": (2, 24)}``.
    narrowest : float
        ``NARROWEST = 140.0``: width in millimetres below which the figure cannot be read.
    """

    name: str
    title: str
    parameters: Mapping[str, Any]
    source: Path
    records: tuple[str, ...] = ()
    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    narrowest: float = 0.0
    seen: str = ""
    row: str = ""

    def scene(self, **parameters: Any) -> "Scene":
        """Return the `Scene` for these parameters, defaults for the others; all values are noted in its `parameters`.

        The recipe's file is executed. Raises AtlasError for an unknown parameter, a value that does not fit, or a
        recipe that fails; errors of the package from the recipe, such as DomainError, are passed on.
        """
        from atlas.pictures.layers import Scene

        for name in parameters:
            if name not in self.parameters:
                raise unknown("parameter", name, self.parameters, f"in the figure {self.name!r}")
        try:
            make, hints = _function(self.source)
            used = {
                name: fitted(name, parameters.get(name, default), hints.get(name), default, self.ranges)
                for name, default in self.parameters.items()
            }
            scene = make(**used)
        except AtlasError:
            raise
        except (Exception, SystemExit) as error:
            raise _broken(self.source, error) from error
        if not isinstance(scene, Scene):
            raise AtlasError(f"{_short(self.source)}: scene() must return a Scene, not {type(scene).__name__}")
        if empty_fields := [name for name in ("caption", "alt", "panels") if not getattr(scene, name)]:
            raise AtlasError(f"{_short(self.source)}: the Scene has no {' and no '.join(empty_fields)}")
        caption = f"{self.seen} {scene.caption}".lstrip()
        title = scene.title or self.title
        return replace(scene, title=title, caption=caption, parameters=used, narrowest=self.narrowest)

    def hints(self) -> dict[str, Any]:
        """Return the evaluated annotations of `scene` by name, of its result too, as `typing.get_type_hints` does.

        The recipe's file is executed. Raises AtlasError, with the line if that is known, where it fails.
        """
        try:
            return _function(self.source)[1]
        except (Exception, SystemExit) as error:
            raise _broken(self.source, error) from error


def names() -> list[str]:
    """Return the names of all recipes in figures/ in alphabetical order."""
    return sorted(path.stem for path in folder("figures").glob("*.py") if not path.stem.startswith("_"))


def source(name: str | PathLike[str]) -> Path:
    """Return the path of a recipe, a name in figures/ or a file NAME.py. Raises AtlasError if there is none."""
    name = str(name)
    if name.endswith(".py"):
        file = Path(name)
        if not file.is_file():
            raise AtlasError(f"there is no recipe {name}: it would be a file of Python with a function scene().")
        return file.absolute()
    file = folder("figures") / f"{name}.py"
    if name.startswith("_") or file.parent != folder("figures") or not file.is_file():
        suggestions = " or ".join(map(repr, get_close_matches(name, names(), 3, 0.4)))
        hint = f" (did you mean {suggestions}?)" if suggestions else ""
        raise AtlasError(f"there is no figure {name!r}{hint}; `atlas list figures` names all.")
    return file


def load(name: str | PathLike[str]) -> Recipe:
    """Return the `Recipe` of a name or file; its file is read, not run. Cached until the file changes."""
    file = source(name)
    return _load(file, _stamp(file))


def _stamp(source: Path) -> tuple[int, int]:
    """Return (modification time, size) of a file, to detect edits."""
    status = source.stat()
    return status.st_mtime_ns, status.st_size


@lru_cache
def _load(source: Path, _stamp: tuple[int, int]) -> Recipe:
    tree = _tree(source)
    make = next((node for node in tree.body if isinstance(node, ast.FunctionDef) and node.name == "scene"), None)
    if make is None:
        raise AtlasError(f"{_short(source)} has no function scene(); a recipe is one that returns a Scene")
    arguments = make.args
    places = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]
    values = [
        *[None] * (len(places) - len(arguments.kwonlyargs) - len(arguments.defaults)),
        *arguments.defaults,
        *arguments.kw_defaults,
    ]
    parameters = {place.arg: _default(source, place.arg, value) for place, value in zip(places, values, strict=True)}
    records = tuple(map(str, _declared("RECORDS", source, tree, ())))
    ranges = {**RANGES, **_declared("RANGES", source, tree, {})}
    narrowest = _declared("NARROWEST", source, tree, 0.0)
    statement, row = (_declared(constant, source, tree, "") for constant in ("SEEN", "ROW"))
    if row not in {"", *ROWS}:
        raise AtlasError(f"ROW in {_short(source)} is not a row of the gallery: {row!r}; take one of {', '.join(ROWS)}")
    return Recipe(source.stem, _title(source, tree), parameters, source, records, ranges, narrowest, statement, row)


def _tree(source: Path) -> ast.Module:
    """Return the syntax tree of the recipe's file `source`. Raises AtlasError for a file that is no Python."""
    try:
        return syntax_tree(source.read_bytes(), str(source))
    except (SyntaxError, ValueError) as error:
        raise _broken(source, error) from error


def _title(source: Path, tree: ast.Module) -> str:
    docstring = ast.get_docstring(tree)
    if not docstring:
        raise AtlasError(f"{_short(source)} has no docstring; its first line would be the title of the figure")
    return docstring.splitlines()[0].rstrip(".")


def _declared(constant: str, source: Path, tree: ast.Module, standard: Any) -> Any:
    """Return a constant of a recipe, assigned once on a line of its own at the top; `standard` if there is none.

    Raises AtlasError for another kind of value, for a second assignment, and for one that assigns other names too.
    """
    nodes = [
        node
        for node in tree.body
        if isinstance(node, ast.Assign)
        and any(isinstance(name, ast.Name) and name.id == constant for t in node.targets for name in ast.walk(t))
    ]
    if len(nodes) > 1 or any(not isinstance(node.targets[0], ast.Name) for node in nodes):
        raise AtlasError(f"{constant} in {_short(source)} is not assigned once, on a line of its own")
    try:
        return type(standard)(ast.literal_eval(nodes[0].value)) if nodes else standard
    except (ValueError, TypeError) as error:
        raise AtlasError(f"{constant} in {_short(source)} is not a {_KINDS[constant]} written out") from error


_KINDS = {
    "RECORDS": "tuple of names",
    "RANGES": "dictionary of pairs",
    "NARROWEST": "number",
    "SEEN": "text",
    "ROW": "text",
}


def _default(source: Path, parameter: str, value: ast.expr | None) -> Any:
    """Return the value of a parameter's default, given by its syntax node.

    Raises AtlasError for a missing default and for one that is no literal.
    """
    if value is None:
        raise AtlasError(f"the parameter {parameter!r} of {_short(source)} has no default; every parameter needs one")
    try:
        return ast.literal_eval(value)
    except ValueError as error:
        raise AtlasError(
            f"the default of the parameter {parameter!r} of {_short(source)} is not a plain value; write it out"
        ) from error


def _function(source: Path) -> tuple[Callable[..., "Scene"], dict[str, Any]]:
    """Return (function `scene` of a recipe's file, annotations of its parameters by name).

    The file is executed, once.
    """
    return _run(source, _stamp(source))


@lru_cache
def _run(source: Path, _stamp: tuple[int, int]) -> tuple[Callable[..., "Scene"], dict[str, Any]]:
    module = ModuleType(f"atlas_figures.{source.stem}")
    module.__file__ = str(source)
    sys.modules[module.__name__] = module
    code = compile(source.read_bytes(), str(source), "exec", dont_inherit=True)
    exec(code, module.__dict__)  # noqa: S102  the import system would leave a __pycache__ beside a user's file
    make: Callable[..., Scene] = module.scene
    return make, get_type_hints(make)


def _broken(source: Path, error: BaseException) -> AtlasError:
    """Return, without raising it, an AtlasError that says in one sentence why a recipe failed, and in which line."""
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == str(source)]
    if isinstance(error, SyntaxError):
        lines, error_text = [error.lineno], error.msg
    else:
        error_text = str(error)
    line_words = f", line {lines[-1]}" if lines and lines[-1] else ""
    return AtlasError(f"{_short(source)}{line_words}: {type(error).__name__}: {error_text}")


def _short(source: Path) -> str:
    """Return the name of a recipe's file for messages: "figures/NAME.py", or the bare name of a user's file."""
    return f"figures/{source.name}" if source.parent == folder("figures") else source.name
