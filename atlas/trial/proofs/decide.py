"""Decides whether a line holds in a model: an exact identity, an exact counterexample, or undecided.

Every model is made of rational functions of free parameters, so that `left = right` is a polynomial identity, which
`identity` decides. One exact rational point where the sides differ refutes it.
"""

import ast
import random
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

import sympy

from atlas.trial.proofs.identity import ordered, positive, resolved, vanishes
from atlas.trial.proofs.model import COMMON, Model, functions
from atlas.trial.proofs.notation import NoMeaningError, Reader, Relation, is_zero, letters_of, parse, write
from atlas.trial.proofs.verdict import Decision

Value = Any

SAMPLES = 5

_small = [Fraction(n, d) for d in (1, 2, 3, 4, 5) for n in range(1, 6)]
DOMAINS: dict[str, Callable[[random.Random], Fraction]] = {
    "real": lambda r: r.choice(_small) * r.choice((-1, 1)),
    "positive": lambda r: r.choice(_small),
    "unit": lambda r: Fraction(r.randint(1, 8), 9),
    "oblique": lambda r: Fraction(r.randint(9, 19), 20),  # tan(delta/2) for pi/4 < delta < pi/2
}
_SIMPLE: dict[str, tuple[Fraction | int, ...]] = {
    "real": (0, 1, 2),
    "positive": (1, 2, 3),
    "unit": (Fraction(1, 2), Fraction(1, 3)),
    "oblique": (Fraction(1, 2), Fraction(2, 3)),
}


@dataclass(frozen=True, slots=True)
class Outcome:
    """Decision on one line: `decision`, one of "proved", "refuted", "supported", "undecided".

    `method` is how it was found, or the reason for which the line is undecided. `counterexample` has texts by name: the
    letters at a point that refutes the line, "relation", "left" and "right"; {} unless the line is refuted.
    """

    decision: Decision
    method: str = ""
    counterexample: dict[str, str] = field(default_factory=dict)


def decide(
    line: str,
    cases: Model | Sequence[Model],
    *,
    defines: Sequence[str] = (),
    solves: str = "",
    sample_only: bool = False,
    shrink: bool = False,
) -> Outcome:
    """Try a line in a model, or in each of several models; return an `Outcome`: proved only if proved in all of them.

    line         a line of `notation`: relations separated by ";"
    cases        a model, or the models of several cases
    defines      names on the left of `=` that the line defines: they are taken from it, not checked against the model
    solves       a second line that must hold with the definitions of the first one
    sample_only  look for a counterexample only, and say `supported` if there is none
    shrink       make the counterexample as simple as possible

    A line without a meaning in a model is refuted, with the reason as its counterexample; a line that checks nothing is
    undecided.
    """
    models = [cases] if isinstance(cases, Model) else list(cases)
    methods: list[str] = []
    for model in models:
        try:
            relations, letters, bindings = understood(line, model, tuple(defines), solves)
        except NoMeaningError as reason:
            return Outcome("refuted", "indices", reason.example)
        extended_model = replace(model, letters=letters, bindings=bindings)
        trees = parse(f"{line}; {solves}" if solves else line)
        example = _counterexample(
            relations, extended_model, tuple(name for tree in trees for name in letters_of(tree)), shrink=shrink
        )
        if example:
            return Outcome("refuted", "exact counterexample", example)
        idle = (
            _unknown(trees, model, defines)
            or next((why for tree in trees if (why := _empty(tree, extended_model))), "")
            or _idle(relations, extended_model, tuple(defines), f"{line}; {solves}" if solves else line)
        )
        if idle:
            return Outcome("undecided", idle)
        methods += [] if sample_only else [_prove(relation, extended_model) for relation in relations]
    if sample_only:
        return Outcome("supported", f"{SAMPLES * len(models)} exact points")
    if methods and all(methods):
        return Outcome("proved", ", ".join(dict.fromkeys(methods)))
    return Outcome("undecided", "neither proved nor refuted")


def understood(
    line: str, model: Model, defines: tuple[str, ...], solves: str
) -> tuple[list[Relation], dict[str, Value], list[tuple[Value, Value]]]:
    """Return (relations to check, letters, bindings) of a line in a model.

    Letters (name -> value) and bindings, pairs (symbol, value), are those of the model with the line's definitions
    added, those of the letters ``defines``; the relations include those of ``solves``. Raises NoMeaningError for a
    line that has no values in the model.
    """
    try:
        return _understand(line, model, defines, solves)
    except NoMeaningError:
        raise
    except (TypeError, AttributeError, IndexError, KeyError, ValueError, SyntaxError) as reason:
        raise NoMeaningError(f"the formula has no meaning: {reason}") from reason


def _understand(
    line: str, model: Model, defines: tuple[str, ...], solves: str
) -> tuple[list[Relation], dict[str, Value], list[tuple[Value, Value]]]:
    letters, bindings = dict(model.letters), list(model.bindings)
    claims, already = [], set[str]()
    for tree in parse(line):
        letters |= _function(tree, defines, Reader(letters, model.ranges))
        name = defined(tree, defines)
        if name in already:
            raise NoMeaningError(f"{name} is defined twice")
        if name:
            already.add(name)
            tree.left, tree.ops = tree.comparators.pop(0), tree.ops[1:]
            value = Reader(letters, model.ranges).value(tree.left, {})
            bindings, letters[name] = _bindings_of(name, value, letters) + bindings, value
        if tree.comparators:
            claims.append(tree)
    reader = Reader(letters, model.ranges)
    relations = reader.relations(write(claims)) if claims else []
    new = [entry for place, entry in enumerate(bindings) if entry[0] not in {symbol for symbol, _ in bindings[:place]}]
    return relations + (reader.relations(solves) if solves else []), letters, new


def defined(tree: ast.Compare, defines: tuple[str, ...]) -> str:
    """Return the letter of ``defines`` that an equation or chain defines at its first or last place; "" without one.

    A definition at the last place is moved to the left of the tree, in place.
    """
    every = [tree.left, *tree.comparators]
    if not all(isinstance(sign, ast.Eq) for sign in tree.ops):
        return ""
    if getattr(tree.left, "id", None) not in defines and getattr(every[-1], "id", None) in defines:
        tree.left, *tree.comparators = reversed(every)
    name = getattr(tree.left, "id", "")
    return name if name in defines and tree.comparators else ""


def _bindings_of(name: str, value: Value, letters: Mapping[str, Value]) -> list[tuple[Value, Value]]:
    """Return pairs (symbol, value) that replace the letter ``name`` where it stands before its definition as ``value``.

    There is one pair for each entry of a vector or matrix, and none where the letter's value in ``letters`` is no
    symbol.
    """
    vocabulary = letters.get(name, sympy.Symbol(name, real=True))
    if isinstance(vocabulary, sympy.MatrixBase):
        pairs = list(zip(vocabulary, value, strict=True))
    else:
        pairs = [(vocabulary, value)] if isinstance(value, sympy.Expr) else []
    return pairs if all(isinstance(symbol, sympy.Symbol) for symbol, _ in pairs) else []


def _function(tree: ast.Compare, defines: tuple[str, ...], reader: Reader) -> dict[str, Value]:
    """Return the function that a line defines and its derivatives, {} if no side is a function named in ``defines``.

    The line d(u)^2 = Q(u) = u^4 + a with Q in ``defines`` gives a dict of four functions by name, Q, dQ, ddQ, dddQ, see
    `functions`: Q has the value of the side behind Q(u), or of the last one left. The tree is changed in place to
    d(u)^2 = u^4 + a. Raises NoMeaningError if that side does not contain the variable u.
    """
    every = [tree.left, *tree.comparators] if all(isinstance(sign, ast.Eq) for sign in tree.ops) else []
    for place, side in enumerate(every):
        match side:
            case ast.Call(func=ast.Name(id=name), args=[ast.Name(id=variable)]) if name in defines:
                del every[place]
                value = reader.value(every[min(place, len(every) - 1)], {})
                tree.left, *tree.comparators = every
                tree.ops = tree.ops[1:]
                symbol = reader.letters.get(variable, sympy.Symbol(variable, real=True))
                if not isinstance(symbol, sympy.Symbol) or not value.has(symbol):
                    raise NoMeaningError(f"{name} does not depend on {variable}")
                return functions(name, value, symbol)
    return {}


def _unknown(trees: list[ast.Compare], model: Model, defines: Iterable[str]) -> str:
    """Return a sentence on a letter without a meaning in the model, or on a repetition; "" if there is neither.

    ``trees`` are the relations of a line, ``defines`` the letters that the line defines. A repetition is a
    statement made twice, two equal sides, or a bracket or vector product of a letter with itself.
    """
    vocabulary = {*defines, *model.letters} | {str(symbol) for symbol, _ in model.bindings}
    vocabulary |= {str(symbol) for value in model.letters.values() for symbol in getattr(value, "free_symbols", ())}
    unknown_letters = {name for tree in trees for name in letters_of(tree)} - vocabulary
    if unknown_letters:
        return f"unreadable: {', '.join(sorted(unknown_letters))} means nothing here"
    calls = [node for tree in trees for node in ast.walk(tree) if isinstance(node, ast.Call)]
    pairs = [call.args for call in calls if _name(call) in {"br", "cross"}]  # zero, whatever stands in them
    every: list[Sequence[ast.AST]] = [trees, *([tree.left, *tree.comparators] for tree in trees), *pairs]
    if any(len(set(map(ast.dump, indices))) < len(indices) for indices in every):
        return "it says the same twice, or of something that it is itself"
    return ""


def _empty(tree: ast.Compare, model: Model) -> str:
    """Return a sentence on a relation "... = 0" of a line that says too little in the model; "" for a sound relation.

    ``tree`` is the relation's syntax tree. The relation says too little where a bracket or derivative has a number
    as index (only one component), where a derivative is taken of independent symbols, or where d2(x) = 0 although
    d(x) = 0.
    """
    if not is_zero(tree.comparators[-1]) or not isinstance(tree.ops[-1], ast.Eq):
        return ""
    if isinstance(tree.left, ast.Call) and _name(tree.left) == "d2":
        rate = ast.Compare(ast.Call(ast.Name("d"), tree.left.args, []), [ast.Eq()], [ast.Constant(0)])
        if all(_prove(relation, model) for relation in Reader(model.letters, model.ranges).relations(write([rate]))):
            return f"{ast.unparse(tree.left)} is the rate of zero"
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call) and _name(node) in {"br", "partial"}]
    for call in calls:
        if any(isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Constant) for node in ast.walk(call)):
            return f"{ast.unparse(call)} is said of one index only"
        argument = getattr(call.args[0], "value", call.args[0])
        value = model.letters.get(getattr(argument, "id", ""))
        vectors = list(value.values()) if isinstance(value, dict) else [value]
        bare = isinstance(vectors[0], sympy.MatrixBase) and all(entry.is_Symbol for entry in vectors[0])
        if _name(call) == "partial" and bare:
            return f"{ast.unparse(argument)} depends on nothing"
    return ""


def _name(call: ast.Call) -> str:
    return getattr(call.func, "id", "")


def _idle(relations: list[Relation], model: Model, defines: tuple[str, ...], line: str) -> str:
    """Return a sentence if a line checks nothing, or defines a letter on which no checked relation depends; else ""."""
    if not relations:
        return "nothing in it is checked"
    named = {name for relation in relations for name in relation.letters}
    values = [side for relation in relations for side in (*relation.lhs, *relation.rhs)]
    all_reached = reached(values, [*model.bindings, *model.flow.items()])
    named |= {str(symbol) for symbol, _ in model.bindings if symbol in all_reached}
    for tree in reversed(parse(line)):  # a letter may be used in the definition of another one
        name = getattr(tree.left, "id", None)
        if name in defines and name not in named:
            return f"nothing that is checked depends on {name}"
        if name in defines:
            named |= {name for side in tree.comparators for name in letters_of(side)}
    return ""


def reached(values: Iterable[Value], rules: Sequence[tuple[Value, Value]]) -> set[Value]:
    """Return the set of symbols on which ``values`` depend, directly or through ``rules``.

    The rules are pairs (symbol, its value or rate).
    """
    symbols: set[Value] = set().union(*(sympy.sympify(value).free_symbols for value in values))
    while True:
        extended = symbols | {
            s for symbol, value in rules if symbol in symbols for s in sympy.sympify(value).free_symbols
        }
        if extended == symbols:
            return symbols
        symbols = extended


def parameters(relations: list[Relation], model: Model, names: tuple[str, ...]) -> list[Value]:
    """Return the list, sorted by name, of the free parameters on which relations and the letters ``names`` depend."""
    values = [side for relation in relations for side in (*relation.lhs, *relation.rhs)]
    values += [
        model.letters[name] for name in names if isinstance(model.letters.get(name), sympy.Expr | sympy.MatrixBase)
    ]
    return sorted(reached(values, model.bindings) - {symbol for symbol, _ in model.bindings}, key=str)


def completed(values: dict[Value, Value], model: Model) -> dict[Value, Value]:
    """Return a copy of the point ``values`` (symbol -> number) with those bindings added that are numbers there."""
    point = dict(values)
    for symbol, value in ordered(model.bindings):
        value_there = sympy.sympify(value).xreplace(point)
        if not value_there.free_symbols:
            point[symbol] = value_there
    return point


def points(parameters: list[Value], model: Model) -> Iterator[dict[Value, Value]]:
    """Yield `SAMPLES` points: dictionaries from each of ``parameters`` to a random rational in its domain.

    The points are the same in every run.
    """
    chance = random.Random(20240)  # noqa: S311  points of a proof, not secrets
    for _ in range(SAMPLES):
        yield {s: sympy.Rational(DOMAINS[_domain(s, model)](chance)) for s in parameters}


def _domain(symbol: Value, model: Model) -> str:
    return model.domains.get(str(symbol), "positive" if symbol.is_positive else "real")


def _violated(sign: str, difference: Value) -> bool | None:
    """Return whether a relation with this ``sign``, such as "<=", is false for left - right = ``difference``.

    None if the difference has no value. One that is not rational is computed to 40 digits, and counts as 0 below 1e-30;
    one with an imaginary part above that violates any relation.
    """
    if difference.has(sympy.nan, sympy.zoo, sympy.oo, -sympy.oo):
        return None
    if not difference.is_Rational:
        number = sympy.N(sympy.expand(difference) if difference.has(sympy.I) else difference, 40)
        if not number.is_number or not number.is_finite:
            return None
        if not number.is_real and abs(number) > sympy.Float("1e-30"):
            return True
        difference = sympy.Integer(0) if abs(number) < sympy.Float("1e-30") else number
    broken = {
        "=": difference != 0,
        "!=": difference == 0,
        "<": difference >= 0,
        "<=": difference > 0,
        ">": difference <= 0,
        ">=": difference < 0,
    }
    return bool(broken[sign])


def _counterexample(relations: list[Relation], model: Model, names: tuple[str, ...], *, shrink: bool) -> dict[str, str]:
    """Return texts by name of a point that refutes a relation, see `_describe`; {} if none of the `points` does.

    A relation without a value at any of these points is refuted, too, with "no value: 0/0" as its sides. ``names`` are
    the letters to be shown, ``shrink`` makes the point as simple as possible.
    """
    valued = [False] * len(relations)
    assignment: dict[Value, Value] = {}
    for assignment in points(parameters(relations, model, names), model):
        values = completed(assignment, model)
        for number, relation in enumerate(relations):
            for entry in range(len(relation.lhs)):
                broken = breaks(relation, entry, values)
                valued[number] |= broken is not None
                if broken:
                    if shrink:
                        values = simplest(relation, entry, assignment, model)
                    return _describe(relation, entry, model, names, values)
    for number, relation in enumerate(relations):
        if not valued[number] and relation.lhs:
            simple_point = {symbol: sympy.Rational(_SIMPLE[_domain(symbol, model)][-2]) for symbol in assignment}
            described = _describe(relation, 0, model, names, completed(simple_point, model))
            return {**described, "left": "no value: 0/0", "right": "no value: 0/0"}
    return {}


def breaks(relation: Relation, entry: int, values: dict[Value, Value]) -> bool | None:
    """Return whether component ``entry``, from 0, of a relation is false at a point; None if it has no value there.

    ``values`` is the point, symbol -> number.
    """
    difference = sympy.sympify(relation.lhs[entry]).xreplace(values) - sympy.sympify(relation.rhs[entry]).xreplace(
        values
    )
    return _violated(relation.sign, difference)


def simplest(relation: Relation, entry: int, assignment: dict[Value, Value], model: Model) -> dict[Value, Value]:
    """Return a simpler point, symbol -> number, at which component ``entry`` of a relation is still false.

    Parameters of the counterexample ``assignment`` are replaced one by one by 0, 1, 2 or the like where that
    refutes, too; then the model's bindings are added, see `completed`.
    """
    for symbol in assignment:
        for value in _SIMPLE[_domain(symbol, model)]:
            simpler = {**assignment, symbol: sympy.Rational(value)}
            if breaks(relation, entry, completed(simpler, model)):
                assignment = simpler
                break
    return completed(assignment, model)


def _describe(
    relation: Relation, entry: int, model: Model, names: tuple[str, ...], values: dict[Value, Value]
) -> dict[str, str]:
    """Return texts by name of a point: each letter's value there, "relation", and its sides "left" and "right".

    ``values`` is the point, symbol -> number, ``entry`` the number of the component that fails, ``names`` are further
    letters to show. Of a letter with an index only entries that are not 0 are listed, then "any other NAME": "0".
    """
    texts: dict[str, str] = {}
    for name in dict.fromkeys((*relation.letters, *names)):
        value = model.letters.get(name, sympy.Symbol(name, real=True))
        if isinstance(value, dict):
            plain = any(isinstance(key, int) for key in value)
            family = {key: _show(v, values) for key, v in value.items() if isinstance(key, int) or not plain}
            not_zero = {key: described for key, described in family.items() if described.strip("[]0, ")}
            texts |= {
                f"{name}[{str(key).strip('()').replace(' ', '')}]": described for key, described in not_zero.items()
            }
            if len(not_zero) < len(family):
                texts[f"any other {name}"] = "0"
        elif isinstance(value, sympy.MatrixBase | sympy.Expr) and value.free_symbols <= set(values):
            texts[name] = _show(value, values)
    unnamed = set(model.letters) - set(COMMON) - set(texts)
    texts |= {str(symbol): _text(value) for symbol, value in values.items() if str(symbol) in unnamed}
    sides = [_text(sympy.sympify(side[entry]).xreplace(values)) for side in (relation.lhs, relation.rhs)]
    component = f" (component {entry + 1})" if len(relation.lhs) > 1 else ""
    return {**texts, "relation": relation.text + component, "left": sides[0], "right": sides[1]}


def _text(value: Value) -> str:
    if value.is_Rational:
        return str(value)
    return "no value" if value.has(sympy.nan, sympy.zoo, sympy.oo) else str(sympy.N(value, 17))


def _show(value: Value, values: dict[Value, Value]) -> str:
    if isinstance(value, sympy.MatrixBase):
        rows = [[_text(entry.xreplace(values)) for entry in row] for row in value.tolist()]
        return str([row[0] for row in rows] if value.shape[1] == 1 else rows).replace("'", "")
    return _text(sympy.sympify(value).xreplace(values))


def _prove(relation: Relation, model: Model) -> str:
    """Return the method that proves a relation: "polynomial identity" or "one sign throughout"; "" if it is not proved.

    "identity" is returned for a relation without components.
    """
    how = "identity"
    bindings = resolved(model.bindings)
    for lhs, rhs in zip(relation.lhs, relation.rhs, strict=True):
        difference = sympy.sympify(lhs) - sympy.sympify(rhs)
        if relation.sign == "=":
            how = "polynomial identity" if vanishes(difference, bindings) else ""
        else:
            value = difference.xreplace(bindings)
            signs = {">": [value], ">=": [value], "<": [-value], "<=": [-value], "!=": [value, -value]}[relation.sign]
            strict = relation.sign not in {"<=", ">="}
            how = "one sign throughout" if any(positive(sign, strict=strict) for sign in signs) else ""
        if not how:
            return ""
    return how
