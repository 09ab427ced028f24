"""Figures by themselves: drawn once, taken from the store afterwards."""

from pathlib import Path

import pytest

from atlas import AtlasError
from atlas.build.figure import build_figures


def test_a_figure_is_drawn_once_for_each_format(tmp_path: Path) -> None:
    """The same figure is taken from the store; another format of it is drawn, and nothing that is there is touched."""
    (first,) = build_figures(["magn"], ("svg",), tmp_path)
    times = {file: file.stat().st_mtime_ns for file in first.files}
    (again,) = build_figures(["magn"], ("svg",), tmp_path)
    (more,) = build_figures(["magn"], ("svg", "png"), tmp_path)
    assert [one.reason.partition(":")[0] for one in (first, again, more)] == ["drawn", "taken", "drawn"]
    assert [file.name for file in more.files] == ["magn.svg", "magn.png"]
    assert {file: file.stat().st_mtime_ns for file in first.files} == times


def test_a_figure_that_was_lost_or_changed_is_put_back(tmp_path: Path) -> None:
    """What is in the folder is what was drawn, whatever happened to the file."""
    (made,) = build_figures(["magn"], ("svg",), tmp_path)
    good = made.files[0].read_bytes()
    made.files[0].write_text("spoiled")
    list(build_figures(["magn"], ("svg",), tmp_path))
    assert made.files[0].read_bytes() == good


def test_figures_keep_their_order_and_fail_alone(tmp_path: Path) -> None:
    """The results come in the order asked for, and one that fails has the reason and no files."""
    found = list(build_figures(["trochoids", "lssc"], ("svg",), tmp_path, parameters={"mu": 0.0}, jobs=2))
    assert [one.name for one in found] == ["trochoids", "lssc"]
    assert all(one.failure and not one.files for one in found)
    assert "no parameter 'mu'" in found[1].failure


def test_parameters_and_the_store_of_a_folder_are_its_own(tmp_path: Path) -> None:
    """Other parameters, and another folder, draw anew."""
    (plain,) = build_figures(["trochoids"], ("svg",), tmp_path / "a")
    (other,) = build_figures(["trochoids"], ("svg",), tmp_path / "a", parameters={"speeds": (0.5,)})
    (elsewhere,) = build_figures(["trochoids"], ("svg",), tmp_path / "b")
    assert "parameters" in other.reason or "never" in other.reason
    assert elsewhere.reason == plain.reason
    assert elsewhere.files[0].read_bytes() != other.files[0].read_bytes()


def test_a_shaded_figure_is_a_png(tmp_path: Path) -> None:
    """Any other format of it is refused before anything is drawn."""
    with pytest.raises(AtlasError, match="a shaded figure is a PNG; 'svg'"):
        list(build_figures(["cone"], ("png", "svg"), tmp_path, renderer="shaded"))
    assert not list(tmp_path.iterdir())
