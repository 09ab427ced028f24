# The public names with their types, for type checkers; atlas/__init__.py loads each when it is first used.

from atlas.bodies.body import SymmetricBody
from atlas.bodies.charge import ChargeMoments
from atlas.bodies.clebsch_integrals import clebsch
from atlas.bodies.field import (
    Field,
    LaboratoryFrame,
)
from atlas.checking.check import check
from atlas.checking.simulate import simulate
from atlas.cli.reporting import report
from atlas.errors import (
    AtlasError,
    DomainError,
    NotCertifiedError,
)
from atlas.fitting import fit
from atlas.maps.monodromy import monodromy
from atlas.motions.any_body import motion
from atlas.motions.drift import drift
from atlas.motions.elementary.kernel import (
    ElementaryMotion,
    FreeMotion,
)
from atlas.motions.elementary.kernel_ball import BallMotion
from atlas.motions.elementary.kernel_hyperbola import Hyperbola
from atlas.motions.nutation.kernel_elliptic import EllipticMotion
from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.motions.nutation.kernel_top import TopMotion
from atlas.motions.particle.flight import Flight
from atlas.motions.particle.kernel import ParticleMotion
from atlas.motions.torus.kernel import AsymmetricMotion
from atlas.pictures.drawing import (
    figure,
    plotter,
)
from atlas.pictures.drawing.animation import animate
from atlas.surfaces.kernel import Quadric
from atlas.sweeps.run import sweep

__version__: str
_HOMES: dict[str, str]
__all__ = [
    "AsymmetricMotion",
    "AtlasError",
    "BallMotion",
    "ChargeMoments",
    "DomainError",
    "ElementaryMotion",
    "EllipticMotion",
    "Field",
    "Flight",
    "FreeMotion",
    "GeneralMotion",
    "Hyperbola",
    "LaboratoryFrame",
    "NotCertifiedError",
    "ParticleMotion",
    "Quadric",
    "SymmetricBody",
    "TopMotion",
    "__version__",
    "animate",
    "check",
    "clebsch",
    "drift",
    "figure",
    "fit",
    "monodromy",
    "motion",
    "plotter",
    "report",
    "simulate",
    "sweep",
]
