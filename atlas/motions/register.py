"""The register of families: each family of motions and surfaces once, its parameters, quantities and classes.

Commands, sweeps, the stress run, certified tables and the guide's reference of quantities are made from it.
"""

from collections.abc import Mapping
from types import MappingProxyType

from atlas.families.family import Command, Family, Parameter, Quantity, Sampled
from atlas.motions.elementary.family import BALL, FREE, HYPERBOLA
from atlas.motions.elementary.family import FAMILY as ELEMENTARY
from atlas.motions.nutation.family_elliptic import FAMILY as ELLIPTIC
from atlas.motions.nutation.family_general import FAMILY as GENERAL
from atlas.motions.nutation.family_top import FAMILY as TOP
from atlas.motions.particle.family import FAMILY as PARTICLE
from atlas.motions.torus.family import FAMILY as ASYMMETRIC
from atlas.surfaces.family import FAMILY as QUADRIC

__all__ = ["FAMILIES", "Command", "Family", "Parameter", "Quantity", "Sampled"]

FAMILIES: Mapping[str, Family] = MappingProxyType(
    {
        family.name: family
        for family in (ELEMENTARY, GENERAL, TOP, ELLIPTIC, ASYMMETRIC, FREE, HYPERBOLA, QUADRIC, BALL, PARTICLE)
    }
)
