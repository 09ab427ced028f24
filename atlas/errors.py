"""What the atlas raises when an input has no answer: one sentence that says what, where, and what would be right."""


class AtlasError(ValueError):
    """An input for which there is no answer; the command line prints the sentence and ends with status 2."""


class DomainError(AtlasError):
    """A physical argument outside the domain of the formula."""
