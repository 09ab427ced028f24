"""Refutes a changed line at exact points before anything is written out in symbols, which takes much longer.

Only where every letter is a number once the free parameters are: nothing is defined by the line, no rate is taken.
"""

import ast
from collections.abc import Iterator
from itertools import pairwise, product
from typing import Any

import sympy

from atlas.proof.decide import breaks, completed, decide, points
from atlas.proof.dimensions import unbalanced
from atlas.proof.model import COMMON, Model
from atlas.proof.notation import _SIGNS, NoMeaningError, Reader, Relation, _entries, names, parse
from atlas.proof.trial import Part

Value = Any


class Numbers:
    """The letters of a part at a few exact points, made once for all its changed lines."""

    def __init__(self, part: Part) -> None:
        """Evaluate the letters, unless the part is of a kind that must be tried in symbols."""
        cases = part.model()
        models: list[Model] = [cases] if isinstance(cases, Model) else list(cases)
        plain = part.check is decide and not part.defines and not part.solves
        self.at_points = [(model, [_Point(letters, model) for letters in _letters(model)]) for model in models * plain]

    def refute(self, line: str) -> bool:
        """Whether a point breaks the line; False says nothing."""
        trees = parse(line)
        called = {name for tree in trees for name in _called(tree)}
        for model, at_points in self.at_points:
            if not called <= {name for name in COMMON if model.letters.get(name) is COMMON[name]}:
                return False
            if model.units and unbalanced(line, model.units):
                return True
            try:
                if any(point.breaks(trees) for point in at_points):
                    return True
            except NoMeaningError:
                return True
            except (TypeError, AttributeError, IndexError, KeyError, ValueError):
                return False
        return False


class _Point:
    """One exact point: what each side of a relation is there is found once, however many lines share it."""

    def __init__(self, letters: dict[str, Value], model: Model) -> None:
        self.reader = Reader(letters, model.ranges)
        self.known: dict[tuple[str, tuple[tuple[str, int], ...]], Value] = {}

    def breaks(self, trees: list[ast.Compare]) -> bool:
        """Whether one of the relations does not hold; components are looked at until one is found that is broken."""
        return any(breaks(relation, 0, {}) for tree in trees for relation in self._relations(tree))

    def _relations(self, tree: ast.Compare) -> Iterator[Relation]:
        """Yield the relations of a chain, a component at a time."""
        sides = [tree.left, *tree.comparators]
        free = [self.reader.free(side) for side in sides]
        for side, indices in zip(sides, free, strict=True):
            if indices != free[0] and not (isinstance(side, ast.Constant) and side.value == 0):
                raise NoMeaningError("the indices do not balance")
        order = sorted(free[0] | (names(tree.left) & set(self.reader.ranges)))
        for (left, right), operator in zip(pairwise(sides), tree.ops, strict=True):
            for choice in product(*(self.reader.ranges.get(name, (1, 2, 3)) for name in order)):
                bound = dict(zip(order, choice, strict=True))
                for one, other in _entries(self._value(left, bound), self._value(right, bound)):
                    yield Relation("", (), _SIGNS[type(operator)], (one,), (other,))

    def _value(self, side: ast.expr, bound: dict[str, int]) -> Value:
        key = ast.dump(side), tuple(sorted(bound.items()))
        if key not in self.known:
            self.known[key] = self.reader.value(side, bound)
        return self.known[key]


def _letters(model: Model) -> list[dict[str, Value]]:
    """Return the letters as numbers, point by point."""
    values = [value for value in model.letters.values() if isinstance(value, sympy.Expr | sympy.MatrixBase)]
    values += [entry for family in model.letters.values() if isinstance(family, dict) for entry in family.values()]
    free: set[Value] = set().union(*(sympy.sympify(value).free_symbols for value in values))
    free |= {symbol for _, value in model.where for symbol in sympy.sympify(value).free_symbols}
    free -= {symbol for symbol, _ in model.where}
    every = (completed(point, model) for point in points(sorted(free, key=str), model))
    return [{name: _at(value, point) for name, value in model.letters.items()} for point in every]


def _at(value: Value, point: dict[Value, Value]) -> Value:
    if isinstance(value, dict):
        return {key: _at(entry, point) for key, entry in value.items()}
    return value.xreplace(point) if isinstance(value, sympy.Expr | sympy.MatrixBase) else value


def _called(tree: ast.AST) -> set[str]:
    """Return the functions that a relation calls."""
    return {part.func.id for part in ast.walk(tree) if isinstance(part, ast.Call) and isinstance(part.func, ast.Name)}
