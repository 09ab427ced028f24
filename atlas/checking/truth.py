"""The true motion at arrays of times: elementary ones some three digits beyond a double, others by their kernels.

The axis and the frequencies of an elementary motion are computed in balls, and the phases are reduced in two words, see
`atlas.arithmetic.phase`; sines, cosines and R are long doubles. A million rows are graded in a second; balls decide
digits that depend on the last bits, and times that are not `within`.
"""

from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from flint import arb
from numpy.typing import NDArray

from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.certified_inputs import Real
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import BITS, workprec
from atlas.arithmetic.phase import MAX_PHASE, Phases, room
from atlas.arithmetic.words import TURN, magnitude, middle, scaled, words
from atlas.motions.base import Motion as Placed
from atlas.motions.elementary.certified import ElementaryMotion
from atlas.motions.nutation.certified_general import GeneralMotion
from atlas.motions.nutation.certified_top import TopMotion
from atlas.motions.nutation.single import SingleGeneral, SingleTop
from atlas.motions.torus.certified import AsymmetricMotion
from atlas.motions.torus.kernel import SingleAsymmetric
from atlas.motions.torus.theta import ThetaKernel

Long = NDArray[np.longdouble]
Motion: TypeAlias = ElementaryMotion | GeneralMotion | AsymmetricMotion | TopMotion | Placed[Any]

UNCERTAINTY = 2e-18
"""Bound on the error of an entry of R, of a quaternion, and of Omega in units of its length."""

KERNELS = 1e-14
"""Bound on the error of an entry of R, of a quaternion, and of Omega in units of the largest rate, by a kernel."""

BALL_THRESHOLD = 100
"""Error, in uncertainties of a kernel, below which balls compute the error, in a thousandth of a second a row."""

PHASE = 2.0**-6
"""Fraction of the largest phase, 2^50, up to which two words of a frequency cost less than a quarter of UNCERTAINTY."""

EXTENDED = bool(np.finfo(np.longdouble).eps < 2e-19)
"""Whether this machine has long doubles of 64 binary digits or more; without them balls decide everything."""


class Truth:
    """Reference R, Omega and quaternion of an elementary motion in long doubles, accurate to `uncertainty`.

    Made from the certified motion. `ball_threshold` and `floor` are 0 and `in_balls` is True, see `KernelTruth`.
    """

    uncertainty = UNCERTAINTY
    ball_threshold = floor = 0.0
    in_balls = True

    def __init__(self, motion: ElementaryMotion) -> None:
        values = enclosed(lambda: (motion.k, motion.phi, *motion.axis, motion.omega2, motion.omega3), BITS)
        with workprec():
            self._phases = Phases([x / TURN for x in values[:2]])
        # three products of words hold a phase of 2^22 to 2^-59 only, which doubles do not see
        self._phases.max_near_time = -1.0
        self.n2, self.n3, self.omega2, self.omega3 = map(long, values[2:])

    def within(self, t: FloatArray) -> NDArray[np.bool_]:
        """Return a mask (m,) of the times (m,) at which the reference is accurate to UNCERTAINTY.

        All False on a machine whose long doubles have no 64 bits.
        """
        return np.asarray((np.abs(t) <= PHASE * self._phases.reach) & EXTENDED)

    def values(self, t: FloatArray) -> tuple[Long, Long, Long]:
        """Return R (m, 9) row by row, Omega (m, 3) and one of the two quaternions (m, 4), scalar first; by (84), (73).

        The times t (m,) must be `within`; Omega is in the body, in rad/time.
        """
        half, left_out, sign, _ = self._phases.angles(t, room(2, t.size))
        x = half.astype(np.longdouble) + left_out  # half the phase, less whole quarter turns; sign tells their parity
        sines, cosines = np.sin(x), np.cos(x)
        S, s = sign[1] * 2 * sines[1] * cosines[1], sign[0] * 2 * sines[0] * cosines[0]
        C, c = sign[1] * (1 - 2 * sines[1] ** 2), sign[0] * (1 - 2 * sines[0] ** 2)
        v = np.where(sign[0] > 0, 2 * sines[0] ** 2, 2 * cosines[0] ** 2)
        n2, n3 = self.n2, self.n3
        c1, second = (c, n3 * s, -n2 * s), (-n3 * s, c + n2 * n2 * v, n2 * n3 * v)
        columns = [a * C + b * S for a, b in zip(c1, second, strict=True)]
        second_column = [b * C - a * S for a, b in zip(c1, second, strict=True)]
        third = [n2 * s, n2 * n3 * v, c + n3 * n3 * v]
        R = np.stack([column[i] for i in range(3) for column in (columns, second_column, third)], axis=-1)
        Omega = np.stack([self.omega2 * S, self.omega2 * C, np.full_like(S, self.omega3)], axis=-1)
        halves = [(np.where(up, b, -a), np.where(up, a, b)) for up, a, b in zip(sign > 0, sines, cosines, strict=True)]
        (c, s), (C, S) = halves
        q = np.stack([c * C - n3 * s * S, n2 * s * S, n2 * s * C, c * S + n3 * s * C], axis=-1)
        return R, Omega, q


@dataclass(frozen=True)
class KernelTruth:
    """Reference R, Omega and quaternion of a motion by its kernel `single`, accurate to a few units in the last place.

    `single` has `rotation(t)` and `angular_velocity(t)`. The values hold for |t| <= `reach` and are accurate to
    `uncertainty`; `in_balls` says whether there is a certified counterpart. Errors below `ball_threshold` are computed
    in balls; errors below `floor` cannot be distinguished from `floor`.
    """

    single: Any
    reach: float
    uncertainty: float = KERNELS
    ball_threshold: float = BALL_THRESHOLD * KERNELS
    floor: float = 0.0
    in_balls: bool = True

    def within(self, t: FloatArray) -> NDArray[np.bool_]:
        """Return a mask (m,) of the times t (m,) with |t| <= `reach`."""
        return np.asarray(np.abs(t) <= self.reach)

    def values(self, t: FloatArray) -> tuple[Long, Long, Long]:
        """Return R (m, 9) row by row, Omega (m, 3) and one of the two quaternions (m, 4), scalar first.

        The times t (m,) must be `within`; Omega is in the body, in rad/time.
        """
        from scipy.spatial.transform import Rotation

        R, Omega = self.single.rotation(t), self.single.angular_velocity(t)
        q = Rotation.from_matrix(R).as_quat(scalar_first=True)
        return R.reshape(-1, 9).astype(np.longdouble), Omega.astype(np.longdouble), q.astype(np.longdouble)


def truth_of(motion: Motion, unit: Real) -> Truth | KernelTruth:
    """Return the reference values of a motion: a `Truth` for an `ElementaryMotion`, else a `KernelTruth`.

    `unit` is `Reference.unit`, in rad/time; for a motion with three moments it limits the times `within` reach. Where
    such a motion has no closed form, no time is within reach, and each row is decided by balls. A motion in given axes
    has no balls.
    """
    if isinstance(motion, Placed):  # the matrices that turn it into the given axes are rounded
        bound = 4 * KERNELS
        return KernelTruth(motion, np.inf, bound, 0.0, bound, in_balls=False)
    if isinstance(motion, ElementaryMotion):
        return Truth(motion)
    if isinstance(motion, AsymmetricMotion):
        of_three = SingleAsymmetric(motion)
        if not isinstance(of_three.closed, ThetaKernel):
            return KernelTruth(of_three, -1.0)  # balls decide each row
        bound = of_three.closed.accuracy + (of_three.closed.proved or 0.0)
        return KernelTruth(of_three, PHASE * MAX_PHASE / float(arb(unit)), bound, 0.0, bound)
    single = SingleTop(motion) if isinstance(motion, TopMotion) else SingleGeneral(motion)
    return KernelTruth(single, PHASE * single.pair.phases.reach)


def long(value: Real) -> np.longdouble:
    """Return the long double nearest to a number (exact, a double or the middle of a ball), or inf."""
    number = middle(value)
    if number == 0:
        return np.longdouble(0)
    size = magnitude(number)
    head, tail = words(scaled(number, -size), 2)
    return np.longdouble(np.ldexp(np.longdouble(head) + np.longdouble(tail), size))
