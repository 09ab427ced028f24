"""Plain letters such as ``omega2 differs from -B'2`` as words and formulas: the ledger and the trial write them so.

Words that stand side by side and are letters, numbers or signs become one formula, labels of the ledger citations; all
other words stay. What may be a word or a letter, ``a`` and ``A``, is told by its neighbours.
"""

import re

from atlas.paper import EQUATIONS

_GREEK = "alpha|beta|gamma|delta|theta|lambda|mu|nu|pi|tau|phi|psi|chi|omega|Omega|eps"
_FUNCTIONS = "sin|cos|tan|exp|det|tr"
_NAME = rf"(?:{_GREEK}|[A-Za-z])'*(?:_?\d{{1,2}}|_[A-Za-z]+)?"
_LETTER = re.compile(rf"-?(?:{_NAME}|OZ|k_hat|kt|dt2?)")
_PART = re.compile(rf"(?:{_FUNCTIONS}|sqrt|hat|[-=<>+*/]|[<>]=|±)")
_CALL = re.compile(r"±?[\w']+\(.*")
_TOKEN = re.compile(
    rf"sqrt\((?P<under>[^()]*)\)|sqrt (?P<digit>\d)|hat (?P<hat>[A-Z]\d)|hat\((?P<hats>[^()]+)\)|(?P<k>k_hat)"
    rf"|(?P<rate>d2?)(?=(?:{_GREEK}|[A-Z]|[txmvy](?![a-z])))|(?P<function>{_FUNCTIONS})\b|(?P<order>[<>]=)|(?P<sign>±)"
    rf"|\^(?P<power>-?\w)|(?P<two>kt|OZ)|(?P<name>{_NAME})(?![a-z]{{2}})|(?P<word>[A-Za-z]{{2,}})"
)
_SPLIT = re.compile(rf"({_GREEK}|[A-Za-z])('*)_?(\d+|[A-Za-z]+)?")
_VECTORS = {"B", "B'", "E", "K", "M", "W", "m", "Omega", "omega"}
_POINTS = {"e", "x", "y", "C", "E"}


def typeset(text: str, *, scalar_omega: bool = False) -> str:
    r"""Return the Markdown of a plain text: ``I > 1: a cone, mf62`` becomes ``$I > 1$: a cone, @mf62``.

    ``scalar_omega`` tells that omega is a frequency, as in the appendix of the paper, and not the angular velocity.
    What stands between dollar signs is TeX and stays.
    """
    return "".join(
        piece if piece.startswith("$") else _plain(piece, scalar_omega) for piece in re.split(r"(\$[^$]*\$)", text)
    )


def _plain(text: str, scalar_omega: bool) -> str:
    """Return the Markdown of a text without TeX."""
    out: list[str] = []
    run: list[str] = []
    words = text.split(" ")
    for place, word in enumerate(words):
        before, after = words[place - 1] if place else "", words[place + 1] if place + 1 < len(words) else ""
        if _is_formula(word, before, after, run):
            run.append(word)
            if word.endswith((",", ":", ";", ".")) and not _open(run):
                out += _close(run, scalar_omega)
        else:
            out += [*_close(run, scalar_omega), _cited(word)]
    return " ".join([*out, *_close(run, scalar_omega)])


def _is_formula(word: str, before: str, after: str, run: list[str]) -> bool:
    """Whether a word belongs to a formula; `run` is what stands directly before it in one."""
    core = word.strip("()[]|,:;.")
    if core in EQUATIONS or (not core and not _open(run)):
        return False
    if core == "a" or (core == "A" and (not before or before[-1] in ".:;") and re.fullmatch("(?!is$)[a-z1-]+", after)):
        return bool(_PART.fullmatch(before) or _PART.fullmatch(after) or _open(run))
    if core.isdigit():
        return bool(
            run or word[0] in "([" or (word == core and not after.isdigit() and _is_formula(after, word, "", run))
        )
    if _LETTER.fullmatch(core) or _PART.fullmatch(core) or _open(run):
        return True
    return bool(re.search(r"[=<>^|/*+±]|\d['_]|_[A-Za-z]|^-\w|\d-\w", core) or _CALL.fullmatch(core))


def _open(run: list[str]) -> bool:
    """Whether a bracket is open."""
    text = " ".join(run)
    return any(text.count(left) > text.count(right) for left, right in ("()", "[]"))


def _close(run: list[str], scalar_omega: bool) -> list[str]:
    """Return the formula of a run with the stops and brackets around it, and empty the run."""
    if not run:
        return []
    text = " ".join(run)
    run.clear()
    body = text.rstrip(",:;.")
    tail = text[len(body) :]
    lead = ""
    if body.count("(") > body.count(")"):
        lead, body = "(", body.replace("(", "", 1)
    if body.count(")") > body.count("("):
        tail, body = ")" + tail, body[::-1].replace(")", "", 1)[::-1]
    return [f"{lead}${_tex(body, scalar_omega)}${tail}"]


def _cited(word: str) -> str:
    """Put the sign of a citation before a label."""
    core = word.strip("()[],:;.")
    return word.replace(core, f"@{core}", 1) if core in EQUATIONS else word


def _tex(plain: str, scalar_omega: bool) -> str:
    """Write a formula in plain letters as TeX."""

    def token(match: re.Match[str]) -> str:
        kind, found = match.lastgroup, match[match.lastgroup or 0]
        simple = {
            "digit": rf"\sqrt {found}",
            "k": r"\hat{\mathbf{k}}",
            "rate": f"{found[0]}^2 " if found == "d2" else "d",
            "function": rf"\{found} " if found != "tr" else r"\operatorname{tr}",
            "order": r"\le " if found == "<=" else r"\ge ",
            "sign": r"\pm ",
            "power": f"^{{{found}}}",
            "two": found,
            "word": rf"\text{{{found}}}",
        }
        match kind:
            case "hat":
                return rf"\hat{{{found[0]}}}_{{{found[1:]}}}"
            case "under":
                return rf"\sqrt{{{_tex(found, scalar_omega)}}}"
            case "hats":
                return rf"\hat{{{_tex(found, scalar_omega)}}}"
            case "name":
                return _letter(found, scalar_omega)
        return simple[str(kind)]

    return _TOKEN.sub(token, plain)


def _letter(name: str, scalar_omega: bool) -> str:
    """Write a letter with its prime and its index."""
    base, primes, index = (str(part) for part in _SPLIT.findall(name)[0])
    letter = base if len(base) == 1 else r"\varepsilon" if base == "eps" else rf"\{base}"
    vector = base + primes in _VECTORS and not index and not (base == "omega" and scalar_omega)
    if vector or (index and base in _POINTS and not primes):
        letter = rf"\boldsymbol{{{letter}}}" if len(base) > 1 else rf"\mathbf{{{letter}}}"
    below = r"_\bot" if index == "perp" else f"_{{{index}}}" if index else ""
    return letter + primes + below
