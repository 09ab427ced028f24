"""Parameters of a fit: values, bounds, expressions. Only expressions load lmfit, which evaluates them."""

import reprlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from math import hypot, inf, isfinite, isnan
from typing import Any

from atlas.errors import AtlasError
from atlas.fitting.data import Data
from atlas.fitting.models import B, Model, Values, unseen

LIMITS = {"ratio": (0.0, 2.0), "I1": (0.0, inf), "I3": (0.0, inf)}
"""Bounds of moments of inertia; the lower one is excluded."""

LENGTH = "sqrt(B1**2 + B2**2 + B3**2)"
"""Expression of `b`, the only expression evaluated without lmfit."""

KEYS = ("value", "vary", "min", "max", "expr")


@dataclass(frozen=True)
class Parameter:
    """A parameter with the attributes of lmfit's: `value`, standard error `stderr`, correlations `correl` by name.

    `stderr` and `correl` are None if the data leave the parameter undetermined. `vary` says whether the fit varies the
    parameter, between `min` and `max`; `expr` is an expression of others, or None.
    """

    value: float
    vary: bool = True
    min: float = -inf
    max: float = inf
    expr: str | None = None
    stderr: float | None = None
    correl: Mapping[str, float] | None = None

    @property
    def free(self) -> bool:
        """Whether the fit varies the parameter itself: `vary` is True and there is no expression."""
        return self.vary and self.expr is None


class Parameters(Mapping[str, Parameter]):
    """Parameters of one fit: an immutable mapping from names to `Parameter`, in the family's order."""

    def __init__(self, parameters: Mapping[str, Parameter]) -> None:
        self._by_name = dict(parameters)
        self._lmfit: Any = None

    def __getitem__(self, name: str) -> Parameter:
        return self._by_name[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._by_name)

    def __len__(self) -> int:
        return len(self._by_name)

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"_lmfit": None}

    def changed(self, **parameters: Mapping[str, Any]) -> "Parameters":
        """Return a copy with new attributes for the named parameters, as ``changed(ratio={"vary": False})``."""
        return Parameters(self._by_name | {name: replace(self[name], **new) for name, new in parameters.items()})

    def values_with(self, free_values: Values) -> dict[str, float]:
        """Return the values of all parameters by name: from `free_values` by name, else the present value.

        Expressions are evaluated, by lmfit except for the length `b`. Raises AtlasError for an expression that has
        no value.
        """
        values = {name: free_values.get(name, p.value) for name, p in self.items()}
        tied = [name for name, p in self.items() if p.expr]
        if tied == ["b"] and self["b"].expr == LENGTH:
            return values | {"b": hypot(*(values[name] for name in B))}
        return self._evaluated(values) if tied else values

    def _evaluated(self, values: Values) -> dict[str, float]:
        self._lmfit = self.to_lmfit() if self._lmfit is None else self._lmfit
        for name, p in self.items():
            if p.expr is None:
                self._lmfit[name].value = values[name]
        self._lmfit.update_constraints()
        return dict(self._lmfit.valuesdict())

    def to_lmfit(self) -> Any:
        """Return an `lmfit.Parameters` object with the same names, values, bounds, expressions and errors.

        Raises AtlasError for an expression that has no value.
        """
        import lmfit

        parameters = lmfit.Parameters()
        try:
            for name, p in sorted(self.items(), key=lambda item: item[1].expr is not None):
                parameters.add(name, None if p.expr else p.value, vary=p.vary, min=p.min, max=p.max, expr=p.expr)
            parameters.update_constraints()
        except (NameError, SyntaxError, TypeError, ValueError) as error:
            raise AtlasError(f"The expression of a parameter cannot be evaluated: {error}.") from error
        ordered = lmfit.Parameters()
        ordered.add_many(*(parameters[name] for name in self))
        for name, p in self.items():
            ordered[name].stderr, ordered[name].correl = p.stderr, p.correl
        return ordered


def parameters_of(model: Model, data: Data, params: Any, fix: Any = None) -> tuple[Parameters, dict[str, float]]:
    """Return (parameters of a family changed by `params` and `fix`, given start values by name of those that vary).

    `params` and `fix` are those of `atlas.fit`, or None; parameters that `data` do not determine are held at 0.
    Raises AtlasError for an unknown name or attribute, a name in both `params` and `fix`, a fixed parameter without
    a value, an attribute that is no number, and a fixed value outside its bounds.
    """
    user_attributes = _user_attributes(params) | _user_attributes(fix, is_fix=True)
    if twice := sorted({*(params or ())} & {*(fix or ())}):
        raise AtlasError(f"{twice[0]} is in both fix and params: give it in one of them.")
    hidden, parameters = unseen(model, data.kind), dict[str, Parameter]()
    for name in model.names:
        low, high = LIMITS.get(name, (-inf, inf))
        value = model.fixed.get(name, hidden.get(name, 1.0 if name in LIMITS else 0.0))
        parameters[name] = Parameter(value, name not in model.fixed and name not in hidden, low, high)
    start = dict[str, float]()
    for name, attributes in user_attributes.items():
        if name not in parameters and "expr" not in attributes:
            raise AtlasError(f"{model.name.capitalize()} motions have no {name!r}: there are {', '.join(model.names)}.")
        default = parameters.get(name, Parameter(0.0))
        low, high = max(attributes.get("min", -inf), default.min), min(attributes.get("max", inf), default.max)
        p = replace(default, **{"vary": True, **attributes, "min": low, "max": high})
        if not (p.vary or "value" in attributes or p.expr or name in model.fixed):
            raise AtlasError(f"{name} is fixed, but has no value: give one.")
        if p.expr is None and "value" in attributes:
            _check_value(name, p)
            if p.vary:
                start[name] = p.value
        parameters[name] = p
    if all(name in model.names for name in B):
        parameters.setdefault("b", Parameter(0.0, vary=False, expr=LENGTH))
    return Parameters(parameters), start


def _user_attributes(params: Any, *, is_fix: bool = False) -> dict[str, dict[str, Any]]:
    """Return the attributes (value, vary, min, max, expr) that a user gave in `params`, by name of the parameter.

    With `is_fix` each value is a number, at which the parameter is held. None gives {}. Raises AtlasError for no
    mapping, an unknown attribute, an attribute that is no number, and min above max.
    """
    if params is not None and not isinstance(params, Mapping):
        raise AtlasError(f"{'fix' if is_fix else 'params'} is a mapping of names to values, not {params!r}.")
    by_name = dict[str, dict[str, Any]]()
    for name, p in (params or {}).items():
        attributes = {"value": p, "vary": False} if is_fix else _attributes(name, p)
        for key in attributes.keys() & {"value", "min", "max"}:
            try:
                attributes[key] = float(attributes[key])
            except (OverflowError, TypeError, ValueError) as error:
                raise AtlasError(f"{name}: {key} must be a number, not {reprlib.repr(attributes[key])}.") from error
        low, high = attributes.get("min", -inf), attributes.get("max", inf)
        if not low <= high:
            raise AtlasError(f"{name}: min must not exceed max, but they are {low!r} and {high!r}.")
        by_name[name] = attributes
    return by_name


def _attributes(name: str, p: Any) -> dict[str, Any]:
    """Return the attributes, by the names of `KEYS`, of the parameter `name` given as a number, a mapping or lmfit's.

    Attributes that are None, and an lmfit value that was not given, are left out. Raises AtlasError for an unknown
    key of a mapping.
    """
    if isinstance(p, Mapping):
        if unknown := sorted({*p} - {*KEYS, "brute_step", "is_init_value"}):
            raise AtlasError(f"{name} has no attribute {unknown[0]!r}: there are {', '.join(KEYS)}.")
        return {key: p[key] for key in KEYS if p.get(key) is not None}
    if not hasattr(p, "vary"):
        return {"value": p}
    value = getattr(p, "init_value", None) if p.value in (p.min, p.max) else None
    attributes = {
        "value": p.value if value is None else value,
        "vary": p.vary,
        "min": p.min,
        "max": p.max,
        "expr": p.expr,
    }
    if p.expr is not None or attributes["value"] == -inf:
        del attributes["value"]  # none was given
    return {key: x for key, x in attributes.items() if x is not None}


def _check_value(name: str, p: Parameter) -> None:
    """Raise AtlasError for NaN, and for a fixed value that is infinite or outside its bounds.

    `name` is for the message.
    """
    low, high = p.min, p.max
    below = LIMITS.get(name, (-inf, inf))[0]
    if isnan(p.value) or not (p.vary or (isfinite(p.value) and below < p.value and low <= p.value <= high)):
        span = f"{'(' if low == below else '['}{low:g}, {high:g}{']' if isfinite(high) else ')'}"
        bounds = "" if low == -inf and high == inf else f" in {span} and"
        raise AtlasError(f"{name} must be{bounds} finite, not {p.value:g}.")
