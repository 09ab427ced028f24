"""What is tried is what is printed: the lines in plain letters against the TeX of the ledger."""

import pytest
import sympy
from oracles import tex

from atlas.paper import EQUATIONS
from atlas.proof.notation import Reader
from atlas.proof.run import trial

NAMES = {
    "E'": "E",
    "B2'": "B2",
    "B3'": "B3",
    "Z": "Bvec",
    "omega1'": "w1",
    "omega2'": "w2",
    "omega3'": "w3",
    "phi'": "phip",
}
LETTERS = {
    "d": lambda x: sympy.Symbol(f"d_{x}"),
    "d2": lambda x: sympy.Symbol(f"dd_{x}"),
    "sin": sympy.sin,
    "cos": sympy.cos,
    "sqrt": sympy.sqrt,
    "pi": sympy.pi,
    "Bsquare": sympy.Symbol("Bvec") ** 2,
    "amp": sympy.Symbol("b"),
    "dOmega3": sympy.Integer(0),
}
# the scalar formulas; names that the lines write in another way
SCALAR: dict[str, dict[str, str]] = {
    "(29)": {"hk2": "k2", "hk3": "k3"},
    "(38)": {},
    "(39)": {},
    "(42)": {},
    "(46)": {},
    "(47)": {},
    "(50)": {},
    "(51)": {},
    "(54)": {},
    "(53)": {},
    "(56)": {},
    "(59)": {"d_Omega1": "dOmega1", "d_Omega2": "dOmega2"},
    "(60)": {"d_K1": "dK1", "d_K2": "dK2"},
    "(62)": {},
    "(63)": {"d_Omega1": "dOmega1", "d_Omega2": "dOmega2"},
    "(64)": {"d_Omega1": "nu1", "d_Omega2": "nu2"},
    "(65)": {},
    "(66)": {},
    "(67)": {},
    "(49)": {"dd_Omega3": "ddOmega3"},
    "(75)": {"d_gamma1": "dgamma1", "d_gamma2": "dgamma2", "d_gamma3": "dgamma3"},
    "(78)": {},
    "(79)": {},
    "(86)": {"phiB": "phiB", "kB": "kB", "Bvec": "b", "Z": "b"},
    "(87)": {},
    "(27)": {"Bvec": "b", "Z": "b"},
    "(33)": {"E": "energy"},
    "(48)": {},
    "(52)": {"Omega3": "omega3"},
    "(71)": {},
    "(72)": {},
    "(77)": {"B3": "Bl3", "B2": "Bl2"},
    "(80)": {},
    "(81)": {},
    "(82)": {"gamma1": "start1", "gamma2": "start2", "gamma3": "start3"},
}
# arguments of functions, which the lines leave out
ARGUMENTS = ("(t)", "(0)", r"(\omega_1, \omega_2)", r"(\omega_2)", r"(\boldsymbol{\omega}, \mathbf{B}')")


@pytest.mark.parametrize("name", SCALAR)
def test_the_line_that_is_tried_says_what_is_printed(name: str) -> None:
    """Each equation of the TeX occurs in the line, but for its sign as a whole."""
    text = EQUATIONS[name].tex
    for argument in ARGUMENTS:
        text = text.replace(argument, "")
    printed = tex.relations(text, {**NAMES, **SCALAR[name]})
    lines = [
        sympy.expand(sympy.together(left - right))
        for found in Reader(LETTERS).relations(trial(name).printed)
        for left, right in zip(found.left, found.right, strict=True)
    ]
    plain = [line.xreplace({s: sympy.Symbol(s.name) for s in line.free_symbols}) for line in lines]
    assert printed
    for difference in filter(None, printed):
        assert any(sympy.expand(sympy.together(difference - sign * line)) == 0 for line in plain for sign in (1, -1)), (
            difference
        )
