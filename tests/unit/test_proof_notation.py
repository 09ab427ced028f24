"""Printed formulas are read as a physicist reads them."""

import pytest
import sympy

from atlas.trial.ledger import EQUATIONS
from atlas.trial.proofs.model import COMMON, matrix, vector
from atlas.trial.proofs.notation import NoMeaningError, Reader, parse, write
from atlas.trial.proofs.run import trial

R, S, v, w = matrix("R"), matrix("S"), vector("v"), vector("w")
LETTERS = {
    **COMMON,
    "R": R,
    "S": S,
    "v": v,
    "w": w,
    "x": sympy.Symbol("x"),
    "m": {1: sympy.Integer(2), 2: sympy.Integer(5)},
}


def _sides(line: str, **ranges: tuple[int, ...]) -> list[tuple[object, object]]:
    return [
        pair
        for relation in Reader(LETTERS, ranges).relations(line)
        for pair in zip(relation.lhs, relation.rhs, strict=True)
    ]


@pytest.mark.parametrize(
    "line",
    [
        "(R*S)[i,j] = R[i,k]*S[k,j]",
        "cross(v,w)[i] = eps[i,j,k]*v[j]*w[k]",
        "dot(v,w) = v[i]*w[i]",
        "T(R)[i,j] = R[j,i]",
        "tr(R) = R[a,a]",
        "v[i] = delta[i,j]*v[j]",
        "one[i,j] = delta[i,j]",
        "v^2 = v[1]*v[1] + v[2]*v[2] + v[3]*v[3]",
        "R*v = [R[1,a]*v[a], R[2,a]*v[a], R[3,a]*v[a]]",
        "7 = m[N]",
        "x - 2*x/4 = x/2",
        "0 = x*0",
    ],
)
def test_index_formulas_follow_the_summation_convention(line: str) -> None:
    """Repeated indices are summed, free ones run over all values, matrices multiply."""
    for side, side_expected in _sides(line, N=(1, 2)):
        assert sympy.expand(side - side_expected) == 0


@pytest.mark.parametrize("line", ["R[i,j] = v[i]", "v[i] = v[i] + w[j]", "x = v", "R = v", "x"])
def test_sides_of_different_kinds_are_refused(line: str) -> None:
    """Sides of different kinds are refused, not broadcast."""
    with pytest.raises((NoMeaningError, TypeError)):
        Reader(LETTERS).relations(line)


@pytest.mark.parametrize("name", EQUATIONS)
def test_every_printed_line_is_written_as_it_is_read(name: str) -> None:
    """Writing a line that was read gives one that reads the same."""
    line = write(parse(trial(name).printed))
    assert write(parse(line)) == line
