"""Named points of the hyperbola, the two frequencies there, and whether the motion is stable."""

from fractions import Fraction
from typing import Any

from atlas.errors import AtlasError
from atlas.report.digits import Number
from atlas.report.schema import StrictStruct
from atlas.report.tables.table import RATE, Column, Data, Request, certified, column


class PointsParameters(StrictStruct, frozen=True):
    """Further values of omega2, in 1/s."""

    omega2: tuple[float, ...] = ()


def points(request: Request) -> Data:
    """Points (omega2, omega3) of (67) with k, phi of (72) and the nutation frequency squared; `omega2` adds more."""
    from atlas.exact.surfaces.hyperbola import Hyperbola

    more = request.take(PointsParameters).omega2
    h = Hyperbola(request.case.exact, request.case.components)
    B2 = Fraction(request.case.components[0])
    I = Fraction(int(h.I.p), int(h.I.q))
    chosen: dict[Any, list[str]] = {}
    for name, omega2 in (
        ("at rest", Fraction(0)),
        (r"$\phi=0$", -2 * B2),
        (r"$\omega_3=0$", -(2 - I) * B2),
        *(("", Fraction(value)) for value in more),
    ):
        if omega2 + B2 != 0:
            chosen.setdefault(Fraction(omega2), []).append(name)
    if not chosen:
        raise AtlasError("with B2 = 0 the hyperbola is the line omega2 = 0, and omega3 is free: it has no such points.")
    order = sorted(chosen)
    values = certified(
        lambda: [(_exact(x), h.omega3(_exact(x)), *h.frequencies(_exact(x)), h.stability(_exact(x))) for x in order],
        request.digits,
    )
    columns = [column(one, request.digits) for one in zip(*values, strict=True)]
    columns[0] = column(
        [Number.given(float(x)) if Fraction(float(x)) == x else _exact(x) for x in order], request.digits
    )
    rows = tuple(
        (
            ", ".join(filter(None, chosen[x])),
            *numbers,
            "stable" if h.stable(value[0]) else "unstable",
        )
        for x, value, *numbers in zip(order, values, *columns, strict=True)
    )
    return Data(
        (
            Column("Point"),
            Column(r"$\omega_2$", RATE),
            Column(r"$\omega_3$", RATE),
            Column("$k$", RATE),
            Column(r"$\phi$", RATE),
            Column(r"$\nu_n^2$", r"s$^{-2}$"),
            Column("Nutation"),
        ),
        rows,
        r"Points of the hyperbola @(67), frequencies of precession $k$ and of proper rotation $\phi$, @(72), and the "
        r"square of the frequency of nutation $\nu_n$, @theorem-stability.",
    )


def _exact(x: Fraction) -> Any:
    """Return a fraction as the certified floor has it."""
    from atlas.exact.inputs import rational

    return rational(x, "omega2")
