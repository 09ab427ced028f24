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
from atlas.paper import EQUATIONS, equation, topic
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
    """Return the trials of one topic by label."""
    return {trial.label: trial for trial in import_module(f"atlas.proof.{stem}").TRIALS}


def trial(label: str) -> Trial:
    """Return the trial of an entry of the ledger."""
    equation(label)
    found = trials(topic(label)).get(label)
    if found is None:
        raise AtlasError(f"nothing has been tried about {label!r}: add a trial to atlas/proof/{topic(label)}.py")
    return found


def try_one(label: str) -> Verdict:
    """Try one entry of the ledger, now."""
    entry, case = equation(label), trial(label)
    start = time.perf_counter()
    outcome = _within_time(lambda: case.of_printed(shrink=True))
    corrected = _within_time(case.of_corrected).decision if case.corrected else ""
    return Verdict(
        label=label,
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
        seconds=round(time.perf_counter() - start, 2),
        source=recorded.source(label),
    )


def _lines(parts: Iterable[Part]) -> str:
    return "; ".join(part.line for part in parts)


def _within_time(run: Callable[[], Outcome]) -> Outcome:
    try:
        with limit(LIMIT):
            return run()
    except _OverTimeError:
        return Outcome("undecided", f"out of time after {LIMIT:.0f} s")


def try_mutants(label: str, *, every: bool = False) -> Sensitivity:
    """Change the form of an entry that is proved in one place at a time, and see whether the trial notices.

    every  all changes that the grammar yields, not a sample of them
    """
    case = trial(label)
    start = time.perf_counter()
    tried, survivors = 0, []
    for part in case.true_parts:
        cases = part.model()
        first = cases if isinstance(cases, Model) else cases[0]
        known = frozenset(first.letters) | set(part.defines)
        numbers = Numbers(part)
        for line, what in changes(part.line, known, most=None if every else SAMPLE, seed=label):
            tried += 1
            if numbers.refute(line):
                continue
            if _within_time(lambda part=part, line=line: part.outcome(line, sample_only=True)).decision != "refuted":  # type: ignore[misc]
                full = _within_time(lambda part=part, line=line: part.outcome(line)).decision  # type: ignore[misc]
                survivors.append((what, line, full))
    return Sensitivity(
        label=label,
        tried=tried,
        noticed=tried - len(survivors),
        survivors=tuple(survivors),
        seconds=round(time.perf_counter() - start, 2),
        source=recorded.source(label, changes=True),
    )


def verify(
    labels: Iterable[str] | None = None,
    progress: Progress | None = None,
    *,
    jobs: int = 1,
    cache_folder: Path | None = None,
) -> list[Verdict]:
    """Try entries of the ledger, all if none is named, and return their verdicts in the ledger's order.

    progress      called with (label, how many are done, how many there are) after each trial
    jobs          processes side by side
    cache_folder  where verdicts are kept by the fingerprint of their proof; None tries everything anew
    """
    return _run(try_one, "verdict", Verdict, labels, progress, jobs, cache_folder)


def mutants(
    labels: Iterable[str] | None = None,
    progress: Progress | None = None,
    *,
    every: bool = False,
    jobs: int = 1,
    cache_folder: Path | None = None,
) -> list[Sensitivity]:
    """Try a sample of the mutants of entries of the ledger, or `every` one; other arguments as for `verify`."""
    run = partial(try_mutants, every=every)
    return _run(run, "all-mutants" if every else "mutants", recorded.sensitivity, labels, progress, jobs, cache_folder)


def _run(
    run: Callable[[str], Found],
    kind: str,
    make: Callable[..., Found],
    labels: Iterable[str] | None,
    progress: Progress | None,
    jobs: int,
    folder: Path | None,
) -> list[Found]:
    wanted = [equation(label).label for label in labels] if labels else list(EQUATIONS)
    wanted = [label for label in EQUATIONS if label in set(wanted)]
    prints = {label: recorded.source(label, changes=kind != "verdict") for label in wanted}
    places = {label: folder / f"{kind}-{label}-{prints[label]}.json" for label in wanted} if folder else {}
    found = {label: make(**json.loads(path.read_text("utf-8"))) for label, path in places.items() if path.is_file()}
    missing = [label for label in wanted if label not in found]
    for done, (label, result) in enumerate(_each(run, missing, jobs), len(found) + 1):
        found[label] = result
        if folder:
            folder.mkdir(parents=True, exist_ok=True)
            fresh = places[label].with_suffix(".new")
            fresh.write_text(json.dumps(result.as_dict()), "utf-8")
            fresh.replace(places[label])
        if progress:
            progress(label, done, len(wanted))
    return [found[label] for label in wanted]


def _each(run: Callable[[str], Found], labels: list[str], jobs: int) -> Iterator[tuple[str, Found]]:
    executor = processes.pool(jobs, context="fork") if jobs > 1 and len(labels) > 1 else None
    if executor is None:
        yield from ((label, run(label)) for label in labels)
        return
    with executor as pool:
        yield from zip(labels, pool.map(run, labels), strict=True)
