"""An analytical atlas of the exact motion of a charged symmetric body in constant electric and magnetic fields.

Names are loaded when they are first used, so that a number costs no drawing library.
"""

from importlib import import_module
from typing import Any

__version__ = "0.2.0"

_HOMES = {
    "AtlasError": "atlas.errors",
    "DomainError": "atlas.errors",
    "NotCertifiedError": "atlas.errors",
    "SymmetricBody": "atlas.core.body",
    "Field": "atlas.core.field",
    "LaboratoryFrame": "atlas.core.field",
    "Quadric": "atlas.core.quadric",
    "Hyperbola": "atlas.core.hyperbola",
    "ElementaryMotion": "atlas.core.elementary",
    "FreeMotion": "atlas.core.elementary",
    "GeneralMotion": "atlas.core.general",
    "TopMotion": "atlas.core.top",
    "AsymmetricMotion": "atlas.core.asymmetric",
    "EllipticMotion": "atlas.core.elliptic",
    "ChargeMoments": "atlas.core.charge_moments",
    "BallMotion": "atlas.core.ball",
    "ParticleMotion": "atlas.core.particle",
    "Flight": "atlas.core.flight",
    "clebsch": "atlas.core.clebsch",
    "sweep": "atlas.study.sweep.run",
    "simulate": "atlas.study.simulate",
    "figure": "atlas.draw",
    "plotter": "atlas.draw",
    "animate": "atlas.draw.animation",
}

__all__ = [*_HOMES, "__version__"]  # noqa: PLE0604  the names are strings


def __getattr__(name: str) -> Any:
    """Load a public name from its home."""
    if name not in _HOMES:
        raise AttributeError(f"module 'atlas' has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    """List the public names."""
    return sorted(__all__)
