"""Tries the entries of the ledger, from the cache where the proof hasn't changed."""

import json
import signal
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

from atlas import processes
from atlas.errors import AtlasError
from atlas.sources import digest
from atlas.trial.ledger import EQUATIONS, equation, find, topic
from atlas.trial.proofs import recorded
from atlas.trial.proofs.decide import Outcome
from atlas.trial.proofs.trial import Part, Trial
from atlas.trial.proofs.verdict import Verdict

LIMIT = 60.0  # seconds of the processor that one trial may take; more is undecided
CACHE = Path("build") / "proofs"
FIELDS = sorted(Verdict.__dataclass_fields__)

Progress = Callable[[str, int, int], None]


class OverTimeError(Exception):
    """Raised by `limit`: a trial has used up its processor time."""


@contextmanager
def limit(seconds: float) -> Iterator[None]:
    """Raise OverTimeError within the block after ``seconds`` of processor time; other programs do not shorten it.

    Outside the main thread, or where the system has no such timer, the block runs without a limit.
    """
    if not hasattr(signal, "setitimer") or threading.current_thread() is not threading.main_thread():
        yield
        return

    def stop(_number: int, _frame: Any) -> None:
        raise OverTimeError

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


@cache
def trials(stem: str) -> dict[str, Trial]:
    """Return the trials of one topic by name, each with the topic's `SIGNS` added to its own; cached.

    ``stem`` is the topic, the stem of its file of proofs, such as "quadric".
    """
    module = import_module(f"atlas.trial.proofs.{stem}")
    signs: dict[str, str] = getattr(module, "SIGNS", {})
    return {
        name: replace(trial, name=name, signs={**signs, **trial.signs}, corrected_tex=EQUATIONS[name].corrected_tex)
        for name, trial in module.TRIALS.items()
    }


def trial(name: str) -> Trial:
    """Return the `Trial` of an entry of the ledger by its exact name, such as "(72)".

    Raises AtlasError for an unknown entry, or one without a trial.
    """
    equation(name)
    named = trials(topic(name)).get(name)
    if named is None:
        raise AtlasError(f"nothing has been tried about {name!r}: add a trial to atlas/trial/proofs/{topic(name)}.py")
    return named


def try_one(name: str) -> Verdict:
    """Try an entry of the ledger now, and return its verdict; each form is undecided after `LIMIT` seconds.

    ``name`` is the exact name, such as "(72)". Raises AtlasError as `trial` does.
    """
    entry, case = equation(name), trial(name)
    start = time.process_time()
    outcome = within_time(lambda: case.of_printed(shrink=True))
    corrected = within_time(true_form.of_printed).decision if (true_form := case.true_form) else ""
    false = case.false_part if case.false else None
    return Verdict(
        name=name,
        number=entry.number,
        section=entry.section,
        kind=entry.kind,
        verdict=outcome.decision,
        method=outcome.method,
        follows=entry.follows,
        printed=_lines(case.parts),
        said=case.said,
        not_read="; ".join(_unread(case)),
        outside=case.outside,
        grade=equation(entry.slip or name).grade,
        slip=entry.slip,
        corrected=_lines(case.corrected_parts),
        corrected_tex=case.corrected_tex,
        corrected_verdict=corrected,
        counterexample=outcome.counterexample,
        note=entry.note,
        false=entry.false,
        false_line=false.line if false else "",
        false_verdict=within_time(false.outcome).decision if false else "",
        seconds=round(time.process_time() - start, 2),
        source=recorded.source(name),
    )


def _unread(case: Trial) -> Iterable[str]:
    """Return the clauses of assumptions that the trial does not read, or one sentence if reading exceeds `LIMIT`."""
    try:
        with limit(LIMIT):
            return case.assumed.unread
    except OverTimeError:
        return (f"no assumption was read in {LIMIT:.0f} s",)


def _lines(statements: Iterable[Part]) -> str:
    return "; ".join(line.line for line in statements)


def within_time(run: Callable[[], Outcome]) -> Outcome:
    """Return the outcome of ``run``; undecided if it takes longer than `LIMIT` seconds of processor time."""
    try:
        with limit(LIMIT):
            return run()
    except OverTimeError:
        return Outcome("undecided", f"out of time after {LIMIT:.0f} s")


def verify(
    names: Iterable[str] | None = None,
    progress: Progress | None = None,
    *,
    jobs: int = 1,
    store: Any = None,
) -> list[Verdict]:
    """Try entries of the ledger, all if none is named, and return their verdicts in the ledger's order.

    names         words that `find` takes; None or empty for all entries
    progress      called with (name, how many are done, how many there are) after each trial that is made, not
                  for verdicts from the store
    jobs          processes side by side
    store         cache with methods get(key) and put(key, bytes), in which verdicts are kept by the fingerprint
                  of their proof; None tries everything anew

    Raises AtlasError for a word that means no entry.
    """
    chosen = {entry.name for name in names for entry in find(name)} if names else set(EQUATIONS)
    names_in_order = [name for name in EQUATIONS if name in chosen]
    keys = {name: digest("verdict", FIELDS, name, recorded.source(name)) for name in names_in_order} if store else {}
    vocabulary = {name: entry for name, key in keys.items() if (entry := store.get(key)) is not None}
    verdicts = {name: Verdict(**json.loads(entry)) for name, entry in vocabulary.items()}
    stale_names = [name for name in names_in_order if name not in verdicts]
    for done, (name, result) in enumerate(_verdicts_of(stale_names, jobs), len(verdicts) + 1):
        verdicts[name] = result
        if store:
            store.put(keys[name], json.dumps(result.as_dict()).encode())
        if progress:
            progress(name, done, len(names_in_order))
    return [verdicts[name] for name in names_in_order]


def _verdicts_of(names: list[str], jobs: int) -> Iterator[tuple[str, Verdict]]:
    executor = processes.pool(jobs, context="fork") if jobs > 1 and len(names) > 1 else None
    if executor is None:
        yield from ((name, try_one(name)) for name in names)
        return
    with executor as pool:
        trials = [pool.submit(try_one, name) for name in names]
        yield from ((name, trial.result()) for name, trial in zip(names, trials, strict=True))
