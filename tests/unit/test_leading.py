"""Paragraphs that lead in to what comes next stand on its page in a PDF."""

import pytest

from atlas.report.texts import Texts

INDENTED, FLUSH = "#leading(true)[", "#leading(false)["


@pytest.mark.parametrize(
    ("markdown", "begins"),
    [
        ("A line:\n\n    code", FLUSH),
        ("One.\n\nTwo\nlines:\n\n    code", INDENTED),
        ("```\ncode\n```\n\nAgain:", FLUSH),
        ("One.\n\nTwo.", ""),
        ("A: b `c:`", ""),
        ("- a list:", ""),
    ],
)
def test_a_paragraph_that_ends_with_a_colon_is_kept_with_the_next(markdown: str, begins: str) -> None:
    """Indented where a paragraph stands before it, in a PDF only; its words are the same."""
    texts = Texts()
    texts.add(markdown, "here")
    typst, html = (
        texts.set(target, lambda _name, _place: pytest.fail("nothing is cited"))[0] for target in ("typst", "html")
    )
    assert [begin for begin in (INDENTED, FLUSH) if begin in typst] == [begins] * bool(begins)
    assert "leading" not in html
