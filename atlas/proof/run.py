"""Tries the entries of the ledger, from the cache where the proof hasn't changed."""

import json
import signal
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import cache, partial
from importlib import import_module
from pathlib import Path
from typing import Any, TypeVar

from atlas import processes
from atlas.errors import AtlasError
from atlas.paper import EQUATIONS, equation, find, topic
from atlas.paper.equation import slug
from atlas.proof import recorded
from atlas.proof.changes import changes
from atlas.proof.decide import Outcome
from atlas.proof.model import Model
from atlas.proof.quick import Numbers
from atlas.proof.trial import Part, Trial
from atlas.proof.verdict import Sensitivity, Verdict

LIMIT = 60.0  # seconds of the processor that one trial may take; more is undecided
SAMPLE = 24  # changes of one line that are tried, if not all
CACHE = Path("build") / "proofs"

Progress = Callable[[str, int, int], None]
Found = TypeVar("Found", Verdict, Sensitivity)


class _OverTimeError(Exception):
    """A trial has used up its time."""


@contextmanager
def limit(seconds: float) -> Iterator[None]:
    """Stop what runs inside after that many seconds of the processor; only the main thread, where there are signals.

    So a verdict does not depend on what else the machine does.
    """
    if not hasattr(signal, "setitimer") or threading.current_thread() is not threading.main_thread():
        yield
        return

    def stop(_number: int, _frame: Any) -> None:
        raise _OverTimeError

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


@cache
def trials(stem: str) -> dict[str, Trial]:
    """Return the trials of one topic by name."""
    return {trial.name: trial for trial in import_module(f"atlas.proof.{stem}").TRIALS}


def trial(name: str) -> Trial:
    """Return the trial of an entry of the ledger."""
    equation(name)
    found = trials(topic(name)).get(name)
    if found is None:
        raise AtlasError(f"nothing has been tried about {name!r}: add a trial to atlas/proof/{topic(name)}.py")
    return found


def try_one(name: str) -> Verdict:
    """Try one entry of the ledger, now."""
    entry, case = equation(name), trial(name)
    start = time.perf_counter()
    outcome = _within_time(lambda: case.of_printed(shrink=True))
    corrected = _within_time(case.of_corrected).decision if case.corrected else ""
    false = case.false_part if case.false else None
    return Verdict(
        name=name,
        number=entry.number,
        section=entry.section,
        kind=entry.kind,
        verdict=outcome.decision,
        method=outcome.method,
        follows=case.follows,
        printed=_lines(case.parts),
        grade=case.grade,
        slip=case.slip,
        corrected=_lines(case.corrected_parts),
        corrected_tex=case.corrected_tex,
        corrected_verdict=corrected,
        counterexample=outcome.counterexample,
        note=case.note,
        false=case.false.says if case.false else "",
        false_line=false.line if false else "",
        false_verdict=_within_time(false.outcome).decision if false else "",
        seconds=round(time.perf_counter() - start, 2),
        source=recorded.source(name),
    )


def _lines(parts: Iterable[Part]) -> str:
    return "; ".join(part.line for part in parts)


def _within_time(run: Callable[[], Outcome]) -> Outcome:
    try:
        with limit(LIMIT):
            return run()
    except _OverTimeError:
        return Outcome("undecided", f"out of time after {LIMIT:.0f} s")


def try_mutants(name: str, *, every: bool = False) -> Sensitivity:
    """Change the form of an entry that is proved in one place at a time, and see whether the trial notices.

    every  all changes that the grammar yields, not a sample of them
    """
    case = trial(name)
    start = time.perf_counter()
    tried, unrefuted = 0, []
    for part in case.true_parts:
        cases = part.model()
        first = cases if isinstance(cases, Model) else cases[0]
        known = frozenset(first.letters) | set(part.defines)
        numbers = Numbers(part)
        for line, what in changes(part.line, known, most=None if every else SAMPLE, seed=name):
            tried += 1
            if numbers.refute(line):
                continue
            if _within_time(lambda part=part, line=line: part.outcome(line, sample_only=True)).decision != "refuted":  # type: ignore[misc]
                full = _within_time(lambda part=part, line=line: part.outcome(line)).decision  # type: ignore[misc]
                unrefuted.append((what, line, full))
    return Sensitivity(
        name=name,
        tried=tried,
        noticed=tried - len(unrefuted),
        unrefuted=tuple(unrefuted),
        seconds=round(time.perf_counter() - start, 2),
        source=recorded.source(name, changes=True),
    )


def verify(
    names: Iterable[str] | None = None,
    progress: Progress | None = None,
    *,
    jobs: int = 1,
    cache_folder: Path | None = None,
) -> list[Verdict]:
    """Try entries of the ledger, all if none is named, and return their verdicts in the ledger's order.

    progress      called with (name, how many are done, how many there are) after each trial
    jobs          processes side by side
    cache_folder  where verdicts are kept by the fingerprint of their proof; None tries everything anew
    """
    return _run(try_one, "verdict", Verdict, names, progress, jobs, cache_folder)


def mutants(
    names: Iterable[str] | None = None,
    progress: Progress | None = None,
    *,
    every: bool = False,
    jobs: int = 1,
    cache_folder: Path | None = None,
) -> list[Sensitivity]:
    """Try a sample of the mutants of entries of the ledger, or `every` one; other arguments as for `verify`."""
    run = partial(try_mutants, every=every)
    return _run(run, "all-mutants" if every else "mutants", recorded.sensitivity, names, progress, jobs, cache_folder)


def _run(
    run: Callable[[str], Found],
    kind: str,
    make: Callable[..., Found],
    names: Iterable[str] | None,
    progress: Progress | None,
    jobs: int,
    folder: Path | None,
) -> list[Found]:
    meant = {entry.name for name in names for entry in find(name)} if names else set(EQUATIONS)
    wanted = [name for name in EQUATIONS if name in meant]
    prints = {name: recorded.source(name, changes=kind != "verdict") for name in wanted}
    places = {name: folder / f"{kind}-{slug(name)}-{prints[name]}.json" for name in wanted} if folder else {}
    found = {name: make(**json.loads(path.read_text("utf-8"))) for name, path in places.items() if path.is_file()}
    missing = [name for name in wanted if name not in found]
    for done, (name, result) in enumerate(_each(run, missing, jobs), len(found) + 1):
        found[name] = result
        if folder:
            folder.mkdir(parents=True, exist_ok=True)
            fresh = places[name].with_suffix(".new")
            fresh.write_text(json.dumps(result.as_dict()), "utf-8")
            fresh.replace(places[name])
        if progress:
            progress(name, done, len(wanted))
    return [found[name] for name in wanted]


def _each(run: Callable[[str], Found], names: list[str], jobs: int) -> Iterator[tuple[str, Found]]:
    executor = processes.pool(jobs, context="fork") if jobs > 1 and len(names) > 1 else None
    if executor is None:
        yield from ((name, run(name)) for name in names)
        return
    with executor as pool:
        yield from zip(names, pool.map(run, names), strict=True)
