"""Motions of a body with three moments that are simpler: a turn about a principal axis, and two equal moments."""

from typing import Any

from flint import fmpq

from atlas.exact.inputs import Real, rational, sin_cos
from atlas.exact.motions.general import GeneralMotion
from atlas.exact.nutation.nutating import turn


class Spin:
    """A turn about a principal axis that stays along the field, or without one."""

    def __init__(self, omega: tuple[fmpq, ...], field: tuple[fmpq, ...]) -> None:
        self.omega, self.field = omega, field

    def rotation(self, t: Any) -> list[list[Real]]:
        """Return R(t) as rows."""
        last = next((i for i in range(3) if self.omega[i] != 0), 2)
        s, c = sin_cos(self.omega[last] * rational(t, "the time"))
        return turn([fmpq(int(i == last)) for i in range(3)], c, s)

    def angular_velocity(self, t: Any) -> list[Real]:
        """Return Omega, which is constant."""
        del t
        return list(self.omega)

    def field_in_body(self, t: Any) -> list[Real]:
        """Return K, which is constant."""
        del t
        return list(self.field)


class Symmetric:
    """The motion of a body with two equal moments, whatever the order of its axes."""

    def __init__(self, moments: tuple[fmpq, ...], Omega: tuple[fmpq, ...], K: tuple[fmpq, ...]) -> None:
        last = next(i for i in range(3) if moments[i - 1] == moments[i - 2])
        self._places = (last - 2) % 3, (last - 1) % 3, last
        spin, field = ([x[i] for i in self._places] for x in (Omega, K))
        self.exact = GeneralMotion.at_state(moments[last] / moments[last - 1], spin, field)

    def rotation(self, t: Any) -> list[list[Real]]:
        """Return R(t) as rows."""
        R, back = self.exact.rotation(t), [self._places.index(i) for i in range(3)]
        return [[R[i][j] for j in back] for i in back]

    def angular_velocity(self, t: Any) -> list[Real]:
        """Return Omega(t) in the body."""
        Omega = self.exact.angular_velocity(t)
        return [Omega[self._places.index(i)] for i in range(3)]

    def field_in_body(self, t: Any) -> list[Real]:
        """Return K(t) = R^T B'."""
        K = self.exact.field_in_body(t)
        return [K[self._places.index(i)] for i in range(3)]
