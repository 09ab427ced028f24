"""Contracts that import-linter lacks; `pyproject.toml` describes them."""

import ast
from collections.abc import Iterator
from fnmatch import fnmatch
from pathlib import Path

import grimp
from importlinter import Contract, ContractCheck, fields, output
from importlinter.contracts.acyclic_siblings import AcyclicSiblingsContract

ROOT = Path(__file__).resolve().parents[1]


class FileNames(Contract):
    """Imports between modules go down only, in an order of the names of their files.

    Options: `packages` whose modules are meant; `order`, from high to low, each line one or more patterns as
    ``family*``. A module is on the first line but "*" that its file's name fits, else on that of "*".
    """

    type_name = "file_names"
    packages = fields.ListField(subfield=fields.StringField())
    order = fields.ListField(subfield=fields.StringField())

    def rank(self, module: str) -> int | None:
        """Return the height of a module, or None for one of another package."""
        if not module.startswith(tuple(f"{package}." for package in self.packages)):  # type: ignore[attr-defined]
            return None
        stem = module.rpartition(".")[2]
        lines: list[list[str]] = [line.split() for line in self.order]  # type: ignore[attr-defined]
        fits = (i for i, line in enumerate(lines) if line != ["*"] and any(fnmatch(stem, pattern) for pattern in line))
        return len(lines) - next(fits, lines.index(["*"]))

    def check(self, graph: grimp.ImportGraph, verbose: bool) -> ContractCheck:  # noqa: ARG002  of any contract
        """Return the imports that go up."""
        ranks = {module: rank for module in graph.modules if (rank := self.rank(module)) is not None}
        upward = [
            f"{module} -> {imported}"
            for module, rank in ranks.items()
            for imported in graph.find_modules_directly_imported_by(module)
            if ranks.get(imported, 0) > rank
        ]
        return ContractCheck(kept=not upward, metadata={"upward": sorted(upward)})

    def render_broken_contract(self, check: ContractCheck) -> None:
        """Print the imports that go up."""
        for line in check.metadata["upward"]:
            output.print_error(line)


class NoCircle(AcyclicSiblingsContract):
    """Siblings import each other in no circle, where an import written as a string counts.

    It is `import_module("atlas.x")`, and of an f-string that part which stands before its first brace.
    """

    type_name = "no_circle"

    def check(self, graph: grimp.ImportGraph, verbose: bool) -> ContractCheck:
        """Check the graph with the imports that are written as strings."""
        for module in [name for name in graph.modules if name.split(".")[0] == "atlas"]:
            for imported in imported_by_string(module):
                if imported in graph.modules and not f"{module}.".startswith(f"{imported}."):
                    graph.add_import(importer=module, imported=imported)
        return super().check(graph, verbose)


def imported_by_string(module: str) -> Iterator[str]:
    """Go through the modules that a module imports by their names in strings."""
    place = ROOT / module.replace(".", "/")
    file = place / "__init__.py" if place.is_dir() else place.with_suffix(".py")
    for node in ast.walk(ast.parse(file.read_text("utf-8"))):
        if isinstance(node, ast.Call) and ast.unparse(node.func).endswith("import_module") and node.args:
            (text, *_), is_whole = node.args, True
            if isinstance(text, ast.JoinedStr) and text.values:
                text, is_whole = text.values[0], False
            if isinstance(text, ast.Constant) and isinstance(text.value, str):
                yield text.value if is_whole else text.value.rpartition(".")[0]
