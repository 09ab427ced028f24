"""The order of convergence of an integrator, from runs of one motion with several steps."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from atlas.checking.grades import LEAST, LINES
from atlas.errors import AtlasError
from atlas.pictures import Curve, Plane, Points, Scene
from atlas.trial.ledger.plain import html_table, table

ROUNDING = 2.0**-52
"""Error up to which rounding hides the error of the method."""


@dataclass(frozen=True)
class Convergence:
    """Order of convergence of an integrator from runs with several steps, as `atlas.check` returns it.

    `str` is the text that `atlas check --order` prints. Runs are sorted by step, the longest first.

    Attributes
    ----------
    case : str
        Type of the reference motion.
    parameters : mapping of str to object
        Parameters of the reference motion.
    files : tuple of str
        Names of the runs.
    steps : tuple of float
        Steps of the runs.
    errors : mapping of str to tuple of float
        Largest error of each run, for "R", "Omega" and "quaternion", in the units of `Check.errors`.
    orders : mapping of str to tuple of float or None
        Order p in error ~ step^p from each run and the one before; None where an error is rounding.
    order : mapping of str to float or None
        Order of all runs by least squares.
    """

    case: str
    parameters: Mapping[str, Any]
    files: tuple[str, ...]
    steps: tuple[float, ...]
    errors: Mapping[str, tuple[float, ...]]
    orders: Mapping[str, tuple[float | None, ...]]
    order: Mapping[str, float | None]

    @property
    def _title(self) -> str:
        order_text = (f"{name} {'not told' if p is None else f'{p:.2f}'}" for name, p in self.order.items())
        return f"order of convergence of {len(self.steps)} runs, case {self.case}: {', '.join(order_text)}"

    def table(self) -> tuple[list[str], list[list[str]]]:
        """Return (heading, rows) of a table of texts, a row for each run, the longest step first.

        A row has the step and, for each quantity, the largest error and the order from the previous run ("-"
        without one).
        """
        heading = ["step", *(x for name in self.errors for x in (f"error of {name}", "order"))]
        rows = []
        for i, step in enumerate(self.steps):
            cells = [f"{step:g}"]
            for name, errors in self.errors.items():
                p = self.orders[name][i - 1] if i else None
                cells += [f"{errors[i]:.2e}", "-" if p is None else f"{p:.2f}"]
            rows.append(cells)
        return heading, rows

    def __str__(self) -> str:
        """Return the orders as a table."""
        return f"{self._title}\n{table(*self.table())}"

    def _repr_html_(self) -> str:
        return html_table(self._title, *self.table())

    def record(self) -> dict[str, Any]:
        """Return the orders as a dict for JSON, with the attributes as keys."""
        return asdict(self)

    def scene(self) -> Scene:
        """Return a `Scene` of the largest errors against the step, both axes logarithmic, a line for each quantity."""
        layers: list[Curve | Points] = []
        for name, errors in self.errors.items():
            points = np.column_stack([self.steps, np.maximum(errors, LEAST)])
            layers += [Curve(points, *LINES[name]), Points(points, LINES[name][0])]
        return Scene(
            title="Order of convergence",
            caption=f"The largest error of each run against its step: {self._title}.",
            alt=f"Lines of error against step, both on logarithmic scales; {self._title}.",
            panels=(Plane(tuple(layers), "step", "largest error", x_scale="log", y_scale="log", legend=True),),
            size=(120.0, 75.0),
            parameters=dict(self.parameters),
        )


def convergence(checks: Sequence[Any]) -> Convergence:
    """Return the `Convergence` of two or more runs of an integrator, each a `Check`, in any order.

    Raises AtlasError for fewer than two runs, for equal steps, for runs without graded columns, for runs whose
    columns or motions differ, and for final times that differ by more than 1.5 times the longest step.
    """
    runs = sorted(checks, key=lambda run: -run.step)
    steps = tuple(run.step for run in runs)
    if len(set(steps)) < max(2, len(steps)) or min(steps) <= 0:
        steps_in_words = ", ".join(f"{step:g}" for step in steps)
        raise AtlasError(f"The order needs two runs or more, each with another step; the steps are {steps_in_words}.")
    if not runs[0].errors or any(set(run.errors) != set(runs[0].errors) for run in runs):
        raise AtlasError("The order needs runs with the same columns, and an initial angular velocity: give --omega.")
    if any(run.parameters != runs[0].parameters for run in runs):
        raise AtlasError(f"{runs[0].file} and another run are of different motions: give runs of one motion.")
    ends = [run.end for run in runs]
    if max(ends) - min(ends) > 1.5 * steps[0]:
        steps_in_words = " and at ".join(f"{end:g}" for end in (min(ends), max(ends)))
        raise AtlasError(f"The runs end at t = {steps_in_words}: the order needs runs over the same time.")
    errors = {name: tuple(max(run.errors[name]) for run in runs) for name in runs[0].errors}
    orders = {
        name: tuple(_slope(steps[i : i + 2], values[i : i + 2]) for i in range(len(steps) - 1))
        for name, values in errors.items()
    }
    return Convergence(
        case=runs[0].case,
        parameters=runs[0].parameters,
        files=tuple(run.file for run in runs),
        steps=steps,
        errors=errors,
        orders=orders,
        order={name: _slope(steps, values) for name, values in errors.items()},
    )


def _slope(steps: Sequence[float], errors: Sequence[float]) -> float | None:
    """Return the slope of log(errors) over log(steps) by least squares: the order of the method.

    None if an error is at most ROUNDING.
    """
    if min(errors) <= ROUNDING:
        return None
    return float(np.polyfit(np.log(steps), np.log(errors), 1)[0])
