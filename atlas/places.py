"""Where figures/, templates/ and reports/ are: in the checkout when there is one, else inside the installed package."""

from pathlib import Path
from typing import Literal

_PACKAGE = Path(__file__).resolve().parent


def folder(kind: Literal["figures", "templates", "reports"]) -> Path:
    """Return the folder of that kind that belongs to the code that runs."""
    checkout = _PACKAGE.parent
    if (checkout / "pyproject.toml").is_file() and (checkout / kind).is_dir():
        return checkout / kind
    return _PACKAGE / "_data" / kind
