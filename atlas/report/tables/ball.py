"""The charged ball: the two frequencies of its general motion and the axis of the faster turn, (26) to (29)."""

from atlas.errors import AtlasError
from atlas.report.schema import StrictStruct
from atlas.report.tables.table import RATE, Column, Data, Request, certified, quantity


class BallParameters(StrictStruct, frozen=True):
    """Initial angular velocity (0, omega2, omega3) and Larmor's frequency, in 1/s."""

    omega2: float
    omega3: float
    larmor: float


def ball(request: Request) -> Data:
    """Frequencies alpha, gamma and axis k_hat for initial angular velocity (0, omega2, omega3) in a field along e3."""
    from atlas.exact.motions.ball import BallMotion

    asked = request.take(BallParameters)
    if asked.larmor == 0:
        raise AtlasError("the ball's table is about a ball in a field: larmor must not be zero.")
    made = BallMotion(1, asked.larmor, (asked.omega2, asked.omega3))
    gamma, k_hat = certified(lambda: (made.gamma, made.k_hat), request.digits)
    rows = (
        ("initial angular velocity", r"$m_2/I_0$", made.m2, RATE),
        ("", r"$m_3/I_0$", made.m3, RATE),
        ("Larmor's frequency @(27)", r"$\alpha$", made.larmor, RATE),
        ("frequency of the turn about $\\hat{\\mathbf{k}}$, @(29)", r"$\gamma$", gamma, RATE),
        ("axis of that turn, @(29)", r"$\hat k_2$", k_hat[0], "1"),
        ("", r"$\hat k_3$", k_hat[1], "1"),
    )
    return Data(
        (Column("Quantity"), Column("Symbol"), Column("Value"), Column("Unit")),
        tuple((name, symbol, quantity(value, request.digits), unit) for name, symbol, value, unit in rows),
        r"The general motion of the ball, @(28), in a field along $\mathbf{e}_3$.",
    )
