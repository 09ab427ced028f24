"""What the page of one object is asked for, its name and its command."""

import re
import shlex
from collections.abc import Mapping
from dataclasses import dataclass, replace
from hashlib import sha256
from itertools import chain
from typing import Any

from atlas.families import FAMILIES, Family
from atlas.report.digits import plain

LONGEST = 100
"""Characters of the name of a page; what is longer ends with a digest."""


@dataclass(frozen=True)
class Asked:
    """What a page is asked for.

    options   the options that say which object it is, each with what was typed, by name
    body, field   their records in a report file, where the family has them; `time` is the unit of time
    values    the other parameters of the family
    called    the name of its files, if it has one of its own
    """

    family: Family
    options: Mapping[str, tuple[str, ...]]
    values: Mapping[str, Any]
    body: Mapping[str, Any] | None = None
    field: Mapping[str, Any] | None = None
    time: str = "time"
    digits: int = 10
    title: str = ""
    called: str = ""

    @property
    def words(self) -> list[str]:
        """The command's name and its options, as they are typed."""
        command = self.family.command.name if self.family.command else self.family.name
        return [command, *chain.from_iterable((f"--{name}", *texts) for name, texts in self.options.items())]

    @property
    def command(self) -> str:
        """The command that makes the page."""
        digits = ["--digits", str(self.digits)] if self.digits != 10 else []
        own = ["--name", self.called] if self.called else []
        return shlex.join(["atlas", "page", *self.words, *digits, *own])

    @property
    def name(self) -> str:
        """The name of its files, made of what was typed."""
        if self.called:
            return self.called
        name = "-".join(re.sub(r"[^\w.+-]+", "_", word.removeprefix("--"), flags=re.ASCII) for word in self.words)
        return name if len(name) <= LONGEST else f"{name[:LONGEST]}-{sha256(name.encode()).hexdigest()[:8]}"

    def changed(self, family: str, **options: Any) -> "Asked":
        """Return what another object near it is asked for by; an option that is None is left out."""
        new = {name: _texts(value) for name, value in options.items() if value is not None}
        kept = {
            name: new.get(name, texts) for name, texts in self.options.items() if name in new or name not in options
        }
        first = {name: new[name] for name in new if name == "ratio"}  # in the place of a shape
        return replace(
            self, called="", family=FAMILIES[family], options=kept | new if "ratio" in kept else first | kept | new
        )


def _texts(value: Any) -> tuple[str, ...]:
    return tuple(plain(x + 0.0) for x in (value if isinstance(value, list | tuple) else (value,)))
