"""Closed motions that lie nearest, and motions of a needle with the same integrals, theorem-companion-range."""

from collections.abc import Iterator
from typing import Any

from atlas.book.digits import Number, plain
from atlas.book.schema import StrictStruct
from atlas.book.tables.properties import FamilyObject
from atlas.book.tables.table import RATE, Data, Request, certified, column, columns_of, heads, quantity
from atlas.errors import AtlasError, DomainError

MAX_FRACTIONS, MAX_DENOMINATOR = 6, 10_000
"""Largest number of fractions shown, and largest denominator."""
PRINTED_DIGITS = 12
"""Digits that a double has for certain, and some to spare."""


def closed(request: Request, item: FamilyObject) -> Data:
    """Return the table of best fractions p/q of phi/k, or of the turns in one nutation, each with its closed motion.

    For an elementary motion phi/k is the rate of proper rotation over that of precession (72). Any other motion has a
    row (p turns of the axis about the field, q nutations, time, turns per nutation less p/q) for each fraction. Raises
    DomainError for k = 0, for a free body, and where the number is an integer within rounding. `item` is the object of
    the request.
    """
    from flint import arb, fmpq

    elementary = item.family.takes("omega2")
    exact = item.balls()
    if elementary and exact.k == 0:
        raise DomainError("With k = 0 there is no precession, and phi/k has no value.")
    if not elementary and exact.kind == "free body":
        raise DomainError("Without a field the axis goes round a circle: its trace closes in each turn.")
    value = certified(
        lambda: arb(exact.phi) / arb(exact.k) if elementary else exact.precession_per_period / (2 * arb.pi()),
        request.digits,
    )
    fractions = list(convergents(value))
    if not fractions:
        raise DomainError(
            "The turns in one nutation are an integer, to the digits computed: the trace closes in each nutation."
        )
    misses = [quantity(value - fmpq(p, q), 2) for p, q in fractions]
    if elementary:
        return _elementary(item, value, fractions, misses, request.digits)
    period = certified(lambda: exact.period, request.digits)
    times = column([q * period for _, q in fractions], request.digits)
    return Data(
        heads("Turns", "Nutations", ("Time", item.unit("time")), "Turns per nutation less the fraction"),
        tuple(
            (Number(str(p)), Number(str(q)), time, miss)
            for (p, q), time, miss in zip(fractions, times, misses, strict=True)
        ),
        f"When the trace of the axis nearly closes: {quantity(value, request.digits).words()} turns about the "
        "field in one nutation, and the best rational approximations of this number.",
    )  # fmt: skip


def _elementary(item: FamilyObject, value: Any, fractions: Any, misses: Any, digits: int) -> Data:
    """Return the table of closed elementary motions with phi/k = p/q, a row for each fraction that has one.

    `value` is phi/k, an interval (ball), phi the rate of proper rotation and k that of precession; `fractions` are
    pairs (p, q), `misses` the differences phi/k - p/q as `Number`s. Raises DomainError if no fraction has a motion.
    """
    from atlas.motions.elementary.closed import ClosedMotion

    ratio, field, omega2, *_ = item.floats
    rows = []
    for (p, q), miss in zip(fractions, misses, strict=True):
        try:
            motion = ClosedMotion(ratio, field, p, q)
        except DomainError:
            continue  # no motion has this phi/k
        numbers = [
            Number(f"{x:.{min(digits, PRINTED_DIGITS)}g}")
            for x in (motion.omega2, motion.omega2 - omega2, motion.period)
        ]
        rows.append((f"${p}/{q}$", *numbers, miss))
    if not rows:
        raise DomainError("No closed motion of the hyperbola (67) lies near.")
    rate = item.unit("1/time")
    return Data(
        heads(
            r"$\phi/k$", (r"$\omega_2$", rate), (r"$\omega_2$ less that of this motion", rate),
            ("Closes after", item.unit("time")), r"$\phi/k$ less the fraction",
        ),
        tuple(rows),
        rf"The nearest closed motions, @theorem-closed: best rational approximations of $\phi/k$ = "
        f"{quantity(value, digits).words()}. "
        "A motion with the fraction $p/q$ comes back after $q$ precessions.",
        ("`Hyperbola.closed(p, q)` makes one; its numbers are rounded from the nearest doubles.",),
    )  # fmt: skip


def convergents(value: Any) -> Iterator[tuple[int, int]]:
    """Yield the first convergents (p, q) of the continued fraction of a ball, as far as its radius determines them.

    At most 6 (`MAX_FRACTIONS`), with q up to 10000 (`MAX_DENOMINATOR`). For a rational value the last one is the
    value; for a negative value p < 0.
    """
    if value < 0:
        yield from ((-p, q) for p, q in convergents(-value))
        return
    before, now = (0, 1), (1, 0)
    for _ in range(MAX_FRACTIONS):
        quotient = value.floor().unique_fmpz()
        if quotient is None:
            return
        before, now = now, (int(quotient) * now[0] + before[0], int(quotient) * now[1] + before[1])
        if now[1] > MAX_DENOMINATOR:
            return
        yield now
        value = value - quotient
        if value.contains(0):
            return
        value = 1 / value


class CompanionParameters(StrictStruct, frozen=True):
    """Parameters of the table `companions`: I3/I2 below 1, and (B2, B3, omega2) of some elementary motions, in 1/s."""

    ratio: float
    motions: tuple[tuple[float, float, float], ...]


def companions(request: Request, setup: CompanionParameters) -> Data:
    """Return the table of steady precessions that other motions leave and come back to, theorem-companion-range.

    Those motions are the companions. A row has B', omega2, the angle theta between axis and field, the rate sqrt(c) at
    which a small push grows, and the angles theta_+ and theta_- with the field at which the companions turn back: rates
    in 1/s, angles in degrees. Raises AtlasError where there is no companion.
    """
    columns = columns_of(lambda: [angles(setup.ratio, *motion) for motion in setup.motions], request.digits)
    motions = [(f"$(0,{plain(B2)},{plain(B3)})$", Number.as_given(omega2)) for B2, B3, omega2 in setup.motions]
    return Data(
        heads(
            (r"$\mathbf{B}'$", RATE),
            (r"$\omega_2$", RATE),
            (r"$\theta$", "degrees"),
            (r"$\sqrt c$", RATE),
            (r"$\theta_+$", "degrees"),
            (r"$\theta_-$", "degrees"),
        ),
        tuple((*rates, *values) for rates, values in zip(motions, zip(*columns, strict=True), strict=True)),
        f"Steady precessions of a body with $I={plain(setup.ratio)}$ that others leave and come back to: the angle "
        r"$\theta$ between axis and field, the rate $\sqrt c$ at which a push grows, and the angles $\theta_\pm$ at "
        r"which the companions turn, @theorem-companion-range.",
    )


def angles(ratio: float, B2: float, B3: float, omega2: float) -> tuple[Any, ...]:
    """Return theta (degrees), sqrt(c) (1/s), theta_+, theta_- (degrees) of an elementary motion, as balls.

    They are the columns of `companions`; sqrt(c) = 0 is an exact rational. Raises AtlasError without a companion.
    `ratio` is I3/I2; B2, B3 and omega2 are in 1/s.
    """
    from flint import arb, fmpq

    I, B2, B3, omega2 = (fmpq(*value.as_integer_ratio()) for value in (ratio, B2, B3, omega2))
    if not (0 < I < 1 and B2):
        raise AtlasError("the companions are those of a body with 0 < I < 1 in a field with B2 other than 0.")
    b2 = B2 * B2 + B3 * B3
    r2, z = B3 * B3 / b2, ((omega2 + B2) / B2) ** 2 / (1 - I)
    c = (I - 1) * b2 * (4 * r2 - (1 - z) * (z - r2) / z) if z else fmpq(-1)
    if not (r2 <= z <= 1 and c >= 0):
        raise AtlasError(f"the elementary motion with omega2 = {omega2} has no companion that comes back to it.")
    r, half = arb(B3) / arb(b2).sqrt(), arb((1 - z) * (z - r2) / z).sqrt()
    theta, above, below = (nu.acos() * 180 / arb.pi() for nu in (r, half - r, -half - r))
    return theta, arb(c).sqrt() if c else fmpq(0), above, below
