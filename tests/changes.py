r"""Changes the TeX of a formula by one sign, number, letter or index at a time: a trial that reads it must notice."""

import random
import re

_TOKEN = re.compile(r"\\(?:begin|end)\{\w+\}|\\(?:text|mathrm|operatorname)\{[^}]*\}|\\[A-Za-z]+|\\.|.", re.DOTALL)
_GREEK = [rf"\{name}" for name in "alpha beta gamma kappa lambda mu nu phi psi chi omega Omega".split()]
_SWAPS = {"+": "-", "-": "+", r"\pm": r"\mp", r"\mp": r"\pm", r"\sin": r"\cos", r"\cos": r"\sin"}
_BOLD = re.compile(r"\\(?:mathbf|boldsymbol)$")


def changes(tex: str, *, most: int | None = None, seed: str = "") -> list[tuple[str, str]]:
    """Return formulas that differ from this one in one place, each with what was changed.

    most  how many at most, chosen by `seed`; None for all
    """
    tokens = _TOKEN.findall(tex)
    found: dict[str, str] = {}
    for place, token in enumerate(tokens):
        before = next((earlier for earlier in reversed(tokens[:place]) if not earlier.isspace()), "")
        for what, other in _others(token, before, tokens, place):
            space = " " if other[-1:].isalpha() and other.startswith("\\") else ""
            found.setdefault("".join([*tokens[:place], other + space, *tokens[place + 1 :]]), f"{token} {what} {other}")
    found.pop(tex, None)
    every = list(found.items())
    if most is None or len(every) <= most:
        return every
    return random.Random(seed).sample(every, most)  # noqa: S311  a choice that is the same in every run


def _others(token: str, before: str, tokens: list[str], place: int) -> list[tuple[str, str]]:
    """Return what one token may be changed to."""
    if token in _SWAPS:
        return [("function" if len(token) == 4 else "sign", _SWAPS[token])]
    if token in {"=", r"\equiv", "("} and _begins_a_term(tokens, place):
        return [("sign", f"{token}-")]
    if token.isdigit():
        return [("index" if before == "_" else "number", str((int(token) + 1) % 10))]
    if token in _GREEK:
        return [("letter", next(other for other in _GREEK if other != token and other not in tokens))]
    if len(token) == 1 and token.isalpha() and not _BOLD.match(before):
        fresh = "XYZUVW" if token.isupper() else "xyzuvw"
        return [("letter", next(other for other in fresh if other not in tokens))]
    return []


def _begins_a_term(tokens: list[str], place: int) -> bool:
    """Whether a sign put behind an opening or a sign of equality changes something: not in a square, nor before = 0."""
    after = next((later for later in tokens[place + 1 :] if not later.isspace() and later != "&"), "")
    rest = re.sub(r"[\s&]", "", "".join(tokens[place:]))
    if re.match(r"\([^()]*\)\}?(\^2|=0|=\\text\{const)", rest.replace("(t)", "").replace("(0)", "")):
        return False
    return after not in {"+", "-", "0", r"\pm", r"\mp", r"\text", "", r"\begin{aligned}", "]", ")"}
