"""The spectral curve of a motion on a torus, with its certified numbers, theorem-clebsch, for further analysis.

Over the body's curve v^2 = P(z) = prod(z + D/I_i) it is eta^2 = g(z) + 2 c v, g = K^2 z^2 + (F + e2 K^2) z + 2 D H,
c = (M, K), D = I1 I2 I3, e2 = I1 I2 + I1 I3 + I2 I3: of genus 3, with an involution eta -> -eta, whose Prym variety of
type (1, 2) is the torus. Its branch points over that curve are the zeros of g + 2 c v: z a root of g^2 - 4 c^2 P, and
v = -g/2c. All coefficients are rational, of the inputs as doubles or decimals.
"""

from math import log2
from typing import TYPE_CHECKING, Any

from flint import acb, acb_mat, arb, ctx, fmpq, fmpq_poly

from atlas.arithmetic.certified_digits import certified
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import by_precision, workprec
from atlas.errors import DomainError, NotCertifiedError
from atlas.motions.torus.approximate_theta import ThetaMotion
from atlas.motions.torus.approximate_theta_sums import CHARACTERISTICS
from atlas.motions.torus.certified import AsymmetricMotion
from atlas.motions.torus.certified_cycles import action, cycles, riemann_matrix

if TYPE_CHECKING:
    from atlas.motions.torus.approximate_periods import Integrals

BITS_A_DIGIT = log2(10)

APPROXIMATE, BITS = 30, 200
"""Digits of a Riemann matrix that is not proved, of some 50 that are computed, and the bits of the computation."""


CYCLE_BITS = 64
"""Bits of periods by which it is told which cycles they are."""


class SpectralCurve:
    """Spectral curve of one certified motion, in the given units; `record(digits)` returns its data as strings.

    Raises DomainError for a motion that is not on a torus.
    """

    def __init__(self, motion: AsymmetricMotion) -> None:
        on = motion.on_torus
        if on is None:
            raise DomainError(f"There is no torus with a spectral curve: the motion is {motion.kind}.")
        self.motion, self.torus, self.rate, self.unit = motion, on.torus, on.rate, motion.inertia[0] / on.moments[0]
        self.integrals: Integrals = motion.invariants

    @property
    def periods(self) -> list[list[arb]]:
        """Two lists [T_H, T_F, angle] of balls: times of the flows of H and F/2 that together bring M and K back.

        R is then rotated about B' by the angle, in rad, in Larmor's frame. T_H is in time, T_F in time/inertia. Raises
        NotCertifiedError where no periods are proved.
        """
        periods = self.torus.periods(int(ctx.prec) + 32)
        return [[p.H / self.rate, p.F / (self.rate * self.unit), p.angle] for p in periods]

    @property
    def winding_numbers(self) -> list[Any]:
        """Ratios [f2/f1, f3/f1] of the frequencies, as balls. Raises DomainError where no periods are proved."""
        f1, f2, f3 = self.motion.frequencies
        return [f2 / f1, f3 / f1]

    @property
    def actions(self) -> list[arb]:
        """List [J1, J2, J3] of balls in inertia/time, the actions whose rates are the `frequencies`; J3 = (M, K)/|K|.

        J1 and J2 are integrals of eta du over cycles, see `atlas.motions.torus.certified_cycles`. Raises
        NotCertifiedError where they are not proved.
        """
        i = self.torus.integrals
        b = arb(i.square).sqrt()
        J = [*(action(self._cycles, p.least(), i.c, b) for p in self.torus.periods(CYCLE_BITS)), arb(i.c) / b]
        return [x * self.unit * self.rate for x in J]

    @by_precision
    def _cycles(self) -> list[list[acb]]:
        return cycles(self.torus.integrals, self.torus.lattice)

    @cached_property
    def theta(self) -> ThetaMotion:
        """The `ThetaMotion` of this motion: its numbers are approximate.

        Raises NotCertifiedError where theta functions are not found.
        """
        return ThetaMotion(self.torus.integrals, self.torus.W, self.torus.K, self.torus.lattice)

    def record(self, digits: int = 20) -> dict[str, Any]:
        """Return the curve as a dictionary of texts and lists, with `digits` proven digits of each real number.

        `g`, `P`, `quartic` (coefficients, lowest power first), `c` and `body_branch_points` are rational. A complex
        number is a pair. `actions` and `riemann_matrix` are proven, but that the cycles are a basis of type (1,2) rests
        on integer relations. `not_proved` is a dictionary of what is computed alone: `characteristics` [e; d] of the
        theta functions of K and M, or `missing` with the reason. Where a zero of eta is so near to another that
        integrals are not proved, it has the reason under `actions`, and `riemann_matrix` to 30 digits if found.
        """
        i = self.integrals
        record, less = certified(self._proven, digits), self._approximate()
        try:
            record["actions"] = certified(lambda: self.actions, digits)
            with workprec(int(digits * BITS_A_DIGIT) + 64):
                record["riemann_matrix"] = _matrix(riemann_matrix(self._cycles), digits)
            less.pop("riemann_matrix", None)
        except NotCertifiedError as reason:
            less.setdefault("actions", str(reason))
        return {
            "curve": "eta^2 = g(z) + 2*c*v, v^2 = P(z)",
            "g": _texts(i.g), "c": str(i.c), "P": _texts(i.P), "quartic": _texts(i.quartic),
            "body_branch_points": [str(-i.D / I) for I in i.moments],
            **record,
            "not_proved": less,
        }  # fmt: skip

    def _proven(self) -> dict[str, Any]:
        return {
            "branch_points": [[[z.real, z.imag], [v.real, v.imag]] for z, v in self.integrals.zeros()],
            "periods": self.periods,
            "frequencies": self.motion.frequencies,
            "winding_numbers": self.winding_numbers,
        }

    def _approximate(self) -> dict[str, Any]:
        try:
            with workprec(BITS):
                matrix = _matrix(self.theta.tau, APPROXIMATE)
            forms = {"denominator": self.theta.denominator}
            forms |= {f"{name}{j + 1}": value for name, values in (("K", self.theta.K), ("M", self.theta.M))
                      for j, value in enumerate(values)}  # fmt: skip
            return {
                "riemann_matrix": matrix,
                "characteristics": {name: list(CHARACTERISTICS[value.place]) for name, value in forms.items()},
            }
        except NotCertifiedError as reason:
            return {"missing": str(reason)}


def _texts(polynomial: fmpq_poly) -> list[str]:
    """Return the coefficients of a polynomial as strings, lowest power first."""
    return [str(fmpq(x)) for x in polynomial.coeffs()]


def _matrix(tau: acb_mat, digits: int) -> list[list[list[str]]]:
    """Return the entries of ``tau`` as [real, imaginary], strings of `digits` digits; "0" below 10^-digits."""
    least = arb(10) ** -digits

    def text(x: arb) -> str:
        return "0" if abs(x) < least else x.str(digits, radius=False)

    return [[[text(x.real), text(x.imag)] for x in row] for row in tau.tolist()]
