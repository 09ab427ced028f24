"""The general motion of a charged symmetric body, from any initial angular velocity (not in the paper)."""

from typing import Any

import numpy as np

from atlas.arithmetic.annotations import BodyLike, FieldLike, FloatOrArray, RealArrayLike
from atlas.arithmetic.dimensions import RATE
from atlas.arithmetic.double_double import over
from atlas.arithmetic.inputs import FloatArray, as_given, components, finite, frozen_property, plain
from atlas.arithmetic.numbers import nearest, workprec
from atlas.bodies.body import exact_moments, kept_ratio
from atlas.bodies.certified_body import Moments
from atlas.bodies.formula_integrals import NAMES, constants
from atlas.bodies.integrals import integrals, shape_factors
from atlas.motions.nutation.certified_general import GeneralMotion as Balls
from atlas.motions.nutation.constants import FIRST_BITS
from atlas.motions.nutation.kernel import SymmetricMotion
from atlas.motions.nutation.rows_scalars import IN_ARRAYS, KINDS
from atlas.motions.nutation.single import SingleGeneral
from atlas.motions.start import Start

CONSTANTS = (*NAMES[:4], "(M,B')")
"""Names of the conserved quantities, in the order of `invariants`."""


def standing(I2: Any, I3: Any, *state: Any) -> SingleGeneral:
    """Return the `SingleGeneral` of eight exact numbers: I2, I3, and the ``state`` at t = 0.

    The state is K1, K2, K3 (1/time), omega1, omega2, omega3 (rad/time), along the body's axes. Any state will do, also
    at rest or without nutation. Raises DomainError for moments that no body has.
    """
    with workprec(FIRST_BITS):
        return SingleGeneral(Balls.at_state(Moments(I2, I3), state[3:], state[:3]))


class GeneralMotion(SymmetricMotion[SingleGeneral]):
    """Motion of a charged symmetric body from any initial angular velocity (not in the paper).

    The motion starts from R(0) = 1; `in_laboratory` takes any attitude. Omega3 moves between two roots of a quartic,
    (dOmega3/dt)^2 = Q(Omega3).

    Parameters
    ----------
    ratio : float or array_like or SymmetricBody
        I = I3/I2, in (0, 2].
    field : (B2, B3) or (B1, B2, B3), array_like, or Field
        Components of B' = mu B/(2c), as in (32), of any sign, in 1/time.
    omega : (omega1, omega2, omega3), array_like
        Initial angular velocity along the body's axes, in rad/time.

    Raises
    ------
    DomainError
        For a ratio that no body has. Values at a time: if the axis comes within about 1e-600 rad of the field.
    AtlasError
        For an input that is no number.

    Notes
    -----
    Inputs are taken as exact and broadcast with one another and with the times. theta is the angle between the axis
    and B, cos theta = K3/b. `kind`, decided exactly, is one of

    - "at rest", "precession", "spin along the field": Omega3 is constant, as in `ElementaryMotion`;
    - "free body": B = 0, (87);
    - "ball": I3 = I2, any motion that is none of these;
    - "nutation, two real roots", "nutation, four real roots" of Q: elliptic functions of time;
    - "separatrix": Omega3 tends to a double root of Q, hyperbolic functions;
    - "separatrix, triple root": rational functions;
    - "separatrix between B and -B": the axis turns over once, from one pole of the sphere to the other.

    The cost does not depend on t. Error bounds are 1.8e-15 for entries of R (3.6e-15 on fine grids), 1.8e-15 |B'| for
    K, and 7e-15 |m| for m. Omega is within 16 ulp of its largest component.

    Examples
    --------
    >>> motion = atlas.GeneralMotion(1.5, (1.0, 2.0), omega=(0.3, 0.7, 0.2))
    >>> motion.kind, round(motion.period, 9)
    ('nutation, four real roots', 2.181330398)
    """

    family = "general"
    _in_arrays, _kinds = (*IN_ARRAYS, "roots"), KINDS

    def __init__(self, ratio: BodyLike, field: FieldLike, omega: RealArrayLike) -> None:
        I2, I3 = exact_moments(ratio)
        B = field_components(field)
        omega = components(omega, ("omega1", "omega2", "omega3"), "The angular velocity", RATE)
        I, *vectors = plain(I3), tuple(map(plain, B)), tuple(map(plain, omega))
        vectors_given = {"field": tuple(map(as_given, B)), "omega": tuple(map(as_given, omega))}
        rounded, exact = kept_ratio(ratio, I), kept_ratio(ratio, I3)
        super().__init__(standing, I2, I3, *[0.0] * (3 - len(B)), *B, *omega)
        self.ratio, (self.field, self.omega), self.arguments = rounded, vectors, {"ratio": exact, **vectors_given}

    @classmethod
    def _from_start(cls, start: Start) -> tuple[Any, FloatArray] | None:  # type: ignore[override]
        """Return (motion, principal axes as rows (..., 3, 3), the symmetry axis last) from a `Start`, ``start``.

        None for a body with three different moments.
        """
        if not start.is_symmetric:
            return None
        body, axes, K, w = start.symmetric
        return cls(body, tuple(K), tuple(w)), axes

    def _inputs_of(self, i: int) -> Any:
        """Return the `Inputs` of the i-th motion, see `of_general`."""
        from atlas.motions.nutation.derivatives_inputs import of_general

        exact = self._single(i).exact
        return of_general(exact.I, exact.field, exact.omega)

    def angular_momentum(self, t: RealArrayLike) -> FloatArray:
        """Angular momentum m(t)/I2 = R (Omega1, Omega2, I Omega3) in the laboratory, as in (88).

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Components of m/I2, in rad/time, each within 7e-15 |m|/I2.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        return self._momentum_of(self._momentum, t, "m/I2")

    def invariants(self, t: RealArrayLike | None = None) -> dict[str, FloatOrArray]:
        """Constants of the motion E', K^2, c3, c5, eqs. (36)-(41), and (M, B')/I2 with M = II (Omega + K).

        Parameters
        ----------
        t : array_like, optional
            Times at which the constants are evaluated from Omega(t) and K(t), as a check. By default the exact inputs
            are used.

        Returns
        -------
        dict of str to float or ndarray
            The five constants by name: "c3" in 1/time, "E'", "K^2", "c5" and "(M,B')" in 1/time^2. From the inputs each
            is rounded once; at times, which broadcast with the motions, each is within some ulp of its largest term.

        Raises
        ------
        DomainError
            If a term exceeds the largest float.
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        if t is None:
            return {name: finite(plain(x), name) for name, x in zip(CONSTANTS, self._constants, strict=True)}
        Omega, K = map(self._along_class, (self.angular_velocity(t), self.field_in_body(t)))
        four = integrals(self.ratio, Omega, K)
        axial = finite(plain((self._momentum(Omega + K) * K).sum(-1)), CONSTANTS[-1])
        return dict(zip(CONSTANTS, (four.E, four.K2, four.c3, four.c5, axial), strict=True))

    @frozen_property
    def _constants(self) -> Any:
        """E', K^2, c3, c5 and (M, B')/I2 of the inputs, a list of five floats or arrays, each rounded once.

        c3 is in 1/time, the others are in 1/time^2.
        """
        if not self.shape:
            return [nearest(x) for x in self._single().exact.invariants.values()]
        I2, I3, *state = self._inputs
        return over(constants, I2, I3, *state[3:], *state[:3], unit=slice(2, None), degree=(2, 2, 1, 2, 2))

    def _momentum(self, Omega: FloatArray) -> FloatArray:
        """Return the momenta (Omega1, Omega2, I Omega3), (..., 3), over I2, for angular velocities (..., 3)."""
        I = shape_factors(self.ratio)[0]
        return np.asarray(Omega * np.stack(np.broadcast_arrays(1.0, 1.0, I), -1))


def field_components(field: Any) -> list[Any]:
    """Return the components [B2, B3] of a field, or [B1, B2, B3] if three are given or a `Field` has B1 != 0.

    They are arrays, or `Given`, in 1/time. Raises AtlasError for another number of components.
    """
    try:
        three = field.prime[0] != 0 if hasattr(field, "prime") else len(getattr(field, "values", field)) == len("123")
    except TypeError:
        three = False
    return components(field, ("B1", "B2", "B3") if three else ("B2", "B3"), "The field", RATE)
