"""Tops and bodies with three moments: a nutation, loops of periods, elliptic motions, tori, motions at times."""

from math import isfinite
from typing import Any

import numpy as np

from atlas.book.digits import Number, plain
from atlas.book.schema import StrictStruct
from atlas.book.tables.table import Data, Request, bits, column, columns_of, heads

TIMES = np.linspace(0.0, 12.0, 40)
"""Times at which a motion is observed."""
OPEN = 1e-9, 1e-5
"""Singular values of equations and of a fit's derivatives, in parts of the largest, that count as zero."""


class Top(StrictStruct, frozen=True):
    """A named top with the arguments of `TopMotion`, in units of I2 and of one time.

    `ratio` is I3/I2; (k2, k3) is the `coupling`, (n2, n3) the `direction` of the field in the body and `omega` (3,) the
    angular velocity at t = 0; the potential is linear nu + quadratic nu^2/2, nu the cosine between axis and field.
    """

    name: str
    ratio: float
    direction: tuple[float, float]
    omega: tuple[float, float, float]
    coupling: tuple[float, float] = (0.0, 0.0)
    linear: float = 0.0
    quadratic: float = 0.0


class TopsParameters(StrictStruct, frozen=True):
    """Parameters of the table `tops`: the tops, a row each."""

    tops: tuple[Top, ...]


class Loop(StrictStruct, frozen=True):
    """A loop at one M3, the momentum about the axis, round the value `p` of a top's unstable spin, or round both spins.

    The loop is in the plane of the momentum p along the field and the energy g; `p` is M3 for the spin along the field,
    -M3 for that against it, so that both have p = 0 for M3 = 0. `ratio` is I3/I2; coupling, linear and quadratic are
    those of `TopMotion`, in units of I2 and of one time.
    """

    name: str
    ratio: float
    M3: float
    p: float
    coupling: tuple[float, float] = (0.0, 0.0)
    linear: float = 0.0
    quadratic: float = 0.0


class MonodromyParameters(StrictStruct, frozen=True):
    """Parameters of the table `monodromy`: the loops, a row each, and the number of points on each."""

    loops: tuple[Loop, ...]
    points: int = 64


def tops(request: Request, setup: TopsParameters) -> Data:
    """Return the table of several tops, a row each: period of nutation, and angles of precession and spin in a period.

    Before these a row has the name and the parameters of the top, see `Top`. Precession is about the field n, spin
    about the body's axis. The period is in units of time, that of small nutations where nu is constant; the angles
    are in rad and whole, not modulo 2 pi.
    """
    from atlas.motions.nutation.certified_top import TopMotion

    motions = [
        TopMotion((1.0, body.ratio), body.coupling, body.direction, body.omega, body.linear, body.quadratic)
        for body in setup.tops
    ]
    columns = columns_of(
        lambda: [(top.period, top.precession_per_period, top.spin_per_period) for top in motions], request.digits
    )
    labels: list[tuple[str | Number, ...]] = [
        (
            top.name,
            Number.as_given(top.ratio),
            *(_of_top(x) for x in (top.coupling, (top.linear, top.quadratic), top.direction, top.omega)),
        )
        for top in setup.tops
    ]
    return Data(
        heads(
            *("Top", "$I$", "$k_2,k_3$", "$a_0,A_0$", "$n_2,n_3$", r"$\boldsymbol\omega$"),
            *("$T$", r"$\Delta\psi$", r"$\Delta\chi$"),
        ),
        tuple((*leading, *values) for leading, values in zip(labels, zip(*columns, strict=True), strict=True)),
        r"Tops of every kind: the period $T$ of nutation and the angles $\Delta\psi$ about $\mathbf{n}$ and "
        r"$\Delta\chi$ about the axis by which the body turns in it, in units of $J_2$ and of one time.",
        (
            r"Where $\nu$ is constant $T$ is the period of small nutations.",
            r"Along $\mathbf{n}$ all of the turn is counted in $\Delta\chi$.",
        ),
    )


def _of_top(numbers: tuple[float, ...]) -> str:
    """Return numbers as the Markdown of one cell, "$1,2$"."""
    return "$" + ",".join(map(plain, numbers)) + "$"


def monodromy(setup: MonodromyParameters) -> Data:
    """Return the table of the monodromy matrices of loops round unstable spins, a row per loop, theorem-residue.

    A row has the name, I, M3 and p, the least and the largest period of nutation on the loop, and the integer matrix
    (3, 3), whose rows are the periods g1 (a turn about the field), g2 (about the axis) and g3 (a nutation) after the
    loop in terms of those before. Last are the largest step of an angle over 2 pi between two points, and the largest
    radius of the balls that enclose these numbers. See `Loop` for I, M3 and p.
    """
    from atlas.maps.monodromy import around, on_loop
    from atlas.maps.wells import Wells

    rows: list[tuple[str | Number, ...]] = []
    for loop_setup in setup.loops:
        wells = Wells.at(loop_setup.M3, loop_setup.ratio, loop_setup.coupling, loop_setup.linear, loop_setup.quadratic)
        loop = around(wells, loop_setup.p, setup.points)
        on_this_loop = on_loop(
            loop_setup.ratio, loop_setup.coupling, loop_setup.M3, loop, loop_setup.linear, loop_setup.quadratic
        )
        matrix = r"\\".join("&".join(map(str, row)) for row in on_this_loop.matrix)
        rows.append(
            (
                loop_setup.name,
                *(Number.as_given(x) for x in (loop_setup.ratio, loop_setup.M3, loop_setup.p)),
                Number(f"{on_this_loop.period.min():.4f}"),
                Number(f"{on_this_loop.period.max():.4f}"),
                rf"$\begin{{pmatrix}}{matrix}\end{{pmatrix}}$",
                Number(f"{on_this_loop.step:.3f}"),
                Number(f"{on_this_loop.radius:.0e}"),
            )
        )
    return Data(
        heads("Top", "$I$", "$M_3$", "$p$", "least $T$", "largest $T$", "matrix", "step", "radius"),
        tuple(rows),
        r"Rows of the matrix: the periods $\mathbf{g}_1$, $\mathbf{g}_2$, $\mathbf{g}_3$ after one round. Beside it "
        r"the largest change of $\Delta\psi/2\pi$ or $\Delta\chi/2\pi$ from one point to the next, which must be less "
        "than a half, and the largest radius of their balls.",
        (f"Loops of {setup.points} points, counter-clockwise in the plane of $p$ and $g$.",),
    )


Triple = tuple[float, float, float]


class Family(StrictStruct, frozen=True):
    """Parameters of the table `elliptic`: a body in a field, and points (z, branch) of elliptic motions.

    `inertia` (I1, I2, I3) and `field` B' in principal axes are in one unit of inertia and one of 1/time. z, in
    inertia^2, is the parameter of the family of motions, see `EllipticMotion`; branch is 1 or -1, the sign of v.
    """

    inertia: Triple
    field: Triple
    places: tuple[tuple[float, int], ...]


class Motion(StrictStruct, frozen=True):
    """A body in a field and its initial angular velocity: (I1, I2, I3), B' and omega in principal axes, in 1/time.

    The moments are in any unit.
    """

    inertia: Triple
    field: Triple
    omega: Triple


class Samples(Motion, frozen=True):
    """A body in a field, its initial angular velocity, see `Motion`, and times."""

    times: tuple[float, ...]


class Observed(StrictStruct, frozen=True):
    """Parameters of `identified`: bodies by their moments, a field, an initial angular velocity, and z.

    Each of the `bodies` is (I1, I2, I3); `field` and `omega` are in principal axes, in 1/time; z is the parameter of
    each body's elliptic motion, see `EllipticMotion`, on the branch v > 0.
    """

    bodies: tuple[Triple, ...]
    field: Triple
    omega: Triple
    z: float


class Momenta(StrictStruct, frozen=True):
    """Parameters of `critical`: a body (I1, I2, I3) in a field of magnitude b, and values p of the momentum.

    p = (M, K)/b is the component along the field of the momentum M = I (Omega + K), with the tensor of inertia I, the
    angular velocity Omega and K = B' in the body's frame.
    """

    inertia: Triple
    b: float
    momentum: tuple[float, ...]


def critical(request: Request, setup: Momenta) -> Data:
    """Return the table of critical values of H and F, a row per momentum and piece of curve, theorem-critical.

    H is the energy integral and F Clebsch's second integral. A row has p, the name of the piece, its two ends, and
    "stable", "saddle" or the kind of a spin. The ends are values of the parameter z for elliptic motions, of F for
    pendulums; a spin has its F alone. All are doubles to four digits.
    """
    from atlas.maps.bifurcation import Bifurcation

    del request  # doubles of four digits
    rows: list[tuple[Any, ...]] = []
    for p in setup.momentum:
        diagram = Bifurcation(setup.inertia, setup.b, p * setup.b)
        ovals = list[tuple[str, float, float, bool]]()
        for stretch in diagram.stretches():
            name = f"{stretch.oval} oval" + (f", $v{'<>'[stretch.branch > 0]}0$" if p else "")
            joined = bool(ovals) and ovals[-1][0] == name and ovals[-1][2:] == (stretch.low, stretch.stable)
            low = ovals.pop()[1] if joined else stretch.low
            ovals.append((name, low, stretch.high, stretch.stable))
        rays = [(f"pendulums about axis {axis + 1}", a, z, steady) for axis, a, z, steady in diagram.rays() if not p]
        for name, start, end, stable in (*ovals, *rays):
            ends = (Number(f"{x:.4g}") if isfinite(x) else r"$\infty$" for x in (start, end))
            rows += [(Number.as_given(p), name, *ends, "stable" if stable else "saddle")] * (start < end)
        for spin in diagram.spins:
            rows.append(
                (Number.as_given(p), f"spin about axis {spin.axis + 1}", Number(f"{spin.F:.4g}"), "", spin.kind)
            )
    return Data(
        heads("$p$", "Piece", "from", "to", "Kind"),
        tuple(rows),
        rf"All critical values of a body with $I_i={_row(setup.inertia)}$ at $b={plain(setup.b)}$ and momenta "
        r"$p=(\mathbf{M},\mathbf{K})/b$: elliptic motions from one place $z$ to another, stable for $C>0$, saddles for "
        r"$C<0$; plane pendulums from one value of $F$ to another; and spins along the field, with their $F$.",
        ("Four digits of doubles, not proven.",),
    )


def identified(request: Request, setup: Observed) -> Data:
    """Return the table of the number of combinations of moments and field that a motion leaves open, a row per motion.

    They are counted in the equations of theorem-identifiable and in the derivatives of a fit to its attitudes at
    the same times; each with the least singular value above the threshold, over the largest. Each body has two
    motions: that from `omega` and that of its elliptic family.
    """
    del request  # doubles of two digits
    rows: list[tuple[str | Number, ...]] = []
    for body in setup.bodies:
        I, K = np.array(body), np.array(setup.field)
        places = setup.z + I.prod() / I
        family = -(1 + np.sqrt(places.prod()) / (I * places)) * K
        for name, omega in (("general", np.array(setup.omega)), ("of the family", family)):
            texts = list[Number]()
            for sizes, least in zip(_singular_values(I, K, omega), OPEN, strict=True):
                shares = sizes / sizes[0]
                texts += [Number(str((shares < least).sum())), Number(f"{shares[shares >= least].min():.2g}")]
            rows.append((f"${_row(body)}$", name, *texts))
    return Data(
        heads("$I_i$", "Motion", "Equations: open", "least", "Fit: open", "least"),
        tuple(rows),
        rf"Combinations that a motion leaves open in $\mathbf{{B}}'={_row(setup.field)}$: of $(x_i,y_i)$ in the linear "
        r"equations of motion, the common factor among them, and of all parameters in the Fisher matrix $S^TS$ of a "
        rf"fit to attitudes. General motions start from $\boldsymbol\omega={_row(setup.omega)}$, those of the family "
        rf"from $z={plain(setup.z)}$, $v>0$. With each the least singular value, of $S$ in a fit, that is not open, in "
        "units of the largest.",
        (
            (
                f"Computed in doubles, not proven, at {TIMES.size} times up to {TIMES[-1]:g}: singular values below "
                f"$10^{{-9}}$ of the largest count as open, in the fit, whose derivatives are differences, $10^{{-5}}$."
            ),
        ),
    )


def _singular_values(I: Any, K: Any, omega: Any) -> tuple[Any, Any]:
    """Return two arrays of singular values, descending: of the linear equations of motion, of a fit's Jacobian.

    `I`, `K` and `omega` (3,) are moments, field B' and initial angular velocity in the body. The equations, at `TIMES`,
    have six unknowns: the moments x_i and the factors y_i of the field K(t), which like Omega(t) is known. The fit, to
    the attitudes at `TIMES`, has the free parameters of the model "asymmetric", in their units.
    """
    from atlas.fitting.data import of_arrays
    from atlas.fitting.models import model_of
    from atlas.fitting.parameters import parameters_of
    from atlas.fitting.problem import Problem
    from atlas.fitting.search import rate_of
    from atlas.motions.any_body import motion

    path = motion(tuple(I), tuple(K), tuple(omega))
    equations = []
    for Omega, field in zip(path.angular_velocity(TIMES), path.field_in_body(TIMES), strict=True):
        rate = (np.cross(I * Omega, Omega) - np.cross((I.sum() - 2 * I) * field, Omega)) / I
        columns = [axis * rate - np.cross(axis * Omega, Omega) for axis in np.eye(3)]
        columns += [np.cross((1 - 2 * axis) * field, Omega) for axis in np.eye(3)]
        equations.append(np.stack(columns, axis=-1))
    data = of_arrays(TIMES, {"rotation": path.rotation(TIMES)}, 1.0, 0.0, scalar_first=False, nan_policy="raise")
    model = model_of("asymmetric")
    problem = Problem(model, data, parameters_of(model, data, None, None)[0], "linear", rate_of(data))
    values = dict(zip(model.names, (I[0] / I[1], I[2] / I[1], *K, *omega, 0.0, 0.0, 0.0), strict=True))
    slopes = problem.jacobian([values[name] for name in problem.names]) * problem.units_of_free
    return np.linalg.svd(np.concatenate(equations), compute_uv=False), np.linalg.svd(slopes, compute_uv=False)


def elliptic(request: Request, setup: Family) -> Data:
    """Return the table of elliptic motions of one body in one field, one a row, theorem-elliptic.

    A row has the place (z, v) of the motion on the curve of its family, see `EllipticMotion`, omega (3,) in 1/time, the
    number C/D^2, whose sign decides on stability, the period T of the field K in the body, the angle in rad by which
    the body turns about the field in T, and a word: "stable", which needs C > 0 unless each Omega_i is 0 or -2 K_i,
    "unstable", or, for C = 0 only, "undecided"; see `EllipticMotion.stability`.
    """
    from atlas.motions.nutation.certified_elliptic import EllipticMotion

    motions = [EllipticMotion(setup.inertia, setup.field, z, branch) for z, branch in setup.places]
    columns = columns_of(
        lambda: [(m.v, *m.omega, m.splitting, m.period, m.turn_per_period) for m in motions], request.digits
    )
    return Data(
        heads("$z$", "$v$", *(rf"$\omega_{i}$" for i in (1, 2, 3)), "$C/D^2$", "$T$", r"$\Theta$", "Motion"),
        tuple(
            (Number.as_given(z), *row, m.stability)
            for (z, _), row, m in zip(setup.places, zip(*columns, strict=True), motions, strict=True)
        ),
        rf"Elliptic motions of a body with $I_i={_row(setup.inertia)}$ in $\mathbf{{B}}'={_row(setup.field)}$: the "
        r"place $(z,v)$, initial angular velocity, the number that decides stability, the period $T$ of "
        r"$\mathbf{K}$, and the turn $\Theta$ of the body about the field in it.",
    )


def periods(request: Request, setup: Motion) -> Data:
    """Return the table of two pairs of times after which M and K return, with the angle about the field, certified.

    M is the momentum and K the field B', both in the body. H is the energy and F Clebsch's integral: to follow the flow
    of H for the time T_H and that of F/2 for T_F brings M and K back. The two rows are a basis of these pairs: T_H, in
    units of time, T_F, and the angle in rad by which the body has turned about the field, in Larmor's frame.
    """
    from flint import fmpq

    from atlas.motions.torus.certified_torus import Torus

    inertia, K, omega = (
        [fmpq(*x.as_integer_ratio()) for x in row] for row in (setup.inertia, setup.field, setup.omega)
    )
    torus = Torus(tuple(inertia), tuple(w + k for w, k in zip(omega, K, strict=True)), tuple(K))
    lattice = torus.periods(bits(request.digits) + 64)
    columns = [column(values, request.digits) for values in zip(*((x.H, x.F, x.angle) for x in lattice), strict=True)]
    return Data(
        heads("Pair", "$T_H$", "$T_F$", r"$\theta$"),
        tuple((f"$r_{n}$", *row) for n, row in enumerate(zip(*columns, strict=True), 1)),
        rf"Periods of the torus of the motion from $\boldsymbol\omega={_row(setup.omega)}$, "
        rf"$I_i={_row(setup.inertia)}$, $\mathbf{{B}}'={_row(setup.field)}$: times of the flows of $H$ and $F/2$ after "
        r"which $\mathbf{M}$ and $\mathbf{K}$ are back, and the angle by which the body has turned about the field, in "
        r"Larmor's frame.",
    )


def asymmetric(request: Request, setup: Samples) -> Data:
    """Return the table of the body's third axis in the laboratory and of Omega3 in 1/time, a row for each time.

    Omega3 is the component of the angular velocity along that axis.
    """
    from atlas.motions.torus.certified import AsymmetricMotion

    motion = AsymmetricMotion(setup.inertia, setup.field, setup.omega)
    columns = columns_of(
        lambda: [(*motion.column(3, t), motion.angular_velocity(t)[2]) for t in setup.times], request.digits
    )
    return Data(
        heads("$t$", *(rf"$R_{{{i}3}}$" for i in (1, 2, 3)), r"$\Omega_3$"),
        tuple(zip(map(Number.as_given, setup.times), *columns, strict=True)),
        rf"The motion from $\boldsymbol\omega={_row(setup.omega)}$ of the body with $I_i={_row(setup.inertia)}$ in "
        rf"$\mathbf{{B}}'={_row(setup.field)}$: its third axis in the laboratory and its spin about it.",
    )


def _row(numbers: Triple) -> str:
    """Return three given numbers as a row vector in TeX, "(1,2,3)", without dollars."""
    return "(" + ",".join(map(plain, numbers)) + ")"
