"""The ledger of one section of the paper, and the errata: entries with what the trial found."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from atlas.errors import AtlasError, unknown
from atlas.paper import EQUATIONS
from atlas.report.schema import StrictStruct
from atlas.report.trial import SECTIONS, EntryView, by_grade, entries

if TYPE_CHECKING:
    from atlas.report.compose import Composer
    from atlas.report.definition import Report


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


def view_ledger(block: Ledger, composer: "Composer") -> LedgerView:
    """Set out the entries of one section, each theorem with a number."""
    for name, entry in EQUATIONS.items():
        if entry.section == block.section and entry.kind == "theorem":
            composer.number(name)
    return LedgerView(
        entries(
            lambda entry, _: entry.section == block.section, composer.recorded.findings, composer.text, composer.uses
        )
    )


def view_errata(_block: Errata, composer: "Composer") -> ErrataView:
    """Set out the entries with a slip, the grave ones first."""
    composer.document.errata = composer.page.slug
    found = entries(lambda _, one: bool(one.grade), composer.recorded.findings, composer.text, composer.uses)
    return ErrataView(by_grade(found), composer.document.ledger)


def pages_of(report: "Report") -> dict[str, str]:
    """Return the slug of the page that holds each entry, for the sections whose ledger the report has."""
    found: dict[str, str] = {}
    for page in report.pages:
        for block in page.blocks:
            if isinstance(block, Ledger):
                if block.section not in SECTIONS:
                    raise AtlasError(
                        f"page {page.slug!r}: {unknown('section', block.section, SECTIONS, 'in the ledger')}"
                    )
                found |= {name: page.slug for name, entry in EQUATIONS.items() if entry.section == block.section}
    return found
