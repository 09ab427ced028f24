"""Checks a line for dimensions: both sides of a relation and all terms of a sum are the same kind of quantity."""

import ast
from collections.abc import Mapping
from fractions import Fraction
from itertools import pairwise

from atlas.proof.notation import parse

Dimension = tuple[Fraction, ...]

_NONE: Dimension = (Fraction(0),) * 4
_NAMES = ("length", "time", "mass", "charge")
_SAME = {"T", "norm", "abs", "at0"}
_KNOWN = _SAME | {"inv", "cross", "dot", "d", "d2", "sqrt", "sin", "cos", "tan"}


class _ClashError(ValueError):
    """Two quantities of different dimensions where only equal ones make sense; `example` is the change of units."""

    def __init__(self, example: dict[str, str]) -> None:
        super().__init__(example["reason"])
        self.example = example


def unbalanced(line: str, units: Mapping[str, tuple[int, ...]]) -> dict[str, str]:
    """Return what is wrong with the dimensions of a line; {} if nothing is, or if a letter has no known dimension.

    A formula of physics holds in every system of units. So the counterexample is a change of units: where two
    quantities are both 1, what they are in units of which one is half as large.
    """
    known = {name: tuple(Fraction(power) for power in powers) for name, powers in units.items()}
    for tree in parse(line):
        sides = [tree.left, *tree.comparators]
        try:
            found = [(side, _dimension(side, known)) for side in sides]
            for (left, one), (right, other) in pairwise(found):
                _same(left, one, right, other)
        except _ClashError as clash:
            return clash.example
        except KeyError:
            continue
    return {}


def _say(dimension: Dimension) -> str:
    said = [f"{name}^{power}" if power != 1 else name for name, power in zip(_NAMES, dimension, strict=True) if power]
    return " ".join(said) or "number"


def _halved(power: Fraction) -> str:
    """Return what 1 becomes when the unit is halved."""
    return str(Fraction(2) ** int(power)) if power.denominator == 1 else f"2^({power})"


def _same(left: ast.expr, one: Dimension | None, right: ast.expr, other: Dimension | None) -> Dimension | None:
    if one is None or other is None:
        return one if other is None else other
    if one != other:
        base = next(index for index in range(4) if one[index] != other[index])
        formulas = [ast.unparse(side).replace("**", "^") for side in (left, right)]
        raise _ClashError(
            {
                "reason": f"{formulas[0]} is a {_say(one)}, {formulas[1]} a {_say(other)}",
                "where both are": "1",
                "then in units of": f"half the {_NAMES[base]}",
                "left": f"{formulas[0]} is {_halved(one[base])}",
                "right": f"{formulas[1]} is {_halved(other[base])}",
            }
        )
    return one


def _dimension(node: ast.expr, known: Mapping[str, Dimension]) -> Dimension | None:
    """Return the dimension of a formula; None for 0, which has any."""
    if isinstance(node, ast.Constant):
        return None if node.value == 0 else _NONE
    if isinstance(node, ast.Name):
        return known[node.id]
    if isinstance(node, ast.UnaryOp | ast.Subscript):
        return _dimension(node.operand if isinstance(node, ast.UnaryOp) else node.value, known)
    if isinstance(node, ast.List):
        result = None
        for entry in node.elts:
            result = _same(node, result, entry, _dimension(entry, known))
        return result
    if isinstance(node, ast.BinOp):
        return _operation(node, known)
    if isinstance(node, ast.Call):
        return _call(node, known)
    raise KeyError(ast.unparse(node))


def _operation(node: ast.BinOp, known: Mapping[str, Dimension]) -> Dimension | None:
    left = _dimension(node.left, known)
    if isinstance(node.op, ast.Pow):
        try:
            power = Fraction(int(ast.literal_eval(node.right)))
        except ValueError:
            raise KeyError(ast.unparse(node.right)) from None
        return None if left is None else tuple(power * x for x in left)
    right = _dimension(node.right, known)
    if isinstance(node.op, ast.Add | ast.Sub):
        return _same(node.left, left, node.right, right)
    if left is None or right is None:
        return None
    sign = 1 if isinstance(node.op, ast.Mult) else -1
    return tuple(x + sign * y for x, y in zip(left, right, strict=True))


def _call(node: ast.Call, known: Mapping[str, Dimension]) -> Dimension | None:
    name = node.func.id if isinstance(node.func, ast.Name) else ""
    if name not in _KNOWN:
        raise KeyError(name)
    inner = [_dimension(argument, known) for argument in node.args]
    if name in {"cross", "dot"} and None not in inner:
        return tuple(sum(powers, Fraction(0)) for powers in zip(*inner, strict=True))
    if name in {"d", "d2"} and inner[0] is not None:
        return (inner[0][0], inner[0][1] - (1 if name == "d" else 2), *inner[0][2:])
    if name == "inv" and inner[0] is not None:
        return tuple(-x for x in inner[0])
    if name == "sqrt" and inner[0] is not None:
        return tuple(x / 2 for x in inner[0])
    if name in {"sin", "cos", "tan"}:
        return _same(node, _NONE, node.args[0], inner[0])
    return inner[0] if name in _SAME else None
