"""A proof as a script of plain SymPy that runs without atlas, and its two sides as polynomials.

A script declares symbols, gives the letters of a line and the symbols their values in free parameters, and
expands the numerator of the difference of both sides, or puts in the exact point that refutes the line. Its
last line of output names what is proved or refuted; if a check fails the exit status is 1.
"""

import re
import textwrap
from collections.abc import Iterator, Sequence
from typing import Any

import sympy
from sympy.printing.str import StrPrinter

from atlas.trial.ledger.plain import plain
from atlas.trial.proofs.decide import breaks, completed, simplest
from atlas.trial.proofs.identity import ordered, positive, resolved, sign_forms
from atlas.trial.proofs.model import rotation
from atlas.trial.proofs.notation import Relation
from atlas.trial.proofs.python import Line
from atlas.trial.proofs.run import LIMIT, OverTimeError, limit, trial
from atlas.trial.proofs.trial import Part
from atlas.trial.proofs.verdict import Verdict

Value = Any

_WIDTH = 110
_LONG = 300  # letters of a polynomial that is written out
_CHECK = '''
def check(difference):
    """Stop unless a number, or each entry of a matrix, is 0: its numerator expands to nothing."""
    for x in Matrix([difference]):
        if expand(numer(together({top}))) != 0:
            raise SystemExit(f"not so: {{x}} is not 0")
'''
_WHERE = ".subs(where)"
_RATE = "def d(x): return sum((diff(x, s) * rate for s, rate in flow.items()), 0 * x)"
_START = "def at0(x): return x.subs(start, simultaneous=True)"
_FORMS = "{}", "factor(together({}))", "(expand(numer(together({0}))) / expand(denom(together({0}))))"

Rows = tuple[dict[str, str], list[str]]  # symbols with their assumptions, and the rows after them


def script_of(verdict: Verdict) -> str:
    """Return the Python script that proves or refutes an entry, or a sentence on why there is none.

    The script refutes the printed form where that is refuted, unless by its indices, and proves a corrected one;
    otherwise it proves the printed form. There is none for an undecided entry, or one refuted by its indices
    without a correction.
    """
    case = trial(verdict.name)
    if verdict.verdict == "undecided" or (verdict.method == "indices" and not case.corrected):
        return f"No script: it is {verdict.verdict} ({plain(verdict.method)}) before anything is computed."
    if verdict.verdict == "refuted":
        how = " by its indices" if verdict.method == "indices" else ""
        says, blocks = [f"{verdict.name} as printed is refuted{how}"], [] if how else [_refuted(case.parts)]
    else:
        says = [f"{verdict.name} {'is a definition that holds' if verdict.verdict == 'definition' else 'is proved'}"]
        blocks = [_proved(line) for line in _lines(case.parts)]
    if case.corrected:
        says.append("its corrected form is proved")
        blocks += [_proved(line) for line in _lines(case.corrected_parts)]
    body = list(_joined(blocks))
    top = f"numer(together(x)){_WHERE}" if "where = " in "\n".join(body) else "x"
    head = textwrap.wrap(f"# {verdict.name}, from {plain(verdict.follows)}", _WIDTH, subsequent_indent="# ")
    head += ["from sympy import *", *(_CHECK.format(top=top).split("\n") if "check(" in "\n".join(body) else [""])]
    return "\n".join(_wrapped(row) for row in [*head, *body, f'print("{", ".join(says)}")']) + "\n"


def _joined(blocks: Sequence[Rows]) -> Iterator[str]:
    """Yield the rows of a script for all blocks, without repetitions; each symbol is declared before its first use.

    A block is a pair (assumptions by symbol, rows), see `_stated`.
    """
    symbols, vocabulary, comment = dict[str, str](), dict[str, str](), ""
    supposed = [any(row.startswith("where = ") for row in rows) for _, rows in blocks]
    for (declared, rows), has_supposition in zip(blocks, supposed, strict=True):
        fresh = {name: assumed for name, assumed in declared.items() if symbols.get(name) != assumed}
        vocabulary = {} if fresh.keys() & symbols.keys() else vocabulary
        for assumed in dict.fromkeys(fresh.values()):
            every = " ".join(name for name in fresh if fresh[name] == assumed)
            for group in textwrap.wrap(every, _WIDTH // 2 - 16):
                yield f'{group.replace(" ", ", ")} = symbols("{group}"{assumed})'
        symbols |= fresh
        for row in [*["where = []"] * (any(supposed) and not has_supposition), *rows]:
            name = re.match(r"(?:def )?(\w+)(?= = |\(x\))", row)
            if row.startswith("# "):
                comment = row
                continue
            repeated = name and vocabulary.get(name[1]) == row and name[1] != "where"
            if not repeated:
                yield from filter(None, (comment, row))
            comment = ""
            if name and not repeated:  # rows that use the name are written again
                vocabulary = {
                    symbol: text for symbol, text in vocabulary.items() if not re.search(rf"\b{name[1]}\b", text)
                }
                vocabulary[name[1]] = row


def sides_of(name: str) -> list[str]:
    """Return a list of texts, one for each relation of an entry's true form, with the common value of its sides.

    ``name`` is the entry's exact name. The texts are those of `_sides`; the list is [] if they take longer than
    `LIMIT`.
    """
    sides: list[str] = []
    try:
        with limit(LIMIT):
            for line in _lines(trial(name).true_parts):
                sides += [_sides(relation, line) for relation in line.relations]
    except OverTimeError:
        return []
    return list(dict.fromkeys(sides))


def _sides(relation: Relation, line: Line) -> str:
    """Return "RELATION: each side is VALUE" in free parameters; of several components the first that is not 0.

    For an inequality the text is "RELATION: left - right = VALUE"; where all sides are 0 it names the values of the
    relation's symbols. ``line`` gives the bindings and the names.
    """
    bindings, printer = resolved(line.model.bindings), line.printer
    pairs = [(sympy.sympify(a), sympy.sympify(b)) for a, b in zip(relation.lhs, relation.rhs, strict=True)]
    if relation.sign != "=":
        value = sympy.factor(sympy.together((pairs[0][0] - pairs[0][1]).xreplace(bindings)))
        return f"{relation.text}: left - right = {_short(value, printer)}"
    values = (sympy.cancel(expression.xreplace(bindings)) for expression, _ in pairs)
    entry, value = next(((n, value) for n, value in enumerate(values, 1) if value != 0), (1, sympy.Integer(0)))
    component = f", component {entry} of {len(pairs)}" if len(pairs) > 1 else ""
    if value != 0:
        return f"{relation.text}: each side{component} is {_short(value, printer)}"
    used = {
        symbol: value for symbol, value in bindings.items() if any(expression.has(symbol) for expression, _ in pairs)
    }
    assignments = "; ".join(f"{printer.doprint(symbol)} = {_short(value, printer)}" for symbol, value in used.items())
    return f"{relation.text}: the left side becomes 0" + (f" with {assignments}" if assignments else "")


def _short(value: Value, printer: StrPrinter) -> str:
    """Return a rational function as text; beyond `_LONG` letters, its numbers of terms and its degrees in words.

    ``printer`` gives the names of the symbols.
    """
    text = str(printer.doprint(value)).replace("**", "^")
    if len(text) <= _LONG:
        return text
    top, bottom = (sympy.Poly(side, *sorted(value.free_symbols, key=str)) for side in sympy.fraction(value))
    sizes = [f"a polynomial of {len(side.terms())} terms and degree {side.total_degree()}" for side in (top, bottom)]
    letters = ", ".join(printer.doprint(symbol) for symbol in top.gens)
    return f"{sizes[0]} in {letters}" + ("" if bottom.is_ground else f", over {sizes[1]}")


def _lines(statements: Sequence[Part]) -> list[Line]:
    return [Line(line.line, model, line.defines, line.solves) for line in statements for model in line.cases]


def _proved(line: Line) -> Rows:
    """Return (assumptions by symbol, rows of a script) that check all relations of a line in one model.

    Rows that state the premises come first, see `_stated`.
    """
    bindings, rows = resolved(line.model.bindings), list[str]()
    for relation in line.relations:
        indent = ""
        for index, numbers in line.loops(relation):
            rows.append(f"{indent}for {index} in {numbers}:")
            indent += "    "
        value = sympy.sympify(relation.lhs[0] - relation.rhs[0]).xreplace(bindings)
        reverse = relation.sign in {"<", "<="} or (relation.sign == "!=" and not positive(value, strict=True))
        difference = line.difference(relation, reverse=reverse)
        if relation.sign == "=":
            rows.append(f"{indent}check({difference})")
            continue
        strict = relation.sign not in {"<=", ">="}
        form = _FORMS[sign_forms(-value if reverse else value, strict=strict).index(True)]
        kind = "is_positive" if strict else "is_nonnegative"
        rows += [f"{indent}if not {form.format(f'({difference}){_WHERE}')}.{kind}:"]
        rows += [f'{indent}    raise SystemExit("not so: {relation.text}")']
    return _stated(line, rows)


def _refuted(statements: Sequence[Part]) -> Rows:
    """Return (assumptions by symbol, rows of a script) that evaluate both sides at a point which refutes a line.

    Raises ValueError if no point refutes any of the lines.
    """
    for line in _lines(statements):
        for assignment in line.points():
            values = completed(assignment, line.model)
            for relation in line.relations:
                for entry in range(len(relation.lhs)):
                    if breaks(relation, entry, values):
                        return _broken(line, relation, entry, simplest(relation, entry, assignment, line.model))
    raise ValueError("there is no counterexample")


def _broken(line: Line, relation: Relation, entry: int, values: dict[Value, Value]) -> Rows:
    numbers = line.loops(relation)
    runs = 1
    for _, choice in numbers:
        runs *= len(choice)
    components = len(relation.lhs) // runs
    rows, run = list[str](), entry // components
    for index, choice in reversed(numbers):
        rows.insert(0, f"{index} = {choice[run % len(choice)]}")
        run //= len(choice)
    sides = [
        f"({side})[{entry % components}]" if components > 1 and side != "0" else f"({side})"
        for side in line.sides(relation)
    ]
    letters = set().union(*(sympy.sympify(side[entry]).free_symbols for side in (relation.lhs, relation.rhs)))
    point = {symbol: value for symbol, value in values.items() if symbol in letters}
    digits = "" if all(value.is_Rational for value in point.values()) else ".n(30)"
    sign = {"=": "=="}.get(relation.sign, relation.sign)
    rows += [
        f"point = {line.table(point)}",
        *(f"{name} = S{side}.subs(point){digits}" for name, side in zip(("left", "right"), sides, strict=True)),
        f'print("{relation.text} has", left, "and", right, "at", point)',
        f"if left {sign} right:",
        '    raise SystemExit("not so: the point does not break it")',
    ]
    return _stated(line, rows)


def _stated(line: Line, rows: Sequence[str]) -> Rows:
    """Return (assumptions by symbol, rows): ``rows`` after those that define letters, rates and values of symbols.

    The values are left out where a row sets `point`, since all symbols have numbers there.
    """
    definitions = [f"{name} = {line.definition(name)}" for name in line.in_order()]
    text = "\n".join([*definitions, *rows])
    letters = [f"{name} = {line.plain(value)}" for name, value in line.used.items() if line.is_said(name, value)]
    symbols = line.symbols_reached()
    if re.search(r"\bd\(", text):
        letters += [f"# the rates in flow: {line.model.laws}"] * bool(line.model.laws)
        letters += [f"flow = {line.table({s: v for s, v in line.model.flow.items() if s in symbols})}", _RATE]
    if "at0(" in text:
        letters += [f"start = {line.table({s: v for s, v in line.model.start.items() if s in symbols})}", _START]
    bindings = (
        [] if "point = " in text else [pair for pair in reversed(ordered(line.model.bindings)) if pair[0] in symbols]
    )
    rotation_rows, bindings = _rotation(line, bindings)
    pairs = ", ".join(f"({line.plain(symbol)}, {line.plain(value)})" for symbol, value in bindings)
    letters += [f"where = [{pairs}]"] * bool(bindings or rotation_rows) + rotation_rows
    rows = rows if bindings or rotation_rows else [row.replace(_WHERE, "") for row in rows]
    return line.assumptions(), [*letters, *definitions, *rows]


def _rotation(line: Line, bindings: list[tuple[Value, Value]]) -> tuple[list[str], list[tuple[Value, Value]]]:
    """Return (rows that make nine symbols a rotation matrix by Cayley's formula, the other bindings).

    If the bindings hold no rotation there are no rows, and all bindings are returned.
    """
    rotation_entries = [(symbol, value) for symbol, value in bindings if value in set(rotation())]
    if len(rotation_entries) < 9:
        return [], bindings
    rotation_entries.sort(key=lambda pair: str(pair[0]))
    symbols = ", ".join(line.plain(symbol) for symbol, _ in rotation_entries)
    line.symbols += [symbol for symbol in sympy.symbols("q1:4", real=True) if symbol not in line.symbols]
    rows = [
        f"C = Matrix([{', '.join(line.plain(q) for q in sympy.symbols('q1:4', real=True))}]).hat()",
        f"where += zip([{symbols}], ((eye(3) + C) * (eye(3) - C).inv()).applyfunc(cancel))",
    ]
    return rows, [pair for pair in bindings if pair not in rotation_entries]


def _wrapped(row: str) -> str:
    """Return a row of Python broken at spaces to at most `_WIDTH` characters a line; its spaces lie within brackets."""
    if len(row) <= _WIDTH:
        return row
    indent = " " * (len(row) - len(row.lstrip()))
    row = re.sub(r"^(\w+) = (?![\[{])(.*)$", r"\1 = (\2)", row)
    quoted = re.sub(r'"[^"]*"|raise S', lambda text: text[0].replace(" ", "\N{NO-BREAK SPACE}"), row)
    lines = textwrap.wrap(
        quoted.lstrip(),
        _WIDTH,
        initial_indent=indent,
        subsequent_indent=f"{indent}    ",
        break_long_words=False,
        break_on_hyphens=False,
    )
    return "\n".join(lines).replace("\N{NO-BREAK SPACE}", " ")
