"""A report definition of a stranger: its texts are text, and it reads and writes nothing outside its folders."""

import re
from pathlib import Path
from random import Random
from typing import Annotated, Any, Literal

import msgspec
import pytest
from lxml import html as reader
from pypdf import PdfReader

from atlas.book import fonts, html, pdf, typesetting
from atlas.book.compose import compose
from atlas.book.definition import Report
from atlas.book.document import Document
from atlas.book.load import load
from atlas.book.schema import Id, Slug, convert
from atlas.book.texts import Link, Texts, citations
from atlas.errors import AtlasError
from atlas.places import folder

MARKUP = (
    "<script>alert(1)</script>",
    '<img src=x onerror="alert(1)">',
    '#panic("ran")',
    '#import "other.typ": all',
    "`#panic()`{=typst}",
    "`<b>`{=html}",
    "[word]{onclick=alert(1)}",
    "// hidden /* too */",
    "a line that ends in \\",
    "{{ 7 * 7 }} <% x %> <$ y $>",
    "= heading <label> @@ ~ _x",
    r"\input{/etc/passwd} \href{javascript:alert(1)}{x}",
)
SCRIPTS = [{"src": "minisearch.js", "defer": "defer"}, {"src": "page.js", "defer": "defer"}]
"""The two that a page asks for, in this order: the library of its search box and its own."""
BLOCKS = (
    "---",
    "---\ntitle: other\n---",
    "```{=typst}\n#panic()\n```",
    "```{=html}\n<script>alert(1)</script>\n```",
    "::: {onclick=alert(1)}\nx\n:::",
    "> quoted\n\n1. one\n2. two\n\n- a\n    - b\n\n| a | b |\n|---|---|\n| 1 | 2 |\n",
    "# First\n\n## Second\n\n~~old~~ x^2^ H~2~O **bold**\n\n```\nverbatim #x $y$ \\\n```",
    "a\\",
)
FONTS = [*map(fonts.source, fonts.FACES.values())]
TOKENS = (
    *"# * _ ` ``` @ // /* */ --- -- ~ \\ [ ] ( ) { } {=typst} = + | ^ < > & ; : ' \" % %> <% {{".split(),
    *(
        "#panic()",
        "<b>",
        "@(67)",
        " $x$ ",
        r" $\text{#panic() b}$ ",
        "[a](b.html)",
        "<lab>",
        "- ",
        "1. ",
        "[^1]",
        " ",
        "\n\n",
    ),
)


def definition(text: str, block: str = "") -> Report:
    """Return a report with a text in every place that takes one."""
    tables = {"title": text, "ratio": 1.5}, {"title": text, "prime": [1.0, 2.0]}
    blocks = [
        {"kind": "prose", "text": block or text},
        {"kind": "note", "title": text, "text": block or text},
        {"kind": "listing", "id": "words", "columns": [text, "b"], "rows": [["a", text]], "caption": text},
        {"kind": "table", "table": "points", "body": "b", "field": "f", "caption": text},
        {"kind": "equation", "name": "own", "tex": r"a+b"},
    ]
    page = {"slug": "index", "title": text, "part": text, "blocks": blocks}
    report = {"name": "mine", "title": text, "subtitle": text, "authors": [text], "abstract": block or text}
    return convert(
        {**report, "pages": [page], "parameters": {"bodies": {"b": tables[0]}, "fields": {"f": tables[1]}}}, Report
    )


def document(report: Report) -> Document:
    """Compose a report and set its texts."""
    document_made = compose(report, {})
    document_made.set("html", "typst")
    return document_made


def visible(document: Document, folder: Path) -> tuple[reader.HtmlElement, str]:
    """Return the first page, parsed, and the words of the PDF."""
    page = reader.fromstring(html.pages(document)["index.html"])
    (folder / "mine.pdf").write_bytes(typesetting.compiled(pdf.source(document), folder, FONTS))
    return page, " ".join(page_pdf.extract_text() for page_pdf in PdfReader(folder / "mine.pdf").pages)


def inert(page: reader.HtmlElement) -> bool:
    """Tell whether nothing in a page runs but its own two scripts, and nothing is fetched or listens."""
    scripts = [dict(script.attrib) for script in page.iter("script")]
    tags = {element.tag for element in page.iter() if isinstance(element.tag, str)}
    attributes = {name for element in page.iter() for name in element.attrib}
    return (
        scripts in ([], SCRIPTS)
        and not page.xpath("//script/text()")
        and not tags & {"iframe", "object", "embed", "form", "base", "img", "svg"}
        and not any(name.startswith("on") for name in attributes)
        and not any(link.startswith(("javascript:", "data:", "//")) for link in page.xpath("//@href"))
    )


@pytest.mark.parametrize(
    "text", [pytest.param(text, marks=[pytest.mark.slow] * (k % 2)) for k, text in enumerate(MARKUP)]
)
def test_markup_in_a_text_is_shown_and_not_obeyed(text: str, tmp_path: Path) -> None:
    """Wherever a file takes a text, HTML, Typst, raw blocks, attributes and templates in it are only letters."""
    page, printed = visible(document(definition(text)), tmp_path)
    assert inert(page)
    (title,) = page.xpath("//header//p[@class='h']")
    assert " ".join(title.text_content().split()) == " ".join(text.split())
    words = re.findall(r"[a-z]{3,}", text)
    assert all(word in page.xpath("string(//main)") for word in words if word not in {"html", "typst"})
    assert all(word in printed for word in words if word not in {"html", "typst"})


def test_a_formula_in_a_title_is_set_and_stands_elsewhere_in_plain_words(tmp_path: Path) -> None:
    """The rest of a title is letters; bookmarks and names of pages have no markup."""
    report = definition(r"The *rate* $\nu^2$ & a~b for $5")
    page, printed = visible(document(report), tmp_path)
    assert [node.text_content() for node in page.xpath("//h1/math | //p[@class='h']/math")] == ["ν2", "ν2"]
    assert page.xpath("string(//title)") == "The *rate* ν^2 & a~b for $5"
    assert "The *rate* 𝜈2 & a~b for $5" in printed


@pytest.mark.parametrize(
    "block", [pytest.param(block, marks=[pytest.mark.slow] * (k % 2)) for k, block in enumerate(BLOCKS)]
)
def test_blocks_of_markdown_are_set_in_page_and_pdf(block: str, tmp_path: Path) -> None:
    """A rule, lists, tables and headings are set; raw blocks, attributes and metadata are text."""
    page, _ = visible(document(definition("x", block)), tmp_path)
    assert inert(page)
    assert len(page.xpath("//h1")) == 1


def test_a_message_shows_forty_characters_of_a_wrong_value() -> None:
    """A longer one is cut, with a mark."""
    for count, quotation in ((38, f"'{'a' * 38}'"), (39, f"'{'a' * 39}…")):
        with pytest.raises(AtlasError) as caught:
            convert("a" * count, float)
        assert str(caught.value) == f"at the top: must be a number, not {quotation}"


def test_random_signs_never_break_the_pdf_or_leave_a_tag(tmp_path: Path) -> None:
    """Seeded strings of the signs that mean something to Markdown, HTML, TeX or Typst stand in page and PDF."""
    random, texts = Random(13), Texts()  # noqa: S311  no secret
    for number in range(200):
        texts.add("".join(random.choices(TOKENS, k=random.randint(1, 12))), "here", inline=number % 2 == 0)
    pieces, printed = texts.set(dict.fromkeys(("html", "typst"), lambda name, _: Link(name))).values()
    assert inert(reader.fromstring("<div>" + "".join(pieces) + "</div>"))
    rule = "#let horizontalrule = line(length: 40%)\n#let leading(indented, body) = body\n"
    blocks = "".join(f"#block([{block}])\n\n" for block in printed)
    typesetting.compiled(rule + blocks, tmp_path, FONTS)


@pytest.mark.parametrize("link", ["https://a.b/c?d=e#f", "http://a.b", "mailto:a@b.c", "index.html#eq-own", "#eq-own"])
def test_links_that_are_allowed_are_kept(link: str) -> None:
    """Links lead to http, https, mailto and pages of the report."""
    document_made = document(definition(f"[word]({link})"))
    assert f'href="{link}"' in html.pages(document_made)["index.html"]


def test_a_doi_becomes_an_address() -> None:
    """``doi:`` leads to doi.org."""
    texts = Texts()
    texts.add("[paper](doi:10.3390/universe10060250)", "here", inline=True)
    (text,) = texts.set({"html": lambda name, _: Link(name)})["html"]
    assert 'href="https://doi.org/10.3390/universe10060250"' in text


@pytest.mark.parametrize(
    "link",
    [
        *("javascript:alert(1)", "JaVaScRiPt:alert(1)", "java&#115;cript:alert(1)", "data:text/html,x", "vbscript:x"),
        *("file:///etc/passwd", "//evil.example/x", "/etc/passwd", "../secret.html", "x.html#a>)[b]", "blob:x"),
    ],
)
def test_other_links_are_refused_with_their_place(link: str) -> None:
    """Any other scheme, and paths out of the report, are errors that name the block."""
    with pytest.raises(AtlasError, match=r"(?s)(abstract|page 'index').*not allowed"):
        document(definition("x", f"[word]({link})"))


def test_pictures_in_a_text_are_refused() -> None:
    """A text can't read a file into the report."""
    with pytest.raises(AtlasError, match="the abstract: a text holds no pictures"):
        document(definition("x", "![](/etc/passwd)"))


@pytest.mark.parametrize("name", ["a b", "a>#panic()<", "../x", "a/b", 'x"y', "", "-a", "a\n", "ä"])
def test_names_that_become_anchors_and_files_are_letters_digits_and_hyphens(name: str) -> None:
    """The id of a figure or table, the name of an equation and the slug of a page are refused otherwise."""
    for block in (
        {"kind": "figure", "recipe": "hyperbola", "id": name},
        {"kind": "table", "table": "points", "id": name},
        {"kind": "listing", "columns": [], "rows": [], "caption": "", "id": name},
        {"kind": "equation", "name": name, "tex": "x"},
    ):
        page = {"slug": "index", "title": "", "blocks": [block]}
        with pytest.raises(AtlasError, match=r"block.* 1 \(\w+\), (id|name): must be a text of letters and digits"):
            convert({"name": "mine", "title": "", "pages": [page]}, Report)
    with pytest.raises(AtlasError, match="slug: must be a text of small letters and digits"):
        convert({"name": "mine", "title": "", "pages": [{"slug": name, "title": "", "blocks": []}]}, Report)


def test_the_scripts_of_a_page_agree_with_its_templates() -> None:
    """Files that the pages ask for lie beside them, as in the templates whatever the report says."""
    files = html.pages(document(definition(MARKUP[0])))
    for script in SCRIPTS:
        assert files[script["src"]] == (folder("templates") / "html" / script["src"]).read_text(encoding="utf-8")


def test_every_page_has_a_policy_that_forbids_scripts() -> None:
    """Each page forbids frames, forms, scripts written in it, and all that is not in its folder."""
    for name, content in html.pages(document(definition("x"))).items():
        if name.endswith(".html"):
            (policy,) = reader.fromstring(content).xpath("//meta[@http-equiv='Content-Security-Policy']/@content")
            assert "default-src 'none'" in policy
            assert "base-uri 'none'" in policy
            assert re.findall(r"script-src ([^;]*)", policy) == ["'self'"]
            assert not re.search(r"\bhttps?:|\*", policy)


KINDS = [
    float,
    int,
    bool,
    str,
    Annotated[float, msgspec.Meta(gt=0.0)],
    Annotated[int, msgspec.Meta(ge=1, le=7)],
    Literal["one", "two"],
    tuple[float, ...],
    tuple[float, float],
    dict[str, int],
    float | None,
]
VALUES = [0, 1, 7, 8, -1, 2.5, -0.5, 0.0, 1e308, True, False, "", "1", "one", "three", [], [1.0], [1, 2.5], [True, 1.0],
          ["x", 1.0], [1.0, 2.0, 3.0], {}, {"a": 1}, {"a": "b"}, {"a": True}]  # fmt: skip


@pytest.mark.parametrize("kind", KINDS, ids=str)
def test_values_of_a_key_agree_with_the_library(kind: Any) -> None:
    """Values of all types against a type: one that is told off is no value for msgspec, and the other way round."""
    for value in VALUES:
        try:
            msgspec.convert(value, kind)
            is_valid = True
        except msgspec.ValidationError:
            is_valid = False
        if is_valid:
            convert(value, kind)
            continue
        with pytest.raises(AtlasError):
            convert(value, kind)


@pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf")])
def test_a_number_is_finite(value: float) -> None:
    """Keys that TOML can write, but no block has."""
    with pytest.raises(AtlasError, match=r"finite|number"):
        convert(value, float)


@pytest.mark.parametrize("kind", [Id, Slug])
def test_a_name_has_letters_digits_and_hyphens_between_them(kind: Any) -> None:
    """And nothing before or after; that of a page no capitals."""
    for value in ("a", "a-b", "a1-2b", "tab-points"):
        assert convert(value, kind) == value
    for value in ("", "-a", "a-", "a--b", "a b", "a/b", "a\n", "../a", "ä", "a_b"):
        with pytest.raises(AtlasError):
            convert(value, kind)
    if kind is Slug:
        with pytest.raises(AtlasError):
            convert("Points", kind)
    else:
        assert convert("Points", kind) == "Points"


def test_a_recipe_is_a_name_or_a_file_beside_the_report(tmp_path: Path) -> None:
    """A figure can't run a file from elsewhere."""
    from atlas.book.load import load
    from atlas.book.pictures import pictures

    for recipe in ("../evil", "/tmp/evil", "evil"):  # noqa: S108  a name that is refused
        page = {"slug": "index", "title": "", "blocks": [{"kind": "figure", "recipe": recipe}]}
        with pytest.raises(AtlasError, match="there is no recipe"):
            pictures(convert({"name": "mine", "title": "", "pages": [page]}, Report))
    (tmp_path / "evil.py").write_text("", encoding="utf-8")
    file = tmp_path / "paper" / "mine.toml"
    file.parent.mkdir()
    for recipe in ("../evil.py", str(tmp_path / "evil.py"), "evil.py"):
        block = f"[[pages]]\nslug = 'index'\ntitle = ''\n[[pages.blocks]]\nkind = 'figure'\nrecipe = '{recipe}'\n"
        file.write_text(f"name = 'mine'\ntitle = ''\n{block}", encoding="utf-8")
        with pytest.raises(AtlasError, match="is no file beside the report"):
            load(file)


def test_sets_of_parameters_stand_in_each_block_that_names_them(tmp_path: Path) -> None:
    """A later set holds before an earlier one, the block's own parameter before both; an unknown set is named."""
    from atlas.book.load import load

    file = tmp_path / "mine.toml"
    sets = "[parameters.sets]\nbody = { ratio = 0.5, azimuth = 1.0 }\nview = { azimuth = 2.0, elevation = 3.0 }\n"
    block = "[[pages]]\nslug = 'index'\ntitle = ''\n[[pages.blocks]]\nkind = 'figure'\nrecipe = 'quadric'\n"
    block_text = "sets = ['body', 'view']\nparameters = { elevation = 4.0 }\n"
    file.write_text(f"name = 'mine'\ntitle = ''\n{sets}{block}{block_text}", encoding="utf-8")
    assert load(file).pages[0].blocks[0].parameters == {"ratio": 0.5, "azimuth": 2.0, "elevation": 4.0}
    file.write_text(f"name = 'mine'\ntitle = ''\n{sets}{block}sets = ['bodi']\n", encoding="utf-8")
    with pytest.raises(AtlasError, match=r"block 1: there is no set 'bodi' in \[parameters\] \(did you mean 'body'"):
        load(file)


WRONG = {
    "times = 3.0": "parameters, times: must be a list, each item a number, not 3.0",
    'times = ["x"]': "parameters, time 1: must be a number, not 'x'",
    "times = [true]": "parameters, time 1: must be a number, not True",
    "times = [nan]": "parameters 'times': must be finite, not nan",
    "times = [0.0], omega_2 = 1.0": "'omega2'",
    "": "it lacks the key 'omega2', a number",
}


@pytest.mark.parametrize("line", WRONG)
def test_a_parameter_of_another_type_is_reported_with_its_key(line: str, tmp_path: Path) -> None:
    """One line names the block, the key and the remedy."""
    file = tmp_path / "mine.toml"
    lines = f"omega2 = 0.5, {line}" if line and "omega_2" not in line else line
    file.write_text(
        'name = "mine"\ntitle = "T"\n[parameters.bodies.b]\ntitle = "b"\nratio = 1.5\n'
        '[parameters.fields.f]\ntitle = "f"\nprime = [1.0, 2.0]\n'
        '[[pages]]\nslug = "index"\ntitle = "T"\n[[pages.blocks]]\nkind = "table"\ntable = "samples"\n'
        f'body = "b"\nfield = "f"\nparameters = {{ {lines} }}\n',
        encoding="utf-8",
    )
    with pytest.raises(AtlasError) as caught:
        compose(load(file), {})
    assert WRONG[line] in str(caught.value)
    assert "block 1 (table)" in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("ratio = nan", "ratio: must be a number, not nan"),
        ('ratio = "1.5"', "ratio: must be a number, not '1.5'"),
        ("inertia = [1.0]", "inertia: must be a list of 2 numbers, not [1.0]"),
        ("inertia = [1.0, inf]", "inertia 2: must be a number, not inf"),
        ("shape = ['ring']", "shape: must be a text, not ['ring']"),
    ],
)
def test_a_body_of_another_type_is_reported_with_its_key(line: str, words: str, tmp_path: Path) -> None:
    """The sentence names file, line where it can, body, key and remedy."""
    file = tmp_path / "mine.toml"
    file.write_text(
        '\ufeffname = "mine"\ntitle = "T"\npages = [{slug = "index", title = "", blocks = []}]\n'
        f'[parameters.bodies.b]\ntitle = "b"\n{line}\n',
        encoding="utf-8",
    )
    with pytest.raises(AtlasError) as caught:
        load(file)
    assert f"bodies 'b', {words}" in str(caught.value)
    assert str(caught.value).startswith(f"{file}, line 6: ")


def test_citations_are_found_as_pandoc_finds_them() -> None:
    """Counted uses and links are the same names."""
    text = "See @(50), (@theorem-points); `@(89)`, $x@y$ and a@b.c, @fig:curve and [@tab:points; see @(90), p. 3]."
    texts, citations_found = Texts(), []
    texts.add(text, "here", inline=True)
    texts.set({"html": lambda name, _: citations_found.append(name) or Link(name)})
    assert citations_found == citations(text) == ["(50)", "theorem-points", "fig:curve", "tab:points", "(90)"]


@pytest.mark.parametrize(
    "line",
    [
        *("style = 'http://127.0.0.1:9/a.mplstyle'", "style = 'file:///etc/passwd'", "style = '../secret.mplstyle'"),
        *("style = 'ggplot,../secret.mplstyle'", "style = 'link.mplstyle'", "style = 'here'", "style = '/etc/passwd'"),
        *("bibliography = '../secret.bib'", "bibliography = 'link.bib'", "bibliography = '/etc/passwd'"),
        *("bibliography = 'http://127.0.0.1:9/a.bib'", "bibliography = 'folder/../../secret.bib'"),
    ],
)
def test_a_report_reads_no_file_but_those_beside_it(line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No address, no path and no link out of its folder, no file of the folder in which it is built."""
    mailed, built = tmp_path / "mailed", tmp_path / "built"
    for folder_of_it in (mailed / "folder", built):
        folder_of_it.mkdir(parents=True)
    for ending, text in (("bib", "@misc{a, title = {T}}"), ("mplstyle", "lines.linewidth: 7")):
        for file in (tmp_path / f"secret.{ending}", mailed / "folder" / f"own.{ending}"):
            file.write_text(text)
        (mailed / f"link.{ending}").symlink_to(tmp_path / f"secret.{ending}")
    (built / "here").write_text("lines.linewidth: 7")
    monkeypatch.chdir(built)
    report, page = (
        mailed / "mine.toml",
        "[[pages]]\nslug = 'index'\ntitle = 'I'\n[[pages.blocks]]\nkind = 'prose'\ntext = 'x'\n",
    )
    head = "name = 'mine'\ntitle = 'M'\n"
    report.write_text(f"{head}{line}\n{page}")
    with pytest.raises(AtlasError, match=r"mine\.toml, line 3: .* is no file in .*/mailed, where the report is"):
        load(report)
    (mailed / "tex.mplstyle").write_text("lines.linewidth: 7\n text.latex.preamble : \\input{/etc/passwd}\n")
    report.write_text(f"{head}style = 'tex.mplstyle'\n{page}")
    with pytest.raises(AtlasError, match=r"mine\.toml, line 3: .* sets text\.latex\.preamble: of LaTeX"):
        load(report)
    key = line.partition(" ")[0]
    ending = {"style": "mplstyle", "bibliography": "bib"}[key]
    report.write_text(f"{head}{key} = 'folder/own.{ending}'\n{page}")
    assert load(report).bibliography or load(report).style == str(mailed / "folder" / "own.mplstyle")
