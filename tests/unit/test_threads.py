"""Objects that threads share: the first calls have one result, in any order and at any precision of flint."""

import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from random import Random
from threading import Barrier, Event, Thread
from typing import Any

import numpy as np
import pytest
from flint import ctx

import atlas
from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import workprec
from atlas.motions.nutation.certified_general import GeneralMotion
from atlas.motions.torus.kernel import forget

TIMES = np.array([0.3, 1.7, 5.0])
OMEGA = (0.3, 0.7, 0.2)
FRESH: dict[str, Callable[[], Any]] = {
    "quadric": lambda: atlas.Quadric(1.5, (1.0, 2.0)),
    "hyperbola": lambda: atlas.Hyperbola(1.5, (1.0, 2.0)),
    "elementary": lambda: atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7),
    "elementary motions": lambda: atlas.ElementaryMotion(1.5, (1.0, 2.0), np.array([0.7, 0.8, 0.9])),
    "free": lambda: atlas.FreeMotion(1.5, OMEGA),
    "general": lambda: atlas.GeneralMotion(1.5, (1.0, 2.0), OMEGA),
    "general motions": lambda: atlas.GeneralMotion(1.5, (1.0, 2.0), (np.array([0.3, 0.4, 0.1]), 0.7, 0.2)),
    "ball": lambda: atlas.BallMotion(0.4, 1.3, momentum=(0.3, 0.8)),
    "top": lambda: atlas.TopMotion((1.0, 1.5), (0.3, 0.4), (0.6, 0.8), (0.1, 0.2, 3.0), linear=0.7),
    "elliptic": lambda: atlas.EllipticMotion((0.8, 1.0, 1.2), (0.2, 1.0, 0.6), 1.7),
    "Euler's top": lambda: atlas.AsymmetricMotion((0.8, 1.0, 1.3), (0.0, 0.0, 0.0), OMEGA),
    "three moments": lambda: atlas.AsymmetricMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), OMEGA),
    "given axes": lambda: atlas.motion(1.4, (0.4, -0.9, 1.2), (0.5, 0.3, -1.1)),
    "particle": lambda: atlas.ParticleMotion(1.1, (0.1, 0.2, 0.3), (0.3, 0.1, 2.0), (0, 0, 0), (1, 2, 0.3)),
}
SLOW, QUICK = "three moments", ("rotation", "angular_velocity", "field_in_body", "third_axis")
CALLS: dict[str, Callable[[Any], Any]] = {
    **{
        name: lambda x, name=name: getattr(x, name)(TIMES)  # type: ignore[misc]
        for name in ("rotation", "angular_velocity", "field_in_body", "quaternion", "third_axis", "position")
    },
    "rotation_grid": lambda x: x.rotation_grid(0.0, 0.1, 20),
    "spectrum": lambda x: x.spectrum("axis").amplitudes,
    "sensitivity": lambda x: x.sensitivity(TIMES, ["t", "omega1"]),
    "sample": lambda x: x.sample(20),
}
"""Methods that are called with arguments."""


def calls(subject: Any, *, slow: bool) -> dict[str, Callable[[Any], Any]]:
    """Return the calls that an object takes, and its properties."""
    kind = type(subject)
    calls_made = {name: CALLS[name] for name in (QUICK if slow else CALLS) if hasattr(kind, name)}
    if not slow:
        names = [name for name in dir(kind) if name[0] != "_" and not callable(getattr(kind, name))]
        calls_made |= {
            name: lambda x, name=name: getattr(x, name)  # type: ignore[misc]
            for name in names
            if hasattr(getattr(kind, name), "__get__")
        }
    return calls_made


def answered(call: Callable[[Any], Any], subject: Any) -> str:
    """Return all digits of a call's result, or its error."""
    try:
        answer = call(subject)
    except (atlas.AtlasError, TypeError) as error:  # no line in closed form, no such input
        return f"{type(error).__name__}: {error}"
    plain = answer.tolist() if isinstance(answer, np.ndarray) else answer
    with np.printoptions(precision=17, floatmode="unique", threshold=10**6):  # each thread has options of its own
        text = repr(plain)
    return "" if " object at " in text else text


def answers_alone(name: str) -> dict[str, str]:
    """Return the result of each call as the first of a new object."""
    answers = {}
    for key, call in calls(FRESH[name](), slow=name == SLOW).items():
        forget()
        answers[key] = answered(call, FRESH[name]())
    return answers


@pytest.fixture
def _restless() -> Iterator[None]:
    """Let threads take turns as often as they can."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(before)


@pytest.mark.slow
@pytest.mark.parametrize("name", FRESH)
@pytest.mark.usefixtures("_restless")
def test_threads_that_share_a_new_object_get_the_serial_results(name: str) -> None:
    """Six threads, each with other first calls, and all calls afterwards, bit for bit."""
    calls_made, expected, random = calls(FRESH[name](), slow=name == SLOW), answers_alone(name), Random(53)  # noqa: S311  no secret
    for _ in range(2 if name == SLOW else 12):
        forget()
        subject, barrier = FRESH[name](), Barrier(6)
        orders = [random.sample(sorted(calls_made), min(4, len(calls_made))) for _ in range(6)]

        def ask(order: list[str], subject: Any = subject, barrier: Barrier = barrier) -> list[tuple[str, str]]:
            barrier.wait()
            return [(key, answered(calls_made[key], subject)) for key in order]

        with ThreadPoolExecutor(6) as pool:
            answers = [pair for pairs in pool.map(ask, orders) for pair in pairs]
        answers += [(key, answered(call, subject)) for key, call in calls_made.items()]
        assert [pair for pair in answers if pair[1] != expected[pair[0]]] == []


@pytest.mark.slow
@pytest.mark.parametrize("name", FRESH)
def test_values_do_not_depend_on_the_precision_that_flint_has(name: str) -> None:
    """Which is another thread's, or the caller's own: of 24 digits nothing is seen."""
    expected = answers_alone(name)
    with workprec(24):
        assert answers_alone(name) == expected


def test_a_value_of_a_parent_class_is_not_taken_for_that_of_its_subclass() -> None:
    """While a subclass makes its value from its parent's, another thread makes its own, and gets the subclass's."""
    values, inside, go_on = list[int](), Event(), Event()

    class Parent:
        @cached_property
        def value(self) -> int:
            return 1

    class Child(Parent):
        @cached_property
        def value(self) -> int:
            parent = super().value
            inside.set()
            go_on.wait(10.0)
            return parent + 1

    child = Child()
    thread = Thread(target=lambda: values.append(child.value))
    thread.start()
    inside.wait()
    assert "value" not in vars(child)
    second = Thread(target=lambda: values.append(child.value))
    second.start()
    go_on.set()
    thread.join()
    second.join()
    assert [*values, child.value] == [2, 2, 2]


def test_all_threads_get_the_value_that_was_stored_first() -> None:
    """Two threads that make a value at one time get the same object."""

    class Thing:
        barrier = Barrier(2, timeout=5.0)

        @cached_property
        def value(self) -> list[int]:
            self.barrier.wait()
            return []

    subject = Thing()
    with ThreadPoolExecutor(2) as pool:
        first, second = pool.map(lambda _: subject.value, range(2))
    assert first is second is subject.value


def test_a_motion_is_made_while_another_thread_holds_the_precision() -> None:
    """A lazily computed value waits for the precision, and the holder of the precision does not wait for it."""
    inside = Event()

    def hold() -> None:
        inside.wait()
        GeneralMotion(1.5, (1, 2), OMEGA)

    def make() -> list[Any]:
        inside.set()
        time.sleep(0.2)  # in which the other thread comes to where it waits
        return [GeneralMotion(1.5, (1, 2), (0.3, 0.7, 0.1)).quartic.low]

    threads = [Thread(target=hold, daemon=True), Thread(target=lambda: enclosed(make, 64), daemon=True)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(5.0)
    assert not any(thread.is_alive() for thread in threads)
    assert ctx.prec == 53
