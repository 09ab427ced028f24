"""Errors of the atlas for inputs that have no answer: one sentence with the fault, its place and the remedy."""

import warnings
from collections.abc import Iterable
from difflib import get_close_matches

MAX_LISTED_NAMES = 30
"""As many names as an error lists."""


class AtlasError(ValueError):
    """An input for which there is no answer; the command line prints the sentence and ends with status 2."""

    @property
    def sentences(self) -> tuple[str, ...]:
        """Sentences of the message, one a line of the command line."""
        return (str(self),)


class FaultsError(AtlasError):
    """Several faults of one file or command, a sentence each."""

    def __init__(self, sentences: Iterable[str]) -> None:
        super().__init__("\n".join(dict.fromkeys(sentences)))

    @property
    def sentences(self) -> tuple[str, ...]:
        """Sentences of the message, one for each fault."""
        return tuple(str(self).split("\n"))


class DomainError(AtlasError):
    """A physical argument outside the domain of the formula."""


class NotCertifiedError(AtlasError):
    """A value for which no enclosure was found; nothing is guessed in its place."""


class AtlasWarning(UserWarning):
    """Warning: the result is computed, but the input may not be the intended one."""


class NearlySymmetricWarning(AtlasWarning):
    """Two moments that differ by little: of a tensor they stay two, of points in a symmetric body they are joined."""


class NearestInputWarning(AtlasWarning):
    """An input that is impossible by the rounding of its digits: the nearest possible one is taken."""


class RelativisticWarning(AtlasWarning):
    """A speed above a tenth of that of light, in known units, where formulas are non-relativistic."""


def tell_nearest(fault: str, taken: str) -> None:
    """Warn of an input that is impossible by its last digits, and name what is taken in its place."""
    warnings.warn(f"{fault}; used instead is {taken}.", NearestInputWarning, stacklevel=5)


def nearest(word: str, known: Iterable[str]) -> str:
    """Return " (did you mean 'points'?)" with the known word nearest to `word`; "" if none is near."""
    close = get_close_matches(word, list(known), 1)
    return f" (did you mean {close[0]!r}?)" if close else ""


def unknown(what: str, name: object, known: Iterable[str], where: str = "") -> AtlasError:
    """Return the error for an unknown name: there is no table 'point' (did you mean 'points'?); known: ....

    `what` is the kind of the name, `known` are the names that there are, `where` says of what, such as "of the figure
    'hyperbola'". All known names are listed if they are few.
    """
    names = list(known)
    listed = f"; known: {', '.join(names) or 'none'}" if len(names) <= MAX_LISTED_NAMES else ""
    return AtlasError(f"there is no {what} {name!r}{f' {where}' if where else ''}{nearest(str(name), names)}{listed}.")
