"""One motion of a top: what turns times into matrices and into Omega."""

from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np

from atlas.core.inputs import FloatArray
from atlas.core.nutation.cayley_klein import Evaluation, evaluate
from atlas.core.nutation.constants import CayleyKlein
from atlas.core.nutation.single import SingleMotion
from atlas.exact.motions.top import TopMotion
from atlas.formulas.numbers import nearest


class SingleTop(SingleMotion):
    """One motion of a top: its constants in balls, and what turns times into matrices."""

    exact: TopMotion

    @cached_property
    def _sloping(self) -> CayleyKlein:
        """The pair with its derivatives by time."""
        return CayleyKlein(lambda: self.exact.solution, slopes=True)

    def angular_velocity(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return Omega(t), shape (..., 3): twice the vector part of the quaternion's logarithmic derivative."""
        kappa = nearest(self.exact.quartic.kappa) if self._sloping.swing else 0.0

        def prepare(size: int) -> Callable[[FloatArray, FloatArray], None]:
            """Return what fills a block."""
            evaluation = Evaluation(self._sloping, size)

            def fill(times: FloatArray, rows: FloatArray) -> None:
                q = evaluation.parts(times)
                (w, x, z, y), (dw, dx, dz, dy) = q[:4], q[4:]
                up, down = w * w + z * z, x * x + y * y
                half = (up + down) / 2
                turn = (
                    (w * dx - x * dw - y * dz + z * dy) / half,
                    (w * dy - y * dw - z * dx + x * dz) / half,
                    (w * dz - z * dw - x * dy + y * dx) / half + kappa * (up - down) / (up + down),
                )
                np.matmul(np.array(turn).T, self.right, out=rows)

            return fill

        return evaluate(t, (3,), out, prepare)
