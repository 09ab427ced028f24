"""Motions whose quartic has a double root, in elementary functions, theorem-companion.

The quartic is q(nu) = (nu - r)^2 (nu - e)(nu - f) A, with A = (I-1) b^2, b = |B'| and nu = K3/b the cosine between the
axis and the field, see theorem-top. The motion starts at t = 0 from the simple root e, a turning point. Its kind is
told by c = q''(r)/2:

    c > 0   the separatrix of an unstable steady precession, which it leaves and joins as exp(-sqrt(c) |t|)
    c = 0   the same of a triple root, in rational functions of time
    c < 0   a periodic nutation, with the integrals of a stable steady precession but elsewhere on the sphere

With C = cosh(sqrt(c) t/2) and S = sinh(sqrt(c) t/2)/sqrt(c) (cos and sin for c < 0, 1 and t/2 for c = 0) the
Cayley-Klein parameters are exp(i lambda t) times constant combinations of C and S, up to a common real factor.
All frequencies share one unit. Constants are made in 256 bits from exact inputs and rounded once; the phases lambda t
and sqrt(c) t are plain floats, so errors grow as eps |t|, and next to a separatrix no faster.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.core.arithmetic.words import exact
from atlas.core.bodies.body import moments
from atlas.core.inputs import FloatArray, components, number, real
from atlas.core.surfaces.hyperbola import Hyperbola
from atlas.errors import DomainError
from atlas.formulas.domain import check_curve
from atlas.formulas.numbers import Number, nearest, root, workprec

ComplexArray = NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class Companion:
    """A motion from the turning point nu = e of a quartic with the double root r."""

    b: float
    """Length of B', in 1/time."""
    c3: float
    """Omega3 + K3, (40), in 1/time."""
    double: float
    """The double root r of q, a cosine."""
    turning: float
    """The simple root e at which nu starts, a cosine."""
    curvature: float
    """c = q''(r)/2 in 1/time^2: the square of the growth rate at the double root, minus that of its nutation."""
    rates: tuple[float, float]
    """Steady rates lambda_-, lambda_+ of the phases of alpha and beta, in 1/time."""
    weights: ComplexArray
    """Shape (2, 2): alpha and beta at rest in these phases as combinations of C and S."""

    @property
    def kind(self) -> str:
        """Return "separatrix", "triple root" or "periodic", by the sign of c."""
        return "separatrix" if self.curvature > 0 else "periodic" if self.curvature < 0 else "triple root"

    def cayley_klein(self, t: Any) -> ComplexArray:
        """Cayley-Klein parameters (alpha, beta), normalised, shape (..., 2), theorem-companion.

        alpha = cos(theta/2) exp(i (psi + chi)/2), beta = sin(theta/2) exp(i (psi - chi)/2) with Euler angles psi about
        B', theta, chi about the axis of the body; psi = chi = 0 at t = 0.
        """
        pair, _ = self._pair(t)
        return np.asarray(pair / np.linalg.norm(pair, axis=-1, keepdims=True))

    def cosine(self, t: Any) -> FloatArray:
        """Cosine nu = K3/b between the axis and B', theorem-companion-nutation; shape of t."""
        alpha, beta = np.moveaxis(np.abs(self._pair(t)[0]) ** 2, -1, 0)
        return np.asarray((alpha - beta) / (alpha + beta))

    def angular_velocity(self, t: Any, start: float = 0.0) -> FloatArray:
        """Angular velocity Omega(t) in the body, shape (..., 3), 1/time; K(start) lies in the plane (e2, e3)."""
        pair, rate = self._pair(t, start)
        across = 2 * (pair[..., 0].conj() * rate[..., 1] - rate[..., 0].conj() * pair[..., 1])
        across = across / (np.abs(pair) ** 2).sum(-1)
        return np.stack([across.real, across.imag, self.c3 - self.b * self.cosine(t)], axis=-1)

    def field_in_body(self, t: Any, start: float = 0.0) -> FloatArray:
        """Field K(t) in the body, (32), shape (..., 3), 1/time; at t = start it is (0, B2, B3) with B2 >= 0."""
        return np.asarray(self.b * self._attitude(t, start)[..., 2, :])

    def rotation(self, t: Any, start: float = 0.0) -> FloatArray:
        """Rotation matrix R(t) with R(start) = 1 in the laboratory where B' = K(start); shape (..., 3, 3).

        It solves (12) and (16) with omega = `angular_velocity(start, start)`.
        """
        return np.asarray(self._attitude(start, start).T @ self._attitude(t, start))

    def _pair(self, t: Any, start: float | None = None) -> tuple[ComplexArray, ComplexArray]:
        """Return alpha and beta and their rates, both up to one real factor; psi as it comes, chi = 0 at start."""
        t = real(t, "The time")
        functions, slopes = _basis(self.curvature, t)
        rates = np.array(self.rates)
        turn = np.exp(1j * t[..., None] * rates)
        if start is not None:
            alpha, beta = self._pair(start)[0]
            chi = np.angle(alpha * beta.conj()) if alpha and beta else 0.0
            turn *= np.exp(np.array([-0.5j, 0.5j]) * chi)
        pair = functions @ self.weights.T
        return turn * pair, turn * (slopes @ self.weights.T + 1j * rates * pair)

    def _attitude(self, t: Any, start: float) -> FloatArray:
        """Return R_z(psi) R_x(theta) R_z(chi), shape (..., 3, 3)."""
        pair = self._pair(t, start)[0]
        a, b = np.moveaxis(pair / np.linalg.norm(pair, axis=-1, keepdims=True), -1, 0)
        w, z, x, y = a.real, a.imag, b.real, b.imag
        rows = [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
        return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def companions(ratio: Any, field: Any, omega2: Any) -> tuple[Companion, ...]:
    """Motions with the integrals E', c3, c5 of an elementary motion that are not it, theorem-companion.

    `ratio` I = I3/I2 or a SymmetricBody, `field` = (B2, B3), B2 not 0, and `omega2` as for ElementaryMotion. Returns
    both, the one that starts at the larger cosine first (for c < 0 they are one orbit from either end); one where the
    double root is triple, c = 0, or there is a second one; and none where I >= 1 or x^2 = ((omega2 + B2)/B2)^2 is
    outside (1-I) [B3^2/b^2, 1], theorem-companion-range.
    """
    I2, I3 = moments(ratio)
    B2, B3 = (
        number(x, name) for x, name in zip(components(field, ("B2", "B3"), "The field"), ("B2", "B3"), strict=True)
    )
    w2 = number(omega2, "omega2")
    if not B2:
        raise DomainError("With B2 = 0 the elementary motions turn about the field: see `TopMotion.sleeping_bands`.")
    check_curve(B2, w2)
    i2, i3, b2, b3, omega = exact(I2, I3, B2, B3, w2)
    less = (i2 - i3) / i2
    if less <= 0:
        return ()
    # (1 - z)(z - r^2) of two rational numbers, so that its sign is certain
    square, across = b2 * b2 + b3 * b3, (omega + b2) / b2
    z, r2 = across * across / less, b3 * b3 / square
    inside = (1 - z) * (z - r2)
    if inside < 0 or z == 0:
        return ()
    with workprec():
        b = root(square)
        r, reach = b3 / b, root(inside / z)
        roots = [-r + reach, -r - reach] if inside != 0 else [-r]
        c = 0.0 - Hyperbola(ratio, field).stability(w2)
        if not c:
            roots = [max(roots, key=lambda e: nearest(abs(e - r)))]
        return tuple(_companion(i3 / i2, b, r, across * b, e, c) for e in roots)


def _companion(I: Number, b: Number, r: Number, w: Number, e: Number, c: float) -> Companion:
    """Return the motion that starts at nu = e = cos(2 delta), beside the steady precession w at nu = r."""
    A = (I - 1) * b * b
    ahead = A * r / (w * w)
    up, down = root((1 + e) / 2), root((1 - e) / 2)
    g = root(-A / (w * w) - 1)  # tan(gamma), of the sign of (A r/w^2 - e)/sin(2 delta)
    if ahead - e < 0:
        g = -g
    step = w * (e - r)
    weights = [
        [nearest(up), -1j * nearest(step * (up + g * down))],
        [nearest(down), 1j * nearest(step * (down - g * up))],
    ]
    M3 = r * (w * w + A) / w
    c3 = M3 / I
    rates = (c3 - M3 - b + w * (1 + ahead)) / 2, (M3 - c3 - b + w * (1 - ahead)) / 2
    return Companion(
        b=nearest(b),
        c3=nearest(c3),
        double=nearest(r),
        turning=nearest(e),
        curvature=c,
        rates=(nearest(rates[0]), nearest(rates[1])),
        weights=np.array(weights),
    )


def _basis(c: float, t: FloatArray) -> tuple[ComplexArray, ComplexArray]:
    """Return C, S and their rates, shape (..., 2), over C for c > 0, lest they overflow."""
    k = np.sqrt(abs(c))
    x = k * t / 2
    if c > 0:
        C, S = np.ones_like(t), np.tanh(x) / k
    elif c < 0:
        C, S = np.cos(x), np.sin(x) / k
    else:
        C, S = np.ones_like(t), t / 2
    functions, slopes = np.stack([C, S], -1), np.stack([c / 2 * S, C / 2], -1)
    return functions.astype(np.complex128), slopes.astype(np.complex128)
