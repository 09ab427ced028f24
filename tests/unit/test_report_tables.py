"""Tables: every digit printed is that of the true value, computed here in another way."""

import re
import string
import unicodedata
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import flint
import mpmath
import numpy as np
import pytest
from fontTools.ttLib import TTFont

import atlas.book.keys  # noqa: F401  adds the tables that explain records
from atlas.book.blocks.table import Cell, ColumnView, TableView
from atlas.book.body_and_field import Body, Field, body_and_field
from atlas.book.digits import MINUS, THIN, Number
from atlas.book.fonts import ALWAYS, FACES, ITALIC, source
from atlas.book.load import load
from atlas.book.tables import TABLES, compute
from atlas.book.tables.table import Data, Request, column, scaled
from atlas.errors import AtlasError
from atlas.pictures.style import STYLES

BODY = Body(title="short solenoid", ratio=1.5)
OBLIQUE = Field(title="oblique field", prime=(1.0, 2.0))


def table(name: str, digits: int = 10, body: Body = BODY, field: Field = OBLIQUE, **parameters: object) -> Data:
    """Compute a table."""
    return compute(name, Request((body_and_field(body, field),), parameters, digits))


def agrees(number: Number, true: mpmath.mpf) -> bool:
    """Whether the digits are the true value rounded to as many decimals."""
    printed = Decimal(number.digits)
    unit_last = mpmath.mpf(10) ** printed.as_tuple().exponent
    return bool(abs(mpmath.mpf(number.digits) - true) <= unit_last / 2)


def values(data: Data) -> dict[str, Number]:
    """Return the numbers of a table of quantities, by symbol."""
    return {str(row[1]): row[2] for row in data.rows if isinstance(row[2], Number)}


def test_a_long_time_costs_no_digit() -> None:
    """R_33 at t = 10^6 is that of (84) in 40 digits."""
    row = table("samples", omega2=0.5, times=[1e6]).rows[0]
    with mpmath.workdps(40):
        true = mpmath.mpf(4) / 5 + mpmath.cos(mpmath.mpf(10) ** 6 * mpmath.sqrt(5) / 2) / 5
        assert isinstance(row[6], Number)
        assert agrees(row[6], true)


def test_a_motion_at_an_end_of_the_band_is_called_unstable() -> None:
    """At I = 1/2, B' = (3, 1), omega2 = -3/2 the square of the nutation frequency is zero, theorem-band-ends."""
    body, field = Body(title="long", ratio=0.5), Field(title="low", prime=(3.0, 1.0))
    rows = {str(row[1]): row for row in table("points", body=body, field=field, omega2=[-1.5]).rows}
    assert rows[str(Number("-1.5"))][5] == Number("0")
    assert rows[str(Number("-1.5"))][6] == "unstable"


def test_the_charge_of_a_body_follows_from_its_mass() -> None:
    """The charge is mu m0, and the field of that charge at the distance of the radius in SI units."""
    ball = Body(title="ball", shape="sphere", mass=9e-15, radius=1e-6)
    field = Field(title="field", B=(0.0, 2.0, 4.0), charge_to_mass=2.0)
    (row,) = table("charges", body=ball, field=field).rows
    assert row[3] == Number("1.8e-14")
    assert row[4] == Number(f"{1.8e-14 * 8.9875517862e9 / 1e-12:.1e}")
    with pytest.raises(AtlasError, match="mass and radius"):
        table("charges")
    needle = Body(title="needle", shape="cylindrical_shell", mass=1.5e-15, radius=5e-324, height=1.2e-6)
    with pytest.raises(AtlasError, match="too large for a float"):
        table("charges", body=needle, field=field)


def test_the_bodies_that_could_exist_have_the_frequencies_of_their_charge() -> None:
    """Frequency 3 eps0 E B/(2 rho r), angle |1-I| B2hat B3hat b/k at its limit; the flight radiates before the turn."""
    parameters: dict[str, object] = {"radii": [1e-6, 1e-2], "density": 2500.0, "surface_field": 1e9, "magnet": 10.0}
    data = compute("sizes", Request((), parameters, 2))
    for r, row in zip((1e-6, 1e-2), data.rows, strict=True):
        b = 3 * 8.8541878188e-12 * 1e9 * 10.0 / (2 * 2500.0 * r)
        assert row[4] == Number(f"{b:.1e}")
    assert row[6] == Number(f"{0.5 * 0.4 * b / 6.283185307179586:.1e}")
    for row in compute("radiation", Request((), parameters, 2)).rows:
        flight, magnetic, electric = (float(cell.digits) for cell in row[1:] if isinstance(cell, Number))
        assert 1e20 * flight < min(magnetic, electric)
    with pytest.raises(AtlasError, match="positive"):
        compute("sizes", Request((), {**parameters, "density": 0.0}, 2))


def test_every_number_has_a_unit() -> None:
    """Each numeric column names its unit in its head, or a column of units stands beside it."""
    more = {
        "points": {},
        "quadric": {},
        "motion": {"omega2": 0.7},
        "sheet": {"omega2": 0.7},
        "samples": {"omega2": 0.7, "times": [0.0, 1.0]},
        "body_and_field": {},
    }
    for name, parameters in more.items():
        data = table(name, **parameters)
        heads = [column.head for column in data.columns]
        for place, head in enumerate(data.columns):
            if any(isinstance(row[place], Number) for row in data.rows):
                assert head.unit or "Unit" in heads, (name, head.head)
        if "Unit" in heads:
            unit_column = heads.index("Unit")
            assert all(row[unit_column] for row in data.rows if isinstance(row[unit_column - 1], Number)), name


def test_a_column_of_mixed_sizes_has_powers_of_ten() -> None:
    """Entries far apart each have their own power; near ones share their decimals."""
    assert [number.parts()[2] for number in column([1.0, 1e-9], 5)] == ["", "\N{MINUS SIGN}9"]
    assert {number.parts()[2] for number in column([1.5, 0.25], 5)} == {""}


@pytest.mark.parametrize(
    ("values", "plain", "prefix"),
    [
        ("1e-4", True, -6),
        ("9e-5", False, -6),
        ("9e-4", True, -6),
        ("1e-3", True, None),
        ("9e5", True, None),
        ("1e6", True, 6),
        ("9e6", True, 6),
        ("1e7", False, 6),
        ("1e-7", False, -9),
        ("1e9", False, 9),
        ("3 4e-6", True, None),
        ("3 4e-7", False, None),
        ("4e5 0.2", True, None),
        ("4e5 0.02", False, None),
        ("0", True, None),
    ],
)
def test_columns_have_powers_of_ten_for_small_large_and_mixed_numbers(
    values: str, plain: bool, prefix: int | None
) -> None:
    """A column has them below 1e-4, from 1e7 on and beyond six decades; its unit takes them in thousands."""
    exact = [Fraction(value) for value in values.split()]
    rationals = [flint.fmpq(value.numerator, value.denominator) for value in exact]
    assert any("e" in cell.digits for cell in column(rationals, 4)) is not plain
    unit, ((number, *_),) = scaled([rationals], "m", 4)
    assert unit == ("m" if prefix is None else f"$10^{{{prefix}}}$ m")
    assert Fraction(number.digits) * Fraction(10) ** (prefix or 0) == exact[0]


def test_a_shape_in_si_units_gives_its_ratio_without_rounding() -> None:
    """A shell of h = 2R has I = 6/5, whatever the rounding of its moments."""
    shell = Body(title="shell", shape="cylindrical_shell", mass=0.1, radius=0.25, height=0.5, charge=0.3)
    magnet = Field(title="magnet", B=(0.0, 3.0, 4.0))
    cells = values(table("body_and_field", 30, shell, magnet))
    assert cells["$I=I_3/I_2$"].digits == "1.2" + 28 * "0"
    assert body_and_field(shell, magnet).ratio == 1.2


@pytest.mark.parametrize(
    ("body", "words"),
    [
        (Body(title="b"), "exactly one of"),
        (Body(title="b", ratio=1.0, shape="ring"), "exactly one of"),
        (Body(title="b", shape="rng", mass=1.0, radius=1.0), "'ring'"),
        (Body(title="b", shape="ring", mass=1.0), "takes mass, radius"),
        (Body(title="b", ratio=2.5), "at most 2"),
    ],
)
def test_a_body_that_cannot_be_is_refused_with_a_reason(body: Body, words: str) -> None:
    """Each way to give a body wrongly is told."""
    with pytest.raises(AtlasError, match=words):
        body_and_field(body, None)


def test_unknown_tables_and_parameters_are_refused() -> None:
    """A misspelt table or parameter names the one that was meant."""
    with pytest.raises(AtlasError, match="'points'"):
        table("point")
    with pytest.raises(AtlasError, match="'omega2'"):
        table("motion", omega_2=0.7)
    assert set(TABLES) >= {"quadric", "points", "motion", "particle", "flight"}


def test_available_quantities_are_listed_in_words() -> None:
    """Their lines can be broken, so that no long one makes the type of the whole table small."""
    for name in ("quantities", "targets", "roles"):
        assert all(isinstance(cell, str) for row in table(name).rows for cell in row), name


def test_a_number_of_which_no_digit_is_proven_has_none() -> None:
    """A ball about zero is printed as a question mark and marked; its status is not in its digits."""
    (number,) = column([flint.arb(0, 1e-3)], 5)
    assert not number.proven
    (none,) = column([flint.arb(0, 2)], 5)
    assert none == Number("", proven=False)
    assert none.parts() == ("?", "", "")
    (wide,) = column([flint.arb(1.2345, 1e-3)], 8)
    assert wide == Number("1.2", proven=False)  # one end rounds to 1.23, the other to 1.24


def test_a_path_beside_its_axis_of_a_micrometre_is_tabled() -> None:
    """Along B the particle drifts by 1e-6 m a second from 2.5e-6 m off the axis: powers of ten, exact zeros."""
    magnet = Field(title="magnet", B=(0.0, 0.0, 1.3), charge_to_mass=2.0)
    data = table("particle", field=magnet, times=[0.0, 2.0], velocity=[0.0, 0.0, 1e-6], position=[2.5e-6, 0.0, 0.0])
    assert [column.unit for column in data.columns[1:]] == 3 * ["$10^{-6}$ m"]
    assert data.rows[1] == (Number("2"), Number("2.500000000"), Number("0"), Number("2.000000000"))


def test_scaled_columns_lose_no_digit() -> None:
    """60 digits of a length of nanometres are those of (98) in 80 digits: the power of ten is not taken in doubles."""
    magnet = Field(title="magnet", B=(0.0, 0.0, 1.0), charge_to_mass=2.0)
    data = table("particle", 60, field=magnet, times=[1.0], velocity=[3e-9, 0.0, 0.0])
    (number,) = (cell for cell in data.rows[0][1:2] if isinstance(cell, Number))
    with mpmath.workdps(80):
        assert [column.unit for column in data.columns[1:]] == 3 * ["$10^{-9}$ m"]
        assert agrees(number, mpmath.mpf(3e-9) * mpmath.sin(2) / 2 * 10**9)
    assert number.proven
    assert len(number.digits) >= 60


def test_a_line_without_named_points_is_reported() -> None:
    """With B2 = 0 omega3 is free on the line omega2 = 0: there is no table of points, and one sentence says so."""
    with pytest.raises(AtlasError, match="B2 = 0"):
        table("points", field=Field(title="axial", prime=(0.0, 2.0)))


DIGITS = "0 -7 12 1.5 -0.25 1.2345 1.23456 -12.345678 0.123456789 3e2 1.25e-3 -4.5e4 6.5e-4 1e12 -1.234567e-15".split()


@pytest.mark.parametrize("digits", DIGITS)
def test_a_number_reads_back_from_each_way_to_print_it(digits: str) -> None:
    """In a cell, a sentence and a formula: the same decimals; after the point in threes where there are more than four.

    In a sentence and a formula powers of ten below 10^4 and above 10^-4, or of 10^0, are not written.
    """
    number, value = Number(digits), Decimal(digits)
    integer, fraction, power = number.parts()
    groups = fraction.removeprefix(".").split(THIN)
    assert fraction == "" or fraction.startswith(".")
    assert [len(group) for group in groups[:-1]] == [3] * (len(groups) - 1)
    assert len(groups) == 1 + (len("".join(groups)) > 4) * (len("".join(groups)) - 1) // 3
    plain = (integer + fraction.replace(THIN, "") + (f"e{power}" if power else "")).replace(MINUS, "-")
    assert Decimal(plain).as_tuple() == value.as_tuple()
    words, _, raised = number.words().replace(MINUS, "-").removesuffix("^").partition("×10^")
    assert Decimal(words) * Decimal(10) ** int(raised or 0) == value
    exponent = int(digits.partition("e")[2] or 0)
    assert bool(raised) == (abs(exponent) > 3)
    tex, _, high = number.tex().strip("$").removesuffix("}").partition(r"\times 10^{")
    assert Decimal(tex) * Decimal(10) ** int(high or 0) == value
    assert bool(high) == bool(exponent)


def test_fonts_have_all_written_characters() -> None:
    """All that a keyboard has, the whole italic alphabet of formulas, and the weight that the font itself says."""
    assert {*string.ascii_letters, *string.digits, *string.punctuation, " "} <= {*ALWAYS}
    assert all(letter.isprintable() or letter.isspace() for letter in ALWAYS)
    named = {letter: unicodedata.name(letter, "") for letter in map(chr, range(0x1D400, 0x1D800))}
    italic = {x for x, name in named.items() if name.startswith("MATHEMATICAL ITALIC") and "DOTLESS" not in name}
    assert {letter for letter in ITALIC if unicodedata.name(letter, "")} == italic | {"\N{PLANCK CONSTANT}"}
    for face in FACES.values():
        assert face.weight == TTFont(source(face))["OS/2"].usWeightClass


def test_a_table_of_more_than_two_dozen_rows_may_be_broken_over_pages() -> None:
    """Its rows are single lines then, of words too."""
    column = ColumnView(0, None, numeric=False, before=0.0, after=0.0)
    for count in (24, 25):
        table = TableView(1, "tab-x", (column, column), ((Cell(0), Cell(0)),) * count, 0, 0, None)
        assert table.tall == table.tight == (count > 24)


def test_periods_of_tops_in_a_table_agree_with_a_quadrature() -> None:
    """T of a released heavy top and of a spherical pendulum, by 4000 points of Gauss and Chebyshev, to ten digits."""
    tops = [
        {"name": "top", "ratio": 0.5, "direction": [0.6, 0.8], "omega": [0.0, 0.0, 5.0], "linear": 1.0},
        {"name": "pendulum", "ratio": 0.5, "direction": [0.6, -0.8], "omega": [0.5, 0.6, 0.0], "linear": 1.0},
    ]
    rows = compute("tops", Request((), {"tops": tops}, 10)).rows
    for row, (nu, p, M3, square) in zip(rows, ((0.8, 2.0, 2.5, 0.0), (-0.8, 0.36, 0.0, 0.61)), strict=True):
        g = square + 2 * nu
        q = np.array([2.0, -g - M3 * M3, -2.0 + 2 * p * M3, g - p * p])
        low, high, root_high = np.sort(np.roots(q).real)
        x = (low + high) / 2 + (high - low) / 2 * np.cos(np.pi * (np.arange(4000) + 0.5) / 4000)
        assert float(row[6].digits) == pytest.approx(np.mean(2 * np.pi / np.sqrt(2 * (root_high - x))), rel=1e-9)


def test_charges_outside_have_the_factors_of_their_shapes() -> None:
    """A ball: 5/3 twice. A cylinder with I = 1 and its charge on the side wall: 3/2 and 2, and A = (2 - 9/8) 2."""
    cylinder = {"radius": 1.0, "height": 3.0**0.5}
    coats = [
        {"name": "ball", "mass": "sphere", "charge": "spherical_shell", "dimensions": {"radius": 2.0}},
        {"name": "rod", "mass": "solid_cylinder", "charge": "cylindrical_shell", "dimensions": cylinder},
    ]
    rows = compute("coats", Request((), {"coats": coats}, 3)).rows
    assert [number.digits for number in rows[0][1:]] == ["1.000", "1.667", "1.667", "0.000", "0.000"]
    assert [number.digits for number in rows[1][1:]] == ["1.000", "1.500", "2.000", "-0.500", "1.750"]


def test_magnetised_bodies_swing_like_pendulums() -> None:
    """T is 2K(sin theta)/sqrt(-A) of a needle, which goes through the pole, 4K(cos theta)/sqrt(A) of a disk."""
    field = Field(title="", B=(0.0, 2.0, 4.0), charge_to_mass=1.0)
    needle = Body(title="", shape="cylindrical_shell", mass=6e-15, radius=1e-6, height=4.242640687119285e-6)
    disk = Body(title="", shape="ring", mass=1e-16, radius=1e-6)
    for body, quarters, square in ((needle, 2, 0.2), (disk, 4, 0.8)):
        (row,) = table("swings", body=body, field=field, susceptibility=-1.2e-5, density=2500.0).rows
        for rate, period in ((row[2], row[3]), (row[4], row[5])):
            true = quarters * float(mpmath.ellipk(square)) / float(rate.digits)
            assert float(period.digits) == pytest.approx(true, rel=0.012)
        assert float(row[6].digits) == pytest.approx((float(row[4].digits) / float(row[2].digits)) ** 2, rel=0.03)


def test_the_monodromy_of_a_table_agrees_with_its_loop() -> None:
    """A row of the matrix for g3, and a step that tells why."""
    loop = {"name": "top", "ratio": 0.5, "M3": 0.5, "p": 0.5, "linear": 1.0}
    (row,) = compute("monodromy", Request((), {"loops": [loop], "points": 24}, 3)).rows
    assert r"0&1&0\\-1&1&1\end" in row[6]
    assert float(row[7].digits) < 0.25


def test_the_required_keys_of_a_block_are_those_without_which_it_is_refused(tmp_path: Path) -> None:
    """A block with these alone is read; without any one of them it is refused by its name."""
    values = {"columns": '["a"]', "rows": '[["b"]]', "names": '["Quadric"]', "source": '"trial"', "section": '"II"'}
    page = '[[pages]]\nslug = "index"\ntitle = "t"\n[[pages.blocks]]\n'
    for kind, _, keys in compute("blocks", Request([], {}, 10)).rows:
        keys_required = re.findall(r"\*\*`(\w+)`\*\*", str(keys))
        for left_out in (None, *keys_required):
            written = {"kind": f'"{kind}"'.replace("`", "")} | {
                key: values.get(key, '"(71)"') for key in keys_required if key != left_out
            }
            text = 'name = "n"\ntitle = "t"\n' + page + "".join(f"{k} = {v}\n" for k, v in written.items())
            (tmp_path / "n.toml").write_text(text, encoding="utf-8")
            if left_out is None:
                assert load(tmp_path / "n.toml").name == "n"
            else:
                with pytest.raises(AtlasError, match=rf"\b{left_out}\b"):
                    load(tmp_path / "n.toml")


def test_the_roles_of_a_table_agree_with_the_style() -> None:
    """Each role stands in it once, and so does each layer of the scene."""
    roles = [name for row in compute("roles", Request([], {}, 10)).rows for name in re.findall(r"`(\w+)`", str(row[0]))]
    assert sorted(roles) == sorted(STYLES)
    names = [str(row[0]).strip("`") for row in compute("layers", Request([], {}, 10)).rows]
    assert {"Scene", "Plane", "Space", "Curve", "Points", "Arrow", "Label", "Surface", "Region", "Image"} == set(names)


def test_kinds_of_spins_agree_with_the_linearized_equations() -> None:
    """In the table of critical values a spin is stable, a saddle or a focus as the eigenvalues of its motion say."""
    inertia, momenta = [0.5, 1.0, 1.25], [1.6, 0.7, 0.2]
    data = compute("critical", Request((), {"inertia": inertia, "b": 1.0, "momentum": momenta}, 4))
    J = np.array(inertia)

    def rates(state: np.ndarray) -> np.ndarray:
        M, K = state[:3], state[3:]
        return np.concatenate([np.cross(M, M / J) + np.cross(K, J * K), np.cross(K, M / J)])

    spins = [row for row in data.rows if str(row[1]).startswith("spin")]
    assert len(spins) == 9
    for p, name, value, _, kind in spins:
        axis = np.eye(3)[int(name[-1]) - 1]
        state = np.concatenate([float(p.digits) * axis, axis])
        flow = np.stack([(rates(state + e) - rates(state - e)) / 2 for e in np.eye(6)], axis=-1)  # quadratic
        roots = np.linalg.eigvals(flow)
        leaves, turns = np.abs(roots.real) > 1e-6, np.abs(roots.imag) > 1e-6
        assert kind == ("focus-focus" if (leaves & turns).any() else "saddle" if leaves.any() else "stable")
        assert float(value.digits) == pytest.approx(float(p.digits) ** 2 - J.prod() / (J @ axis), abs=5e-4)


def test_a_unit_stands_in_its_column_alone() -> None:
    """With the unit of time s no words of a given quantity say 1/time."""
    parameters: dict[str, object] = {
        "family": "asymmetric",
        "inertia": (1.0, 2.0, 2.5),
        "field": (0.0, 0.0, 0.0),
        "omega": (1.0, 0.2, 0.3),
    }
    rows = compute("properties", Request((body_and_field(None, None),), parameters | {"time": "s"}, 10)).rows
    assert any(row[0] == "Initial angular velocity" for row in rows)
    assert not any("1/time" in str(row[0]) for row in rows)
