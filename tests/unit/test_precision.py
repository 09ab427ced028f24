"""Doubles do not depend on the precision that a user of flint has set."""

from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np
import pytest
from flint import ctx

import atlas
from atlas.errors import DomainError

TIMES = [0.0, 0.37, 12345.6]
MAKERS: list[Callable[[], Any]] = [
    lambda: atlas.ElementaryMotion(1.3, (1.1, 2.3), 0.7),
    lambda: atlas.Hyperbola(1.3, (1.1, 2.3)).closed(2, 3),
    lambda: atlas.FreeMotion(1.3, (0.1, 0.2, 0.3)),
    lambda: atlas.BallMotion(1.3, 0.5, (0.1, 0.2)),
    lambda: atlas.GeneralMotion(1.3, (1.1, 2.3), (0.3, 0.7, 0.21)),
    lambda: atlas.GeneralMotion(0.5, (1.0, 0.1), (0.0, -0.5, 0.23)),
    lambda: atlas.GeneralMotion(1e-3, (1.0, 0.1), (2.0, -0.5, 1e-3)),
    lambda: atlas.GeneralMotion(1.3, (1.1, 2.3), (0.3, 0.7, [0.21, 0.3, 0.4])),
    lambda: atlas.GeneralMotion.in_laboratory(1.3, (0.1, 1.1, 2.3), np.eye(3), (0.3, 0.7, 0.21)),
    lambda: atlas.TopMotion((1.0, 0.53), (0.1, 0.2), (0.6, 0.83), (0.1, 0.2, 5.0), linear=3.1, quadratic=0.3),
    lambda: atlas.EllipticMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), 1.7),
    lambda: atlas.AsymmetricMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), (0.3, 0.7, 0.2)),
]


def doubles(make: Callable[[], Any]) -> dict[str, list[float]]:
    """Return the values of a motion at some times, alone and in a grid, and its numbers."""
    motion = make()
    names = ("rotation", "angular_velocity", "field_in_body", "angular_momentum")
    found = {name: getattr(motion, name)(TIMES) for name in names if hasattr(motion, name)}
    found["grid"] = motion.rotation_grid(0.0, 0.01, 5)
    for name in ("k", "phi", "gamma", "omega", "turning_points", "period", "nome", "splitting", "frequencies", "H"):
        with suppress(AttributeError, DomainError):  # of another class, or without a value
            value = getattr(motion, name)
            found[name] = np.array(np.broadcast_arrays(*value) if isinstance(value, tuple) else value)
    return {name: values.tolist() for name, values in found.items()}


@pytest.mark.slow
@pytest.mark.parametrize("make", MAKERS)
def test_results_do_not_depend_on_flints_precision_outside(
    make: Callable[[], Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """With 12 binary digits, with 53 and with 500 every double is the same to its last bit."""
    values = []
    for bits in (12, 53, 500):
        monkeypatch.setattr(ctx, "prec", bits)
        values.append(doubles(make))
        assert ctx.prec == bits
    assert values[0] == values[1] == values[2]
