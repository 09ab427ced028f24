"""The general motion of a charged symmetric body, from any initial angular velocity (not in the paper)."""

from typing import Any, Self

import numpy as np
from flint import fmpq

from atlas.core.arithmetic.double_double import over
from atlas.core.bodies.body import kept_ratio, moments
from atlas.core.bodies.symmetric_top import moments_of_one
from atlas.core.inputs import FloatArray, components, finite, kept, plain, real, vector
from atlas.core.motions.integrals import integrals, shape_factors
from atlas.core.motions.nutating import SymmetricMotion
from atlas.core.nutation.constants import FIRST
from atlas.core.nutation.scalars import IN_ARRAYS, KINDS
from atlas.core.nutation.single import SingleGeneral
from atlas.core.quantities import RATE
from atlas.errors import DomainError
from atlas.exact.bodies.body import Moments
from atlas.exact.motions.general import GeneralMotion as Balls
from atlas.exact.nutation.cayley_klein import matrix
from atlas.formulas.integrals import NAMES, constants
from atlas.formulas.numbers import nearest, quaternion_products, rational, workprec

CONSTANTS = (*NAMES[:4], "(M,B')")
"""What a motion conserves, in this order."""

ORTHOGONAL = 1e-9
"""An attitude may be so far from orthogonal; the rotation nearest to it is taken."""


def standing(I2: float, I3: float, B2: float, B3: float, *omega: float) -> SingleGeneral:
    """Return the motion with R(0) = 1 in the field (0, B2, B3)."""
    with workprec(FIRST):
        exact = Balls(Moments(I2, I3), (B2, B3), omega)
    return SingleGeneral(exact, np.eye(3), (I2, I3, B2, B3, *omega))


class GeneralMotion(SymmetricMotion[SingleGeneral]):
    """Motion R(t), R(0) = 1, of a charged symmetric body from any initial angular velocity (not in the paper).

    `ratio` I = I3/I2 or a SymmetricBody; `field` = (B2, B3), the components of B' = mu B/(2c), as in (32); `omega` =
    (omega1, omega2, omega3), the initial angular velocity: in one unit 1/time, of any sign. The inputs are taken as
    exact and broadcast with one another and with t. `in_laboratory` takes a field in any direction and any attitude.

    Omega3 moves between two roots of the quartic Q, (dOmega3/dt)^2 = Q(Omega3); theta is the angle between the body's
    axis and B, cos theta = K3/b. `kind` is one of

    - "at rest", "precession", "spin along the field": Omega3 is constant, as in `ElementaryMotion`;
    - "free body": B = 0, (87); "ball": I3 = I2, any motion that is none of these;
    - "nutation, two real roots" and "nutation, four real roots" of Q: elliptic functions of time;
    - "separatrix": Omega3 tends to a double root of Q, hyperbolic functions; "separatrix, triple root": rational ones;
      "separatrix between B and -B": the axis turns over from one pole of the sphere to the other, once.

    Which it is, is decided exactly; the entries of R join without a gap. The cost does not depend on t. Entries of R
    are within 1.8e-15, twice what elementary motions promise, on fine grids within 3.6e-15. K is
    within 1.8e-15 of |B'|, Omega within 16 ulp of its own largest component, however slowly the body turns beside its
    Larmor frame, and m within 7e-15 of its length.
    Raises AtlasError for what is no number. Values at a time raise DomainError if the body's axis comes to within some
    1e-600 rad of the field, but not into it.

        >>> motion = atlas.GeneralMotion(1.5, (1.0, 2.0), omega=(0.3, 0.7, 0.2))
        >>> motion.kind, round(motion.period, 9)
        ('nutation, four real roots', 2.181330398)
    """

    family = "general"
    _in_arrays, _kinds = (*IN_ARRAYS, "roots"), KINDS

    def __init__(self, ratio: Any, field: Any, omega: Any) -> None:
        I2, I3 = moments(ratio)
        self.ratio = kept_ratio(ratio, I3)
        B2, B3 = components(field, ("B2", "B3"), "The field", RATE)
        omega = components(omega, ("omega1", "omega2", "omega3"), "The angular velocity", RATE)
        super().__init__(standing, I2, I3, B2, B3, *omega)
        self.field, self.omega = (plain(B2), plain(B3)), tuple(plain(w) for w in omega)
        self.arguments = {"ratio": self.ratio, "field": self.field, "omega": self.omega}

    @classmethod
    def in_laboratory(  # type: ignore[override]  # exact, and so of one motion, without other parameters
        cls, ratio: Any, field: Any, attitude: Any, angular_velocity: Any
    ) -> Self:
        """Motion R(t), R(0) = `attitude`, in a field of any direction.

        `field` (3,) is the vector B' and `angular_velocity` (3,) the initial one, both in the laboratory and in 1/time;
        `attitude` (3, 3) is the initial rotation matrix, whose columns are the body's axes in the laboratory. It is
        replaced by the rotation of its quaternion, rounded, which is exact. `rotation` then takes the body to the
        laboratory, `angular_velocity` and `field_in_body` are in the body, `angular_momentum` in the laboratory.
        Raises DomainError if the attitude is no rotation to 1e-9. AtlasError is raised for what is no number.
        """
        I2, I3 = moments_of_one(ratio)
        attitude = real(attitude, "The attitude")
        start = exact_attitude(attitude)
        field, angular_velocity = vector(field, "The field", RATE), vector(angular_velocity, "omega", RATE)
        B, w = _transposed(start, field), _transposed(start, angular_velocity)
        motion = cls.__new__(cls)
        motion.ratio, motion.shape = kept_ratio(ratio, I3), ()
        motion.made_by = "GeneralMotion.in_laboratory"
        matrix = np.array([[int(x.p) / int(x.q) for x in row] for row in start])
        motion._made = {0: SingleGeneral(Balls.at_state(Moments(I2, I3), w, B), matrix)}  # noqa: SLF001  of this class
        motion.field, motion.omega = tuple(field.tolist()), tuple(int(x.p) / int(x.q) for x in w)
        motion.arguments = {
            "ratio": motion.ratio, "field": field, "attitude": attitude, "angular_velocity": angular_velocity,
        }  # fmt: skip
        return motion

    def angular_momentum(self, t: Any) -> FloatArray:
        """Angular momentum m(t)/I2 = R (Omega1, Omega2, I Omega3) in the laboratory; shape (..., 3).

        Each component is within 7e-15 of the length of m. Raises AtlasError for a time that is not finite or whose
        phases exceed 2^50.
        """
        return np.asarray(finite(np.matvec(self.rotation(t), self._momentum(self.angular_velocity(t))), "m/I2"))

    def invariants(self, t: Any = None) -> dict[str, Any]:
        """Constants E', K^2, c3, c5 of (36) to (41), and (M, B')/I2 with M = II (Omega + K), by name.

        Without `t` from the exact inputs, each rounded once. With times, as they come out of Omega(t) and K(t): a
        check, good to some ulp of the largest term. DomainError where a term is too large for a float. Raises
        AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        if t is None:
            return {name: finite(plain(x), name) for name, x in zip(CONSTANTS, self._constants, strict=True)}
        Omega, K = self.angular_velocity(t), self.field_in_body(t)
        four = integrals(self.ratio, Omega, K)
        along = finite(plain((self._momentum(Omega + K) * K).sum(-1)), CONSTANTS[-1])
        return dict(zip(CONSTANTS, (four.E, four.K2, four.c3, four.c5, along), strict=True))

    @kept
    def _constants(self) -> Any:
        """Return E', K^2, c3, c5 and (M, B')/I2 of the inputs."""
        if not self.shape:
            return [nearest(x) for x in self._single().exact.invariants.values()]
        I2, I3 = moments(self.ratio)
        return over(constants, I2, I3, *self.omega, 0.0, *self.field, unit=slice(2, None), degree=(2, 2, 1, 2, 2))

    def _momentum(self, Omega: FloatArray) -> FloatArray:
        """Return (Omega1, Omega2, I Omega3)."""
        I = shape_factors(self.ratio)[0]
        return np.asarray(Omega * np.stack(np.broadcast_arrays(1.0, 1.0, I), -1))


def exact_attitude(attitude: Any) -> list[list[fmpq]]:
    """Return the rotation of the rounded quaternion of a matrix, in rational numbers.

    Raises DomainError if the matrix is not orthogonal to 1e-9 or is a reflection.
    """
    R = real(attitude, "The attitude")
    if R.shape != (3, 3):
        raise DomainError(f"The attitude must be a rotation matrix (3, 3), not of shape {R.shape}.")
    if np.abs(R.T @ R - np.eye(3)).max() > ORTHOGONAL or np.linalg.det(R) < 0:
        raise DomainError("The attitude must be a rotation matrix: R^T R = 1 to 1e-9, and det R = 1.")
    table: FloatArray = np.roll(quaternion_products(R.tolist()), 1, axis=(0, 1))  # the scalar first
    return matrix([rational(v) for v in table[np.argmax(np.diag(table))].tolist()])


def _transposed(R: list[list[fmpq]], v: FloatArray) -> list[fmpq]:
    """Return R^T v, exactly."""
    exact = [rational(x) for x in v.tolist()]
    return [sum((R[i][j] * exact[i] for i in range(3)), fmpq(0)) for j in range(3)]
