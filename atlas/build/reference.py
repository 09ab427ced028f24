"""The public names of the package, as its reference shows them: arguments and docstrings, read from the code itself."""

import inspect
from collections.abc import Mapping
from typing import Any

import atlas
from atlas.report.appendices import Described


def described() -> dict[str, Described]:
    """Return what there is to know of each public name, with the public members of classes, inherited ones too."""
    names = [name for name in atlas.__all__ if not name.startswith("_")]
    return {name: _described(getattr(atlas, name), _members(getattr(atlas, name))) for name in names}


def _members(thing: Any) -> Mapping[str, Described]:
    """Return the members of a class that have a docstring of ours, its own first."""
    found: dict[str, Described] = {}
    for cls in inspect.getmro(thing) if inspect.isclass(thing) else ():
        for name, member in vars(cls).items() if cls.__module__.startswith("atlas") else ():
            called = not hasattr(member, "fget") and not hasattr(member, "func")  # no property, no cached property
            inner = (getattr(member, part, None) for part in ("fget", "func", "__func__"))
            code = next(filter(None, inner), member)
            if not name.startswith("_") and inspect.isfunction(code) and name not in found:
                found[name] = _described(code, {}, called=called)
    return found


def _described(thing: Any, members: Mapping[str, Described], *, called: bool = True) -> Described:
    return Described(_arguments(thing) if called else "", inspect.getdoc(thing) or "", members)


def _arguments(thing: Any) -> str:
    """Return the arguments of what can be called, with their defaults; nothing for an exception."""
    if inspect.isclass(thing) and issubclass(thing, BaseException):
        return ""
    signature = inspect.signature(thing)
    plain = [
        parameter.replace(annotation=inspect.Parameter.empty)
        for name, parameter in signature.parameters.items()
        if name not in {"self", "cls"}
    ]
    shown = str(signature.replace(parameters=plain, return_annotation=inspect.Signature.empty))
    return shown.replace("<factory>", "...")
