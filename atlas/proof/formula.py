"""The true form of an equation as something to compute with, so that other floors can be held against the ledger."""

from typing import Any

import sympy

from atlas.errors import AtlasError
from atlas.paper import equation
from atlas.proof.model import COMMON
from atlas.proof.notation import Reader, parse
from atlas.proof.run import trial


def value(label: str, letter: str, **letters: Any) -> Any:
    """Evaluate what an equation says that a letter is, in the form that has been proved.

    letters  the values of the other letters: numbers (floats are taken as exact), sequences as vectors, SymPy objects

        value("mf76", "omega3", omega2=0.7, I=1.5, B2=1.0, B3=2.0)

    The corrected form is read first; the printed one where that only adds cases. Returns an exact SymPy number, or a
    matrix of such. AtlasError if the equation defines no such letter or lacks a value.
    """
    case = trial(equation(label).label)
    known = {**COMMON, **{name: _exact(given) for name, given in letters.items()}}
    for tree in [tree for line in (case.corrected, case.printed) if line for tree in parse(line)]:
        if getattr(tree.left, "id", None) == letter:
            found = Reader(known).value(tree.comparators[-1], {})
            missing = sorted(str(symbol) for symbol in getattr(found, "free_symbols", ()) if str(symbol) not in letters)
            if missing:
                raise AtlasError(f"{label} needs the value of {', '.join(missing)} too")
            return found
    raise AtlasError(f"{label} does not say what {letter!r} is; it reads {case.corrected or case.printed}")


def _exact(given: Any) -> Any:
    if isinstance(given, sympy.Basic | sympy.MatrixBase):
        return given
    if hasattr(given, "__len__"):
        return sympy.Matrix([_exact(entry) for entry in given])
    return sympy.Rational(given)
