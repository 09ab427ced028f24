"""Recorded results as a report shows them, plain data: the trial of the ledger's entries, and tables by name.

The floor above reads the records; this one sets them out and never runs a benchmark or a proof.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from atlas.book.tables.table import Data


@dataclass(frozen=True)
class Finding:
    """Finding of the trial on one entry of the ledger, in the plain letters of its record; "" where there is nothing.

    verdict         proved, refuted, undecided, definition, or supported, then with the count in `method`
    method          how it was decided, and `follows`: source from which the printed form was derived
    corrected       TeX of the true form where the printed one is refuted; `corrected_verdict` is the verdict on it
    counterexample  texts by letter: values that break the printed form; also "relation", "left", "right" or "reason",
                    see `atlas.book.blocks.counterexample.counterexample_text`
    note            meaning of the verdict, where it needs a word
    modules         paths of modules that cite the entry, such as ``motions/elementary/kernel_hyperbola.py``
    grade           kind of slip, such as misprint, if the entry needs an erratum
    slip            name of the entry under which a shared slip is counted
    false           a false sentence near a claim in words, which the trial refutes
    script          source of a SymPy program that proves or refutes the entry, or the line that says why there is none
    said            by phrase of the entry's TeX that the trial cannot read, the line tried in its place, "" if supposed
    not_read        clauses of its assumptions that the trial does not hold against its model
    outside         a false domain beside that of the entry, and the reason for which nothing is proved there
    """

    verdict: str
    method: str
    follows: str
    corrected: str = ""
    corrected_verdict: str = ""
    counterexample: Mapping[str, str] = field(default_factory=dict)
    note: str = ""
    modules: tuple[str, ...] = ()
    grade: str = ""
    slip: str = ""
    false: str = ""
    script: str = ""
    said: Mapping[str, str] = field(default_factory=dict)
    not_read: str = ""
    outside: str = ""


@dataclass(frozen=True)
class Described:
    """A public name of the package: its arguments as text, such as "(a, b=1)", its docstring, its members by name."""

    arguments: str
    docstring: str
    members: Mapping[str, "Described"] = field(default_factory=dict)


@dataclass(frozen=True)
class Appendices:
    """Recorded results that the blocks of a report show; each mapping is empty where no block asks for it.

    `findings` are the trial's by name of the entry of the ledger, `tables` the recorded tables by "source: name",
    `reference` the public names of the package.
    """

    findings: Mapping[str, Finding] = field(default_factory=dict)
    tables: Mapping[str, Data] = field(default_factory=dict)
    reference: Mapping[str, Described] = field(default_factory=dict)
