"""The proved form of an equation as a number: what other floors are held against."""

from fractions import Fraction

import pytest
import sympy

from atlas.errors import AtlasError
from atlas.proof.formula import value


def test_a_formula_of_the_ledger_gives_an_exact_number() -> None:
    """Floats are taken as exact, so that the result is a fraction."""
    assert value("(71)", "omega3", omega2=0.5, I=1.5, B2=1.0, B3=2.0) == sympy.Rational(4, 9)
    assert value("(72)", "phi", omega2=0.5, I=1.5, B2=1.0, B3=2.0) == sympy.Rational(-5, 9)
    assert value("(27)", "alpha", mu=2, Bf=[0, Fraction(1, 2), 0], c=4) == sympy.Rational(1, 8)


def test_the_corrected_form_is_used() -> None:
    """(48) has (2-I)^2, not (2-1)^2."""
    letters = {"c5": 0, "c3": 1, "E": 0, "Bsquare": 0}
    assert value("(48)", "a1", I=2, **letters) == 2
    assert value("(48)", "a1", I=1, **letters) == 0


def test_vectors_are_sequences() -> None:
    """A vector in, a vector out."""
    found = value("(21)", "d(Omega)", R=sympy.eye(3), Bf=[0, 0, 1], Omega=[1, 0, 0], mu=2, c=1)
    assert list(found) == [0, -1, 0]


def test_any_side_of_an_equation_can_be_asked_for() -> None:
    """A whole side as the trial writes it: the letter may stand on the right, or nothing but a zero."""
    assert value("(36)", "E", Omega1=1, Omega2=2, Omega3=3, I=2) == 1 + 4 + 18
    assert value("(36)", "at0(E)", omega1=1, omega2=2, omega3=3, I=2) == 1 + 4 + 18
    on_the_hyperbola = value("(71)", "omega3", omega2=0.5, I=1.5, B2=1, B3=2)
    assert value("(67)", "0", omega2=0.5, omega3=on_the_hyperbola, I=1.5, B2=1, B3=2) == 0
    assert value("(67)", "0", omega2=0.5, omega3=on_the_hyperbola, I=1.5, B2=1, B3=-2) != 0


def test_a_chain_is_read_where_all_letters_are_known() -> None:
    """(72) gives phi twice, once with omega3."""
    assert value("(72)", "phi", omega3=5, B3=3, B2=2, omega2=4) == -1


def test_free_indices_make_vectors_and_matrices() -> None:
    """(12) has two, in their order: dR = R hat(Omega)."""
    R, Omega = [[1, 2, 3], [4, 5, 6], [7, 8, 10]], [1, 2, 3]
    hat = sympy.Matrix([[0, -3, 2], [3, 0, -1], [-2, 1, 0]])
    assert value("(12)", "d(R[i,j])", R=R, Omega=Omega) == sympy.Matrix(R) * hat
    free = value("(11)", "IdOmega[k]", I=sympy.diag(1, 1, 3), Omega=Omega, A=sympy.zeros(3, 3), R=sympy.eye(3))
    assert list(free) == [-12, 6, 0]


def test_functions_are_letters_too() -> None:
    """What d does is for the caller to say, and a function that is not given is missed."""
    assert value("(37)", "0", d=lambda square: square, K=[1, 2, 3]) == 14
    with pytest.raises(AtlasError, match="needs the value of d too"):
        value("(37)", "0", K=[1, 2, 3])


def test_a_missing_letter_is_named() -> None:
    """Nothing is guessed."""
    with pytest.raises(AtlasError, match="B3"):
        value("(71)", "omega3", omega2=0.5, I=1.5, B2=1.0)
    with pytest.raises(AtlasError, match="does not say what 'psi' is"):
        value("(71)", "psi")
