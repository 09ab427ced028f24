"""What a figure is made for: a journal's column, a slide, a poster, and what is asked there of width, type and lines.

Each target names its source. What a publisher does not say is not made up: ``asks`` says so, and the value is ours.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from atlas.errors import unknown

TYPE = 8.6
"""Points: the least type whose capitals and figures are 2 mm high; its subscripts, 0.7 of it, have 6 points."""


@dataclass(frozen=True)
class Target:
    """A publication or medium that figures are made for, with the limits that it sets.

    ``width`` is the figure's width and ``height`` its greatest height, in millimetres; ``type`` the size of all
    text in points; ``lines`` the least and greatest line width in points; ``dpi`` the resolution of pixel images.
    ``asks`` states the publisher's rules in words, ``source`` their address, "" where there is none.
    """

    width: float
    height: float
    type: float
    lines: tuple[float, float]
    dpi: float
    asks: str
    source: str

    @property
    def zoom(self) -> float:
        """Factor by which text, marks and arrows are larger than in a journal: the type size over TYPE."""
        return self.type / TYPE


ANY = 100.0
"""Points: as wide as lines may be where nobody says how wide."""
_APS = Target(
    86.0,
    215.0,
    TYPE,
    (0.52, ANY),
    600.0,
    "a column of 8.6 cm, 17.8 cm across both; letters and figures at least 2 mm high, lines at least 0.18 mm (0.5 pt), "
    "600 dpi; the height is that of a page of REVTeX with room for a caption",
    "https://journals.aps.org/authors/style-basics",
)
_ELSEVIER = Target(
    90.0,
    240.0,
    TYPE,
    (0.1, 1.5),
    600.0,
    "90, 140 or 190 mm, at most 240 mm high; type 7 pt, subscripts 6 pt; lines from 0.1 to 1.5 pt; 500 dpi where "
    "pictures and letters meet",
    "https://www.elsevier.com/about/policies-and-standards/author/artwork-and-media-instructions",
)
_IOP = Target(
    85.0,
    215.0,
    TYPE,
    (0.3, ANY),
    600.0,
    "8.5 cm and 15 cm; type 8 to 12 pt; no rule found on lines, resolution and height: 0.3 pt, 600 dpi, 215 mm ours",
    "https://publishingsupport.iopscience.iop.org/questions/figures-journal-articles/",
)
_SPRINGER = Target(
    84.0,
    234.0,
    TYPE,
    (0.3, ANY),
    600.0,
    "84 mm, 174 mm across both columns, at most 234 mm high; type 8 to 12 pt; lines at least 0.1 mm (0.3 pt); 600 dpi "
    "where pictures and letters meet",
    "https://www.springer.com/gp/authors-editors/journal-author/artwork-and-illustrations-guidelines",
)
TARGETS: Mapping[str, Target] = MappingProxyType(
    {
        "aps": _APS,
        "aps-double": replace(_APS, width=178.0),
        "elsevier": _ELSEVIER,
        "elsevier-middle": replace(_ELSEVIER, width=140.0),
        "elsevier-double": replace(_ELSEVIER, width=190.0),
        "iop": _IOP,
        "iop-double": replace(_IOP, width=150.0),
        "springer": _SPRINGER,
        "springer-double": replace(_SPRINGER, width=174.0),
        "beamer": Target(
            140.0,
            68.0,
            10.0,
            (0.6, ANY),
            300.0,
            "the text of a slide of 160 mm x 90 mm (16:9) is 140 mm wide; the rest is ours: type of 10 pt, "
            "lines of 0.6 pt, 68 mm below a title",
            "the class beamer, version 3.6, option aspectratio=169",
        ),
        "poster": Target(
            390.0,
            560.0,
            24.0,
            (1.0, ANY),
            300.0,
            "nobody's rule, all ours: half of A0 upright, type of 24 pt to be read from two metres",
            "",
        ),
    }
)


def find(name: str) -> Target:
    """Return the target with this name, one of TARGETS. Raises AtlasError for an unknown name."""
    if name not in TARGETS:
        raise unknown("target", name, TARGETS, "of figures")
    return TARGETS[name]
