"""Attributes that are made when they are first asked for, by any thread."""

import functools
from collections.abc import Callable
from typing import Any, Self, TypeVar, overload

Value = TypeVar("Value")


class cached_property(functools.cached_property[Value]):  # noqa: N801, TID251  used as the one of the library
    """A property that is computed once and kept in the instance, with no lock and for all threads.

    Threads that ask at the same time may compute the value at the same time; all of them get the one that was stored
    first. The lock of Python 3.11's property, one for all instances of a class, waits for ever where a thread that
    holds it waits for `workprec`, and a thread in `workprec` waits for it.

    A method of a subclass may use the value of the parent, `super().name`: that is not stored, since it would stand
    where the subclass's value belongs.

    A subclass of this property may set `finish`, a function from the computed value to the one that is stored.
    """

    finish: Callable[[Any], Any] | None = None

    @overload
    def __get__(self, instance: None, owner: type[Any] | None = None) -> Self: ...
    @overload
    def __get__(self, instance: object, owner: type[Any] | None = None) -> Value: ...
    def __get__(self, instance: object | None, owner: type[Any] | None = None) -> Any:
        """Return the stored value, computed and stored first if there is none; on a class the property itself."""
        if instance is None:
            return self
        name = str(self.attrname)
        values = vars(instance)
        is_stored = getattr(type(instance), name) is self
        if is_stored and name in values:
            return values[name]
        value = self.func(instance)
        if self.finish:
            value = self.finish(value)
        return values.setdefault(name, value) if is_stored else value
