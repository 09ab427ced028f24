"""The recipes in figures/: what there is, what each takes, and the scene it makes.

What a recipe says of itself, its title and its parameters with their defaults, is read from its source; it runs only
when its scene is wanted.
"""

import ast
import sys
import traceback
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any, get_type_hints

from atlas.errors import AtlasError, nearest
from atlas.places import folder
from atlas.scene.layers import Scene
from atlas.scene.parameters import RANGES, fitted


@dataclass(frozen=True)
class Recipe:
    """A figure that can be made: its name, title, parameters with their defaults, and where it is written.

    `records` are the files of reports/data that it reads, as it declares them: ``RECORDS = ("bench.json",)``.
    """

    name: str
    title: str
    parameters: Mapping[str, Any]
    source: Path
    records: tuple[str, ...] = ()

    def scene(self, **parameters: Any) -> Scene:
        """Make the scene with these parameters, the defaults for the rest, and note them all in it."""
        for name in parameters:
            if name not in self.parameters:
                raise _unknown("parameter", name, self.parameters, f"the figure {self.name!r}")
        try:
            make, hints, ends = _function(self.source)
            used = {
                name: fitted(name, parameters.get(name, default), hints.get(name), default, ends)
                for name, default in self.parameters.items()
            }
            scene = make(**used)
        except AtlasError:
            raise
        except Exception as error:
            raise _broken(self.source, error) from error
        if not isinstance(scene, Scene):
            raise AtlasError(f"{_short(self.source)}: scene() must return a Scene, not {type(scene).__name__}")
        return replace(scene, parameters=used)


def names() -> list[str]:
    """Return the names of all recipes in alphabetical order."""
    return sorted(path.stem for path in folder("figures").glob("*.py") if not path.stem.startswith("_"))


def title(name: str) -> str:
    """Return the title of a recipe, the first line of its docstring."""
    return _title(name, _tree(_source(name)))


@cache
def load(name: str) -> Recipe:
    """Read what a recipe says of itself, without running it."""
    source = _source(name)
    tree = _tree(source)
    make = next((node for node in tree.body if isinstance(node, ast.FunctionDef) and node.name == "scene"), None)
    if make is None:
        raise AtlasError(f"figures/{name}.py has no function scene(); a recipe is one that returns a Scene")
    given = make.args
    places = [*given.posonlyargs, *given.args, *given.kwonlyargs]
    values = [
        *[None] * (len(places) - len(given.kwonlyargs) - len(given.defaults)),
        *given.defaults,
        *given.kw_defaults,
    ]
    parameters = {place.arg: _default(name, place.arg, value) for place, value in zip(places, values, strict=True)}
    return Recipe(name, _title(name, tree), parameters, source, _records(name, tree))


def _tree(source: Path) -> ast.Module:
    """Parse a recipe."""
    try:
        return ast.parse(source.read_bytes(), str(source))
    except (SyntaxError, ValueError) as error:
        raise _broken(source, error) from error


def _title(name: str, tree: ast.Module) -> str:
    docstring = ast.get_docstring(tree)
    if not docstring:
        raise AtlasError(f"figures/{name}.py has no docstring; its first line would be the title of the figure")
    return docstring.splitlines()[0].rstrip(".")


def _records(name: str, tree: ast.Module) -> tuple[str, ...]:
    """Return the records that a recipe declares."""
    for node in tree.body:
        if isinstance(node, ast.Assign) and any(isinstance(t, ast.Name) and t.id == "RECORDS" for t in node.targets):
            try:
                return tuple(map(str, ast.literal_eval(node.value)))
            except (ValueError, TypeError) as error:
                raise AtlasError(f"RECORDS in figures/{name}.py is not a tuple of names written out") from error
    return ()


def _default(name: str, parameter: str, value: ast.expr | None) -> Any:
    """Return the default of a parameter."""
    if value is None:
        raise AtlasError(f"the parameter {parameter!r} of figures/{name}.py has no default; every parameter needs one")
    try:
        return ast.literal_eval(value)
    except ValueError as error:
        raise AtlasError(
            f"the default of the parameter {parameter!r} of figures/{name}.py is not a plain value; write it out"
        ) from error


@cache
def _function(source: Path) -> tuple[Callable[..., Scene], dict[str, Any], Mapping[str, tuple[float, float]]]:
    """Run a recipe's file and return its function, what it is annotated with, and between what its numbers may lie."""
    spec = spec_from_file_location(f"atlas_figures.{source.stem}", source)
    if spec is None or spec.loader is None:
        raise AtlasError(f"{source} cannot be loaded as Python")
    module = module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    make: Callable[..., Scene] = module.scene
    return make, get_type_hints(make), {**RANGES, **getattr(module, "RANGES", {})}


def _source(name: str) -> Path:
    """Where a recipe is written."""
    known = names()
    if name not in known:
        raise _unknown("figure", name, known, str(folder("figures")))
    return folder("figures") / f"{name}.py"


def _broken(source: Path, error: Exception) -> AtlasError:
    """Say in one sentence what went wrong in a recipe, and in which of its lines."""
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == str(source)]
    if isinstance(error, SyntaxError):
        lines, error_text = [error.lineno], error.msg
    else:
        error_text = str(error)
    where = f", line {lines[-1]}" if lines and lines[-1] else ""
    return AtlasError(f"{_short(source)}{where}: {type(error).__name__}: {error_text}")


def _short(source: Path) -> str:
    """Name a recipe's file as the user knows it."""
    return f"figures/{source.name}"


def _unknown(what: str, name: str, known: Iterable[str], where: str) -> AtlasError:
    """Say which names there are, and which one is meant most likely."""
    options = list(known)
    return AtlasError(f"no {what} {name!r} in {where}{nearest(name, options)}; known: {', '.join(options) or 'none'}")
