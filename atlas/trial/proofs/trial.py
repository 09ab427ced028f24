"""A trial: what the paper prints, what stands before it, and what the verdict rests on."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache

from atlas.trial.ledger import EQUATIONS
from atlas.trial.proofs import tex
from atlas.trial.proofs.assumed import Read, held
from atlas.trial.proofs.decide import Outcome, decide
from atlas.trial.proofs.model import COMMON, Model, Value
from atlas.trial.proofs.notation import NoMeaningError, Reader, parse, sides
from atlas.trial.proofs.verdict import Grade

Cases = Model | Sequence[Model]


@cache
def _made(model: Callable[[], Cases]) -> Sequence[Model]:
    """Return the models of a line, made once for all that is tried in them."""
    models = model()
    return [models] if isinstance(models, Model) else models


@cache
def _assumed(
    assumptions: tuple[str, ...], signs: tuple[tuple[str, str], ...], model: Callable[[], Cases], apart: tuple[str, ...]
) -> Read:
    """Return what became of assumptions in a model, once for all forms that are tried."""
    return held(assumptions, dict(signs), _made(model), apart)


@dataclass(frozen=True, kw_only=True)
class Part:
    """A further line that an entry needs: the converse of the first one, or another of its cases; see `Trial`."""

    line: str
    model: Callable[[], Cases]
    defines: tuple[str, ...] = ()
    solves: str = ""

    @property
    def cases(self) -> Sequence[Model]:
        """The models in which the line is tried."""
        return _made(self.model)

    def outcome(self, **wanted: bool) -> Outcome:
        """Try the line; `wanted` as `decide` takes it."""
        return decide(self.line, self.cases, defines=self.defines, solves=self.solves, **wanted)


@dataclass(frozen=True)
class Falsehood:
    """A false sentence near a claim, which its trial must refute: else the trial would let the claim pass unread.

    says    the sentence
    right   what it changes in the true form of the claim, in the first line that holds it; empty if it changes nothing
    wrong   what it has in that place
    model   of what it says this, if not of what the claim is about
    """

    says: str
    right: str = ""
    wrong: str = ""
    model: Callable[[], Cases] | None = None


@dataclass(frozen=True, kw_only=True)
class Trial:
    r"""The trial of one entry of the ledger.

    name       that of the entry, the key under which its topic has it
    model      what stands before it, made when it is needed; several cases where the claim covers them all
    follows    from what the printed form is derived, in a few words
    signs      what letters and phrases of its TeX mean, where its topic does not say so; see `tex`
    form       what the line becomes that is made from the TeX, such as `notation.conserved`
    tex        the TeX, if it is not that of the ledger
    defines    letters that the printed form defines
    solves     what must hold with these
    elsewhere  models of statements that are not of what `model` is about, by their place in the line
    apart      clauses of its assumptions whose letters are not those of `model`: they are named as not read
    arrows     what stands at an arrow of the formula, by the number of statements before it: None at a single one,
               whose premise the model has or the line defines; at a double one the line that tries it in both
               directions, empty where `form` makes that of its two sides
    also       further lines that the claim needs: parts, or the lines alone where they are of the same model
    definition whether the entry says nothing but what its letters mean: then it is a definition and not proved
    grade      what kind of slip it is, if it needs an erratum: it is refuted, or true but not the whole truth
    slip       the entry under which the slip is counted, if it is the same one; its grade then is this one's, too
    corrected_tex  the true form where there is a slip, in which `\boxed` marks what has changed; `corrected_signs`,
               `corrected_model`, `corrected_defines`, `corrected_solves` where they differ from
               those of the printed form, and `corrected_also`
    note       what the verdict means, where it needs a word
    false      a false sentence near it; a claim in words must have one, unless it is refuted itself
    """

    name: str = ""
    model: Callable[[], Cases]
    follows: str
    signs: Mapping[str, str] = field(default_factory=dict)
    form: Callable[[str], str] = str
    tex: str = ""
    defines: tuple[str, ...] = ()
    solves: str = ""
    elsewhere: Mapping[int, Callable[[], Cases]] = field(default_factory=dict)
    apart: tuple[str, ...] = ()
    arrows: Mapping[int, Part | str | None] = field(default_factory=dict)
    also: tuple[Part | str, ...] = ()
    definition: bool = False
    grade: Grade = ""
    slip: str = ""
    corrected_tex: str = ""
    corrected_signs: Mapping[str, str] = field(default_factory=dict)
    corrected_model: Callable[[], Cases] | None = None
    corrected_defines: tuple[str, ...] | None = None
    corrected_solves: str | None = None
    corrected_also: tuple[Part, ...] = ()
    note: str = ""
    false: Falsehood | None = None

    @property
    def printed(self) -> str:
        """The printed form in plain letters. Raises UnreadableError if its TeX can't be read."""
        return self.form(tex.line(self.formula, self.signs))

    @property
    def formula(self) -> str:
        """The TeX that is tried."""
        return self.tex or EQUATIONS[self.name].tex

    @property
    def true_form(self) -> "Trial | None":
        """The trial of the true form, as of what is printed; None if there is no slip."""
        if not self.corrected_tex:
            return None
        return Trial(
            name=self.name,
            model=self.corrected_model or self.model,
            follows=self.follows,
            signs={**self.signs, **self.corrected_signs},
            form=self.form,
            arrows=self.arrows,
            apart=self.apart,
            tex=self.corrected_tex,
            defines=self.defines if self.corrected_defines is None else self.corrected_defines,
            solves=self.solves if self.corrected_solves is None else self.corrected_solves,
            also=self.corrected_also,
        )

    @property
    def corrected(self) -> str:
        """The true form in plain letters, empty if there is no slip. Raises UnreadableError if it can't be read."""
        return self.true_form.printed if self.true_form else ""

    @property
    def said(self) -> dict[str, str]:
        """What of the printed and of the corrected form is not read, with the lines that are tried in its place."""
        return tex.said(self.formula, self.signs) | (self.true_form.said if self.true_form else {})

    @property
    def assumed(self) -> Read:
        """What became of the assumptions in the model of the true form."""
        case = self.true_form or self
        return _assumed(EQUATIONS[self.name].assumptions, tuple(case.signs.items()), case.model, self.apart)

    @property
    def parts(self) -> tuple[Part, ...]:
        """The lines of the printed form."""
        statements: dict[Callable[[], Cases], list[str]] = {}
        for place, statement in enumerate(self.printed.split("; ")):
            statements.setdefault(self.elsewhere.get(place, self.model), []).append(statement)
        first = [
            Part(line="; ".join(lines), model=model, defines=self.defines, solves=self.solves)
            for model, lines in statements.items()
        ]
        lines = [line for line in (*self.arrows.values(), *self.also) if line]
        further = [Part(line=line, model=self.model) if isinstance(line, str) else line for line in lines]
        return (*first, *further)

    @property
    def corrected_parts(self) -> tuple[Part, ...]:
        """The lines of the corrected form; none if there is no such form."""
        return self.true_form.parts if self.true_form else ()

    @property
    def true_parts(self) -> tuple[Part, ...]:
        """The lines of the form that is proved: the corrected one where there is one."""
        return (self.true_form or self).parts

    @property
    def false_part(self) -> Part:
        """The part of the true form that the false sentence changes. Raises ValueError if there is none."""
        if self.false is None or not (self.false.right or self.false.model):
            raise ValueError(f"{self.name} has no false sentence beside it")
        for true_part in self.true_parts:
            if self.false.right in true_part.line:
                line = true_part.line.replace(self.false.right, self.false.wrong, 1)
                return replace(true_part, line=line, model=self.false.model or true_part.model)
        raise ValueError(f"{self.name}: the false sentence changes {self.false.right!r}, which is not there")

    def of_printed(self, *, shrink: bool = False) -> Outcome:
        """Try the printed form; a definition that holds is called one."""
        try:
            parts, thin = self.parts, tex.thin(self.formula, self.signs)
        except (tex.UnreadableError, NoMeaningError) as reason:
            return Outcome("undecided", f"unreadable: {reason}")
        tried = [(place, r"\implies" if line is None else r"\iff") for place, line in self.arrows.items()]
        if tex.arrows(self.formula, self.signs) != tried:
            return Outcome("undecided", "unreadable: its arrows are not those that are tried")
        if self.assumed.broken:
            return Outcome("undecided", f"assumed, and not so in the model: {'; '.join(self.assumed.broken)}")
        for name in thin:
            if any(getattr(model.letters.get(name), "shape", ()) == (3, 1) for model in parts[0].cases):
                return Outcome("undecided", f"unreadable: {name} is a vector, and is not bold")
        outcome = _joined([piece.outcome(shrink=shrink) for piece in parts])
        if self.definition and outcome.decision == "proved":
            return Outcome("definition", "it says what its letters mean")
        return outcome

    def of_corrected(self) -> Outcome:
        """Try the corrected form, which must be there."""
        if self.true_form is None:
            raise ValueError(f"{self.name} has no corrected form")
        return self.true_form.of_printed()


def read(name: str, signs: Mapping[str, str]) -> str:
    """Return an entry of the ledger as a line in plain letters."""
    return tex.line(EQUATIONS[name].tex, signs)


def evaluated(name: str, signs: Mapping[str, str], letters: Mapping[str, Value], side: int = 1) -> Value:
    """Return the value of a side of the first relation of an entry of the ledger."""
    line = sides(read(name, signs))[side]
    return Reader({**COMMON, **letters}).value(parse(f"{line} = 0")[0].left, {})


def mended(name: str, changes: Mapping[str, str], more: str = "") -> str:
    r"""Return the TeX of an entry with other pieces, in a \boxed unless they say what has changed, and more behind it.

    Raises ValueError if a piece is not there.
    """
    tex, end = EQUATIONS[name].tex, r" \end{aligned}"
    for printed, right in changes.items():
        if printed not in tex:
            raise ValueError(f"{printed} is not in {name}")
        tex = tex.replace(printed, right if not right or r"\boxed" in right else rf"\boxed{{{right}}}")
    return tex.removesuffix(end) + more + (end if tex.endswith(end) else "")


def _joined(outcomes: Sequence[Outcome]) -> Outcome:
    """Return what several lines come to: refuted if one is, proved if all are."""
    for decision in ("refuted", "undecided", "supported"):
        for outcome in outcomes:
            if outcome.decision == decision:
                return outcome
    return Outcome("proved", ", ".join(dict.fromkeys(how for one in outcomes for how in one.method.split(", "))))
