"""Motions of a symmetric top in a uniform field, from any start (not in the paper)."""

from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from atlas.arithmetic.annotations import BodyLike, FieldLike, FloatOrArray, RealArrayLike
from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.dimensions import INERTIA, LENGTH, MASS, RATE, SI_FIELDS
from atlas.arithmetic.double_double import exact_results, over
from atlas.arithmetic.given import exact_number
from atlas.arithmetic.inputs import FloatArray, as_given, components, finite, frozen_property, number, plain, positive
from atlas.arithmetic.numbers import Number, as_rational, length, nearest, rational, select, workprec
from atlas.bodies.body import SymmetricBody
from atlas.bodies.charge import ChargeMoments
from atlas.bodies.laboratory import anisotropy
from atlas.bodies.symmetric_top import inputs_of_top, moments_of_one, signed_weight
from atlas.bodies.units import system
from atlas.errors import AtlasError, DomainError
from atlas.motions.nutation.certified_top import TopMotion as Balls
from atlas.motions.nutation.certified_top_steady import SteadyPrecession
from atlas.motions.nutation.constants import FIRST_BITS
from atlas.motions.nutation.kernel import SymmetricMotion
from atlas.motions.nutation.rows import TopsAtTimes
from atlas.motions.nutation.rows_blocks import TopBlocks
from atlas.motions.nutation.rows_scalars import IN_ARRAYS, TOP_KINDS
from atlas.motions.nutation.single import BITS, SingleTop
from atlas.motions.start import Body, Start, of_moments
from atlas.surfaces.formula_top import constants, of_given
from atlas.surfaces.kernel import TopQuadric


def balls(*row: float) -> Balls:
    """Return the certified `TopMotion` of a ``row`` of eleven exact numbers.

    They are I2, I3, k2, k3, n2, n3, omega1, omega2, omega3, linear and quadratic.
    """
    with workprec(FIRST_BITS):
        return Balls(row[0:2], row[2:4], row[4:6], row[6:9], *row[9:])


def _constants(*row: float) -> list[float]:
    """Return [2 h, M3, p] of a top over I2, each rounded once: energy h, momenta M3 along the axis and p along n.

    The row is I2, I3, k2, k3, n2, n3, linear, quadratic, omega1, omega2, omega3.
    """
    with workprec():
        h, M3, p = map(nearest, balls(*row[:6], *row[8:], *row[6:8]).invariants)
    return [2 * h, M3, p]


def _in_plane(*numbers: Number) -> tuple[Number, ...]:
    """Return n2, n3, omega, and (cos, sin) of the rotation about e3 that makes n1 zero: a tuple of seven numbers.

    The ``numbers`` are n1, n2, n3, omega1, omega2, omega3, and 1; the results have their type.
    """
    n1, n2, n3, w1, w2, w3, unity = numbers
    size = length(n1, n2)
    unit = select(size, size, unity)
    c, s = select(size, n2 / unit, unity), n1 / unit
    return size, n3, c * w1 - s * w2, s * w1 + c * w2, w3, c, s


class TopMotion(SymmetricMotion[SingleTop]):
    """Motion of a symmetric top in a uniform field, from any start (not in the paper).

    The motion starts from R(0) = 1. With b = R^T n/|n| and M = I Omega + k b its equations are

        dM/dt = [M, Omega] + [k Omega - U'(nu) e3, b],     db/dt = [b, Omega].

    Parameters
    ----------
    inertia : (I2, I3), array_like
        Moments across and along the axis, 0 < I3 <= 2 I2.
    coupling : (k2, k3), array_like
        Gyroscopic coupling to the field, in inertia/time.
    direction : (n2, n3), array_like
        Constant vector n in the body at t = 0, of any length but zero; e1 is across n.
    omega : (omega1, omega2, omega3), array_like
        Initial angular velocity along the body's axes, in rad/time.
    linear, quadratic : float or array_like
        Coefficients of the potential U(nu) = linear nu + quadratic nu^2/2, nu = cos theta, in inertia/time^2.

    Raises
    ------
    DomainError
        If I3 is not in (0, 2 I2], or if n is zero.
    AtlasError
        For an input that is no finite number.

    Notes
    -----
    Inputs are taken as exact and broadcast with one another and with the times. `heavy` and `charged` make a top from
    physical data. Without a potential, k2/I2 = k3/I3 = |B'| is a `GeneralMotion`. Lagrange's heavy top has k2 = k3 = 0
    and linear = m g l. theta is the angle between the axis and n. `kind`, decided exactly, is one of

    - "at rest", "vertical spin" (a sleeping top), "steady precession": theta is constant;
    - "regular nutation": the polynomial of nu is a quadratic, and nu is a cosine of time;
    - "nutation, three real roots" of a cubic: elliptic functions of time;
    - "nutation, two real roots", "nutation, four real roots" of a quartic: elliptic functions of time;
    - "separatrix": nu tends to a double root;
    - "separatrix, triple root"; "separatrix between n and -n".

    The quartic is a cubic if k3^2/I3 - k2^2/I2 + quadratic = 0. The cost does not depend on t. Entries of R are within
    3.6e-15 for phases up to 2^50, Omega within 3.6e-15 of the largest rate. Arrays of tops at a few times each are
    vectorised. Tops next to a separatrix or nearly steady take some milliseconds each.

    Examples
    --------
    >>> top = atlas.TopMotion((1.0, 0.5), (0.0, 0.0), (0.6, 0.8), omega=(0.1, 0.2, 5.0), linear=3.0)
    >>> top.kind, round(top.period, 9)
    ('nutation, three real roots', 3.204092414)
    """

    family = "top"
    _in_arrays, _kinds = IN_ARRAYS, TOP_KINDS
    _blocks_of, _motions_of = TopBlocks, TopsAtTimes

    def __init__(
        self,
        inertia: BodyLike,
        coupling: RealArrayLike,
        direction: RealArrayLike,
        omega: RealArrayLike,
        linear: RealArrayLike = 0.0,
        quadratic: RealArrayLike = 0.0,
    ) -> None:
        *top, a0, A0 = inputs_of_top(inertia, coupling, direction, linear, quadratic)
        columns = [*top, *components(omega, ("omega1", "omega2", "omega3"), "The angular velocity", RATE), a0, A0]
        super().__init__(lambda *row: SingleTop(balls(*row)), *columns)
        self.inertia, self.coupling, self.direction, self.omega, (self.linear, self.quadratic) = (
            tuple(plain(x) for x in columns[i:j]) for i, j in ((0, 2), (2, 4), (4, 6), (6, 9), (9, 11))
        )
        names = ("inertia", "coupling", "direction", "omega", "linear", "quadratic")
        vectors = (tuple(map(as_given, columns[i:j])) for i, j in ((0, 2), (2, 4), (4, 6), (6, 9)))
        self.arguments = dict(zip(names, (*vectors, *map(as_given, columns[9:])), strict=True))

    @classmethod
    def heavy(
        cls,
        body: SymmetricBody,
        gravity: float,
        length: float,
        direction: RealArrayLike,
        omega: RealArrayLike,
        *,
        mass: float,
    ) -> Self:
        """Lagrange's top: a body under its weight, held at a point of its axis (not in the paper).

        Parameters
        ----------
        body : SymmetricBody
            Body with moments about its centre of mass.
        gravity : float
            Acceleration g >= 0, in length/time^2, in units that fit those of the moments, mass length^2.
        length : float
            Distance l from the fixed point to the centre of mass, along the axis.
        direction : (n2, n3), array_like
            Upward vertical in the body at t = 0.
        omega : (omega1, omega2, omega3), array_like
            Initial angular velocity, in rad/time.
        mass : float
            Mass m > 0.

        Returns
        -------
        TopMotion
            Top with the moment I2 + m l^2 across the axis and linear = m g l, both exact.

        Raises
        ------
        DomainError
            For a mass that is not positive, or a negative g.
        AtlasError
            For an input that is no body or no number.
        """
        I2, I3 = moments_of_one(body)
        m, l = positive(mass, "The mass", MASS), number(length, "The length", LENGTH)
        g = number(gravity, "The gravity g", "m / s**2")
        if g < 0:
            raise DomainError(f"The gravity g must not be negative, but is {g}: turn the direction round instead.")
        i2, m_, g_, l_ = map(rational, (I2, m, g, l))
        transverse, linear = map(exact_number, (i2 + m_ * l_ * l_, m_ * g_ * l_))
        return cls((transverse, I3), (0.0, 0.0), direction, omega, linear=linear)

    @classmethod
    def charged(
        cls,
        body: SymmetricBody,
        charges: ChargeMoments,
        field: FieldLike,
        omega: RealArrayLike,
        *,
        c: float = 1.0,
        units: str | None = None,
        moment: float = 0.0,
        polarizability: tuple[float, float] = (0.0, 0.0),
        susceptibility: float = 0.0,
        volume: float = 0.0,
        demagnetization: float = 1 / 3,
        weight: tuple[float, float] = (0.0, 0.0),
    ) -> Self:
        """Top whose charge is distributed differently from its mass, in the magnetic field (0, B2, B3).

        Parameters
        ----------
        body : SymmetricBody
            Moments of inertia: about the centre of mass, or about the fixed point of a held body.
        charges : ChargeMoments
            Second moments J2, J3 of the charge.
        field : (B2, B3), array_like
            Magnetic field B itself in the body's axes at t = 0, in T or G; no `Field`, which holds B'.
        omega : (omega1, omega2, omega3), array_like
            Initial angular velocity, in rad/time.
        c : float
            1 in SI, the speed of light in Gaussian units, as in `Field`; given instead of `units`.
        units : {"SI", "Gaussian"}, optional
            Units kg, m, C, T or g, cm, statC, G; results are in seconds.
        moment : float
            Magnetic moment d along the axis, with the energy -d |B| nu.
        polarizability : (float, float)
            Moments (a2, a3) that a unit field induces across and along the axis; the energy is -(a3 - a2) B^2 nu^2/2.
        susceptibility : float
            Magnetic susceptibility chi of an ellipsoid.
        volume : float
            Volume V of the ellipsoid.
        demagnetization : float
            Demagnetizing factor N along the axis of the ellipsoid.
        weight : (w2, w3)
            For a body held at the distance l from its centre of mass: vector of length m g l along the upward vertical,
            in the body's axes at t = 0 as `field`, to which it is parallel.

        Returns
        -------
        TopMotion
            Top with the coupling k_i = J_i |B|/(2c).

        Raises
        ------
        DomainError
            For B = 0, which is a `FreeMotion`, and for a weight that is not parallel to the field.
        AtlasError
            For an input that is no body or no number.

        Notes
        -----
        The ellipsoid has the polarizability V chi/(mu0 (1 + N chi)) along its axis, in SI, added to `polarizability`.
        Products and |B| are not rounded, except that of `volume` and `susceptibility`.
        """
        I2, I3 = moments_of_one(body)
        c = number(c, "c")
        if not isinstance(charges, ChargeMoments):
            raise AtlasError(f"The charges are ChargeMoments (of a shape, of points, or J2 and J3), not {charges!r}.")
        if units is not None and c != 1:
            raise AtlasError(f"Give units or c, not both: {units!r} implies c.")
        c = c if units is None else system(units).c
        if hasattr(field, "pair"):
            raise AtlasError("A charged top takes B itself, in the units that are said, not a Field, which has B'.")
        columns = components(field, ("B2", "B3"), "The field", SI_FIELDS["B"] if c == 1 else "")
        B2, B3 = (number(x, "A component of the field") for x in columns)
        if not (B2 or B3):
            raise DomainError("Without a field a charged top has no direction: it is a free body, FreeMotion.")
        with workprec():
            size = as_rational(length(rational(B2), rational(B3)))
        half = size / (2 * rational(positive(c, "c")))
        induced = components(polarizability, ("a2", "a3"), "The polarizability")
        a2, a3 = (rational(number(x, "A polarizability")) for x in induced)
        if susceptibility:
            a3 = a3 + rational(anisotropy(susceptibility, volume, demagnetization, c != 1))
        linear = signed_weight((B2, B3), weight) - rational(number(moment, "The moment", "J/T")) * size
        quadratic = (a2 - a3) * size * size
        coupling = [exact_number(rational(J) * half) for J in charges.exact]
        return cls((I2, I3), coupling, (B2, B3), omega, linear=exact_number(linear), quadratic=exact_number(quadratic))

    @frozen_property
    def stable(self) -> bool | NDArray[np.bool_]:
        """True if a motion with constant theta is stable, else False, theorem-top-nutation; None where theta varies.

        For an array of tops it is an array of these.

        Notes
        -----
        Stability is decided exactly. At its border the next derivatives of the potential decide.
        """
        return self._of_all("stable", lambda exact: exact.stable)

    @property
    def steady_precessions(self) -> list[SteadyPrecession]:
        """Steady precessions at the inclination and with the omega3 of this top, theorem-top-precession.

        Returns
        -------
        list of SteadyPrecession
            Records with `rate` about n, squared frequency `nutation` and `stable`; the smaller |rate + k2/I2| first.

        Raises
        ------
        DomainError
            Where every rate is a steady precession.
        AtlasError
            For an array of tops.

        Notes
        -----
        The rates solve I2 nu w^2 - M3 w + a + A nu = 0 with w = rate + k2/I2 and

            M3 = I3 omega3 + k3 nu,    a = M3 (k2/I2 - k3/I3) + linear,    A = k3^2/I3 - k2^2/I2 + quadratic.

        The list is empty where both are complex. One remains where both coincide or nu = 0. A start has omega1 = 0 and
        omega2 = rate n2/|n|. For an axis along n see `sleeping_bands`.
        """
        balls = enclosed(lambda: [tuple(x) for x in self._twin.steady_precessions], BITS)
        return [SteadyPrecession(nearest(rate), nearest(square), stable) for rate, square, stable in balls]

    @property
    def sleeping_bands(self) -> dict[str, tuple[float, float] | None]:
        """Intervals of omega3 in which the vertical top is unstable, theorem-sleeping-top: M3^2 < 4 I2 (a + A).

        Returns
        -------
        dict of str to (float, float) or None
            Bounds in rad/time for the axis along n, "upright", and against n, "hanging"; None if every spin is stable.

        Raises
        ------
        AtlasError
            For an array of tops.

        Notes
        -----
        M3, a and A are those of `steady_precessions`, with nu = 1, or -1 if hanging. "hanging" reverses the sign of
        a. For Lagrange's top the band is (I3 omega3)^2 < 4 I2 m g l. At its ends see `stable`.
        """
        balls = enclosed(lambda: list(self._twin.sleeping_bands.items()), BITS)
        return {name: band and (nearest(band[0]), nearest(band[1])) for name, band in balls}

    @property
    def _twin(self) -> Balls:
        """The certified motion of one top. Raises AtlasError for an array."""
        if self.shape:
            raise AtlasError("This is asked of one top: give its parameters as numbers, not as arrays.")
        return self._single().exact

    @property
    def quadric(self) -> TopQuadric:
        """Quadric of starts with nu'' = 0 of this top for any omega, theorem-top-quadric: a `TopQuadric`."""
        return TopQuadric(self.inertia, self.coupling, self.direction, self.linear, self.quadratic)

    @staticmethod
    def _body_of(inertia: Any) -> Body:
        """Return the `Body` with the moments (I2, I2, I3) along the axes of the class; ``inertia`` is (I2, I3)."""
        I2, I3 = components(inertia, ("I2", "I3"), "The inertia", INERTIA)
        return of_moments((I2, I2, I3), np.eye(3))

    @classmethod
    def _from_start(cls, start: Start, **parameters: Any) -> tuple[Any, FloatArray]:
        """Return (top, axes) from a `Start`; the rows of `axes` (..., 3, 3) are chosen so that n1 = 0.

        ``parameters`` are the coupling and the potential; the field of the start is n.
        """
        n, w = start.components_along(np.eye(3))
        axes: FloatArray = np.eye(3)
        if np.any(n[0]):
            n2, n3, w1, w2, w3, c, s = exact_results(_in_plane, *n, *w, 1.0, unit=slice(3, 6), count=7)
            n, w = [0.0, n2, n3], [w1, w2, w3]
            zero, unity, c, s = np.broadcast_arrays(0.0, 1.0, np.asarray(c), np.asarray(s))
            axes = np.moveaxis(np.array([[c, -s, zero], [s, c, zero], [zero, zero, unity]]), (0, 1), (-2, -1))
        I = start.body.moments
        return cls((plain(I[..., 1]), plain(I[..., 2])), direction=n[1:], omega=w, **parameters), axes

    def _inputs_of(self, i: int) -> Any:
        """Return the `Inputs` of the i-th motion, see `of_top`."""
        from atlas.motions.nutation.derivatives_inputs import of_top

        return of_top(self._row(i))

    def angular_momentum(self, t: RealArrayLike) -> FloatArray:
        """Canonical momentum R (I Omega + k b)/I2 in the laboratory, whose component along n is constant.

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Components of M/I2, in rad/time.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        return self._momentum_of(lambda _: self._momentum(t), t, "M/I2")

    def invariants(self, t: RealArrayLike | None = None) -> dict[str, FloatOrArray]:
        """Constants of the motion divided by I2: energy h, M3 along the axis and p = (M, n) along the unit vector n.

        Parameters
        ----------
        t : array_like, optional
            Times at which the constants are evaluated from Omega(t) and b(t), as a check. By default the exact inputs
            are used.

        Returns
        -------
        dict of str to float or ndarray
            "h" in 1/time^2, "M3" and "p" in 1/time; from the inputs each is rounded once.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        if t is None:
            *top, w1, w2, w3, a0, A0 = self._inputs
            inputs = *top, a0, A0, w1, w2, w3
            twice, M3, p = map(plain, over(of_given(constants), *inputs, degree=(1, 1, 1), scalar_path=_constants))
            return {"h": finite(twice / 2, "h"), "M3": M3, "p": p}
        Omega, b = map(self._along_class, (self.angular_velocity(t), self.field_in_body(t)))
        M = self._momentum(t)
        (I2, I3), nu = self.inertia, b[..., 2]
        spinning = Omega[..., 0] ** 2 + Omega[..., 1] ** 2 + I3 / I2 * Omega[..., 2] ** 2
        h = spinning / 2 + (self.linear * nu + self.quadratic * nu * nu / 2) / I2
        return {"h": finite(plain(h), "h"), "M3": plain(M[..., 2]), "p": plain((M * b).sum(-1))}

    def _momentum(self, t: Any) -> FloatArray:
        """Return the canonical momentum M/I2 along the axes of the class at times t, shape (..., 3), in rad/time."""
        (I2, I3), (k2, k3) = self.inertia, self.coupling
        return np.asarray(
            self._along_class(self.angular_velocity(t)) * np.stack(np.broadcast_arrays(1.0, 1.0, I3 / I2), -1)
            + self._along_class(self.field_in_body(t)) * np.stack(np.broadcast_arrays(k2 / I2, k2 / I2, k3 / I2), -1)
        )
