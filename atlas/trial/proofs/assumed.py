r"""Holds the models of a trial against the assumptions of its entry.

A clause of an assumption that is one formula, or says that one thing differs from another, is read with the letters of
the trial. An equation must hold in each model that knows its letters, unless they are independent there, so that the
claim is tried for all their values. A domain must be covered: points of the models that obey it come near its ends.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy

from atlas.trial.proofs import tex
from atlas.trial.proofs.identity import resolved, vanishes
from atlas.trial.proofs.model import Model
from atlas.trial.proofs.notation import NoMeaningError, Reader, Relation, letters_of, parse, write

POINTS, NEAR = 6000, 0.05
"""Points of a model, and how near one of them must come to an end of a domain, beside 1 and the sizes compared."""

_CLAUSE = re.compile(r"\$([^$]+)\$(?: (differs? from|is) (0|\d|\$[^$]+\$))?(?: \([^)]*\))?")


@dataclass(frozen=True)
class Read:
    """Assumptions of an entry: true in the models, false there, not read; and (model, symbol, value) of special cases.

    A special case is an equation for a symbol that is free in the model, so that the claim must have a value there.
    """

    kept: tuple[str, ...]
    broken: tuple[str, ...]
    left: tuple[str, ...]
    special: tuple[tuple[int, Any, Any], ...] = ()


def formulas(words: str) -> Iterator[tuple[str, str]]:
    """Yield the clauses of an assumption, each with its formula, empty where it is none that can be read."""
    for clause in re.split(r"[,;:] (?=(?:[^$]*\$[^$]*\$)*[^$]*$)", words):
        found = _CLAUSE.fullmatch(clause)
        if not found:
            yield clause, ""
        elif found[2]:
            yield clause, f"{found[1]}{'=' if found[2] == 'is' else chr(92) + 'ne '}{found[3].strip('$')}"
        else:
            yield clause, found[1]


def held(assumptions: Sequence[str], signs: Mapping[str, str], models: Sequence[Model], apart: Sequence[str]) -> Read:
    """Hold models against assumptions, but for the clauses `apart`, whose letters mean something else."""
    kept, broken, left = list[str](), list[str](), list[str]()
    special = list[tuple[int, Any, Any]]()
    domains: dict[int, list[tuple[str, Any, Any]]] = {}
    for clause, formula in (pair for words in assumptions for pair in formulas(words)):
        read = "" if clause in apart else formula
        relations = [(n, each) for n, model in enumerate(models) for each in _relations(read, signs, model)]
        if not relations:
            left.append(clause)
        for number, relation in relations:
            if relation.sign == "=":
                bindings = resolved(models[number].bindings)
                free = not _vanish(relation, bindings)
                (broken if free and not _independent(relation, models[number], bindings) else kept).append(
                    relation.text
                )
                special += [(number, relation.left[0], relation.right[0])] * free
            elif relation.sign == "!=":
                (broken if _vanish(relation, resolved(models[number].bindings)) else kept).append(relation.text)
            else:
                domains.setdefault(number, []).extend(_sides(relation, models[number]))
    for text, distance in _nearest(domains, models).items():
        (kept if distance < NEAR else broken).append(text)
    kept, broken, left = (list(dict.fromkeys(texts)) for texts in (kept, broken, left))
    return Read(tuple(kept), tuple(broken), tuple(left), tuple(special))


def _nearest(domains: Mapping[int, list[tuple[str, Any, Any]]], models: Sequence[Model]) -> dict[str, float]:
    """Return how near points of any model come to the end of each domain."""
    nearest: dict[str, float] = {}
    for number, rows in domains.items():
        for text, distance in _distances(rows, models[number]):
            nearest[text] = min(distance, nearest.get(text, np.inf))
    return nearest


def _relations(formula: str, signs: Mapping[str, str], model: Model) -> list[Relation]:
    """Return the relations of a formula in a model; none where it is not read or has letters unknown there."""
    symbols = {str(s): s for v in model.letters.values() for s in getattr(v, "free_symbols", ())}
    letters = symbols | model.letters
    try:
        line = tex.line(formula, signs) if formula else ""
        trees = [tree for tree in parse(line) if set(letters_of(tree)) <= {*letters}] if line else []
        return Reader(letters, model.ranges).relations(write(trees)) if trees else []
    except (tex.UnreadableError, NoMeaningError, TypeError, KeyError, AttributeError, IndexError, SyntaxError):
        return []


def _independent(relation: Relation, model: Model, bindings: dict[Any, Any]) -> bool:
    """Whether the letters of an equation are different free symbols of a model."""
    values = [model.letters.get(name, sympy.Symbol(name, real=True)) for name in relation.letters]
    single = "(" not in relation.text and all(isinstance(x, sympy.Symbol) and x not in bindings for x in values)
    return single and len(set(values)) == len(values)


def _vanish(relation: Relation, bindings: dict[Any, Any]) -> bool:
    """Whether both sides of a relation are identical in free parameters."""
    pairs = zip(relation.left, relation.right, strict=True)
    return all(vanishes(sympy.sympify(a) - sympy.sympify(b), bindings) for a, b in pairs)


def _sides(relation: Relation, model: Model) -> Iterator[tuple[str, Any, Any]]:
    """Yield text, a difference that must be positive, and the size of its terms, in free parameters."""
    bindings, sense = resolved(model.bindings), 1 if relation.sign in {">", ">="} else -1
    for a, b in zip(map(sympy.sympify, relation.left), map(sympy.sympify, relation.right), strict=True):
        yield relation.text, (sense * (a - b)).xreplace(bindings), (1 + abs(a) + abs(b)).xreplace(bindings)


def _distances(rows: list[tuple[str, Any, Any]], model: Model) -> Iterator[tuple[str, float]]:
    """Yield how near points of a model that obey all relations come to the end of each; inf if none obeys them."""
    symbols = sorted(set().union(*(x.free_symbols for _, *both in rows for x in both)), key=str)
    chance, columns = np.random.default_rng(1), []
    for symbol in symbols:
        domain = model.domains.get(str(symbol), "positive" if symbol.is_positive else "real")
        wide, narrow = 10 ** chance.uniform(-4, 4, POINTS), chance.uniform(0, 2.5, POINTS)
        signs = chance.choice((-1, 1), POINTS) if domain == "real" else 1
        values = np.where(chance.random(POINTS) < 0.5, wide, narrow) * signs
        columns.append({"unit": narrow / 2.5, "oblique": 0.41421 + 0.58579 * narrow / 2.5}.get(domain, values))
    with np.errstate(all="ignore"):
        tables = [
            [np.broadcast_to(np.real_if_close(x), (POINTS,)) for x in sympy.lambdify(symbols, both, "numpy")(*columns)]
            for _, *both in rows
        ]
        inside = np.all([value >= 0 for value, _ in tables], axis=0)
        for (text, *_), (value, size) in zip(rows, tables, strict=True):
            yield text, float(np.min((value / size)[inside], initial=np.inf))
