"""The public interface: names, what they take, in which order, and what is taken where something is left out."""

import inspect
from collections.abc import Callable, Iterator
from typing import Any

import lines
from syrupy.assertion import SnapshotAssertion

import atlas


def taken(call: Callable[..., Any]) -> str:
    """Return what a function takes, without the types."""
    given = inspect.signature(call).parameters.values()
    return str(inspect.Signature([one.replace(annotation=inspect.Parameter.empty) for one in given]))


def public() -> Iterator[tuple[str, Callable[..., Any]]]:
    """Yield the functions and classes of `atlas`, and public methods with the class that has them, each once."""
    for name in sorted(atlas.__all__):
        one = getattr(atlas, name)
        if not callable(one) or (inspect.isclass(one) and issubclass(one, BaseException)):
            continue
        yield name, one
        for of in reversed(inspect.getmro(one) if inspect.isclass(one) else ()):
            for key, value in sorted(vars(of).items()):
                method = getattr(value, "__func__", value)
                if inspect.isfunction(method) and not key.startswith("_") and of.__module__.startswith("atlas"):
                    yield f"{of.__name__}.{key}", method


def test_public_functions_take_what_they_took(snapshot: SnapshotAssertion) -> None:
    """A line for each: a change here is one for every user."""
    assert [name + taken(call) for name, call in dict(public()).items()] == snapshot.use_extension(lines.Lines)
