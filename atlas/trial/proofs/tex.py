r"""Reads the TeX of the ledger: the line that is tried is made from the formula that is shown.

`line` turns a formula, or several of them, into a line of `notation`. Brackets with a comma have the meaning of the
paper: [a, b] the vector product, (a, b) the scalar one, {a, b} Poisson's bracket. A letter without a sign between it
and the next is a factor. A table gives the meaning of a letter, in TeX; a letter without an entry has its own name:

    \mathbf{K}: K    \Omega_3: Omega3    \hat{B}_2: hB2    \dot m: d(m)    R_{ij}: R[i, j]    f(0): at0(f)

A table may also give the meaning of a longer phrase: an expression, a whole relation, other TeX, or nothing, where the
model says it.
Whatever is neither read nor said raises UnreadableError, so that no sign of a formula is passed over;
`unread_phrases` names the phrases of the table. On both sides of an arrow stand statements of the line; `arrows` lists
them with their places, and a trial must name the same ones: the premise that its model has, or the line for the other
direction.
"""

import ast
import keyword
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from itertools import pairwise

from atlas.trial.proofs.notation import names, parse, write

_TOKEN = re.compile(r"\\begin\{\w+\}|\\end\{\w+\}|\\text\{[^}]*\}|\\[A-Za-z]+|\\.|\d|\S", re.DOTALL)
_SILENT = {r"\left", r"\right", r"\Bigl", r"\Bigr", r"\bigl", r"\bigr", r"\displaystyle", r"\!", "\\ "}
_SAME = {
    r"\tfrac": r"\frac",
    r"\varepsilon": r"\epsilon",
    r"\boldsymbol": r"\mathbf",
    r"\equiv": "=",
    r"\;": r"\,",
    r"\text{diag}": r"\diag",
}
_RELATES = re.compile("[=<>]")
_ALIGNED = {r"\begin{aligned}", r"\end{aligned}"}
_ARROWS = {r"\iff", r"\implies"}
_SEPARATORS = {",", ";", ":", r"\quad", r"\qquad", r"\\", *_ARROWS} | {
    rf"\text{{{words}}}" for words in ("where", "then", "or", "or, equivalently", "and")
}
_SIGNS: dict[str, type[ast.cmpop]] = {
    "=": ast.Eq,
    r"\ne": ast.NotEq,
    "<": ast.Lt,
    r"\le": ast.LtE,
    ">": ast.Gt,
    r"\ge": ast.GtE,
}
_FUNCTIONS = {rf"\{name}" for name in ["sqrt", "sin", "cos", "tan", "ln", "det", "diag", "exp", "sinh", "cosh", "tanh"]}
_ACCENTS = {r"\hat": "h", r"\tilde": "tilde", r"\dot": "d", r"\ddot": "d2"}
_FONTS = {r"\mathbf", r"\mathbb", r"\mathrm", r"\operatorname", r"\mathcal"}
_TOTAL = "sum over "
_CLOSING = {")", "]", "}", r"\}", r"\rvert", "&", r"\end{pmatrix}"}
_PAIRS = {"(": (")", "dot"), "[": ("]", "cross"), r"\{": (r"\}", "br")}


class UnreadableError(ValueError):
    """Raised for a formula with something in it that is neither read nor defined by the table of signs."""


@dataclass(frozen=True)
class _Meaning:
    """A phrase of the TeX already replaced by `plain`, its text in plain letters from the table of signs."""

    plain: str


@dataclass(frozen=True)
class _Letter:
    """A letter of TeX, key of a `_Table`.

    `accents` are commands from outside in, `base` is the letter with its font, `primes` their number, `below` the
    tokens of its lower index.
    """

    accents: tuple[str, ...]
    base: str
    primes: int
    below: tuple[str, ...]


_Token = str | _Meaning


@dataclass(frozen=True)
class _Table:
    """Meanings in plain letters: of `letters`, and of `phrases` (tokens, meaning), the longest phrase first.

    `left_side` is the left side, in plain letters, of a formula that is printed without one; empty if it has one.
    """

    letters: Mapping[_Letter, str] = field(default_factory=dict)
    phrases: tuple[tuple[tuple[str, ...], str], ...] = ()
    left_side: str = ""

    def names_of_others(self, letter: _Letter) -> set[str]:
        """Return the plain names that the table gives to other letters; a letter in another font is not another."""
        bare = replace(letter, base=letter.base.split()[-1])
        return {plain for entry, plain in self.letters.items() if replace(entry, base=entry.base.split()[-1]) != bare}


def line(tex: str, signs: Mapping[str, str]) -> str:
    """Return the formula ``tex`` as a line of `notation`, relations joined by "; ".

    ``signs`` maps letters and phrases in TeX to plain ones. Raises UnreadableError if something is neither read nor in
    ``signs``, nothing is a relation, or one plain name stands for a bold and a thin letter.
    """
    return _read(tex, tuple(signs.items()))[0]


def thin(tex: str, signs: Mapping[str, str]) -> frozenset[str]:
    """Return the set of plain names of a formula's letters that are not bold and have no index: none may be a vector.

    ``tex`` and ``signs`` as in `line`; raises UnreadableError as `line` does.
    """
    return _read(tex, tuple(signs.items()))[1]


def unread_phrases(tex: str, signs: Mapping[str, str]) -> dict[str, str]:
    """Return the phrases of ``signs`` that occur in the TeX and replace a whole relation, each with its line.

    The line is empty where nothing is read in the place of a phrase, because the model says it.
    """
    tokens = _tokens(tex)
    phrases = {}
    for key, plain in signs.items():
        phrase = _tokens(key)
        occurs = any(tokens[place : place + len(phrase)] == phrase for place in range(len(tokens))) if phrase else False
        if occurs and (not plain or (_RELATES.search(plain) and not plain.endswith("="))):
            phrases[key] = plain
    return phrases


def arrows(tex: str, signs: Mapping[str, str]) -> list[tuple[int, str]]:
    """Return pairs (number of statements before an arrow, its TeX), for arrows outside the phrases of ``signs``."""
    tokens = _with_meanings(_tokens(tex), _table(tuple(signs.items())))
    marks = [(place, mark) for place, mark in enumerate(tokens) if isinstance(mark, str) and mark in _ARROWS]
    return [(len(_statements(tokens[:place])), mark) for place, mark in marks]


@cache
def _read(tex: str, signs: tuple[tuple[str, str], ...]) -> tuple[str, frozenset[str]]:
    table = _table(signs)
    readers = [_Formula(statement, table) for statement in _statements(_with_meanings(_tokens(tex), table))]
    relations = [relation for reader in readers for relation in reader.relations()]
    if not relations:
        raise UnreadableError("nothing in the formula is to be read")
    thin, bold = (frozenset().union(*(getattr(reader, kind) for reader in readers)) for kind in ("thin", "vectors"))
    if thin & bold:
        raise UnreadableError(f"{', '.join(sorted(thin & bold))} stands in two fonts")
    return "; ".join(relations), thin


@cache
def _table(signs: tuple[tuple[str, str], ...]) -> _Table:
    letters, phrases = {}, {}
    for key, plain in (*_COMMON.items(), *signs):
        tokens = _tokens(key)
        reader = _Formula(tokens, _Table())
        if reader.is_letter():
            letter = reader.letter()
            if reader.position == len(tokens):
                letters[letter] = plain
                continue
        phrases[tuple(tokens)] = plain
    left_side = phrases.pop((), "")
    return _Table(letters, tuple(sorted(phrases.items(), key=lambda phrase: -len(phrase[0]))), left_side)


def _tokens(tex: str) -> list[str]:
    r"""Return the TeX commands and single characters of a formula, without spaces and \boxed with its braces."""
    tokens = [_SAME.get(mark, mark) for mark in _TOKEN.findall(tex) if mark not in _SILENT]
    result: list[str] = []
    drops, depth, matrices = list[int](), 0, 0
    for place, mark in enumerate(tokens):
        matrices += (mark == r"\begin{pmatrix}") - (mark == r"\end{pmatrix}")
        if mark == r"\boxed" or mark in _ALIGNED or (mark == "&" and not matrices):
            continue
        if mark == "{":
            if place and tokens[place - 1] == r"\boxed":
                drops.append(depth)
            else:
                result.append(mark)
            depth += 1
        elif mark == "}":
            depth -= 1
            if drops and drops[-1] == depth:
                drops.pop()
            else:
                result.append(mark)
        else:
            result.append(mark)
    return result


def _statements(tokens: list[_Token]) -> list[list[_Token]]:
    r"""Return the token lists of single statements: they end at commas, spaces, arrows, ends of rows and words between.

    A part that begins with a sign of comparison, or with + or - after an end of row, continues the statement before.
    Separators inside brackets count for nothing; a statement with y_\pm becomes two, see `_signed`.
    """
    statements: list[list[_Token]] = [[]]
    depth, row, ended = 0, False, False
    for mark in tokens:
        if mark in {"(", "[", "{", r"\{", r"\begin{pmatrix}"}:
            depth += 1
        elif mark in {")", "]", "}", r"\}", r"\end{pmatrix}"}:
            depth -= 1
        if not depth and mark in _SEPARATORS:
            row, ended = (
                row or mark in {r"\\", r"\quad", r"\qquad"},
                ended or mark not in {r"\\", r"\quad", r"\qquad"},
            )
            continue
        goes_on = mark in _SIGNS or (not ended and mark in {"+", "-"})
        if (row or ended) and not goes_on:
            statements.append([])
        row = ended = False
        statements[-1].append(mark)
    return [signed for statement in statements if statement and statement != ["."] for signed in _signed(statement)]


def _signed(statement: list[_Token]) -> list[list[_Token]]:
    r"""Return the statement alone in a list, or two, of y_+ and of y_-, for y_\pm = a \pm b."""
    if not any(pair[0] == "_" and pair[1] in {r"\pm", r"\mp"} for pair in pairwise(statement)):
        return [statement]
    upper, lower = {r"\pm": "+", r"\mp": "-"}, {r"\pm": "-", r"\mp": "+"}
    return [
        [signs.get(mark, mark) if isinstance(mark, str) else mark for mark in statement] for signs in (upper, lower)
    ]


def _with_meanings(tokens: list[str], table: _Table) -> list[_Token]:
    """Return the tokens with each phrase of the table replaced by the tokens of its meaning, the longest phrase first.

    See `_phrase`.
    """
    result: list[_Token] = []
    place = 0
    while place < len(tokens):
        for phrase, plain in table.phrases:
            if tuple(tokens[place : place + len(phrase)]) == phrase:
                result += _phrase(plain)
                place += len(phrase)
                break
        else:
            result.append(tokens[place])
            place += 1
    return result


def _phrase(plain: str) -> list[_Token]:
    """Return the list of tokens for the meaning ``plain`` of a phrase.

    It is a comma for an empty meaning, the tokens of a meaning in TeX, a left side and "=" for one that ends in "=",
    a statement of its own between commas for a relation, and one `_Meaning` for an expression.
    """
    if not plain:
        return [","]
    if plain.startswith("\\"):
        return [*_tokens(plain)]
    if plain.endswith("="):
        return [_Meaning(plain.removesuffix("=")), "="]
    return [",", _Meaning(plain), ","] if _RELATES.search(plain) else [_Meaning(plain)]


class _Formula:
    """A recursive-descent reader of one statement, a list of tokens; `position` is the index of the next token.

    Methods named for a part of a formula read the part, step past it and return its syntax tree. They raise
    UnreadableError at a token that they do not expect. `thin` and `vectors` collect plain names of letters that are
    not bold and bold, `sums` the indices that are summed.
    """

    def __init__(self, tokens: list[_Token] | list[str], table: _Table) -> None:
        self.tokens: list[_Token] = list(tokens)
        self.table = table
        self.position = 0
        self.bold = False
        self.thin: set[str] = set()  # letters without an index, and those that are bold
        self.vectors: set[str] = set()
        self.sums: list[str] = []

    def relations(self) -> list[str]:
        """Return the statement as one or two relations in plain letters; "= const" at its end says d(left side) = 0.

        Raises UnreadableError if tokens are left over, nothing is compared, or an index of the left side is summed on
        another.
        """
        if len(self.tokens) == 1 and isinstance(self.tokens[0], _Meaning):
            return [write(parse(self.tokens[0].plain))]
        sides, operators, lines = [self.sum()], list[ast.cmpop](), list[str]()
        if self.table.left_side:
            sides, operators = [_expression(self.table.left_side), *sides], [ast.Eq()]
        while self.peek() in _SIGNS:
            sign = _SIGNS[str(self.take())]()
            if self.peek() == r"\text{const}" and isinstance(sign, ast.Eq):
                self.take()
                rate = ast.Compare(_call("d", sides[0]), [ast.Eq()], [ast.Constant(0)])
                lines.append(write([rate]))
                break
            operators.append(sign)
            self.sums = []
            sides.append(self.sum())
            if names(sides[0]) & set(self.sums):
                raise UnreadableError(f"the index of {ast.unparse(sides[0])} is summed on the other side")
        if self.position < len(self.tokens):
            raise UnreadableError(f"{self.peek()} in the formula is not read")
        if not operators and not lines:
            raise UnreadableError(f"{ast.unparse(sides[0])} is not related to anything")
        return ([write([ast.Compare(sides[0], operators, sides[1:])])] if operators else []) + lines

    def peek(self, ahead: int = 0) -> _Token:
        """Return the token ``ahead`` places after the next one, without stepping; "" past the end."""
        return self.tokens[self.position + ahead] if self.position + ahead < len(self.tokens) else ""

    def take(self, mark: str = "") -> _Token:
        """Return the next token and step past it.

        Raises UnreadableError at the end of the tokens, or if ``mark`` is given and the token is another.
        """
        head = self.peek()
        if head == "" or (mark and head != mark):
            raise UnreadableError(f"{mark or 'something'} is missing where the formula has {head or 'its end'}")
        self.position += 1
        return head

    def sum(self) -> ast.expr:
        r"""Read a sum, and return its syntax tree; \pm x becomes + sign*x, \mp x becomes - sign*x."""
        result: ast.expr | None = None
        while result is None or self.peek() in {"+", "-", r"\pm", r"\mp"}:
            sign = str(self.take()) if self.peek() in {"+", "-", r"\pm", r"\mp"} else "+"
            term = self.product()
            if sign in {r"\pm", r"\mp"}:
                term = _product(ast.Name("sign"), term)
            minus = sign in {"-", r"\mp"}
            if result is None:
                result = _minus(term) if minus else term
            else:
                result = ast.BinOp(result, ast.Sub() if minus else ast.Add(), term)
        return result

    def product(self, *, of_letters: bool = False) -> ast.expr:
        """Read factors until the product ends, with sums, products over an index and quotients among them.

        ``of_letters`` reads the argument of a function without brackets: letters, digits and slashes alone. Raises
        UnreadableError if there is no factor, or a sum has no such index behind it.
        """
        result: ast.expr | None = None
        sums: list[str] = []
        while not self.ends(of_letters=of_letters and result is not None):
            if self.peek() == r"\,":
                self.take()
            elif self.peek() == r"\sum":
                sums += self.summed()
            elif self.peek() == r"\prod":
                (index,) = self.summed()
                result = _product(result, _expanded(self.power(), index, "*"))
            elif isinstance(head := self.peek(), _Meaning) and head.plain.startswith(_TOTAL):
                self.take()
                result = _product(result, _expanded(self.product(), head.plain.removeprefix(_TOTAL), "+"))
            elif self.peek() in {"/", r"\times"} and result is not None:
                divides = self.take() == "/"
                result = ast.BinOp(result, ast.Div() if divides else ast.Mult(), self.power())
            else:
                self.argument(result)
                result = _product(result, self.power())
        if result is None:
            raise UnreadableError(f"a term is missing where the formula has {self.peek() or 'its end'}")
        if set(sums) - names(result) or len(set(sums)) < len(sums):
            raise UnreadableError(f"the sum over {', '.join(sums)} has no such index in it")
        return result

    def argument(self, before: ast.expr | None) -> None:
        """Raise UnreadableError if a bracket with one token, such as (x) or (-x), stands next: it may be an argument.

        ``before`` is the product read so far. Nothing is done where it is None, or the token in the bracket is an
        already replaced phrase.
        """
        if before is None or self.peek() != "(":
            return
        behind = self.tokens[self.position + 1 : self.position + 3]
        if isinstance(behind[0], _Meaning):
            return
        if behind[-1:] == [")"] or (behind[:1] == ["-"] and self.peek(3) == ")"):
            raise UnreadableError(f"({''.join(str(mark) for mark in behind).rstrip(')')}) is not read as an argument")

    def ends(self, *, of_letters: bool) -> bool:
        """Whether the next token ends a product; ``of_letters`` stops also at all but letters, digits and slashes.

        Nothing is read.
        """
        head = self.peek()
        if head == "" or head in _SIGNS or head in {"+", "-", r"\pm", r"\mp", ",", ";", r"\\"} or head in _CLOSING:
            return True
        return of_letters and not (self.is_letter() or str(head).isdigit() or head == "/")

    def summed(self) -> list[str]:
        r"""Step past a sign of sum or product and its lower index; return the index names, [] without an index.

        Each is one letter or number, two in \sum_{ij}; the names are added to `sums` too. A limit or a comma in the
        index raises UnreadableError.
        """
        self.take()
        if self.peek() != "_":
            return []
        self.take()
        indices = self.indices()
        self.sums += indices
        return indices

    def power(self) -> ast.expr:
        """Read a factor with what follows it: powers, T for the transpose, indices, and an argument t or 0 in brackets.

        The argument t is dropped, the argument 0 becomes at0(factor).
        """
        bold, self.bold = self.bold, False
        base = self.atom()
        while True:
            if self.peek() == "^":
                self.take()
                base = self.raised(base)
            elif self.peek() == "_":
                self.take()
                base = ast.Subscript(base, _tuple(self.indices()))
            elif self.tokens[self.position : self.position + 3] == ["(", "t", ")"]:
                self.position += 3
            elif self.tokens[self.position : self.position + 3] == ["(", "0", ")"]:
                self.position += 3
                base = _call("at0", base)
            else:
                self.bold |= bold
                return base

    def raised(self, base: ast.expr) -> ast.expr:
        """Read a superscript of ``base``: the transpose for T, a further index of an array, otherwise a power."""
        if self.peek() == "T":
            self.take()
            return _call("T", base)
        if isinstance(base, ast.Subscript) and (self.is_letter() or self.braced()):
            return ast.Subscript(base.value, _tuple([*_indices(base), *self.indices()]))
        exponent = self.group()
        return ast.BinOp(base, ast.Pow(), exponent)

    def braced(self) -> bool:
        """Whether a single letter in braces stands next; nothing is read."""
        mark = self.peek(1)
        return self.peek() == "{" and self.peek(2) == "}" and isinstance(mark, str) and mark.isalpha()

    def group(self) -> ast.expr:
        """Read a sum in braces, one digit, or one atom without braces; return its syntax tree."""
        if self.peek() == "{":
            self.take()
            result = self.sum()
            self.take("}")
            return result
        if str(self.peek()).isdigit():
            return ast.Constant(int(str(self.take())))
        return self.atom()

    def atom(self) -> ast.expr:
        """Read a replaced phrase, an integer, a letter, a bracket, a norm, a fraction, a matrix or a function."""
        head = self.peek()
        if isinstance(head, _Meaning):
            self.take()
            return _expression(head.plain)
        if head.isdigit():
            digits = ""
            while str(self.peek()).isdigit():
                digits += str(self.take())
            return ast.Constant(int(digits))
        if self.is_letter():
            return self.named()
        readers = {"{": self.group, r"\lvert": self.length, r"\frac": self.fraction, r"\begin{pmatrix}": self.matrix}
        readers |= dict.fromkeys(_PAIRS, self.bracket) | dict.fromkeys(_FUNCTIONS, self.function)
        if head not in readers:
            raise UnreadableError(f"{head or 'its end'} in the formula is not read")
        return readers[head]()

    def function(self) -> ast.expr:
        """Read a function and its argument: a bracket, a group, or letters without brackets.

        A power behind the name is one of the value: sin^2 x is the square of sin(x).
        """
        name = str(self.take()).strip("\\")
        if name == "sqrt":
            return _call(name, self.group())
        if name == "diag":
            return _call(name, *self.entries(str(self.take("("))))
        if self.peek() == "^":
            self.take()
            exponent = self.group()
            return ast.BinOp(_call(name, self.product(of_letters=True)), ast.Pow(), exponent)
        return _call(name, self.bracket() if self.peek() == "(" else self.product(of_letters=True))

    def bracket(self) -> ast.expr:
        """Read a bracket: a group of one entry, a product of two entries, or a row (a, b, c)^T as a list.

        The product is scalar for (a, b), vector for [a, b], Poisson's for {a, b}. Raises UnreadableError for three or
        more entries without ^T.
        """
        closing, product = _PAIRS[str(self.peek())]
        entries = self.entries(str(self.take()))
        if len(entries) == 1:
            return entries[0]
        if closing == ")" and self.tokens[self.position : self.position + 2] == ["^", "T"]:
            self.position += 2
            return ast.List(entries)
        if len(entries) == 2:
            return _call(product, *entries)
        raise UnreadableError("a row of numbers is not read where a column should stand")

    def entries(self, opening: str) -> list[ast.expr]:
        """Read the sums between commas or semicolons up to the bracket that closes ``opening``; return their trees.

        ``opening`` is the token of the bracket, which has been read.
        """
        entries = [self.sum()]
        while self.peek() in {",", ";"}:
            self.take()
            entries.append(self.sum())
        self.take(_PAIRS[opening][0])
        return entries

    def length(self) -> ast.expr:
        """Read a formula between bars: the tree of norm(...) if a letter in it is bold, else of abs(...)."""
        self.take()
        bold, self.bold = self.bold, False
        inside = self.sum()
        self.take(r"\rvert")
        name = "norm" if self.bold else "abs"
        self.bold = bold
        return _call(name, inside)

    def fraction(self) -> ast.expr:
        """Read a fraction: d/dt of the next factor, a partial derivative, or a quotient."""
        self.take()
        if self.tokens[self.position : self.position + 7] == ["{", "d", "}", "{", "d", "t", "}"]:
            self.position += 7
            return _call("d", self.power())
        if self.tokens[self.position : self.position + 2] == ["{", r"\partial"]:
            return _call("partial", *(self.varied() for _ in range(2)))
        top = self.group()
        return ast.BinOp(top, ast.Div(), self.group())

    def varied(self) -> ast.expr:
        r"""Read the braces behind a fraction of partial derivatives, such as {\partial f}, and return the tree of f."""
        self.take("{")
        self.take(r"\partial")
        inside = self.product()
        self.take("}")
        return inside

    def matrix(self) -> ast.expr:
        """Read a matrix, and return the tree of a list of rows, or of a list of entries for a single column."""
        self.take()
        rows: list[list[ast.expr]] = [[]]
        while True:
            rows[-1].append(self.sum())
            mark = self.take()
            if mark == r"\\":
                rows.append([])
            elif mark == r"\end{pmatrix}":
                break
            elif mark != "&":
                raise UnreadableError(f"{mark} in a matrix is not read")
        if len(rows[0]) == 1:
            return ast.List([row[0] for row in rows])
        return ast.List([ast.List(row) for row in rows])

    def is_letter(self) -> bool:
        """Whether a letter stands next, with or without accents; nothing is read."""
        head = self.peek()
        if not isinstance(head, str) or head in _FUNCTIONS:
            return False
        return (
            head in _ACCENTS
            or head in _FONTS
            or (len(head) == 1 and head.isalpha())
            or (len(head) > 2 and _GREEK.fullmatch(head[1:]) is not None)
        )

    def letter(self) -> _Letter:
        """Read a letter with accents, font, primes and lower index, in this order, as a `_Letter`."""
        accents: list[str] = []
        closing = 0
        while self.peek() in _ACCENTS:
            accents.append(str(self.take()))
            if self.peek() == "{":
                self.take()
                closing += 1
        font = str(self.take()) if self.peek() in _FONTS else ""
        if font and self.peek() == "{":
            self.take()
            base = ""
            while self.peek() != "}":
                base += str(self.take())
            self.take()
        else:
            base = str(self.take())
        primes, below = 0, list[str]()
        while True:
            if self.peek() == "'":
                self.take()
                primes += 1
            elif self.peek() == "_" and not below:
                self.take()
                below = self.below()
            elif self.peek() == "}" and closing:
                self.take()
                closing -= 1
            elif closing:
                raise UnreadableError(f"{self.peek()} under an accent is not read")
            else:
                return _Letter(tuple(accents), (font and f"{font} ") + base, primes, tuple(below))

    def below(self) -> list[str]:
        """Read a lower index, behind its underscore, and return its tokens: one token, or those in braces."""
        if self.peek() != "{":
            return [str(self.take())]
        self.take()
        marks, depth = list[str](), 0
        while depth or self.peek() != "}":
            mark = str(self.take())
            depth += (mark == "{") - (mark == "}")
            marks.append(mark)
        self.take()
        return marks

    def indices(self) -> list[str]:
        """Read a lower index, and return its names, each a letter or a number; UnreadableError for any other token."""
        return _plain(self.below())

    def named(self) -> ast.expr:
        """Read a letter, and return its syntax tree: the table's meaning, or its own name with its index.

        A letter without a meaning stands in d(...) or d2(...) if it has dots. A meaning that ends in "()" is called
        with the bracket that follows; one that ends in "[]" takes the index. Plain names are noted in `vectors` (bold)
        or `thin`.
        """
        letter = self.letter()
        self.bold |= letter.base.startswith(r"\mathbf")
        family = self.table.letters.get(_Letter(letter.accents, letter.base, letter.primes, ()), "")
        if letter.below and family.endswith("[]"):
            return self.syntax_of(letter)
        rates = [_ACCENTS[accent] for accent in letter.accents if accent in {r"\dot", r"\ddot"}]
        undotted = replace(letter, accents=tuple(a for a in letter.accents if a not in {r"\dot", r"\ddot"}))
        basis = self.table.letters.get(letter)
        if basis is not None and basis.endswith("()"):
            self.take("(")
            return _call(basis.removesuffix("()"), *self.entries("("))
        value = _expression(basis.removesuffix("[]")) if basis is not None else self.syntax_of(undotted)
        if isinstance(value, ast.Name):
            (self.vectors if letter.base.startswith("\\mathbf") else self.thin).add(value.id)
        for rate in reversed(rates) if basis is None else ():
            value = _call(rate, value)
        return value

    def syntax_of(self, letter: _Letter) -> ast.expr:
        """Return the syntax tree of a letter without dots: the table's meaning, an array's entry R[i, j], or a name.

        A name joins accents, letter, "p" for each prime, and digits of the index: hB2, B2p. Raises UnreadableError if
        the table gives that name to another letter.
        """
        if letter in self.table.letters:
            return _expression(self.table.letters[letter].removesuffix("[]"))
        bare = _Letter(letter.accents, letter.base, letter.primes, ())
        prefix = "".join(_ACCENTS[accent] for accent in letter.accents)
        name = prefix + _name(letter.base.split(" ")[-1].strip("\\")) + "p" * letter.primes
        vocabulary = self.table.letters.get(bare)
        if name + "".join(letter.below) in self.table.names_of_others(letter):
            raise UnreadableError(f"{name}{''.join(letter.below)} is the name of another letter")
        if letter.below and not (vocabulary is None and all(mark.isdigit() for mark in letter.below)):
            array = _expression(vocabulary.removesuffix("[]")) if vocabulary else ast.Name(name)
            return ast.Subscript(array, _tuple(_plain(letter.below)))
        return ast.Name(name + "".join(letter.below))


_GREEK = re.compile(
    "alpha|beta|gamma|delta|epsilon|zeta|eta|theta|kappa|lambda|mu|nu|xi|pi|rho|sigma|tau|phi|chi|psi|omega"
    "|varrho|Lambda|Phi|Omega"
)
_COMMON = {r"\mathbf{1}": "one", r"\epsilon": "eps[]"}


def _expanded(term: ast.expr, index: str, sign: str) -> ast.expr:
    """Return the tree of the sum (``sign`` "+") or product ("*") of three copies of a term, with ``index`` 1, 2, 3."""
    text = ast.unparse(term)
    return _expression(sign.join("(" + re.sub(rf"\b{index}\b", str(n), text) + ")" for n in (1, 2, 3)))


def _plain(below: Iterable[str]) -> list[str]:
    """Return the tokens of an index as names without backslashes: numbers, single letters, Greek names.

    Raises UnreadableError for any other token.
    """
    names = [_name(mark.strip("\\")) for mark in below]
    if not all(
        index.isdigit() or _GREEK.fullmatch(index.rstrip("_")) or (len(index) == 1 and index.isalpha())
        for index in names
    ):
        raise UnreadableError(f"the index {' '.join(below)} is not read")
    return names


def _name(word: str) -> str:
    """Return the word, with an underscore behind it where it is a keyword of Python such as lambda."""
    return f"{word}_" if keyword.iskeyword(word) else word


def _expression(plain: str) -> ast.expr:
    return ast.parse(plain.replace("^", "**"), mode="eval").body


def _call(name: str, *arguments: ast.expr) -> ast.Call:
    return ast.Call(ast.Name(name), list(arguments), [])


def _product(product: ast.expr | None, factor: ast.expr) -> ast.expr:
    return factor if product is None else ast.BinOp(product, ast.Mult(), factor)


def _minus(term: ast.expr) -> ast.expr:
    """Return the tree of a term with the opposite sign: the minus stands before the first factor of a product."""
    if isinstance(term, ast.BinOp) and isinstance(term.op, ast.Mult | ast.Div):
        return ast.BinOp(_minus(term.left), term.op, term.right)
    return ast.UnaryOp(ast.USub(), term)


def _tuple(indices: list[str]) -> ast.expr:
    entries: list[ast.expr] = [ast.Constant(int(index)) if index.isdigit() else ast.Name(index) for index in indices]
    return entries[0] if len(entries) == 1 else ast.Tuple(entries)


def _indices(node: ast.Subscript) -> list[str]:
    entries = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
    return [ast.unparse(entry) for entry in entries]
