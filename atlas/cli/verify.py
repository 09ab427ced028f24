"""``atlas verify``: the paper's equations on trial."""

from collections import Counter
from typing import Any

import click

from atlas.cli.options import examples, json_option
from atlas.cli.present import Printout, bar, dump, show
from atlas.cli.words import Command
from atlas.trial.ledger.plain import plain

COLUMNS = (
    "name",
    "number",
    "section",
    "kind",
    "verdict",
    "grade",
    "slip",
    "printed",
    "corrected",
    "counterexample",
    "seconds",
)


@click.command(
    "verify",
    cls=Command,
    epilog=examples("atlas verify 48 71", "atlas verify 48 --script > proof.py", "atlas verify --json"),
)
@click.argument("names", nargs=-1, metavar="[NUMBER|NAME...]")
@click.option(
    "--record", is_flag=True, help="Save the verdicts of all equations as the record from which reports are made."
)
@click.option("--anew", is_flag=True, help="Run every proof again instead of taking verdicts from the cache.")
@click.option(
    "--jobs",
    "-j",
    type=click.IntRange(min=1),
    default=1,
    show_default=True,
    help="Number of proofs that run at the same time.",
)
@click.option("--script", is_flag=True, help="Print the proof of one equation as a SymPy script, and nothing else.")
@json_option
def command(names: tuple[str, ...], record: bool, anew: bool, jobs: int, script: bool, as_json: bool) -> int:
    """Prove or refute equations and claims of the paper as printed; all of them if none is named.

    NUMBER is the printed number of an equation, 72 or "(72)"; in the appendix also the journal's, A5. NAME is a theorem
    or an equation without a number, by its name in the ledger or its LaTeX label in the paper's source.

    A verdict is proved, refuted, undecided, supported (by examples, not proved), or definition. A refuted equation is
    shown with a counterexample in numbers and a corrected form, which is proved; slips have a grade, such as misprint.
    For a named equation both sides are printed as polynomials in free parameters. The exit status is 1 if a verdict
    differs from the recorded one.

    --script prints a SymPy program that runs without atlas. Its last line names the equation that is proved or
    refuted; it exits with status 1 if the proof fails.
    """
    if record and names:
        raise click.UsageError("--record keeps the verdicts of all equations: name none.")
    from atlas.book.building.cache import Cache
    from atlas.places import cache_folder
    from atlas.trial import proofs as proof
    from atlas.trial.ledger import find
    from atlas.trial.proofs.run import CACHE

    if script and (as_json or len({entry.name for name in names for entry in find(name)}) != 1):
        raise click.UsageError("--script prints one script: name one equation, without --json.")

    options: dict[str, Any] = {"jobs": jobs, "store": None if anew else Cache(cache_folder(CACHE))}
    with bar("trials") as tell:
        verdicts = proof.verify(names or None, lambda name, done, total: tell(done, total, name), **options)
    if script:
        return _script(verdicts[0])
    status = _verdicts(verdicts, as_json, record, named=bool(names))
    if record:
        proof.recorded.save(verdicts)
        proof.recorded.save_scripts({verdict.name: proof.script_of(verdict) for verdict in verdicts})
    return status


def _verdicts(verdicts: Any, as_json: bool, record: bool, *, named: bool) -> int:
    """Print `Verdict`s, as JSON or a table, and on standard error each difference from the record.

    With `named` the parts of each verdict follow. Returns 1 for a difference, unless `record` says that they are
    recorded, else 0.
    """
    from atlas.trial.proofs.recorded import differs

    different = differs(verdicts)
    if as_json:
        equations = [
            {name: verdict.as_dict()[name] for name in COLUMNS} | {"example": verdict.example} for verdict in verdicts
        ]
        dump({"equations": equations, "different": [list(row) for row in different]})
    else:
        _table(verdicts)
        for verdict in verdicts:
            if verdict.grade or named:
                click.echo(_details(verdict, named=named))
        _totals(verdicts)
    for name, was, now in different:
        click.echo(f"atlas: {name} was recorded as {was} and is found {now}", err=True)
    return int(bool(different) and not record)


def _script(verdict: Any) -> int:
    """Print the SymPy script of one `Verdict`; return 1 if it differs from the recorded one, else 0.

    Raises AtlasError where the entry has no script.
    """
    from atlas.errors import AtlasError
    from atlas.trial import proofs as proof

    text = proof.script_of(verdict)
    if not text.startswith("#"):
        raise AtlasError(f"{verdict.name}: {text}")
    click.echo(text, nl=False)
    return int(bool(proof.recorded.differs([verdict])))


def _table(verdicts: Any) -> None:
    """Print `Verdict`s as a table with one line each, the time of a proof in s."""
    heading = ("equation", "verdict", "slip", "corrected form", "method", "s")
    rows = [
        [
            verdict.name,
            verdict.verdict,
            verdict.grade,
            verdict.corrected_verdict,
            plain(verdict.method),
            f"{verdict.seconds:.1f}",
        ]
        for verdict in verdicts
    ]
    show(Printout("the paper's equations on trial, as printed", heading=heading, rows=rows, justify="left"))


def _details(verdict: Any, *, named: bool) -> str:
    """Return the text of a `Verdict`, a line for each part; `named` adds the parts shown for one entry alone."""
    from atlas.trial.ledger import EQUATIONS

    says = {"says": EQUATIONS[verdict.name].says, "tried from": verdict.follows} if named else {}
    words = [(name, plain(text)) for name, text in says.items()]
    words += [("also says", _reading(*pair)) for pair in verdict.said.items() if named]
    words += [("not read", f"of what is assumed: {plain(verdict.not_read)}")] if named and verdict.not_read else []
    words += [("outside", plain(verdict.outside))] if named else []
    words += [("as printed", verdict.printed), ("counterexample", verdict.example), ("corrected", verdict.corrected)]
    words += [("note", plain(verdict.note))] if named else []
    lines = [f"  {name + ':':16}{text}" for name, text in words if text]
    return "\n".join([verdict.name, *lines, *(_proof(verdict) if named else ())])


def _reading(phrase: str, line: str) -> str:
    """Return a sentence on a phrase of a formula, in TeX: as which `line` it was tried, or, for "", supposed."""
    sentence = " ".join(plain(f"${phrase}$").split())
    return f"{sentence}: {f'tried as {line}' if line else 'supposed, or tried in a further line'}"


def _proof(verdict: Any) -> list[str]:
    """Return the lines of both sides of a proved form, none if they are not known, and the command for its script."""
    from atlas.trial import proofs as proof

    lines = [f"    {line}" for line in proof.sides_of(verdict.name)]
    return [
        *(["  proof:", *lines] if lines else []),
        f"  {'script:':16}atlas verify {verdict.number or verdict.name} --script",
    ]


def _totals(verdicts: Any) -> None:
    """Print the count of each verdict, the time of all trials in s, and the count of each kind of slip."""
    from atlas.trial.proofs.verdict import slips

    totals = Counter(verdict.verdict for verdict in verdicts)
    seconds = sum(verdict.seconds for verdict in verdicts)
    click.echo(f"{', '.join(f'{n} {name}' for name, n in totals.most_common())}; {seconds:.0f} s of trials")
    graded = {grade: len(names) for grade, names in slips(verdicts).items() if names}
    if graded:
        one_verdict = ", ".join(f"{count} {grade}" for grade, count in graded.items())
        count = sum(graded.values())
        click.echo(f"{count} distinct slip{'s' if count != 1 else ''}: {one_verdict}")
