"""The proved form of an equation as a number: what other floors are held against."""

from fractions import Fraction

import pytest
import sympy

from atlas.errors import AtlasError
from atlas.proof.formula import value


def test_a_formula_of_the_ledger_gives_an_exact_number() -> None:
    """Floats are taken as exact, so that the result is a fraction."""
    assert value("mf76", "omega3", omega2=0.5, I=1.5, B2=1.0, B3=2.0) == sympy.Rational(4, 9)
    assert value("mf77", "phi", omega2=0.5, I=1.5, B2=1.0, B3=2.0) == sympy.Rational(-5, 9)
    assert value("mf37", "alpha", mu=2, b=Fraction(1, 2), c=4) == sympy.Rational(1, 8)


def test_the_corrected_form_is_used() -> None:
    """mf56 has (2-I)^2, not (2-1)^2."""
    letters = {"c5": 0, "c3": 1, "E": 0, "Bsquare": 0}
    assert value("mf56", "a1", I=2, **letters) == 2
    assert value("mf56", "a1", I=1, **letters) == 0


def test_vectors_are_sequences() -> None:
    """A vector in, a vector out."""
    found = value("mf31", "dOmega", R=sympy.eye(3), Bf=[0, 0, 1], Omega=[1, 0, 0], mu=2, c=1)
    assert list(found) == [0, -1, 0]


def test_a_missing_letter_is_named() -> None:
    """Nothing is guessed."""
    with pytest.raises(AtlasError, match="B3"):
        value("mf76", "omega3", omega2=0.5, I=1.5, B2=1.0)
    with pytest.raises(AtlasError, match="does not say what 'psi' is"):
        value("mf76", "psi")
