"""A levitated ball with an electric dipole, its lines and their parameters; bodies that show the paper's term."""

import json
from math import pi, sqrt

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.bodies.body import from_shape
from atlas.bodies.laboratory import GRAVITY, anisotropy, demagnetization, gas_drag
from atlas.bodies.units import ELECTRIC_CONSTANT, ELEMENTARY_CHARGE
from atlas.book.digits import MINUS, Number
from atlas.book.schema import StrictStruct
from atlas.book.tables.table import Data, heads
from atlas.motions.nutation.kernel_top import TopMotion
from atlas.places import folder

MIN_COMPONENT = 1e-3
"""Part of the least amplitude of a line below which a component of it is none."""

NOT_SEEN = 1e-7
"""Ratio to the largest singular value below which a combination of parameters has no observable effect."""

SHARE = 1e-5
"""Share of a parameter in such a combination from which on the data do not determine the parameter."""

RECORDED = {"found": ".0f", "within": ".1f", "seconds": ".2f"}
"""Columns of a record of fits, and their format."""


class Dipole(StrictStruct, frozen=True):
    """A solid sphere: radius in m, density in kg/m^3, dipole in e um, field in V/m, spins about the dipole in Hz.

    `dipole` is in units of the elementary charge times 1 um, `spins` in turns a second. The dipole starts `inclination`
    rad off the field, with no angular velocity but the spin.
    """

    radius: float
    density: float
    dipole: float
    field: float
    spins: tuple[float, ...]
    inclination: float

    def motion(self, spin: float) -> TopMotion:
        """Return the `TopMotion`, in SI units, with `spin` turns a second and potential -d E nu.

        nu is the cosine between dipole and field.
        """
        I = from_shape("sphere", mass=self.density * 4 / 3 * pi * self.radius**3, radius=self.radius).I2
        direction = np.sin(self.inclination), np.cos(self.inclination)
        return TopMotion((I, I), (0.0, 0.0), direction, (0.0, 0.0, 2 * pi * spin), -self.energy)

    @property
    def energy(self) -> float:
        """Energy scale d E in J, of the dipole in the electric field."""
        return self.dipole * 1e-6 * ELEMENTARY_CHARGE * self.field


def levitated(setup: Dipole) -> Data:
    """Return the table of nutation and precession of a ball with a dipole, a row for each spin, in Hz.

    The ball is the solid sphere of `Dipole`. All columns are in turns a second: the spin, the frequency of nutation and
    that of small librations without spin, the precession, negative if it goes round the field against the spin, and
    that of a fast spin.
    """
    rows: list[tuple[str | Number, ...]] = []
    for spin in setup.spins:
        motion = setup.motion(spin)
        I = motion.inertia[0]
        small, slow = sqrt(setup.energy / I) / (2 * pi), -setup.energy / (I * 4 * pi**2 * spin) if spin else 0.0
        frequencies = 1 / float(motion.period), _precession(motion) / (2 * pi)
        rows.append((Number(f"{spin:g}"), *map(_three, (frequencies[0], small, frequencies[1], slow))))
    return Data(
        heads(
            ("Spin", "Hz"), ("Nutation", "Hz"), (r"$\sqrt{dE/I}/2\pi$", "Hz"),
            ("Precession", "Hz"), (r"$-dE/4\pi^2I\,\text{spin}$", "Hz"),
        ),
        tuple(rows),
        rf"A ball of the radius {setup.radius * 1e6:g} µm and {setup.density:g} kg m$^{{-3}}$ with a dipole of "
        rf"{setup.dipole:g} $e$ µm, which starts {setup.inclination:g} rad off a field of {setup.field / 1e3:g} kV/m "
        "and spins about it: the frequencies of the motion, beside those of small librations and of a fast spin.",
        (
            (
                "Three digits of doubles, not proven. A negative precession goes round the field against the spin. "
                "Without a spin the axis goes through the field twice a period of libration: the inclination nods at "
                "twice its frequency, and half a turn about the field in each nod is the precession."
            ),
        ),
    )  # fmt: skip


def _precession(motion: TopMotion) -> float:
    """Return the rate of precession in the spectrum of the axis, in rad/s.

    For a pendulum, which has no spin, it is half the rate of nutation: half a turn about the field in each nod.
    """
    spectrum = motion.spectrum("axis")
    return float(spectrum.rates[spectrum.names.index("precession")])


class Lines(Dipole, frozen=True):
    """A `Dipole` with its rates of spin, for a table of the lines in the spectrum of its axis.

    A line is shown if its amplitude is `least` or more of the root mean square; the axis has length 1.
    """

    least: float = 1e-3


def lines(setup: Lines) -> Data:
    """Return the table of spectral lines of the axis for each spin, with combinations and largest displacements.

    A row has spin and line in turns a second, the combination of frequencies in words, such as "1 nutation", and the
    displacement across and along the field, of an axis of length 1. A line a exp(i f t), f in rad/s, and its conjugate
    at -f draw an ellipse, whose larger semi-axis is twice the largest singular value of (Re a, Im a); the mean has no
    conjugate. Lines with f < 0 have no row.
    """
    rows: list[tuple[str | Number, ...]] = []
    for spin in setup.spins:
        spectrum = setup.motion(spin).spectrum("axis", least=setup.least)
        for f, amplitude, total in zip(spectrum.frequencies, spectrum.amplitudes, spectrum.combinations, strict=True):
            if f < 0:
                continue
            components = [f"{n:+d} {name}" for name, n in zip(spectrum.names, total.tolist(), strict=True) if n]
            n = np.array([0.0, np.sin(setup.inclination), np.cos(setup.inclination)])
            parts_of_line = amplitude - (amplitude @ n) * n, np.atleast_1d(amplitude @ n)
            sizes = [(1 + (f > 0)) * float(np.linalg.norm([a.real, a.imag], 2)) for a in parts_of_line]
            visible = [_three(x if x > MIN_COMPONENT * setup.least else 0.0) for x in sizes]
            rows.append(
                (
                    Number(f"{spin:g}"),
                    _three(f / (2 * pi)),
                    " ".join(components).lstrip("+").replace("-", MINUS) or "mean",
                    *visible,
                )
            )
    return Data(
        heads(("Spin", "Hz"), ("Line", "Hz"), "Turns", "across the field", "along it"),
        tuple(rows),
        f"Lines of the axis of the ball, down to {setup.least:g} of the root mean square: how far each moves the axis "
        "to either side, in the component across the field that it moves most, and along the field.",
        ("Three digits of doubles, not proven; a dash below a thousandth of the least; for the mean its magnitude.",),
    )  # fmt: skip


class Watch(Dipole, frozen=True):
    """A measurement of a `Dipole`'s axis: `samples` in `seconds`, each component with a standard deviation `noise`.

    The axis has length 1.
    """

    samples: int
    seconds: float
    noise: float


def inferred(setup: Watch) -> Data:
    """Return the table of standard deviations of parameters fitted to the axis alone, a column for each spin.

    The rows are d E/I2 relative to itself, d the dipole and E the field, inclination in rad, I3/I2, spin in Hz, and
    spin in Hz with I3 known. They are of first order, from the derivatives of the motion by its parameters at
    random times.
    """
    names = (r"$dE/I$, in parts of itself", "inclination (rad)", "$I_3/I_2$", "spin (Hz)", "spin (Hz), $I_3$ known")
    columns = []
    for spin in setup.spins:
        motion = setup.motion(spin)
        t = np.sort(np.random.default_rng(1).uniform(0.0, setup.seconds, setup.samples))
        v = motion.sensitivity(t, ["linear", "I3", "n2", "n3", "omega3", "omega1", "omega2"])
        n2, n3 = motion.direction
        rotated = np.broadcast_to(np.eye(3), (t.size, 3, 3))
        unit = sqrt(setup.energy / motion.inertia[0])
        scaled = [motion.linear * v[:, 0], n3 * v[:, 2] - n2 * v[:, 3], motion.inertia[0] * v[:, 1], 2 * pi * v[:, 4]]
        scaled += [unit * v[:, 5], unit * v[:, 6], *np.moveaxis(rotated, 1, 0)]
        J = np.stack([np.cross(derivative, motion.column(3, t)).ravel() for derivative in scaled], -1) / setup.noise
        spreads = [*deviations(J)[:4], deviations(np.delete(J, 2, axis=1))[2]]
        columns.append([Number(f"{x:.1e}") if np.isfinite(x) else "–" for x in spreads])
    return Data(
        heads("Quantity", *(f"spin {spin:g} Hz" for spin in setup.spins)),
        tuple((name, *row) for name, row in zip(names, zip(*columns, strict=True), strict=True)),
        f"Smallest standard deviations from {setup.samples} samples of the axis within {setup.seconds:g} s, with noise "
        f"of {setup.noise:g} in every component; the direction of the field and the start are unknown too.",
        ("Two digits of doubles, not proven, of first order; a dash where the axis alone does not determine it.",),
    )


def deviations(J: FloatArray) -> FloatArray:
    """Return the standard deviations (P,) of parameters from derivatives J (N, P) of data in units of their noise.

    They follow from the Fisher matrix J^T J; inf for a parameter in a combination that the data do not determine.
    """
    size = np.linalg.norm(J, axis=0)
    size[size == 0.0] = 1.0
    _, s, V = np.linalg.svd(J / size, full_matrices=False)
    is_known = s > NOT_SEEN * s[0]
    spread = np.sqrt(((V[is_known] / s[is_known, None]) ** 2).sum(axis=0)) / size
    return np.where((abs(V[~is_known]) > SHARE).any(axis=0), np.inf, spread)


class Design(StrictStruct, frozen=True):
    """Spheroids of some equatorial radii in m, of a material, charged to a field at their surface, in a magnet (T).

    `aspect` is polar over equatorial radius, `density` in kg/m^3, `susceptibility` the volume's in SI,
    `surface_field` in V/m. In Larmor's frame they spin about their own axis at `spin` times Larmor's frequency; the
    axis is `inclination` rad off the field.
    """

    radii: tuple[float, ...]
    aspect: float
    density: float
    susceptibility: float
    surface_field: float
    magnet: float
    spin: float
    inclination: float


def beyond_larmor(setup: Design) -> Data:
    """Return the table of precession beyond Larmor's rate, in Hz, by charge, by magnetisation and by both.

    A row for each radius in m has Larmor's frequency b/2 pi and the mean precession beyond it by the charge, by
    magnetisation, by both, and by both less that by magnetisation, all in turns a second; the potential by
    magnetisation over that by the charge; and two disturbances as large as the charge's effect: an offset of the
    centre of charge in m, by its weight, and a pressure of the gas in Pa, by its drag. All motions have the same
    momentum in Larmor's frame, that of the spin about the axis. Rates do not add: the effect of the charge is the
    rate by both less that by magnetisation alone.
    """
    moment_along = demagnetization(setup.aspect)
    rows: list[tuple[str | Number, ...]] = []
    for r in setup.radii:
        volume = 4 / 3 * pi * setup.aspect * r**3
        mass = setup.density * volume
        body = from_shape("spheroid", mass=mass, equatorial=r, polar=setup.aspect * r)
        mu = 3 * ELECTRIC_CONSTANT * setup.surface_field / (setup.density * r)
        b = mu * setup.magnet / 2
        magnetic = -anisotropy(setup.susceptibility, volume, moment_along) * setup.magnet**2
        n = np.sin(setup.inclination), np.cos(setup.inclination)
        I2, I3 = float(body.I2), float(body.I3)
        magnetisation, induced, total = (
            float(TopMotion(
                (I2, I3), (larmor * I2, larmor * I3), n,
                (0.0, -larmor * n[0], setup.spin * b - larmor * n[1]), 0.0, quadratic,
            ).precession_rate) + larmor
            for larmor, quadratic in ((b, 0.0), (0.0, magnetic), (b, magnetic))
        )  # fmt: skip
        potential = (I3 - I2) * b * b
        offset = abs(potential) / 2 / (mass * GRAVITY)
        pressure = abs(total - induced) / (2 * pi) / gas_drag(r, I3)
        rates = [Number(f"{rate / (2 * pi):.7g}") if magnetic else _three(rate / (2 * pi)) for rate in (induced, total)]
        leading, shares = (
            (r, b / (2 * pi), magnetisation / (2 * pi)),
            ((total - induced) / (2 * pi), magnetic / potential),
        )
        rows.append((*map(_three, leading), *rates, *map(_three, (*shares, offset, pressure))))
    return Data(
        heads(
            ("$r$", "m"), (r"$b/2\pi$", "Hz"), ("by the charge", "Hz"), ("by magnetism", "Hz"), ("by both", "Hz"),
            ("both less magnetism", "Hz"), "quotient", (r"offset $\delta$", "m"), ("pressure", "Pa"),
        ),
        tuple(rows),
        rf"Spheroids of $\chi_m={Number(f'{setup.susceptibility:.1e}').tex()[1:-1]}$ and {setup.density:g} "
        rf"kg m$^{{-3}}$, {setup.aspect:g} times as high as wide, charged to "
        rf"{Number(f'{setup.surface_field:.0e}').tex()} V/m, in {setup.magnet:g} T: the mean precession about the "
        rf"field beyond Larmor's turn, of a spin of ${setup.spin:g}\,b$ in Larmor's frame, "
        rf"{setup.inclination:g} rad off the field, by the charge alone, by magnetism alone and by both; the quotient "
        rf"of the potentials, magnetism's over the charge's; the offset $\delta$ of the centre of charge for which "
        rf"$m_0g\delta$ is as large as the charge's potential; the pressure at which the gas stops the spin within "
        "one turn of what the charge changes.",
        ("Three or seven digits of doubles, not proven.", "The drag is that of a sphere of the radius $r$."),
    )  # fmt: skip


def _three(value: float) -> str | Number:
    """Return a `Number` of three digits, without a power of ten from 1e-3 to 1e5; a dash below 1e-30."""
    if abs(value) < 1e-30:
        return "–"
    size = abs(value)
    return Number(f"{value:.0f}" if 1e3 <= size < 1e5 else f"{value:.3g}" if 1e-3 <= size < 1e3 else f"{value:.2e}")


def fits() -> Data:
    """Return the table of recorded fits of simulated data, a row for each family and kind of measurement.

    A row has the share of motions found and of parameters within one standard error in %, and the median CPU time in s.
    """
    record = json.loads((folder("reports") / "data" / "fits.json").read_text(encoding="utf-8"))
    return Data(
        heads("Family", "Measured", ("Found", "%"), ("Within one error", "%"), ("CPU time, median", "s")),
        tuple(
            (*kind.split(", "), *(Number(f"{row[name]:{form}}") for name, form in RECORDED.items()))
            for kind, row in record.items()
        ),
        "Fits of simulated measurements, 100 motions a row, without start values.",
        (
            "500 times with an error of 0.01, unless stated otherwise; 68 % of parameters should lie within one error.",
            "Fast spins turn at about 30/time and are measured for a time of 20. Errors within one fit are correlated.",
        ),
    )
