"""The motion of any body from any start, by the class that fits it, in the axes that were given."""

from typing import Any, TypeAlias

from atlas.arithmetic.annotations import AttitudeLike, BodyLike, FieldLike, RealArrayLike
from atlas.arithmetic.uncertainty import UncertainObject, is_uncertain
from atlas.motions.elementary.kernel import ElementaryMotion, FreeMotion
from atlas.motions.elementary.kernel_ball import BallMotion
from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.motions.start import argument, start_of
from atlas.motions.torus.kernel import AsymmetricMotion

AnyMotion: TypeAlias = AsymmetricMotion | FreeMotion | ElementaryMotion | BallMotion | GeneralMotion

FAMILIES: tuple[Any, ...] = (AsymmetricMotion, FreeMotion, ElementaryMotion, BallMotion, GeneralMotion)
"""Classes in the order in which they are tried; the last one takes any start of a symmetric body."""


def motion(
    inertia: BodyLike,
    field: FieldLike = (0.0, 0.0, 0.0),
    omega: RealArrayLike | None = None,
    attitude: AttitudeLike | None = None,
    *,
    omega_laboratory: RealArrayLike | None = None,
) -> AnyMotion:
    """Motion of a charged body of any shape from any start, by the class that fits, eqs. (12), (16).

    Parameters
    ----------
    inertia : float, SymmetricBody or array_like
        Ratio I3/I2 or a SymmetricBody, with the axis along e3 or as its `axes` say; a tuple of the principal moments
        (I1, I2, I3) along the body's axes, numbers or arrays; or an inertia tensor, whose principal axes are found. An
        array or a list of shape (..., 3, 3) has tensors, any other one of shape (..., 3) moments, and one of another
        shape ratios: three ratios are given as ``SymmetricBody(1.0, ratios)``.
    field : array_like, shape (..., 3), or Field, optional
        Vector B' = mu B/(2c) in the laboratory, in 1/time; by default none. Arrays of components are given as a tuple
        of three arrays.
    omega : array_like, shape (..., 3)
        Angular velocity at t = 0 along the axes of the body, in rad/time.
    attitude : array_like, shape (..., 3, 3), or scipy Rotation, optional
        Rotation R(0), with the axes of the body as columns; by default the unit matrix.
    omega_laboratory : array_like, shape (..., 3)
        Angular velocity at t = 0 along the axes of the laboratory, in the place of `omega`.

    Returns
    -------
    Motion
        Motion of the class that `family` names: "free", "elementary" or "ball" for such exact starts of a body with
        two equal moments, else "general"; "asymmetric" for any other body. `kind` names the type of motion.

    Raises
    ------
    DomainError
        For moments or a tensor that no body has, an attitude that is no rotation, and an array of bodies of which only
        some are symmetric.
    AtlasError
        For an input that is no finite number, and unless one of `omega` and `omega_laboratory` is given.

    Warns
    -----
    NearestInputWarning
        If a tensor or an attitude has the digits of single precision only: the nearest possible one is taken.

    Notes
    -----
    `rotation`, `quaternion`, `column` and `rotation_grid` refer to the given axes. `angular_velocity` and
    `field_in_body` are along those of the body, `angular_momentum` is in the laboratory.

    Inputs are taken as exact, and the class is chosen without a tolerance. A matrix of floats is orthogonal up to
    rounding and stands for the rotation of its quaternion. Entries of R are within about 1e-15 at any time.
    `input_error` bounds the effect of rounding the inputs.

    Any number of the inputs may have a standard deviation, as `uncertainties.ufloat` has it: numbers with the
    attributes `nominal_value` and `std_dev`. Quantities and matrices of the motion are then `ufloat` too, correlated
    with the inputs; `nominal_value` is the motion at the nominal inputs. Classes of motions, bodies, fields and
    surfaces take such inputs alike, and motions take such bodies and fields.

    Examples
    --------
    >>> motion = atlas.motion([[2, 0.1, 0], [0.1, 1.5, 0.2], [0, 0.2, 1]], (0.3, 0, 1), (0.1, 0.2, 3.0))
    >>> motion.family, motion.kind
    ('asymmetric', 'on a torus')
    """
    if is_uncertain(inertia, field, omega, attitude, omega_laboratory):
        starts = {"attitude": attitude, "omega_laboratory": omega_laboratory}
        named = {name: x for name, x in starts.items() if x is not None}
        return UncertainObject(motion, (inertia, field, omega), named)  # type: ignore[return-value]  # its numbers vary
    start = start_of(inertia, field, omega, attitude, omega_laboratory)
    name, w = ("omega", omega) if omega is not None else ("omega_laboratory", omega_laboratory)
    arguments = {
        "inertia": inertia, "field": argument(field, start.B), name: argument(w, start.w), "attitude": attitude,
    }  # fmt: skip
    class_motion, axes = next(candidate for family in FAMILIES if (candidate := family._from_start(start)))  # noqa: SLF001
    placed: AnyMotion = start.place(class_motion, axes, motion, arguments, "motion")
    return placed
