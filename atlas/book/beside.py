"""The reports beside a report, in outline: a build depends on the answers that it got from them alone."""

from collections.abc import Iterable, Mapping
from typing import Any, TypeAlias

Outline: TypeAlias = Mapping[str, Mapping[str, Any]]
"""Answers of one report by kind and name, as JSON has them; see `atlas.book.document.Document.outline`."""


class Beside:
    """Outlines of the reports beside one; `answers` holds each question asked so far, "kind name", with its answer."""

    def __init__(self, outlines: Iterable[Outline] = ()) -> None:
        self.outlines, self.answers = [*outlines], dict[str, list[Any]]()

    def ask(self, kind: str, name: str) -> list[Any]:
        """Return the answers of the reports that have one, in their order."""
        answer = self.answers[f"{kind} {name}"] = [one[kind][name] for one in self.outlines if name in one[kind]]
        return answer

    def agrees(self, answers: Mapping[str, list[Any]]) -> bool:
        """Return whether the questions of an earlier build have the same answers now."""
        return all(self.ask(*question.split(" ", 1)) == answer for question, answer in answers.items())
