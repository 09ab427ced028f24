"""A proof as a script of plain SymPy, some twenty lines that run without atlas.

A script has what the letters of a line stand for, what their symbols are in free parameters, and the line itself with
its two sides. It expands the numerator of their difference, or puts in the exact point that refutes the line. The last
line that it prints says what is proved or refuted; its exit status is 1 if that is not so.
"""

import ast
import math
import re
import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import sympy
from sympy.printing.str import StrPrinter

from atlas.paper.plain import plain
from atlas.proof.decide import (
    Outcome,
    _defined,
    _parameters,
    _reached,
    _read,
    _simplest,
    breaks,
    completed,
    decide,
    points,
)
from atlas.proof.identity import ordered, positive, resolved
from atlas.proof.model import COMMON, Model
from atlas.proof.notation import Reader, Relation, _is_sum, _is_zero, factors, letters_of, names, parse
from atlas.proof.run import LIMIT, OverTimeError, limit, trial
from atlas.proof.trial import Part, Trial
from atlas.proof.verdict import Verdict

Value = Any

_WIDTH = 110
_LONG = 300  # letters of a polynomial that is written out
_METHODS = {"cross": "cross", "dot": "dot", "inv": "inv", "det": "det", "tr": "trace", "hat": "hat"}
_CALLED = {"eps": "LeviCivita", "delta": "KroneckerDelta", "ln": "log", "abs": "Abs"}
_CALLED |= {name: name for name in ("sin", "cos", "tan", "atan", "diag")}
_SYMPY = (
    *("Abs", "Integer", "KroneckerDelta", "LeviCivita", "Matrix", "QQ", "Rational", "atan", "cancel", "cos", "cosh"),
    *(
        "denom",
        "diag",
        "exp",
        "expand",
        "eye",
        "factor",
        "log",
        "numer",
        "pi",
        "ring",
        "sin",
        "sinh",
        "sqrt",
        "symbols",
    ),
    *("tan", "tanh", "together", "zeros"),
)
_OWN = {
    "at0",
    "check",
    "claims",
    "d",
    "failed",
    "flow",
    "left",
    "partial",
    "point",
    "right",
    "start",
    "vanishes",
    "where",
}
_HELPERS = {
    "vanishes": '''
def vanishes(x, meaning):
    """Whether a rational function of free parameters is 0: its numerator expands to nothing."""
    top = numer(together(numer(together(x)).xreplace(meaning)))
    letters = sorted(top.free_symbols, key=str)
    rational = letters and top.is_polynomial(*letters) and not top.has(sqrt(Integer(-1)))
    return not (ring(letters, QQ)[0].from_expr(top) if rational else expand(top))
''',
    "positive": '''
def positive(x, meaning):
    """Whether a function of letters of known sign is positive: as it stands, by factors, or term by term."""
    x = x.xreplace(meaning)
    y = factor(together(x))
    return any(f.is_positive for f in (x, y, expand(numer(y)) / expand(denom(y))))
''',
    "partial": '''
def partial(f, x):
    """Gradient of a number, or the Jacobian of a vector, by a vector of symbols; the derivative by one symbol."""
    if not hasattr(x, "shape"):
        return f.diff(x)
    return f.jacobian(x) if hasattr(f, "shape") else Matrix([f]).jacobian(x).T
''',
    "check": '''
failed = []
def check(claims, where=()):
    """Try both sides of each claim, with symbols as `where` says in free parameters."""
    meaning = {}
    for symbol, value in where:
        meaning[symbol] = cancel(value.xreplace(meaning))
    failed.extend(text for text, holds, left, right in claims
                  if not all(holds(a - b, meaning) for a, b in zip(left, right, strict=True)))
''',
}
_HELPERS["nonnegative"] = _HELPERS["positive"].replace("positive", "nonnegative")


_RATE = "def d(x): return sum((x.diff(s) * rate for s, rate in flow.items()), 0 * x)"
_START = "def at0(x): return x.subs(start, simultaneous=True)"


class _NoFormulaError(Exception):
    """A line has a function of the model's own over indices, so that its components are written out."""


_INTEGRATED = {"(19)", "text-short-cylinder"}  # their letters are integrals, taken when the model is made


def script_of(found: Verdict) -> str:
    """Return the script of an entry of the ledger on which this was found, or the line that says why there is none.

    It refutes the printed form where that is refuted, and proves the corrected one; otherwise the printed one.
    """
    case, outcome = trial(found.name), Outcome(found.verdict, found.method)
    if found.name in _INTEGRATED:
        return "No script: the moments are integrated before anything is compared."
    if case.check is not decide:
        return f"No script: {plain(outcome.method)}."
    try:
        return _script(case, outcome)
    except _NoFormulaError as reason:
        return f"No script: {reason}."


def _script(case: Trial, outcome: Outcome) -> str:
    name = case.name
    before = outcome.method in {"indices", "dimensions"}
    if outcome.decision == "undecided" or (before and not case.corrected_parts):
        raise _NoFormulaError(f"it is {outcome.decision} ({plain(outcome.method)}) before anything is computed")
    blocks, says = list[_Block](), [f"{name} as printed is refuted"]
    if before:
        says = [f"{name} as printed is refuted by its {outcome.method} before anything is computed"]
    elif outcome.decision == "refuted":
        blocks = [_refuted(case.parts)]
    else:
        blocks = _blocks("as printed", case.parts)
        says = [f"{name} {'is a definition that holds' if outcome.decision == 'definition' else 'is proved'}"]
    if case.corrected_parts:
        blocks += _blocks("corrected", case.corrected_parts)
        says.append("its corrected form is proved")
    body = "".join(block.text() for block in blocks)
    words = set(re.findall(r"\w+", body))
    whole = "".join(text for helper, text in _HELPERS.items() if helper in words) + body
    whole = whole if "check" in words else f"\nfailed = []\n{whole}"
    imported = ", ".join(word for word in _SYMPY if re.search(rf"(?<!\.)\b{word}\b", whole))
    head = f"# {name}, from {plain(case.follows)}\n{_wrapped(f'from sympy import ({imported})')}\n"
    tail = (
        f'\nprint("not so: " + "; ".join(failed) if failed else "{", ".join(says)}")\nraise SystemExit(bool(failed))\n'
    )
    return head + whole + tail


def sides_of(name: str) -> list[str]:
    """Return what both sides of each line of a true form are in free parameters, or what has its sign.

    None if that takes too long.
    """
    found: list[str] = []
    try:
        with limit(LIMIT):
            for block in [
                block for part in trial(name).true_parts if part.check is decide for block in _blocks("", [part])
            ]:
                where = resolved(block.model.where)
                found += [_sides(relation, where, block.printer) for relation in block.relations]
    except OverTimeError:
        return []
    return list(dict.fromkeys(found))


def _sides(relation: Relation, where: Mapping[Value, Value], printer: StrPrinter) -> str:
    """Return what the sides of a relation are, of several components of the first that is not 0."""
    pairs = [(sympy.sympify(a), sympy.sympify(b)) for a, b in zip(relation.left, relation.right, strict=True)]
    if relation.sign != "=":
        value = sympy.factor(sympy.together((pairs[0][0] - pairs[0][1]).xreplace(where)))
        return f"{relation.text}: left - right = {_short(value, printer)}"
    found = (sympy.cancel(left.xreplace(where)) for left, _ in pairs)
    entry, value = next(((n, value) for n, value in enumerate(found, 1) if value != 0), (1, sympy.Integer(0)))
    component = f", component {entry} of {len(pairs)}" if len(pairs) > 1 else ""
    if value != 0:
        return f"{relation.text}: each side{component} is {_short(value, printer)}"
    used = {symbol: meant for symbol, meant in where.items() if any(left.has(symbol) for left, _ in pairs)}
    meant = "; ".join(f"{printer.doprint(symbol)} = {_short(value, printer)}" for symbol, value in used.items())
    return f"{relation.text}: the left side becomes 0" + (f" with {meant}" if meant else "")


def _short(value: Value, printer: StrPrinter) -> str:
    """Return a rational function as text, or its size where that is long."""
    text = str(printer.doprint(value)).replace("**", "^")
    if len(text) <= _LONG:
        return text
    top, bottom = (sympy.Poly(side, *sorted(value.free_symbols, key=str)) for side in sympy.fraction(value))
    sizes = [f"a polynomial of {len(side.terms())} terms and degree {side.total_degree()}" for side in (top, bottom)]
    letters = ", ".join(printer.doprint(symbol) for symbol in top.gens)
    return f"{sizes[0]} in {letters}" + ("" if bottom.is_ground else f", over {sizes[1]}")


def _blocks(title: str, parts: Sequence[Part]) -> "list[_Block]":
    cases = [(part, model) for part in parts for model in _models(part)]
    each = f", case {{}} of {len(cases)}" if len(cases) > 1 else ""
    return [_Block(title + each.format(n), part, model) for n, (part, model) in enumerate(cases, 1)]


def _models(part: Part) -> Sequence[Model]:
    cases = part.model()
    return [cases] if isinstance(cases, Model) else list(cases)


def _refuted(parts: Sequence[Part]) -> "_Block":
    """Return the block of the first case that has a counterexample, with the point."""
    for part in parts:
        for model in _models(part):
            block = _Block("as printed", part, model)
            every = tuple(name for tree in block.trees for name in letters_of(tree))
            for free in points(_parameters(block.relations, block.model, every), block.model):
                values = completed(free, block.model)
                for relation in block.relations:
                    for entry in range(len(relation.left)):
                        if breaks(relation, entry, values):
                            block.broken = relation, entry, _simplest(relation, entry, free, block.model)
                            return block
    raise _NoFormulaError("there is no counterexample")


class _Printer(StrPrinter):  # type: ignore[misc]  # SymPy has no types
    """Prints an expression as Python: fractions exact, each symbol by its identifier, matrices on one line."""

    def __init__(self, identifier: Callable[[Value], str]) -> None:
        super().__init__()
        self.identifier = identifier

    def _print_Symbol(self, expr: Value) -> str:
        return self.identifier(expr)

    _print_Dummy = _print_Symbol

    def _print_ImaginaryUnit(self, expr: Value) -> str:
        del expr
        return "sqrt(Integer(-1))"  # I is the ratio of the moments

    def _print_Rational(self, expr: Value) -> str:
        return f"Rational({expr.p}, {expr.q})"

    def _print_MatrixBase(self, expr: Value) -> str:
        rows = [[self.doprint(entry) for entry in row] for row in expr.tolist()]
        inside = [row[0] for row in rows] if expr.shape[1] == 1 else [f"[{', '.join(row)}]" for row in rows]
        return f"Matrix([{', '.join(inside)}])"


class _Block:
    """One line in one case, as Python."""

    def __init__(self, title: str, part: Part, model: Model) -> None:
        self.title = title
        self.relations, letters, where = _read(part.line, model, tuple(part.defines), part.solves)
        self.model = replace(model, letters=letters, where=where)
        self.trees = [*parse(part.line), *(parse(part.solves) if part.solves else [])]
        self.broken: tuple[Relation, int, dict[Value, Value]] | None = None
        self.identifiers: dict[Value, str] = {}
        self.used: dict[str, Value] = {}  # letters of the model that stand in the text
        self.symbols: list[Value] = []
        self.printer = _Printer(self.identifier)
        self.reader = Reader(letters, model.ranges)
        self.definitions = {
            name: tree.comparators[0]
            for tree in parse(part.line)
            if (name := _defined(tree, part.defines)) and not _called(tree, part.defines)
        }
        own = {name for tree in self.trees for name in letters_of(tree)}
        self.taken = {*_SYMPY, *_OWN} | {name for name in own if not isinstance(letters.get(name), sympy.Symbol)}
        dicts = {name for name in own if isinstance(letters.get(name), dict)}
        self.first = 1 if dicts else 0

    def identifier(self, symbol: Value) -> str:
        """Return the identifier of a symbol: its name, with a stroke behind it where a letter has that name."""
        if symbol not in self.identifiers:
            name = re.sub(r"\W", "_", symbol.name)
            while name in self.taken or name in self.identifiers.values() or name in {"lambda", "in", "is", "as"}:
                name += "_"
            self.identifiers[symbol] = name
        return self.identifiers[symbol]

    def plain(self, value: Value) -> str:
        """Return a value as Python."""
        if isinstance(value, dict):
            return "{" + ", ".join(f"{key}: {self.plain(each)}" for key, each in value.items()) + "}"
        value = value if isinstance(value, sympy.MatrixBase) else sympy.sympify(value)
        self.symbols += [symbol for symbol in sorted(value.free_symbols, key=str) if symbol not in self.symbols]
        text = self.printer.doprint(value.as_immutable() if isinstance(value, sympy.MatrixBase) else value)
        return f"Integer({text})" if value.is_Matrix is not True and value.is_Integer else text

    def text(self) -> str:
        """Return the block: symbols, letters, rates, and what is claimed or refuted."""
        definitions = [f"{name} = {self.definition(name)}" for name in self.in_order()]
        ends = self.refutation(*self.broken) if self.broken else self.claimed()
        written = "\n".join([*definitions, *ends])
        lines = [f"{name} = {self.plain(value)}" for name, value in self.used.items() if self.is_said(name, value)]
        needed = _reached([*self.symbols, *(v for v in self.used.values() if isinstance(v, sympy.Symbol))], self.model)
        if re.search(r"\bd\(", written):
            lines += [f"flow = {self.table(self.model.flow, needed)}", _RATE]
        if "at0(" in written:
            lines += [f"start = {self.table(self.model.start, needed)}", _START]
        if not self.broken:
            where = ordered([(symbol, value) for symbol, value in self.model.where if symbol in needed])
            meaning = ", ".join(f"({self.plain(symbol)}, {self.plain(value)})" for symbol, value in where)
            ends[-1] = f"], where=[{meaning}])" if where else ends[-1]
        every = [*self.declared(), *lines, *definitions, *ends]
        return f"\n# {self.title}\n" + "\n".join(_wrapped(line) for line in every) + "\n"

    def definition(self, name: str) -> str:
        """Return what a letter is defined to be, as it is read or, with a function of the model's own, evaluated."""
        try:
            text = self.code(self.definitions[name])
            return f"Integer({text})" if text.isdigit() else text
        except _NoFormulaError:
            return self.plain(self.model.letters[name])

    def in_order(self) -> list[str]:
        """Return the letters that the line defines, each after those that its definition uses."""
        found: list[str] = []
        for _ in self.definitions:
            for name, tree in self.definitions.items():
                if name not in found and not (_words(tree) & set(self.definitions)) - {name, *found}:
                    found.append(name)
        if len(found) < len(self.definitions):
            raise _NoFormulaError("its letters are defined by one another")
        return found

    def is_said(self, name: str, value: Value) -> bool:
        """Whether a letter needs a line: not if it is the symbol of its name."""
        return not (isinstance(value, sympy.Symbol) and self.identifier(value) == name)

    def table(self, values: Mapping[Value, Value], needed: set[Value]) -> str:
        """Return a dictionary of symbols as Python."""
        found = [f"{self.plain(s)}: {self.plain(value)}" for s, value in values.items() if s in needed]
        return "{" + ", ".join(found) + "}"

    def declared(self) -> list[str]:
        """Return the lines that declare the symbols."""
        for value in self.used.values():
            if isinstance(value, sympy.Symbol):
                self.plain(value)
        kinds: dict[str, list[Value]] = {}
        for symbol in self.symbols:
            assumed = ("positive", "nonnegative", "nonzero", "real")
            strongest = [kind for kind in assumed if getattr(symbol, f"is_{kind}")][:1]
            extra = ["nonzero"] if strongest == ["nonnegative"] and symbol.is_nonzero else []
            kinds.setdefault("".join(f", {kind}=True" for kind in strongest + extra), []).append(symbol)
        lines = []
        for assumption, symbols in kinds.items():
            names_here = " ".join(self.identifier(symbol) for symbol in symbols)
            lines += [
                f"{some.replace(' ', ', ')} = symbols({_quoted(some)}{assumption})"
                for some in textwrap.wrap(names_here, _WIDTH // 2 - 16)
            ]
        return lines

    def claimed(self) -> list[str]:
        """Return the lines that check the claims."""
        found = []
        for relation in self.relations:
            left, right = self.sides(relation)
            holds, turned_round = self.holds(relation)
            left, right = (right, left) if turned_round else (left, right)
            found.append(f"    ({_quoted(relation.text)},\n     {holds}, {left},\n     {right}),")
        return ["check([", *found, "])"]

    def holds(self, relation: Relation) -> tuple[str, bool]:
        """Return the function that decides a relation, and whether of the right side less the left one."""
        if relation.sign == "=":
            return "vanishes", False
        strict = relation.sign not in {"<=", ">="}
        turned_round = relation.sign in {"<", "<="}
        if relation.sign == "!=":
            where = resolved(self.model.where)
            difference = sympy.sympify(relation.left[0] - relation.right[0]).xreplace(where)
            turned_round = not positive(difference, strict=True)
        return "positive" if strict else "nonnegative", turned_round

    def refutation(self, relation: Relation, entry: int, values: Mapping[Value, Value]) -> list[str]:
        """Return the lines that put in the point which breaks a relation."""
        left, right = (f"({side})[{entry}]" for side in self.sides(relation))
        sides = [sympy.sympify(side[entry]).free_symbols for side in (relation.left, relation.right)]
        point = {symbol: value for symbol, value in values.items() if symbol in set().union(*sides)}
        exact = all(value.is_Rational for value in point.values())
        digits = "" if exact else ".n(30)"
        sign = {"=": "=="}.get(relation.sign, relation.sign)
        text = f"point = {self.table(point, set(point))}"
        return [
            text,
            f"left, right = (side.xreplace(point){digits} for side in ({left}, {right}))",
            f'print({_quoted(relation.text)}, "has", left, "and", right, "at", point)',
            f"if left {sign} right: failed.append({_quoted('the point does not break ' + relation.text)})",
        ]

    def sides(self, relation: Relation) -> tuple[str, str]:
        """Return both sides of a relation as rows of components; as they were found where no formula can be given."""
        tree = parse(relation.text)[0]
        free = sorted(self.reader.free(tree.left) | (names(tree.left) & set(self.reader.ranges)))
        runs = math.prod(len(self.reader.ranges.get(name, (1, 2, 3))) for name in free)
        values = [self.value(side, tuple(free)) for side in (tree.left, tree.comparators[0])]
        if runs * max(len(value) if isinstance(value, sympy.MatrixBase) else 1 for value in values) > len(
            relation.left
        ):
            free = [name for name in free if name not in self.reader.ranges]  # summed, in the middle of a chain
        try:
            left, right = (self.row(side, free, len(relation.left)) for side in (tree.left, tree.comparators[0]))
        except _NoFormulaError:
            left, right = (
                "[" + ", ".join(self.plain(value) for value in side) + "]" for side in (relation.left, relation.right)
            )
        return left, right

    def row(self, side: ast.expr, free: Sequence[str], count: int) -> str:
        """Return one side as a row of components."""
        if _is_zero(side):
            return f"[Integer(0)] * {count}" if count > 1 else "[Integer(0)]"
        is_matrix = self.columns(side, tuple(free)) > 0
        loops = "".join(f" for {name} in {self.range(name)}" for name in free)
        code = self.code(side, tuple(free))
        if not free:
            return code if is_matrix else f"[{code}]"
        return f"[entry{loops} for entry in {code}]" if is_matrix else f"[{code}{loops}]"

    def range(self, name: str) -> str:
        """Return the range of an index."""
        if name in self.reader.ranges:
            return str(self.reader.ranges[name])
        return "(1, 2, 3)" if self.first else "range(3)"

    def code(self, node: ast.expr, bound: tuple[str, ...] = ()) -> str:
        """Return a formula as Python; indices in `bound` are variables of loops around it, all others are summed."""
        return ast.unparse(ast.fix_missing_locations(self.formula(node, bound)))

    def formula(self, node: ast.expr, bound: tuple[str, ...]) -> ast.expr:
        """Return the syntax tree of a formula in Python, as `Reader.value` understands it."""
        if _is_sum(node):
            return ast.BinOp(self.formula(node.left, bound), node.op, self.formula(node.right, bound))
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            return ast.UnaryOp(ast.USub(), self.formula(node.operand, bound))
        parts = list(factors(node))
        sums = []
        for name in sorted(names(node) - set(bound)):
            holders = [part for part, _ in parts if name in names(part)]
            if len(holders) > 1 or not _is_sum(holders[0]):
                sums.append(name)
        inside = (*bound, *sums)
        first, *others = [(self.factor(part, inside), divides) for part, divides in parts]
        result = first[0]
        for factor, divides in others:
            if divides and not {*_words(result), *_words(factor)}:
                result = ast.Call(ast.Name("Rational"), [result, factor], [])
            else:
                result = ast.BinOp(result, ast.Div() if divides else ast.Mult(), factor)
        if not sums:
            return result
        loops = [
            ast.comprehension(ast.Name(name), ast.parse(self.range(name), mode="eval").body, [], 0) for name in sums
        ]
        value = self.value(node, bound)
        start = [ast.Name(f"zeros{value.shape}")] if isinstance(value, sympy.MatrixBase) else []
        return ast.Call(ast.Name("sum"), [ast.GeneratorExp(result, loops), *start], [])

    def value(self, node: ast.expr, bound: tuple[str, ...]) -> Value:
        """Return the value of a formula where all indices are the first ones."""
        return self.reader.value(node, {name: self.reader.ranges.get(name, (1,))[0] for name in bound})

    def columns(self, node: ast.expr, bound: tuple[str, ...]) -> int:
        """Return the number of columns of a vector or a matrix, 0 for a number."""
        value = self.value(node, bound)
        return value.shape[1] if isinstance(value, sympy.MatrixBase) else 0

    def factor(  # noqa: PLR0911  one return for each kind of factor
        self, node: ast.expr, bound: tuple[str, ...]
    ) -> ast.expr:
        """Return the syntax tree of a factor in Python, as `Reader` understands it."""
        match node:
            case ast.Constant():
                return node
            case ast.Name():
                return self.name(node, bound)
            case ast.Subscript():
                return self.entry(node, bound)
            case ast.BinOp(op=ast.Pow()):
                base, power = self.formula(node.left, bound), self.formula(node.right, bound)
                if self.columns(node.left, bound) == 1:  # a vector has no other power than its square
                    return ast.Call(ast.Attribute(base, "dot"), [base], [])
                if self.model.letters["inv"] is not COMMON["inv"] and self.columns(node.left, bound) > 1:
                    return ast.Name(f"({self.plain(self.value(node, ()))})")  # the model's own inverse
                return ast.BinOp(base, ast.Pow(), power)
            case ast.Call(func=ast.Name(id=name)):
                return self.call(node, name, bound)
            case ast.List():
                rows = [entry.elts if isinstance(entry, ast.List) else [entry] for entry in node.elts]
                lists = [[self.formula(entry, bound) for entry in row] for row in rows]
                column = all(len(row) == 1 for row in lists)
                inside: list[ast.expr] = [row[0] if column else ast.List(row) for row in lists]
                return ast.Call(ast.Name("Matrix"), [ast.List(inside)], [])
        return self.formula(node, bound)

    def name(self, node: ast.Name, bound: tuple[str, ...]) -> ast.expr:
        """Return a letter, and note that it is used."""
        if node.id in bound:
            return node if self.first else ast.BinOp(node, ast.Add(), ast.Constant(1))
        if node.id in self.definitions:
            return node
        value = self.model.letters.get(node.id, sympy.Symbol(node.id, real=True))
        if value is COMMON.get(node.id):
            return ast.Name({"one": "eye(3)", "i": "sqrt(Integer(-1))"}.get(node.id, node.id))
        if callable(value) and not isinstance(value, sympy.Basic | sympy.MatrixBase):
            raise _NoFormulaError
        self.used[node.id] = value
        return node

    def entry(self, node: ast.Subscript, bound: tuple[str, ...]) -> ast.expr:
        """Return what brackets choose; indices count from 0 but where a letter is a family of particles."""
        at = list(node.slice.elts) if isinstance(node.slice, ast.Tuple) else [node.slice]
        if isinstance(node.value, ast.Name) and node.value.id in {"eps", "delta"}:
            return ast.Call(ast.Name(_CALLED[node.value.id]), [self.place(index, bound, 0) for index in at], [])
        family = isinstance(node.value, ast.Name) and isinstance(self.model.letters.get(node.value.id), dict)
        places = [self.place(index, bound, 0 if family else 1) for index in at]
        base = self.factor(node.value, bound)
        return ast.Subscript(base, places[0] if len(places) == 1 else ast.Tuple(places))

    def place(self, index: ast.expr, bound: tuple[str, ...], shift: int) -> ast.expr:
        """Return an index, less what Python counts from."""
        if isinstance(index, ast.Constant):
            return ast.Constant(int(str(index.value)) - shift)
        if isinstance(index, ast.Name) and index.id in bound:
            return ast.BinOp(index, ast.Sub(), ast.Constant(1)) if self.first and shift else index
        raise _NoFormulaError

    def call(  # noqa: PLR0911  one return for each kind of function
        self, node: ast.Call, name: str, bound: tuple[str, ...]
    ) -> ast.expr:
        """Return a call of a function: SymPy's own, a rate, or what the model's own function gives."""
        own = self.model.letters.get(name)
        if name in {"d", "d2", "at0"}:
            inside: ast.expr = self.formula(node.args[0], bound)
            for _ in range(2 if name == "d2" else 1):
                inside = ast.Call(ast.Name(name[:1] if name != "at0" else name), [inside], [])
            return inside
        if own is not COMMON.get(name) or name not in {*_METHODS, *_CALLED, "T", "norm", "sqrt", "partial"}:
            if set(names(node)) & set(bound):
                raise _NoFormulaError
            return ast.Name(f"({self.plain(self.reader.value(node, {}))})")
        given = [self.formula(argument, bound) for argument in node.args]
        if name == "T":
            return ast.Attribute(given[0], "T")
        if name in _METHODS:
            return ast.Call(ast.Attribute(given[0], _METHODS[name]), given[1:], [])
        if name == "norm":
            given = [ast.Call(ast.Attribute(given[0], "dot"), [given[0]], [])]
        if name == "partial":
            return ast.Call(ast.Name(name), given, [])
        if name in {"sqrt", "norm"}:
            return ast.Call(ast.Name("sqrt"), [ast.Call(ast.Name("factor"), given, [])], [])
        return ast.Call(ast.Name(_CALLED[name]), given, [])


def _called(tree: ast.AST, defines: Sequence[str]) -> bool:
    """Whether a relation defines a function, as Q(u) = u^4 + a does."""
    return any(isinstance(part, ast.Call) and getattr(part.func, "id", "") in defines for part in ast.walk(tree))


def _words(node: ast.expr) -> set[str]:
    """Return the names in a formula."""
    return {part.id for part in ast.walk(node) if isinstance(part, ast.Name)}


def _quoted(text: str) -> str:
    """Return a string literal that is not broken over lines."""
    return f'"{text}"'.replace(" ", "\N{NO-BREAK SPACE}")


def _wrapped(line: str) -> str:
    """Break a long line at spaces, which are all within brackets."""
    found = []
    for row in line.split("\n"):
        brackets = not re.match(r"(?:def|from|check|print|if)\b|[ \]]|\w+ = \{", row) and len(row) > _WIDTH
        text = re.sub(r" = (.*)$", r" = (\1)", row, count=1) if brackets else row
        indent = " " * (len(row) - len(row.lstrip()))
        found += textwrap.wrap(
            text.lstrip(),
            _WIDTH,
            initial_indent=indent,
            subsequent_indent=f"{indent}    ",
            break_long_words=False,
            break_on_hyphens=False,
        )
    return "\n".join(found).replace("\N{NO-BREAK SPACE}", " ")
