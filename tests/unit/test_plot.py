"""`atlas plot`: the columns of a table, as they stand in it."""

from pathlib import Path

import numpy as np
import pytest
from matplotlib.collections import LineCollection

from atlas.cli.app import main
from atlas.cli.plot import figure_of


@pytest.mark.parametrize("ending", [".csv", ".npz"])
def test_points_and_units_agree_with_the_table(ending: str, tmp_path: Path) -> None:
    """A sweep's table is drawn number by number, with its units at the axes."""
    table = tmp_path / f"table{ending}"
    words = "sweep elementary --field 1 2 --omega2 0.7 --set ratio=0.3:1.8:7 --quantity k phi --out".split()
    with pytest.raises(SystemExit) as end:
        main([*words, str(table)])
    assert not end.value.code
    axes = figure_of(table, "ratio", ["k", "phi"], 86.0).axes[0]
    assert axes.get_ylabel() == "k [1/time], phi [1/time]"
    k, phi = axes.get_lines()
    assert k.get_xdata() == pytest.approx(np.linspace(0.3, 1.8, 7), rel=1e-15)
    assert np.ptp(np.asarray(k.get_ydata())) == 0.0
    assert (np.diff(np.asarray(phi.get_ydata())) < 0.0).all()


def test_empty_cells_are_left_out_and_deviations_are_drawn_as_bars(tmp_path: Path) -> None:
    """An empty cell is no point; y_sigma beside y is its error."""
    table = tmp_path / "own.csv"
    table.write_text("# made by hand\nx [s],y,y_sigma\n0,1,0.5\n1,,0.5\n2,3,0.25\n", encoding="utf-8")
    axes = figure_of(table, "x", ["y"], 86.0).axes[0]
    line, errors = axes.get_lines()[0], axes.collections[0]
    assert isinstance(errors, LineCollection)
    assert np.asarray(line.get_xydata()).tolist() == [[0.0, 1.0], [2.0, 3.0]]
    assert [np.asarray(bar)[:, 1].tolist() for bar in errors.get_segments()] == [[0.5, 1.5], [2.75, 3.25]]
    assert axes.get_xlabel() == "x [s]"
