"""Other conventions of reading data that no motion of the family follows as given."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from atlas.arithmetic.inputs import FloatArray
from atlas.checking.conventions import quaternion_readings
from atlas.errors import AtlasError
from atlas.fitting.data import Data
from atlas.fitting.models import DIRECTION, Values
from atlas.fitting.parameters import Parameters
from atlas.fitting.problem import Problem
from atlas.fitting.search import follow_data, rate_of, tries_about

HELD = (
    "The direction of the field is held at (0, 0, 1), and the data are followed where it is free: give, "
    'in Python, params={"n1": {"vary": True}, "n2": {"vary": True}}, or data along axes whose third is the field.'
)


def other_conventions(
    problem: Problem, parameters: Callable[[Data], tuple[Parameters, Values]], *, quaternions: bool
) -> Iterator[tuple[str, Problem]]:
    """Yield (sentence, problem) to be tried: a top's direction set free, then rotations read in other conventions.

    A direction is freed only if all of it is held and the data are rotations or axes. `parameters` maps `Data` to
    the pair (parameters, start values by name); `quaternions` says that the rotations were given as quaternions.
    """
    data = problem.data
    is_held = problem.model.has_direction and not any(problem.params[name].free for name in DIRECTION)
    if is_held and data.kind in ("rotation", "axis"):
        freed = problem.params.changed(**{name: {"vary": True} for name in DIRECTION[:2]})
        yield HELD, Problem(problem.model, data, freed, problem.loss, problem.rate, problem.start_values)
    for words, R in _readings(data.values, quaternions=quaternions) if data.kind == "rotation" else ():
        read = replace(data, values=R)
        parameters_free, start = parameters(read)
        sentence = f"The data are followed where they are read otherwise: {words}."
        yield sentence, Problem(problem.model, read, parameters_free, problem.loss, rate_of(read), start)


def _readings(R: FloatArray, *, quaternions: bool) -> Iterator[tuple[str, FloatArray]]:
    """Yield (words, rotations (N, 3, 3)) for each other reading of the rotations R (N, 3, 3), which were read as given.

    Of matrices the only one is the transposed; of `quaternions` there are five, in other orders and conjugate.
    """
    if not quaternions:
        yield "as matrices that are transposed, for R takes the body to the laboratory", R.swapaxes(1, 2)
        return
    for words, q in quaternion_readings(Rotation.from_matrix(R).as_quat(scalar_first=True)):
        if words:
            yield f"as quaternions {words}", Rotation.from_quat(q, scalar_first=True).as_matrix()


def minima_of(problem: Problem) -> Iterator[FloatArray]:
    """Yield the varied parameters (n,) of the motion reached from each start about the middle of the data.

    If a parameter of the state is given, fixed or bounded, the starts are about t = 0. Starts that lead to no
    motion are skipped.
    """
    for centre, near_centre, start, count in tries_about(problem, 0):
        try:
            x = follow_data(near_centre, start, count)
            yield problem.inside(near_centre.parameters_at(x, -centre)) if centre else x
        except (AtlasError, np.linalg.LinAlgError):
            continue
