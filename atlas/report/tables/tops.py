"""Symmetric tops of any kind: one nutation of each in proven digits, and what loops do to their periods."""

from typing import Any

from atlas.report.digits import Number, plain
from atlas.report.schema import StrictStruct
from atlas.report.tables.table import Column, Data, Request, certified, column


class Top(StrictStruct, frozen=True):
    """A top as in `TopMotion`, in units of I2 and of one time, with its name."""

    name: str
    ratio: float
    direction: tuple[float, float]
    omega: tuple[float, float, float]
    coupling: tuple[float, float] = (0.0, 0.0)
    linear: float = 0.0
    quadratic: float = 0.0


class TopsParameters(StrictStruct, frozen=True):
    """The tops, a row each."""

    tops: tuple[Top, ...]


class Loop(StrictStruct, frozen=True):
    """A loop at one M3 round the value p of the spin, or round the spins, of a top."""

    name: str
    ratio: float
    M3: float
    p: float
    coupling: tuple[float, float] = (0.0, 0.0)
    linear: float = 0.0
    quadratic: float = 0.0


class MonodromyParameters(StrictStruct, frozen=True):
    """The loops, a row each, and the number of points on each."""

    loops: tuple[Loop, ...]
    points: int = 64


def tops(request: Request) -> Data:
    """Return the period of nutation and the angles in it of several tops."""
    asked = request.take(TopsParameters).tops
    found = certified(lambda: [_nutation(one) for one in asked], request.digits)
    columns = [column(values, request.digits) for values in zip(*found, strict=True)]
    given: list[tuple[str | Number, ...]] = [
        (
            one.name,
            Number.given(one.ratio),
            *(_row(x) for x in (one.coupling, (one.linear, one.quadratic), one.direction, one.omega)),
        )
        for one in asked
    ]
    return Data(
        (
            *map(Column, ("Top", "$I$", "$k_2,k_3$", "$a_0,A_0$", "$n_2,n_3$", r"$\boldsymbol\omega$")),
            *map(Column, ("$T$", r"$\Delta\psi$", r"$\Delta\chi$")),
        ),
        tuple((*first, *rest) for first, rest in zip(given, zip(*columns, strict=True), strict=True)),
        r"Tops of every kind: the period $T$ of nutation and the angles $\Delta\psi$ about $\mathbf{n}$ and "
        r"$\Delta\chi$ about the axis by which the body turns in it, in units of $J_2$ and of one time.",
        (
            r"Where $\nu$ is constant $T$ is the period of small nutations.",
            r"Along $\mathbf{n}$ all of the turn is counted in $\Delta\chi$.",
        ),
    )


def _row(numbers: tuple[float, ...]) -> str:
    """Return given numbers in one cell."""
    return "$" + ",".join(map(plain, numbers)) + "$"


def _nutation(one: Top) -> tuple[Any, Any, Any]:
    """Return the period and both angles as balls."""
    from atlas.exact.motions.top import TopMotion

    top = TopMotion((1.0, one.ratio), one.coupling, one.direction, one.omega, one.linear, one.quadratic)
    return top.period, top.precession_per_period, top.spin_per_period


def loops(request: Request) -> Data:
    """Return what becomes of the basis of periods on loops round unstable spins, theorem-residue."""
    from atlas.core.maps.monodromy import around, on_loop
    from atlas.core.maps.wells import Wells

    asked = request.take(MonodromyParameters)
    rows: list[tuple[str | Number, ...]] = []
    for one in asked.loops:
        wells = Wells.at(one.M3, one.ratio, one.coupling, one.linear, one.quadratic)
        loop = around(wells, one.p, asked.points)
        found = on_loop(one.ratio, one.coupling, one.M3, loop, one.linear, one.quadratic)
        matrix = r"\\".join("&".join(map(str, row)) for row in found.matrix)
        rows.append(
            (
                one.name,
                *(Number.given(x) for x in (one.ratio, one.M3, one.p)),
                Number(f"{found.period.min():.4f}"),
                Number(f"{found.period.max():.4f}"),
                rf"$\begin{{pmatrix}}{matrix}\end{{pmatrix}}$",
                Number(f"{found.step:.3f}"),
                Number(f"{found.radius:.0e}"),
            )
        )
    return Data(
        (*map(Column, ("Top", "$I$", "$M_3$", "$p$", "least $T$", "largest $T$", "matrix", "step", "radius")),),
        tuple(rows),
        r"Rows of the matrix: what $\mathbf{g}_1$, $\mathbf{g}_2$, $\mathbf{g}_3$ have become after one round. With it "
        r"the largest change of $\Delta\psi/2\pi$ or $\Delta\chi/2\pi$ from one point to the next, which must be less "
        "than a half, and the largest radius of the balls that hold them.",
        (f"Loops of {asked.points} points, counter-clockwise in the plane of $p$ and $g$.",),
    )
