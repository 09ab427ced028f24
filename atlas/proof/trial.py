"""A trial: what the paper prints, what stands before it, and what the verdict rests on."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from atlas.proof.decide import Outcome, decide
from atlas.proof.model import Model

Cases = Model | Sequence[Model]
Check = Callable[..., Outcome]


@dataclass(frozen=True, kw_only=True)
class Trial:
    """The trial of one entry of the ledger.

    printed    the form as printed, in the letters of `notation`
    model      what stands before it, made when it is needed; several cases where the claim covers them all
    follows    from what the printed form is derived, in a few words
    defines    letters that the printed form defines
    solves     what must hold with these
    corrected  the true form where the printed one is refuted, with its TeX; `corrected_model`, `corrected_defines` and
               `corrected_solves` where they differ from those of the printed form
    note       what the verdict means, where it needs a word
    check      how the lines are decided, if not by `decide`
    """

    label: str
    printed: str
    model: Callable[[], Cases]
    follows: str
    defines: tuple[str, ...] = ()
    solves: str = ""
    corrected: str = ""
    corrected_tex: str = ""
    corrected_model: Callable[[], Cases] | None = None
    corrected_defines: tuple[str, ...] | None = None
    corrected_solves: str | None = None
    note: str = ""
    check: Check = decide

    def of_printed(self, line: str = "", *, sample_only: bool = False, shrink: bool = False) -> Outcome:
        """Try the printed form, or another line in its place."""
        return self.check(
            line or self.printed,
            self.model(),
            defines=self.defines,
            solves=self.solves,
            sample_only=sample_only,
            shrink=shrink,
        )

    def of_corrected(self, line: str = "", *, sample_only: bool = False) -> Outcome:
        """Try the corrected form, or another line in its place."""
        return self.check(
            line or self.corrected,
            (self.corrected_model or self.model)(),
            defines=self.defines if self.corrected_defines is None else self.corrected_defines,
            solves=self.solves if self.corrected_solves is None else self.corrected_solves,
            sample_only=sample_only,
            shrink=False,
        )
