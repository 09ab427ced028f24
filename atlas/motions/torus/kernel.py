"""Any motion of a charged body with three different moments of inertia (not in the paper)."""

from collections.abc import Callable
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from atlas.arithmetic.annotations import BodyLike, FieldLike, FloatOrArray, NameOrArray, RealArrayLike
from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.dimensions import INERTIA, RATE
from atlas.arithmetic.inputs import FloatArray, as_given, components, finite, frozen_property, plain, real
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import nearest
from atlas.arithmetic.rotation import IDENTITY, target
from atlas.arithmetic.words import floats
from atlas.errors import AtlasError, DomainError, NotCertifiedError
from atlas.motions.base import Motion
from atlas.motions.nutation.certified_elliptic import EllipticMotion, EulerTop
from atlas.motions.nutation.kernel import scalar
from atlas.motions.nutation.single_elliptic import SingleElliptic, SingleEulerTop
from atlas.motions.spectrum import Wheels
from atlas.motions.start import Start
from atlas.motions.torus.certified import AsymmetricMotion as Balls
from atlas.motions.torus.certified_torus import frequencies
from atlas.motions.torus.rounded import Certified
from atlas.motions.torus.theta import MAX_ROUNDING, ThetaKernel, closed_form

if TYPE_CHECKING:
    from atlas.motions.torus.certified_spectral_curve import SpectralCurve

BITS = 60
"""Relative accuracy of a frequency before it is rounded, once."""

MOTION_CACHE_SIZE = 16
"""Size of the cache of motions with their closed forms."""

CHECK_TIMES = (5.3, -61.7, 2.9e5, -8.1e11)
"""Times, over the largest rate, at which a closed form is held against the certified twin; the last if it is proved."""

DIRECT_CHECKS = 2
"""Of them those that need no proven periods: all that are taken where these are long."""

MAX_DIFFERENCE = 1e-14
"""Largest difference of an accepted closed form from the certified twin."""

BESIDE = ("ball", "symmetric body")
"""Kinds that `BallMotion` and `GeneralMotion` answer."""


MAX_TERM = 4
"""Largest integer in a change of the basis of frequencies that is tried."""


def in_basis_near(frequencies: list[float], reference: list[float]) -> list[float]:
    """Return [f1, f2, f3] of a torus in the basis nearest to ``reference``, the three frequencies of another torus."""
    f1, f2, f3 = frequencies
    integers = np.arange(-MAX_TERM, MAX_TERM + 1)
    a, b = (x.ravel() for x in np.meshgrid(integers, integers))
    combined = a * f1 + b * f2
    distance = abs(combined - reference[0])[:, None] + abs(combined - reference[1])
    is_basis = abs(a[:, None] * b - b[:, None] * a) == 1
    first, second = np.unravel_index(np.where(is_basis, distance, np.inf).argmin(), distance.shape)
    nearest_multiple = combined[abs(f3 + combined - reference[2]).argmin()]
    return [combined[first], combined[second], f3 + nearest_multiple]


class SingleAsymmetric:
    """Evaluator of one motion: the closed form if available, else balls rounded once.

    ``exact`` is the certified motion, `size` the largest component of field and omega, in 1/time, 1 if all are zero.
    Methods take times of any shape.
    """

    def __init__(self, exact: Balls) -> None:
        self.exact = exact
        self.size = max(map(nearest, map(abs, (*exact.field, *exact.omega)))) or 1.0
        self.certified = Certified(exact, self.size)

    @cached_property
    def _candidate(self) -> tuple[ThetaKernel | SingleElliptic | None, str]:
        """Tuple (closed form, not yet compared, or None; its proof status, or why there is none, a string).

        The string is empty for theta functions, whose status `_choice` finds.
        """
        elliptic = self.exact.elliptic
        if elliptic is not None:
            return self._elliptic(elliptic)
        try:
            return closed_form(self.exact, self.size), ""
        except NotCertifiedError as reason:
            return None, f"certified at each time: {str(reason).removeprefix('not certified: ')}"

    @cached_property
    def _choice(self) -> tuple[ThetaKernel | SingleElliptic | None, str]:
        """Tuple (closed form if proved or in agreement with the balls, else None; its proof status, a string)."""
        closed, status = self._candidate
        if closed is None or isinstance(closed, SingleElliptic):
            return closed, status
        on_torus = self.exact.on_torus
        count = DIRECT_CHECKS if on_torus is not None and on_torus.torus.is_long else len(CHECK_TIMES)
        times = [t / self.size for t in (CHECK_TIMES[:count] if closed.proved is None else CHECK_TIMES[-1:])]
        differences: list[float] = []
        for t in times:
            try:
                differences.append(self._difference(closed, t))
            except NotCertifiedError as reason:  # its periods are too long to be proved
                if not differences:
                    return None, f"certified at each time: {str(reason).removeprefix('not certified: ')}"
                break
        largest, times = max(differences), times[: len(differences)]
        if not largest <= min(closed.accuracy, MAX_DIFFERENCE):
            return None, f"certified at each time: theta functions differ from the certified twin by {largest:.1e}."
        status = (
            f"not proved; agrees with the certified twin within {largest:.1e} at {len(times)} times up to |t| = "
            f"{max(map(abs, times)):.3g}"
            if closed.proved is None
            else f"proved for this motion, at all times within {closed.proved:.1e}"
        )
        return closed, f"{status}; rounding adds {closed.accuracy:.1e} at most"

    def _elliptic(self, exact: EllipticMotion) -> tuple[SingleElliptic | None, str]:
        """Return (`SingleElliptic` of the motion ``exact``, its proof status), or (None, why none is used)."""
        try:
            if isinstance(exact, EulerTop):
                single: SingleElliptic = SingleEulerTop(exact, floats(self.exact.field))
            else:
                single = SingleElliptic(exact)
            single.pair  # noqa: B018  raises DomainError outside the range of floats
        except DomainError:  # next to the line about which its axis turns
            return None, "certified at each time: Jacobi's functions are too small for a float."
        is_slender = not single.accuracy(self.size) <= MAX_ROUNDING
        balls = ", and Omega, of so slender a body, is certified at each time" if is_slender else ""
        adds = single.accuracy(self.size, has_omega=not is_slender)
        return single, f"proved for this motion, at all times; rounding adds {adds:.1e} at most{balls}"

    def _difference(self, closed: ThetaKernel, t: float) -> float:
        """Return the largest difference of R, K and Omega, rates over `size`, between closed form and balls at t."""
        pairs = (
            (x.rotation(t), x.field_in_body(t) / self.size, x.angular_velocity(t) / self.size)
            for x in (closed, self.certified)
        )
        return float(max(np.abs(x - y).max() for x, y in zip(*pairs, strict=True)))

    @property
    def closed(self) -> ThetaKernel | SingleElliptic | None:
        """`ThetaKernel` or `SingleElliptic` of the motion if proved or in agreement with the balls; else None.

        Theta functions with a small misfit are returned before they are compared; once `agreement` is known, that
        decides.
        """
        closed, _ = self._candidate
        if closed is None or isinstance(closed, SingleElliptic) or (closed.fits and "_choice" not in vars(self)):
            return closed
        return self._choice[0]

    def approximate_frequencies(self) -> list[float]:
        """Return [f1, f2, f3] in rad/time from theta functions, not proved; without these, certified ones, rounded."""
        if not isinstance(self.closed, ThetaKernel):
            return [nearest(f) for f in enclosed(lambda: self.exact.frequencies, BITS)]
        periods, rate = [p.least() for p in self.closed.periods], self.closed.rate
        return [nearest(f) * rate for f in frequencies(periods, self.closed.constants.b)]

    @property
    def theta(self) -> ThetaKernel:
        """The `ThetaKernel`, closed form by theta functions. Raises AtlasError where there is none."""
        if not isinstance(self.closed, ThetaKernel):
            raise AtlasError(f"The motion has no theta functions of two variables; it is {self.agreement}")
        return self.closed

    @property
    def accuracy(self) -> float:
        """Bound on rounding errors: of R, and of K and Omega over the largest rate `size`.

        Without a closed form it is 2^-52.
        """
        if isinstance(self.closed, SingleElliptic):
            return self.closed.accuracy(self.size, has_omega=not self._slender)
        return self.closed.accuracy if self.closed else 2.0**-52

    @property
    def _slender(self) -> bool:
        """Whether Jacobi's functions would lose digits of Omega, which has a large factor along an axis."""
        return isinstance(self.closed, SingleElliptic) and not self.closed.accuracy(self.size) <= MAX_ROUNDING

    @property
    def agreement(self) -> str:
        """Proof status of the closed form, or the reason why none is used, as a sentence."""
        return self._choice[1]

    def rotation(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return R(t), body to laboratory, shape t.shape + (3, 3); exactly 1 at t = 0.

        ``out``, if given, is filled and returned.
        """
        return self._started("rotation", (3, 3), lambda: IDENTITY, t, out)

    def column(self, j: int, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the column R_j(t), j = 1, 2, 3, shape t.shape + (3,); exact at t = 0.

        ``out``, if given, is filled and returned.
        """
        return self._started("column", (3,), lambda: IDENTITY[j - 1], t, out, j)

    def quaternion(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the quaternion (x, y, z, w) of R(t), continuous in t with w >= 0 at t = 0, shape t.shape + (4,).

        ``out``, if given, is filled and returned.
        """
        return self._started("quaternion", (4,), lambda: np.eye(4)[3], t, out)

    def angular_velocity(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the angular velocity Omega(t) along the body's axes, shape t.shape + (3,), in rad/time.

        At t = 0 it is exactly the initial one. The result is written into ``out`` if given.
        """
        return self._started("angular_velocity", (3,), lambda: floats(self.exact.omega), t, out)

    def field_in_body(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return K(t) along the body's axes, shape t.shape + (3,), in 1/time; exactly the initial one at t = 0.

        ``out``, if given, is filled and returned.
        """
        return self._started("field_in_body", (3,), lambda: floats(self.exact.field), t, out)

    def _started(
        self, name: str, shape: tuple[int, ...], start: Callable[[], FloatArray], t: Any, out: FloatArray | None,
        *column_number: int,
    ) -> FloatArray:  # fmt: skip
        """Return the function ``name`` at times t, shape t.shape + ``shape``, exactly start() at t = 0.

        The values are those of the closed form, else of balls. ``column_number`` is the first argument of "column".
        ``out``, if given, is filled and returned.
        """
        times = real(t, "The time")
        moving = np.count_nonzero(times)
        if moving:
            balls = self.closed is None or (name == "angular_velocity" and self._slender)
            values: FloatArray = getattr(self.certified if balls else self.closed, name)(*column_number, t, out)
        else:
            values = target(out, times.shape + shape)
        if moving < times.size:
            values[times == 0] = start()
        return values


@lru_cache(maxsize=MOTION_CACHE_SIZE)
def _single(*row: Any) -> SingleAsymmetric:
    """Return the `SingleAsymmetric` of a ``row`` of nine exact numbers, three moments, field and omega; cached."""
    return SingleAsymmetric(Balls(row[:3], row[3:6], row[6:]))


def forget() -> None:
    """Clear the cache of single motions, the evaluators that `AsymmetricMotion` keeps."""
    _single.cache_clear()


class AsymmetricMotion(Motion[SingleAsymmetric]):
    """Motion of a charged body with any inertia tensor, from any start, theorem-clebsch (not in the paper).

    The motion starts from R(0) = 1. The body is Clebsch's integrable case: M = II (Omega + K) and the field K = R^T B'
    in the body move on a torus with two commuting flows.

    Parameters
    ----------
    inertia : (I1, I2, I3), array_like
        Principal moments, positive, the largest at most the sum of the others.
    field : (B1, B2, B3), array_like, or Field
        Components of B' along the principal axes at t = 0, in 1/time.
    omega : (omega1, omega2, omega3), array_like
        Initial angular velocity along the principal axes, in rad/time.

    Raises
    ------
    DomainError
        For moments that no body has.
    NotCertifiedError
        If a value cannot be proved; a subclass of AtlasError.
    AtlasError
        For an input that is no finite number.

    Notes
    -----
    Inputs are taken as exact and broadcast with one another and with the times. `kind` is one of

    - "at rest", "spin about an axis", "Euler's top" (free), "ball", "symmetric body";
    - "on a torus": the general case;
    - "elliptic motion": the torus shrinks to a curve, see `EllipticMotion`;
    - "on the discriminant": other states without two periods; certified up to a time that the error states.

    On a torus M, K and the attitude are quotients of theta functions of two variables. The first time takes a second or
    two, of a slender body ten or more, each further time two microseconds. `agreement` states whether the formulas are
    proved for this motion. `accuracy` bounds the rounding: of Omega and K relative to the largest component of B' and
    of the initial Omega, so that an Omega far below |B'| has fewer digits. Euler's top, a spin about an axis and an
    elliptic motion use Jacobi's functions. Without a closed form every value is certified and rounded once, in tenths
    of a second. For certified digits see `atlas.motions.torus.certified`.

    Charge is distributed like mass. The moment that the field induces in the body is neglected. For a micrometre of
    glass in some tesla the induced moment exceeds the retained square of the field by a factor 1e5.

    Examples
    --------
    >>> atlas.AsymmetricMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), omega=(0.3, 0.7, 0.2)).kind
    'on a torus'
    """

    family = "asymmetric"

    def __init__(self, inertia: BodyLike, field: FieldLike, omega: RealArrayLike) -> None:
        columns = [
            *components(inertia, ("I1", "I2", "I3"), "The inertia", INERTIA),
            *components(field, ("B1", "B2", "B3"), "The field", RATE),
            *components(omega, ("omega1", "omega2", "omega3"), "The initial angular velocity", RATE),
        ]
        super().__init__(_single, *columns)
        self._of_each(lambda single: single.exact.kind)  # inputs of no motion are refused here
        rounded, exact = tuple(map(plain, columns)), tuple(map(as_given, columns))
        self.inertia, self.field, self.omega = rounded[:3], rounded[3:6], rounded[6:]
        self.arguments = {"inertia": exact[:3], "field": exact[3:6], "omega": exact[6:]}

    @frozen_property
    def kind(self) -> NameOrArray:
        """Type of the motion, "on a torus" or another of the class's Notes: a string, or an array of strings."""
        return self._of_each(lambda single: single.exact.kind)

    @frozen_property
    def H(self) -> FloatOrArray:
        """Integral H = (M, II^-1 M)/2 + (K, II K)/2 with M = II (Omega + K), theorem-lie-poisson, in inertia/time^2.

        Raises
        ------
        DomainError
            If the value exceeds the largest float.
        """
        return finite(self._of_each(lambda single: nearest(single.exact.H)), "H")

    @frozen_property
    def F(self) -> FloatOrArray:
        """Clebsch's integral F = M^2 - I1 I2 I3 (K, II^-1 K), theorem-clebsch, in inertia^2/time^2.

        Raises
        ------
        DomainError
            If the value exceeds the largest float.
        """
        return finite(self._of_each(lambda single: nearest(single.exact.F)), "F")

    @frozen_property
    def MK(self) -> FloatOrArray:
        """Casimir (M, K): |B'| times the canonical momentum along B', in inertia/time^2.

        Raises
        ------
        DomainError
            If the value exceeds the largest float.
        """
        return finite(self._of_each(lambda single: nearest(single.exact.MK)), "(M, K)")

    @frozen_property
    def energy(self) -> FloatOrArray:
        """Kinetic energy (Omega, II Omega)/2 = H - (M, K), theorem-kinetic-energy, in inertia/time^2.

        Raises
        ------
        DomainError
            If the value exceeds the largest float.
        """
        return finite(self._of_each(lambda single: nearest(single.exact.energy)), "The energy")

    @frozen_property
    def agreement(self) -> NameOrArray:
        """Proof status of the closed form, or why none is used: a sentence, or an array of sentences."""
        return self._of_each(lambda single: single.agreement)

    @frozen_property
    def accuracy(self) -> FloatOrArray:
        """Bound on the errors of R, at any time, and of Omega and K relative to the largest rate, see the class.

        Notes
        -----
        For a closed form the bound is that of rounding, to first order, proved on cells that cover the torus. The
        library's exponentials and sines are assumed within one ulp. Where `agreement` states no proof, the bound
        covers rounding alone. Without a closed form the bound is that of one rounding.
        """
        return self._of_each(lambda single: single.accuracy)

    @frozen_property
    def period(self) -> FloatOrArray:
        """Period of Omega for a free body, of Omega and K for an elliptic motion; of nutation for a symmetric body.

        Raises
        ------
        DomainError
            For any other single motion of a body without two equal moments, which has `frequencies`; an array has NaN.
        """
        return self._scalar("period")

    @frozen_property
    def precession_rate(self) -> FloatOrArray:
        """Mean rate of precession, in rad/time: of a free body about m, of an elliptic motion about the field.

        Raises
        ------
        DomainError
            On a separatrix and without a period, for one motion; an array has NaN there.

        Notes
        -----
        The precessing axis is that of `mode`. Other axes precess by additional full nutations. As two moments become
        equal, the rate tends to |m|/I1 of `FreeMotion`.
        """
        return self._scalar("precession_rate")

    @frozen_property
    def spin_rate(self) -> FloatOrArray:
        """Mean rate of rotation about the axis that m or K circles: 2 pi/`period` with a sign, in rad/time.

        Raises
        ------
        DomainError
            Where `precession_rate` is undefined.
        """
        return self._scalar("spin_rate")

    @frozen_property
    def mode(self) -> NameOrArray:
        """Axis that the momentum of a free body circles: a string, or an array of strings.

        Raises
        ------
        DomainError
            In a field.

        Notes
        -----
        "long axis" (least moment), "short axis" (largest moment), "separatrix", "ball" or "at rest".
        """
        return self._of_each(lambda single: single.exact.mode)

    def _scalar(self, name: str) -> FloatOrArray:
        return self._of_each(lambda single: scalar(single.exact, name, strict=not self.shape))

    @frozen_property
    def frequencies(self) -> FloatArray:
        """Angular frequencies (f1, f2, f3), shape (..., 3), in rad/time, each rounded once from certified balls.

        Raises
        ------
        DomainError
            For motions without frequencies.

        Notes
        -----
        On a torus M and K have the frequencies f1 and f2; R has f3, about B', in addition. The basis f1, f2 is a
        convention, and f3 is defined up to integer multiples of both: seen from the frame that rotates with -B',
        the body turns about B' by at most half a turn in each of the two periods of the torus. For a free body and
        an elliptic motion f1 = |spin_rate|, f2 = 0 and f3 = precession_rate.
        """
        frequencies = self._of_each(lambda single: floats(enclosed(lambda: single.exact.frequencies, BITS)))
        return np.asarray(finite(np.array(frequencies), "A frequency"))

    def _frequencies_near(self, reference: list[float]) -> FloatArray:
        """Return f1, f2, f3, shape (..., 3), in rad/time, not proved, in the basis nearest to `reference`.

        A torus has f1 and f2 but for integer combinations of determinant 1 or -1, and f3 but for multiples of both.
        """
        return np.asarray(self._of_each(lambda single: in_basis_near(single.approximate_frequencies(), reference)))

    @classmethod
    def _from_start(cls, start: Start) -> tuple[Any, FloatArray] | None:  # type: ignore[override]
        """Return (motion, its principal axes as rows (..., 3, 3)) from a `Start`, ``start``.

        None for a body with two equal moments.
        """
        axes = start.body.axes
        return None if start.is_symmetric else (cls(start.moments, *start.components_along(axes)), axes)

    def _inputs_of(self, i: int) -> Any:
        """Return the `Inputs` of the i-th motion, see `of_asymmetric`."""
        from atlas.motions.torus.derivatives_inputs import of_asymmetric

        return of_asymmetric(self._single(i))

    def _dynamics(self) -> Any:
        """Return (moments (3,), coupling (3,), linear, quadratic) of one motion as a top: the coupling is the moments.

        The coefficients of the potential, linear and quadratic, are 0.
        """
        J = np.array(self.inertia)
        return J, J, 0.0, 0.0

    def _wheels(self) -> Wheels:
        """Return the `Wheels` of one motion: with two phases on a torus, else with one or none.

        Raises DomainError for a motion without a closed form.
        """
        from atlas.motions.elementary.kernel_ball import BallMotion
        from atlas.motions.nutation.kernel_general import GeneralMotion
        from atlas.motions.nutation.spectrum import of_nutation
        from atlas.motions.torus.spectrum import of_torus

        single = self._single()
        if isinstance(single.closed, ThetaKernel):
            return of_torus(single.exact, single.closed, *self._sides)
        if single.exact.kind in BESIDE:
            family: Any = BallMotion if single.exact.kind == BESIDE[0] else GeneralMotion
            wheels: Wheels = family.in_laboratory(self.inertia, self.field, np.eye(3), self.omega)._wheels()  # noqa: SLF001
            return wheels
        if single.closed is None:
            raise DomainError(f"The motion has no lines in closed form: it is {single.exact.kind}, {single.agreement}")
        return of_nutation(self, single.closed.exact)

    @property
    def curve(self) -> "SpectralCurve":
        """Spectral curve of one motion on a torus, with certified branch points, periods, frequencies and actions.

        Returns
        -------
        SpectralCurve
            ``curve.record(digits)`` has all values as text with certified digits.

        Raises
        ------
        DomainError
            For a motion without a torus.
        AtlasError
            For an array of motions.

        Notes
        -----
        The record also holds the characteristics of the theta functions, which are not certified.
        """
        from atlas.motions.torus.certified_spectral_curve import SpectralCurve

        if self.shape:
            raise AtlasError(f"A spectral curve is that of one motion, not of an array of them, of shape {self.shape}.")
        return SpectralCurve(self._single().exact)

    @frozen_property
    def riemann_matrix(self) -> NDArray[np.complex128]:
        """Riemann matrix tau of the torus of type (1, 2), symmetric with Im tau > 0; shape (..., 2, 2).

        Raises
        ------
        AtlasError
            For motions without a closed form by theta functions.

        Notes
        -----
        The matrix is Siegel-reduced and not certified. Parts below 1e-35, zero by symmetry, are shown as zero.
        """
        return np.asarray(self._of_each(lambda single: single.theta.riemann_matrix))

    def field_in_body(self, t: RealArrayLike) -> FloatArray:
        """Field K(t) = R^T B' in the body, eq. (32).

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Components of K, in 1/time.

        Raises
        ------
        AtlasError
            For a time that is not finite.
        NotCertifiedError
            Where no proof is found.
        """
        return self._in_body(self._evaluate(lambda single, t, out: single.field_in_body(t, out), t, (3,)))

    def angular_momentum(self, t: RealArrayLike) -> FloatArray:
        """Angular momentum m = R II Omega in the laboratory.

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Components of m, in inertia/time.

        Raises
        ------
        AtlasError
            For a time that is not finite.
        NotCertifiedError
            Where no proof is found.
        """
        return self._momentum_of(lambda Omega: Omega * np.stack(np.broadcast_arrays(*self.inertia), -1), t)

    def _fill_grid(self, single: SingleAsymmetric, start: float, step: float, out: FloatArray) -> None:
        """Fill ``out`` (count, 3, 3) with R of one motion at times start + i step; exactly 1 at t = 0.

        ``single`` is the motion's evaluator.
        """
        (single.closed or single.certified).fill_grid(start, step, out)
        if step and (start / step).is_integer() and 0 <= -start / step < len(out):
            out[round(-start / step)] = np.eye(3)
