r"""Changes the TeX of a formula by one sign, number, letter, index or connective: a trial that reads it must notice."""

import random
import re

_TOKEN = re.compile(r"\\(?:begin|end)\{\w+\}|\\(?:text|mathrm|operatorname)\{[^}]*\}|\\[A-Za-z]+|\\.|.", re.DOTALL)
_GREEK = [rf"\{name}" for name in "alpha beta gamma kappa lambda mu nu phi psi chi omega Omega".split()]
_SWAPS = {"+": "-", "-": "+", r"\pm": r"\mp", r"\mp": r"\pm", r"\sin": r"\cos", r"\cos": r"\sin"}
_CONNECTIVES = {r"\iff": r"\implies", r"\implies": r"\iff", r"\qquad": r"\iff", r"\quad": r"\implies"}
_LETTERS = [[*"xyzuvwabcdefghijklmnopqrst"], [*"XYZUVWABCDEFGHIJKLMNOPQRST"]]
_ANSATZ = (
    *(r"\omega_2, \Omega _3)^T", r"(1-I)\Omega _3+(2-I)B'_3]\Omega", r"-I\Omega _3K_2", r"+I\Omega _3K_1"),
    *(r"=\Omega _3K_2-B'_3", r"-\Omega _3K_1+B'_3"),
)
SAME = (
    (r"\lambda_{AB}[x_A^i-x_1^i]", "a dummy index: the multipliers are symmetric"),
    (r"\lambda_{AB}[\mathbf{y}_A-\mathbf{y}_1]", "a dummy index: the multipliers are symmetric"),
    *((text, "the ansatz of (58) is that Omega_3 is omega_3") for text in _ANSATZ),
    *((text, "another name of a free index") for text in (r"\{K_x,K_j\}", r"\{K_i,K_x\}")),
    (r"\xi=-\xi_0", "xi_0 is any constant"),
    *(
        (text, "beta and gamma are any numbers")
        for text in (r"A-\gamma J", r"A+\alpha  J", r"Y=-\beta A", r"Y=\alpha  A")
    ),
    *((text, "I_1 = I_2") for text in (r"I\equiv\frac{I_3}{I_1}", r"E'\equiv\frac{2E}{I_1}")),
    (r"q''(-\nu_0)", "q has no cubic term, so that its second derivative is even"),
    (r"e_\pm=-\nu_0\mp", "both roots stand in a product"),
    (r"e_\mp =-\nu_0\pm", "both roots stand in a product"),
)
"""Changes that keep the mathematics of a formula of the ledger, each with its reason."""

_BOLD = re.compile(r"\\(?:mathbf|boldsymbol)$")


def changes(tex: str, *, most: int | None = None, seed: str = "") -> list[tuple[str, str]]:
    """Return formulas that differ from this one in one place, each with its change.

    most  how many at most, chosen by `seed`; None for all
    """
    tokens = _TOKEN.findall(tex)
    changed_forms: dict[str, str] = {}
    for place, token in enumerate(tokens):
        before = next((earlier for earlier in reversed(tokens[:place]) if not earlier.isspace()), "")
        for kind, token_new in _replacements(token, before, tokens, place):
            space = " " if token_new[-1:].isalpha() and token_new.startswith("\\") else ""
            changed_forms.setdefault(
                "".join([*tokens[:place], token_new + space, *tokens[place + 1 :]]), f"{token} {kind} {token_new}"
            )
    changed_forms = {
        form: kind for form, kind in changed_forms.items() if form != tex and not any(s in form for s, _ in SAME)
    }
    every = list(changed_forms.items())
    if most is None or len(every) <= most:
        return every
    return random.Random(seed).sample(every, most)  # noqa: S311  a choice that is the same in every run


def _replacements(mark: str, before: str, tokens: list[str], place: int) -> list[tuple[str, str]]:
    """Return the replacements of one token."""
    kind, others = "letter", list[str]()
    if mark in _SWAPS:
        kind, others = "function" if len(mark) == 4 else "sign", [_SWAPS[mark]]
    elif mark in _CONNECTIVES:
        kind, others = "connective", [_CONNECTIVES[mark]]
    elif mark in {"=", r"\equiv", "("} and _begins_a_term(tokens, place):
        kind, others = "sign", [f"{mark}-"]
    elif mark.isdigit():
        kind = "index" if before == "_" else "number"
        among = "123" if before == "_" and mark in "123" else str((int(mark) + 1) % 10)
        others = [other for other in among if other != mark]
    elif mark in _GREEK:
        others = _letters(_GREEK, mark, tokens)
    elif len(mark) == 1 and mark.isalpha() and not _BOLD.match(before):
        others = _letters(_LETTERS[mark.isupper()], mark, tokens)
    return [(kind, other) for other in others]


def _letters(letters: list[str], token: str, tokens: list[str]) -> list[str]:
    """Return a letter that the formula does not have, and another one that it has."""
    alternatives = [letter for letter in letters if letter != token]
    return [
        next(letter for letter in alternatives if (letter in tokens) is is_present)
        for is_present in (False, True)
        if any((letter in tokens) is is_present for letter in alternatives)
    ]


def _begins_a_term(tokens: list[str], place: int) -> bool:
    """Whether a sign put behind an opening or a sign of equality changes something: not in a square, nor before = 0."""
    if "".join(tokens[:place]).rstrip().endswith((r"\cos", r"\cosh")):
        return False
    after = next((later for later in tokens[place + 1 :] if not later.isspace() and later != "&"), "")
    following = re.sub(r"[\s&]|\\boxed\{", "", "".join(tokens[place:]))
    if re.match(r"=([^=]*=)?0\b", following):
        return False
    if re.match(r"\([^()]*\)\}?(\^2|=0|=\\text\{const)", following.replace("(t)", "").replace("(0)", "")):
        return False
    return after not in {"+", "-", "0", r"\pm", r"\mp", r"\text", "", r"\begin{aligned}", "]", ")"}
