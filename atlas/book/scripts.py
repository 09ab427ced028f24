"""The scripts of the pages: as they stand in ``templates/html``, below formulas and looks that Python has once.

A formula of a file `formula.py` is evaluated on `Term`, which writes each operation as a line of JavaScript, in the
same order; a look is that of a role of `atlas.pictures.style`.
"""

import json
from collections.abc import Callable
from typing import Any

from atlas.motions.elementary import formula_hyperbola as hyperbola
from atlas.motions.nutation.rows_roots import from_start
from atlas.pictures.style import STYLES
from atlas.places import folder
from atlas.surfaces import formula as quadric


def nutation(_: Any, I: Any, B2: Any, B3: Any, *omega: Any) -> tuple[Any, ...]:
    """Return the coefficients of (dOmega3/dt)^2 as a polynomial in Omega3 - omega3, a tuple, the constant one first.

    `I` is I3/I2, (B2, B3) the field and `omega` the angular velocity (3,) in the body at t = 0, both in 1/time; the
    first argument, I2 = 1, is not used.
    """
    momenta = (omega[1] + B2, I * (omega[2] + B3))
    return from_start(I, (B2, B3), omega, momenta, (1, 1), I - 1)


FORMULAS: dict[str, tuple[Callable[..., Any], str]] = {
    "ordinate": (hyperbola.ordinate, "I B2 B3 omega2"),
    "frequencies": (hyperbola.frequencies, "I B2 B3 omega2"),
    "stability": (hyperbola.stability, "I B2 B3 omega2"),
    "nutation": (nutation, "I B2 B3 omega1 omega2 omega3"),
    "closing": (hyperbola.closing, "I B2 B3 r"),
    "residual": (quadric.residual, "I B2 B3 omega1 omega2 omega3"),
    "halfAngle": (quadric.half_angle, "I B2 B3"),
}
"""The formulas that scripts use, with their arguments; moments of inertia are in units of I2."""
FORMULAIC = "explorer.js"
"""The script that uses them."""


class Term:
    """A number of a generated script: the name of a variable, and the list of assignments that all terms share.

    Arithmetic with terms or numbers appends an assignment, "x3 = x1 + x2", and returns a new term.
    """

    def __init__(self, name: str, lines: list[str]) -> None:
        self.name, self.lines = name, lines

    def _named(self, expression: str) -> "Term":
        self.lines.append(f"x{len(self.lines)} = {expression}")
        return Term(f"x{len(self.lines) - 1}", self.lines)

    def __str__(self) -> str:
        return self.name

    def __add__(self, term: Any) -> "Term":
        return self._named(f"{self} + {term}")

    def __radd__(self, term: Any) -> "Term":
        return self._named(f"{term} + {self}")

    def __sub__(self, term: Any) -> "Term":
        return self._named(f"{self} - {term}")

    def __rsub__(self, term: Any) -> "Term":
        return self._named(f"{term} - {self}")

    def __mul__(self, term: Any) -> "Term":
        return self._named(f"{self} * {term}")

    def __rmul__(self, term: Any) -> "Term":
        return self._named(f"{term} * {self}")

    def __truediv__(self, term: Any) -> "Term":
        return self._named(f"{self} / {term}")

    def __neg__(self) -> "Term":
        return self._named(f"-{self}")

    def __abs__(self) -> "Term":
        return self._named(f"Math.abs({self})")

    def sqrt(self) -> "Term":
        """Append the square root to the script as an assignment, and return its term."""
        return self._named(f"Math.sqrt({self})")

    def scaled(self, power: int) -> "Term":
        """Append the product with 2**power to the script as an assignment, and return its term."""
        return self._named(f"{self} * {2**power}")

    def select(self, positive: Any, alternative: Any) -> "Term":
        """Append the choice of `positive` if this term is above zero when the script runs, else `alternative`.

        Both are terms or numbers; returns the term of the choice.
        """
        return self._named(f"{self} > 0 ? {positive} : {alternative}")


def function_source(name: str, formula: Callable[..., Any], arguments: str) -> str:
    """Return the source of a JavaScript function `name`, a property of an object, that evaluates a formula with I2 = 1.

    `arguments` are the names of the formula's arguments after the first, I2, separated by spaces. A tuple becomes
    an array.
    """
    lines, names = list[str](), arguments.split()
    value = formula(1, *(Term(argument, lines) for argument in names))
    result = f"[{', '.join(map(str, value))}]" if isinstance(value, tuple) else str(value)
    steps = "".join(f"  const {line};\n" for line in lines)
    return f"{name}: ({', '.join(names)}) => {{\n{steps}  return {result};\n}}"


def script(name: str) -> str:
    """Return the source of a script of the pages, the file `name` of templates/html.

    The functions of `FORMULAS` and the looks of roles are put before the script named FORMULAIC.
    """
    text = (folder("templates") / "html" / name).read_text(encoding="utf-8")
    if name != FORMULAIC:
        return text
    functions = ",\n".join(function_source(formula_name, *formula) for formula_name, formula in FORMULAS.items())
    looks = {
        role: [look.colour, look.tube, look.back, look.glass] for role, look in STYLES.items() if f'"{role}"' in text
    }
    return f"globalThis.atlasFormulas = {{\n{functions},\n}};\nglobalThis.atlasLooks = {json.dumps(looks)};\n{text}"
