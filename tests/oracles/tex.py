"""Reads the paper's scalar formulas from TeX, so that what was tried can be compared with what is printed."""

import re
from itertools import pairwise

import sympy

_FRACTION = re.compile(r"\\frac\s*(\d)\s*(\d)")
_TOKEN = re.compile(r"\\[A-Za-z]+|\d+|[A-Za-z]'?|[-+*/^(){}=,_']")
_SPACING = (r"\left", r"\right", r"\Bigl", r"\Bigr", r"\quad", r"\,", "&", r"\displaystyle")


def relations(tex: str, names: dict[str, str]) -> list[sympy.Expr]:
    """Return left - right of every equation in a formula; `names` renames letters, keyed as they are spelt here."""
    text = tex.replace(r"\begin{aligned}", "").replace(r"\end{aligned}", "")
    text = re.sub(r"\\\\ *&(?=[-+])", "", text)  # a formula that goes on in the next row
    text = re.sub(r"\\text\{[^}]*\}", ";", text)
    text = re.sub(r"\\\\|\\qquad|\\quad|;", " ; ", text)
    found = []
    for part in re.split(r"[;]", text):
        sides = re.split(r"=|\\equiv", part)
        if len(sides) == 1:
            continue
        values = [Formula(side.strip().strip(",."), names).value() for side in sides if side.strip().strip(",.& ")]
        found += [sympy.expand(sympy.together(left - right)) for left, right in pairwise(values)]
    return found


class Formula:
    """A recursive-descent reader: sums of products of powers, products without a sign between."""

    def __init__(self, tex: str, names: dict[str, str]) -> None:
        self.names = names
        for mark in _SPACING:
            tex = re.sub(re.escape(mark) + r"(?![A-Za-z])", " ", tex)
        tex = _FRACTION.sub(r"\\frac{\1}{\2}", tex).replace("[", "(").replace("]", ")")
        tex = tex.replace(r"\mathbf{B}'", "Z").replace(r"\mathbf{B}", "Z").replace(r"\lvert", "").replace(r"\rvert", "")
        self.tokens = _TOKEN.findall(tex)
        self.at = 0

    def value(self) -> sympy.Expr:
        """Return the whole formula."""
        result = self._sum()
        assert self.at == len(self.tokens), self.tokens[self.at :]
        return result

    def _peek(self) -> str:
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def _take(self) -> str:
        self.at += 1
        return self.tokens[self.at - 1]

    def _sum(self) -> sympy.Expr:
        negative = self._peek() == "-" and bool(self._take())
        result = self._product() * (-1 if negative else 1)
        while self._peek() in {"+", "-"}:
            result = result + self._product() if self._take() == "+" else result - self._product()
        return result

    def _product(self) -> sympy.Expr:
        result = self._power()
        while self._peek() and self._peek() not in {"+", "-", ")", "}", ",", "="}:
            result *= self._power()
        return result

    def _power(self) -> sympy.Expr:
        base = self._atom()
        while self._peek() == "^":
            self._take()
            base **= self._atom()
        return base

    def _group(self) -> sympy.Expr:
        opening = self._take()
        result = self._sum()
        assert self._take() == {"(": ")", "{": "}"}[opening]
        return result

    def _atom(self) -> sympy.Expr:
        if self._peek() in {"(", "{"}:
            return self._group()
        here = self._take()
        if here.isdigit():
            return sympy.Integer(here)
        if here == r"\frac":
            return self._group() / self._group()
        if here in {r"\sin", r"\cos"}:
            argument = self._group() if self._peek() == "(" else self._product_of_letters()
            return (sympy.sin if here == r"\sin" else sympy.cos)(argument)
        if here == r"\sqrt":
            return sympy.sqrt(self._group())
        return sympy.pi if here == r"\pi" else self._letter(here)

    def _product_of_letters(self) -> sympy.Expr:
        """Return the argument of a sine without brackets: a letter, and t if it follows."""
        result = self._letter(self._take())
        while self._peek() == "t":
            result *= self._letter(self._take())
        return result

    def _letter(self, here: str) -> sympy.Expr:
        mark = {r"\dot": "d_", r"\ddot": "dd_", r"\hat": "h"}.get(here, "")
        if mark:
            braced = self._peek() == "{" and bool(self._take())
            here = self._take()
            if braced:
                assert self._take() == "}"
        name = mark + here.strip("\\").rstrip("'")
        primed = here.endswith("'") or (self._peek() == "'" and bool(self._take()))
        if self._peek() == "_":
            self._take()
            name += str(self._group()) if self._peek() == "{" else self._take()
        name += "'" if primed else ""
        return sympy.Symbol(self.names.get(name, name))
