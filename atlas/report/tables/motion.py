"""One elementary motion, of a body or of several: its constants, and one body's state at some times."""

from atlas.report.body_and_field import BodyAndField
from atlas.report.digits import Number, plain
from atlas.report.schema import StrictStruct
from atlas.report.tables.layout import Quantity, side_by_side, titled
from atlas.report.tables.quadric import quantities as quadric_quantities
from atlas.report.tables.table import RATE, Column, Data, Request, certified, column


class Motion(StrictStruct, frozen=True):
    """The motion by its omega2, in 1/s; `omega3` where the hyperbola leaves it free."""

    omega2: float
    omega3: float | None = None


class Samples(StrictStruct, frozen=True):
    """The same, and times in s."""

    omega2: float
    times: tuple[float, ...]
    omega3: float | None = None


def motion(request: Request) -> Data:
    """List initial data, frequencies, stability and integrals of the motion that starts with `omega2`."""
    asked = request.take(Motion)
    columns, rows = side_by_side(request, [quantities(one, asked, request.digits) for one in request.cases])
    return Data(
        columns,
        rows,
        rf"The motion with $\omega_2={plain(asked.omega2)}$ s$^{{-1}}$: initial data, frequencies and integrals.",
    )


def quantities(case: BodyAndField, asked: Motion, digits: int) -> list[Quantity]:
    """Return what belongs to a motion: (67), k and phi of (72), nutation, the integrals (36) to (41) and (88)."""
    from atlas.exact.motions.elementary import ElementaryMotion
    from atlas.exact.surfaces.hyperbola import Hyperbola

    made = ElementaryMotion(case.exact, case.components, asked.omega2, asked.omega3)
    k, invariants = certified(lambda: (made.k, made.invariants), digits)
    squared, nutation = r"s$^{-2}$", []
    if made.case in {"precession", "at rest"}:
        h = Hyperbola(case.exact, case.components)
        nutation = [
            Quantity("square of the frequency of nutation", r"$\nu_n^2$", h.stability(made.omega2), squared),
            Quantity("nutation @theorem-stability", "", "stable" if h.stable(made.omega2) else "unstable"),
        ]
    return [
        Quantity("initial angular velocity", r"$\omega_2$", made.omega2, RATE),
        Quantity("initial spin", r"$\omega_3$", made.omega3, RATE),
        Quantity("frequency of precession", "$k$", k, RATE),
        Quantity("frequency of proper rotation", r"$\phi$", made.phi, RATE),
        *nutation,
        Quantity("energy @(36)", "$E'=2E/I_2$", invariants["E'"], squared),
        Quantity("field in the body @(37)", r"$\mathbf{K}^2$", invariants["K^2"], squared),
        Quantity("integral @(40)", "$c_3$", invariants["c3"], RATE),
        Quantity("integral @(41)", "$c_5$", invariants["c5"], squared),
        Quantity("momentum along the field @(88)", r"$(\mathbf{m},\mathbf{B}')/I_2$", invariants["(m,B')"], squared),
    ]


def samples(request: Request) -> Data:
    """Omega(t), (73), and the third axis of the body R_3(t), (84), at some `times`."""
    from atlas.exact.motions.elementary import ElementaryMotion

    asked = request.take(Samples)
    made = ElementaryMotion(request.case.exact, request.case.components, asked.omega2, asked.omega3)
    values = certified(lambda: [(*made.angular_velocity(t), *made.third_axis(t)) for t in asked.times], request.digits)
    columns = [column(one, request.digits) for one in zip(*values, strict=True)]
    return Data(
        (
            Column("$t$", "s"),
            *(Column(rf"$\Omega_{j}$", RATE) for j in (1, 2, 3)),
            *(Column(rf"$R_{{{j}3}}$", "1") for j in (1, 2, 3)),
        ),
        tuple(zip(map(Number.given, asked.times), *columns, strict=True)),
        rf"The motion with $\omega_2={plain(asked.omega2)}$ s$^{{-1}}$ at some times: angular velocity in the body, "
        r"@(73), and the body's axis in the laboratory, the third column of @(84).",
    )


def sheet(request: Request) -> Data:
    """List what the tables `quadric` and `motion` have, for the motion that starts with `omega2`."""
    asked = request.take(Motion)
    columns, rows = side_by_side(
        request,
        [[*quadric_quantities(one, request.digits), *quantities(one, asked, request.digits)] for one in request.cases],
    )
    return Data(
        columns,
        rows,
        f"Data sheet of {titled(request)}: the quadric of initial data, @(51) to @(57), and the motion that starts "
        rf"with $\omega_2={plain(asked.omega2)}$ s$^{{-1}}$.",
    )
