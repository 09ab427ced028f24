"""Information of the data on the parameters: covariance, the combinations that are not determined, and conventions."""

from typing import Any

import numpy as np
from scipy.linalg import qr

from atlas.arithmetic.inputs import FloatArray
from atlas.fitting.models import units_of, unseen
from atlas.fitting.parameters import Parameters
from atlas.fitting.problem import Problem

UNSEEN = 0.5
"""Standard error of a combination of parameters, in natural units, above which the data do not determine it."""

ROUNDING = 2.0**-48
"""Singular value, relative to the largest, below which it is a rounding error of the derivatives."""

NULL = 1e-7
"""Singular value, relative to the largest, and part of a combination, below which both count as zero."""


class Seen:
    """Standard errors of the n varied parameters, and the combinations that the data do not determine.

    Both follow from the singular values of the Jacobian J (N k, n) of the residuals at `x` (n,); `weighted` is J
    with the weights of a robust loss, `scores` (N k,) are residuals times weights, `scale` is the noise over the
    given sigma. `covariance` (n, n) and `errors` (n,) are in the parameters' units.
    """

    def __init__(
        self,
        problem: Problem,
        motion: Any,
        x: FloatArray,
        J: FloatArray,
        weighted: FloatArray,
        scores: FloatArray,
        scale: float,
    ) -> None:
        self.problem, self.x = problem, x
        field = float(np.linalg.norm(motion.field_in_body(0.0))) * (not problem.model.has_direction)
        rate = max(problem.rate, float(np.linalg.norm(motion.angular_velocity(0.0))))  # it may start from rest
        units = units_of(problem.model, field + rate)
        self.units = np.array([units[name] for name in problem.names])
        scaled = weighted * self.units
        _, size, turn = np.linalg.svd(scaled, full_matrices=False)
        rounding = ROUNDING * size.max(initial=1.0)
        size = np.maximum(size, rounding)
        self.is_lost = (scale / size > UNSEEN) | (size <= rounding)  # however exact the data are
        inverse = turn[~self.is_lost].T / size[~self.is_lost] ** 2 @ turn[~self.is_lost]
        null = self.is_lost & (size < NULL * size.max(initial=1.0))
        weak = self.is_lost & ~null
        if problem.loss == "linear":
            self.covariance = inverse * scale**2
        else:  # of an M-estimator, whatever the noise
            score = (J * self.units * scores[:, None]).reshape(problem.data.t.size, -1, len(x)).sum(1)
            spread = score.T @ score  # the numbers of one time may be off together
            self.covariance = inverse @ spread @ inverse
        square = np.outer(self.units, self.units)
        self.covariance = self.covariance * square
        self.prediction_covariance = self.covariance + turn[weak].T / size[weak] ** 2 @ turn[weak] * scale**2 * square
        """Covariance (n, n) for predictions: that of the parameters, plus combinations that are hardly determined."""
        self.null = turn[null].T
        self.directions = _separated(turn[self.is_lost].T)
        """Combinations of parameters that are not determined, in natural units, as columns: (n, count)."""
        self.errors = np.sqrt(np.diag(self.covariance))
        self.is_moved = self._moves(np.diag(self.units), self.errors)
        """Whether each parameter changes along each of these combinations by more than its error, (n, count)."""

    def _moves(self, scaled: FloatArray, errors: FloatArray) -> Any:
        by = abs(scaled @ self.directions)
        return (by * UNSEEN > errors[:, None]) & (by > NULL * np.linalg.norm(scaled, axis=1)[:, None])

    def parameters(self) -> Parameters:
        """Return the `Parameters` with standard errors and correlations, None where the data determine none."""
        problem, names = self.problem, self.problem.names
        is_lost, errors = self.is_moved.any(1), self.errors
        marked: dict[str, dict[str, Any]] = {
            name: {"value": value} for name, value in problem.values(self.x).items() if name in problem.params
        }
        for i, name in enumerate(names):
            marked[name] |= {"stderr": None if is_lost[i] else float(errors[i])}
            marked[name] |= {"correl": None if is_lost[i] else {
                other_name: float(self.covariance[i, j] / (errors[i] * errors[j]))
                for j, other_name in enumerate(names) if j != i and not is_lost[j] and errors[i] * errors[j] > 0
            }}  # fmt: skip
        derived = [name for name, p in problem.params.items() if p.expr]
        by = problem.chain(list(self.x), derived)
        for name, row in zip(derived, by, strict=True):
            error = np.sqrt(max(row @ self.covariance @ row, 0.0))
            is_moved = self._moves((row * self.units)[None], error[None]).any()
            marked[name]["stderr"] = None if is_moved else float(error)
        return problem.params.changed(**marked)

    def words(self) -> list[str]:
        """Return a sentence for each combination of parameters that the data do not determine, [] for none."""
        out = []
        for k, u in enumerate(self.directions.T):
            indices = [int(i) for i in np.argsort(-abs(u)) if self.is_moved[i, k]]
            names = [self.problem.names[i] for i in indices]
            if len(names) == 1:
                out.append(f"{names[0]} is not determined by these data.")
                continue
            leading = "ratio" if "ratio" in names else names[0]
            steps = u * self.units
            steps = steps / steps[self.problem.names.index(leading)]
            moves = ", ".join(
                f"{self.problem.names[i]} by {steps[i]:+.3g} d"
                for i in sorted(indices)
                if self.problem.names[i] != leading
            )
            out.append(
                f"{', '.join(names[:-1])} and {names[-1]} are not determined apart: if {leading} changes by a small d "
                f"and {moves}, these data stay the same."
            )
        return out


def _separated(directions: FloatArray) -> FloatArray:
    """Return combinations (n, count) of length 1 that span the same space as the columns of `directions` (n, count).

    Each has a parameter that no other one has; a single column is returned as it is.
    """
    if directions.shape[1] < 2:
        return directions
    _, _, order = qr(directions.T, mode="economic", pivoting=True)
    simple = directions @ np.linalg.inv(directions[order[: directions.shape[1]]])
    return np.asarray(simple / np.linalg.norm(simple, axis=0))


def gauge(problem: Problem) -> list[str]:
    """Return a list of at most one sentence, on the attitude angles that the problem's data do not determine."""
    hidden = unseen(problem.model, problem.data.kind)
    if not hidden:
        return []
    if "a1" in hidden:
        return [
            "The attitude in the laboratory is not determined: B1 to B3 are along the axes of the body at the epoch."
        ]
    if problem.data.kind != "axis":
        words = "The angle of the body about the field is not determined: a3 = 0 at the epoch is a convention. With "
        return [words + "all signs of n, k2, k3 and linear reversed the data are the same."]
    return ["The angle of the body about its axis is not determined: a3 = 0 at the epoch is a convention."]
