r"""The ledger: the labelled equations of the paper, the claims that it makes in words, and our own theorems.

The paper: A. A. Deriglazov, *Rotation matrix of a charged symmetrical body: one-parameter family of solutions in
elementary functions*, arXiv 2403.12089, Universe 2024, 10(6), 250. One file holds one topic, in the paper's order.
Data only: what is true of it is decided in `atlas.proof`.

The numbers are those that LaTeX prints: a row of `eqnarray` that ends in `\\` or closes the environment takes a number
unless it says `\nonumber`; a row that ends in the primitive `\cr` takes none.
"""

import re
from collections.abc import Mapping
from types import MappingProxyType

from atlas.errors import unknown
from atlas.paper import (
    ball,
    clebsch,
    closed,
    elementary,
    euler_poisson,
    general,
    hyperbola,
    lagrangian,
    particle,
    pseudo_oscillator,
    quadric,
    separatrix,
    theorems,
)
from atlas.paper.equation import Equation, Kind, Section

__all__ = ["EQUATIONS", "LABEL", "Equation", "Kind", "Section", "equation", "topic"]

_FILES = (
    *(lagrangian, euler_poisson, ball, pseudo_oscillator, quadric, hyperbola, elementary, particle),
    *(theorems, clebsch, general, separatrix, closed),
)

_TOPICS = {entry.label: file.__name__.rpartition(".")[2] for file in _FILES for entry in file.EQUATIONS}

EQUATIONS: Mapping[str, Equation] = MappingProxyType(
    {entry.label: entry for file in _FILES for entry in file.EQUATIONS}
)


LABEL = re.compile(r"(?<![@\w-])(?:mf\d+(?:\.\d+)?[ab]?|The\.1|Aff100|(?:text|theorem)(?:-[a-z0-9]+)+)\b")
"""A label where a docstring or a caption names it; those that are numbers, such as 1.6, can't be told from numbers."""


def equation(label: str) -> Equation:
    """Return the equation with that label; AtlasError with the nearest label if there is none."""
    if label not in EQUATIONS:
        raise unknown("equation", label, EQUATIONS, "in the ledger")
    return EQUATIONS[label]


def topic(label: str) -> str:
    """Return the topic of an equation: the stem of its file here, and of the files about it on the other floors."""
    return _TOPICS[equation(label).label]
