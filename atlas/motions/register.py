"""The register of families: each family of motions and surfaces once, its parameters, quantities and classes.

Commands, sweeps, the stress run, certified tables and the guide's reference of quantities are made from it.
"""

from collections.abc import Mapping
from types import MappingProxyType

from atlas.families.family import Command, Family, Parameter, Quantity, Sampled
from atlas.motions.elementary import family as elementary
from atlas.motions.elementary import family_ball as ball
from atlas.motions.elementary import family_free as free
from atlas.motions.elementary import family_hyperbola as hyperbola
from atlas.motions.nutation import family_elliptic as elliptic
from atlas.motions.nutation import family_general as general
from atlas.motions.nutation import family_top as top
from atlas.motions.particle import family as particle
from atlas.motions.torus import family as asymmetric
from atlas.surfaces import family as quadric

__all__ = ["FAMILIES", "Command", "Family", "Parameter", "Quantity", "Sampled"]

FAMILIES: Mapping[str, Family] = MappingProxyType(
    {
        module.FAMILY.name: module.FAMILY
        for module in (elementary, general, top, elliptic, asymmetric, free, hyperbola, quadric, ball, particle)
    }
)  # fmt: skip
