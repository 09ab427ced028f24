"""Elliptic motions: the paper's family for a body with any three moments of inertia (not in the paper)."""

from typing import Any

import numpy as np

from atlas.arithmetic.annotations import BodyLike, FieldLike, FloatOrArray, RealArrayLike
from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.dimensions import INERTIA, RATE
from atlas.arithmetic.inputs import FloatArray, as_given, components, finite, frozen_property, plain
from atlas.arithmetic.numbers import nearest, workprec
from atlas.bodies.clebsch_integrals import conserved
from atlas.motions.nutation.certified_elliptic import EllipticMotion as Balls
from atlas.motions.nutation.constants import FIRST_BITS
from atlas.motions.nutation.kernel import NutatingMotion
from atlas.motions.nutation.rows_elliptic import EllipticAtTimes, EllipticBlocks, EllipticScalars
from atlas.motions.nutation.rows_scalars import IN_ARRAYS
from atlas.motions.nutation.single import BITS
from atlas.motions.nutation.single_elliptic import SingleElliptic
from atlas.motions.start import Start

CONSTANTS = ("H", "F", "(M,K)", "K^2", "energy")
"""Names of the conserved quantities, in the order of `invariants`."""


def balls(*row: float) -> Balls:
    """Return the certified motion of a ``row`` of eight numbers: I1, I2, I3, B1, B2, B3, z, branch.

    Raises DomainError for inputs of no motion.
    """
    with workprec(FIRST_BITS):
        return Balls(row[:3], row[3:6], *row[6:])


class EllipticMotion(NutatingMotion[SingleElliptic]):
    """Family of motions of a charged body with any inertia tensor, by elliptic functions, theorem-elliptic.

    It extends the paper's hyperbola (67) to three different moments (not in the paper). With D = I1 I2 I3, for all t,

        Omega(t) = -[1 + v (z II + D)^-1] K(t),     v = branch sqrt((z + D/I1)(z + D/I2)(z + D/I3)).

    Parameters
    ----------
    inertia : (I1, I2, I3), array_like
        Principal moments, positive, the largest at most the sum of the others.
    field : (B1, B2, B3), array_like, or Field
        Components of B' along the principal axes at t = 0, in 1/time.
    z : float or array_like
        Parameter of the family, in inertia^2, on one of the two ovals of the curve (see Notes).
    branch : {1, -1} or array_like
        Sign of the root v.

    Raises
    ------
    DomainError
        For moments that no body has, for a z on neither oval or at the end of one, and for another branch.
    AtlasError
        For an input that is no finite number.

    Notes
    -----
    The motion starts from R(0) = 1. Inputs are taken as exact and broadcast with one another and with the times. z
    lies above the largest of -D/I_i, or between the other two. K moves like the angular momentum of a free body, K' =
    [K, E K] with E_i = -v/(z I_i + D). For I1 = I2 the family is that of the elementary motions. z = 0 is rest (branch
    -1) or Omega = -2 K (branch 1). `kind`, decided exactly, is one of

    - "at rest", "Omega = -2 K", "ball", "field along an axis": K is constant, and R a rotation about the field;
    - "elementary": two moments are equal, R = R_B(k t) R_3(phi t) as in (84), (85);
    - "elliptic": Jacobi's elliptic functions of time;
    - "separatrix": K tends to the axis of the middle E_i.

    `period` is that of K, or where K is constant that of an infinitesimal change of K; inf where none exists. K circles
    the axis of the largest or of the least E_i, for I1 = I2 the axis of symmetry. `precession_per_period` is the angle
    of this axis about the field. `spin_per_period` is 2 pi or -2 pi. Other axes precess by a different number of full
    turns. Where K is constant, the angles are the limits of neighbouring motions.

    The cost does not depend on t. Entries of R are within 3.6e-15 for phases up to 2^50. K is within 3.6e-15 |B'|,
    Omega_i within 3.6e-15 |E_i - 1| |B'|, and scalars are within 4 ulp.

    Examples
    --------
    >>> motion = atlas.EllipticMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), z=1.7)
    >>> motion.kind, round(motion.period, 9)
    ('elliptic', 23.996707123)
    """

    family = "elliptic"
    _in_arrays, _kinds = (*(set(IN_ARRAYS) - {"turning_points"}), "v", "omega"), ("elliptic",)
    _blocks_of, _motions_of, _scalars_of = EllipticBlocks, EllipticAtTimes, EllipticScalars

    def __init__(self, inertia: BodyLike, field: FieldLike, z: RealArrayLike, branch: RealArrayLike = 1) -> None:
        columns = [
            *components(inertia, ("I1", "I2", "I3"), "The inertia", INERTIA),
            *components(field, ("B1", "B2", "B3"), "The field", RATE),
            *components((z, branch), ("z", "branch"), "The point of the curve"),
        ]
        super().__init__(lambda *row: SingleElliptic(balls(*row)), *columns)
        _ = self.kind  # inputs of no motion are refused here
        self.inertia, self.field, (self.z, self.branch) = (
            tuple(plain(x) for x in columns[i:j]) for i, j in ((0, 3), (3, 6), (6, 8))
        )
        field = tuple(map(as_given, columns[3:6]))
        self.arguments = {"inertia": self.inertia, "field": field, "z": self.z, "branch": self.branch}

    @frozen_property
    def precession_rate(self) -> FloatOrArray:
        """Mean rate of precession about the field of the axis that K circles, in rad/time; also for constant K.

        Raises
        ------
        DomainError
            On a separatrix and for the spin about the axis of the middle E_i, for one motion; an array has NaN there.
        """
        return self._scalar("precession_rate")

    @frozen_property
    def spin_rate(self) -> FloatOrArray:
        """Mean rate of rotation about the axis that K circles: 2 pi/`period`, -2 pi/`period` or 0, in rad/time.

        Raises
        ------
        DomainError
            As for `precession_rate`.
        """
        return self._scalar("spin_rate")

    @frozen_property
    def stability(self) -> FloatOrArray:
        """Orbital stability of the curve of K and M: "stable", "unstable" or "undecided", or an array of these.

        Notes
        -----
        M is II (Omega + K). "stable" means that every neighbouring start stays next to the curve. "undecided" occurs
        where `splitting` is zero. The answer is decided exactly. At rest and for Omega = -2 K the curve is that of the
        flow that the integral F of `invariants` generates, along which neighbours drift slowly.
        """
        return self._of_all("stability", lambda exact: exact.stability)

    @frozen_property
    def splitting(self) -> FloatOrArray:
        """Squared frequency of small departures, theorem-splitting, in 1/time^2; negative where unstable.

        Raises
        ------
        DomainError
            If the value exceeds the largest float.

        Notes
        -----
        The flow is that of H + (z/D) F/2, with the integrals H and F of `invariants` and D = I1 I2 I3. The value is
        [4 b^2 P + s (P'^2 - 2 P P'')]/D^2, with b = |B'|, P(z) = v^2 and s = sum K_i^2/(z + D/I_i). For I1 = I2 = 1
        it is (1 + z/D)^2 times `Hyperbola.stability`.
        """
        return finite(self._scalar("splitting"), "splitting")

    @frozen_property
    def v(self) -> FloatOrArray:
        """Root v = branch sqrt((z + D/I1)(z + D/I2)(z + D/I3)), in inertia^3.

        Raises
        ------
        DomainError
            If the value exceeds the largest float.
        """
        return finite(self._scalar("v"), "v")

    @frozen_property
    def omega(self) -> tuple[FloatOrArray, FloatOrArray, FloatOrArray]:
        """Initial angular velocity (omega1, omega2, omega3) = -[1 + v (z II + D)^-1] B', in rad/time.

        Raises
        ------
        DomainError
            If a component exceeds the largest float.
        """
        omega: Any = self._of_all("omega", lambda exact: [nearest(x) for x in enclosed(lambda: exact.omega, BITS)])
        finite(omega, "omega")
        return (omega[..., 0], omega[..., 1], omega[..., 2]) if self.shape else tuple(omega)

    @classmethod
    def _from_start(cls, start: Start, **parameters: Any) -> tuple[Any, FloatArray]:
        """Return (motion, principal axes as rows (..., 3, 3)) from ``start``, a `Start`.

        ``parameters`` are z and branch.
        """
        axes = start.body.axes
        return cls(start.moments, tuple(start.components_along(axes)[0]), **parameters), axes

    def _inputs_of(self, i: int) -> Any:
        """Return the `Inputs` of the i-th motion, see `of_elliptic`."""
        from atlas.motions.nutation.derivatives_inputs import of_elliptic

        return of_elliptic(self._single(i).exact)

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
            For a time that is not finite or whose phases exceed 2^50.
        """
        return self._momentum_of(lambda Omega: Omega * np.stack(np.broadcast_arrays(*self.inertia), -1), t)

    def invariants(self, t: RealArrayLike | None = None) -> dict[str, FloatOrArray]:
        """Constants of the motion H, F, (M, K), K^2 and kinetic energy, theorem-clebsch.

        Parameters
        ----------
        t : array_like, optional
            Times at which the constants are evaluated from Omega(t) and K(t), as a check. By default the exact inputs
            are used.

        Returns
        -------
        dict of str to float or ndarray
            "H", "(M,K)", "energy" in inertia/time^2, "F" in inertia^2/time^2, "K^2" in 1/time^2. From the inputs each
            is rounded once; at times each is within some ulp of its largest term.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.

        Notes
        -----
        With M = II (Omega + K) and D = I1 I2 I3, H = (M, II^-1 M)/2 + (K, II K)/2 and F = M^2 - D (K, II^-1 K).
        """
        if t is None:
            constants = self._of_all(
                "invariants", lambda exact: list(map(nearest, enclosed(lambda: exact.invariants, BITS)))
            )
            columns = np.moveaxis(finite(np.reshape(constants, (*self.shape, len(CONSTANTS))), "H"), -1, 0)
            return dict(zip(CONSTANTS, map(plain, columns), strict=True))
        state = map(self._along_class, (self.angular_velocity(t), self.field_in_body(t)))
        J = [self.inertia[i // 4] if i % 4 == 0 else 0.0 for i in range(9)]
        return dict(zip(CONSTANTS, vars(conserved(J, *state)).values(), strict=True))
