"""A counterexample as it is printed: the plain letters and relations of the trial's record in TeX."""

import ast
import re
from collections.abc import Mapping

_LETTERS = {
    "Bf": "B",
    "Bp": "B'",
    "Bsquare": r"\mathbf{B}'^2",
    "drift": r"\dot{\mathbf{O}}",
    "dR": r"\dot{R}",
    "lam": r"\lambda",
    "lamM": r"\lambda",
    "w": r"\omega'",
    "eps": r"\epsilon",
} | {name: rf"\{name}" for name in ("alpha", "mu", "phi", "omega", "Omega")}
_PRIMED = {"B": "B'", "E": "E'"}
"""In Sections IV and V, whose field and energy have a prime."""
_ONE = "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]"
_PLACES = {"1": "first", "2": "second", "3": "third"}
_SIGNS = {ast.Eq: "=", ast.NotEq: r"\ne", ast.Lt: "<", ast.LtE: r"\le", ast.Gt: ">", ast.GtE: r"\ge"}
_RATES = {"d": "dot", "d2": "ddot"}
_NAME = re.compile(r"^(h(?=B)|)([A-Za-z]+?)(\d+|par|perp|)$")
_CALLS = {
    "cross": "[{},{}]",
    "dot": "({},{})",
    "norm": r"\lvert {}\rvert",
    "d": r"\tfrac{{d}}{{dt}}({})",
    "d2": r"\tfrac{{d^2}}{{dt^2}}({})",
    "sqrt": r"\sqrt{{{}}}",
    "T": "{}^T",
}


def counterexample_text(values_by_name: Mapping[str, str], section: str) -> str:
    """Return a counterexample in Markdown with TeX: values of the letters, and the broken equation or a reason.

    `values_by_name` holds the values as text by letter, and under "relation", "left", "right" the broken equation
    with the values of its sides, or under "reason" why it is false. `section` is that of the paper: in IV and V, B
    and E have a prime.
    """
    values = {
        name: value for name, value in values_by_name.items() if name not in {"relation", "left", "right", "reason"}
    }
    vectors = {name.partition("[")[0] for name, value in values.items() if re.match(r"\[[^\[]", value)}
    letters = _Letters(vectors, primed=section in {"IV", "V"})
    values_in_words = ", ".join(letters.value(name, value) for name, value in values.items())
    if "relation" not in values_by_name:
        sides = ", ".join(letters.typeset(values_by_name[side]) for side in ("left", "right") if side in values_by_name)
        return ": ".join(filter(None, (values_by_name["reason"], values_in_words, sides))) + "."
    relation, _, place = values_by_name["relation"].partition(" (component ")
    location = f" in the {_PLACES.get(place[:-1], f'{place[:-1]}th')} component" if place else ""
    sides = ", ".join(f"{side} {letters.typeset(values_by_name[side])}" for side in ("left", "right"))
    return f"{values_in_words} break ${letters.formula(relation)}${location}: {sides}."


class _Letters:
    """Writes formulas in plain letters as TeX; names in `vectors` become bold, with `primed` B and E get a prime."""

    def __init__(self, vectors: set[str], *, primed: bool) -> None:
        self.vectors, self.primed = vectors, primed

    def value(self, name: str, value: str) -> str:
        """Return "$letter=value$" in TeX, or "any other $letter=value$".

        Vectors stand in round brackets; the unit matrix is written as 1.
        """
        partner = "any other " if name.startswith("any other ") else ""
        number = "1" if value == _ONE else value.replace("[", "(").replace("]", ")")
        return f"{partner}${self.formula(name.removeprefix(partner))}={number}$"

    def typeset(self, side: str) -> str:
        """Return one side of a relation, a number or a formula in plain letters, as TeX between dollar signs.

        Of a text "formula has remark" only the formula becomes TeX; " has remark" follows as words.
        """
        formula, says, remainder = side.partition(" has ")
        return f"${formula if re.fullmatch(r'[-/0-9]+', formula) else self.formula(formula)}${says}{remainder}"

    def formula(self, line: str) -> str:
        """Return a relation or an expression in plain letters, such as "a = b^2", as TeX without dollar signs.

        Raises SyntaxError or TypeError for a text that is no formula of the trial.
        """
        python = re.sub(r"(?<![<>!=])=(?!=)", "==", line).replace("^", "**")
        return self.tex(ast.parse(python, mode="eval").body)

    def letter(self, name: str, *, bold: bool, accent: str = "") -> str:
        """Return the TeX of a letter such as "hB2": its hat, name, dots (``accent`` dot or ddot) and lower index.

        It is in bold type if `bold`.
        """
        if name in _LETTERS:
            letter, below = _LETTERS[name], ""
        else:
            hat, base, below = _NAME.findall(name)[0]
            letter = _LETTERS.get(base, _PRIMED.get(base, base) if self.primed and not hat else base)
            letter = rf"\hat{{{letter}}}" if hat else letter
        if bold and r"\mathbf" not in letter:
            letter = rf"\boldsymbol{{{letter}}}" if letter.startswith("\\") else rf"\mathbf{{{letter}}}"
        letter = rf"\{accent}{{{letter}}}" if accent else letter
        return letter + {"": "", "par": r"_\Vert", "perp": r"_\bot"}.get(below, f"_{{{below}}}")

    def tex(  # noqa: PLR0911  one return for each kind of formula
        self, node: ast.expr
    ) -> str:
        """Return the TeX, without dollar signs, of the syntax tree of a relation or an expression in plain letters.

        Raises TypeError for a tree that is no formula of the trial.
        """
        match node:
            case ast.Compare():
                signs = [_SIGNS[type(sign)] for sign in node.ops]
                tail = (f"{sign}{self.tex(side)}" for sign, side in zip(signs, node.comparators, strict=True))
                return f"{self.tex(node.left)}{''.join(tail)}"
            case ast.Name():
                return self.letter(node.id, bold=node.id in self.vectors)
            case ast.Constant():
                return str(node.value)
            case ast.List():
                return f"({', '.join(map(self.tex, node.elts))})"
            case ast.UnaryOp():
                return f"-{self.factor(node.operand)}"
            case ast.BinOp():
                return self.joined(node)
            case ast.Subscript(value=ast.Name(id=name), slice=at):
                return self.entry(name, at.elts if isinstance(at, ast.Tuple) else [at])
            case ast.Call(func=ast.Name(id="d" | "d2" as rate), args=[ast.Name(id=name)]):
                return self.letter(name, bold=name in self.vectors, accent=_RATES[rate])
            case ast.Call(func=ast.Name(id=name), args=arguments):
                return _CALLS.get(name, rf"\operatorname{{{name}}}({{}})").format(*map(self.tex, arguments))
        raise TypeError(f"{ast.unparse(node)} is no formula of the trial")

    def joined(self, node: ast.BinOp) -> str:
        """Return the TeX of a sum, a difference, a quotient or a power; any other operator is written as a product.

        `node` is a syntax tree of Python.
        """
        match node.op:
            case ast.Add():
                return f"{self.tex(node.left)}+{self.tex(node.right)}"
            case ast.Sub():
                return f"{self.tex(node.left)}-{self.factor(node.right)}"
            case ast.Div():
                return rf"\frac{{{self.tex(node.left)}}}{{{self.tex(node.right)}}}"
            case ast.Pow():
                return f"{{{self.factor(node.left)}}}^{{{self.tex(node.right)}}}"
        return f"{self.factor(node.left)} {self.factor(node.right)}"

    def entry(self, name: str, indices: list[ast.expr]) -> str:
        """Return the TeX of a letter with one or more indices, set below.

        The first index of x is the particle; a second one is the component and set above, and x is bold without it.
        """
        example, *alternatives = map(self.tex, indices)
        if name == "x":
            return f"{self.letter(name, bold=not alternatives)}_{{{example}}}" + "".join(
                f"^{{{exponent}}}" for exponent in alternatives
            )
        return f"{self.letter(name, bold=False)}_{{{' '.join([example, *alternatives])}}}"

    def factor(self, node: ast.expr) -> str:
        """Return the TeX of a factor's syntax tree: a sum or difference in brackets, any other formula as it is."""
        tex = self.tex(node)
        return f"({tex})" if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.Sub) else tex
