"""The public interface: names, parameters in their order, and defaults."""

import ast
import inspect
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import lines
import pytest
from syrupy.assertion import SnapshotAssertion

import atlas
from atlas.places import folder


def signature_of(call: Callable[..., Any]) -> str:
    """Return the parameters of a function, without the types."""
    parameters = inspect.signature(call).parameters.values()
    return str(inspect.Signature([parameter.replace(annotation=inspect.Parameter.empty) for parameter in parameters]))


def public() -> Iterator[tuple[str, Callable[..., Any]]]:
    """Yield the functions and classes of `atlas`, and public methods with the class that has them, each once."""
    for name in sorted(atlas.__all__):
        member = getattr(atlas, name)
        if not callable(member) or (inspect.isclass(member) and issubclass(member, BaseException)):
            continue
        yield name, member
        for base in reversed(inspect.getmro(member) if inspect.isclass(member) else ()):
            for key, value in sorted(vars(base).items()):
                method = getattr(value, "__func__", value)
                if inspect.isfunction(method) and not key.startswith("_") and base.__module__.startswith("atlas"):
                    yield f"{base.__name__}.{key}", method


def test_public_signatures_are_unchanged(snapshot: SnapshotAssertion) -> None:
    """A line for each: a change here is one for every user."""
    assert [name + signature_of(call) for name, call in dict(public()).items()] == snapshot.use_extension(lines.Lines)


ROOT = folder("figures").parent
CALLS = ROOT / "tests" / "typed_calls.py"
RUNS = """
import atlas
import numpy as np

t, motion = np.arange(3), atlas.FreeMotion(1.5, (0.1, 0.7, 0.2))
reveal_type(atlas.check(t, motion=motion))
reveal_type(atlas.check([0.0, 1.0], motion=motion))
reveal_type(atlas.check([t, t], motion=motion))
reveal_type(atlas.sweep("free", {}, ["kind"], digits=20))
reveal_type(atlas.sweep("free", {}, ["kind"], "free.csv"))
"""


def checked(path: Path, text: str) -> str:
    """Return mypy's output for a file with this text."""
    path.write_text(text, encoding="utf-8")
    return said_of(path)


def said_of(path: Path) -> str:
    """Return mypy's output for a file, with the cache of `make lint`."""
    command = [sys.executable, "-m", "mypy", "--config-file", "pyproject.toml", "--follow-imports", "silent", str(path)]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False).stdout


def test_each_public_name_has_the_type_of_its_home() -> None:
    """The stub names all that `atlas` exports, each from the module that it is loaded from."""
    nodes = ast.parse((ROOT / "atlas" / "__init__.pyi").read_text("utf-8")).body
    stub = {alias.name: node.module for node in nodes if isinstance(node, ast.ImportFrom) for alias in node.names}
    assert stub == atlas._HOMES


@pytest.mark.slow
def test_a_type_checker_takes_right_calls_and_refuses_each_wrong_one() -> None:
    """Every statement of `refused_calls` is an error, and no statement of `accepted_calls` is."""
    text = CALLS.read_text("utf-8")
    refused_calls = next(
        node for node in ast.parse(text).body if isinstance(node, ast.FunctionDef) and node.name == "refused_calls"
    )
    refused = {int(line) for line in re.findall(r"^[^:]+:(\d+): error:", said_of(CALLS), re.MULTILINE)}
    assert refused == {statement.lineno for statement in refused_calls.body[1:]}


def test_no_public_parameter_or_result_is_of_any_type() -> None:
    """Each argument and result of a user has a type, so that an editor knows it."""
    assert [
        f"{name}: {key}"
        for name, call in public()
        for key, kind in (call.__init__ if inspect.isclass(call) else call).__annotations__.items()
        if kind is Any
    ] == []


@pytest.mark.slow
def test_a_type_checker_tells_one_run_from_several_and_columns_from_a_file(tmp_path: Path) -> None:
    """One run gives a `Check`, several a `Convergence`, a sweep without a file its columns."""
    types = [line.partition("Revealed type is ")[2] for line in checked(tmp_path / "mine.py", RUNS).splitlines()[:5]]
    check, order = '"atlas.checking.check.Check"', '"atlas.checking.order.Convergence"'
    assert types[:3] == [check, check, order]
    assert types[3].startswith('"dict[str, ')
    assert types[4] == '"pathlib.Path | str"'
