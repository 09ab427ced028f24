"""Changes a line by one sign, coefficient, index or exponent at a time: a trial that means something must notice."""

import ast
import copy
import random
import re
from collections.abc import Iterator

from atlas.proof.notation import parse, write


def changes(line: str, letters: frozenset[str], *, most: int | None = None, seed: str = "") -> list[tuple[str, str]]:
    """Return lines that differ from this one in one place, each with what was changed.

    most     how many at most, chosen by `seed`; None for all

    letters  the names that the model knows: an index is changed to one that means something
    """
    found: dict[str, str] = {}
    for what, tree in _changes(parse(line), letters):
        text = write(tree)
        if text != write(parse(line)):
            found.setdefault(text, what)
    every = sorted(found.items())
    if most is None or len(every) <= most:
        return every
    return sorted(random.Random(seed).sample(every, most))  # noqa: S311  a choice that is the same in every run


def _changes(trees: list[ast.Compare], letters: frozenset[str]) -> Iterator[tuple[str, list[ast.Compare]]]:
    """Yield every change of one node, on a copy of the whole line."""
    for number, tree in enumerate(trees):
        for path in _paths(tree):
            for what, replacement in _options(_ancestors(tree, path), letters):
                changed = copy.deepcopy(trees)
                _set(changed[number], path, replacement)
                yield what, changed


Path = tuple[tuple[str, int | None], ...]


def _paths(root: ast.AST) -> Iterator[Path]:
    """Yield the way to every formula below a node: fields, and places in lists."""
    for field, value in ast.iter_fields(root):
        for index, node in list(enumerate(value)) if isinstance(value, list) else [(None, value)]:
            if isinstance(node, ast.expr):
                yield ((field, index),)
                yield from (((field, index), *rest) for rest in _paths(node))


def _ancestors(root: ast.AST, path: Path) -> list[ast.AST]:
    chain = [root]
    for field, index in path:
        value = getattr(chain[-1], field)
        chain.append(value if index is None else value[index])
    return chain


def _set(root: ast.AST, path: Path, replacement: ast.expr) -> None:
    parent = _ancestors(root, path[:-1])[-1]
    field, index = path[-1]
    if index is None:
        setattr(parent, field, replacement)
    else:
        getattr(parent, field)[index] = replacement


def _options(chain: list[ast.AST], letters: frozenset[str]) -> Iterator[tuple[str, ast.expr]]:
    """Yield what a node may be changed to, but for changes of sign or size that leave the relation what it is."""
    idle = _idle(chain)
    yield from ((what, node) for what, node in _every(chain[-1], chain[-2], letters) if what not in idle)


def _idle(chain: list[ast.AST]) -> set[str]:
    """Return what makes no difference here: the sign below an even power or a cosine, any factor of what equals 0."""
    below = chain[-1]
    for above in reversed(chain[:-1]):
        if isinstance(above, ast.BinOp) and isinstance(above.op, ast.Pow):
            even = isinstance(above.right, ast.Constant) and above.right.value in {2, 4}
            return {"sign"} if above.left is below and even else set()
        if isinstance(above, ast.Call) and isinstance(above.func, ast.Name):
            if above.func.id in {"cos", "abs", "norm"}:
                return {"sign"}
            if above.func.id not in {"d", "d2", "dot", "cross"}:
                return set()
        elif isinstance(above, ast.Compare):
            sides = [above.left, *above.comparators]
            zero = any(isinstance(side, ast.Constant) and side.value == 0 for side in sides)
            return {"sign", "coefficient"} if len(sides) == 2 and zero and chain[-1] is not above else set()
        elif not isinstance(above, ast.UnaryOp) and not _is_product(above):
            return set()
        below = above
    return set()


def _is_product(node: ast.AST) -> bool:
    return isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult | ast.Div)


def _every(node: ast.AST, parent: ast.AST, letters: frozenset[str]) -> Iterator[tuple[str, ast.expr]]:
    """Yield all that one node may be changed to."""
    match node:
        case ast.BinOp():
            yield from _operated(node, parent)
        case ast.UnaryOp():
            yield "sign", node.operand
        case ast.Constant(value=int(value)):
            exponent = isinstance(parent, ast.BinOp) and isinstance(parent.op, ast.Pow) and parent.right is node
            in_brackets = isinstance(parent, ast.Subscript) and parent.slice is node
            yield ("exponent" if exponent else "index" if in_brackets else "number"), ast.Constant(value + 1)
        case ast.Name() if not _is_function(node, parent):
            yield from _renamed(node, parent, letters)
        case ast.Subscript(slice=ast.Tuple(elts=[first, second, *rest])):
            yield "index", ast.Subscript(node.value, ast.Tuple([second, first, *rest], ast.Load()), ast.Load())
        case ast.Call():
            yield from _called(node)


def _operated(node: ast.BinOp, parent: ast.AST) -> Iterator[tuple[str, ast.expr]]:
    match node.op:
        case ast.Add():
            yield "term", ast.BinOp(node.left, ast.Sub(), node.right)
        case ast.Sub():
            yield "term", ast.BinOp(node.left, ast.Add(), node.right)
        case ast.Pow():
            yield "exponent", node.left
        case _:
            if not _is_product(parent):
                yield "coefficient", ast.BinOp(ast.Constant(2), ast.Mult(), node)
                yield "sign", ast.UnaryOp(ast.USub(), node)
            if isinstance(node.op, ast.Div):
                yield "exponent", ast.BinOp(node.left, ast.Mult(), node.right)


def _is_function(node: ast.AST, parent: ast.AST) -> bool:
    return isinstance(parent, ast.Call) and parent.func is node


def _renamed(node: ast.Name, parent: ast.AST, letters: frozenset[str]) -> Iterator[tuple[str, ast.expr]]:
    stem = re.match(r"(.*?)(\d)([a-z]?)$", node.id)
    if stem:
        for digit in "123":
            other = f"{stem[1]}{digit}{stem[3]}"
            if other != node.id and other in letters:
                yield "index", ast.Name(other)
    if isinstance(parent, ast.BinOp | ast.Compare | ast.UnaryOp | ast.Call) and node.id not in {"pi", "one"}:
        yield "coefficient", ast.BinOp(ast.Constant(2), ast.Mult(), node)
        yield "sign", ast.UnaryOp(ast.USub(), node)


def _called(node: ast.Call) -> Iterator[tuple[str, ast.expr]]:
    name = node.func.id if isinstance(node.func, ast.Name) else ""
    if name == "cross":
        yield "sign", ast.Call(node.func, [node.args[1], node.args[0]], [])
    if name in {"sin", "cos"}:
        yield "function", ast.Call(ast.Name("cos" if name == "sin" else "sin"), node.args, [])
    if name == "sqrt":
        yield "exponent", node.args[0]
    if name == "T":
        yield "index", node.args[0]
    if name in {"d", "d2"}:
        yield "sign", ast.UnaryOp(ast.USub(), node)
        yield "coefficient", ast.BinOp(ast.Constant(2), ast.Mult(), node)
