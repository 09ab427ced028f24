"""The trial of the paper's equations: claims, proofs and verdicts; an independent witness that imports no kernel.

    from atlas.trial import proofs
    proofs.verify(["(72)"])       try entries of the ledger now, all if none is named
    proofs.recorded.load()        the recorded verdicts, without SymPy

`notation` reads a printed formula, `model` gives values to its letters, `decide` decides, `trial` joins the three; one
file holds the trials of one topic, under the name that it has in the ledger. Modules with SymPy are loaded when one is
used.
"""

from importlib import import_module
from typing import Any

from atlas.trial.proofs import recorded
from atlas.trial.proofs.verdict import Verdict

__all__ = ["Verdict", "recorded", "script_of", "sides_of", "try_one", "verify"]

_LAZY = {"verify": "run", "try_one": "run", "script_of": "script", "sides_of": "script"}


def __getattr__(name: str) -> Any:
    """Return `verify`, `try_one`, `script_of` or `sides_of`; its module, which needs SymPy, is loaded at first use.

    Raises AttributeError for any other name.
    """
    if name not in _LAZY:
        raise AttributeError(f"module 'atlas.trial.proofs' has no attribute {name!r}")
    return getattr(import_module(f"atlas.trial.proofs.{_LAZY[name]}"), name)
