"""The report files that there are; found without loading what reads them."""

from pathlib import Path

from atlas.errors import AtlasError, unknown
from atlas.places import folder
from atlas.report import toml


def names() -> list[str]:
    """List the reports of the folder ``reports/``."""
    return sorted(path.stem for path in folder("reports").glob("*.toml"))


def related_to(file: Path) -> list[str]:
    """Return the names of the reports that stand beside that of a file; none where the file can't be read."""
    try:
        related = toml.loads(file.read_text(encoding="utf-8-sig")).get("related", {})
    except ValueError:
        return []
    known = names()
    return [name for name in related if name in known] if isinstance(related, dict) else []


def find(name: str) -> Path:
    """Return the file of a report, given its name or its path."""
    path = Path(name) if name.endswith(".toml") else folder("reports") / f"{name}.toml"
    if path.is_file():
        return path
    if name.endswith(".toml"):
        raise AtlasError(f"There is no report file {name}.")
    if Path(name).is_file():
        raise AtlasError(f"{name} is no report: a report is a .toml file.")
    raise unknown("report", name, names())
