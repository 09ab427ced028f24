"""An analytical atlas of the exact motion of a charged symmetric body in constant electric and magnetic fields.

    >>> import atlas
    >>> motion = atlas.ElementaryMotion(1.5, (1.0, 2.0), omega2=0.7)
    >>> round(motion.k, 9), round(motion.phi, 9)
    (1.565247584, -0.741176471)

Bodies and fields: SymmetricBody, ChargeMoments, Field, LaboratoryFrame. Surfaces of initial data: Quadric, Hyperbola.
Motions: motion (any body from any start, by the class that fits); ElementaryMotion (the paper's), GeneralMotion (from
any start), BallMotion, FreeMotion, TopMotion (any symmetric top), EllipticMotion and AsymmetricMotion (three different
moments), ParticleMotion, Flight. Pictures: figure, plotter, animate. Reports: report. Tables: sweep. Periods round a
loop: monodromy. To compare with: simulate, check, clebsch. Slow changes: drift. From measurements: fit. Errors:
AtlasError, DomainError, NotCertifiedError.

Names are loaded when they are first used, so that a number costs no drawing library.
"""

import sys

if (program := [*getattr(sys, "argv", ()), ""][0]).endswith(("/atlas", "/atlas/__main__.py")) or (
    program == "-m" and "atlas" in sys.orig_argv
):
    # not the module signal, which imports enum first: Ctrl-C meanwhile would print a traceback
    import _signal  # type: ignore[import-not-found]

    if _signal.getsignal(_signal.SIGINT) is _signal.default_int_handler:  # until atlas/__main__.py heeds it
        _signal.signal(_signal.SIGINT, _signal.SIG_DFL)

from functools import partial
from importlib import import_module
from typing import Any

from atlas.viewers import VIEWERS

__version__ = "0.4.0.dev0"

_HOMES = {
    "AtlasError": "atlas.errors",
    "DomainError": "atlas.errors",
    "NotCertifiedError": "atlas.errors",
    "SymmetricBody": "atlas.bodies.body",
    "Field": "atlas.bodies.field",
    "LaboratoryFrame": "atlas.bodies.field",
    "Quadric": "atlas.surfaces.kernel",
    "Hyperbola": "atlas.motions.elementary.kernel_hyperbola",
    "ElementaryMotion": "atlas.motions.elementary.kernel",
    "FreeMotion": "atlas.motions.elementary.kernel",
    "GeneralMotion": "atlas.motions.nutation.kernel_general",
    "TopMotion": "atlas.motions.nutation.kernel_top",
    "AsymmetricMotion": "atlas.motions.torus.kernel",
    "EllipticMotion": "atlas.motions.nutation.kernel_elliptic",
    "ChargeMoments": "atlas.bodies.charge",
    "motion": "atlas.motions.any_body",
    "BallMotion": "atlas.motions.elementary.kernel_ball",
    "ParticleMotion": "atlas.motions.particle.kernel",
    "Flight": "atlas.motions.particle.flight",
    "clebsch": "atlas.bodies.clebsch_integrals",
    "monodromy": "atlas.maps.monodromy",
    "check": "atlas.checking.check",
    "fit": "atlas.fitting",
    "sweep": "atlas.sweeps.run",
    "simulate": "atlas.checking.simulate",
    "drift": "atlas.motions.drift",
    "figure": "atlas.pictures.drawing",
    "plotter": "atlas.pictures.drawing",
    "animate": "atlas.pictures.drawing.animation",
    "report": "atlas.cli.reporting",
}

VIEWERS.update((name, partial(import_module, f"atlas.notebook.{name}")) for name in ("show", "pictures", "frames"))

__all__ = [*_HOMES, "__version__"]  # noqa: PLE0604  the names are strings


def __getattr__(name: str) -> Any:
    """Return the public object `name`; its module is imported at first use. Raises AttributeError for another name."""
    if name not in _HOMES:
        raise AttributeError(f"module 'atlas' has no attribute {name!r}")
    return globals().setdefault(name, getattr(import_module(_HOMES[name]), name))


def __dir__() -> list[str]:
    """Return the public names, sorted, for `dir(atlas)`."""
    return sorted(__all__)
