"""Reports in Markdown: each part becomes that of a report in TOML, and a mistake is told by its line."""

from pathlib import Path
from typing import Any

import pytest
from msgspec.structs import asdict

from atlas.book.blocks import kind_of
from atlas.book.compose import compose
from atlas.book.load import load
from atlas.book.pictures import pictures
from atlas.errors import AtlasError

MARKDOWN = """+++
name = "mine"
title = "A shell in a magnet"

[parameters.fields.magnet]
title = "field"
prime = [1.0, 2.0]
+++

All of it, in $x$.

# The shell

```{page}
part = "One"
```

The data lie on a quadric, @(51).

```python
# this is code
```

```{equation}
name = "(71)"
```

````{note}
+++
title = "Beware"
+++
```figure
is code in a note
```
````

# The second page

```{figure}
recipe = "colours"
id = "colours"
```
"""
TOML = '''
name = "mine"
title = "A shell in a magnet"
abstract = "All of it, in $x$."

[parameters.fields.magnet]
title = "field"
prime = [1.0, 2.0]

[[pages]]
slug = "index"
title = "The shell"
part = "One"

[[pages.blocks]]
kind = "prose"
text = """The data lie on a quadric, @(51).

```python
# this is code
```"""

[[pages.blocks]]
kind = "equation"
name = "(71)"

[[pages.blocks]]
kind = "note"
title = "Beware"
text = "```figure\\nis code in a note\\n```"

[[pages]]
slug = "the-second-page"
title = "The second page"

[[pages.blocks]]
kind = "figure"
recipe = "colours"
id = "colours"
'''


def report_file(folder: Path, text: str, suffix: str = "md") -> Path:
    """Write a report."""
    file = folder / f"mine.{suffix}"
    file.write_text(text, encoding="utf-8")
    return file


def test_markdown_and_toml_reports_read_the_same(tmp_path: Path) -> None:
    """Head, abstract, pages with their titles, texts with code, blocks with a head."""
    report_markdown, report_toml = (
        load(report_file(tmp_path, text, suffix)) for text, suffix in ((MARKDOWN, "md"), (TOML, "toml"))
    )
    assert {**asdict(report_markdown), "source": None} == {**asdict(report_toml), "source": None}
    assert [kind_of(block) for page in report_markdown.pages for block in page.blocks] == [
        "prose",
        "equation",
        "note",
        "figure",
    ]


MISTAKES: dict[str, tuple[str, str, int, str]] = {
    "a misspelt key of the head": (
        'title = "A shell',
        'titel = "A shell',
        3,
        "no key 'titel' here (did you mean 'title'",
    ),
    "a misspelt key of a block": ('recipe = "colours"', 'recpe = "colours"', 40, "'recpe' here (did you mean 'recipe'"),
    "a misspelt key of a page": ('part = "One"', 'prat = "One"', 15, "no key 'prat' here (did you mean 'part'"),
    "a misspelt kind": ("```{equation}", "```{equaton}", 24, "'equaton' (did you mean 'equation'"),
    "a value that is no TOML": ('name = "(71)"', "name = (71)", 25, "this is not TOML: Invalid value"),
    "a head of a block that is no TOML": ('title = "Beware"', "Beware", 30, "this is not TOML"),
    "a head that is no TOML": ("prime = [1.0, 2.0]", "prime = 1.0, 2.0", 7, "this is not TOML"),
    "a head that does not end": ("\n+++\n\nAll", "\n\nAll", 9, "this is not TOML"),
    "a head of a block that does not end": ('"Beware"\n+++', '"Beware"', 28, "close it with a line +++"),
    "no head": ("+++\nname", "name", 1, "begins with its head"),
    "a block that does not end": ('id = "colours"\n```\n', 'id = "colours"\n', 39, "close it with a line ```"),
    "code that does not end": ("# this is code\n```\n", "# this is code\n", 20, "```python does not end"),
    "a block above the first page": ("# The shell\n", "", 13, "put a line '# Title' above it"),
    "a page that is told twice": ("```{equation}\nname", "```{page}\nslug", 24, "once, directly below the heading"),
    "an abstract that is told twice": ("title = ", 'abstract = "A"\ntitle = ', 11, "the head has too"),
    "pages in the head": ('title = "A', 'pages = []\ntitle = "A', 1, "the head holds no pages"),
    "a kind in a block": ('name = "(71)"', 'name = "(71)"\nkind = "note"', 24, "takes no key 'kind'"),
    "two pages of one slug": (
        "# The second page\n",
        '# T\n```{page}\nslug = "index"\n```\n',
        39,
        "slug 'index': two pages have it",
    ),
    "a field that is not there": ('id = "colours"', 'field = "magnt"', 41, "no field 'magnt' in [parameters] (did you"),
    "lines that only a reader sets": ('title = "A shell', 'source = {}\ntitle = "A shell', 3, "no key 'source' here"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_reported_with_its_line(mistake: str, tmp_path: Path) -> None:
    """In one sentence: file, line of the file from its first on, fault, remedy."""
    text, text_wrong, line, message = MISTAKES[mistake]
    assert MARKDOWN.count(text) == 1 or text == "title = "
    file = report_file(tmp_path, MARKDOWN.replace(text, text_wrong, 1))
    with pytest.raises(AtlasError) as caught:
        load(file)
    sentence = str(caught.value)
    assert sentence.startswith(f"{file}, line {line}: ")
    assert message in sentence
    assert "\n" not in sentence


@pytest.mark.parametrize(
    ("text", "text_wrong", "line", "message"),
    [
        ('"colours"\nid', '"colour"\nid', 39, "page 'the-second-page', block 1 (figure): there is no recipe 'colour'"),
        ("@(51)", "@(511)", 18, "page 'index', block 1 (prose): there is no equation"),
    ],
)
def test_a_mistake_found_in_typesetting_is_reported_with_its_block(
    text: str, text_wrong: str, line: int, message: str, tmp_path: Path
) -> None:
    """A recipe that there is not, a citation that leads nowhere."""
    report = load(report_file(tmp_path, MARKDOWN.replace(text, text_wrong)))
    with pytest.raises(AtlasError) as caught:
        compose(report, pictures(report)).set("html")
    assert str(caught.value).startswith(f"mine.md, line {line}: {message}")


SIGNS = (
    "::: note",
    "+++",
    "---",
    "<!-- x -->",
    "\\# no page",
    "#no page",
    "#",
    "{figure}",
    "``{figure}``",
    "    # code",
    "~~~",
)


@pytest.mark.parametrize("line", SIGNS)
def test_lines_of_text_are_kept_letter_by_letter(line: str, tmp_path: Path) -> None:
    """Lines that are neither heading nor fence reach the text letter by letter, separators of lines of Unicode too."""
    block: Any = (
        load(report_file(tmp_path, MARKDOWN.replace("The data", f"A\u2028B\n\n{line}\n\nThe data"))).pages[0].blocks[0]
    )
    assert block.text.startswith(f"A\u2028B\n\n{line}\n\nThe data")
