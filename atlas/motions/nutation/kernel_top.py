"""Motions of a symmetric top in a uniform field, from any start (not in the paper)."""

from typing import Any, Self

import numpy as np

from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.dimensions import LENGTH, MASS, RATE, SI_FIELDS
from atlas.arithmetic.double_double import over
from atlas.arithmetic.given import exact_number
from atlas.arithmetic.inputs import FloatArray, as_given, components, finite, kept, number, plain, positive
from atlas.arithmetic.numbers import as_rational, length, nearest, rational, workprec
from atlas.bodies.body import SymmetricBody
from atlas.bodies.charge import ChargeMoments
from atlas.bodies.laboratory import anisotropy
from atlas.bodies.symmetric_top import along, inputs_of_top, moments_of_one
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
from atlas.surfaces.formula_top import constants, of_given
from atlas.surfaces.kernel import TopQuadric


def balls(*row: float) -> Balls:
    """Return one motion as balls: I2, I3, k2, k3, n2, n3, the three components of omega, linear, quadratic."""
    with workprec(FIRST_BITS):
        return Balls(row[0:2], row[2:4], row[4:6], row[6:9], *row[9:])


def _constants(*row: float) -> list[float]:
    """Return twice the energy, M3 and p of I2, I3, k2, k3, n2, n3, linear, quadratic and omega, each rounded once."""
    with workprec():
        h, M3, p = map(nearest, balls(*row[:6], *row[8:], *row[6:8]).invariants)
    return [2 * h, M3, p]


class TopMotion(SymmetricMotion[SingleTop]):
    """Motion R(t), R(0) = 1, of a symmetric top in a uniform field, from any start (not in the paper).

    `inertia` (I2, I3) across and along the axis; `coupling` (k2, k3), so that M = I Omega + k b, in the unit of inertia
    by that of time; `direction` (n2, n3) of the constant vector n in the body at t = 0, of any length but zero: b =
    R^T n/|n|, and e1 is across n; `omega` = (omega1, omega2, omega3) the initial angular velocity, in 1/time; `linear`
    and `quadratic` give the potential U(nu) = linear nu + quadratic nu^2/2, nu = cos theta the cosine between the axis
    and n, in the unit of inertia by that of time squared. The inputs are taken as exact and broadcast with one another
    and with t. The equations are

        dM/dt = [M, Omega] + [k Omega - U'(nu) e3, b],     db/dt = [b, Omega].

    `GeneralMotion` is k2/I2 = k3/I3 = |B'| without a potential, Lagrange's heavy top k2 = k3 = 0, linear = m g l.
    `heavy` and `charged` make a top from what a user has in hand. nu moves between two roots of a quartic, a cubic if
    A = k3^2/I3 - k2^2/I2 + quadratic is zero; `kind` is one of

    - "at rest", "vertical spin" (a sleeping top), "steady precession": theta is constant;
    - "regular nutation": a quadratic, nu is a cosine of time; "nutation, three real roots" of a cubic, "nutation, two
      real roots" or "four real roots" of a quartic: elliptic functions of time;
    - "separatrix": nu tends to a double root; "separatrix, triple root"; "separatrix between n and -n".

    Which it is, is decided exactly. The cost does not depend on t. Arrays of tops at a few times each are evaluated
    without a loop; those next to a separatrix, nearly steady, or with rates of very different sizes are made one by
    one, some milliseconds each. Entries of R are within 3.6e-15 for phases up to 2^50, Omega within 3.6e-15 of the
    largest rate.
    Raises DomainError if I3 is not in (0, 2 I2] or if n is zero; AtlasError for what is no finite number.

        >>> top = atlas.TopMotion((1.0, 0.5), (0.0, 0.0), (0.6, 0.8), omega=(0.1, 0.2, 5.0), linear=3.0)
        >>> top.kind, round(top.period, 9)
        ('nutation, three real roots', 3.204092414)
    """

    family = "top"
    _in_arrays, _kinds = IN_ARRAYS, TOP_KINDS
    _blocks_of, _motions_of = TopBlocks, TopsAtTimes

    def __init__(
        self, inertia: Any, coupling: Any, direction: Any, omega: Any, linear: Any = 0.0, quadratic: Any = 0.0
    ) -> None:
        *top, a0, A0 = inputs_of_top(inertia, coupling, direction, linear, quadratic)
        parts = [*top, *components(omega, ("omega1", "omega2", "omega3"), "The angular velocity", RATE), a0, A0]
        super().__init__(lambda *row: SingleTop(balls(*row)), *parts)
        self.inertia, self.coupling, self.direction, self.omega, (self.linear, self.quadratic) = (
            tuple(plain(x) for x in parts[i:j]) for i, j in ((0, 2), (2, 4), (4, 6), (6, 9), (9, 11))
        )
        names = ("inertia", "coupling", "direction", "omega", "linear", "quadratic")
        kept = (tuple(map(as_given, parts[i:j])) for i, j in ((0, 2), (2, 4), (4, 6), (6, 9)))
        self.arguments = dict(zip(names, (*kept, *map(as_given, parts[9:])), strict=True))

    @classmethod
    def heavy(
        cls, body: SymmetricBody, gravity: float, length: float, direction: Any, omega: Any, *, mass: float
    ) -> Self:
        """Lagrange's top: a body held at a point of its axis, under its weight.

        `body` with its moments about the centre of mass, which lies at `length` along the axis from the fixed point;
        `gravity` g >= 0 and `mass`, in the units of the moments; `direction` (n2, n3) points up, against gravity. The
        moment across the axis is I2 + m l^2, and linear = m g l, exactly.
        Raises AtlasError for what is no body or no number, DomainError for a mass that is not positive or a negative g.
        """
        I2, I3 = moments_of_one(body)
        m, l = positive(mass, "The mass", MASS), number(length, "The length", LENGTH)
        g = number(gravity, "The gravity g", "m / s**2")
        if g < 0:
            raise DomainError(f"The gravity g must not be negative, but is {g}: turn the direction round instead.")
        i2, m_, g_, l_ = (rational(float(x)) for x in (I2, m, g, l))
        across, linear = map(exact_number, (i2 + m_ * l_ * l_, m_ * g_ * l_))
        return cls((across, I3), (0.0, 0.0), direction, omega, linear=linear)

    @classmethod
    def charged(
        cls,
        body: SymmetricBody,
        charges: ChargeMoments,
        field: Any,
        omega: Any,
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
        """Top of a body whose charges are spread in another way than its mass, in the magnetic field (0, B2, B3).

        `field` = (B2, B3) is B itself; `units`, "SI" (kg, m, C, T) or "Gaussian" (g, cm, statC, G), say what `c` is: 1
        in SI, the speed of light in Gaussian units, as in `Field`; results are in seconds. k_i = J_i |B|/(2c). `moment`
        d is a magnetic moment along the axis, with the energy -d |B| nu; `polarizability` (a2, a3), moments induced
        across and along the axis by a unit field, gives -(a3 - a2) B^2 nu^2/2; an ellipsoid of `volume` V,
        `susceptibility` chi and factor N of `demagnetization` along its axis has V chi/(mu0 (1 + N chi)) along it, in
        SI, and adds its own. `weight` = (w2, w3), parallel to the field, is m g l along the upward vertical of a body
        held at a point, at the distance l from the centre of mass; its moments are then those about that point.
        Products and |B| are not rounded, but for that of `volume`
        and `susceptibility`. Raises AtlasError for what is no body or no number, DomainError for B = 0, where there is
        no direction: use `FreeMotion`; and for a weight that is not parallel to the field: two directions are no top.
        """
        I2, I3 = moments_of_one(body)
        if not isinstance(charges, ChargeMoments):
            raise AtlasError(f"The charges are ChargeMoments (of a shape, of points, or J2 and J3), not {charges!r}.")
        if units is not None and c != 1:
            raise AtlasError(f"Give units or c, not both: {units!r} says what c is.")
        c = c if units is None else system(units).c
        if hasattr(field, "pair"):
            raise AtlasError("A charged top takes B itself, in the units that are said, not a Field, which has B'.")
        parts = components(field, ("B2", "B3"), "The field", SI_FIELDS["B"] if c == 1 else "")
        B2, B3 = (number(x, "A component of the field") for x in parts)
        if not (B2 or B3):
            raise DomainError("Without a field a charged top has no direction: it is a free body, FreeMotion.")
        with workprec():
            size = as_rational(length(rational(B2), rational(B3)))
        half = size / (2 * rational(positive(c, "c")))
        induced = components(polarizability, ("a2", "a3"), "The polarizability")
        a2, a3 = (rational(number(x, "A polarizability")) for x in induced)
        if susceptibility:
            a3 = a3 + rational(anisotropy(susceptibility, volume, demagnetization, c != 1))
        linear = along((B2, B3), weight) - rational(number(moment, "The moment", "J/T")) * size
        quadratic = (a2 - a3) * size * size
        coupling = [exact_number(rational(float(J)) * half) for J in (charges.J2, charges.J3)]
        return cls((I2, I3), coupling, (B2, B3), omega, linear=exact_number(linear), quadratic=exact_number(quadratic))

    @kept
    def stable(self) -> Any:
        """Whether a motion with constant theta is stable against nutation, decided exactly, theorem-top-nutation.

        At the border of stability the next derivatives of the potential decide. None where theta varies.
        """
        return self._each("stable", lambda exact: exact.stable)

    @property
    def steady_precessions(self) -> list[SteadyPrecession]:
        """Steady precessions at the inclination and with the omega3 of this top: `rate`, `nutation`, `stable`.

        I2 nu w^2 - M3 w + a + A nu = 0, theorem-top-precession, w = rate + k2/I2 with `rate` about n; none where both
        are complex, one where they meet or nu = 0, else the one of the smaller |w| first. omega2 = rate n2/|n| and
        omega1 = 0 start it. None with the axis along n, see `sleeping_bands`. AtlasError for an array; DomainError
        where every rate is one.
        """
        balls = enclosed(lambda: [tuple(x) for x in self._twin.steady_precessions], BITS)
        return [SteadyPrecession(nearest(rate), nearest(square), stable) for rate, square, stable in balls]

    @property
    def sleeping_bands(self) -> dict[str, tuple[float, float] | None]:
        """Values of omega3 between which this top falls over, its axis along n, "upright", or against it, "hanging".

        M3^2 < 4 (a + A), with the sign of a reversed for "hanging", theorem-sleeping-top; of Lagrange's top (I3
        omega3)^2 < 4 I2 m g l. None where it is stable at any spin. At an end see `stable`. AtlasError for an array.
        """
        balls = enclosed(lambda: list(self._twin.sleeping_bands.items()), BITS)
        return {name: band and (nearest(band[0]), nearest(band[1])) for name, band in balls}

    @property
    def _twin(self) -> Balls:
        """One top in balls. Raises AtlasError for an array."""
        if self.shape:
            raise AtlasError("This is asked of one top: give its parameters as numbers, not as arrays.")
        return self._single().exact

    @property
    def quadric(self) -> TopQuadric:
        """The quadric of starts with nu'' = 0 of this top, whatever omega, theorem-top-quadric."""
        return TopQuadric(self.inertia, self.coupling, self.direction, self.linear, self.quadratic)

    def field_in_body(self, t: Any) -> FloatArray:
        """Direction b(t) = R^T n in the body, a unit vector; shape (..., 3).

        Raises AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        b = self._evaluate(lambda single, t, out: single.field_in_body(t, out), t, (3,))
        return self._in_body(np.asarray(finite(b, "b")))

    def angular_momentum(self, t: Any) -> FloatArray:
        """Canonical momentum R (I Omega + k b)/I2 in the laboratory, whose component along n is constant; (..., 3).

        Raises AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        return self._momentum_of(lambda _: self._momentum(t), t, "M/I2")

    def invariants(self, t: Any = None) -> dict[str, Any]:
        """Constants of the motion over I2: energy h, M3 along the axis and p = (M, n) along the direction.

        Without `t` from the exact inputs, each rounded once. With times as they come out of Omega(t) and b(t): a check.
        Raises AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        if t is None:
            *top, w1, w2, w3, a0, A0 = self._inputs
            inputs = *top, a0, A0, w1, w2, w3
            twice, M3, p = map(plain, over(of_given(constants), *inputs, degree=(1, 1, 1), alone=_constants))
            return {"h": finite(twice / 2, "h"), "M3": M3, "p": p}
        Omega, b = map(self._along_class, (self.angular_velocity(t), self.field_in_body(t)))
        M = self._momentum(t)
        (I2, I3), nu = self.inertia, b[..., 2]
        spinning = Omega[..., 0] ** 2 + Omega[..., 1] ** 2 + I3 / I2 * Omega[..., 2] ** 2
        h = spinning / 2 + (self.linear * nu + self.quadratic * nu * nu / 2) / I2
        return {"h": finite(plain(h), "h"), "M3": plain(M[..., 2]), "p": plain((M * b).sum(-1))}

    def _momentum(self, t: Any) -> FloatArray:
        """Return M/I2 in the body."""
        (I2, I3), (k2, k3) = self.inertia, self.coupling
        return np.asarray(
            self._along_class(self.angular_velocity(t)) * np.stack(np.broadcast_arrays(1.0, 1.0, I3 / I2), -1)
            + self._along_class(self.field_in_body(t)) * np.stack(np.broadcast_arrays(k2 / I2, k2 / I2, k3 / I2), -1)
        )
