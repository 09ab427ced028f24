"""Report files and their heads."""

from pathlib import Path
from typing import Any

from atlas.book import toml
from atlas.errors import AtlasError, unknown
from atlas.places import folder

RULE = "+++"
"""The line above and the line below the head of a report in Markdown."""
SUFFIXES = (".md", ".toml")


def files() -> dict[str, Path]:
    """Return the paths of the reports in ``reports/`` by name: TOML files, and Markdown files with a head of TOML."""
    paths = sorted(path for suffix in SUFFIXES for path in folder("reports").glob(f"*{suffix}"))
    return {path.stem: path for path in paths if path.suffix == ".toml" or text_of(path).startswith(RULE)}


def names() -> list[str]:
    """Return the names of the reports in the folder ``reports/``."""
    return list(files())


def find(name: str) -> Path:
    """Return the path of a report, given its name in ``reports/`` or the path of a .md or .toml file.

    Raises AtlasError if there is none, or the file has another suffix.
    """
    path = Path(name)
    if path.suffix in SUFFIXES:
        if path.is_file():
            return path
        raise AtlasError(f"There is no report file {name}.")
    reports = files()
    if name in reports:
        return reports[name]
    if path.is_file():
        raise AtlasError(f"{name} is no report: a report is a .md or a .toml file.")
    raise unknown("report", name, [*reports, "your_body"])


def file_in(name: str, folder: Path) -> Path | None:
    """Return the path of a file, `name` relative to `folder`, in or below that folder of a report.

    None if the file is missing or outside, also through a link.
    """
    file = folder / name
    return file if file.resolve().is_relative_to(folder.resolve()) and file.is_file() else None


def text_of(path: Path) -> str:
    """Return the text of a report file, without a byte order mark. Raises AtlasError for one that is no UTF-8."""
    try:
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise AtlasError(f"{path} is not a text in UTF-8: {error.reason} at byte {error.start}.") from error


def head(path: Path) -> dict[str, Any]:
    """Return the keys of a report's head, or all keys of a report in TOML. Raises AtlasError for other text."""
    text = text_of(path)
    try:
        return toml.loads(head_of(text) if path.suffix == ".md" else text)
    except ValueError as error:
        raise AtlasError(f"{path} is not TOML: {error}.") from error


def head_of(text: str) -> str:
    """Return the TOML text between the rules "+++" at the beginning of a report in Markdown.

    All of it without a rule.
    """
    return text.partition(f"\n{RULE}")[0].removeprefix(RULE)


def related_to(file: Path) -> list[str]:
    """Return the names of the reports in ``reports/`` that a report's head names as related; [] if it can't be read."""
    try:
        related = head(file).get("related", {})
    except AtlasError:
        return []
    reports = names()
    return [name for name in related if name in reports] if isinstance(related, dict) else []
