"""Any motion of a charged body with three different moments of inertia (not in the paper)."""

from functools import lru_cache
from typing import Any

import numpy as np

from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.dimensions import INERTIA, RATE
from atlas.arithmetic.inputs import FloatArray, as_given, components, finite, kept, plain, real
from atlas.arithmetic.numbers import nearest
from atlas.arithmetic.rotation import target
from atlas.arithmetic.words import floats
from atlas.errors import AtlasError, DomainError, NotCertifiedError
from atlas.lazy import cached_property
from atlas.motions.base import Motion
from atlas.motions.nutation.certified_elliptic import EllipticMotion, EulerTop
from atlas.motions.nutation.kernel import scalar
from atlas.motions.nutation.single_elliptic import MAX_ERROR, SingleElliptic, SingleEulerTop
from atlas.motions.torus.certified import AsymmetricMotion as Balls
from atlas.motions.torus.rounded import Certified
from atlas.motions.torus.theta import MAX_ROUNDING, ThetaKernel, closed_form

BITS = 60
"""Relative accuracy of a frequency before it is rounded, once."""

MOTION_CACHE_SIZE = 16
"""Motions that are kept with what was found of them."""

CHECK_TIMES = (5.3, -61.7, 2.9e5, -8.1e11)
"""Times, over the largest rate, at which a closed form is held against the certified twin; the last if it is proved."""

MAX_DIFFERENCE = 1e-14
"""Largest difference from it."""


class SingleAsymmetric:
    """One motion: the closed form where there is one, else matrices and vectors from balls, rounded once."""

    def __init__(self, exact: Balls) -> None:
        self.exact = exact
        self.size = max(nearest(abs(x)) for x in (*exact.field, *exact.omega)) or 1.0
        self.certified = Certified(exact, self.size)

    @cached_property
    def _first(self) -> tuple[ThetaKernel | SingleElliptic | None, str]:
        """The closed form if there is one, held against nothing yet; and what is known of it, or why there is none."""
        elliptic = self.exact.elliptic
        if elliptic is not None:
            return self._elliptic(elliptic)
        try:
            return closed_form(self.exact, self.size), ""
        except NotCertifiedError as reason:
            return None, f"certified at each time: {str(reason).removeprefix('not certified: ')}"

    @cached_property
    def _choice(self) -> tuple[ThetaKernel | SingleElliptic | None, str]:
        """The closed form if there is one that is proved or agrees with the certified twin; and what is known of it."""
        closed, known = self._first
        if closed is None or isinstance(closed, SingleElliptic):
            return closed, known
        times, differences = [t / self.size for t in (CHECK_TIMES if closed.proved is None else CHECK_TIMES[-1:])], []
        for t in times:
            try:
                differences.append(self._difference(closed, t))
            except NotCertifiedError as reason:  # its periods are too long to be proved
                if not differences:
                    return None, f"certified at each time: {str(reason).removeprefix('not certified: ')}"
                break
        worst, times = max(differences), times[: len(differences)]
        if not worst <= min(closed.accuracy, MAX_DIFFERENCE):
            return None, f"certified at each time: theta functions differ from the certified twin by {worst:.1e}."
        known = (
            f"not proved; agrees with the certified twin within {worst:.1e} at {len(times)} times up to |t| = "
            f"{max(map(abs, times)):.3g}"
            if closed.proved is None
            else f"proved for this motion, at all times within {closed.proved:.1e}"
        )
        return closed, f"{known}; rounding adds {closed.accuracy:.1e} at most"

    def _elliptic(self, exact: EllipticMotion) -> tuple[SingleElliptic | None, str]:
        """Return the closed form by Jacobi's functions, and what is known of it, or why it is not taken."""
        try:
            if isinstance(exact, EulerTop):
                single: SingleElliptic = SingleEulerTop(exact, floats(self.exact.field))
            else:
                single = SingleElliptic(exact)
            single.parts  # noqa: B018  what floats do not hold is refused here
        except DomainError:  # next to the line about which its axis turns
            return None, "certified at each time: Jacobi's functions are too small for a float."
        error = single.accuracy(self.size)
        balls = "" if error <= MAX_ROUNDING else ", and Omega, of so slender a body, is certified at each time"
        adds = MAX_ERROR if balls else error
        return single, f"proved for this motion, at all times; rounding adds {adds:.1e} at most{balls}"

    def _difference(self, closed: ThetaKernel, t: float) -> float:
        """Return how far the closed form is from the certified twin at a time."""
        pairs = (
            (x.rotation(t), x.field_in_body(t) / self.size, x.angular_velocity(t) / self.size)
            for x in (closed, self.certified)
        )
        return float(max(np.abs(x - y).max() for x, y in zip(*pairs, strict=True)))

    @property
    def closed(self) -> ThetaKernel | SingleElliptic | None:
        """The closed form by theta or Jacobi's functions, where there is one that fits, or agrees with the twin."""
        closed, _ = self._first
        if closed is None or isinstance(closed, SingleElliptic) or (closed.fits and "_choice" not in vars(self)):
            return closed
        return self._choice[0]

    @property
    def theta(self) -> ThetaKernel:
        """The closed form by theta functions; AtlasError where there is none."""
        if not isinstance(self.closed, ThetaKernel):
            raise AtlasError(f"The motion has no theta functions of two variables; it is {self.agreement}")
        return self.closed

    @property
    def accuracy(self) -> float:
        """Bound on what rounding adds, that of a value which is rounded once where there is no closed form."""
        if isinstance(self.closed, SingleElliptic):
            return MAX_ERROR if self._slender else self.closed.accuracy(self.size)
        return self.closed.accuracy if self.closed else 2.0**-52

    @property
    def _slender(self) -> bool:
        """Whether Jacobi's functions would lose digits of Omega, which has a large factor along an axis."""
        return isinstance(self.closed, SingleElliptic) and not self.closed.accuracy(self.size) <= MAX_ROUNDING

    @property
    def agreement(self) -> str:
        """What is known of the truth of the closed form, or why there is none."""
        return self._choice[1]

    def rotation(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return R(t), shape (..., 3, 3)."""
        return self._started("rotation", np.eye(3), t, out)

    def column(self, j: int, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the column R_j(t), shape (..., 3)."""
        return self._started("column", np.eye(3)[j - 1], t, out, j)

    def quaternion(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the quaternion (x, y, z, w) of R(t), continuous in t, shape (..., 4)."""
        return self._started("quaternion", np.eye(4)[3], t, out)

    def angular_velocity(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return Omega(t), shape (..., 3)."""
        return self._started("angular_velocity", floats(self.exact.omega), t, out)

    def field_in_body(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return K(t), shape (..., 3)."""
        return self._started("field_in_body", floats(self.exact.field), t, out)

    def _started(self, name: str, start: FloatArray, t: Any, out: FloatArray | None, *which: int) -> FloatArray:
        """Return the values of a function of time, which is known at zero, without a closed form."""
        known = np.asarray(real(t, "The time") == 0)
        if known.all():
            products = target(out, known.shape + start.shape)
        else:
            balls = self.closed is None or (name == "angular_velocity" and self._slender)
            products = getattr(self.certified if balls else self.closed, name)(*which, t, out)
        products[known] = start
        return products


@lru_cache(maxsize=MOTION_CACHE_SIZE)
def _single(*row: Any) -> SingleAsymmetric:
    """Return a motion; those made last are kept, since a sweep asks for the same one at many times."""
    return SingleAsymmetric(Balls(row[:3], row[3:6], row[6:]))


def forget() -> None:
    """Forget the motions that are kept."""
    _single.cache_clear()


class AsymmetricMotion(Motion[SingleAsymmetric]):
    """Motion R(t), R(0) = 1, of a charged body of any inertia tensor, from any start (not in the paper).

    `inertia` (I1, I2, I3), the principal moments; `field` (B1, B2, B3), the components of B' in the principal axes at
    t = 0, and `omega` (omega1, omega2, omega3), the initial angular velocity there, in 1/time. The inputs are taken as
    exact and broadcast with one another and with t. The body is Clebsch's case, theorem-clebsch: M and K move on a
    torus with two commuting flows. Their periods are found by integrals between branch points and proved by Newton's
    method in balls; times are reduced modulo them, and Taylor series with a proven remainder do the rest. `kind` is

    - "at rest", "spin about an axis"; "ball" and "symmetric body", which `GeneralMotion` answers; "Euler's top", free;
    - "on a torus": any other; "elliptic motion", where the torus shrinks to a curve, see `EllipticMotion`;
    - "on the discriminant": other states without two periods, for which there is an answer up to a time that the error
      states.

    On a torus M, K and the attitude are quotients of theta functions of two variables: a quarter of a second for the
    first time that is asked for, then two microseconds each, however long. That they are is proved for each motion when
    `agreement` is asked for, see `atlas.motions.torus.certified_distances`; where no proof is found they are held
    against the certified twin at a few times, and at once where the theta functions fit the motion to less than 36
    digits. A free body of three moments, a spin about a principal axis and an elliptic motion are made of Jacobi's
    functions, some milliseconds for the first time and a tenth of a microsecond for each after it. `accuracy` bounds
    what rounding adds. Where there is no closed form, or it differs, and for other kinds, every value is proved and
    rounded once, in tenths of a second each. For proven digits see `atlas.motions.torus.certified`. Raises DomainError
    for moments that no body has, positive and the largest at most the sum of the others; NotCertifiedError, an
    AtlasError, for what cannot be proved; AtlasError for what is no finite number.

    Left out is the moment that the field induces in the body: with three different moments of inertia it takes the body
    out of this integrable class, and for a micrometre of glass in some teslas it is 1e5 times as strong as the square
    of the field that is kept. Charge is spread like mass, so that the centre of charge is that of mass.

        >>> atlas.AsymmetricMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), omega=(0.3, 0.7, 0.2)).kind
        'on a torus'
    """

    family = "asymmetric"

    def __init__(self, inertia: Any, field: Any, omega: Any) -> None:
        parts = [
            *components(inertia, ("I1", "I2", "I3"), "The inertia", INERTIA),
            *components(field, ("B1", "B2", "B3"), "The field", RATE),
            *components(omega, ("omega1", "omega2", "omega3"), "The initial angular velocity", RATE),
        ]
        super().__init__(_single, *parts)
        self._of_each(lambda single: single.exact.kind)  # what is no motion is refused here
        self.inertia, self.field, self.omega = (tuple(plain(x) for x in parts[i : i + 3]) for i in (0, 3, 6))
        kept = (tuple(map(as_given, parts[i : i + 3])) for i in (0, 3, 6))
        self.arguments = dict(zip(("inertia", "field", "omega"), kept, strict=True))

    @kept
    def kind(self) -> Any:
        """Name of the kind of motion, a string, or an array of them."""
        return self._of_each(lambda single: single.exact.kind)

    @kept
    def H(self) -> Any:
        """H = (M, II^-1 M)/2 + (K, II K)/2, M = II (Omega + K), theorem-lie-poisson. DomainError beyond all floats."""
        return finite(self._of_each(lambda single: nearest(single.exact.H)), "H")

    @kept
    def F(self) -> Any:
        """Clebsch's F = M^2 - I1 I2 I3 (K, II^-1 K), theorem-clebsch. DomainError beyond all floats."""
        return finite(self._of_each(lambda single: nearest(single.exact.F)), "F")

    @kept
    def MK(self) -> Any:
        """The Casimir (M, K), |B'| times the canonical momentum along B. DomainError beyond all floats."""
        return finite(self._of_each(lambda single: nearest(single.exact.MK)), "(M, K)")

    @kept
    def energy(self) -> Any:
        """Kinetic energy (Omega, II Omega)/2 = H - (M, K), theorem-kinetic-energy. DomainError beyond all floats."""
        return finite(self._of_each(lambda single: nearest(single.exact.energy)), "The energy")

    @kept
    def agreement(self) -> Any:
        """What is known of the truth of the closed form, or why there is none: a sentence, or an array of them."""
        return self._of_each(lambda single: single.agreement)

    @kept
    def accuracy(self) -> Any:
        """Bound on errors of entries of R, and of Omega and K beside the largest rate, at any time.

        In closed form it is that of rounding, to first order, proved in cells that cover the torus, if exponentials and
        sines of the library are within an ulp; errors that were seen are some ten times smaller. Where `agreement` says
        that the formulas are not proved, it bounds rounding alone. Else it is that of a value that is rounded once.
        """
        return self._of_each(lambda single: single.accuracy)

    @kept
    def period(self) -> Any:
        """Period of Omega of a free body, of Omega and K of an elliptic motion, inf where they are constant.

        Of any other motion, which has `frequencies`, there is none, nor are there mean rates: DomainError for one
        motion, NaN for one of an array. Raises DomainError where it is beyond all floats.
        """
        return self._scalar("period")

    @kept
    def precession_rate(self) -> Any:
        """Mean rate of precession, about the momentum m, of the axis of a free body that m goes round, in rad/time.

        That is the axis of the least or of the largest moment, see `mode`; any other precesses by whole nutations more
        or less. Of an elliptic motion in a field it is that of `EllipticMotion`, about the field. Where two moments
        become equal it is |m|/I1, that of `FreeMotion`. On a separatrix, and where there is no period, there is none:
        DomainError for one motion, NaN for one of an array.
        """
        return self._scalar("precession_rate")

    @kept
    def spin_rate(self) -> Any:
        """Mean rate at which the body turns about the axis that m, or K, goes round: 2 pi over the period, with a sign.

        None where there is no `precession_rate`.
        """
        return self._scalar("spin_rate")

    @kept
    def mode(self) -> Any:
        """Axis that the momentum of a free body goes round, a string, or an array of them.

        "long axis", of the least moment; "short axis", of the largest; "separatrix", "ball" or "at rest". Raises
        DomainError in a field.
        """
        return self._of_each(lambda single: single.exact.mode)

    def _scalar(self, name: str) -> Any:
        return self._of_each(lambda single: scalar(single.exact, name, alone=not self.shape))

    @kept
    def frequencies(self) -> Any:
        """Angular frequencies (f1, f2, f3) of a motion, shape (..., 3), each rounded once from proven balls.

        On a torus M and K turn with f1 and f2, and R with f3 about B besides. It is a convention which basis f1, f2
        are, and f3 is one but for integer multiples of them: in a period the body turns by at most half a turn about B
        beside -B'. Of a free body, and of an elliptic motion, f1 = |spin_rate|, f2 = 0 and f3 = precession_rate.
        Raises DomainError for other motions.
        """
        frequencies = self._of_each(lambda single: floats(enclosed(lambda: single.exact.frequencies, BITS)))
        return np.asarray(finite(np.array(frequencies), "A frequency"))

    @property
    def curve(self) -> Any:
        """Spectral curve of one motion on a torus, with proven branch points, periods, frequencies, windings, actions.

        `curve.record(digits)` has all of it as texts of so many digits, also the rational coefficients, the Riemann
        matrix, and, not proved, the characteristics of the theta functions; see `SpectralCurve`. DomainError for
        a motion without a torus, AtlasError for an array of them.
        """
        from atlas.motions.torus.certified_spectral_curve import SpectralCurve

        if self.shape:
            raise AtlasError(f"A spectral curve is that of one motion, not of an array of them, of shape {self.shape}.")
        return SpectralCurve(self._of_each(lambda single: single.exact))

    @kept
    def riemann_matrix(self) -> Any:
        """Riemann matrix tau of the torus of type (1, 2), symmetric with Im tau > 0, shape (..., 2, 2).

        It is Siegel-reduced, so that theta series need few terms, and not proved; a part below 1e-35, which symmetry
        makes zero, is shown as zero. Raises AtlasError for motions without
        closed form.
        """
        return np.asarray(self._of_each(lambda single: single.theta.riemann_matrix))

    def angular_velocity(self, t: Any) -> FloatArray:
        """Angular velocity Omega(t) in the body; shape (..., 3).

        Raises AtlasError for a time that is not finite, NotCertifiedError where there is no proof.
        """
        return self._spun(self._evaluate(lambda single, t, out: single.angular_velocity(t, out), t, (3,)), t)

    def field_in_body(self, t: Any) -> FloatArray:
        """Field K(t) = R^T B' in the body; shape (..., 3).

        Raises AtlasError for a time that is not finite, NotCertifiedError where there is no proof.
        """
        return self._in_body(self._evaluate(lambda single, t, out: single.field_in_body(t, out), t, (3,)))

    def angular_momentum(self, t: Any) -> FloatArray:
        """Angular momentum m = R II Omega in the laboratory; shape (..., 3).

        Raises AtlasError for a time that is not finite, NotCertifiedError where there is no proof.
        """
        return self._momentum_of(lambda Omega: Omega * np.stack(np.broadcast_arrays(*self.inertia), -1), t)

    def _fill_grid(self, single: SingleAsymmetric, start: float, step: float, out: FloatArray) -> None:
        """Fill the matrices of one motion on a grid, at exact times."""
        (single.closed or single.certified).fill_grid(start, step, out)
        if step and (start / step).is_integer() and 0 <= -start / step < len(out):
            out[round(-start / step)] = np.eye(3)
