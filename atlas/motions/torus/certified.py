"""Any motion of a charged body with three moments of inertia, as balls, at any time (not in the paper).

Seen from the frame that turns with -B' the body moves as Clebsch's case of Kirchhoff's equations, theorem-clebsch, on a
torus on which two flows commute. Times are reduced modulo the periods of both, `atlas.motions.torus.certified_torus`,
and the remainder goes by Taylor series, `atlas.motions.torus.certified_flow`:

    R(t) = R_B(-b t + n1 theta1 + n2 theta2) S(s),    (t, 0) = n1 r1 + n2 r2 + s.

Nothing is taken from the theory of theta functions but where to look for the periods, which are then proved.
"""

from collections.abc import Iterable
from itertools import chain
from operator import mul
from typing import Any

from flint import arb, arb_poly, ctx, fmpq

from atlas.arithmetic.certified_inputs import Real, rational, rationals
from atlas.arithmetic.certified_rotation import AXES, identity, product, turn
from atlas.arithmetic.numbers import applied, dot, workprec
from atlas.arithmetic.numbers import nearest as nearest_float
from atlas.errors import DomainError, NotCertifiedError
from atlas.motions.nutation.certified_cayley_klein import matrix
from atlas.motions.nutation.certified_elliptic import EllipticMotion, EulerTop, check_moments
from atlas.motions.nutation.certified_general import Symmetric
from atlas.motions.torus.approximate_periods import Integrals, nearest
from atlas.motions.torus.certified_flow import Arrival, GrowthError
from atlas.motions.torus.certified_torus import Torus, frequencies, rotated

NEAR = fmpq(1, 1 << 16)
"""Longest time of the single series about t = 0, whose numbers keep their relative accuracy however small."""

MAX_DIRECT_TIME = 16
"""Longest time, in 1/rate, that is integrated at once, without periods."""

MAX_FLOW_TIME = 128
"""Longest time, in 1/rate, where there are no periods."""

STATE_CACHE_SIZE = 4096
"""Size of the cache of states, for further quantities at the same times."""

MAX_GROWTH_PRECISION = 600
"""Bits from which on growing errors get no more."""

GUARD_BITS = 48
"""Bits of a flow beyond those of the matrix: the usual loss on the way."""


class OnTorus:
    """A certified motion on its torus, or on a closed curve where the torus degenerates.

    It is made of moments (three different ones), Omega and K along the principal axes at t = 0. Moments, field and
    times are divided by powers of two that make the largest of them near one; `rate` is the one of 1/time. `torus`
    has the periods and the flows.
    """

    def __init__(self, moments: tuple[fmpq, ...], Omega: tuple[fmpq, ...], K: tuple[fmpq, ...]) -> None:
        unit, self.rate = _power(max(moments)), _power(max(map(abs, (*Omega, *K))))
        self.moments = tuple(I / unit for I in moments)
        self.field = tuple(k / self.rate for k in K)
        W = tuple(w / self.rate + k for w, k in zip(Omega, self.field, strict=True))
        self.torus = Torus(self.moments, W, self.field)
        self.pendulum = next((i for i in range(3) if not any((K[i], W[i - 1], W[i - 2]))), None)
        """The axis about which the body swings in Larmor's frame, in the plane of the field, where it does."""
        self._arrived: dict[tuple[fmpq, int], tuple[Arrival, arb]] = {}

    @property
    def b(self) -> arb:
        """Length |B'| of the field, in units of `rate`, as a ball at the precision of the moment; 0 for a free body."""
        return arb(dot(self.field, self.field)).sqrt()

    @property
    def is_regular(self) -> bool:
        """Whether both flows are independent on the torus: H, F and the Casimirs are no critical values."""
        return bool(self.torus.integrals.double_points().degree() == 0)

    @property
    def frequencies(self) -> list[arb]:
        """Angular frequencies [f1, f2, f3], balls in rad/time: f1, f2 of M and K, and f3 about the field.

        Raises NotCertifiedError where no periods are proved.
        """
        periods = self.torus.periods(ctx.prec + GUARD_BITS)
        with workprec(ctx.prec + GUARD_BITS):
            return [x * self.rate for x in frequencies([p.least() for p in periods], self.b)]

    def elliptic(self) -> EllipticMotion | None:
        """Return this motion as an `EllipticMotion` with a rational z, if it is one, otherwise None.

        Its field is in the given unit, its moments are divided by the power of two.
        """
        z_polynomial, (W, K) = self.torus.integrals.double_points(), (self.torus.W, self.field)
        M = [I * w for I, w in zip(self.moments, W, strict=True)]
        D = self.moments[0] * self.moments[1] * self.moments[2]
        for z, _ in z_polynomial.roots():
            w = [z + D / I for I in self.moments]
            v = next((-m * x / k for m, k, x in zip(M, K, w, strict=True) if k != 0), fmpq(0))
            if v * v == w[0] * w[1] * w[2] != 0 and all(m * x == -v * k for m, k, x in zip(M, K, w, strict=True)):
                return EllipticMotion(self.moments, [k * self.rate for k in K], z, 1 if v > 0 else -1)
        return None

    def state(self, t: Any) -> tuple[Arrival, arb]:
        """Return (`Arrival` at time t, total angle about the field in rad, a ball).

        R is the rotation by this angle times S of the arrival, whose W and K are in units of `rate`. Cached by time and
        precision. Raises NotCertifiedError where the state cannot be enclosed.
        """
        t = rational(t, "the time") * self.rate
        key = t, ctx.prec
        arrived = self._arrived.get(key)
        if arrived is None:
            if len(self._arrived) >= STATE_CACHE_SIZE:
                self._arrived.clear()
            arrived = self._arrived[key] = self._state(t)
        return arrived

    def follow(self, times: Iterable[fmpq]) -> None:
        """Cache the states at times that only Taylor's series reaches, along one path in each direction of time.

        ``times`` are rationals in the given unit. At most `STATE_CACHE_SIZE` are cached; where the errors exceed
        their bounds, the other times are left to `state`.
        """
        ascending = sorted({t * self.rate for t in times} - {t for t, _ in self._arrived}, key=abs)
        if len(self._arrived) + len(ascending) > STATE_CACHE_SIZE:
            self._arrived.clear()
        for side in (1, -1):
            passed = [t for t in ascending if NEAR < side * t <= MAX_FLOW_TIME]
            if len(passed) < 2 or not self._without_periods(passed[-1]):
                continue
            end = passed[-1]
            try:
                arrivals = self.torus.flow.pass_by(end, [t / end for t in passed], ctx.prec + 2 * GUARD_BITS)
                for t, arrival in zip(passed, arrivals, strict=True):
                    self._arrived[t, ctx.prec] = arrival, self._turn(t)
            except NotCertifiedError:
                continue

    def _turn(self, t: fmpq) -> arb:
        """Return the total angle -|B'| t in rad, a ball, of Larmor's frame, which rotates about the field.

        t is in units of 1/`rate`.
        """
        with workprec(ctx.prec + GUARD_BITS + _digits_before_point(t)):
            return -t * self.b

    def _without_periods(self, t: fmpq) -> str:
        """Return the reason for which periods do not reduce time t, as a clause; "" if they do.

        t is in units of 1/`rate`.
        """
        if not self.is_regular:
            return "the motion is one where two periods of its torus fall together"
        if abs(t) > MAX_FLOW_TIME:
            return ""
        if self.torus.spin is not None and self.torus.pushed is None:
            return "the motion is next to an unstable spin"
        return "a period of its torus is long" if self.torus.is_long else ""

    def _state(self, t: fmpq) -> tuple[Arrival, arb]:
        bits, extra_bits, turn = ctx.prec + GUARD_BITS, _digits_before_point(t), self._turn(t)
        if abs(t) <= MAX_DIRECT_TIME:
            return self._along_series(t, bits), turn
        if why := self._without_periods(t):
            return self._directly(t, why), turn
        try:
            r1, r2 = self.torus.periods(ctx.prec + extra_bits)
        except NotCertifiedError as reason:
            return self._directly(t, str(reason).removeprefix("not certified: ").removesuffix(".")), turn
        with workprec(bits + extra_bits):
            area = r1.H * r2.F - r1.F * r2.H
            n, m = (nearest(x) for x in (t * r2.F / area, -t * r1.F / area))
            H, F = t - n * r1.H - m * r2.H, -n * r1.F - m * r2.F
            remaining = [x.mid() for x in (H, F)]
            arrival = self.torus.flow.go(remaining[0].fmpq(), remaining[1].fmpq(), bits)
            arrival = self._displaced(arrival, H - remaining[0], F - remaining[1])
            return arrival, n * r1.angle + m * r2.angle + turn

    def _directly(self, t: fmpq, why: str) -> Arrival:
        """Return the `Arrival` at t, in units of 1/`rate`, by Taylor's series from 0.

        Raises NotCertifiedError, with the reason ``why`` there are no periods, beyond `MAX_FLOW_TIME`.
        """
        if abs(t) > MAX_FLOW_TIME:
            raise NotCertifiedError(
                f"not certified: {why}, so that Taylor's series goes all the way, up to |t| = "
                f"{nearest_float(MAX_FLOW_TIME / self.rate):.6g}."
            )
        return self._along_series(t, ctx.prec + 2 * GUARD_BITS)

    def _along_series(self, t: fmpq, bits: int) -> Arrival:
        """Return the `Arrival` at t by Taylor's series, with ``bits`` doubled as long as errors grow too much.

        t is in units of 1/`rate`. Raises GrowthError beyond `MAX_GROWTH_PRECISION`.
        """
        while True:
            try:
                return self.torus.flow.go(t, fmpq(0), bits)
            except GrowthError:  # next to an unstable spin
                if bits > MAX_GROWTH_PRECISION:
                    raise
                bits *= 2

    def _displaced(self, arrival: Arrival, H: arb, F: arb) -> Arrival:
        """Return an `Arrival` moved by the flow of H for the tiny time H and that of F/2 for the tiny time F.

        ``arrival`` is the state before, the times are balls. Raises NotCertifiedError unless the state moves by
        less than 2^-16.
        """
        wide = [x + arb(0, 2.0**-16) for x in (*arrival.W, *arrival.K)]
        X, Y = self.torus.fields(wide[:3], wide[3:])
        ways = [H * x + F * y for x, y in zip(X, Y, strict=True)]
        if not all(arb(0, 2.0**-16).contains(x) for x in ways):
            raise NotCertifiedError("not certified: the periods are not known well enough for so long a time.")
        V = [(H + F * I) * w for I, w in zip(self.moments, wide, strict=False)]
        state = [x + y for x, y in zip((*arrival.W, *arrival.K), ways, strict=True)]
        return Arrival(state[:3], state[3:], rotated(arrival.q, V))

    def _series_at_zero(self, t: Any) -> list[list[arb]] | None:
        """Return five lists of three balls, Omega, K and the rows of R, by the Taylor series about t = 0.

        None where |t| `rate` is beyond NEAR; Omega and K are in units of `rate`, t in the given unit. With W =
        Omega + K, W_i' = (I_j - I_k)/I_i (W_j W_k - K_j K_k), and x' = [x, Omega] of K and of each row of R. Since
        I_j - I_k < I_i, with s the largest |W_i| or |K_i|, |W_n|, |K_n| <= s (2s)^n and |R_n| <= (n+1) (2s)^n.
        """
        t = rational(t, "the time") * self.rate
        if not abs(t) <= NEAR:
            return None
        I = self.moments
        W, K = [[arb(w)] for w in self.torus.W], [[arb(k)] for k in self.field]
        Omega = [[arb(w - k)] for w, k in zip(self.torus.W, self.field, strict=True)]
        R = [[[arb(i == j)] for j in range(3)] for i in range(3)]

        def times(a: list[arb], b: list[arb]) -> arb:
            return sum(map(mul, a, b[::-1]), arb(0))

        count = ctx.prec // 12 + 4
        for n in range(1, count):
            rates = [
                (I[i - 2] - I[i - 1]) / I[i] * (times(W[i - 2], W[i - 1]) - times(K[i - 2], K[i - 1])) for i in range(3)
            ]
            spun = [[times(x[i - 2], Omega[i - 1]) - times(x[i - 1], Omega[i - 2]) for i in range(3)] for x in (K, *R)]
            for row, rate in zip((*W, *K, *chain(*R)), (*rates, *chain(*spun)), strict=True):
                row.append(rate / n)
            for row, w, k in zip(Omega, W, K, strict=True):
                row.append(w[n] - k[n])
        largest = max(abs(x) for x in (*self.torus.W, *self.field))
        falls = arb(2 * largest * abs(t))
        remaining = (1 + largest) * (count + 1) * falls**count / (1 - falls) ** 2
        return [[arb_poly(x)(arb(t)) + arb(0, remaining.upper()) for x in rows] for rows in (Omega, K, *R)]

    def rotation(self, t: Any) -> list[list[Real]]:
        """Return R(t) at one time t, taken exactly, as three rows of balls or rationals, with R(0) = 1."""
        series = self._series_at_zero(t)
        if series:
            return series[2:]
        arrival, angle = self.state(t)
        w, *q = arrival.q
        i = self.pendulum
        if i is None:
            swing: list[list[Real]] = matrix(arrival.q)
        else:
            swing = turn(AXES[i], w * w - q[i] * q[i], 2 * w * q[i])
        return product(turn(self.field, angle.cos(), angle.sin()), swing)

    def field_in_body(self, t: Any) -> list[Real]:
        """Return K(t) = R^T B' along the body's axes, three balls or rationals in 1/time."""
        series = self._series_at_zero(t)
        return [k * self.rate for k in (series[1] if series else self.state(t)[0].K)]

    def angular_velocity(self, t: Any) -> list[Real]:
        """Return Omega(t) = W - K along the body's axes at one time, a list of three balls or rationals in rad/time."""
        series = self._series_at_zero(t)
        if series:
            return [w * self.rate for w in series[0]]
        arrival, _ = self.state(t)
        return [(w - k) * self.rate for w, k in zip(arrival.W, arrival.K, strict=True)]


def _digits_before_point(t: fmpq) -> int:
    """Return the number of binary digits of |t| before the point, at least 0, plus 8 to spare."""
    return max(0, int(abs(t).p).bit_length() - int(t.q).bit_length()) + 8


class AsymmetricMotion:
    """The motion R(t), R(0) = 1, of a body with moments (I1, I2, I3) in the field B' = (B1, B2, B3), from omega.

    ``inertia``, ``field`` (1/time) and ``omega`` (rad/time) are along the principal axes at t = 0, three exact numbers
    each. `kind` says which case it is, decided on the exact inputs. Values are computed anew at the precision of the
    moment, see `atlas.arithmetic.certified_digits`; NotCertifiedError is raised for values that cannot be enclosed.
    """

    def __init__(self, inertia: Any, field: Any, omega: Any) -> None:
        self.inertia = rationals(inertia, "inertia (I1, I2, I3)", 3)
        self.field = rationals(field, "field (B1, B2, B3)", 3)
        self.omega = rationals(omega, "omega", 3)
        check_moments(self.inertia)
        self.kind, self._motion = self._case()

    def _case(self) -> tuple[str, Symmetric | EllipticMotion | OnTorus]:
        J, K, Omega = self.inertia, self.field, self.omega
        if not any(Omega):
            return "at rest", EulerTop(J, Omega)
        if sum(any(pair) for pair in zip(Omega, K, strict=True)) == 1:
            return "spin about an axis", EulerTop(J, Omega)  # the field stays
        if len(set(J)) < 3:
            return "ball" if len(set(J)) == 1 else "symmetric body", Symmetric(J, Omega, K)
        if not any(K):
            return "Euler's top", EulerTop(J, Omega)
        motion = OnTorus(J, Omega, K)
        if motion.is_regular:
            return "on a torus", motion
        elliptic = motion.elliptic()
        return ("elliptic motion", elliptic) if elliptic else ("on the discriminant", motion)

    @property
    def on_torus(self) -> OnTorus | None:
        """The `OnTorus` of a motion of kind "on a torus", in units that make its constants near one.

        None for other kinds.
        """
        return self._motion if isinstance(self._motion, OnTorus) and self._motion.is_regular else None

    @property
    def elliptic(self) -> EllipticMotion | None:
        """The `EllipticMotion` with this attitude; for a free body, a spin along a field and rest an `EulerTop`.

        An `EulerTop`, a subclass, has the angular momentum in the place of a field. None on a torus, on the
        discriminant, and for two equal moments in a field.
        """
        if isinstance(self._motion, EllipticMotion):
            return self._motion
        return None if any(self.field) else EulerTop(self.inertia, self.omega)

    def follow(self, times: Iterable[fmpq]) -> None:
        """Prepare the states at times (rationals), where that is faster for all together than for each."""
        if isinstance(self._motion, OnTorus):
            self._motion.follow(times)

    def rotation(self, t: Any) -> list[list[Real]]:
        """Return R(t) at one time t, taken exactly, as three rows of balls; at t = 0 the unit matrix of rationals."""
        if rational(t, "the time") == 0:
            return identity()
        return self._motion.rotation(t)

    def column(self, j: int, t: Any) -> list[Real]:
        """Return column j of R(t), j = 1, 2, 3: the body's axis j in the laboratory, balls or rationals."""
        return [row[j - 1] for row in self.rotation(t)]

    def field_in_body(self, t: Any) -> list[Real]:
        """Return K(t) = R^T B' along the body's axes, three balls in 1/time; rationals at t = 0 and for a spin."""
        if rational(t, "the time") == 0 or isinstance(self._motion, EulerTop):
            return list(self.field)
        return self._motion.field_in_body(t)

    def angular_velocity(self, t: Any) -> list[Real]:
        """Return Omega(t) along the body's axes, three balls in rad/time; at t = 0 the given rationals."""
        if rational(t, "the time") == 0:
            return list(self.omega)
        return self._motion.angular_velocity(t)

    @property
    def _nutating(self) -> Any:
        """Certified motion with a period: `EulerTop`, `EllipticMotion`, or `GeneralMotion` of a symmetric body.

        Raises DomainError for a motion of another kind.
        """
        motion = self.elliptic
        if isinstance(self._motion, Symmetric) and any(self.field):
            return self._motion.exact
        if motion is None or (isinstance(motion, EulerTop) and any(self.field)):
            frequencies = ", but the three frequencies f1, f2, f3" if self.on_torus else ""
            raise DomainError(f"The motion, {self.kind}, has no one period and no mean rates{frequencies}.")
        return motion

    @property
    def period(self) -> arb:
        """Period in time, as a ball; infinite where the motion is constant.

        It is that of Omega for a free body, of Omega and K for an elliptic motion, of nutation for two equal moments.
        Raises DomainError for other motions.
        """
        return self._nutating.period

    @property
    def precession_rate(self) -> Real:
        """Mean angular velocity about the momentum of a free body, or about B', in rad/time, a ball or a rational.

        It is the rate of the body's axis about which the momentum, or K, goes. Raises DomainError for motions without a
        period.
        """
        return self._nutating.precession_rate

    @property
    def spin_rate(self) -> Real:
        """Mean angular velocity of the body about its axis around which the momentum, or K, goes, in rad/time.

        It is a ball or a rational. Raises DomainError for motions without a period.
        """
        return self._nutating.spin_rate

    @property
    def mode(self) -> str:
        """Name of the axis that the momentum of a free body goes round, see `EulerTop.mode`.

        Raises DomainError in a field.
        """
        motion = self._nutating
        if not isinstance(motion, EulerTop):
            raise DomainError("The mode, long axis or short axis, is defined for a free body: this body is in a field.")
        return motion.mode

    @property
    def frequencies(self) -> list[Real]:
        """Angular frequencies [f1, f2, f3] in rad/time of a motion on a torus, of a free body or of an elliptic motion.

        R = R_B(f3 t) S(f1 t, f2 t), with S of period 2 pi in both phases; M = II (Omega + K) and the field K along the
        body's axes depend on f1 t and f2 t alone. On a torus the basis f1, f2 is a convention, and f3 is defined up to
        integer multiples of both: it is the one for which the body, seen from the frame that rotates with -B', turns
        about the field by at most half a turn in each of the two periods of the torus. Without a torus
        f1 = |spin_rate|, f2 = 0 and f3 = precession_rate, about the momentum of a free body. Raises DomainError for
        other motions: at rest or in a spin in a field, with two equal moments in a field, and "on the discriminant";
        also where no periods are proved.
        """
        if self.on_torus is None:
            motion = self.elliptic
            if motion is None or (isinstance(motion, EulerTop) and any(self.field)):
                raise DomainError(f"There is no torus with three frequencies: the motion is {self.kind}.")
            return [arb(abs(motion.spin_rate)), arb(0), arb(motion.precession_rate)]
        try:
            return list(self.on_torus.frequencies)
        except NotCertifiedError as reason:
            raise DomainError(f"The frequencies are {reason}") from reason

    @property
    def invariants(self) -> Integrals:
        """The `Integrals` of the motion, exact rationals: H, F, (M, K) and K^2 of theorem-clebsch."""
        return Integrals.of_state(self.inertia, self.omega, self.field)

    @property
    def H(self) -> fmpq:
        """H = (M, II^-1 M)/2 + (K, II K)/2, M = II (Omega + K), K the field in the body: exact, in inertia/time^2."""
        return self.invariants.H

    @property
    def F(self) -> fmpq:
        """Clebsch's F = M^2 - I1 I2 I3 (K, II^-1 K), exact, in inertia^2/time^2; M and K are those of `H`."""
        return self.invariants.F

    @property
    def MK(self) -> fmpq:
        """Casimir (M, K), M = II (Omega + K), of momentum and field in the body: exact, in inertia/time^2."""
        return self.invariants.c

    @property
    def energy(self) -> fmpq:
        """Kinetic energy (Omega, II Omega)/2 = H - (M, K): exact, in inertia/time^2."""
        return self.H - self.MK

    def angular_momentum(self, t: Any) -> list[Real]:
        """Return m = R II Omega in the laboratory at time t, three balls in inertia/time.

        They are rationals at t = 0, and at all times without a field.
        """
        Omega = self.angular_velocity(t) if any(self.field) else self.omega
        m = [I * w for I, w in zip(self.inertia, Omega, strict=True)]
        return applied(self.rotation(t), m) if any(self.field) else m


def _power(x: fmpq) -> fmpq:
    """Return a power of two y with x/2 < y < 2 x, for a positive rational x; of a power of two itself."""
    exponent = int(x.p).bit_length() - int(x.q).bit_length()
    return fmpq(2) ** exponent if exponent >= 0 else fmpq(1, 2**-exponent)
