r"""Rewrites the TeX of a formula by a rule at a time: other mistakes than those that `changes` makes token by token.

Two letters are exchanged, a factor or a term is dropped, a fraction stands on its head, indices change places or become
numbers, a dot, a prime, a hat or a T is lost or added, a bracket becomes another one, a sign of comparison turns round.
"""

import random
import re
from collections.abc import Iterator
from itertools import pairwise

LETTER = (
    r"(?:\\(?:dot|ddot|hat) ?)?(?:\\(?:mathbf|boldsymbol)\{\\?[A-Za-z]+\}|(?<![\\A-Za-z{])[A-Za-z](?![A-Za-z])"
    r"|\\(?:alpha|beta|gamma|kappa|mu|nu|phi|omega|Omega|lambda|tau)\b)"
)
_GROUP = r"\{([^{}]*(?:\{[^{}]*\}[^{}]*)*)\}"
RULES = (
    (r"\\t?frac12", "", "loses a factor"),
    (r"\\t?frac12", "2", "has the inverse factor"),
    (r"(?<![\d^_{\\c])2(?=[\\A-Za-z(\[{])", "", "loses a factor"),
    (r"(?<=[=+(\[])(?=[\\A-Za-z])(?!\\end|\\text|\\qquad|\\quad|\\begin|\\frac|\\b)", "2", "has a factor more"),
    (r"\^2", "", "loses a power"),
    (r"\^2", "^3", "has another power"),
    (r"\\sin", r"\\tan ", "has another function"),
    (r"\\cos", r"\\sin ", "has another function"),
    (r"\\cosh", r"\\sinh ", "has another function"),
    (r"\\sinh", r"\\cosh ", "has another function"),
    (r"\\dot ?(?!\{)", "", "loses a dot"),
    (r"\\ddot", r"\\dot", "loses a dot"),
    (r"\\dot(?!\\|s)", r"\\ddot", "has a dot more"),
    (r"\^T", "", "loses a transpose"),
    (r"(?<![A-Za-z\\{])R(?![_^A-Za-z(])", "R^T", "has a transpose more"),
    (r"(?<![\\A-Za-z])\\hat ?", "", "loses a hat"),
    (r"(?<=[A-Za-z}])'", "", "loses a prime"),
    (r"\\mathbf\{([A-Z])\}", r"\1", "is no vector"),
    (r"(?<=[RS])_\{([a-z])([a-z])\}(?!\(0)", r"_{\2\1}", "has its indices exchanged"),
    (r"_\{([a-z])([a-z])([a-z])\}", r"_{\2\1\3}", "has its indices exchanged"),
    (r"_([ijkN])(?![A-Za-z])", "_1", "has a number for an index"),
    (r"_([ijkN])(?![A-Za-z])", "_2", "has a number for an index"),
    (r"_\d", "", "loses an index"),
    (r"\[([^\[\],]+),([^\[\],]+)\]", r"[\2,\1]", "has its arguments exchanged"),
    (r"\[([^\[\],]+),([^\[\],]+)\]", r"(\1,\2)", "has another bracket"),
    (r"\(([^(),]+),([^(),]+)\)", r"[\1,\2]", "has another bracket"),
    (rf"\\frac{_GROUP}{_GROUP}", r"\\frac{\2}{\1}", "stands on its head"),
    (r"<", ">", "is turned round"),
    (r">", "<", "is turned round"),
    (r"\\le(?![a-z])", r"\\ge", "is turned round"),
    (r"\\ge(?![a-z])", r"\\le", "is turned round"),
    (r"\\ne(?![a-z])", "=", "is denied"),
    (r"(?<![\\A-Za-z])=(?!0)", r"\\ne ", "is denied"),
    (r"\\sqrt(?=\{)", "", "loses a root"),
    (r"\\pm", "+", "loses a sign"),
    (r"\\mp", "-", "loses a sign"),
)


_TERM = r"(?<=[\w)\]}])[+-](?:[^+\-=,&<>\\(){}\[\]]|\\[A-Za-z]+|[({\[][^(){}\[\]]*[)}\]])+(?=[+\-=,)\]}&]|$)"


SAME = (
    *((text, "gamma is any number") for text in (r"X=\alpha A,", r"A+2\gamma J")),
    (r"I\boldsymbol{\omega}=I_0R", "the inertia tensor of a ball is its moment"),
    (r"=IR\boldsymbol{\Omega}", "the inertia tensor of a ball is its moment"),
    (r"\boldsymbol{\omega}(0)=\boldsymbol{\Omega}", "an equation read from the other side"),
    (r"[\mathbf{m},\boldsymbol{\omega}]=0", "the other sign of nothing"),
    ("D=-c", "an equation read from the other side"),
    (r"\left(C\cos", "brackets about one thing"),
    (r"\exp(t\lambda_", "factors commute"),
    ("=2p=0", "twice nothing"),
)
"""Rewritings that keep the mathematics of a formula of the ledger, each with its reason."""


def rewritings(tex: str, *, most: int | None = None, seed: str = "") -> list[tuple[str, str]]:
    """Return formulas that differ from this one by one rule at one place, each with its rule."""
    forms = dict(_rewritten(tex))
    every = [pair for pair in forms.items() if pair[0] != tex and not any(same in pair[0] for same, _ in SAME)]
    return every if most is None or len(every) <= most else random.Random(seed).sample(every, most)  # noqa: S311


def _rewritten(tex: str) -> Iterator[tuple[str, str]]:
    for pattern, other, what in RULES:
        for match in re.finditer(pattern, tex):
            if what != "has a factor more" or not tex.endswith(("const}", "=0")):  # twice a constant is one
                yield tex[: match.start()] + match.expand(other) + tex[match.end() :], f"{match[0]} {what}"
    for first, second in pairwise(re.finditer(LETTER, tex)):
        between = tex[first.end() : second.start()]
        if first[0] != second[0] and re.search(r"[-=/_^]|\}\{", between):  # not two factors, which commute
            swapped = f"{second[0]}{between}{first[0]} "
            yield (
                tex[: first.start()] + swapped + tex[second.end() :],
                f"{first[0]} and {second[0]} are exchanged",
            )
    for match in re.finditer(_TERM, tex):
        yield tex[: match.start()] + tex[match.end() :], f"{match[0]} is dropped"
