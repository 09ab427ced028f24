"""``atlas motion --out``: samples of a motion as a CSV, NPZ or Parquet file, with its conventions."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import click

from atlas.cli.options import Place
from atlas.cli.typed import parts_of

out_option: Callable[[Any], Any] = click.option(
    "--out",
    type=Place(dir_okay=False, path_type=Path),
    help="Write the motion at --times to a table, .csv, .npz or .parquet; vectors are along the axes of the inputs.",
)


def write_table(motion: Any, times: Sequence[float], out: Path, units: Mapping[str, str]) -> None:
    """Write a table of one motion, its conventions and parameters above the rows, which `atlas check` reads.

    A row has the motion at one of the times, in doubles. `units` are other names of the register's units. Raises
    click.UsageError without times, AtlasError for an ending other than .csv, .npz and .parquet.
    """
    from atlas.files import write
    from atlas.notebook.frames import columns_at
    from atlas.sweeps.families import FAMILIES
    from atlas.sweeps.plan import CONVENTIONS
    from atlas.sweeps.tables import PARTS, check_format, head_of

    check_format(out)
    if not times:
        raise click.UsageError("--out writes the motion at --times or on a --grid: give one of them.")
    columns = dict(columns_at(motion, list(map(float, times))))
    units_by_name = {**FAMILIES[motion.family].units, "t": "time"}
    named = {name: units.get(units_by_name.get(name, ""), units_by_name.get(name, "")) for name in columns}
    lines = [
        *CONVENTIONS * ("R11" in columns),
        *(f"{name} = {' '.join(texts)}" for name, texts in parameters_of(motion).items()),
    ]
    head = head_of(lines, (f"{name} [{unit}]" if unit else name for name, unit in named.items()))
    content = PARTS[out.suffix[1:]](columns, head)
    write(out, head.encode() * (out.suffix == ".csv") + content)


def parameters_of(motion: Any) -> dict[str, list[str]]:
    """Return the inputs of a motion by name for a trajectory's head, as lists of shortest decimal texts.

    A body with moments is given as inertia, (I2, I3), in the place of its ratio. Of a motion in given axes the
    inputs are inertia (I11 I22 I33 I12 I13 I23 of the tensor), field, omega and attitude, the quaternion x, y, z, w
    at t = 0.
    """
    if getattr(motion, "is_placed", False):
        J, field, _, omega = motion.given
        moments = [J[i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
        numbers = {"inertia": moments, "field": field, "omega": omega, "attitude": motion.quaternion(0.0)}
    else:
        numbers = {name: parts_of(value) for name, value in motion.arguments.items() if value is not None}
        body = motion.arguments.get("ratio")
        if hasattr(body, "I2"):
            numbers = {"inertia": [body.I2, body.I3]} | {name: x for name, x in numbers.items() if name != "ratio"}
    return {name: [repr(float(x)) for x in values] for name, values in numbers.items()}
