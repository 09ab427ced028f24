"""The two vectors of constant length that move with Omega3: the field in the body, and the angular velocity.

A unit vector is a pair (alpha, beta) up to a factor: cos and sin of half its polar angle, with phases. Both pairs are
functions of one form, told apart by where Omega3 has its poles:

    alpha'/alpha = [-u' + i T]/(2 (U - u)) + i f,    T the torque at the pole U, -Q(U) = T^2,
    beta'/beta   = [ u' + i T]/(2 (u - U)) + i f,    and another T, U, f for beta,

each with one simple zero in a cell of the lattice. For K, of length b, the poles are c3 ± b, where the torque is
(M,K) ± b M3, and f is the rate of Larmor's frame. For the angular velocity the vector is (Omega2, Omega1,
-sqrt(I) Omega3), whose length is sqrt(E'); its poles are ± sqrt(E'/I), the torque there is
P(u) = u^2 - (2-I) c3 u + c5, and f = 0. So Omega keeps its digits however slow the body turns beside its Larmor frame.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from flint import acb, arb, fmpq

from atlas.arithmetic.certified_inputs import Real
from atlas.arithmetic.certified_surd import Surd
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import root
from atlas.motions.nutation.certified_quartic import Quartic, Vector

POLES = (-1, 1)


@dataclass(frozen=True)
class Sphere:
    """Sphere on which a vector moves in the body, with its poles -1 (of alpha) and 1 (of beta) as keys.

    The vector is K, a top's b = R^T n, or (Omega2, Omega1, -sqrt(I) Omega3). At a pole it would be along the axis:
    `poles` are the values of the quartic's variable u there, `torques` are T with T^2 = -Q(u), `signs` their exact
    signs, and `frames` the rates, in rad/time, of the phases of alpha and beta that the frame gives. `start` is the
    vector at t = 0, of this `length`. `slopes` are the derivatives of alpha and beta at t = 0, for the one that is zero
    there. The frame has the rates `precession` about the field and `spin` about the axis, in rad/time.
    """

    start: tuple[Real, Real, Real]
    length: Real
    poles: Mapping[int, arb]
    torques: Mapping[int, arb]
    signs: Mapping[int, int]
    frames: Mapping[int, Real]
    slopes: Mapping[int, acb]
    precession: Real
    spin: Real

    @cached_property
    def tilt(self) -> tuple[Real, Real, Real, Real]:
        """Tilt of `start`: (cos, sin of half the polar angle, cos, sin of the azimuth), see `tilt_of`.

        The azimuth is 0 along the second axis and a right angle along the first.
        """
        return tilt_of(self.start, self.length)


def tilt_of(vector: Sequence[Real], length: Real) -> tuple[Real, Real, Real, Real]:
    """Return (cos, sin of half the polar angle, cos, sin of the azimuth) of a vector (x, y, z) of this ``length``.

    Each is a rational or a ball. The azimuth runs from the second axis to the first: cos = y/h, sin = x/h, h the length
    of (x, y). It is 0 for a vector along the third axis.
    """
    x, y, z = vector
    if x == 0 and y == 0:
        return (fmpq(1), fmpq(0), fmpq(1), fmpq(0)) if z >= 0 else (fmpq(0), fmpq(1), fmpq(1), fmpq(0))
    flat = abs(y) if x == 0 else root(x * x + y * y)
    # of the two halves the one that does not cancel first
    longer = arb((1 + abs(arb(z) / length)) / 2).sqrt()
    shorter = arb(flat) / (2 * longer * length)
    return (longer, shorter, y / flat, x / flat) if z >= 0 else (shorter, longer, y / flat, x / flat)


def sphere_of_field(q: Quartic, axis: Vector) -> Sphere:
    """Return the `Sphere` on which K moves; of a free body, where K = 0, the sphere of its momentum.

    ``q`` is the quartic of the motion, `axis` is K, or the momentum, at t = 0, three rationals.
    """
    (w1, w2, _), (x, y, z) = q.Omega, axis
    b = root(q.K2)
    return Sphere(
        start=axis,
        length=root(x * x + y * y + z * z),
        poles={pole: q.c3 - pole * arb(b) for pole in POLES},
        torques={pole: q.momentum - pole * arb(b) * q.I * q.c3 for pole in POLES},
        signs={pole: q.sign_beside(pole) for pole in POLES},
        frames={pole: (-b - pole * (1 - q.I) * q.c3) / 2 for pole in POLES},
        slopes={-1: acb(-w1, w2) / 2, 1: acb(w1, w2) / 2},
        precession=-b,
        spin=(1 - q.I) * q.c3,
    )


def sphere_of_velocity(q: Quartic) -> Sphere:
    """Return the `Sphere` of (Omega2, Omega1, -sqrt(I) Omega3), whose length is constant, for the quartic ``q``."""
    (w1, w2, w3), (K1, K2, _) = q.Omega, q.K
    square = q.E / q.I
    end, short = arb(root(square)), root(q.I)
    turn = acb(K1, K2) * acb(0, 1) * arb(short) / 2
    return Sphere(
        start=(w2, w1, -short * w3),
        length=root(q.E),
        poles={pole: -pole * end for pole in POLES},
        torques={pole: square + q.c5 + pole * (2 - q.I) * q.c3 * end for pole in POLES},
        signs={pole: (Surd.root(square) * (pole * (2 - q.I) * q.c3) + (square + q.c5)).sign for pole in POLES},
        frames={pole: fmpq(0) for pole in POLES},
        slopes={-1: turn, 1: -turn.conjugate()},
        precession=fmpq(0),
        spin=fmpq(0),
    )
