"""Slow change of a motion, by averages over its fast phases: those of a nutation, or of a torus."""

from typing import Any, overload

import numpy as np

from atlas.arithmetic.annotations import RealArrayLike
from atlas.arithmetic.dimensions import TIME, bare
from atlas.arithmetic.inputs import number, real
from atlas.errors import AtlasError, DomainError
from atlas.motions.nutation.drift import Drift, of_nutation
from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.motions.nutation.kernel_top import TopMotion
from atlas.motions.torus.drift import AsymmetricDrift, of_torus
from atlas.motions.torus.kernel import BESIDE, AsymmetricMotion

WITH_PHASES = ("on a torus", "Euler's top")
"""Kinds of motions of a body with three moments that have phases to average over."""


@overload
def drift(
    motion: GeneralMotion | TopMotion,
    t: RealArrayLike,
    *,
    field: float = 0.0,
    drag: RealArrayLike = 0.0,
    linear: float = 0.0,
    quadratic: float = 0.0,
) -> Drift: ...
@overload
def drift(
    motion: AsymmetricMotion, t: RealArrayLike, *, field: float = 0.0, drag: RealArrayLike = 0.0
) -> AsymmetricDrift | Drift: ...
def drift(
    motion: GeneralMotion | TopMotion | AsymmetricMotion,
    t: RealArrayLike,
    *,
    field: float = 0.0,
    drag: RealArrayLike = 0.0,
    linear: float = 0.0,
    quadratic: float = 0.0,
) -> Drift | AsymmetricDrift:
    """Slow change of one motion, averaged over its fast phases: an approximation of first order.

    Parameters
    ----------
    motion : GeneralMotion, TopMotion or AsymmetricMotion
        One motion, also from `atlas.motion`.
    t : array_like, shape (m,)
        Times, not negative, ascending; the change begins at t = 0.
    field : float
        Relative growth rate of the field, in 1/time: its strength, and the coupling, are multiplied by 1 + `field` t.
    drag : float, (float, float) or (float, float, float)
        Rates d of the torque -(d_i I_i Omega_i), in 1/time: one number, (d2, d3) of a symmetric body, or one number for
        each principal axis of an `AsymmetricMotion`, in the order of its `own.inertia`.
    linear, quadratic : float
        Growth rates of the potential of a top, in inertia/time^3.

    Returns
    -------
    Drift or AsymmetricDrift
        Constants, actions, mean rates and phases at the times; of an `AsymmetricMotion` with three different moments
        an `AsymmetricDrift`, else a `Drift`.

    Raises
    ------
    DomainError
        Where the motion reaches a separatrix, and averaging fails; the message has the time for three moments. For a
        motion that has no phase to average over, such as a spin or an elliptic motion.
    AtlasError
        For another motion, and for an input that is no number.

    Notes
    -----
    Let e be the largest of these rates relative to those of the motion. Up to times of order 1/e, constants, actions
    and mean rates are accurate to order e. Phases are accurate to order one. Nothing is certified. The cost depends on
    the amount of change, not on the number of turns.

    With three moments, the state (M, K), M = I (Omega + K), has two phases. The integrals y = (H, F, c, K^2) of
    `AsymmetricMotion`, with c = (M, K), change by dy/dt = <(dy/dM, N) + g (dy/dK, K)>, the mean over the torus, where N
    is the drag and g = `field`/(1 + `field` t). A free body has y = (H, F) and one phase. Where the ratio of the two
    frequencies passes one of small whole numbers, the error may grow to the order of the root of e. A field that turns
    slowly, without growing, changes no integral to this order: the motion goes with the field.

    Examples
    --------
    >>> motion = atlas.GeneralMotion(1.5, (1.0, 2.0), omega=(0.3, 0.7, 0.2))
    >>> slowed = atlas.drift(motion, [0.0, 5e4], field=1e-5)
    >>> slowed.action.round(6), slowed.nutation.round(4)
    (array([0.038207, 0.038207]), array([2.8804, 2.6824]))
    """
    unplaced: Any = getattr(motion, "own", motion)
    names = set(getattr(unplaced, "arguments", ()))
    is_asymmetric = names == {"inertia", "field", "omega"}
    if getattr(unplaced, "shape", None) != () or not (
        is_asymmetric or names > {"ratio", "field"} or "coupling" in names
    ):
        raise AtlasError(
            "A drift takes one GeneralMotion, ElementaryMotion, TopMotion or AsymmetricMotion, not "
            f"{type(unplaced).__name__}."
        )
    times = np.atleast_1d(real(bare(t, "The time", TIME), "The time"))
    if times.ndim != 1 or not times.size or times[0] < 0 or (np.diff(times) < 0).any():
        raise AtlasError("The times of a drift are a row of them, ascending from zero on.")
    rates = [number(x, name) for x, name in ((field, "field"), (linear, "linear"), (quadratic, "quadratic"))]
    if 1 + rates[0] * times[-1] <= 0:
        raise DomainError(f"The field is gone at t = {-1 / rates[0]:g}: 1 + field t must stay positive.")
    friction = real(drag, "The drag")
    if friction.shape not in ((), (1,), (3,) if is_asymmetric else (2,)):
        raise AtlasError(f"The drag is one rate or {'three' if is_asymmetric else '(d2, d3)'}: shape {friction.shape}.")
    if not is_asymmetric or unplaced.kind in BESIDE:
        return of_nutation(unplaced, times, rates, friction)
    if any(rates[1:]):
        raise AtlasError(
            "linear and quadratic are for the potential of a TopMotion: leave them out for a body with three moments."
        )
    if unplaced.kind not in WITH_PHASES:
        raise DomainError(f"The motion has no phases to average over: it is {unplaced.kind}; start beside it.")
    return of_torus(unplaced, times, rates[0], np.broadcast_to(friction, (3,)))
