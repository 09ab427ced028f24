"""The guide: its commands can be typed, and print the text below them."""

import doctest
import inspect
import re
import shlex
import shutil
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

import atlas
from atlas.book.blocks.reference import markdown, markdown_of_sections
from atlas.book.building.records import described
from atlas.book.files import find
from atlas.book.load import load
from atlas.book.texts import Link, Text, Texts
from atlas.cli import main
from atlas.places import folder

FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
BLOCK = re.compile(r"^(`{3,})(\w+)\n(.*?)^\1$", re.MULTILINE | re.DOTALL)


def blocks() -> list[tuple[str, str, str]]:
    """Return the page, the language and the text of each block of code, in their order."""
    pages = load(find("guide")).pages
    texts = [(page.slug, block.text) for page in pages for block in page.blocks if hasattr(block, "text")]
    return [(slug, *block) for slug, text in texts for _, *block in BLOCK.findall(text)]


@pytest.fixture
def _print_options() -> Iterator[None]:
    """Set NumPy's print options back, when the guide has set its own."""
    with np.printoptions():
        yield


@pytest.mark.slow
@pytest.mark.usefixtures("_print_options")
def test_every_block_of_the_guide_prints_its_output(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Files are written, sessions of Python and of the shell are gone through in one folder and in one process."""
    shutil.copytree(folder("reports") / "data", tmp_path / "reports" / "data")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "100")
    names, failures = {"__name__": "guide"}, []
    for page, language, text in blocks():
        if text.startswith("# "):
            place = text.split()[1]
            (tmp_path / place).write_text(text.partition("\n")[2], "utf-8")
        elif language == "python":
            test = doctest.DocTestParser().get_doctest(text, names, page, None, None)
            runner = doctest.DocTestRunner(optionflags=FLAGS, verbose=False)
            runner.run(test, out=failures.append, clear_globs=False)
            names = test.globs
        else:
            assert language == "console"
            failures += [failure for command, output in sessions(text) if (failure := shell(command, output, capsys))]
    assert not failures, "".join(failures)


def sessions(text: str) -> list[tuple[str, str]]:
    """Return the command lines of a block, each with its output."""
    return re.findall(r"^\$ atlas (.*)\n((?:(?!\$ ).*\n)*)", text, re.MULTILINE)


def shell(command: str, output: str, capsys: pytest.CaptureFixture[str]) -> str:
    """Run a command line in this process; return the difference of its output, or nothing."""
    capsys.readouterr()
    with pytest.raises(SystemExit) as ended:
        main(shlex.split(command))
    out, err = capsys.readouterr()
    if doctest.OutputChecker().check_output(output, out + err, FLAGS) and ended.value.code in {0, 2}:
        return ""
    return f"$ atlas {command}\nexpected:\n{output}\ngot ({ended.value.code}):\n{out}{err}\n"


def test_the_reference_holds_every_public_name() -> None:
    """Each public name of the package stands in the reference, with its arguments, its docstring and its members."""
    pages = load(find("guide")).pages
    listed = [name for page in pages for block in page.blocks for name in getattr(block, "names", ())]
    assert sorted(listed) == sorted(set(atlas.__all__) - {"__version__"})
    entries = described()
    assert entries["Quadric"].arguments == "(ratio, field)"
    assert entries["Quadric"].docstring.startswith("Quadric of initial data")
    assert entries["ElementaryMotion"].members["rotation"].arguments == "(t, out=None)"  # inherited
    assert entries["ElementaryMotion"].members["k"].arguments == ""  # a value
    assert entries["SymmetricBody"].members["ring"].arguments == "(mass, radius)"
    assert entries["AtlasError"].arguments == ""
    assert all(entry.docstring for name in entries.values() for entry in (name, *name.members.values()))


def test_docstrings_have_lists_and_no_ruled_tables() -> None:
    """A page of the reference would show the rules of a table of reStructuredText as a line of signs."""
    ruled = [
        f"{name}.{inner}"
        for name, entry in described().items()
        for inner, member in {"": entry, **entry.members}.items()
        if re.search(r"^\s*={4,}", member.docstring, re.MULTILINE)
    ]
    assert not ruled


@pytest.mark.slow
def test_examples_in_docstrings_print_their_output() -> None:
    """Examples that `help` shows of the package and of its classes of motions and surfaces can be typed."""
    texts = {"atlas": atlas.__doc__ or ""} | {name: entry.docstring for name, entry in described().items()}
    examples = {
        name: doctest.DocTestParser().get_doctest(text, {"atlas": atlas}, name, None, None)
        for name, text in texts.items()
        if ">>>" in text
    }
    assert len(examples) > 9
    failures = list[str]()
    for example in examples.values():
        doctest.DocTestRunner(optionflags=FLAGS, verbose=False).run(example, out=failures.append)
    assert not failures, "".join(failures)


def test_examples_in_the_kernels_print_their_output() -> None:
    """So do those of formulas, of balls and of doubles."""
    homes = (Path(atlas.__file__).parent / floor for floor in ("arithmetic", "bodies", "surfaces", "motions", "maps"))
    files = [path for home in homes for path in home.rglob("*.py") if ">>>" in path.read_text("utf-8")]
    names = (
        ".".join(("atlas", *path.relative_to(Path(atlas.__file__).parent).with_suffix("").parts)) for path in files
    )
    results = [doctest.testmod(import_module(name), extraglobs={"atlas": atlas}, optionflags=FLAGS) for name in names]
    assert not any(result.failed for result in results)
    assert sum(result.attempted for result in results) > 9


def test_a_docstring_is_shown_as_it_is_written() -> None:
    """Signs of Markdown are letters, backticks and indented lines are code, dashes are lists."""
    text = "A `x` of omega'_1^2 * 2 < [y].\n\n    E = m_0 c^2\n\n- one ``a`b``\n- two"
    (piece,) = Texts([Text(markdown(text), "here", False, {})]).set({"html": lambda name, _: Link(name)})["html"]
    assert "<code>x</code> of omega" in piece
    assert "_1^2 * 2 &lt; [y]." in piece
    assert "<pre><code>E = m_0 c^2</code></pre>" in piece
    assert piece.count("<li>") == 2


def test_sections_of_a_docstring_become_tables() -> None:
    """Parameters and errors are rows of a table, examples are code, and the words of other sections stay."""
    text = (
        "A motion.\n\nParameters\n----------\nratio : float or (I2, I3)\n    Ratio |I3|/I2,\n    below 2.\n"
        "t, s : array_like\n    Times.\n\nRaises\n------\nDomainError\n    At the pole.\n\n"
        "Notes\n-----\nAs in (71).\n\nExamples\n--------\n>>> 1 + 1\n2"
    )
    (piece,) = Texts([Text(markdown_of_sections(text), "here", False, {})]).set({"html": lambda name, _: Link(name)})[
        "html"
    ]
    rows = [re.sub(r"<[^>]+>|\s+", " ", row).split() for row in re.findall(r"<tr.*?</tr>", piece, re.DOTALL)]
    assert [" ".join(row) for row in rows] == [
        "Parameters Meaning",
        "ratio float or (I2, I3) Ratio |I3|/I2, below 2.",
        "t, s array_like Times.",
        "Raises Meaning",
        "DomainError At the pole.",
    ]
    assert "<strong>Notes</strong>" in piece
    assert "<p>As in (71).</p>" in piece
    assert "<pre><code>&gt;&gt;&gt; 1 + 1\n2</code></pre>" in piece


def test_parameters_of_docstrings_agree_with_signatures() -> None:
    """Each public class, function and method lists its parameters in their order, and results where it has some."""
    disagreements = list[str]()
    for name, one in described().items():
        members = {f"{name}.{inner}": member for inner, member in one.members.items()}
        for place, member_entry in {name: one, **members}.items():
            call = (
                ""
                if member_entry.arguments in {"", "()"}
                else f"lambda {member_entry.arguments[1:-1].replace('...', 'None')}: 0"
            )
            section = re.search(r"^Parameters\n-{10}\n((?:(?!.*\n-{3}).*\n?)*)", member_entry.docstring, re.MULTILINE)
            entries = re.findall(r"^(\S.*?)(?: : .*)?$", section[1] if section else "", re.MULTILINE)
            listed = [x.lstrip("*") for entry in entries for x in entry.split(", ")]
            if call and listed != [*inspect.signature(eval(call)).parameters]:  # noqa: S307  our own signature
                disagreements.append(f"{place}{member_entry.arguments}: {listed}")
            if call and place.count(".") and "\nReturns\n-------\n" not in member_entry.docstring:
                disagreements.append(f"{place}: no result")
    assert not disagreements, "\n".join(disagreements)
