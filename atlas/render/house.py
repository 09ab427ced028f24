"""The house style of print: fonts, line widths and the settings that make the same bytes twice."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from types import MappingProxyType
from typing import Any

POINTS_PER_MM = 72.0 / 25.4
TEXT_SIZE = 9.0
LABEL_SIZE = 10.0
SMALL_SIZE = 8.0

SETTINGS: Mapping[str, Any] = MappingProxyType(
    {
        "font.family": "STIXGeneral",
        "font.size": TEXT_SIZE,
        "mathtext.fontset": "stix",
        "axes.labelsize": TEXT_SIZE,
        "axes.titlesize": TEXT_SIZE,
        "axes.titlelocation": "left",
        "axes.titlepad": 5.0,
        "axes.linewidth": 0.6,
        "axes.formatter.use_mathtext": True,
        "axes.formatter.limits": (-4, 5),
        "axes.unicode_minus": True,
        "xtick.direction": "in",
        "ytick.direction": "in",
        "xtick.top": True,
        "ytick.right": True,
        "xtick.labelsize": SMALL_SIZE,
        "ytick.labelsize": SMALL_SIZE,
        "xtick.major.width": 0.5,
        "ytick.major.width": 0.5,
        "xtick.minor.width": 0.4,
        "ytick.minor.width": 0.4,
        "xtick.major.size": 3.0,
        "ytick.major.size": 3.0,
        "xtick.minor.size": 1.6,
        "ytick.minor.size": 1.6,
        "legend.fontsize": SMALL_SIZE,
        "legend.frameon": True,
        "legend.framealpha": 0.9,
        "legend.edgecolor": "none",
        "legend.fancybox": False,
        "legend.handlelength": 2.4,
        "legend.borderpad": 0.3,
        "legend.labelspacing": 0.35,
        "lines.solid_capstyle": "round",
        "lines.solid_joinstyle": "round",
        "lines.dash_capstyle": "butt",
        "lines.scale_dashes": False,
        "image.composite_image": False,
        "figure.dpi": 100.0,
        "savefig.dpi": 300.0,
        "svg.fonttype": "path",
        "svg.hashsalt": "atlas",
        "pdf.fonttype": 42,
        "path.simplify": True,
    }
)


@contextmanager
def house_style() -> Iterator[None]:
    """Draw in the house style and leave the reader's own settings as they were."""
    import matplotlib as mpl

    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(SETTINGS)
        yield
