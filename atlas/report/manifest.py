"""The mark of a built report in its folder: its name, its title and the versions of what made it."""

from typing import TYPE_CHECKING

import msgspec

if TYPE_CHECKING:
    from atlas.report.document import Document

MANIFEST = "manifest.json"
"""By it a folder is known to be of a report, which may be built anew."""


def manifest_of(document: "Document") -> bytes:
    """Return the manifest of a report as JSON; it depends on the report and on the versions alone."""
    from atlas.report.versions import versions

    report = document.report
    found = {"report": report.name, "title": report.title, "versions": versions()}
    return msgspec.json.format(msgspec.json.encode(found), indent=1) + b"\n"
