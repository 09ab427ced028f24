"""Bodies with three different moments: elliptic motions, the periods of a torus, and any motion at some times."""

from typing import Any

from atlas.report.digits import Number, plain
from atlas.report.schema import StrictStruct
from atlas.report.tables.table import Column, Data, Request, certified, column

Triple = tuple[float, float, float]


class Family(StrictStruct, frozen=True):
    """A body in a field, in one unit of inertia and one of time, and places (z, branch) of elliptic motions."""

    inertia: Triple
    field: Triple
    places: tuple[tuple[float, int], ...]


class Motion(StrictStruct, frozen=True):
    """A body in a field and its initial angular velocity."""

    inertia: Triple
    field: Triple
    omega: Triple


class Samples(Motion, frozen=True):
    """The same, and times."""

    times: tuple[float, ...]


def elliptic(request: Request) -> Data:
    """List elliptic motions of one body in one field, a row each, theorem-elliptic."""
    from atlas.exact.motions.elliptic import EllipticMotion

    asked = request.take(Family)
    motions = [EllipticMotion(asked.inertia, asked.field, z, branch) for z, branch in asked.places]
    values = certified(
        lambda: [(m.v, *m.omega, m.splitting, m.period, m.precession_per_period) for m in motions], request.digits
    )
    columns = [column(one, request.digits) for one in zip(*values, strict=True)]
    heads = ("$v$", r"$\omega_1$", r"$\omega_2$", r"$\omega_3$", "$C/D^2$", "$T$", r"$\Theta$")
    return Data(
        (Column("$z$"), *map(Column, heads), Column("Motion")),
        tuple(
            (Number.given(z), *row, m.stability)
            for (z, _), row, m in zip(asked.places, zip(*columns, strict=True), motions, strict=True)
        ),
        rf"Elliptic motions of a body with $I_i={_row(asked.inertia)}$ in $\mathbf{{B}}'={_row(asked.field)}$: the "
        r"place $(z,v)$, initial angular velocity, what decides on stability, the period $T$ of "
        r"$\mathbf{K}$, and the turn $\Theta$ about the field in it.",
    )


def periods(request: Request) -> Data:
    """List two pairs of times after which M and K are back, and the turn about the field, with proven digits."""
    from flint import fmpq

    from atlas.exact.motions.torus import Torus
    from atlas.report.tables.table import bits

    asked = request.take(Motion)
    inertia, K, omega = (
        [fmpq(*x.as_integer_ratio()) for x in row] for row in (asked.inertia, asked.field, asked.omega)
    )
    torus = Torus(tuple(inertia), tuple(w + k for w, k in zip(omega, K, strict=True)), tuple(K))
    found = torus.periods(bits(request.digits) + 64)
    columns = [column(values, request.digits) for values in zip(*((x.H, x.F, x.angle) for x in found), strict=True)]
    return Data(
        (Column("Pair"), Column("$T_H$"), Column("$T_F$"), Column(r"$\theta$")),
        tuple((f"$r_{n}$", *row) for n, row in enumerate(zip(*columns, strict=True), 1)),
        rf"Periods of the torus of the motion from $\boldsymbol\omega={_row(asked.omega)}$, "
        rf"$I_i={_row(asked.inertia)}$, $\mathbf{{B}}'={_row(asked.field)}$: times of the flows of $H$ and $F/2$ after "
        r"which $\mathbf{M}$ and $\mathbf{K}$ are back, and the angle by which the body has turned about the field, in "
        r"Larmor's frame.",
    )


def asymmetric(request: Request) -> Data:
    """List the third axis of the body and its spin about it at some times, whatever the motion."""
    from atlas.exact.motions.asymmetric import AsymmetricMotion

    asked = request.take(Samples)
    made = AsymmetricMotion(asked.inertia, asked.field, asked.omega)
    values: list[Any] = certified(
        lambda: [(*made.column(3, t), made.angular_velocity(t)[2]) for t in asked.times], request.digits
    )
    columns = [column(one, request.digits) for one in zip(*values, strict=True)]
    return Data(
        (Column("$t$"), *(Column(rf"$R_{{{i}3}}$") for i in (1, 2, 3)), Column(r"$\Omega_3$")),
        tuple(zip(map(Number.given, asked.times), *columns, strict=True)),
        rf"The motion from $\boldsymbol\omega={_row(asked.omega)}$ of the body with $I_i={_row(asked.inertia)}$ in "
        rf"$\mathbf{{B}}'={_row(asked.field)}$: its third axis in the laboratory and its spin about it.",
    )


def _row(numbers: Triple) -> str:
    """Return given numbers as a row vector in TeX."""
    return "(" + ",".join(map(plain, numbers)) + ")"
