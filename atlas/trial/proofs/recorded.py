"""The recorded verdicts, kept beside the proofs: a page is drawn from them and never waits for a proof.

`source(name)` is a fingerprint of everything that a proof depends on: the files of the machinery, the file of the
topic and the topics that it builds on, comments and blank lines aside, and all that the ledger has of the entry. A
recorded verdict is current if its fingerprint is.
"""

import hashlib
import json
import re
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

from atlas import files
from atlas.errors import AtlasError
from atlas.trial.ledger import EQUATIONS, equation, topic
from atlas.trial.proofs.verdict import Verdict

FOLDER = Path(__file__).resolve().parent
VERDICTS = FOLDER / "verdicts.json"
SCRIPTS = FOLDER / "scripts.json"
MACHINERY = ("notation", "tex", "model", "identity", "decide", "assumed", "trial")


@cache
def _normal(stem: str) -> str:
    lines = (FOLDER / f"{stem}.py").read_text("utf-8").splitlines()
    return "\n".join(line.rstrip() for line in lines if line.strip() and not line.lstrip().startswith("#"))


@cache
def _reach(stem: str) -> frozenset[str]:
    """Return the stems of the files of proofs that a topic's file imports, directly or not, without "verdict".

    The stem itself is among them.
    """
    text = _normal(stem)
    direct = set(re.findall(r"^from atlas\.trial\.proofs\.(\w+) import", text, re.MULTILINE))
    for names in re.findall(r"^from atlas\.trial\.proofs import (.+)$", text, re.MULTILINE):
        direct |= {name.split(" as ")[0].strip() for name in names.split(",")}
    return frozenset({stem}).union(*(_reach(name) for name in direct - {"verdict"}))


@cache
def _fingerprint(stem: str, machinery: tuple[str, ...]) -> str:
    texts = [_normal(name) for name in sorted(_reach(stem) | set(machinery))]
    return hashlib.sha256("\0".join(texts).encode()).hexdigest()[:16]


def source(name: str) -> str:
    """Return the fingerprint of an entry's proof, 16 hexadecimal digits.

    ``name`` is any word that `atlas.trial.ledger.equation` takes. Raises AtlasError for an unknown entry.
    """
    entry = equation(name)
    return hashlib.sha256(f"{_fingerprint(topic(name), MACHINERY)}\0{entry}".encode()).hexdigest()[:16]


def load(path: Path = VERDICTS) -> dict[str, Verdict]:
    """Return the recorded verdicts, a dictionary by name in the ledger's order; {} if the file is missing.

    Verdicts of entries that the ledger no longer has are left out. Raises AtlasError if the file holds no valid JSON.
    """
    recorded = {entry["name"]: Verdict(**entry) for entry in _read(path)}
    return {name: recorded[name] for name in EQUATIONS if name in recorded}


def _read(path: Path) -> Any:
    """Return the list or dictionary in the JSON file at ``path``, [] if it is missing. Raises AtlasError as `load`."""
    try:
        return json.loads(path.read_text("utf-8"))
    except FileNotFoundError:
        return []
    except json.JSONDecodeError as reason:
        raise AtlasError(
            f"{path.name} holds no valid record ({reason}); delete it and run `atlas verify --record`"
        ) from None


def scripts(path: Path = SCRIPTS) -> dict[str, str]:
    """Return by name the recorded Python script, or the sentence on why there is none; {} if the file is missing.

    Raises AtlasError for a file that is no valid JSON.
    """
    return dict(_read(path))


def save_scripts(texts_by_name: Mapping[str, str], path: Path = SCRIPTS) -> None:
    """Write scripts by name into the record at ``path``, in the ledger's order; scripts of other names are kept."""
    texts = scripts(path) | dict(texts_by_name)
    ordered = {name: texts[name] for name in EQUATIONS if name in texts}
    files.write(path, json.dumps(ordered, indent=1, ensure_ascii=False) + "\n")


def save(verdicts: Iterable[Verdict], path: Path = VERDICTS) -> None:
    """Write verdicts into the record at ``path``, in the ledger's order; recorded verdicts of other names are kept.

    The seconds of a verdict stay as recorded unless the proof has another fingerprint.
    """
    old = {entry["name"]: entry for entry in _read(path)}
    for record in verdicts:
        entry = record.as_dict()
        before = old.get(record.name)
        if before and before["source"] == entry["source"]:
            entry["seconds"] = before["seconds"]
        old[record.name] = entry
    ordered = [old[name] for name in EQUATIONS if name in old]
    files.write(path, json.dumps(ordered, indent=1, ensure_ascii=False) + "\n")


def differs(verdicts: Iterable[Verdict], recorded: Mapping[str, Verdict] | None = None) -> list[tuple[str, str, str]]:
    """Return (name, recorded decision, decision found) for each verdict that differs from the record.

    ``recorded`` has the record's verdicts by name; None reads the record. A decision is text such as "refuted,
    corrected form proved"; "not recorded" for a new entry.
    """
    records = load() if recorded is None else recorded
    changed = []
    for verdict in verdicts:
        before = records.get(verdict.name)
        was = _decisions(before) if before else "not recorded"
        if was != _decisions(verdict):
            changed.append((verdict.name, was, _decisions(verdict)))
    return changed


def _decisions(verdict: Verdict) -> str:
    return verdict.verdict + (f", corrected form {verdict.corrected_verdict}" if verdict.corrected_verdict else "")
