"""The ledger of one section of the paper, and the errata: entries with what the trial found."""

from collections.abc import Mapping
from dataclasses import dataclass

from atlas.paper import EQUATIONS
from atlas.report.blocks.composer import Composer
from atlas.report.schema import StrictStruct
from atlas.report.trial import EntryView, by_grade, entries


class Ledger(StrictStruct, frozen=True, tag_field="kind", tag="ledger"):
    """The entries of one section of the paper, each with what the trial found: "II", ..., "VII", or "Atlas"."""

    section: str


class Errata(StrictStruct, frozen=True, tag_field="kind", tag="errata"):
    """Every entry of the ledger with a slip, the grave ones first: as printed, as corrected, and a counterexample."""


@dataclass(frozen=True)
class LedgerView:
    """The entries of one section of the paper."""

    entries: tuple[EntryView, ...]


@dataclass(frozen=True)
class ErrataView:
    """The entries with a slip, the grave ones first, and the page of each in the ledger."""

    entries: tuple[EntryView, ...]
    ledger: Mapping[str, str]


def view_ledger(block: Ledger, composer: Composer) -> LedgerView:
    """Set out the entries of one section, each theorem with a number."""
    for name, entry in EQUATIONS.items():
        if entry.section == block.section and entry.kind == "theorem":
            composer.number(name)
    return LedgerView(
        entries(
            lambda entry, _: entry.section == block.section, composer.recorded.findings, composer.text, composer.uses
        )
    )


def view_errata(_block: Errata, composer: Composer) -> ErrataView:
    """Set out the entries with a slip, the grave ones first."""
    composer.hold_errata()
    found = entries(lambda _, one: bool(one.grade), composer.recorded.findings, composer.text, composer.uses)
    return ErrataView(by_grade(found), composer.ledger)
