"""Decides identities and signs of rational functions of free parameters.

Rotations are written by Cayley's formula, angles by the tangent of the half, roots by parameters that make them
rational. Then two sides are equal if and only if the numerator of their difference expands to nothing.
"""

from typing import Any

import sympy
from sympy.polys.rings import ring

Value = Any


def ordered(bindings: list[tuple[Value, Value]]) -> list[tuple[Value, Value]]:
    """Return the ``bindings``, pairs (symbol, value), each after the pairs whose symbols its value contains.

    Pairs that depend on each other in a circle are kept, each circle broken at its last pair of the list.
    """
    remaining, result = list(bindings), list[tuple[Value, Value]]()
    done: set[Value] = set()
    names = {symbol for symbol, _ in bindings}
    while remaining:
        for entry in remaining:
            if not (sympy.sympify(entry[1]).free_symbols & names) - done - {entry[0]}:
                break
        remaining.remove(entry)
        done.add(entry[0])
        result.append(entry)
    return result


def resolved(bindings: list[tuple[Value, Value]]) -> dict[Value, Value]:
    """Return a dictionary from each symbol of ``bindings`` to its value in free parameters alone."""
    values: dict[Value, Value] = {}
    for symbol, value in ordered(bindings):
        values[symbol] = sympy.cancel(sympy.sympify(value).xreplace(values))
    return values


def vanishes(difference: Value, bindings: dict[Value, Value] | None = None) -> bool:
    """Whether the rational function ``difference`` is zero identically, with ``bindings`` (symbol -> value) inserted.

    It is zero if its numerator, a polynomial in free parameters, expands to nothing. A symbol that is N/n in free
    parameters becomes N times a symbol for 1/n; at the end each power of 1/n is cleared by the power of n that is
    missing. So no fraction is ever expanded.
    """
    numerator = sympy.numer(sympy.together(difference))
    if bindings and vanishes(numerator):
        return True
    used = {symbol: value for symbol, value in (bindings or {}).items() if numerator.has(symbol)}
    inverses: dict[Value, Value] = {}
    swap = {}
    for symbol, value in used.items():
        top, bottom = sympy.fraction(value)
        swap[symbol] = top if bottom.is_number else top * inverses.setdefault(bottom, sympy.Dummy())
        if bottom.is_number:
            swap[symbol] = top / bottom
    polynomial = numerator.xreplace(swap)
    symbols = sorted(polynomial.free_symbols | {s for n in inverses for s in n.free_symbols}, key=str)
    if polynomial.is_number or not symbols:
        return bool(sympy.expand(polynomial) == 0)
    try:
        algebra = ring(symbols, sympy.QQ_I if polynomial.has(sympy.I) else sympy.QQ)[0]
        element = algebra.from_expr(polynomial)
    except (ValueError, sympy.polys.polyerrors.CoercionFailed):
        return bool(sympy.expand(sympy.numer(sympy.together(numerator.xreplace(used)))) == 0)
    for bottom, inverse in inverses.items():
        element = (
            _cleared(element, symbols.index(inverse), algebra.from_expr(bottom), algebra)
            if inverse in symbols
            else element
        )
    return not element


def _cleared(element: Value, place: int, bottom: Value, algebra: Value) -> Value:
    """Return a polynomial in s = 1/n multiplied by the lowest power of n that clears s, an element of ``algebra``.

    s is the generator number ``place`` of the ring ``algebra``, ``bottom`` is n as an element of the ring.
    """
    by_power: dict[int, dict[tuple[int, ...], Value]] = {}
    for powers, coefficient in element.terms():
        by_power.setdefault(powers[place], {})[(*powers[:place], 0, *powers[place + 1 :])] = coefficient
    result = algebra.zero
    for power in range(max(by_power, default=0) + 1):
        result = result * bottom + algebra.from_dict(by_power.get(power, {}))
    return result


def sign_forms(value: Value, *, strict: bool) -> list[bool]:
    """Return three booleans: whether SymPy sees that a function is positive as given, factored, and expanded.

    Without ``strict`` nonnegative suffices. False means that the sign is not seen, not that it is another.
    """
    factored = sympy.factor(sympy.together(value))
    forms = value, factored, sympy.expand(sympy.numer(factored)) / sympy.expand(sympy.denom(factored))
    return [bool(form.is_positive or (not strict and form.is_nonnegative)) for form in forms]


def positive(value: Value, *, strict: bool) -> bool:
    """Whether SymPy sees in one of `sign_forms` that a function is positive, or nonnegative without ``strict``.

    ``value`` is an expression in symbols of known sign. False means that nothing is known.
    """
    return any(sign_forms(value, strict=strict))
