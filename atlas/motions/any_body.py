"""The motion of any body from any start, by the class that fits it, in the axes that were given."""

from typing import Any

from atlas.motions.elementary.kernel import ElementaryMotion, FreeMotion
from atlas.motions.elementary.kernel_ball import BallMotion
from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.motions.start import Start, argument, attitude_of, body_of, columns
from atlas.motions.torus.kernel import AsymmetricMotion

FAMILIES: tuple[Any, ...] = (AsymmetricMotion, FreeMotion, ElementaryMotion, BallMotion, GeneralMotion)
"""Classes in the order in which they are tried; the last one takes any start of a symmetric body."""


def motion(inertia: Any, field: Any, omega: Any, attitude: Any = None) -> Any:
    """Motion of a charged body of any shape from any start: of the class that fits, in the axes that are given.

    Parameters
    ----------
    inertia : float, SymmetricBody, tuple or array_like
        A ratio I3/I2 or a SymmetricBody, or an array of them, with its axis along e3 or as its `axes` say; three
        principal moments (I1, I2, I3) along the axes of the body; or a tensor (..., 3, 3) in these axes, whose
        principal axes are found, with -sum m x y and so on beside its diagonal.
    field : array_like (..., 3) or Field
        The vector B' = mu B/(2c) in the laboratory, in 1/time. For arrays of components give a tuple of three arrays.
    omega : array_like (..., 3)
        The angular velocity at t = 0 along the axes of the body, in the same unit.
    attitude : array_like (..., 3, 3) or scipy Rotation, optional
        R(0), with the axes of the body as columns; the unit matrix otherwise.

    Returns
    -------
    Motion
        A motion of the class that fits, as `family` says: "free", "elementary" or "ball" where a body with two equal
        moments starts so exactly, otherwise "general"; "asymmetric" for any other body. `kind` says of which kind it is
        there. `rotation`, `quaternion`, `column` and `rotation_grid` are between the axes given, `angular_velocity` and
        `field_in_body` along those of the body, `angular_momentum` in the laboratory.

    Raises
    ------
    DomainError
        For a tensor or for moments that no body has, an attitude that is no rotation, and for an array whose bodies are
        partly symmetric.
    AtlasError
        For what is no finite number.

    Notes
    -----
    The motion is made of the numbers as they were given: components along other axes are not rounded, and no class is
    chosen within a tolerance. A matrix of floats, as an attitude or principal axes, is orthogonal but for rounding, and
    stands for the rotation of its quaternion, which is as near. Only the matrices that turn the result into the given
    axes are rounded, so that entries of R are off by some 1e-15 at any time. `input_error` says what rounding of the
    inputs themselves would change.

        >>> motion = atlas.motion([[2, 0.1, 0], [0.1, 1.5, 0.2], [0, 0.2, 1]], (0.3, 0, 1), (0.1, 0.2, 3.0))
        >>> motion.family, motion.kind
        ('asymmetric', 'on a torus')
    """
    B, w = columns(field, "The field", "B"), columns(omega, "The angular velocity", "omega")
    start = Start(body_of(inertia), B, w, attitude_of(attitude))
    arguments = {"inertia": inertia, "field": argument(field, B), "omega": argument(omega, w), "attitude": attitude}
    own, axes = next(found for family in FAMILIES if (found := family._from_start(start)))  # noqa: SLF001
    return start.place(own, axes, motion, arguments, "motion")
