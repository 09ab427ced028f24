"""The house style of print: sizes of letters, and the settings that make the same bytes twice."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
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
        "axes.formatter.limits": (-4, 5),
        "axes.unicode_minus": True,
        "path.simplify": True,
    }
)


_AT_HOME = ContextVar("at home", default=False)


@contextmanager
def house_style() -> Iterator[None]:
    """Draw in the house style and leave the reader's own settings as they were."""
    if _AT_HOME.get():
        yield
        return
    import matplotlib as mpl

    token = _AT_HOME.set(True)
    try:
        with mpl.rc_context():
            mpl.rcdefaults()
            mpl.rcParams.update(SETTINGS)
            yield
    finally:
        _AT_HOME.reset(token)
