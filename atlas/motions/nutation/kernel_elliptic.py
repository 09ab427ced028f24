"""Elliptic motions: the paper's family for a body with any three moments of inertia (not in the paper)."""

from typing import Any

import numpy as np

from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.dimensions import INERTIA, RATE
from atlas.arithmetic.inputs import FloatArray, as_given, components, finite, kept, plain
from atlas.arithmetic.numbers import nearest, workprec
from atlas.bodies.clebsch_integrals import conserved
from atlas.motions.nutation.certified_elliptic import EllipticMotion as Balls
from atlas.motions.nutation.constants import FIRST_BITS
from atlas.motions.nutation.kernel import NutatingMotion
from atlas.motions.nutation.rows_elliptic import EllipticAtTimes, EllipticBlocks, EllipticScalars
from atlas.motions.nutation.rows_scalars import IN_ARRAYS
from atlas.motions.nutation.single import BITS
from atlas.motions.nutation.single_elliptic import SingleElliptic

CONSTANTS = ("H", "F", "(M,K)", "K^2", "energy")
"""What a motion conserves, in this order."""


def balls(*row: float) -> Balls:
    """Return one motion as balls: I1, I2, I3, B1, B2, B3, z, branch."""
    with workprec(FIRST_BITS):
        return Balls(row[:3], row[3:6], *row[6:])


class EllipticMotion(NutatingMotion[SingleElliptic]):
    """Motion R(t), R(0) = 1, of a charged body of any inertia tensor, one of a family for each field, theorem-elliptic.

    `inertia` (I1, I2, I3), the principal moments; `field` (B1, B2, B3), the components of B' in the principal axes at
    t = 0, in 1/time; `z` in the unit of inertia squared and `branch`, 1 or -1, choose the motion: with D = I1 I2 I3,

        Omega(t) = -[1 + v (z II + D)^-1] K(t) for all t,     v = branch sqrt((z + D/I1)(z + D/I2)(z + D/I3)),

    which is the initial angular velocity `omega` too. So K turns like a free body, K' = [K, E K], E_i = -v/(z I_i + D),
    in Jacobi's elliptic functions. The inputs are taken as exact and broadcast with one another and with t. z lies on
    one of two ovals: above the largest of -D/I_i, or between the other two. For I1 = I2 this is the paper's hyperbola
    (67) of elementary motions, and z = 0 is rest (branch -1) or Omega = -2 K (branch 1). `kind`, decided exactly, is

    - "at rest", "Omega = -2 K", "ball", "field along an axis": K is constant, and R a turn about the field;
    - "elementary": two moments are equal, R = R_B(k t) R_3(phi t) as in (84), (85);
    - "elliptic", or "separatrix", where K tends to the axis of the middle E_i.

    The cost does not depend on t. Entries of R are
    within 3.6e-15 for phases up to 2^50, K within 3.6e-15 |B'|, Omega_i within 3.6e-15 |E_i - 1| |B'|; scalars within
    4 ulp. Raises DomainError for moments that no body has, positive and the largest at most the sum of the
    others, for a z on neither oval or at the end of one, and for another branch; AtlasError for what is no finite
    number.

        >>> motion = atlas.EllipticMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), z=1.7)
        >>> motion.kind, round(motion.period, 9)
        ('elliptic', 23.996707123)
    """

    family = "elliptic"
    _in_arrays, _kinds = (*(set(IN_ARRAYS) - {"turning_points"}), "v", "omega"), ("elliptic",)
    _blocks_of, _motions_of, _scalars_of = EllipticBlocks, EllipticAtTimes, EllipticScalars

    def __init__(self, inertia: Any, field: Any, z: Any, branch: Any = 1) -> None:
        parts = [
            *components(inertia, ("I1", "I2", "I3"), "The inertia", INERTIA),
            *components(field, ("B1", "B2", "B3"), "The field", RATE),
            *components((z, branch), ("z", "branch"), "The point of the curve"),
        ]
        super().__init__(lambda *row: SingleElliptic(balls(*row)), *parts)
        _ = self.kind  # what is no motion is refused here
        self.inertia, self.field, (self.z, self.branch) = (
            tuple(plain(x) for x in parts[i:j]) for i, j in ((0, 3), (3, 6), (6, 8))
        )
        field = tuple(map(as_given, parts[3:6]))
        self.arguments = {"inertia": self.inertia, "field": field, "z": self.z, "branch": self.branch}

    @kept
    def period(self) -> Any:
        """Period T of K; where K is constant, that of an infinitesimal change of it, inf where there is none.

        Raises DomainError where it is beyond all floats.
        """
        return self._scalar("period")

    @kept
    def precession_per_period(self) -> Any:
        """Angle, in one period, by which the axis that K goes round precesses about the field, radians.

        That is the axis of the largest or of the least E_i; any other precesses by whole turns more or less. For I1 =
        I2 it is the axis of symmetry. Where K stands on an axis, it is the limit of the motions next to it. Where there
        is no period there is none: DomainError for one motion, NaN for one of an array.
        """
        return self._scalar("precession_per_period")

    @kept
    def spin_per_period(self) -> Any:
        """Angle by which the body turns about the axis that K goes round in one period: 2 pi or -2 pi."""
        return self._scalar("spin_per_period")

    @kept
    def precession_rate(self) -> Any:
        """Mean rate of precession of that axis about the field; also where K stands, and there is no period."""
        return self._scalar("precession_rate")

    @kept
    def spin_rate(self) -> Any:
        """Mean rate at which the body turns about the axis that K goes round, 2 pi or -2 pi over the period, or 0."""
        return self._scalar("spin_rate")

    @kept
    def stability(self) -> Any:
        """Whether every motion that starts near stays beside the curve of K and M: a string, or an array of them.

        "stable", "unstable" or, where `splitting` is zero, "undecided"; decided exactly on the inputs. Where the body
        rests or Omega = -2 K the curve is that of the second flow, along which neighbours drift slowly.
        """
        return self._each("stability", lambda exact: exact.stability)

    @kept
    def splitting(self) -> Any:
        """Squared frequency of small departures in the flow of H + (z/D) F/2, theorem-splitting; negative: unstable.

        It is [4 b^2 P + s (P'^2 - 2 P P'')]/D^2, in 1/time^2, with P = v^2 as a polynomial in z and
        s = sum K_i^2/(z + D/I_i). For I1 = I2 = 1 that is (1 + z/D)^2 times the squared frequency of nutation of
        `Hyperbola.stability`. DomainError beyond all floats.
        """
        return finite(self._scalar("splitting"), "splitting")

    @kept
    def v(self) -> Any:
        """The root v of prod(z + D/I_i), of the sign of the branch, in inertia^3. DomainError beyond all floats."""
        return finite(self._scalar("v"), "v")

    @kept
    def omega(self) -> tuple[Any, Any, Any]:
        """Initial angular velocity (omega1, omega2, omega3) = -[1 + v (z II + D)^-1] B'; DomainError beyond floats."""
        omega = self._each("omega", lambda exact: [nearest(x) for x in enclosed(lambda: exact.omega, BITS)])
        finite(omega, "omega")
        return (omega[..., 0], omega[..., 1], omega[..., 2]) if self.shape else tuple(omega)

    def angular_momentum(self, t: Any) -> FloatArray:
        """Angular momentum m = R II Omega in the laboratory; shape (..., 3).

        Raises AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        return self._momentum_of(lambda Omega: Omega * np.stack(np.broadcast_arrays(*self.inertia), -1), t)

    def invariants(self, t: Any = None) -> dict[str, Any]:
        """Constants of any body's motion, theorem-clebsch: H, F, (M, K), K^2 and the kinetic energy.

        Without `t` from the exact inputs, each rounded once. With times, as they come out of Omega(t) and K(t): a
        check, good to some ulp of the largest term. Raises AtlasError for a time that is not finite or whose phases
        exceed 2^50.
        """
        if t is None:
            constants = self._each(
                "invariants", lambda exact: list(map(nearest, enclosed(lambda: exact.invariants, BITS)))
            )
            columns = np.moveaxis(finite(np.reshape(constants, (*self.shape, len(CONSTANTS))), "H"), -1, 0)
            return dict(zip(CONSTANTS, map(plain, columns), strict=True))
        state = map(self._along_class, (self.angular_velocity(t), self.field_in_body(t)))
        J = [self.inertia[i // 4] if i % 4 == 0 else 0.0 for i in range(9)]
        return dict(zip(CONSTANTS, vars(conserved(J, *state)).values(), strict=True))
