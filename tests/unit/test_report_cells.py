"""Every number of every table, computed here in another way, where no parameter is 1 and nothing is symmetric."""

import json
import re
from collections.abc import Iterable, Sequence
from decimal import Decimal
from typing import Any

import mpmath
import pytest
from mpmath import mp, mpf
from oracles import closed_form

from atlas.book.blocks.table import Table
from atlas.book.body_and_field import Body, Field, body_and_field, chosen
from atlas.book.digits import Number
from atlas.book.load import load
from atlas.book.tables import TABLES, compute
from atlas.book.tables.table import Data, Request
from atlas.places import folder

I, B2, B3, OMEGA2 = 0.7, 1.3, -0.4, 0.6
TIMES = [0.0, 0.3, 7.25]
BODY = Body(title="long", ratio=I)
FIELD = Field(title="oblique", prime=(B2, B3))
MU, E, B = 1.7, (0.2, -0.3, 0.5), (0.0, 0.9, -0.35)
MAGNET = Field(title="magnet", B=B, E=E, charge_to_mass=MU)
POSITION, VELOCITY, POINT = [0.4, -0.1, 0.3], [0.7, 0.2, -0.6], [0.15, -0.25, 0.35]


def table(
    name: str, digits: int = 20, bodies: Sequence[Body] = (BODY,), field: Field = FIELD, **parameters: Any
) -> Data:
    """Compute a table of bodies in a field."""
    return compute(name, Request([body_and_field(body, field) for body in bodies], parameters, digits))


def holds(data: Data, *rows: Iterable[Any]) -> None:
    """Assert that the numbers of each row are the true ones, rounded to as many decimals, none more and none less."""
    numbers = [[cell for cell in row if isinstance(cell, Number)] for row in data.rows]
    numbers = [row for row in numbers if row]
    for cells, values in zip(numbers, rows, strict=True):
        for cell, value in zip(cells, values, strict=True):
            assert cell.proven
            assert is_rounding(cell.digits, closed_form.exact(value)), (cell, value)


def is_rounding(digits: str, true: mpf) -> bool:
    """Tell whether digits are those of the true value, rounded."""
    unit_last = mpf(10) ** Decimal(digits).as_tuple().exponent
    return bool(abs(mpf(digits) - true) <= unit_last * (0.5 + 1e-12))


def root(square: mpf) -> mpf:
    """Return a semi-axis."""
    return mp.sqrt(abs(square))


def elementary(omega2: float = OMEGA2, field: tuple[float, float] = (B2, B3)) -> closed_form.Elementary:
    """Return the frequencies of a motion of the body."""
    values: closed_form.Elementary = closed_form.elementary(1, I, *field, omega2)
    return values


def test_the_cells_of_named_points_agree_with_their_formulas() -> None:
    """omega2, omega3, k, phi and the nutation frequency squared at each point, in ascending order."""
    with mp.workdps(40):
        i, b2, b3 = mpf(I), mpf(B2), mpf(B3)
        rows = []
        for w in sorted([mpf(0), -2 * b2, -(2 - i) * b2, mpf("0.25"), mpf(-1)]):
            motion, x = closed_form.elementary(1, I, B2, B3, w), (w + b2) / b2
            square = ((b2**2 + b3**2) * x**4 + (1 - i) * (2 * b3**2 - b2**2) * x**2 + b3**2 * (1 - i) ** 2) / x**2
            rows.append((w, motion.omega3, motion.k, motion.phi, square))
        data = table("points", omega2=[0.25, -1.0])
        holds(data, *rows)
        assert [row[-1] for row in data.rows] == ["stable" if row[-1] > 0 else "unstable" for row in rows]
        assert {row[0] for row in data.rows} == {"", "at rest", r"$\phi=0$", r"$\omega_3=0$"}


def test_a_point_at_the_pole_is_noted_below_the_table() -> None:
    """It has no row; of others nothing is said."""
    data = table("points", omega2=[-B2, 0.25])
    assert len(data.rows) == 4
    assert data.notes == (r"There is no row for $\omega_2=-1.3$, since $\omega_2=-B'_2$ does not have one $\omega_3$.",)
    assert not table("points", omega2=[0.25]).notes


def test_the_cells_of_the_quadric_agree_with_their_formulas() -> None:
    """Ratio, both angles, a2, a3, the semi-axes, and the centre -B'."""
    with mp.workdps(40):
        q = closed_form.quadric(1, I, B2, B3)
        squares = [(root(square),) for square in q.squares]
        rows = [(mpf(I),), (q.beta,), (q.angle,), (q.a2,), (q.a3,), *squares, (-mpf(B2),), (-mpf(B3),)]
        holds(table("quadric"), *rows)


def of_the_motion(ratio: float) -> tuple[mpf, ...]:
    """Return initial data, frequencies, nutation and the five integrals of a body, from their definitions at t = 0."""
    motion, i, b2, b3 = closed_form.elementary(1, ratio, B2, B3, OMEGA2), mpf(ratio), mpf(B2), mpf(B3)
    w2, w3 = motion.omega2, motion.omega3
    x, c3 = (w2 + b2) / b2, w3 + b3
    square = ((b2**2 + b3**2) * x**4 + (1 - i) * (2 * b3**2 - b2**2) * x**2 + b3**2 * (1 - i) ** 2) / x**2
    c5 = w2 * b2 - w3**2 + (2 - i) * c3 * w3
    return (w2, w3, motion.k, motion.phi, square, w2**2 + i * w3**2, b2**2 + b3**2, c3, c5, w2 * b2 + i * w3 * b3)


def test_the_cells_of_a_motion_agree_with_their_formulas() -> None:
    """Initial data, frequencies, nutation and the integrals."""
    with mp.workdps(40):
        holds(table("motion", omega2=OMEGA2), *((value,) for value in of_the_motion(I)))


def test_the_cells_of_a_data_sheet_agree_with_their_formulas() -> None:
    """Quadric and motion of each body in its column, on the same rows; a ball has no semi-axes."""
    ratios = (1.6, 0.45, 1.0)
    with mp.workdps(40):
        bodies = []
        for ratio in ratios:
            q = closed_form.quadric(1, ratio, B2, B3)
            axes = [None if ratio == 1 else root(square) for square in q.squares]
            bodies.append((ratio, q.beta, q.angle, q.a2, q.a3, *axes, -B2, -B3, *of_the_motion(ratio)))
        rows = [[value for value in same if value is not None] for same in zip(*bodies, strict=True)]
        data = table("sheet", bodies=[Body(title=f"{ratio}", ratio=ratio) for ratio in ratios], omega2=OMEGA2)
        holds(data, *rows)
    assert [column.head for column in data.columns] == ["Quantity", "Symbol", "1.6", "0.45", "1.0", "Unit"]
    words = {row[0]: row[2:5] for row in data.rows if isinstance(row[2], str)}
    assert words == {
        "quadric @(51)": ("two-sheet hyperboloid", "one-sheet hyperboloid", "cone"),
        "nutation @theorem-stability": ("stable", "stable", "stable"),
    }
    assert [row[4] for row in data.rows if row[0] == "semi-axis"] == ["–", "–", "–"]


def test_a_data_sheet_says_that_a_motion_is_unstable() -> None:
    """Two bodies in a low field, one of them long: its motion is in the unstable band, theorem-band."""
    bodies, low = [Body(title="a", ratio=0.5), Body(title="b", ratio=1.5)], Field(title="low", prime=(1.0, 0.1))
    row = next(row for row in table("sheet", bodies=bodies, field=low, omega2=-0.5).rows if row[0][:8] == "nutation")
    assert row[2:4] == ("unstable", "stable")


def test_the_cells_of_a_motion_at_some_times_agree_with_their_formulas() -> None:
    """Time, Omega(t) of (73) and the third column of (84)."""
    with mp.workdps(40):
        rows = []
        for t in TIMES:
            R = closed_form.elementary_rotation(1, I, B2, B3, OMEGA2, t)
            omega = closed_form.elementary_angular_velocity(1, I, B2, B3, OMEGA2, t)
            rows.append((mpf(t), *omega, *R[:, 2]))
        holds(table("samples", omega2=OMEGA2, times=TIMES), *rows)


def test_the_cells_of_a_path_agree_with_their_formulas() -> None:
    """Time and y(t) by the exponential of the linear system; frequency mu |B|/c and drift c [E,B]/B^2 in the note."""
    with mp.workdps(40):
        rows = [(mpf(t), *closed_form.particle(MU, E, B, POSITION, VELOCITY, t).y) for t in TIMES]
        data = table("particle", field=MAGNET, times=TIMES, position=POSITION, velocity=VELOCITY)
        holds(data, *rows)
        e, b = mpmath.matrix(E), mpmath.matrix(B)
        square = sum(x * x for x in b)
        drift = [(e[(j + 1) % 3] * b[(j + 2) % 3] - e[(j + 2) % 3] * b[(j + 1) % 3]) / square for j in range(3)]
        (note,) = data.notes
        for number, true in zip(re.findall(r"-?\d+\.\d+", note), [mpf(MU) * mp.sqrt(square), *drift], strict=True):
            assert is_rounding(number, true)


def test_the_cells_of_a_flight_agree_with_their_formulas() -> None:
    """Time, the centre of mass, and the point y_0 + R x; the body turns in B' = mu B/2."""
    with mp.workdps(40):
        rows = []
        field = (MU * mpf(B[1]) / 2, MU * mpf(B[2]) / 2)
        field_exact = (float(field[0]), float(field[1]))  # the table takes the nearest doubles
        for t in TIMES:
            y = closed_form.particle(MU, E, B, POSITION, VELOCITY, t).y
            x = closed_form.elementary_rotation(1, I, *field_exact, OMEGA2, t) * mpmath.matrix(POINT)
            rows.append((mpf(t), *y, *(mpf(a) + b for a, b in zip(y, x, strict=True))))
        parameters = {"omega2": OMEGA2, "times": TIMES, "point": POINT, "position": POSITION, "velocity": VELOCITY}
        holds(table("flight", field=MAGNET, **parameters), *rows)


def test_the_cells_of_the_ball_agree_with_their_formulas() -> None:
    """m2, m3, alpha as given; gamma and the axis of (29)."""
    with mp.workdps(40):
        ball = closed_form.ball(1, 0.45, 0.3, -0.7)
        values = (0.3, -0.7, 0.45, ball.gamma, ball.k2, ball.k3)
        data = compute("ball", Request((), {"omega2": 0.3, "omega3": -0.7, "larmor": 0.45}, 20))
        holds(data, *((value,) for value in values))


def test_the_cells_of_companions_agree_with_their_formulas() -> None:
    """The quartic of theorem-top over (nu - r)^2 is A nu^2 + 2 A r nu + C, whose value at r is c; here C is exact."""
    motions = [[B2, B3, -0.7], [3.0, 1.0, -1.5]]
    with mp.workdps(40):
        rows = []
        for motion in motions:
            b2, b3, omega2 = map(closed_form.exact, motion)
            b = mp.hypot(b2, b3)
            r, w, A = b3 / b, omega2 * b / b2 + b, -(b**2) / 2
            M3 = r * (w**2 + A) / w
            p, energy = w * (1 - r**2) + M3 * r, w**2 * (1 - r**2) + A * r**2
            C = (energy - p**2) / r**2
            rate = mp.sqrt(mp.chop(3 * A * r**2 + C, 1e-30))
            high = -r + mp.sqrt(r**2 - C / A)
            angles = [mp.degrees(mp.acos(nu)) for nu in (r, high, -2 * r - high)]
            rows.append((omega2, angles[0], rate, *angles[1:]))
        holds(table("companions", digits=9, ratio=0.5, motions=motions), *rows)


def test_the_cells_of_body_and_field_agree_with_their_formulas() -> None:
    """The inputs; the moments of a shell, their ratio, mu, and B' of (32), where e2 makes B'_2 positive."""
    shell = Body(title="shell", shape="cylindrical_shell", mass=0.75, radius=0.25, height=0.375, charge=-0.3)
    magnet = Field(title="magnet", B=(0.0, 3.0, 4.5), E=(0.5, 0.0, -2.5))
    with mp.workdps(40):
        I3 = mpf("0.75") * mpf("0.0625")
        I2 = I3 / 2 + mpf("0.75") * mpf("0.375") ** 2 / 12
        mu = mpf(-0.3 / 0.75)
        values = (0.75, 0.25, 0.375, -0.3, 0, 3, mpf("4.5"), mpf("0.5"), 0, mpf("-2.5"))
        follows = (I2, I3, I3 / I2, mu, mpf(float(-mu * 3 / 2)), mpf(float(mu * mpf("2.25"))))
        with mp.workdps(17):  # inputs are shown as typed
            values = tuple(mpf(repr(float(value))) for value in values)
        holds(table("body_and_field", bodies=[shell], field=magnet), *((value,) for value in (*values, *follows)))


def test_the_cells_of_charges_agree_with_their_formulas() -> None:
    """Mass, radius, charge mu m0 and e/(4 pi eps0 r^2), to two digits."""
    bodies = [
        Body(title=name, shape="sphere", mass=m, radius=r) for name, m, r in (("a", 9e-15, 2e-6), ("b", 3.0, 0.4))
    ]
    rows = []
    for body in bodies:
        m, r = body.mass or 0.0, body.radius or 0.0
        rows.append((m, r, MU * m, 8.9875517862e9 * MU * m / r**2))
    holds(table("charges", bodies=bodies, field=Field(title="m", B=B, charge_to_mass=MU)), *rows)


def test_the_cells_of_diamagnetism_agree_with_their_formulas() -> None:
    """(I3 - I2) |mu B|^2/8, and the energy -(m, B)/2 of a thin wall along the field less across it, to two digits."""
    tube = Body(title="tube", shape="cylindrical_shell", mass=6e-15, radius=1e-6, height=4e-6)
    hoop = Body(title="hoop", shape="ring", mass=3e-16, radius=2e-6)
    chi, rho, mu0 = -1.2e-5, 2500.0, 4e-7 * mp.pi
    square = sum(x * x for x in B)
    I2, I3 = 6e-15 * (0.5e-12 + 16e-12 / 12), 6e-15 * 1e-12
    rows = []
    for difference, mass, N_along, N_across in ((I3 - I2, 6e-15, 0, 0.5), (3e-16 * 2e-12, 3e-16, 0.5, 0.25)):
        strength = -mpf(chi) * mass / rho * square / (2 * mu0)
        rows.append((difference * MU**2 * square / 8, strength * ((1 - chi * N_along) - (1 - chi * N_across))))
    magnet = Field(title="m", B=B, charge_to_mass=MU)
    holds(table("diamagnetism", bodies=[tube, hoop], field=magnet, susceptibility=chi, density=rho), *rows)


def test_the_cells_of_bodies_that_could_exist_agree_with_their_formulas() -> None:
    """Charge, elementary charges, mu, b, its period, the angle between m and B, and J b^2/k_B, to two digits."""
    surface, density, magnet, eps0 = 1e9, 2500.0, 10.0, 8.8541878188e-12
    parameters = {"radii": [1e-6, 2e-2], "density": density, "surface_field": surface, "magnet": magnet}
    rows = []
    for r in (1e-6, 2e-2):
        charge, mu = 4 * mp.pi * eps0 * r * r * surface, 3 * eps0 * surface / (density * r)
        b = mu * magnet / 2
        motion = closed_form.elementary(1, 1.5, 1, 2, 2 * mp.pi / (b / mp.sqrt(5)) / mp.sqrt(5))
        m, B = (motion.omega2, mpf("1.5") * motion.omega3), (1, 2)
        angle = abs(mp.atan2(m[0] * B[1] - m[1] * B[0], m[0] * B[0] + m[1] * B[1]))
        heat = 8 * mp.pi * density * mpf(r) ** 5 / 15 * b * b / 1.380649e-23
        rows.append((r, charge, charge / 1.602176634e-19, mu, b, 2 * mp.pi / b, angle, heat))
    holds(compute("sizes", Request((), parameters, 2)), *rows)


def test_the_cells_of_radiation_agree_with_their_formulas() -> None:
    """Energy over power in Julian years: Larmor's formula, a magnetic dipole, an electric quadrupole, in SI units."""
    surface, density, magnet, eps0, c = 1e9, 2500.0, 10.0, 8.8541878188e-12, 299_792_458.0
    parameters = {"radii": [1e-6, 2e-2], "density": density, "surface_field": surface, "magnet": magnet}
    rows = []
    for r in (1e-6, 2e-2):
        e, mass = 4 * mp.pi * eps0 * r * r * surface, 4 * mp.pi / 3 * density * r**3
        mu = e / mass
        b = mu * magnet / 2
        inertia = 2 * mass * r * r / 5
        flight = (mass / 2) / (e**2 * (2 * b) ** 2 / (6 * mp.pi * eps0 * c**3))
        energy = inertia * b**2 / 2
        dipole = mu * inertia * b / 2
        magnetic = energy / ((dipole * b**2) ** 2 / (6 * mp.pi * eps0 * c**5))
        # D = mu (I2 - I3)(3 n n - 1) of an axis that runs round a circle: |D'''|^2 = 16 * 18 (mu (I2 - I3) b^3)^2
        electric = energy / (288 * (mu * inertia * 0.5 * b**3) ** 2 / (720 * mp.pi * eps0 * c**5))
        rows.append((r, *(time / 31_557_600 for time in (flight, magnetic, electric))))
    holds(compute("radiation", Request((), parameters, 2)), *rows)


def test_the_cells_of_fits_count_fits_within_their_errors() -> None:
    """Found in 97 % at least, fast spins in 90; within one standard error in 68 %, up to 5 or twice its error."""
    record = json.loads((folder("reports") / "data" / "fits.json").read_text(encoding="utf-8"))
    rows = [(row["found"], row["within"], row["seconds"]) for row in record.values()]
    assert len(rows) == 16
    for kind, row in record.items():
        assert row["found"] >= (90 if "fast spins" in kind else 97)
        assert abs(row["within"] - 68) <= (2 * row["error"] if "fast spins" in kind else 5)
    holds(compute("fits", Request((), {}, 2)), *rows)


@pytest.mark.parametrize(
    "name",
    [*("sizes", "radiation", "charges", "coats", "diamagnetism", "swings"), *("levitated", "lines", "beyond_larmor")],
)
def test_a_table_of_doubles_says_that_they_are_not_proven(name: str) -> None:
    """A table of the atlas that is not made of balls has it in its notes."""
    report = load(folder("reports") / "atlas.md")
    blocks = [block for page in report.pages for block in page.blocks if isinstance(block, Table)]
    (block,) = [block for block in blocks if block.table == name]
    data = compute(name, Request(chosen(block, report.parameters), block.parameters, block.digits))
    assert any("not proven" in note for note in data.notes)


def test_every_table_has_a_test_of_its_cells() -> None:
    """Each table has a test of its cells above, or in another file."""
    tested = {"points", "quadric", "sheet", "motion", "samples", "particle", "flight", "ball", "body_and_field"}
    words = {
        "quantities",
        "targets",
        "roles",
        "layers",
        "blocks",
        "report_keys",
    }  # test_guide, test_targets, test_report_tables
    tested |= {"charges", "fits", "companions", "diamagnetism", "sizes", "radiation"}
    elsewhere = {
        "tops",
        "monodromy",
        "coats",
        "swings",
        "properties",
        "closed",
        "critical",
    }  # test_report_tables, test_page
    elsewhere |= {"identified"}  # test_identifiable
    elsewhere |= {"elliptic", "periods", "asymmetric"}  # test_three_moments
    elsewhere |= {"levitated", "lines", "inferred", "beyond_larmor"}  # test_laboratory
    assert set(TABLES) - words == tested | elsewhere
