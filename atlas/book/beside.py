"""Outlines of the reports related to a report: a build depends on them by the answers that it got alone."""

from collections.abc import Iterable, Mapping
from typing import Any, TypeAlias

Outline: TypeAlias = Mapping[str, Mapping[str, Any]]
"""Answers of one report by kind and name, as JSON has them; see `atlas.book.document.Document.outline`."""


class RelatedReports:
    """Outlines of the related reports of a report, and in `answers` each question put to them, with its answer.

    A question is "kind name" with the kind "link", "entry" or "uses", its answer a list, see `ask`. An outline is a
    mapping of answers by kind and name, see `atlas.book.document.Document.outline`.
    """

    def __init__(self, outlines: Iterable[Outline] = ()) -> None:
        self.outlines, self.answers = [*outlines], dict[str, list[Any]]()

    def ask(self, kind: str, name: str) -> list[Any]:
        """Return the answers to a question, a list with one for each related report that has one, in order.

        The list is [] where none has one; it is also stored in `answers`.
        """
        answer = self.answers[f"{kind} {name}"] = [
            outline[kind][name] for outline in self.outlines if name in outline[kind]
        ]
        return answer

    def agrees(self, answers: Mapping[str, list[Any]]) -> bool:
        """Return whether the questions of an earlier build, the keys of its `answers`, have the same answers now."""
        return all(self.ask(*question.split(" ", 1)) == answer for question, answer in answers.items())
