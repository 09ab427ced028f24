"""The lines of a motion.

The signals of detectors of the body's axis and of its angular velocity in a general motion: each line is at
m omega_T + l k, or m omega_T + j phi: omega_T is the frequency of nutation, k and phi the mean rates of precession
and of spin.
"""

import numpy as np

from atlas.arithmetic.inputs import integer, number
from atlas.errors import DomainError
from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.motions.spectrum import Spectrum
from atlas.pictures import Curve, Label, Layer, Plane, Points, Scene
from atlas.pictures.captions import plain, plain_setting, plain_vector, tex_equals, tex_setting, tex_vector

ROW = "its axis"
SEEN = "Lines lie at sums of multiples of two frequencies."
WIDTH, HEIGHT = 120.0, 110.0
BESIDE = 0.1
"""Part of the width between names that are both written."""


def scene(
    *,
    ratio: float = 1.5,
    field: tuple[float, float] = (1.0, 2.0),
    omega: tuple[float, float, float] = (0.3, 0.7, 0.2),
    least: float = 1e-4,
    names: int = 12,
    unit: str = "time",
) -> Scene:
    """Draw spectral lines down to ``least``, and the whole numbers of the ``names`` highest ones of each panel.

    ``least`` is the least amplitude drawn, over the root mean square of the vector; the whole numbers are the
    multiples of the basic rates in a line's frequency, see `Spectrum`. ``ratio`` is I3/I2; ``field`` is (B2, B3) of
    B', ``omega`` the angular velocity at t = 0, in 1/time; ``unit`` is the word for the unit of time. Raises
    DomainError for ``least`` outside 1e-12 to 0.1.
    """
    least, names = number(least, "least"), integer(names, "names", 0)
    if not 1e-12 <= least <= 0.1:
        raise DomainError(f"figure spectrum draws lines down to least = 1e-12 to 0.1, not {least:g}.")
    motion = GeneralMotion(ratio, field, omega)
    axis, spin = motion.spectrum("axis", least), motion.spectrum("angular_velocity", least)
    rates = dict(zip((*axis.names, *spin.names), (*axis.rates, *spin.rates), strict=True))
    top = 1.2 * float(max(axis.frequencies.max(initial=0.0), spin.frequencies.max(initial=0.0))) or 1.0
    symbols = {"nutation": r"\omega_T", "precession": "k", "spin": r"\phi"}
    rate_words = ", ".join(f"${symbols[name]}{tex_equals(rate)}$" for name, rate in rates.items()) or "all at zero"
    return Scene(
        caption=(
            rf"{tex_setting(ratio, field, article='A')} from "
            rf"$\boldsymbol{{\omega}}={tex_vector(omega)}$: {rate_words}. (a) Of the axis, along the field and across "
            "it. "
            r"(b) Of $\boldsymbol{\Omega}$, along the axis and across it. Heights are norms of "
            r"complex amplitudes, for one sign of a frequency, over the root mean square."
        ),
        alt=(
            "Two panels of vertical lines over frequency, on a logarithmic scale, for "
            f"{plain_setting(ratio, field)} from the angular velocity {plain_vector(omega)}: of the body's axis and of "
            "the angular velocity in the body."
            + (
                " They become lower by about the same factor from one multiple of the nutation, "
                f"{plain(rates['nutation'])}, to the next."
                if "nutation" in rates
                else ""
            )
        ),
        panels=(
            stems(r"(a) the axis, $(m,l)$ at $m\omega_T+lk$", axis, least, names, top, ""),
            stems(r"(b) $\boldsymbol{\Omega}$, $(m,j)$ at $m\omega_T+j\phi$", spin, least, names, top, unit),
        ),
        size=(WIDTH, HEIGHT),
    )


def stems(heading: str, lines: Spectrum, least: float, count: int, top: float, unit: str) -> Plane:
    """Return a `Plane` of spectral lines; lines with turns about the field or the body's axis are of a second kind.

    `heading` is the title. Amplitudes are norms of complex amplitudes over the root mean square, drawn from
    ``least`` / 2 on; the ``count`` highest lines bear their whole numbers. Frequencies, in rad/time, go from 0 up
    to ``top``; without a ``unit`` the axis has no name, and the kinds have.
    """
    size = np.sqrt(lines.power / lines.mean_square)
    positive = lines.frequencies >= 0
    f, size, numbers = lines.frequencies[positive], size[positive], np.zeros((positive.sum(), 2), dtype=int)
    for i, name in enumerate(lines.names):
        numbers[:, int(name != "nutation")] = lines.combinations[positive, i]
    layers: list[Layer] = []
    for turns, (role, kind) in enumerate((("second", "along"), ("main", "across"))):
        chosen = np.flatnonzero((numbers[:, 1] != 0) == bool(turns))
        for i, n in enumerate(chosen):
            stem = np.array([[f[n], least / 2], [f[n], size[n]]])
            layers.append(Curve(stem, role))
            if not (i or unit):
                layers.append(Label(np.sqrt(stem[0] * stem[1]), kind, role, (4.0, 0.0)))
        layers.append(Points(np.column_stack([f, size])[chosen], "point" if turns else "rest"))
    labelled: list[int] = []
    for n in np.argsort(-size):
        if len(labelled) < count and all(abs(f[n] - f[neighbour]) > BESIDE * top for neighbour in labelled):
            labelled.append(int(n))
    for n in sorted(
        labelled, key=lambda n: float(f[n])
    ):  # a name that gives way to its left neighbour goes to the right
        text = f"$({numbers[n, 0]},{{{numbers[n, 1]}}})$"
        layers.append(Label(np.array([f[n], size[n]]), text, "label", (0.0, 7.0)))
    return Plane(
        tuple(layers), f"frequency (1/{unit})" if unit else "", "amplitude", (-0.1 * top, top), (least / 2, 20.0),
        y_scale="log", title=heading,
    )  # fmt: skip
