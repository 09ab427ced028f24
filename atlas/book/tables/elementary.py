"""The quadric of initial data, named points of the hyperbola, one elementary motion; of a body or of several."""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from atlas.book.body_and_field import BodyAndField
from atlas.book.digits import Number, plain
from atlas.book.schema import StrictStruct
from atlas.book.tables.table import RATE, Column, Data, Request, certified, column, columns_of, heads
from atlas.errors import AtlasError

NONE = "–"
"""Text of a cell where a body has no such quantity."""


class Quantity(NamedTuple):
    """A quantity of one body: meaning, letter in TeX, value, and unit ("" for a pure number).

    The value is a ball, a rational or a float, or a word.
    """

    name: str
    symbol: str
    value: Any
    unit: str = ""


def side_by_side(
    request: Request, bodies: Sequence[Sequence[Quantity]]
) -> tuple[tuple[Column, ...], tuple[tuple[str | Number, ...], ...]]:
    """Return (columns, rows) of a table with a column for each body, from their quantities in the same order.

    A row has meaning, symbol, a value for each body, and unit. The values of a row have the number of decimals that
    gives the largest of them the requested digits. `bodies` has a list of quantities for each body of the request.
    """
    titles = [case.body_record.title if case.body_record else "body" for case in request.cases]
    values_of = ["Value"] if len(bodies) == 1 else [title[:1].upper() + title[1:] for title in titles]
    columns = heads("Quantity", "Symbol", *values_of, "Unit")
    rows = []
    for quantities in zip(*bodies, strict=True):
        name, symbol, _, unit = quantities[0]
        values = [case.value for case in quantities]
        numbers = iter(column([value for value in values if not isinstance(value, str)], request.digits))
        cells = [value if isinstance(value, str) else next(numbers) for value in values]
        rows.append((name, symbol, *cells, unit or "1" * bool(symbol)))
    return columns, tuple(rows)


def titled(request: Request) -> str:
    """Return "the " and the body's title, or "the bodies" for several, for use in a sentence."""
    if len(request.cases) > 1:
        return "the bodies"
    record = request.case.body_record
    return f"the {record.title if record else 'body'}"


def quadric(request: Request) -> Data:
    """Return the table of the quadric (51) to (57), a column for each body: I, kind, angles, a2, a3, semi-axes, centre.

    The angles, in rad, are beta, from e2 to I^-1 B', and beta/2 + pi/4, from e2 to the principal axis of omega'_2.
    a2 and a3 are the coefficients of (54), pure numbers. Semi-axes, of three directions, and centre (omega2,
    omega3) are in 1/s. With the field along or across the axis there are I and kind alone.
    """
    columns, rows = side_by_side(request, [of_quadric(case, request.digits) for case in request.cases])
    return Data(columns, rows, f"The quadric of initial data of {titled(request)}, @(51), in canonical form.")


def of_quadric(case: BodyAndField, digits: int) -> list[Quantity]:
    """Return the quantities of the quadric of a body in a field, see `quadric`, to `digits` digits.

    Only I and kind for a field along or across the axis; a dash for each semi-axis if I = 1, as for a sphere.
    """
    from flint import arb

    from atlas.surfaces.certified import Quadric

    q = Quadric(case.exact, case.components)
    sheet = [
        Quantity("ratio of the moments @(33)", "$I=I_3/I_2$", certified(lambda: q.I, digits)),
        Quantity("quadric @(51)", "", q.kind),
    ]
    if q.B2 == 0 or q.B3 == 0:
        return sheet
    beta, turn, a2, a3, axes, centre = certified(
        lambda: (q.beta, arb(q.beta) / 2 + arb.pi() / 4, q.a2, q.a3, q.semi_axes, q.centre), digits
    )
    return [
        *sheet,
        Quantity(r"angle from $\mathbf{e}_2$ to $\mathbb{I}^{-1}\mathbf{B}'$", r"$\beta$", beta, "rad"),
        Quantity(r"angle from $\mathbf{e}_2$ to the axis of $\omega'_2$", r"$\beta/2+\pi/4$", turn, "rad"),
        Quantity("coefficient of @(54)", "$a_2$", a2),
        Quantity("coefficient of @(54)", "$a_3$", a3),
        *(Quantity("semi-axis", f"$C_{j}$", NONE if q.I == 1 else axes[j - 1], RATE) for j in (1, 2, 3)),
        *(Quantity("centre", rf"$\omega_{j}$", centre[j - 1], RATE) for j in (2, 3)),
    ]


class PointsParameters(StrictStruct, frozen=True):
    """Parameters of the table `points`: further values of omega2, in 1/s."""

    omega2: tuple[float, ...] = ()


class Point(NamedTuple):
    """A point of the hyperbola (67): its names, and whether the motion is stable against small nutations.

    `names` is a text such as "at rest", "" for a value of omega2 that was asked for. `values` are five balls:
    omega2, omega3, the rates k of precession and phi of proper rotation in 1/s, and the square of the nutation
    frequency nu_n in 1/s^2; omega2 is a `Number` as given if a float holds it.
    """

    names: str
    values: tuple[Any, ...]
    stable: bool


def points(request: Request, setup: PointsParameters) -> Data:
    """Return the table of points (omega2, omega3) of (67), with k, phi of (72) and the nutation frequency squared.

    k is the rate of precession, phi that of proper rotation. Rates are in 1/s, the square in 1/s^2, negative where
    small nutations grow; the last column is "stable" or "unstable". With several bodies the first column has each
    body's title, beside its first point. Raises AtlasError for B2 = 0.
    """
    groups = [of_points(case, setup, request.digits) for case in request.cases]
    columns = [
        iter(column(values, request.digits))
        for values in zip(*(point.values for group in groups for point in group), strict=True)
    ]
    rows: list[tuple[str | Number, ...]] = []
    has_titles = len(groups) > 1
    for case, group in zip(request.cases, groups, strict=True):
        title = case.body_record.title if case.body_record else "body"
        for number, point in enumerate(group):
            body = (title[:1].upper() + title[1:] if number == 0 else "",) * has_titles
            rows.append((*body, point.names, *map(next, columns), "stable" if point.stable else "unstable"))
    poles = dict.fromkeys(-Fraction(case.components[0]) for case in request.cases)
    left_out = [f"$\\omega_2={plain(value)}$" for value in setup.omega2 if Fraction(value) in poles]
    return Data(
        heads(
            *(("Body",) * has_titles),
            "Point",
            (r"$\omega_2$", RATE),
            (r"$\omega_3$", RATE),
            ("$k$", RATE),
            (r"$\phi$", RATE),
            (r"$\nu_n^2$", r"s$^{-2}$"),
            "Nutation",
        ),
        tuple(rows),
        r"Points of the hyperbola @(67), frequencies of precession $k$ and of proper rotation $\phi$, @(72), and the "
        r"square of the frequency of nutation $\nu_n$, @theorem-stability.",
        tuple(
            rf"There is no row for {pole}, since $\omega_2=-B'_2$ does not have one $\omega_3$." for pole in left_out
        ),
    )


def of_points(case: BodyAndField, setup: PointsParameters, digits: int) -> list[Point]:
    """Return the named and the given points of the hyperbola (67) of a body, by rising omega2, without the pole.

    The named points are rest, phi = 0 and omega3 = 0; the pole is omega2 = -B2. Equal points are one with several
    names. Raises AtlasError for B2 = 0, where the curve is a line. `setup` has the given omega2; values have
    `digits` proven digits.
    """
    from atlas.arithmetic.certified_inputs import rational
    from atlas.motions.elementary.certified_hyperbola import Hyperbola

    h = Hyperbola(case.exact, case.components)
    B2 = Fraction(case.components[0])
    I = Fraction(int(h.I.p), int(h.I.q))
    named: dict[Fraction, list[str]] = {}
    for name, omega2 in (
        ("at rest", Fraction(0)),
        (r"$\phi=0$", -2 * B2),
        (r"$\omega_3=0$", -(2 - I) * B2),
        *(("", Fraction(value)) for value in setup.omega2),
    ):
        if omega2 + B2 != 0:
            named.setdefault(omega2, []).append(name)
    if not named:
        raise AtlasError("with B2 = 0 the hyperbola is the line omega2 = 0, and omega3 is free: it has no such points.")
    order = sorted(named)
    exact = [rational(omega2, "omega2") for omega2 in order]
    values = certified(lambda: [(h.omega3(x), *h.frequencies(x), h.stability(x)) for x in exact], digits)
    numbers = [Number.as_given(float(y)) if Fraction(float(y)) == y else x for x, y in zip(exact, order, strict=True)]
    return [
        Point(", ".join(filter(None, named[y])), (number, *row), h.stable(x))
        for x, y, number, row in zip(exact, order, numbers, values, strict=True)
    ]


class Motion(StrictStruct, frozen=True):
    """Parameters of an elementary motion: omega2 in 1/s, and omega3 where the hyperbola leaves it free, else None."""

    omega2: float
    omega3: float | None = None


class Samples(StrictStruct, frozen=True):
    """Parameters of a motion at times in s: omega2 in 1/s, omega3 where the hyperbola leaves it free, else None."""

    omega2: float
    times: tuple[float, ...]
    omega3: float | None = None


def motion(request: Request, setup: Motion) -> Data:
    """Return the table of a motion that starts with `omega2`: initial data, frequencies, stability and integrals.

    It has a column for each body, in 1/s and 1/s^2; the rows are those of `of_motion`.
    """
    columns, rows = side_by_side(request, [of_motion(case, setup, request.digits) for case in request.cases])
    return Data(
        columns,
        rows,
        rf"The motion with $\omega_2={plain(setup.omega2)}$ s$^{{-1}}$: initial data, frequencies and integrals.",
    )


def of_motion(case: BodyAndField, setup: Motion, digits: int) -> list[Quantity]:
    """Return the quantities of the motion of a body from the omega2 and omega3 of ``setup``, to ``digits`` digits.

    They are the start (67), the rates k of precession and phi of proper rotation (72), the square of the frequency of
    nutation and "stable" or "unstable" where the motion is one of the hyperbola, the energy and the integrals (36) to
    (41), and (m, B')/I2 (88), m the angular momentum, in 1/s or 1/s^2.
    """
    from atlas.motions.elementary.certified import ElementaryMotion
    from atlas.motions.elementary.certified_hyperbola import Hyperbola

    motion = ElementaryMotion(case.exact, case.components, setup.omega2, setup.omega3)
    k, invariants = certified(lambda: (motion.k, motion.invariants), digits)
    squared, nutation = r"s$^{-2}$", []
    if motion.case in {"precession", "at rest"}:
        h = Hyperbola(case.exact, case.components)
        nutation = [
            Quantity("square of the frequency of nutation", r"$\nu_n^2$", h.stability(motion.omega2), squared),
            Quantity("nutation @theorem-stability", "", "stable" if h.stable(motion.omega2) else "unstable"),
        ]
    return [
        Quantity("initial angular velocity", r"$\omega_2$", motion.omega2, RATE),
        Quantity("initial spin", r"$\omega_3$", motion.omega3, RATE),
        Quantity("frequency of precession", "$k$", k, RATE),
        Quantity("frequency of proper rotation", r"$\phi$", motion.phi, RATE),
        *nutation,
        Quantity("energy @(36)", "$E'=2E/I_2$", invariants["E'"], squared),
        Quantity("field in the body @(37)", r"$\mathbf{K}^2$", invariants["K^2"], squared),
        Quantity("integral @(40)", "$c_3$", invariants["c3"], RATE),
        Quantity("integral @(41)", "$c_5$", invariants["c5"], squared),
        Quantity("momentum along the field @(88)", r"$(\mathbf{m},\mathbf{B}')/I_2$", invariants["(m,B')"], squared),
    ]


def samples(request: Request, setup: Samples) -> Data:
    """Return the table, a row for each of the `times`, of Omega(t), (73), and the third axis R_3(t), (84).

    A row has t in s, the three components of the angular velocity Omega along the body's axes in 1/s, and the three of
    the symmetry axis, a unit vector, in the laboratory. Only the first body is shown.
    """
    from atlas.motions.elementary.certified import ElementaryMotion

    motion = ElementaryMotion(request.case.exact, request.case.components, setup.omega2, setup.omega3)
    columns = columns_of(
        lambda: [(*motion.angular_velocity(t), *motion.third_axis(t)) for t in setup.times], request.digits
    )
    return Data(
        heads(
            ("$t$", "s"), *((rf"$\Omega_{j}$", RATE) for j in (1, 2, 3)), *((rf"$R_{{{j}3}}$", "1") for j in (1, 2, 3))
        ),
        tuple(zip(map(Number.as_given, setup.times), *columns, strict=True)),
        rf"The motion with $\omega_2={plain(setup.omega2)}$ s$^{{-1}}$ at some times: angular velocity in the body, "
        r"@(73), and the body's axis in the laboratory, the third column of @(84).",
    )


def sheet(request: Request, setup: Motion) -> Data:
    """Return the table with the rows of `quadric` and then of `motion`, a column for each body."""
    columns, rows = side_by_side(
        request,
        [[*of_quadric(case, request.digits), *of_motion(case, setup, request.digits)] for case in request.cases],
    )
    return Data(
        columns,
        rows,
        f"Data sheet of {titled(request)}: the quadric of initial data, @(51) to @(57), and the motion that starts "
        rf"with $\omega_2={plain(setup.omega2)}$ s$^{{-1}}$.",
    )
