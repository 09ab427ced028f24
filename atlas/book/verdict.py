"""Words on a body and its motion: between needle and disk, what kind of motion, whether it is stable."""

from collections.abc import Sequence
from fractions import Fraction
from math import hypot
from typing import Any

from atlas.book.tables.properties import FamilyObject
from atlas.motions.register import Family

NEEDLE = 0.1
"""I = I3/I2 below which a body is called a needle."""
NEAR_MIDDLE = 0.95
"""Part of the angular momentum along the middle axis from which on a body is said to turn over."""
NEAR_BALL = 0.01
"""|I - 1| below which a body is called nearly a ball."""


def shape_words(ratio: float) -> str:
    """Return words on a body's shape by its ratio I3/I2, from "nearly a needle" below 0.1 to "a disk or loop" at 2.

    "a ball" stands at 1 exactly and "a disk or loop" at 2 exactly, "nearly a ball" within 0.01 of 1.
    """
    if ratio == 1.0:
        return "a ball: every axis is like every other"
    if ratio == 2.0:
        return "as flat as a body can be, a disk or a loop"
    if abs(ratio - 1.0) < NEAR_BALL:
        return "nearly a ball"
    if ratio < NEEDLE:
        return "nearly a needle"
    return "longer than a ball" if ratio < 1.0 else "flatter than a ball"


def verdict(item: FamilyObject) -> str:
    """Return words on the kind of an object's motion and, where known, its stability against small nutations.

    For an object without a start they say that all motions are shown.
    """
    family, motion = item.family, item.kernels()
    if not family.sampled:
        return "no start was given, so that all motions are shown and none is followed"
    if nutation := family.quantity("nutation"):
        return f"{motion.case}, {nutation.value(motion)} against small nutations"
    kind = str(motion.kind)
    if kind == "ball":
        kind = "it turns as a ball does, about its momentum"
    if kind == "free body":
        kind = "spin about its axis" if is_still(item) else "free precession"
    elif kind == "Euler's top":
        kind = "it tumbles freely, as Euler's top"
    elif kind == "spin about an axis" and "axis" in getattr(motion, "mode", ""):
        kind = f"spin about its {motion.mode}"
    says = "its axis nods" if kind.startswith("nutation") else kind
    says = says.replace("on a torus", "it turns with three frequencies")
    stable = is_stable(item)
    return says if stable is None else f"{says}, {'stable' if stable else 'unstable'} against small nutations"


def has_mean_rates(item: FamilyObject) -> bool:
    """Return whether the axis of a motion goes round unevenly, so that its rate of precession is a mean."""
    kind = str(getattr(item.kernels(), "kind", ""))
    return kind.startswith("nutation") or kind in {"ball", "Euler's top", "on a torus"}


def is_stable(item: FamilyObject) -> bool | None:
    """Return whether a motion whose axis keeps its angle is stable against small nutations.

    None where this is undecided, and for a motion whose axis nods.
    """
    family, motion = item.family, item.kernels()
    if family.takes("coupling"):
        return getattr(motion, "stable", None)
    if motion.kind == "spin about an axis" and family.takes("omega"):
        return spins_on(*(list(map(Fraction, values)) for values in item.exact))
    if not family.takes("ratio"):
        return None
    ratio, field, (omega1, omega2, omega3) = item.floats
    if motion.kind == "spin along the field":
        I, b = Fraction(getattr(ratio, "ratio", ratio)), Fraction(field[1])
        gap = I * I * (Fraction(omega3) + b) ** 2 + 4 * (1 - I) * b * b
        return gap > 0 if gap else None
    if motion.kind == "precession":
        from atlas.motions.elementary.certified_hyperbola import Hyperbola

        if not omega1 and field[0] and omega2 != -field[0]:
            return bool(Hyperbola(*item.exact[:2]).stable(omega2))
    return None


def spins_on(moments: Sequence[Fraction], field: Sequence[Fraction], omega: Sequence[Fraction]) -> bool | None:
    """Return whether a spin about a principal axis, along the field if there is one, is linearly stable.

    Principal ``moments``, ``field`` B' and ``omega`` are three numbers each along the principal axes; omega has one
    component that is not zero. Call its axis the third, K the field's component along it, and W the sum of K and that
    component. Small components W1, W2 of Omega + K and K1, K2 of the field in the body obey W1' = r1 (W W2 - K K2),
    W2' = r2 (W W1 - K K1), K1' = W K2 - K W2, K2' = K W1 - W K1, where r1 = (I2 - I3)/I1 and r2 = (I3 - I1)/I2.
    Solutions exp(s t) have s^4 + p s^2 + q = 0: they stay small where both s^2 are negative and different. None at a
    border, where the linear equations do not decide.
    """
    axis = next(i for i in range(3) if omega[i])
    I1, I2, I3 = (moments[(axis + i) % 3] for i in (1, 2, 3))
    W, K, r1, r2 = omega[axis] + field[axis], field[axis], (I2 - I3) / I1, (I3 - I1) / I2
    if not K:
        return r1 * r2 < 0 if r1 * r2 else None
    p, q = (1 - r1 * r2) * W * W + (r1 - r2) * K * K, -r1 * r2 * (W * W - K * K) ** 2
    gaps = p, q, p * p - 4 * q
    return all(x > 0 for x in gaps) if all(gaps) else None


def is_still(item: FamilyObject) -> bool:
    """Return whether a body is at rest, or spins about its symmetry or third axis along the field or without one.

    False for a top at rest whose axis is off the field, since it falls, and for an object without a start.
    """
    values = dict(zip((p.name for p in item.family.parameters), item.floats, strict=True))
    if not item.family.sampled or not {"field", "direction"} & values.keys() or not {"omega", "omega2"} & values.keys():
        return False
    *transverse, _ = values.get("direction") or values["field"]
    Omega = item.kernels().angular_velocity(0.0)
    return not any((*transverse, *Omega[:2])) or ("field" in values and not any(Omega))


def turns_over(item: FamilyObject) -> bool:
    """Return whether a free body of three moments starts near its middle axis, so that it turns over again and again.

    Near means that this axis has `NEAR_MIDDLE` of the angular momentum.
    """
    if str(item.kernels().kind) != "Euler's top" or not item.family.takes("inertia"):
        return False
    values = dict(zip((p.name for p in item.family.parameters), item.floats, strict=True))
    momenta = [(moment, abs(moment * rate)) for moment, rate in zip(values["inertia"], values["omega"], strict=True)]
    middle_momentum = float(sorted(momenta)[1][1])
    return middle_momentum > NEAR_MIDDLE * hypot(*(momentum for _, momentum in momenta))


def place_of(family: Family, motion: Any) -> str:
    """Return a sentence on whether the start of `motion` lies on the curve of motions without nutation.

    Without a start it is a sentence on all other starts.
    """
    if not family.sampled:
        return "Any other start makes the axis nod."
    if family.takes("omega2"):
        return "The given start lies on it: the axis keeps its angle with the field."
    if motion.kind == "ball":
        return "All axes of a ball are alike: the drawn one turns about the angular momentum, and that about the field."
    nods = str(motion.kind).startswith("nutation")
    return (
        "The given start lies off it, so that the axis nods." if nods else "From the given start the axis does not nod."
    )
