"""Where the formulas hold, and the sentence that says where they do not: of exact numbers, floats and arrays of them.

A check of arrays raises if it fails for any element.

>>> from atlas.bodies.formula_domain import case_of
>>> case_of(1.0, 1.5, 1.0, 2.0, 0.7)
'precession'
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from atlas.errors import DomainError

if TYPE_CHECKING:
    from atlas.arithmetic.numbers import Number

CASES = ("free body", "spin along the field", "transverse field, free spin", "ball, free spin", "at rest", "precession")
FREE_CASES = 4
"""In the first so many cases omega3 is free and has to be given."""

ROD = (
    "A thin rod has I3 = 0: its turn about its own axis carries no inertia, so Omega3 is not determined; "
    "give it a radius."
)
NO_SUCH_BODY = "since I2 - I3/2, the sum of m z^2 along the axis z, is not negative"


def holds(condition: Any) -> bool:
    """Return whether a condition is true; of an array of conditions, whether any of its elements is."""
    return bool(condition.any() if hasattr(condition, "any") else condition)


def refuse(condition: Any, sentence: str, *values: Any) -> None:
    """Raise DomainError with ``sentence`` where a condition holds, for a number or anywhere in an array.

    Each {} in the sentence is replaced by one of ``values``, of arrays the first element for which the condition holds.
    """
    if not holds(condition):
        return
    if getattr(condition, "shape", ()):
        values = tuple((x + 0.0 * condition)[condition].flat[0] for x in values)
    raise DomainError(sentence.format(*map(shortest_text, values)) if values else sentence)


def shortest_text(value: Number) -> str:
    """Return a number, exact or a float, as the shortest text of the double nearest to it, or "beyond all floats"."""
    try:
        return repr(int(value.p) / int(value.q) if hasattr(value, "p") else float(value))
    except OverflowError:
        return "beyond all floats"


def check_ratio(I: Number) -> None:
    """Raise DomainError unless 0 < I <= 2, where I = I3/I2 is a number or an array: no other body exists, (33)."""
    refuse(I <= 0, "The ratio I = I3/I2 must lie in (0, 2], not {}: a moment of inertia is positive.", I)
    refuse(I > 2, f"No body has I = I3/I2 = {{}}: I is at most 2, {NO_SUCH_BODY}.", I)


def check_moments(I2: Number, I3: Number) -> None:
    """Raise DomainError for moments, numbers or arrays, that no symmetric top has.

    They are not both positive, or I3 is above 2 I2.
    """
    impossible = (I2 <= 0) | (I3 <= 0) | (I3 > 2 * I2)
    sentence = "No body has I2 = {}, I3 = {}: both are positive and I3 is at most 2 I2 = {}."
    refuse(impossible, sentence, I2, I3, 2 * I2)


def check_direction(n2: Number, n3: Number) -> None:
    """Raise DomainError for a direction (n2, n3), numbers or arrays, that is zero."""
    refuse((n2 == 0) & (n3 == 0), "The direction (n2, n3) must not be the zero vector.")


def check_ball(inertia: Number) -> None:
    """Raise DomainError for an inertia of a solid ball, a number or an array, that is not positive."""
    refuse(inertia <= 0, "The inertia of a ball must be positive, not {}.", inertia)


def case_of(I2: Number, I3: Number, B2: Number, B3: Number, omega2: Number) -> str:
    """Return the name of the case of an elementary motion, one of `CASES`, decided by exact comparisons.

    I2, I3 are the moments in one unit, B2, B3 and omega2 single numbers in 1/time. Raises DomainError where (67) has no
    point: for B2 = 0 with omega2 not zero, and at the pole omega2 = -B2 unless B3 = 0 or I = I3/I2 is 1.
    """
    if B2 == 0:
        if B3 == 0:
            return "free body"
        sentence = "With B2 = 0 every elementary motion has omega2 = 0, not {}: (67) reads B3 omega2^2 = 0."
        refuse(omega2 != 0, sentence, omega2)
        return "spin along the field"
    if omega2 != -B2:
        return "precession" if omega2 != 0 else "at rest"
    if B3 == 0:
        return "transverse field, free spin"
    further = ": no elementary motion starts there unless B3 = 0 or I = 1"
    refuse(I2 != I3, f"omega2 = -B2 = {{}} is the pole of omega3(omega2), (71){further}.", omega2)
    return "ball, free spin"


def check_omega3(case: str, omega3: Number | None, curve: Number) -> None:
    """Raise DomainError if omega3 is free but None, or given and, as a float, not the omega3 ``curve`` of (71).

    ``case`` is one of `CASES`; in the first FREE_CASES omega3 is free. None passes where it is not free.
    """
    if case in CASES[:FREE_CASES]:
        general = "or omega = (0, omega2, omega3) to the general motion"
        refuse(omega3 is None, f"In the case {case!r} omega3 is free: give it, {general}.")
    elif omega3 is not None and shortest_text(omega3) != shortest_text(curve):
        refuse(
            True, f"omega3 follows from omega2 by (71) and is {shortest_text(curve)}, not {{}}: leave it out.", omega3
        )


def check_curve(B2: Number, omega2: Number) -> None:
    """Raise DomainError where (71) has no omega3: for B2 = 0, and at the pole omega2 = -B2; anywhere in arrays."""
    refuse(B2 == 0, "With B2 = 0 the curve (67) is the line omega2 = 0, and omega3 is free on it.")
    refuse(omega2 == -B2, "omega2 = -B2 = {} is the pole of omega3(omega2), (71).", omega2)


def check_asymptotes(B2: Number, B3: Number) -> None:
    """Raise DomainError where the curve (67) is none, but two lines: for B2 = 0 or B3 = 0."""
    refuse((B2 == 0) | (B3 == 0), "The curve (67) has asymptotes only if neither B2 nor B3 is zero.")


def check_beta(B2: Number, B3: Number) -> None:
    """Raise DomainError where I^-1 B' has no direction: for B2 = B3 = 0; anywhere in arrays."""
    refuse((B2 == 0) & (B3 == 0), "With B = 0 there is no angle beta: I^-1 B' has no direction.")


def check_a2(B2: Number, B3: Number) -> None:
    """Raise DomainError where a2 of (54) is infinite, for B2 = 0 < B3, and for B = 0."""
    check_beta(B2, B3)
    refuse((B2 == 0) & (B3 > 0), "With B2 = 0 and B3 > 0 sin(beta) = 1, and a2 of (54) is infinite.")


def check_a3(B2: Number, B3: Number) -> None:
    """Raise DomainError where a3 of (54) is infinite, for B2 = 0 > B3, and for B = 0."""
    check_beta(B2, B3)
    refuse((B2 == 0) & (B3 < 0), "With B2 = 0 and B3 < 0 sin(beta) = -1, and a3 of (54) is infinite.")


def check_D(n3: Number, linear: Number) -> None:
    """Raise DomainError where D of a top is infinite: for n3 = 0 with a ``linear`` potential that is not zero."""
    sentence = "With n3 = 0 and a linear potential D = A + kappa^2 + a0/n3 is infinite."
    refuse((n3 == 0) & (linear != 0), sentence)


def check_force(force: Any, quantity: str) -> None:
    """Raise DomainError, naming the ``quantity`` that needs one, where ``force``, a boolean or an array, is false."""
    refuse(force == False, f"Without a magnetic force (mu B = 0) the motion has no {quantity}.")  # noqa: E712  of arrays too
