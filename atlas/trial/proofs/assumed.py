r"""Holds the models of a trial against the assumptions of its entry.

A clause of an assumption that is one formula, or says that one thing differs from another, is read with the letters of
the trial. An equation must hold in each model that knows its letters, unless it gives a number to a free symbol, so
that the claim is tried for all its values. A relation with the same expression on both sides says nothing, and counts
as not read. A domain must be covered: points of the models that obey it come near its ends.
"""

import ast
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy

from atlas.trial.proofs import tex
from atlas.trial.proofs.identity import resolved, vanishes
from atlas.trial.proofs.model import Model
from atlas.trial.proofs.notation import Reader, Relation, letters_of, parse, write

POINTS, NEAR = 6000, 0.05
"""Points of a model, and how near one of them must come to an end of a domain, beside 1 and the sizes compared."""

_CLAUSE = re.compile(r"\$([^$]+)\$(?: (differs? from|is) (0|\d|\$[^$]+\$))?(?: \([^)]*\))?")


@dataclass(frozen=True)
class Read:
    """Clauses of an entry's assumptions, sorted by how they compare with the models of its trial.

    satisfied   relations in plain letters that are true in the models
    broken      relations that are false in a model, or domains that the points of the models do not come near
    unread      clauses, as worded in the ledger, that are not read as a relation
    special     triples (index of the model, symbol, number): relations that give a number to a symbol which is free in
                the model, so that the claim must have a value there
    """

    satisfied: tuple[str, ...]
    broken: tuple[str, ...]
    unread: tuple[str, ...]
    special: tuple[tuple[int, Any, Any], ...] = ()


def formulas(words: str) -> Iterator[tuple[str, str]]:
    r"""Yield pairs (clause, its formula in TeX) for the clauses of an assumption; the formula is "" where none is read.

    ``words`` is the assumption's text; clauses are separated by commas, semicolons or colons. "$a$ is $b$" becomes a=b,
    "$a$ differs from $b$" a \ne b.
    """
    for clause in re.split(r"[,;:] (?=(?:[^$]*\$[^$]*\$)*[^$]*$)", words):
        match = _CLAUSE.fullmatch(clause)
        if not match:
            yield clause, ""
        elif match[2]:
            yield clause, f"{match[1]}{'=' if match[2] == 'is' else chr(92) + 'ne '}{match[3].strip('$')}"
        else:
            yield clause, match[1]


def compare(
    assumptions: Sequence[str], signs: Mapping[str, str], models: Sequence[Model], excluded: Sequence[str]
) -> Read:
    """Sort the clauses of an entry's assumptions by whether they hold in the models of its trial; see `Read`.

    ``assumptions`` are the entry's texts, ``signs`` maps TeX of a letter to its plain letter. Clauses in ``excluded``
    count as unread: their letters have another meaning in the models.
    """
    satisfied, broken, unread = list[str](), list[str](), list[str]()
    special = list[tuple[int, Any, Any]]()
    domains: dict[int, list[tuple[str, Any, Any]]] = {}
    for clause, formula in (pair for words in assumptions for pair in formulas(words)):
        read = "" if clause in excluded else formula
        relations = [(n, relation) for n, model in enumerate(models) for relation in _relations(read, signs, model)]
        if not relations:
            unread.append(clause)
        for number, relation in relations:
            bindings = resolved(models[number].bindings)
            if _says_nothing(relation):
                unread.append(clause)
            elif relation.sign == "=" and _gives_number(relation, bindings):
                satisfied.append(relation.text)
                special.append((number, relation.lhs[0], relation.rhs[0]))
            elif relation.sign in {"=", "!="}:
                (satisfied if _vanish(relation, bindings) == (relation.sign == "=") else broken).append(relation.text)
            else:
                domains.setdefault(number, []).extend(_differences(relation, models[number]))
    for text, distance in _nearest(domains, models).items():
        (satisfied if distance < NEAR else broken).append(text)
    satisfied, broken, unread = (list(dict.fromkeys(texts)) for texts in (satisfied, broken, unread))
    return Read(tuple(satisfied), tuple(broken), tuple(unread), tuple(special))


def _nearest(domains: Mapping[int, list[tuple[str, Any, Any]]], models: Sequence[Model]) -> dict[str, float]:
    """Return by text of a relation the smallest distance, see `_distances`, of any model's points from its limit.

    ``domains`` maps the index of a model to its triples of `_differences`. Inf where no point obeys the relations.
    """
    nearest: dict[str, float] = {}
    for number, rows in domains.items():
        for text, distance in _distances(rows, models[number]):
            nearest[text] = min(distance, nearest.get(text, np.inf))
    return nearest


def _relations(formula: str, signs: Mapping[str, str], model: Model) -> list[Relation]:
    """Return the relations of a TeX formula in a model; [] where it is not read or has letters unknown there.

    ``signs`` maps TeX of a letter to its plain letter. Left out are relations with a letter whose symbol bears the
    name of another letter, as J1 is J2 in a symmetric top, since one can replace the other unnoticed. That two
    letters are equal is kept.
    """
    symbols = {str(s): s for v in model.letters.values() for s in getattr(v, "free_symbols", ())}
    letters = symbols | model.letters
    try:
        line = tex.line(formula, signs) if formula else ""
        trees = [tree for tree in parse(line) if set(letters_of(tree)) <= {*letters}] if line else []
        relations = Reader(letters, model.ranges).relations(write(trees)) if trees else []
    except (ValueError, TypeError, KeyError, AttributeError, IndexError, SyntaxError):
        return []
    double = {name for name, value in model.letters.items() if str(value) != name and _is_letter(value, model)}
    return [
        relation
        for relation in relations
        if not double.intersection(relation.letters) or re.fullmatch(r"\w+ \S+ \w+", relation.text)
    ]


def _is_letter(value: Any, model: Model) -> bool:
    """Whether a value is a symbol whose name is also a letter of the model, with this symbol as its value."""
    return isinstance(value, sympy.Symbol) and model.letters.get(str(value)) == value


def _says_nothing(relation: Relation) -> bool:
    """Whether a relation =, <= or >= has the same expression as typed on both sides, so that it holds always."""
    tree = parse(relation.text)[0]
    return relation.sign in {"=", "<=", ">="} and ast.dump(tree.left) == ast.dump(tree.comparators[0])


def _gives_number(relation: Relation, bindings: Mapping[Any, Any]) -> bool:
    """Whether a relation gives a number to its one letter, a symbol of the model that ``bindings`` do not determine."""
    symbol, value = relation.lhs[0], sympy.sympify(relation.rhs[0])
    is_free = isinstance(symbol, sympy.Symbol) and symbol not in bindings
    return is_free and len(relation.letters) == len(relation.lhs) == 1 and bool(value.is_number)


def _vanish(relation: Relation, bindings: dict[Any, Any]) -> bool:
    """Whether left - right of a relation vanishes identically in all components, with ``bindings`` inserted.

    ``bindings`` map symbols to values in free parameters.
    """
    pairs = zip(relation.lhs, relation.rhs, strict=True)
    return all(vanishes(sympy.sympify(a) - sympy.sympify(b), bindings) for a, b in pairs)


def _differences(relation: Relation, model: Model) -> Iterator[tuple[str, Any, Any]]:
    """Yield (text, difference, scale) for each component of an inequality: the difference is positive where it holds.

    The scale is 1 + |left| + |right|. Both are SymPy expressions in the model's free parameters.
    """
    bindings, sense = resolved(model.bindings), 1 if relation.sign in {">", ">="} else -1
    for a, b in zip(map(sympy.sympify, relation.lhs), map(sympy.sympify, relation.rhs), strict=True):
        yield relation.text, (sense * (a - b)).xreplace(bindings), (1 + abs(a) + abs(b)).xreplace(bindings)


def _distances(rows: list[tuple[str, Any, Any]], model: Model) -> Iterator[tuple[str, float]]:
    """Yield (text, distance) for each row: the smallest difference/scale among `POINTS` random points, dimensionless.

    ``rows`` are triples (text, difference, scale) of `_differences`. Only points at which no difference is negative
    count; the distance is inf if there is none.
    """
    symbols = sorted(set().union(*(x.free_symbols for _, *terms in rows for x in terms)), key=str)
    chance, columns = np.random.default_rng(1), []
    for symbol in symbols:
        domain = model.domains.get(str(symbol), "positive" if symbol.is_positive else "real")
        wide, narrow = 10 ** chance.uniform(-4, 4, POINTS), chance.uniform(0, 2.5, POINTS)
        signs = chance.choice((-1, 1), POINTS) if domain == "real" else 1
        values = np.where(chance.random(POINTS) < 0.5, wide, narrow) * signs
        columns.append({"unit": narrow / 2.5, "oblique": 0.41421 + 0.58579 * narrow / 2.5}.get(domain, values))
    with np.errstate(all="ignore"):
        tables = [
            [np.broadcast_to(np.real_if_close(x), (POINTS,)) for x in sympy.lambdify(symbols, terms, "numpy")(*columns)]
            for _, *terms in rows
        ]
        inside = np.all([value >= 0 for value, _ in tables], axis=0)
        for (text, *_), (value, size) in zip(rows, tables, strict=True):
            yield text, float(np.min((value / size)[inside], initial=np.inf))
