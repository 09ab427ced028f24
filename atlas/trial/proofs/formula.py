"""The true form of an equation as something to compute with, so that other floors can be held against the ledger."""

import ast
from itertools import product
from typing import Any

import sympy

from atlas.errors import AtlasError
from atlas.trial.ledger import equation
from atlas.trial.proofs.model import COMMON
from atlas.trial.proofs.notation import Reader, letters_of, parse
from atlas.trial.proofs.run import trial


def value(name: str, side: str, /, **letters: Any) -> Any:
    """Evaluate one side of an equation of the ledger, in the form that has been proved.

    name     the equation: any word that `atlas.trial.ledger.equation` takes
    side     a letter, or a whole side as the trial writes it: "omega3", "d(Omega1)", "0"
    letters  the values of the letters on the other side: numbers (floats are taken as exact), sequences as vectors and
             nested ones as matrices, SymPy objects, functions such as d

        value("(71)", "omega3", omega2=0.7, I=1.5, B2=1.0, B3=2.0)

    The corrected form is read first; the printed one where that only adds cases. Of a chain a = b = c the last side
    counts that has no other letters. Returns an exact SymPy number; a vector or a matrix of such numbers where the
    side is one, or has one or two free indices. Raises AtlasError if the equation has no such side or lacks a
    value.
    """
    case = trial(equation(name).name)
    vocabulary = {**COMMON, **{name: _exact(number) for name, number in letters.items()}}
    side_text = ast.dump(parse(f"{side} = 0")[0].left)
    unknown_letters: list[str] = []
    for tree in [tree for piece in (*case.corrected_parts, *case.parts) for tree in parse(piece.line)]:
        sides = [tree.left, *tree.comparators]
        if not all(isinstance(sign, ast.Eq) for sign in tree.ops) or side_text not in map(ast.dump, sides):
            continue
        for operand in reversed([operand for operand in sides if ast.dump(operand) != side_text]):
            absent_letter = sorted({*letters_of(operand), *_functions(operand)} - set(vocabulary))
            if not absent_letter:
                return _components(Reader(vocabulary), operand)
            unknown_letters = unknown_letters or absent_letter
    if unknown_letters:
        raise AtlasError(f"{name} needs the value of {', '.join(unknown_letters)} too")
    raise AtlasError(f"{name} has no side {side!r}; its form is {case.corrected or case.printed}")


def _components(reader: Reader, side: ast.expr) -> Any:
    """Return the value of a side: an expression, or a matrix (3, 1) for one free index and (3, 3) for two."""
    indices = sorted(reader.free_indices(side))
    if not indices:
        return reader.value(side, {})
    entries = [
        reader.value(side, dict(zip(indices, places, strict=True)))
        for places in product((1, 2, 3), repeat=len(indices))
    ]
    return sympy.Matrix(3, 3 ** (len(indices) - 1), entries)


def _functions(side: ast.expr) -> set[str]:
    """Return the set of names of the functions that a formula calls."""
    return {node.func.id for node in ast.walk(side) if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)}


def _exact(number: Any) -> Any:
    if isinstance(number, sympy.Basic | sympy.MatrixBase) or callable(number):
        return number
    if hasattr(number, "__len__"):
        return sympy.Matrix([[_exact(x) for x in row] if hasattr(row, "__len__") else [_exact(row)] for row in number])
    return sympy.Rational(number)
