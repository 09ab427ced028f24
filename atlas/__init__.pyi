# The public names with their types, for type checkers; atlas/__init__.py loads each when it is first used.

from atlas.core.bodies.body import SymmetricBody
from atlas.core.bodies.charge import ChargeMoments
from atlas.core.bodies.field import (
    Field,
    LaboratoryFrame,
)
from atlas.core.maps.monodromy import monodromy
from atlas.core.motions.asymmetric import AsymmetricMotion
from atlas.core.motions.ball import BallMotion
from atlas.core.motions.chosen import motion
from atlas.core.motions.clebsch import clebsch
from atlas.core.motions.elementary import (
    ElementaryMotion,
    FreeMotion,
)
from atlas.core.motions.elliptic import EllipticMotion
from atlas.core.motions.flight import Flight
from atlas.core.motions.general import GeneralMotion
from atlas.core.motions.particle import ParticleMotion
from atlas.core.motions.top import TopMotion
from atlas.core.surfaces.hyperbola import Hyperbola
from atlas.core.surfaces.quadric import Quadric
from atlas.draw import (
    figure,
    plotter,
)
from atlas.draw.animation import animate
from atlas.errors import (
    AtlasError,
    DomainError,
    NotCertifiedError,
)
from atlas.study.check import check
from atlas.study.drift import drift
from atlas.study.fit import fit
from atlas.study.simulate import simulate
from atlas.study.sweep.run import sweep

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
    "simulate",
    "sweep",
]
