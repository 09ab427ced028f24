"""The proved form of an equation as a number: the reference of other floors."""

import pytest

from atlas.errors import AtlasError
from atlas.trial.proofs.formula import value


def test_a_formula_takes_functions_and_names_a_missing_one() -> None:
    """The caller defines d, and a function that is not given is missed."""
    assert value("(37)", "0", d=lambda square: square, K=[1, 2, 3]) == 14
    with pytest.raises(AtlasError, match="needs the value of d too"):
        value("(37)", "0", K=[1, 2, 3])


def test_a_missing_letter_is_named() -> None:
    """Nothing is guessed."""
    with pytest.raises(AtlasError, match="B3"):
        value("(71)", "omega3", omega2=0.5, I=1.5, B2=1.0)
    with pytest.raises(AtlasError, match="has no side 'psi'"):
        value("(71)", "psi")
