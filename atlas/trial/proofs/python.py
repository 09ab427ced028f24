"""A line of `notation` in a model, written as Python with SymPy's own names."""

import ast
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import sympy
from sympy.printing.str import StrPrinter

from atlas.trial.proofs.decide import defined, parameters, points, reached, understood
from atlas.trial.proofs.model import COMMON, Model
from atlas.trial.proofs.notation import Reader, Relation, factors, is_sum, is_zero, letters_of, names, parse

Value = Any

_METHODS = {"cross": "cross", "dot": "dot", "inv": "inv", "det": "det", "tr": "trace", "hat": "hat"}
_CALLED = {"eps": "LeviCivita", "delta": "KroneckerDelta", "ln": "log", "abs": "Abs", "sqrt": "sqrt"}
_CALLED |= {name: name for name in ("sin", "cos", "tan", "atan", "diag")}
_TAKEN = {"at0", "check", "d", "flow", "left", "point", "right", "start", "where", "x", "C", "lambda", "in", "is", "as"}


class _NoFormulaError(Exception):
    """Raised where a formula calls a function of the model's own with a loop's index; components are listed instead."""


class _Printer(StrPrinter):  # type: ignore[misc]  # SymPy has no types
    """Prints an expression as Python: fractions exact, matrices on one line.

    `identifier` is a function from a symbol to the name under which the symbol is printed.
    """

    def __init__(self, identifier: Callable[[Value], str]) -> None:
        super().__init__()
        self.identifier = identifier

    def _print_Symbol(self, expr: Value) -> str:
        return self.identifier(expr)

    _print_Dummy = _print_Symbol

    def _print_ImaginaryUnit(self, expr: Value) -> str:
        del expr
        return "sqrt(-1)"  # I is the ratio of the moments

    def _print_Rational(self, expr: Value) -> str:
        return f"Rational({expr.p}, {expr.q})"

    def _print_Integral(self, expr: Value) -> str:
        return f"integrate({', '.join(self.doprint(argument) for argument in expr.args)})"

    def _print_MatrixBase(self, expr: Value) -> str:
        rows = [[self.doprint(entry) for entry in row] for row in expr.tolist()]
        inside = [row[0] for row in rows] if expr.shape[1] == 1 else [f"[{', '.join(row)}]" for row in rows]
        return f"Matrix([{', '.join(inside)}])"


class Line:
    """One line of a trial in one model, as Python code for a script with SymPy.

    Made from the line, the model, the letters that the line defines, and the second line ``solves`` (see
    `decide.decide`); raises NoMeaningError for a line without values in the model. `relations` are to be checked,
    `model` is the model with the definitions added, `definitions` maps defined letters to syntax trees. `used`
    (letter -> value) and `symbols` grow as code is written: they hold the model's letters and SymPy symbols in it.
    ``node``, in the methods, is the syntax tree of a formula of the line.
    """

    def __init__(self, line: str, model: Model, defines: tuple[str, ...], solves: str) -> None:
        self.relations, letters, bindings = understood(line, model, defines, solves)
        self.model = replace(model, letters=letters, bindings=bindings)
        self.reader = Reader(letters, model.ranges)
        self.trees = [*parse(line), *(parse(solves) if solves else [])]
        self.definitions = {
            name: tree.comparators[0]
            for tree in parse(line)
            if (name := defined(tree, defines)) and not _function_names(tree) & set(defines)
        }
        self.used: dict[str, Value] = {}
        self.symbols: list[Value] = []
        self.identifiers: dict[Value, str] = {}
        self.printer = _Printer(self.identifier)
        self.occupied_names = {name for tree in self.trees for name in letters_of(tree)}
        self.occupied_names = _TAKEN | {
            name for name in self.occupied_names if not isinstance(letters.get(name), sympy.Symbol)
        }

    def identifier(self, symbol: Value) -> str:
        """Return the Python identifier of a symbol: its name, with underscores added until no other letter has it."""
        if symbol not in self.identifiers:
            name = re.sub(r"\W", "_", symbol.name)
            while name in self.occupied_names or name in self.identifiers.values():
                name += "_"
            self.identifiers[symbol] = name
        return self.identifiers[symbol]

    def plain(self, value: Value) -> str:
        """Return a number, expression, matrix or dictionary of these as Python code; adds its symbols to `symbols`."""
        if isinstance(value, dict):
            return "{" + ", ".join(f"{key}: {self.plain(entry)}" for key, entry in value.items()) + "}"
        value = value.as_immutable() if isinstance(value, sympy.MatrixBase) else sympy.sympify(value)
        self.symbols += [symbol for symbol in sorted(value.free_symbols, key=str) if symbol not in self.symbols]
        text = str(self.printer.doprint(value))
        return f"Integer({text})" if value.is_Matrix is not True and value.is_Integer else text

    def table(self, values: Mapping[Value, Value]) -> str:
        """Return the code of a dictionary from symbols to expressions; adds their symbols to `symbols`."""
        pairs = (f"{self.plain(s)}: {v if sympy.sympify(v).is_Integer else self.plain(v)}" for s, v in values.items())
        return "{" + ", ".join(pairs) + "}"

    def points(self) -> Iterator[dict[Value, Value]]:
        """Yield the points at which `decide` tries the line: dictionaries from free parameters to rational numbers."""
        every = tuple(name for tree in self.trees for name in letters_of(tree))
        return points(parameters(self.relations, self.model, every), self.model)

    def symbols_reached(self) -> set[Value]:
        """Return the set of symbols on which the code so far depends, directly or through `bindings` and rates.

        The code so far is all that the methods have written. Its own symbols, in `symbols` and `used`, are in the set.
        """
        values = [*self.symbols, *(v for v in self.used.values() if isinstance(v, sympy.Symbol))]
        return reached(values, [*self.model.bindings, *self.model.flow.items()])

    def assumptions(self) -> dict[str, str]:
        """Return by identifier the assumptions of the symbols in the code so far, as ", positive=True", or "".

        Adds the symbols of `used` letters to `symbols`.
        """
        for value in self.used.values():
            if isinstance(value, sympy.Symbol):
                self.plain(value)
        assumptions = {}
        for symbol in sorted(self.symbols, key=str):
            kinds = [kind for kind in ("positive", "nonnegative", "nonzero", "real") if getattr(symbol, f"is_{kind}")]
            extra_kinds = ["nonzero"] * (kinds[:1] == ["nonnegative"] and bool(symbol.is_nonzero))
            assumptions[self.identifier(symbol)] = "".join(f", {kind}=True" for kind in kinds[:1] + extra_kinds)
        return assumptions

    def is_said(self, name: str, value: Value) -> bool:
        """Whether the code needs a line "name = value": not for a symbol whose identifier is the name."""
        return not (isinstance(value, sympy.Symbol) and self.identifier(value) == name)

    def definition(self, name: str) -> str:
        """Return the code of a defined letter's value: its formula as read, or its components written out.

        The components are written out where the formula has a function of the model's own. Raises KeyError for a
        letter that the line does not define.
        """
        try:
            text = self.code(self.definitions[name], ())
            return f"Integer({text})" if text.isdigit() else text
        except _NoFormulaError:
            return self.plain(self.model.letters[name])

    def in_order(self) -> list[str]:
        """Return the list of letters that the line defines, each after those in its definition.

        Letters whose definitions form a circle are left out.
        """
        ordered: list[str] = []
        for _ in self.definitions:
            for name, tree in self.definitions.items():
                if name not in ordered and not (_words(tree) & set(self.definitions)) - {name, *ordered}:
                    ordered.append(name)
        return ordered

    def loops(self, relation: Relation) -> list[tuple[str, tuple[int, ...]]]:
        """Return pairs (index, its integers), one for each free index of a relation that the script runs through.

        The names are sorted; the integers are 1, 2, 3, or those of the model's `ranges`. The list is empty where the
        relation's components are written out. An index of particles is left out where the relation has fewer
        components than its loops would give.
        """
        tree = parse(relation.text)[0]
        ranges = self.reader.ranges
        indices = sorted(self.reader.free_indices(tree.left) | (names(tree.left) & set(ranges)))
        try:
            for side in (tree.left, tree.comparators[0]):
                self.code(side, tuple(indices))
        except _NoFormulaError:
            return []
        values = [self.value(side, tuple(indices)) for side in (tree.left, tree.comparators[0])]
        size = max(len(value) if isinstance(value, sympy.MatrixBase) else 1 for value in values)
        for name in indices:
            size *= len(ranges.get(name, (1, 2, 3)))
        if size > len(relation.lhs):  # summed over particles, in the middle of a chain
            indices = [name for name in indices if name not in ranges]
        return [(name, ranges.get(name, (1, 2, 3))) for name in indices]

    def sides(self, relation: Relation) -> list[str]:
        """Return the code of the left and the right side of a relation, with free indices as variables.

        Where the model has a function of indices, both are code of the matrix (N, 1) of all N components.
        """
        tree, indices = parse(relation.text)[0], tuple(name for name, _ in self.loops(relation))
        try:
            return [self.code(side, indices) for side in (tree.left, tree.comparators[0])]
        except _NoFormulaError:
            return [self.plain(sympy.Matrix(side)) for side in (relation.lhs, relation.rhs)]

    def difference(self, relation: Relation, *, reverse: bool = False) -> str:
        """Return the code of left side - right side, or of right - left if ``reverse``; a right side 0 is left out."""
        lhs, rhs = self.sides(relation)
        if is_zero(parse(relation.text)[0].comparators[0]):
            return f"-({lhs})" if reverse else lhs
        lhs, rhs = (rhs, lhs) if reverse else (lhs, rhs)
        return ast.unparse(ast.parse(f"({lhs}) - ({rhs})", mode="eval"))

    def code(self, node: ast.expr, bound: tuple[str, ...]) -> str:
        """Return a formula as Python; indices in ``bound`` are variables of loops around it, all others are summed.

        Raises _NoFormulaError as `call` and `name` do.
        """
        return ast.unparse(ast.fix_missing_locations(self.formula(node, bound)))

    def formula(self, node: ast.expr, bound: tuple[str, ...]) -> ast.expr:
        """Return the syntax tree in Python of a formula in plain letters, as `Reader.value` understands the formula.

        Indices outside ``bound`` are summed by a `sum` over a generator; quotients of two numbers become Rational.
        """
        if is_sum(node):
            return ast.BinOp(self.formula(node.left, bound), node.op, self.formula(node.right, bound))
        if isinstance(node, ast.UnaryOp):
            return ast.UnaryOp(node.op, self.formula(node.operand, bound))
        operands = list(factors(node))
        sums = sorted(self.reader.summed(operands, names(node) - set(bound)))
        (product, _), *further_factors = [
            (self.factor(factor_tree, (*bound, *sums)), divides) for factor_tree, divides in operands
        ]
        for factor, divides in further_factors:
            if divides and not {*_words(product), *_words(factor)}:
                product = ast.Call(ast.Name("Rational"), [product, factor], [])
            else:
                product = ast.BinOp(product, ast.Div() if divides else ast.Mult(), factor)
        if not sums:
            return product
        loops = " ".join(f"for {name} in {self.reader.ranges.get(name, (1, 2, 3))}" for name in sums)
        value = self.value(node, bound)
        start = f", zeros{value.shape}" if isinstance(value, sympy.MatrixBase) else ""
        product = ast.fix_missing_locations(product)
        return _tree(f"sum(({ast.unparse(product)} {loops}){start})")

    def value(self, node: ast.expr, bound: tuple[str, ...]) -> Value:
        """Return the value of a formula, expression or matrix, with each index in ``bound`` at its first integer."""
        return self.reader.value(node, {name: self.reader.ranges.get(name, (1,))[0] for name in bound})

    def factor(  # noqa: PLR0911  one return for each kind of factor
        self, node: ast.expr, bound: tuple[str, ...]
    ) -> ast.expr:
        """Return the syntax tree in Python of one factor of a formula, as `Reader` understands the factor.

        Indices of vectors and matrices are less by one: Python counts from 0. ``bound`` as in `code`.
        """
        match node:
            case ast.Constant():
                return node
            case ast.Name():
                return self.name(node, bound)
            case ast.Subscript():
                indices = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
                basis = getattr(node.value, "id", "")
                if basis in {"eps", "delta"}:
                    return ast.Call(ast.Name(_CALLED[basis]), list(indices), [])
                is_shifted = not isinstance(self.model.letters.get(basis), dict)
                places = [_less(index) if is_shifted else index for index in indices]
                return ast.Subscript(
                    self.factor(node.value, bound), places[0] if len(places) == 1 else ast.Tuple(places)
                )
            case ast.BinOp(op=ast.Pow()):
                value = self.value(node.left, bound)
                base, power = self.formula(node.left, bound), self.formula(node.right, bound)
                if getattr(value, "shape", (1, 3))[1] == 1:  # a vector has no other power than its square
                    return ast.Call(ast.Attribute(base, "dot"), [base], [])
                if self.model.letters["inv"] is not COMMON["inv"] and isinstance(value, sympy.MatrixBase):
                    return _tree(f"({self.plain(self.value(node, ()))})")  # the model's own inverse
                return ast.BinOp(base, ast.Pow(), power)
            case ast.Call(func=ast.Name(id=name)):
                return self.call(node, name, bound)
            case ast.List():
                rows = [entry.elts if isinstance(entry, ast.List) else [entry] for entry in node.elts]
                lists: list[ast.expr] = [ast.List([self.formula(entry, bound) for entry in row]) for row in rows]
                return ast.Call(ast.Name("Matrix"), [ast.List(lists)], [])
        return self.formula(node, bound)

    def name(self, node: ast.Name, bound: tuple[str, ...]) -> ast.expr:
        """Return the syntax tree of a letter; unless it is an index, defined or common, it is added to `used`.

        ``bound`` are the indices of loops. Raises _NoFormulaError if the letter's value in the model is a function.
        """
        value = self.model.letters.get(node.id, sympy.Symbol(node.id, real=True))
        if node.id in bound or node.id in self.definitions:
            return node
        if value is COMMON.get(node.id):
            return _tree({"one": "eye(3)", "i": "sqrt(-1)"}.get(node.id, node.id))
        if callable(value) and not isinstance(value, sympy.Basic | sympy.MatrixBase):
            raise _NoFormulaError
        self.used[node.id] = value
        return node

    def call(self, node: ast.Call, name: str, bound: tuple[str, ...]) -> ast.expr:
        """Return the syntax tree of a function's call: SymPy's function or method, d(...), at0(...), or its value.

        ``name`` is the function's name, ``bound`` the indices of loops. A function of the model's own is replaced
        by its value; raises _NoFormulaError if it has an index of a loop.
        """
        vocabulary = {*_METHODS, *_CALLED, "T", "norm", "d", "d2", "at0"}
        if name not in vocabulary or (
            self.model.letters[name] is not COMMON.get(name) and name not in {"d", "d2", "at0"}
        ):
            if names(node) & set(bound):
                raise _NoFormulaError
            return _tree(f"({self.plain(self.reader.value(node, {}))})")
        argument_tree, *further_arguments = (self.formula(argument, bound) for argument in node.args)
        if name == "T":
            return ast.Attribute(argument_tree, "T")
        if name in _METHODS:
            return ast.Call(ast.Attribute(argument_tree, _METHODS[name]), further_arguments, [])
        if name == "norm":
            name, argument_tree = "sqrt", ast.Call(ast.Attribute(argument_tree, "dot"), [argument_tree], [])
        if name == "sqrt":  # a square in it is seen if it is factored
            argument_tree = ast.Call(ast.Name("factor"), [argument_tree], [])
        for _ in range(2 if name == "d2" else 1):
            argument_tree = ast.Call(
                ast.Name(_CALLED.get(name, name[:1] if name == "d2" else name)), [argument_tree, *further_arguments], []
            )
        return argument_tree


def _less(index: ast.expr) -> ast.expr:
    """Return the syntax tree of an index less one: indices of the paper count from 1."""
    if isinstance(index, ast.Constant):
        return ast.Constant(int(str(index.value)) - 1)
    return ast.BinOp(index, ast.Sub(), ast.Constant(1))


def _tree(text: str) -> ast.expr:
    return ast.parse(text, mode="eval").body


def _function_names(tree: ast.AST) -> set[str]:
    return {getattr(node.func, "id", "") for node in ast.walk(tree) if isinstance(node, ast.Call)}


def _words(node: ast.expr) -> set[str]:
    """Return the set of names in a formula: letters, indices and functions."""
    return {name.id for name in ast.walk(node) if isinstance(name, ast.Name)}
