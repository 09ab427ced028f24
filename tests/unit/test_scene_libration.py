"""Omega3 away from equilibrium: its quartic about the start keeps its digits, also where Omega3 is large."""

from typing import Any

import pytest
from flint import fmpq, fmpq_poly

from atlas.core.motions.pseudo_oscillator import PseudoOscillator
from atlas.exact.nutation.quartic import Quartic
from atlas.scene import recipes
from atlas.scene.layers import Curve
from atlas.scene.libration import Libration


@pytest.mark.parametrize("ratio", [1.5, 0.3, 1e-7, 1e-12])
def test_the_quartic_about_the_start_has_exact_coefficients(ratio: float) -> None:
    """The powers of v = Omega3 - omega3 are those of the rational quartic, each to 16 eps of what it is the sum of."""
    B2, B3, omega1, omega2 = 1.0, 2.0, 0.4, 0.7
    I = fmpq(*ratio.as_integer_ratio())
    omega3 = B3 * (omega1**2 + omega2 * (omega2 + (2 - ratio) * B2)) / (ratio * B2 * (omega2 + B2))
    exact: Any = [fmpq(*x.as_integer_ratio()) for x in (omega1, omega2, omega3)]
    quartic = Quartic(I, tuple(exact), (fmpq(0), fmpq(1), fmpq(2)))
    about = quartic.polynomial(fmpq_poly([exact[2], 1]))
    powers = Libration(PseudoOscillator(ratio, (B2, B3), (omega1, omega2, omega3))).powers
    for n, found in enumerate(powers):
        assert abs(found - int(about[n].p) / int(about[n].q)) <= 16 * 2.0**-52 * 20


@pytest.mark.parametrize("ratio", [1e-7, 1e-12])
def test_the_departure_from_the_quadric_of_a_needle_is_no_noise(ratio: float) -> None:
    """Its curves need as few points as those of any other body: were they noise, they would be cut without end."""
    made = recipes.load("quadric_leak").scene(ratio=ratio)
    sizes = [len(layer.points) for panel in made.panels for layer in panel.layers if isinstance(layer, Curve)]
    assert max(sizes) < 2000


@pytest.mark.parametrize(("omega2", "omega3"), [(0.3, 0.2), (-2.5, 0.7), (0.9, -1.1)])
def test_a_libration_from_a_turning_point_starts_at_one_of_its_ends(omega2: float, omega3: float) -> None:
    """With omega1 = 0 one turning point is the start itself: the path starts there at t = 0, at rest."""
    libration = Libration(PseudoOscillator(1.5, (1.0, 2.0), (0.0, omega2, omega3)))
    assert min(libration.above, -libration.below) == 0.0
    (time, departure), (_, later) = libration.departure([0.0, 1e-4])
    assert (time, departure) == pytest.approx((0.0, 0.0), abs=1e-15)
    assert abs(later) <= 1e-7 * (libration.above - libration.below)
