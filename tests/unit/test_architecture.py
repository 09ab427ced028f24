"""ARCHITECTURE.md speaks of files and names that are there."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "ARCHITECTURE.md").read_text("utf-8")
TICKED = sorted(set(re.findall(r"`([^`\n]+)`", TEXT)))
PATHS = [x for x in TICKED if re.fullmatch(r"(atlas|figures|reports)/[\w/]*(\.py)?", x)]
CLASSES = [x for x in TICKED if re.fullmatch(r"[A-Z]\w+", x)]


@pytest.mark.parametrize("path", sorted({*PATHS, *re.findall(r"\batlas/\w+", TEXT)}))
def test_a_path_is_there(path: str) -> None:
    """Each file and folder that the text or its drawing names is one, but for modules without their ending."""
    assert (ROOT / path).exists() or (ROOT / f"{path}.py").exists()


def test_a_name_is_one_of_the_code() -> None:
    """Each class or constant that the text names is defined somewhere in the package."""
    code = "\n".join(file.read_text("utf-8") for file in (ROOT / "atlas").rglob("*.py"))
    missing = [name for name in CLASSES if not re.search(rf"^(class {name}\b|{name}\b.*=)", code, re.MULTILINE)]
    assert len(CLASSES) > 10
    assert not missing
    assert all(re.search(rf"^ *def {name}\(", code, re.MULTILINE) for name in ("load", "closed_form", "distances"))
