"""Trajectories of several integrators, graded side by side: their tables, and their errors in one picture."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from atlas.checking.check import Check
from atlas.checking.grades import LINES, MAX_DIGITS
from atlas.errors import AtlasError
from atlas.pictures import Curve, Plane, Scene
from atlas.pictures.captions import listed
from atlas.pictures.style import LINES as ROLES


@dataclass(frozen=True)
class Comparison:
    """Grades of several trajectories, each against its reference motion: `checks` has the `Check` of each."""

    checks: tuple[Check, ...]

    def __str__(self) -> str:
        """Return the tables of all trajectories, one below the other."""
        return "\n".join(map(str, self.checks))

    def record(self) -> dict[str, Any]:
        """Return the grades as plain data for JSON, under "checks" a list of the records of the trajectories."""
        return {"checks": [check.record() for check in self.checks]}

    def scene(self) -> Scene:
        """Return a `Scene` of the errors of all trajectories against time, a panel each for R, Omega and quaternions.

        Raises AtlasError for more than eight trajectories, and where none has a column that is graded.
        """
        groups = [group for group in LINES if any(group in check.errors for check in self.checks)]
        if not groups:
            raise AtlasError(
                f"{self.checks[0].file} and the others are without an initial angular velocity, and so without "
                "errors to plot: give --omega."
            )
        if len(self.checks) > len(ROLES):
            raise AtlasError(f"A picture compares {len(ROLES)} files at most, not {len(self.checks)}: leave some out.")
        panels = tuple(self._panel(group) for group in groups)
        files = listed([check.file for check in self.checks])
        worst_digits = (
            f"{min(c.worst for c in check.columns):.1f} of {check.file}" for check in self.checks if check.columns
        )
        digits = f"Correct digits in the worst column: {', '.join(worst_digits)}."
        quantities = listed([{"R": "matrices", "Omega": "angular velocity"}.get(x, "quaternions") for x in groups])
        return Scene(
            title=f"Errors of {files}",
            caption=f"The largest errors in {quantities} of {files} against the certified motion. {digits}",
            alt=f"Curves of error against time on a logarithmic scale, one for each of {files}. {digits}",
            panels=panels,
            size=(120.0, 15.0 + 60.0 * len(panels)),
            parameters=dict(self.checks[0].parameters),
        )

    def _panel(self, group: str) -> Plane:
        """Return a panel with the errors against time, one curve for each trajectory that has them.

        `group` is "R", "Omega" or "quaternion". Errors outside 10^-17 to 10^17 are drawn at these limits.
        """
        limits = 10.0**-MAX_DIGITS, 10.0**MAX_DIGITS
        curves = tuple(
            Curve(np.column_stack([check.times, np.clip(check.errors[group], *limits)]), role, check.file)
            for check, role in zip(self.checks, ROLES, strict=False)
            if group in check.errors
        )
        return Plane(curves, "$t$", f"error of {LINES[group][1]}", y_scale="log", legend=True)
