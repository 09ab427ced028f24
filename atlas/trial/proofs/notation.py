"""The paper's formulas as lines of plain letters: read, and written out in components.

A line is one or more relations, separated by `;`:

    phi = omega3 - B3/B2*omega2 = B3*omega2*(1 - I)*(omega2 + 2*B2)/(I*B2*(omega2 + B2))
    d(R[i,j]) = -eps[j,a,b]*Omega[a]*R[i,b]

`^` is a power; `cross`, `dot`, `d` (rate in time), `d2`, `T` (transpose), `sqrt`, `sin`, ... are functions of the model
they are. Indices stand in square brackets; one that occurs twice in a product, or once in it but not on the left, is
summed.
"""

import ast
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any, TypeGuard

import sympy

Value = Any  # a SymPy expression or matrix, or a function of such

_SIGNS = {ast.Eq: "=", ast.NotEq: "!=", ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="}


class NoMeaningError(ValueError):
    """A line that has no meaning: its indices do not balance, or a vector stands where a number should.

    `example` has the texts "reason" and, where both are known, "left" and "right": a counterexample of
    `decide.Outcome`.
    """

    def __init__(self, reason: str, lhs: str = "", rhs: str = "") -> None:
        super().__init__(reason)
        self.example = {"reason": reason} | ({"left": lhs, "right": rhs} if lhs else {})


@dataclass(frozen=True, slots=True)
class Relation:
    """One comparison of two formulas: `text` in plain letters, `letters` in it, `sign` such as "<=".

    `lhs` and `rhs` are the values of both sides, one entry for each component and each value of the free indices.
    """

    text: str
    letters: tuple[str, ...]
    sign: str
    lhs: tuple[Value, ...]
    rhs: tuple[Value, ...]


def parse(line: str) -> list[ast.Compare]:
    """Return one syntax tree for each relation of a line; "=" is read as "==", "^" as "**".

    Raises NoMeaningError for a statement without a sign of comparison, SyntaxError for one that Python can't read.
    """
    trees = []
    for text in line.split(";"):
        python = re.sub(r"(?<![<>!=])=(?!=)", "==", text.strip()).replace("^", "**")
        tree = ast.parse(python, mode="eval").body
        if not isinstance(tree, ast.Compare):
            raise NoMeaningError(f"{text.strip()!r} relates nothing to anything")
        trees.append(tree)
    return trees


def equations(line: str) -> list[ast.Compare]:
    """Return the relations of a line as syntax trees. Raises NoMeaningError if one of them is not an equation."""
    trees = parse(line)
    if not all(isinstance(sign, ast.Eq) for tree in trees for sign in tree.ops):
        raise NoMeaningError(f"{line} is not said with signs of equality")
    return trees


def write(trees: list[ast.Compare]) -> str:
    """Return the line of `notation` for syntax trees, relations joined by "; ": the inverse of `parse`."""
    text = "; ".join(ast.unparse(tree) for tree in trees)
    return re.sub(r" ([*/^]) ", r"\1", text.replace("==", "=").replace("**", "^"))


def sides(line: str) -> list[str]:
    """Return the two or more sides of the first relation of a line as texts.

    Raises NoMeaningError if any relation of the line is no equation.
    """
    tree = equations(line)[0]
    return [write([ast.Compare(side, [ast.Eq()], [ast.Constant(0)])])[:-4] for side in (tree.left, *tree.comparators)]


def conserved(line: str) -> str:
    """Return the line "a = c; d(a) = 0; at0(c) = b" for a = c = b, which says that a is conserved.

    For a = b it is "d(a) = 0; at0(a) = b". Equations of a longer line are treated one by one. Raises NoMeaningError for
    a relation that is no equation.
    """
    lines: list[str] = []
    for tree in equations(line):
        sides = [ast.unparse(side) for side in (tree.left, *tree.comparators)]
        lines += [f"{sides[0]} == {side}" for side in sides[1:-1]]
        lines += [f"d({sides[0]}) == 0", f"at0({sides[-2]}) == {sides[-1]}"]
    return write([compare for statement in lines for compare in parse(statement)])


def names(node: ast.AST) -> set[str]:
    """Return the set of index names in the square brackets of a formula, given as its syntax tree."""
    letters = set()
    for node_inside in ast.walk(node):
        if isinstance(node_inside, ast.Subscript):
            letters |= {name.id for name in ast.walk(node_inside.slice) if isinstance(name, ast.Name)}
    return letters


def factors(node: ast.expr) -> Iterator[tuple[ast.expr, bool]]:
    """Yield pairs (factor, whether it divides) of a product or quotient; (formula, False) for any other formula.

    Formulas and factors are syntax trees.
    """
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult | ast.Div):
        yield from factors(node.left)
        divides = isinstance(node.op, ast.Div)
        yield from ((factor, inverse != divides) for factor, inverse in factors(node.right))
    else:
        yield node, False


def is_sum(node: ast.expr) -> TypeGuard[ast.BinOp]:
    """Whether a formula, given as its syntax tree, is a sum or a difference."""
    return isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.Sub)


class Reader:
    """Evaluates lines of `notation` with given values of letters (name -> value).

    Indices run over 1, 2, 3 unless `ranges` (index -> integers) gives others. A letter without a value is a real
    symbol of its name.
    """

    def __init__(self, letters: Mapping[str, Value], ranges: Mapping[str, tuple[int, ...]] | None = None) -> None:
        self.letters = letters
        self.ranges = ranges or {}
        self._fixed: dict[str, Value] = {}  # parts without indices, which sums would build again and again

    def relations(self, line: str) -> list[Relation]:
        """Return the `Relation` of each comparison in a line; a chain a = b = c gives two, a = b and b = c.

        Raises NoMeaningError if the free indices of its sides differ, or a vector stands beside a number other than 0.
        """
        relations = []
        for tree in parse(line):
            sides = [tree.left, *tree.comparators]
            free_indices = sorted(self.free_indices(tree.left) | (names(tree.left) & set(self.ranges)))
            for side in sides[1:]:
                if not is_zero(side) and self.free_indices(side) != self.free_indices(tree.left):
                    raise NoMeaningError(
                        f"the indices of {ast.unparse(tree.left)} and {ast.unparse(side)} do not balance"
                    )
            for lhs, operator, rhs in zip(sides, tree.ops, sides[1:], strict=False):
                sign = _SIGNS[type(operator)]
                tree_here = ast.Compare(lhs, [operator], [rhs])
                values = [(self.value(lhs, bound), self.value(rhs, bound)) for bound in self._assignments(free_indices)]
                pairs = [pair for value in values for pair in _entries(*value)]
                relations.append(
                    Relation(
                        write([tree_here]),
                        letters_of(tree_here),
                        sign,
                        tuple(a for a, _ in pairs),
                        tuple(b for _, b in pairs),
                    )
                )
        return relations

    def free_indices(self, node: ast.expr) -> set[str]:
        """Return the set of names of the free indices of a formula, without those of particles (`ranges`).

        ``node`` is the formula's syntax tree. Raises NoMeaningError if terms of a sum have different free indices.
        """
        if is_sum(node):
            lhs, rhs = self.free_indices(node.left), self.free_indices(node.right)
            if lhs != rhs and not is_zero(node.left) and not is_zero(node.right):
                raise self._imbalance(node.left, node.right)
            return lhs
        if isinstance(node, ast.UnaryOp):
            return self.free_indices(node.operand)
        operands = [factor for factor, _ in factors(node)]
        if len(operands) == 1:
            if isinstance(node, ast.Call):
                return set().union(*(self.free_indices(argument) for argument in node.args))
            if isinstance(node, ast.Subscript):
                inner = [name.id for name in ast.walk(node.slice) if isinstance(name, ast.Name)]
                return {name for name in inner if inner.count(name) == 1} - set(self.ranges) | self.free_indices(
                    node.value
                )
            return set()
        every = [name for operand in operands for name in self.free_indices(operand)]
        return {name for name in every if every.count(name) == 1}

    def _imbalance(self, *sides: ast.expr) -> NoMeaningError:
        says = []
        for side in sides:
            indices = " and ".join(sorted(self.free_indices(side)))
            says.append(f"{ast.unparse(side)} has {'the' if indices else 'no'} free index {indices}".rstrip())
        return NoMeaningError("the indices do not balance", *says)

    def value(self, node: ast.expr, bound: Mapping[str, int]) -> Value:
        """Return the value of a formula, an expression or a matrix, with the indices in ``bound`` at these integers.

        ``node`` is the formula's syntax tree. All other indices are summed over. Raises KeyError for a function
        that the letters lack.
        """
        if bound and not names(node) and not isinstance(node, ast.Constant | ast.Name):
            key = ast.dump(node)
            if key not in self._fixed:
                self._fixed[key] = self.value(node, {})
            return self._fixed[key]
        if is_sum(node):
            lhs, rhs = self.value(node.left, bound), self.value(node.right, bound)
            return lhs + rhs if isinstance(node.op, ast.Add) else lhs - rhs
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            return -self.value(node.operand, bound)
        operands = list(factors(node))
        sums = self.summed(operands, names(node) - set(bound))
        terms = list(self._products(operands, sums, dict(bound), sympy.Integer(1)))
        return sum(terms[1:], terms[0]) if terms else sympy.Integer(0)

    def summed(self, operands: list[tuple[ast.expr, bool]], indices: set[str]) -> set[str]:
        """Return the set of those of ``indices`` over which the product of ``operands`` is summed as a whole.

        ``operands`` are the pairs (factor, whether it divides) of `factors`. An index within a single factor that
        is itself a sum is summed inside that factor.
        """
        holders = {name: [factor for factor, _ in operands if name in names(factor)] for name in indices}
        return {name for name, group in holders.items() if len(group) > 1 or not is_sum(group[0])}

    def _assignments(self, indices: list[str]) -> Iterator[dict[str, int]]:
        for choice in product(*(self.ranges.get(name, (1, 2, 3)) for name in indices)):
            yield dict(zip(indices, choice, strict=True))

    def _products(
        self, operands: list[tuple[ast.expr, bool]], sums: set[str], bound: dict[str, int], so_far: Value
    ) -> Iterator[Value]:
        """Yield ``so_far`` times each product of the values of ``operands``, one for each value of indices ``sums``.

        ``operands`` are the pairs of `factors`, ``bound`` the integers of the indices that are fixed. A factor that
        has a new index and is zero, and is no divisor, is skipped with all its products.
        """
        if not operands:
            yield so_far
            return
        (factor, divides), remainder = operands[0], operands[1:]
        new = sorted(names(factor) & sums)
        for choice in self._assignments(new):
            bindings = {**bound, **choice}
            value = self._factor(factor, bindings)
            if new and value == 0 and not divides:
                continue
            yield from self._products(
                remainder, sums - set(new), bindings, so_far / value if divides else so_far * value
            )

    def _factor(  # noqa: PLR0911  one return for each kind of factor
        self, node: ast.expr, bound: Mapping[str, int]
    ) -> Value:
        match node:
            case ast.Constant():
                return sympy.Integer(node.value)
            case ast.Name():
                named = bound.get(node.id, self.letters.get(node.id))
                return sympy.Symbol(node.id, real=True) if named is None else named
            case ast.Subscript():
                return self._entry(node, bound)
            case ast.BinOp(op=ast.Pow()):
                base, power = self.value(node.left, bound), self.value(node.right, bound)
                return self._power(base, power) if isinstance(base, sympy.MatrixBase) else base**power
            case ast.Call(func=ast.Name(id=name)):
                return self.letters[name](*(self.value(argument, bound) for argument in node.args))
            case ast.List():
                rows = [entry.elts if isinstance(entry, ast.List) else [entry] for entry in node.elts]
                return sympy.Matrix([[self.value(entry, bound) for entry in row] for row in rows])
        return self.value(node, bound)

    def _power(self, base: Value, power: Value) -> Value:
        """Return v.v for a column and the exponent 2, or a power of a square matrix; the exponent -1 gives the inverse.

        Raises NoMeaningError for another power of a column, and for an exponent of a matrix that is no integer.
        """
        if base.shape[1] == 1 and power == 2:
            return base.dot(base)
        if base.shape[1] == 1 or not getattr(power, "is_Integer", False):
            raise NoMeaningError(f"{power} is no power of a vector or a matrix")
        return self.letters["inv"](base) if power == -1 else base**power

    def _entry(self, node: ast.Subscript, bound: Mapping[str, int]) -> Value:
        """Return the entry of a vector, matrix or dictionary at the indices in square brackets.

        Indices of vectors and matrices count from 1; those in ``bound`` have the integers given there. Raises
        NoMeaningError if a dictionary with a key above 3, one that counts particles, has a spatial index.
        """
        base = self._factor(node.value, bound)
        is_other_index = isinstance(node.slice, ast.Name) and node.slice.id not in self.ranges
        if is_other_index and isinstance(base, dict) and any(isinstance(key, int) and key > 3 for key in base):
            raise NoMeaningError(f"{ast.unparse(node)} has an index that does not count these")
        bindings = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        offset = isinstance(base, sympy.MatrixBase)
        entry = tuple(int(self._factor(index, bound)) - offset for index in bindings)
        return base[entry if len(entry) > 1 else entry[0]]


def letters_of(tree: ast.AST) -> tuple[str, ...]:
    """Return the distinct letters of a formula, a syntax tree, in their order: no indices in brackets, no functions."""
    functions = {id(node.func) for node in ast.walk(tree) if isinstance(node, ast.Call)}
    inside = {id(name) for node in ast.walk(tree) if isinstance(node, ast.Subscript) for name in ast.walk(node.slice)}
    letters = [node for node in ast.walk(tree) if isinstance(node, ast.Name) and id(node) not in functions | inside]
    return tuple(dict.fromkeys(name.id for name in sorted(letters, key=lambda name: name.col_offset)))


def is_zero(node: ast.expr) -> bool:
    """Whether a formula, given as its syntax tree, is the number 0."""
    return isinstance(node, ast.Constant) and node.value == 0


def _entries(lhs: Value, rhs: Value) -> list[tuple[Value, Value]]:
    """Return pairs of corresponding entries of the values of two sides, row by row: one pair for two numbers.

    The number 0 stands for a zero matrix of any shape. Raises NoMeaningError if the shapes differ.
    """
    matrices = [isinstance(side, sympy.MatrixBase) for side in (lhs, rhs)]
    if not any(matrices):
        return [(lhs, rhs)]
    if not matrices[1] and rhs == 0:
        rhs = lhs * 0
    if not matrices[0] and lhs == 0:
        lhs = rhs * 0
    if not isinstance(lhs, sympy.MatrixBase) or not isinstance(rhs, sympy.MatrixBase) or lhs.shape != rhs.shape:
        raise NoMeaningError("one side has more components than the other")
    return list(zip(lhs, rhs, strict=True))
