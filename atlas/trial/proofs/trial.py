"""A trial: the printed form of an entry, the model of its letters, and the lines that are tried."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache

import sympy

from atlas.trial.ledger import EQUATIONS
from atlas.trial.proofs import tex
from atlas.trial.proofs.assumed import Read, compare
from atlas.trial.proofs.decide import Outcome, decide, understood
from atlas.trial.proofs.model import COMMON, Model, Value
from atlas.trial.proofs.notation import NoMeaningError, Reader, parse, sides

Cases = Model | Sequence[Model]


@cache
def _models_of(model: Callable[[], Cases]) -> Sequence[Model]:
    """Call ``model`` and return its models as a sequence, of one for a single `Model`; cached by function."""
    models = model()
    return [models] if isinstance(models, Model) else models


@cache
def _assumed(
    assumptions: tuple[str, ...],
    signs: tuple[tuple[str, str], ...],
    model: Callable[[], Cases],
    excluded: tuple[str, ...],
) -> Read:
    """Return the `Read` of assumptions compared with the models of ``model`` by `assumed.compare`; cached.

    ``signs`` are pairs (TeX, plain letter) of the table of letters, ``excluded`` clauses that are not read.
    """
    return compare(assumptions, dict(signs), _models_of(model), excluded)


@dataclass(frozen=True, kw_only=True)
class Part:
    """A further line that an entry needs: the converse of the first one, or another of its cases; see `Trial`.

    `line` is a line of `notation`, `model` the function that makes its model or models, `defines` and `solves` are
    as in `decide.decide`.
    """

    line: str
    model: Callable[[], Cases]
    defines: tuple[str, ...] = ()
    solves: str = ""

    @property
    def cases(self) -> Sequence[Model]:
        """The sequence of models in which the line is tried, one or more; see `_models_of`."""
        return _models_of(self.model)

    def outcome(self, **options: bool) -> Outcome:
        """Return the `Outcome` of the line in its models.

        ``options`` are flags of `decide`: ``sample_only`` and ``shrink``.
        """
        return decide(self.line, self.cases, defines=self.defines, solves=self.solves, **options)


@dataclass(frozen=True)
class Falsehood:
    """Change of a line that makes the false sentence of an entry, which its trial must refute.

    right   piece of the true form that is replaced, in the first line that has the piece; empty if none is
    wrong   piece in that place
    model   model of the false sentence, if not that of the claim
    """

    right: str = ""
    wrong: str = ""
    model: Callable[[], Cases] | None = None


@dataclass(frozen=True, kw_only=True)
class Trial:
    r"""The trial of one entry of the ledger.

    name       that of the entry, the key under which its topic has it
    model      function that makes the model, or a model for each case of the claim
    signs      meanings of letters and phrases of its TeX beside those of its topic; see `tex`
    form       change of the line that is made from the TeX, such as `notation.conserved`
    tex        the TeX, if it is not that of the ledger
    defines    letters that the printed form defines
    solves     line that must hold with these letters
    elsewhere  other models of single statements, by their place in the line
    excluded   clauses of its assumptions whose letters are not those of `model`: they are named as not read
    arrows     for each arrow of the formula, by the number of statements before it: None at a single one,
               whose premise the model has or the line defines; at a double one the line that tries it in both
               directions, empty where `form` makes that of its two sides
    also       further lines that the claim needs: parts, or the lines alone where they are of the same model
    definition whether the entry only defines its letters: then it is a definition and not proved
    corrected_tex  the true form, that of the ledger; `corrected_signs`, `corrected_model`, `corrected_defines`,
               `corrected_solves` where they differ from those of the printed form, and `corrected_also`
    false      change that makes the false sentence of the entry from the line
    """

    name: str = ""
    model: Callable[[], Cases]
    signs: Mapping[str, str] = field(default_factory=dict)
    form: Callable[[str], str] = str
    tex: str = ""
    defines: tuple[str, ...] = ()
    solves: str = ""
    elsewhere: Mapping[int, Callable[[], Cases]] = field(default_factory=dict)
    excluded: tuple[str, ...] = ()
    arrows: Mapping[int, Part | str | None] = field(default_factory=dict)
    also: tuple[Part | str, ...] = ()
    definition: bool = False
    corrected_tex: str = ""
    corrected_signs: Mapping[str, str] = field(default_factory=dict)
    corrected_model: Callable[[], Cases] | None = None
    corrected_defines: tuple[str, ...] | None = None
    corrected_solves: str | None = None
    corrected_also: tuple[Part, ...] = ()
    false: Falsehood | None = None

    @property
    def printed(self) -> str:
        """The printed form as a line of `notation`, after `form`. Raises UnreadableError if its TeX can't be read."""
        return self.form(tex.line(self.formula, self.signs))

    @property
    def formula(self) -> str:
        """The TeX to be read: that of the trial, or of the ledger's entry where the trial has none."""
        return self.tex or EQUATIONS[self.name].tex

    @property
    def true_form(self) -> "Trial | None":
        """The trial of the corrected form; None if the entry has no `corrected_tex`.

        Each field `corrected_...` replaces that of the printed form where it is given; `also` is `corrected_also`
        alone.
        """
        if not self.corrected_tex:
            return None
        return Trial(
            name=self.name,
            model=self.corrected_model or self.model,
            signs={**self.signs, **self.corrected_signs},
            form=self.form,
            arrows=self.arrows,
            excluded=self.excluded,
            tex=self.corrected_tex,
            defines=self.defines if self.corrected_defines is None else self.corrected_defines,
            solves=self.solves if self.corrected_solves is None else self.corrected_solves,
            also=self.corrected_also,
        )

    @property
    def corrected(self) -> str:
        """The corrected form as a line of `notation`; empty if there is none.

        Raises UnreadableError if its TeX can't be read.
        """
        return self.true_form.printed if self.true_form else ""

    @property
    def said(self) -> dict[str, str]:
        """Phrases of the TeX, printed and corrected, that are not read, each with the line tried instead.

        See `tex.unread_phrases`: the line is empty where nothing is tried.
        """
        return tex.unread_phrases(self.formula, self.signs) | (self.true_form.said if self.true_form else {})

    @property
    def assumed(self) -> Read:
        """The clauses of the entry's assumptions, each satisfied, broken or unread in the models of the true form.

        The true form is the corrected one, or the printed one where there is no correction.
        """
        return self._compared(EQUATIONS[self.name].assumptions)

    def _compared(self, assumptions: tuple[str, ...]) -> Read:
        case = self.true_form or self
        return _assumed(assumptions, tuple(case.signs.items()), case.model, self.excluded)

    @property
    def outside(self) -> str:
        """The false domain of the entry and the reason for which nothing is proved there; empty if the entry has none.

        It is the text "WRONG in the place of RIGHT: undecided (REASON)". Raises ValueError if the replaced words stand
        in no assumption, or the models do not contradict the false domain.
        """
        entry = EQUATIONS[self.name]
        if not entry.outside:
            return ""
        right, wrong = entry.outside
        false = tuple(clause.replace(right, wrong) for clause in entry.assumptions)
        objection = self._unlike(self._compared(false))
        if false == entry.assumptions or not objection:
            raise ValueError(f"{self.name}: the false domain {wrong} in the place of {right} changes nothing")
        return f"{wrong} in the place of {right}: undecided ({objection.partition(': ')[0]})"

    @property
    def parts(self) -> tuple[Part, ...]:
        """The lines of the printed form, each with its models.

        Statements of one model are joined by "; ", those at the places in `elsewhere` stand in parts of their own
        models. The lines of `arrows` and `also` follow. Raises UnreadableError if the TeX can't be read.
        """
        statements: dict[Callable[[], Cases], list[str]] = {}
        for place, statement in enumerate(self.printed.split("; ")):
            statements.setdefault(self.elsewhere.get(place, self.model), []).append(statement)
        printed_parts = [
            Part(line="; ".join(lines), model=model, defines=self.defines, solves=self.solves)
            for model, lines in statements.items()
        ]
        lines = [line for line in (*self.arrows.values(), *self.also) if line]
        further_parts = [Part(line=line, model=self.model) if isinstance(line, str) else line for line in lines]
        return (*printed_parts, *further_parts)

    @property
    def corrected_parts(self) -> tuple[Part, ...]:
        """The lines of the corrected form, as `parts`; an empty tuple if there is no corrected form."""
        return self.true_form.parts if self.true_form else ()

    @property
    def true_parts(self) -> tuple[Part, ...]:
        """The lines of the form to be proved: the corrected one, or the printed one if none is corrected."""
        return (self.true_form or self).parts

    @property
    def false_part(self) -> Part:
        """The first part of the true form that contains ``false.right``, with ``false.wrong`` in that place.

        It has the model of `false` where one is given. Raises ValueError if the trial has no false sentence, or no part
        contains ``false.right``.
        """
        if self.false is None or not (self.false.right or self.false.model):
            raise ValueError(f"{self.name} has no false sentence beside it")
        for true_part in self.true_parts:
            if self.false.right in true_part.line:
                line = true_part.line.replace(self.false.right, self.false.wrong, 1)
                return replace(true_part, line=line, model=self.false.model or true_part.model)
        raise ValueError(f"{self.name}: the false sentence changes {self.false.right!r}, which is not there")

    def of_printed(self, *, shrink: bool = False) -> Outcome:
        """Return the `Outcome` of the printed form; ``shrink`` makes a counterexample as simple as possible.

        It is undecided, with the reason as `method`, where the TeX can't be read, its arrows are not those of the
        trial, or the models contradict an assumption. A definition that is proved has the decision "definition".
        """
        try:
            parts, objection = self.parts, self._objection(tex.thin(self.formula, self.signs))
        except (tex.UnreadableError, NoMeaningError) as reason:
            return Outcome("undecided", f"unreadable: {reason}")
        if objection:
            return Outcome("undecided", objection)
        outcome = _joined([piece.outcome(shrink=shrink) for piece in parts])
        if self.definition and outcome.decision == "proved":
            return Outcome("definition", "it says what its letters mean")
        return outcome

    def _objection(self, thin: Iterable[str]) -> str:
        """Return the reason for which the printed form is not tried, as a sentence; empty if there is none.

        Reasons are arrows other than those in `arrows`, those of `_unlike`, and a letter of ``thin`` (not bold) whose
        value in a model is a vector.
        """
        tried = [(place, r"\implies" if line is None else r"\iff") for place, line in self.arrows.items()]
        if tex.arrows(self.formula, self.signs) != tried:
            return "unreadable: its arrows are not those that are tried"
        if unlike := self._unlike(self.assumed):
            return unlike
        for name in thin:
            if any(getattr(model.letters.get(name), "shape", ()) == (3, 1) for model in self.parts[0].cases):
                return f"unreadable: {name} is a vector, and is not bold"
        return ""

    def _unlike(self, read: Read) -> str:
        """Return a sentence with the first conflict between assumptions and models; empty if there is none.

        ``read`` are the assumptions compared with the models. Conflicts are an assumption that is false in a model,
        and one that gives a number to a free symbol for which a side of the first part is infinite or undefined.
        """
        if read.broken:
            return f"assumed, and not so in the model: {'; '.join(read.broken)}"
        first_statement = (self.true_form or self).parts[0]
        for number, symbol, value in read.special:
            relations = understood(
                first_statement.line, first_statement.cases[number], first_statement.defines, first_statement.solves
            )[0]
            sides = (sympy.sympify(side) for relation in relations for side in (*relation.lhs, *relation.rhs))
            if any(side.subs(symbol, value).has(sympy.nan, sympy.zoo) for side in sides):
                return f"assumed, and without a value there: {symbol} = {value}"
        return ""


def read(name: str, signs: Mapping[str, str]) -> str:
    """Return the printed TeX of an entry of the ledger as a line of `notation`.

    ``name`` is the exact name, ``signs`` maps TeX of letters to plain letters. Raises UnreadableError as `tex.line`
    does.
    """
    return tex.line(EQUATIONS[name].tex, signs)


def evaluated(name: str, signs: Mapping[str, str], letters: Mapping[str, Value], side: int = 1) -> Value:
    """Return the value, SymPy expression or matrix, of a side of the first relation of an entry's printed form.

    ``name`` is the entry's exact name, ``signs`` its table of letters. ``side`` counts the sides from 0: by default
    the one behind the first sign of equality. ``letters`` are added to `COMMON`; other letters stay symbols.
    """
    line = sides(read(name, signs))[side]
    return Reader({**COMMON, **letters}).value(parse(f"{line} = 0")[0].left, {})


def _joined(outcomes: Sequence[Outcome]) -> Outcome:
    """Return the first outcome that is refuted, else undecided, else supported, else "proved" for all lines together.

    A proof names the methods of all lines, each once; without lines it is proved with an empty method.
    """
    for decision in ("refuted", "undecided", "supported"):
        for outcome in outcomes:
            if outcome.decision == decision:
                return outcome
    return Outcome(
        "proved", ", ".join(dict.fromkeys(how for outcome in outcomes for how in outcome.method.split(", ")))
    )
