"""What a build notes for the next one: JSON below its digest, so that a note that was damaged is as good as none."""

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from atlas.build.whole import room


def read(path: Path) -> dict[str, Any]:
    """Return what was noted, or nothing if there is no note, or another one than was written."""
    try:
        stamp, _, text = path.read_bytes().partition(b"\n")
    except OSError:
        return {}
    found: dict[str, Any] = json.loads(text) if _stamp(text) == stamp else {}
    return found


def write(path: Path, content: Mapping[str, Any]) -> None:
    """Note something, whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with room(path.parent) as beside:
        put(beside / path.name, content)
        (beside / path.name).replace(path)


def put(path: Path, content: Mapping[str, Any]) -> None:
    """Write a note where nobody reads it yet."""
    text = json.dumps(dict(content)).encode()
    path.write_bytes(_stamp(text) + b"\n" + text)


def _stamp(text: bytes) -> bytes:
    return hashlib.sha256(text).hexdigest().encode()
