"""Errors of the atlas for inputs that have no answer: one sentence with the fault, its place and the remedy."""

import warnings
from collections.abc import Iterable
from difflib import get_close_matches

MAX_LISTED_NAMES = 30
"""As many names as an error lists."""


class AtlasError(ValueError):
    """Base of the package's errors: an input has no answer, and the message says the fault, its place and the remedy.

    The command line prints the message and ends with status 2.
    """

    @property
    def sentences(self) -> tuple[str, ...]:
        """The message as a tuple with one element; the command line prints each element on its own line."""
        return (str(self),)


class FaultsError(AtlasError):
    """Several faults of one file or command, made from their sentences; repeated sentences are kept once."""

    def __init__(self, sentences: Iterable[str]) -> None:
        super().__init__("\n".join(dict.fromkeys(sentences)))

    @property
    def sentences(self) -> tuple[str, ...]:
        """The sentences in the order given, one for each fault, without repetitions."""
        return tuple(str(self).split("\n"))


class DomainError(AtlasError):
    """A physical argument lies outside the domain in which the formula holds."""


class NotCertifiedError(AtlasError):
    """No enclosure of a value by intervals was found; an uncertified value is not returned in its place."""


class AtlasWarning(UserWarning):
    """Base of the package's warnings: the result is computed, but the input may not be the intended one."""


class NearlySymmetricWarning(AtlasWarning):
    """Two moments of inertia are nearly equal.

    Moments of a tensor stay different; of points in a symmetric body, they are replaced by one moment.
    """


class NearestInputWarning(AtlasWarning):
    """The input is impossible by the rounding of its last digits; the nearest possible input is used instead."""


class RelativisticWarning(AtlasWarning):
    """A speed, in known units, exceeds a tenth of the speed of light, while the formulas are non-relativistic."""


def tell_nearest(fault: str, replacement: str) -> None:
    """Issue a NearestInputWarning with the text FAULT; used instead is REPLACEMENT.

    `fault` describes the input that is impossible by its last digits, `replacement` is the input used in its place.
    """
    warnings.warn(f"{fault}; used instead is {replacement}.", NearestInputWarning, stacklevel=5)


def nearest(word: str, words: Iterable[str]) -> str:
    """Return " (did you mean 'points'?)" with the one of `words` closest to `word`; "" if none is similar."""
    close = get_close_matches(word, list(words), 1)
    return f" (did you mean {close[0]!r}?)" if close else ""


def unknown(kind: str, name: object, valid_names: Iterable[str], context: str = "") -> AtlasError:
    """Return, without raising it, an error such as: there is no table 'point' (did you mean 'points'?); known: a, b.

    `kind` is a noun ("table"), `name` the unknown name, and `context` an optional phrase after the name such as
    "of the figure 'hyperbola'". Valid names are listed up to MAX_LISTED_NAMES of them.
    """
    names = list(valid_names)
    listed = f"; known: {', '.join(names) or 'none'}" if len(names) <= MAX_LISTED_NAMES else ""
    return AtlasError(
        f"there is no {kind} {name!r}{f' {context}' if context else ''}{nearest(str(name), names)}{listed}."
    )
