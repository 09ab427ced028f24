"""A spin along the field, B2 = 0: whether it is stable, how it tips over if not, and how it nutates when pushed.

With M3 = I (omega3 + B3), A = (I-1) B3^2 and D = M3^2 - 4 A the spin is stable for D >= 0 (M3 not 0) and unstable for
D < 0, theorem-axis-stable, theorem-axis-escape: only a disk, I > 1, that nearly turns with Larmor's frame tips over.
"""

from dataclasses import dataclass
from math import inf, pi
from typing import Any

import numpy as np

from atlas.core.arithmetic.words import exact
from atlas.core.body import moments
from atlas.core.inputs import number
from atlas.core.separatrix import Companion
from atlas.errors import DomainError
from atlas.formulas.numbers import nearest, root, workprec


@dataclass(frozen=True)
class Nutation:
    """How the axis moves that was pushed out of the field's direction."""

    turning: float
    """The cosine nu at which it turns back; -1 if it swings over to the other end of the field's axis."""
    period: float
    """Time from nu = 1 to `turning` and back."""


def escape(ratio: Any, B3: Any, omega3: Any) -> Companion:
    """Motion that leaves the unstable spin omega3 about the field and comes back to it, theorem-axis-escape.

    `ratio` I = I3/I2 or a SymmetricBody, `B3` > 0 the field along the axis, `omega3` the spin. It turns back where
    nu = |M3|/(b sqrt(I-1)) - 1, M3 = I (omega3 + B3). For M3 = 0 it does not turn back but tips over from one end of
    the field's axis to the other, theorem-axis-pendulum, and t = 0 is where nu = 0: `turning` is -1 then, as is what it
    tends to. DomainError unless D = M3^2 - 4 (I-1) B3^2 is negative, for then the spin is stable.
    """
    I2, I3 = moments(ratio)
    field, spin = number(B3, "B3"), number(omega3, "omega3")
    if field <= 0:
        raise DomainError(f"Choose the axis of the body along the field, so that B3 > 0, not {field}.")
    i2, i3, b, w3 = exact(I2, I3, field, spin)
    I = i3 / i2
    c3 = w3 + b
    M3, A = I * c3, (I - 1) * b * b
    c = 4 * A - M3 * M3
    if c <= 0:
        raise DomainError(
            f"The spin omega3 = {spin} about B3 = {field} is stable: D = I^2 (omega3 + B3)^2 + 4 (1-I) B3^2 is not "
            "negative, theorem-axis-stable, so no motion leaves it."
        )
    rates = nearest((c3 - b) / 2), nearest((M3 - c3 - b) / 2)
    with workprec():
        if M3 == 0:
            lean = nearest(root(A))
            weights = np.array([[1.0, -lean, 0.0], [1.0, lean, 0.0]], dtype=np.complex128)
            return Companion(field, 0.0, 1.0, -1.0, nearest(c), rates, weights, slow=True)
        e = abs(M3) / root(A) - 1
        up, down = root((1 + e) / 2), root((1 - e) / 2)
        slope = M3 * (e - 1) / (2 * up)
        weights = np.array([[nearest(up), -1j * nearest(slope), 0.0], [0.0, 0.0, nearest(down)]])
        return Companion(field, nearest(c3), 1.0, nearest(e), nearest(c), rates, weights)


def pushed(ratio: Any, B3: Any, omega3: Any, push: Any) -> Nutation:
    """Return the turning point and the period of a spin about the field that was pushed, theorem-axis-pushed.

    `ratio` I = I3/I2 or a SymmetricBody, `B3` the field along the axis, of either sign and not 0; `omega3` and `push` =
    |omega1|, not 0, the initial angular velocity, in one unit 1/time. With x = tan(theta/2)^2 the motion is
    dx^2 = x c(x), c = s^2 (1+x)^2 + x (4 A - M3^2 (1+x)^2), and turns at the least positive root e of c. With the other
    roots f, g of that cubic the period is 2 pi/(|M3| agm(y, z)), y^2 = -f (e-g), z^2 = -g (e-f). For M3 = 0 it is
    that of a pendulum, dtheta^2 = s^2 + A sin(theta)^2. In plain floats, to about 1e-12; as the push s goes to 0 where
    D < 0 and M3 is not 0, the period grows as (4/sqrt(-D)) log(1/s).
    """
    from scipy.special import agm

    I2, I3 = moments(ratio)
    field, spin, s = number(B3, "B3"), number(omega3, "omega3"), abs(number(push, "The push"))
    if not (field and s):
        raise DomainError("The field along the axis and the push must not be zero.")
    i2, i3, b, w3 = exact(I2, number(I3, "The ratio I"), field, spin)
    M3, A = abs(nearest(i3 / i2 * (w3 + b))), nearest((i3 - i2) / i2 * b * b)
    if not M3:
        return _plane(s, A)
    c = np.array([-M3 * M3, s * s - 2 * M3 * M3, 2 * s * s + 4 * A - M3 * M3, s * s])
    roots = np.roots(c)
    e = float(min(x.real for x in roots if abs(x.imag) <= 1e-9 * abs(x) and x.real > 0))
    e -= float(np.polyval(c, e) / np.polyval(np.polyder(c), e))
    # f + g and f g from the coefficients: apart they are ill-conditioned near I = 1, where f = g = -1
    product = s * s / (M3 * M3 * e)
    minus_sum = e + 2 - s * s / (M3 * M3)
    yz = np.sqrt(product * (e * e + minus_sum * e + product))
    mean = agm(np.sqrt(minus_sum * e + 2 * product + 2 * yz) / 2, np.sqrt(yz))
    return Nutation((1 - e) / (1 + e), 2 * pi / (M3 * float(mean)))


def _plane(s: float, A: float) -> Nutation:
    """Return the nutation of a body at rest in Larmor's frame: a plane pendulum, dtheta^2 = s^2 + A sin(theta)^2."""
    from scipy.special import agm

    rest = s * s + A
    if rest > 0:
        return Nutation(-1.0, 2 * pi / float(agm(s, np.sqrt(rest))))
    if rest < 0:
        return Nutation(float(np.sqrt(rest / A)), pi / float(agm(np.sqrt(-A), np.sqrt(-rest))))
    return Nutation(0.0, inf)
