"""The constants, the quadric and the hyperbola of every symmetric top, theorem-top-quadric, in units of its moment I2.

The inputs are those of the theorem: I = I3/I2; k2 and k3 over I2; (n2, n3) a unit vector; a0 and A0 over I2.
"""

from collections.abc import Callable
from typing import Any

from atlas.arithmetic.numbers import Number, length, root
from atlas.surfaces import formula as quadric


def of_given(formula: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function of the inputs as given that scales by I2 and |n|, then applies ``formula``.

    Its inputs are I2, I3, k2, k3, n2, n3, a0, A0, n of any length, and further arguments of the formula.
    """

    def scaled(*numbers: Number) -> Any:
        I2, I3, k2, k3, n2, n3, a0, A0, *arguments = numbers
        size = length(n2, n3)
        return formula(I3 / I2, k2 / I2, k3 / I2, n2 / size, n3 / size, a0 / I2, A0 / I2, *arguments)

    return scaled


def constants(
    I: Number, k2: Number, k3: Number, n2: Number, n3: Number, a0: Number, A0: Number,
    omega1: Number, omega2: Number, omega3: Number,
) -> tuple[Number, Number, Number]:  # fmt: skip
    """Return (twice the energy, momentum M3 along the axis, momentum p = (M, n) along n), M = I Omega + k n.

    All are in units of I2: I is I3/I2, k2, k3, a0 and A0 are over I2, (n2, n3) has length 1; omega is along the body's
    axes in rad/time.
    """
    pull, M3 = n3 * a0, n3 * k3 + I * omega3
    energy = n3 * n3 * A0 + pull + pull + (omega1 * omega1 + omega2 * omega2 + I * omega3 * omega3)
    return energy, M3, (n2 * k2 + omega2) * n2 + M3 * n3


def centre(I: Number, k2: Number, k3: Number, n2: Number, n3: Number, a0: Number, A0: Number) -> tuple[Number, Number]:
    """Return the centre (omega2, omega3) of the quadric of a top, where w = v = 0 (see `TopQuadric`), in rad/time.

    I is I3/I2, k2, k3, a0 and A0 are over I2, (n2, n3) has length 1.
    """
    del a0, A0
    turn = k3 / I
    twist = k2 - turn
    return -(n2 * turn), n3 / I * (twist + twist - k3)


def excess(I: Number, k2: Number, k3: Number, n2: Number, n3: Number, a0: Number, A0: Number) -> Number:
    """Return n3 D, see `atlas.surfaces.kernel.TopQuadric`, finite for n3 = 0 too; for the paper's body (I - 1) B3 b.

    In 1/time^2. I is I3/I2, k2, k3, a0 and A0 are over I2, (n2, n3) has length 1.
    """
    del n2
    turn = k3 / I
    return n3 * (turn * (k3 + turn - (k2 + k2)) + A0) + a0


def D(*numbers: Number) -> Number:
    """Return D of `atlas.surfaces.kernel.TopQuadric`, in 1/time^2, for n3 not zero; ``numbers`` as for `excess`."""
    return excess(*numbers) / numbers[4]


def semi_axes(*numbers: Number) -> tuple[Number, Number, Number]:
    """Return the roots of |D| n2^2 (1, |a2|, |a3|), in rad/time; ``numbers`` as for `excess`, n2 and n3 not zero."""
    I, _, _, n2, n3, *_ = numbers
    square, body = abs(D(*numbers)) * n2 * n2, (n2 / n2, I, n2, n3)
    return root(square), root(square * abs(quadric.a2(*body))), root(square * abs(quadric.a3(*body)))


def residual(
    I: Number, k2: Number, k3: Number, n2: Number, n3: Number, a0: Number, A0: Number,
    omega1: Number, omega2: Number, omega3: Number,
) -> Number:  # fmt: skip
    """Return n3 (omega1^2 + w^2) - I n2 w v + n2^2 n3 D, which is -d^2 nu/dt^2 at t = 0, nu = cos theta.

    In 1/time^2, of a start with omega along the body's axes in rad/time; w, v and D as in
    `atlas.surfaces.kernel.TopQuadric`, the other arguments as for `excess`.
    """
    top = I, k2, k3, n2, n3, a0, A0
    second, third = centre(*top)
    w, v = omega2 - second, omega3 - third
    return n3 * (omega1 * omega1 + w * w) + n2 * (n2 * excess(*top) - I * w * v)


def omega3(*top_and_omega2: Number) -> Number:
    """Return omega3 at omega2 by v(w) of the hyperbola, theorem-top-hyperbola, for n2 and w not zero, in rad/time.

    The arguments are I, k2, k3, n2, n3, a0, A0, as in the module, and omega2.
    """
    *top, omega2 = top_and_omega2
    I, _, _, n2, n3, *_ = top
    second, third = centre(*top)
    w = omega2 - second
    return (n3 / n2 * w + n2 * excess(*top) / w) / I + third


def frequencies(*top_and_omega2: Number) -> tuple[Number, Number]:
    """Return the rates (omega2/n2 of precession about n, omega3 - n3 omega2/n2 of the turn about the body's axis).

    The arguments are I, k2, k3, n2, n3, a0, A0 in units of I2, with n of length 1 and n2 not 0, and omega2.
    """
    *top, omega2 = top_and_omega2
    precession = omega2 / top[3]
    return precession, omega3(*top, omega2) - top[4] * precession


def stability(*top_and_omega2: Number) -> Number:
    """Return the square of the frequency of small nutations at omega2, in 1/time^2; negative if unstable.

    Arguments as for `omega3`. By theorem-top-nutation, w of which is here u = omega2/n2 + k2. With x = u - kappa,
    M3 x = n3 u^2 + a0 + A n3 and (a + A n3)/u = (kappa n3 u + a0 + A n3)/x.
    """
    *(I, k2, k3, n2, n3, a0, A0), omega2 = top_and_omega2
    turn = k3 / I
    kappa, A = k2 - turn, A0 + turn * k3 - k2 * k2
    u, x = omega2 / n2 + k2, omega2 / n2 + turn
    force = a0 + A * n3
    pull = (kappa * n3 * u + force) / x
    M3 = (n3 * u * u + force) / x
    linear = n3 * (kappa * M3 + a0)
    square = n3 * n3
    return u * u + pull * pull + A * (n2 * n2 - (square + square)) - (linear + linear)
