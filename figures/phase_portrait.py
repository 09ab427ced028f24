"""Phase portrait of the nutation.

All motions with the same two conserved momenta about the field and about the axis, whatever their energy: Omega3
against its rate. In Larmor's frame the body is a symmetric top, theorem-top, with nu = cos(theta), theta between axis
and field, and one degree of freedom is left; Omega3 = c3 - b nu. Its equilibria are elementary motions.
"""

from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np
from numpy.polynomial import Polynomial

from atlas.arithmetic.inputs import FloatArray
from atlas.bodies.integrals import shape_factors
from atlas.errors import DomainError
from atlas.maps.bifurcation import momentum_map, potential
from atlas.motions.elementary.kernel_hyperbola import Hyperbola
from atlas.pictures import Curve, Label, Layer, Plane, Points, Scene
from atlas.pictures.captions import plain, plain_setting, tex, tex_setting
from atlas.pictures.sample import flat, room

ROW = "its map"
SEEN = r"Round a stable motion $\Omega_3$ and its rate follow closed curves."
Window: TypeAlias = tuple[tuple[float, float], tuple[float, float]]

WIDTH, HEIGHT, MARGIN = 110.0, 84.0, 13.0
RANGES = {"levels": (1, 40)}


def scene(
    *,
    ratio: Any = 0.5,
    field: tuple[float, float] = (1.0, 0.1),
    omega2: float = -0.5,
    levels: int = 4,
    unit: str = "time",
) -> Scene:
    """Draw the portrait of the momenta of ``omega2``, with ``levels`` closed curves about each equilibrium.

    ``ratio`` is I3/I2 or a body; ``field`` is (B2, B3) of B', ``omega2`` that of an elementary motion, in 1/time;
    ``unit`` is the word for the unit of time. Raises DomainError where B2 or B3 is 0.
    """
    if not all(field):
        raise DomainError(f"figure phase_portrait needs both components of the field, not field = {field}.")
    top = Top(ratio, field, omega2)
    stable = [nu for nu, is_stable in top.equilibria if is_stable]
    saddles = [nu for nu, is_stable in top.equilibria if not is_stable]
    energies = top.energies(levels)
    outlines = np.concatenate([line for energy in energies for line in top.orbits(*energy)])
    high = 1.1 * float(np.abs(outlines[:, 1]).max())
    view = room(outlines[:, 0], 0.06), (-high, high)
    layers: list[Layer] = [Curve(np.array([[view[0][0], 0.0], [view[0][1], 0.0]]), "guide")]
    layers += [Curve(line, "component") for energy in energies for line in top.orbits(*energy, view)]
    layers += [Curve(line, "unstable") for nu in saddles for line in top.orbits(top.V(nu), 0.0, view)]
    layers += [Points(np.array([[top.omega3(nu), 0.0]]), "start") for nu in stable]
    layers += [Points(np.array([[top.omega3(nu), 0.0]]), "unstable_point") for nu in saddles]
    layers += [
        Label(np.array([top.omega3(nu), 0.0]), name, "label", (0.0, 9.0))
        for nu, name in [*((nu, "stable") for nu in stable), *((nu, "unstable") for nu in saddles)]
    ]
    eight = (
        r"The unstable one is a saddle: its separatrix (heavy line) "
        r"surrounds both stable ones. "
        if saddles
        else "Here there is one, and it is stable. "
    )
    return Scene(
        caption=(
            rf"$\Omega_3$ and its rate for {tex_setting(ratio, field)}, for all motions with the momenta "
            rf"of the elementary one $\omega_2={tex(omega2)}$, one curve for each energy. {eight}"
        ),
        alt=(
            f"Closed curves in the plane of Omega 3 and its rate, for {plain_setting(ratio, field)} with the momenta "
            f"of omega 2 = {plain(omega2)}: {len(stable)} stable and {len(saddles)} unstable equilibria"
            + (", with a figure of eight through the latter." if saddles else ".")
        ),
        panels=(
            Plane(
                tuple(layers),
                rf"$\Omega_3$ (1/{unit})",
                rf"$\dot\Omega_3$ (1/{unit}$^2$)",
                *view,
            ),
        ),
        named={"heavy": "unstable"},
        size=(WIDTH, HEIGHT),
    )


class Top:
    """The reduced motion of nu = cos(theta), theorem-top, with the momenta of one elementary motion.

    Made from I3/I2 or a body, (B2, B3) and omega2. `I` is I3/I2, `b` the field's length, `c3` = Omega3 + b nu, `M3`
    and `p` are the momenta along the axis and the field over I2, `A` = (I - 1) b^2.
    """

    def __init__(self, ratio: Any, field: tuple[float, float], omega2: float) -> None:
        self.I, _, _ = shape_factors(ratio)
        self.b = float(np.hypot(*field))
        omega3 = float(Hyperbola(ratio, field).omega3(omega2))
        self.c3 = omega3 + field[1]
        conserved = momentum_map(ratio, (0.0, omega2, omega3), (0.0, *field))
        self.M3, self.p = float(conserved.M3), float(conserved.p)
        self.A = (self.I - 1.0) * self.b**2

    def V(self, nu: float) -> float:
        """Effective potential of the nutation at nu = cos(theta), in 1/time^2: the energy of an equilibrium there."""
        return float(potential(self.I, self.b, self.M3, self.p, nu))

    def omega3(self, nu: Any) -> Any:
        """Return Omega3 = c3 - b nu, in rad/time, at nu = cos(theta): a number for a number, else an array."""
        return self.c3 - self.b * nu

    @property
    def equilibria(self) -> list[tuple[float, bool]]:
        """The roots of V'(nu) in (-1, 1), ascending, as pairs (nu, whether V has a minimum there)."""
        nu, sine_squared = Polynomial([0, 1]), Polynomial([1, 0, -1])
        slope = self.A * nu * sine_squared**2 + (self.p - self.M3 * nu) * (self.p * nu - self.M3)
        roots = slope.roots()
        real = np.sort(roots[(np.abs(roots.imag) < 1e-9) & (np.abs(roots.real) < 1)].real)
        return [(float(x), bool(slope.deriv()(x) > 0)) for x in real]

    def energies(self, levels: int) -> list[tuple[float, float]]:
        """Return pairs (energy h, cosine of the equilibrium that its curve goes round, 0 if it is all of them).

        Below the highest equilibrium there are ``levels`` curves about each stable one, above it as many about all.
        Energies are in 1/time^2.
        """
        values = [(self.V(nu), nu) for nu, _ in self.equilibria]
        (low, _), (top, _) = min(values), max(values)
        steps = (np.arange(1, levels + 1) / (levels + 1)) ** 2
        depth = top - low if len(values) > 1 else 0.2 * (abs(top) + self.b**2)
        inside = [(h + share * (top - h), nu) for h, nu in values if h < top for share in steps]
        return [*inside, *((top + depth * share, 0.0) for share in steps)]

    def orbits(self, h: float, centre: float, view: Window | None = None) -> list[FloatArray]:
        """Return the closed curves (N, 2) of the energy h that go round the cosine `centre`, or for 0 all of them.

        The columns are Omega3 and its time derivative. ``view`` has the panel's limits ((low, high) in x, in y), to
        which the curves are sampled; without it they are coarse.
        """
        nu, sine_squared = Polynomial([0, 1]), Polynomial([1, 0, -1])
        Q = sine_squared * (h - self.M3**2 / self.I - self.b**2 - self.A * nu**2) - (self.p - self.M3 * nu) ** 2
        roots = Q.roots()
        real = np.sort(roots[(np.abs(roots.imag) < 1e-6) & (np.abs(roots.real) <= 1)].real)
        orbits = []
        for low, high in pairwise(real):
            if Q((low + high) / 2) <= 0 or high - low < 1e-9 or (centre and not low < centre < high):
                continue
            cofactor = Q // Polynomial([-low * high, low + high, -1])

            def point(
                s: FloatArray, low: float = low, high: float = high, cofactor: Polynomial = cofactor
            ) -> FloatArray:
                nu = (low + high) / 2 + (high - low) / 2 * np.sin(s)
                rate = (high - low) / 2 * np.cos(s) * np.sqrt(np.maximum(cofactor(nu), 0.0))
                return np.stack([self.omega3(nu), -self.b * rate], axis=1)

            turn = 2 * np.pi
            orbits.append(
                flat(point, 0.0, turn, view, (WIDTH - MARGIN, HEIGHT - MARGIN), pieces=32)
                if view
                else point(np.linspace(0.0, turn, 201))
            )
        return orbits
