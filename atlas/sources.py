"""What a figure, a report or a table is made from: a digest of the code that it reaches, comments and formatting aside.

A Python file is reached when it is named or imported, at any depth and also inside a function, from a file that is
reached. Its digest is that of its syntax tree, so that a comment or a line break changes nothing, and a changed
docstring does (the title of a figure is one). Any other file, and one that is no Python, is digested byte by byte.
"""

import ast
import hashlib
import json
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from functools import lru_cache, partial
from pathlib import Path
from threading import Lock
from typing import Any, TypeAlias

from atlas import _HOMES
from atlas.places import folder

PACKAGE = Path(__file__).resolve().parent
OURS = {"atlas", "figures"}
"""The names that imports of ours begin with."""
MAX_CACHED_SOURCES = 3000
Below: TypeAlias = Callable[[Path, str], tuple[Path | None, Path | None]]
DISTURBED = sys.version_info < (3, 11, 8)
"""Whether two threads that parse disturb each other, CPython issue 106905: a SystemError now and then."""
_PARSING = Lock()


def digest(*values: Any) -> str:
    """Return the SHA-256, 64 hexadecimal digits, of the values written as JSON; the same on every machine.

    Values that JSON cannot write are taken as their `str`.
    """
    text = json.dumps(values, sort_keys=True, ensure_ascii=True, allow_nan=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()


class Sources:
    """Digests of source files and of all modules of atlas and figures that they import.

    Made from a cache with `load(name)` and `save(name, value)` for JSON values, or None. Each file is read once;
    the facts from its syntax tree are kept in the cache under the digest of its bytes.
    """

    def __init__(self, cache: Any = None) -> None:
        self._cache = cache
        self._cached_facts: dict[str, Any] = cache.load("sources") if cache else {}
        self._used: dict[str, Any] = {}
        self._facts_by_path: dict[Path, dict[str, Any]] = {}
        self._modules = lru_cache(maxsize=None)(partial(_files, below=lru_cache(maxsize=None)(_below)))

    def reached(self, roots: Iterable[Path]) -> tuple[Path, ...]:
        """Return the files `roots` and every module of atlas and figures that they import, at any depth, sorted."""
        reached, waiting = set[Path](), [path.resolve() for path in roots]
        while waiting:
            path = waiting.pop()
            if path not in reached:
                reached.add(path)
                waiting += [module for name in self._facts(path)["imports"] for module in self._modules(name)]
        return tuple(sorted(reached, key=str))

    def closure(self, roots: Iterable[Path]) -> str:
        """Return one digest, 64 hexadecimal digits, of the files `roots` and of every module of atlas that they import.

        Comments and formatting of Python files do not count, nor where the checkout is. Raises OSError for a
        missing file.
        """
        return digest(sorted([_place(path), self._facts(path)["digest"]] for path in self.reached(roots)))

    def named(self, file: str | None) -> str:
        """Return the `closure` of the file with this path; the digest of the text, or of None, if there is no file."""
        return self.closure([Path(file)]) if file and Path(file).is_file() else digest(file)

    def save(self) -> None:
        """Save the facts on files in the cache; from MAX_CACHED_SOURCES on, only those used in this process."""
        if self._cache is not None:
            facts = self._cached_facts | self._used
            self._cache.save("sources", facts if len(facts) < MAX_CACHED_SOURCES else self._used)

    def _facts(self, path: Path) -> dict[str, Any]:
        """Return {"digest": hexadecimal text, "imports": dotted names of modules} of a file, which is read once."""
        if path not in self._facts_by_path:
            content = path.read_bytes()
            key = path.suffix + hashlib.sha256(content).hexdigest()
            self._facts_by_path[path] = self._used[key] = self._cached_facts.get(key) or _read(path, content)
        return self._facts_by_path[path]


def _read(path: Path, content: bytes) -> dict[str, Any]:
    tree = None
    with suppress(SyntaxError, ValueError):  # it is no Python: who loads it will say so
        tree = syntax_tree(content) if path.suffix == ".py" else None
    if tree is None:
        return {"digest": hashlib.sha256(content).hexdigest(), "imports": []}
    text, imports = _facts_of(tree)
    return {"digest": hashlib.sha256(text.encode()).hexdigest(), "imports": sorted(imports)}


def syntax_tree(content: bytes, file: str = "<unknown>") -> ast.Module:
    """Return the syntax tree of Python source in bytes; `file` is the name in errors.

    Raises SyntaxError or ValueError for what is no Python. Threads parse one at a time, because of CPython issue 106905
    (see `DISTURBED`); libraries that parse, as Matplotlib for its style sheets, do not take this lock.
    """
    with _PARSING:
        return ast.parse(content, file)


def _facts_of(tree: ast.AST) -> tuple[str, set[str]]:
    """Return a syntax tree as text without positions, and the dotted names of atlas and figures that it imports.

    A line of the text is the kind of a node or a value in it; `ast.dump` and `ast.walk` take twice the time.
    """
    lines, imports, waiting = list[str](), set[str](), list[Any]([tree])
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.AST):
            lines.append(type(node).__name__)
            waiting += [getattr(node, field, None) for field in node._fields]
            if isinstance(node, ast.Import | ast.ImportFrom):
                imports.update(_names(node))
        elif isinstance(node, list):
            lines.append(f"[{len(node)}")
            waiting += node
        else:
            lines.append(repr(node))
    return "\n".join(lines), imports


def _names(node: ast.Import | ast.ImportFrom) -> Iterator[str]:
    """Yield the dotted names of modules of atlas and figures that an import statement imports.

    From ``from a import b`` that is "a.b", whether b is a module or a name in a.
    """
    if isinstance(node, ast.Import):
        yield from (name for alias in node.names for name in _bound(alias) if name.split(".")[0] in OURS)
    elif (node.module or "").split(".")[0] in OURS:
        yield from (f"{node.module}.{alias.name}".removesuffix(".*") for alias in node.names)


def _bound(alias: ast.alias) -> Iterator[str]:
    """Yield the modules that ``import a.b`` binds: "a.b" and "a"; of ``import a.b as c`` only "a.b"."""
    yield alias.name
    if alias.asname is None:
        yield alias.name.split(".")[0]


def _files(name: str, below: Below) -> tuple[Path, ...]:
    """Return the files that importing a dotted name runs: each package on the way and the module itself.

    A public name of the package adds the module that defines it, the bare name "atlas" all of these. `below` is
    `_below`, cached.
    """
    root, *segments = name.split(".")
    if root == "figures":
        return tuple(path for segment in segments[:1] if (path := folder("figures") / f"{segment}.py").is_file())
    homes = {segments[0]} if segments else set(_HOMES)
    files, package_folder = [PACKAGE / "__init__.py"], PACKAGE
    for public in homes & set(_HOMES):
        files += _files(_HOMES[public], below)
    for segment in segments:
        package, module = below(package_folder, segment)
        if package:
            files.append(package)
            package_folder = package.parent
        else:
            files += [module] if module else []
            break  # what follows is a name inside the module or the package
    return tuple(files)


def _below(folder: Path, name: str) -> tuple[Path | None, Path | None]:
    """Return the paths of the package NAME/__init__.py and of the module NAME.py in a folder; None for one missing."""
    package, module = folder / name / "__init__.py", folder / f"{name}.py"
    return package if package.is_file() else None, module if module.is_file() else None


@lru_cache(maxsize=4096)
def _place(path: Path) -> str:
    """Return a path as text relative to the package's folder `_data`, or to the folder that holds the package.

    A path outside both is reduced to the file's name.
    """
    text = path.as_posix()
    for base in (f"{PACKAGE.as_posix()}/_data/", f"{PACKAGE.parent.as_posix()}/"):
        if text.startswith(base):
            return text.removeprefix(base)
    return path.name
