"""What a figure or a page is made from: a digest of the code that it reaches, comments and formatting aside.

A Python file is reached when it is named or imported, at any depth and also inside a function, from a file that is
reached. Its digest is that of its syntax tree, so that a comment or a line break changes nothing, and a changed
docstring does (the title of a figure is one). Any other file, and one that is no Python, is digested byte by byte.
"""

import ast
import hashlib
import json
import os
import time
from collections.abc import Iterable, Iterator
from contextlib import suppress
from functools import cache, lru_cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import atlas
from atlas import _HOMES
from atlas.build import notes
from atlas.places import folder

PACKAGE = Path(atlas.__file__).resolve().parent
OURS = {"atlas", "figures"}
"""The names that imports of ours begin with."""
TICK = 100_000_000
"""Nanoseconds within which two changes of a file may bear the same time; clocks of file systems tick every 10 ms."""


def digest(*parts: Any) -> str:
    """Return the digest of values that JSON can write, the same on every machine."""
    text = json.dumps(parts, sort_keys=True, ensure_ascii=True, allow_nan=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()


@cache
def release(library: str) -> str:
    """Return the version of a library."""
    try:
        return version(library)
    except PackageNotFoundError:
        return "absent"


class Sources:
    """Digests of files and of all that they reach, remembered between runs by the files' times, sizes and inodes.

    A file that was written just now is not remembered: it could be written again at the same time by the clock.
    """

    def __init__(self, memory: Path | None = None) -> None:
        self._memory = memory
        self._known: dict[str, dict[str, Any]] = {}
        self._changed = False
        self._seen: dict[str, dict[str, Any]] = {}
        self._closures: dict[tuple[frozenset[str], frozenset[str]], str] = {}
        if memory is not None:
            self._known = notes.read(memory)

    def reached(self, roots: Iterable[Path], without: Iterable[Path] = ()) -> tuple[Path, ...]:
        """Return the files and every module of ours that they import, sorted; not ``without`` nor through it."""
        return tuple(sorted(map(Path, self._reached(map(_resolved, roots), map(_resolved, without)))))

    def closure(self, roots: Iterable[Path], without: Iterable[Path] = ()) -> str:
        """Return one digest of the files and of every module of ours that they import, but for ``without``.

        It does not depend on where the checkout is.
        """
        asked = frozenset(map(_resolved, roots)), frozenset(map(_resolved, without))
        if asked not in self._closures:
            self._closures[asked] = self.alone(map(Path, sorted(self._reached(*asked))))
        return self._closures[asked]

    def alone(self, files: Iterable[Path]) -> str:
        """Return one digest of the files themselves."""
        return digest([[_place(path), self._facts(_resolved(path))["digest"]] for path in files])

    def save(self) -> None:
        """Remember the digests for the next run, where that can be written: it saves time, and nothing needs it."""
        if self._memory is not None and self._changed:
            with suppress(OSError):
                notes.write(self._memory, self._known)

    def _reached(self, roots: Iterable[str], without: Iterable[str]) -> set[str]:
        closed, found, waiting = set(without), set[str](), list(roots)
        while waiting:
            path = waiting.pop()
            if path not in found and path not in closed:
                found.add(path)
                waiting.extend(self._facts(path)["imports"])
        return found

    def _facts(self, path: str) -> dict[str, Any]:
        """Return the digest of one file and what it imports; a file is looked at once."""
        if path not in self._seen:
            state = os.stat(path)  # noqa: PTH116  hundreds of times a build
            stamp = [state.st_mtime_ns, state.st_ctime_ns, state.st_size, state.st_ino]
            known = self._known.get(path)
            if known is None or known["stamp"] != stamp:
                known = {"stamp": stamp, **_read(Path(path))}
                if time.time_ns() - state.st_ctime_ns > TICK:
                    self._known[path] = known
                    self._changed = True
            files = {str(module) for name in known["imports"] for module in _files(name)}
            self._seen[path] = {"digest": known["digest"], "imports": files}
        return self._seen[path]


@lru_cache(maxsize=4096)
def _resolved(path: Path) -> str:
    return str(path.resolve())


def _read(path: Path) -> dict[str, Any]:
    content = path.read_bytes()
    tree = _tree(content) if path.suffix == ".py" else None
    if tree is None:
        return {"digest": hashlib.sha256(content).hexdigest(), "imports": []}
    return {"digest": hashlib.sha256(ast.dump(tree).encode()).hexdigest(), "imports": sorted(set(_names(tree)))}


def _tree(content: bytes) -> ast.AST | None:
    """Return the syntax tree of a module, or None if it is no Python: who loads it will say so."""
    try:
        return ast.parse(content)
    except (SyntaxError, ValueError):
        return None


def _names(tree: ast.AST) -> Iterator[str]:
    """Go through the dotted names of ours that a module imports, anywhere in it."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (name for alias in node.names for name in _bound(alias) if name.split(".")[0] in OURS)
        elif isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] in OURS:
            yield from (f"{node.module}.{alias.name}".removesuffix(".*") for alias in node.names)


def _bound(alias: ast.alias) -> Iterator[str]:
    """Go through the modules that a name of an import statement makes known."""
    yield alias.name
    if alias.asname is None:
        yield alias.name.split(".")[0]


@lru_cache(maxsize=4096)
def _files(name: str) -> tuple[Path, ...]:
    """Return the files that importing a dotted name runs: each package on the way and the module itself.

    A public name of the package brings the module that it comes from, and the bare package brings them all.
    """
    first, *parts = name.split(".")
    if first == "figures":
        return tuple(path for part in parts[:1] if (path := folder("figures") / f"{part}.py").is_file())
    homes = {parts[0]} if parts else set(_HOMES)
    files, here = [PACKAGE / "__init__.py"], PACKAGE
    for public in homes & set(_HOMES):
        files += _files(_HOMES[public])
    for part in parts:
        package, module = here / part / "__init__.py", here / f"{part}.py"
        if package.is_file():
            files.append(package)
            here /= part
        else:
            if module.is_file():
                files.append(module)
            break  # what follows is a name inside the module or the package
    return tuple(files)


def _place(path: Path) -> str:
    """Return the path from the folder that holds the package, whatever it is called here."""
    for base in (PACKAGE / "_data", PACKAGE.parent):
        if path.is_relative_to(base):
            return path.relative_to(base).as_posix()
    return path.name
