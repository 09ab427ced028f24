"""The guide's notebook runs as it is written, and prints its recorded output."""

from typing import Any

import pytest

from atlas.book.files import find
from atlas.book.load import load
from atlas.places import folder


@pytest.fixture(scope="module")
def ran(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Run it, in a folder of its own, and ask at the end which modules were loaded."""
    import jupytext
    import nbclient
    import nbformat

    patch, home = pytest.MonkeyPatch(), tmp_path_factory.mktemp("home")
    for name in ("IPYTHONDIR", "JUPYTER_CONFIG_DIR", "JUPYTER_RUNTIME_DIR"):
        patch.setenv(name, str(home))
    notebook = jupytext.read(folder("reports") / "notebook.md")
    notebook.cells.append(nbformat.v4.new_code_cell("import sys; print('matplotlib.pyplot' in sys.modules)"))
    nbclient.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(home)}}).execute()
    patch.undo()
    return notebook


def outputs(ran: Any) -> list[tuple[str, list[Any], str]]:
    """Return each cell with code, its outputs, and the text below it."""
    below = [cell.source if cell.cell_type == "markdown" else "" for cell in ran.cells[1:]] + [""]
    return [(cell.source, cell.outputs, text) for cell, text in zip(ran.cells, below, strict=True) if "outputs" in cell]


@pytest.mark.slow
def test_cells_print_the_output_below_them(ran: Any) -> None:
    """A block of text below a cell is its output."""
    printed = 0
    for source, outputs_given, below in outputs(ran)[:-1]:
        text = "".join(
            output.text for output in outputs_given if output.output_type == "stream" and output.name == "stdout"
        )
        assert bool(text) == below.startswith("```text\n"), source
        if text:
            assert text.split() == below.removeprefix("```text\n").partition("```")[0].split()
            printed += 1
    assert printed >= 5


@pytest.mark.slow
def test_objects_and_figures_show_themselves(ran: Any) -> None:
    """A motion as a table and as LaTeX, a figure as a picture: without %matplotlib, and without pyplot."""
    outputs_of = {source.splitlines()[-1]: outputs_given for source, outputs_given, _ in outputs(ran)}
    assert {*outputs_of["motion"][0].data} >= {"text/plain", "text/html", "text/latex"}
    assert "<table>" in outputs_of["motion"][0].data["text/html"]
    assert "image/png" in outputs_of["motion.plot(turns=10)"][0].data
    (text_last,) = (
        output.text for output in outputs(ran)[-1][1] if output.output_type == "stream" and output.name == "stdout"
    )
    assert text_last == "False\n"


def test_the_notebook_is_a_page_of_the_guide() -> None:
    """It is a page of the guide."""
    assert any(
        getattr(block, "file", "") == "notebook.md" for page in load(find("guide")).pages for block in page.blocks
    )
