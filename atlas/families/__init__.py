"""The register of families: each family of motions and surfaces once, its parameters, quantities and classes.

Commands, sweeps, the stress run, certified tables and the guide's reference of quantities are made from it.
"""

from collections.abc import Mapping
from types import MappingProxyType

from atlas.families import asymmetric, ball, elementary, elliptic, free, general, hyperbola, particle, quadric, top
from atlas.families.family import Command, Family, Parameter, Quantity, Sampled

__all__ = ["FAMILIES", "Command", "Family", "Parameter", "Quantity", "Sampled"]

FAMILIES: Mapping[str, Family] = MappingProxyType(
    {
        module.FAMILY.name: module.FAMILY
        for module in (elementary, general, top, elliptic, asymmetric, free, hyperbola, quadric, ball, particle)
    }
)  # fmt: skip
