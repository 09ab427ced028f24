"""One line of the ledger: an equation of the paper, a claim that it makes in words, or a theorem of the atlas."""

from dataclasses import dataclass
from typing import Literal

Kind = Literal["definition", "derivation step", "claim", "theorem"]
Grade = Literal["", "sign of the charge", "gap in the argument", "missing case", "misprint", "wording"]
Section = Literal["II", "III", "IV", "V", "VII", "Atlas"]

ASSUMPTIONS = {
    "symmetric": r"$I_1 = I_2$, third axis of inertia along $\mathbf{e}_3$ at $t = 0$",
    "field": r"$\mathbf{B}' = (0, B'_2, B'_3)^T$, $B'_2 > 0$, $B'_3 > 0$",
    "off the lines": r"$\omega_2$ differs from $-B'_2$",
}
"""Assumptions of entries in several files, by the words that stand for them there."""


def slug(name: str) -> str:
    """Return an equation's name without brackets, for links and file names: "72" of "(72)"; "theorem-pair" stays."""
    return name.strip("()")


@dataclass(frozen=True, slots=True, kw_only=True)
class Equation:
    r"""An equation: its name, its formula and its assumptions, and the words of its trial.

    name         the number that it has in print, "(72)"; one without, such as a claim made in words, has a name
                 `text-...` of our own, a theorem that the paper doesn't have `theorem-...`: the key in its file
    says         its statement in words, in one line
    tex          the formula as printed, slips included, in modern TeX
    alias        its LaTeX label in the paper's source; (53) and (55) share one there
    assumptions  its conditions, each in a few words; in its file also the name of one of `ASSUMPTIONS` or of the
                 table `assumptions` there
    outside      (words of an assumption, false words in their place), which give a domain in which nothing may be
                 proved; or empty
    quote        the words of the paper that make the claim, where the paper has no formula
    follows      premises of its proof, in a few words
    grade        kind of slip, if the entry needs an erratum: it is refuted, or true but incomplete
    slip         name of the entry under which the slip is counted, if two entries share one; both have its grade
    corrected_tex  the true form where there is a slip, in which `\boxed` marks the changes
    note         meaning of the verdict, where a word is needed
    false        a false sentence near the entry, which the trial must refute; a claim in words must have one,
                 unless the claim is refuted
    kind         definition, derivation step (follows from earlier equations), claim (a result), theorem (ours);
                 where an entry doesn't say it, the name decides: with a number it is a derivation step, `text-...` a
                 claim, `theorem-...` a theorem
    section      II to V, VII (the appendix, numbered as a section), or Atlas for a theorem beyond the
                 paper: that of its file, as `atlas.trial.ledger` has it
    """

    name: str
    says: str
    tex: str
    alias: str = ""
    assumptions: tuple[str, ...] = ()
    outside: tuple[str, ...] = ()
    quote: str = ""
    follows: str = ""
    grade: Grade = ""
    slip: str = ""
    corrected_tex: str = ""
    note: str = ""
    false: str = ""
    kind: Kind
    section: Section

    @property
    def number(self) -> int | None:
        """The number in print, an integer; None if the name has no brackets."""
        return int(self.name[1:-1]) if self.name.startswith("(") else None
