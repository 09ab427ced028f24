"""One elementary motion: its constants, and the body's state at some times."""

from atlas.report.numbers import Number, plain
from atlas.report.schema import StrictStruct
from atlas.report.tables.model import RATE, Column, Data, Request, certified, column, quantity


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
    """List initial data, frequencies and integrals (36) to (41), (88) of the motion that starts with `omega2`."""
    from atlas.exact.elementary import ElementaryMotion

    asked = request.take(Motion)
    made = ElementaryMotion(request.case.exact, request.case.components, asked.omega2, asked.omega3)
    k, invariants = certified(lambda: (made.k, made.invariants), request.digits)
    squared = r"s$^{-2}$"
    rows = (
        ("initial angular velocity", r"$\omega_2$", made.omega2, RATE),
        ("", r"$\omega_3$", made.omega3, RATE),
        ("frequency of precession", "$k$", k, RATE),
        ("frequency of proper rotation", r"$\phi$", made.phi, RATE),
        ("energy @(36)", "$E'=2E/I_2$", invariants["E'"], squared),
        ("field in the body @(37)", r"$\mathbf{K}^2$", invariants["K^2"], squared),
        ("integral @(40)", "$c_3$", invariants["c3"], RATE),
        ("integral @(41)", "$c_5$", invariants["c5"], squared),
        ("momentum along the field @(88)", r"$(\mathbf{m},\mathbf{B}')/I_2$", invariants["(m,B')"], squared),
    )
    return Data(
        (Column("Quantity"), Column("Symbol"), Column("Value"), Column("Unit")),
        tuple((name, symbol, quantity(value, request.digits), unit) for name, symbol, value, unit in rows),
        rf"The motion with $\omega_2={plain(asked.omega2)}$ s$^{{-1}}$: initial data, frequencies and integrals.",
    )


def samples(request: Request) -> Data:
    """Omega(t), (73), and the third axis of the body R_3(t), (84), at some `times`."""
    from atlas.exact.elementary import ElementaryMotion

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
