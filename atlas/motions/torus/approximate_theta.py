"""Clebsch's motion on its torus by theta functions of two variables: their constants, approximate to many digits.

With zeta = X^-1 (t, g), t and g the times of the flows of H and F/2 from an origin where M_i = K_i = 0 for one i,

    K_j, M_j = (n0 theta[0,e_j; 0,d_j] + n1 theta[1,e_j; 0,d_j]) / (d0 theta[0,e_0; 0,d_0] + d1 theta[1,e_0; 0,d_0]),
    N = S^T (e_x + i e_y) = exp(i l zeta) (the same form at zeta - w) / (the same denominator),

e_x, e_y and B' being a right-handed system and the argument (2 zeta_1, zeta_2) with [[2 tau11, tau12], [tau12,
tau22/2]]: one pair of characteristics for the denominator and one for each axis. Origins are algebraic; the constants
follow by a linear fit to Taylor's series there, and the place of the start by Newton's method. That the functions are
of that form rests on a count of dimensions; that they are the motion at hand is proved by
`atlas.motions.torus.certified_distances`.
"""

from collections.abc import Iterator, Sequence
from itertools import combinations, permutations, product

import numpy as np
from flint import acb, acb_mat, arb, fmpq

from atlas.arithmetic.numbers import cross, dot, workprec
from atlas.errors import NotCertifiedError
from atlas.motions.torus.approximate_lattice import Lattice
from atlas.motions.torus.approximate_origins import State, Vector, around, fields, origins
from atlas.motions.torus.approximate_periods import BITS, Integrals, centre, complex_of, matrix_of
from atlas.motions.torus.approximate_theta_sums import CHARACTERISTICS, Array, Form, Sums

GRIDS, CANDIDATES = (16, 48), 24
"""Points along each real period among which the start is looked for, a few first; and those of them that are tried."""

NEWTON_STEPS = 12
"""Steps of Newton's method."""

MAX_RESIDUAL = 1e-18
"""Largest residual of a fit, beside its values."""

ComplexPair = tuple[acb, acb]


class ThetaMotion:
    """Theta functions of one motion: the forms `denominator`, `K`, `M` and `N`, and `start`, zeta at t = 0; not proved.

    ``motion`` are its integrals, ``W`` = Omega + K and ``K`` its state at t = 0 in the body, ``lattice`` its
    periods. `l` and `w` are the quasi-periods of N, `misfit` the largest relative residual of the fits. If a
    ``neighbour`` is given, the origin and the start nearest to its own are taken. Raises NotCertifiedError where
    they are not found.
    """

    def __init__(
        self,
        motion: Integrals,
        W: Sequence[fmpq],
        K: Sequence[fmpq],
        lattice: Lattice,
        neighbour: "ThetaMotion | None" = None,
    ) -> None:
        self.motion, self.field, self.lattice = motion, K, lattice
        self.misfit = 0.0  # the largest residual of a fit, beside its values
        with workprec(BITS):
            self.X, self.tau = lattice.X, lattice.tau
            t = self.tau
            self.hat = acb_mat([[2 * t[0, 0], t[0, 1]], [t[0, 1], t[1, 1] / 2]])
            self.origin: tuple[int, State] = (
                origins(motion)[0] if neighbour is None else _nearest_origin(neighbour.origin, origins(motion))
            )
            self.denominator, self.K, self.M = self._fitted()
            e = frame(K)
            N = [acb(x, y) for x, y in zip(*e, strict=True)]
            M = [acb(I * w) for I, w in zip(motion.moments, W, strict=True)]
            self.at_start = State(M, [acb(x) for x in K], N)
            self.start = self._place() if neighbour is None else self._improved(neighbour.times, reduced=False)
            self.l, self.w = self._quasi_periods()
            self.N = self._forms_of_N()

    @property
    def forms(self) -> list[Form]:
        """List of ten `Form` in (2 zeta_1, zeta_2): N without exp(i l (zeta - start)), the denominator, K and M.

        Vectors have three forms each, in the order N, denominator, K, M.
        """
        shift = 2 * self.w[0], self.w[1]
        N = [Form(x.place, x.weights, shift) for x in self.N]
        return [*N, self.denominator, *self.K, *self.M]

    def zeta(self, T: Sequence[acb]) -> Vector:
        """Return the arguments zeta = X^-1 T of the theta functions, two complex balls, from the times T = (T_H, T_F).

        T counts from the origin.
        """
        zeta = self.X.solve(acb_mat([[T[0]], [T[1]]]))
        return [centre(zeta[0, 0]), centre(zeta[1, 0])]

    def pairs(self, zeta: Sequence[acb]) -> list[ComplexPair]:
        """Return the pairs (theta[0,e;0,d], theta[1,e;0,d]) at zeta for each (e, d) of CHARACTERISTICS.

        They are complex balls.
        """
        theta = self.hat.theta(acb_mat([[2 * zeta[0]], [zeta[1]]]))
        return [(theta[0, 4 * e + d], theta[0, 8 + 4 * e + d]) for e, d in CHARACTERISTICS]

    def state(self, zeta: Sequence[acb]) -> State:
        """Return the `State` at a point zeta of the complex torus: vectors M and K, three complex components each.

        Components are midpoints of balls: no bound on their error is kept. N is the empty list.
        """
        pairs = self.pairs(zeta)
        D = self.denominator.value(pairs)
        M, K = ([centre(form.value(pairs) / D) for form in forms] for forms in (self.M, self.K))
        return State(M, K, [])

    def _fitted(self) -> tuple[Form, list[Form], list[Form]]:
        """Return (`Form` of the denominator, three of K, three of M), fitted to states near the origin."""
        axis, origin = self.origin
        points = around(self.motion.moments, origin)
        pairs = [self.pairs(self.zeta((t, acb(0)))) for t, _ in points]
        j = (axis + 1) % 3
        tried = list[tuple[float, Form]]()
        for place, axis_place in permutations(range(3), 2):
            rows = [
                [state.K[j] * p[place][0], state.K[j] * p[place][1], -p[axis_place][0], -p[axis_place][1]]
                for p, (_, state) in zip(pairs, points, strict=True)
            ]
            null, error = _null(rows)
            tried.append((error, Form(place, (null[0], null[1]))))
        error, denominator = min(tried, key=lambda x: x[0])
        D = [denominator.value(p) for p in pairs]
        free_places = [n for n in range(3) if n != denominator.place]
        rows = [[x * d for x in state.components] for (_, state), d in zip(points, D, strict=True)]
        places = [(3,) if i % 3 == axis else free_places for i in range(6)]
        forms = [
            self._form(pairs, list(column), neighbour)
            for column, neighbour in zip(zip(*rows, strict=True), places, strict=True)
        ]
        return denominator, forms[3:], forms[:3]

    def _form(self, pairs: list[list[ComplexPair]], values: Vector, places: Sequence[int]) -> Form:
        """Return the `Form`, of a place among ``places``, whose values fit ``values`` best.

        ``pairs`` are the theta functions at the same points, see `pairs`. Raises NotCertifiedError for a residual above
        `MAX_RESIDUAL`.
        """
        tried = list[tuple[float, Form]]()
        for place in places:
            weights, error = _least_squares([list(p[place]) for p in pairs], values)
            tried.append((error, Form(place, (weights[0], weights[1]))))
        error, form = min(tried, key=lambda x: x[0])
        if not error < MAX_RESIDUAL:
            raise NotCertifiedError(f"not certified: theta functions do not fit the motion, by {error:.1g}.")
        self.misfit = max(self.misfit, error)
        return form

    def _place(self) -> Vector:
        """Return zeta at the start, two complex balls, by Newton's method from the nearest points of a grid.

        Conjugation takes origins to origins, which are half a period apart: so the imaginary part of the times between
        them and the start is a fourth of that of a period. Raises NotCertifiedError where the start is not found.
        """
        target = np.array([complex_of(x) for x in self.at_start.components[:6]])
        real, others_ = (matrix_of(acb_mat(pair))[:, :2] for pair in (self.lattice.real, self.lattice.other_periods))
        rough, quarters = Rough(self), np.array(list(product(range(4), repeat=2)))[:, None] / 4
        for count in GRIDS:
            steps = np.array(list(product(range(count), repeat=2))) / count
            times = (steps @ real + quarters @ others_).reshape(-1, 2)
            distance = np.linalg.norm(rough.states(times) - target, axis=1)
            candidates = rough.times_near(times[np.argsort(distance)[:CANDIDATES]], target)
            if candidates is not None:
                return self._improved(candidates)
        raise NotCertifiedError("not certified: the place of the start on the motion's torus was not found.")

    @property
    def times(self) -> Array:
        """Complex times (T_H, T_F) from the origin to the start, shape (2,)."""
        return np.asarray(matrix_of(self.X) @ [complex_of(x) for x in self.start])

    def _improved(self, T: Array, *, reduced: bool = True) -> Vector:
        """Return zeta at the start, two complex numbers as balls of radius 0, by Newton's method from times T (2,).

        T is complex, near (T_H, T_F) from the origin to the start, where M and K must be those at t = 0. If `reduced`,
        an even period is subtracted, see `_near_real`. Raises NotCertifiedError where the method does not converge.
        """
        rates = fields(self.motion.moments, np.array([complex_of(x) for x in self.at_start.components[:6]]))
        i, j = max(combinations(range(6), 2), key=lambda p: abs(np.linalg.det(rates[list(p)])))
        start = self.at_start.components
        a, b, c, d = (acb(complex(rates[p, q])) for p, q in ((i, 0), (i, 1), (j, 0), (j, 1)))
        times = [acb(complex(x)) for x in T]
        before = np.inf
        for _ in range(NEWTON_STEPS):
            states = self.state(self.zeta(times)).components
            f, g = start[i] - states[i], start[j] - states[j]
            distance = abs(complex_of(f)) + abs(complex_of(g))
            if not distance < before:
                break
            before = distance
            times = [
                centre(times[0] + (f * d - g * b) / (a * d - b * c)),
                centre(times[1] + (g * a - f * c) / (a * d - b * c)),
            ]
        zeta = self._near_real(self.zeta(times)) if reduced else self.zeta(times)
        error = max(abs(complex_of(x - y)) for x, y in zip(self.state(zeta).components, start, strict=False))
        self.misfit = max(self.misfit, error)
        if not error < MAX_RESIDUAL:
            raise NotCertifiedError("not certified: Newton's method does not find the start on the motion's torus.")
        return zeta

    def _near_real(self, zeta: Vector) -> Vector:
        """Return zeta less the even period of `hat` that brings it nearest to real times: all forms get one factor."""
        Y = matrix_of(self.hat).imag
        v = [2 * zeta[0], zeta[1]]
        m, n = (2 * round(float(x) / 2) for x in np.linalg.solve(Y, [complex_of(x).imag for x in v]))
        first_component, second = (v[k] - m * self.hat[0, k] - n * self.hat[1, k] for k in range(2))
        return [centre(first_component / 2), centre(second)]

    def _quasi_periods(self) -> tuple[Vector, Vector]:
        """Return the characteristics (l, w) of N, two complex balls each.

        Under a period N gets the factor exp(-i b T_c), and l and w are determined up to whole turns.
        """
        b = arb(self.motion.square).sqrt()
        angles = [-b * T[2] for T in (*self.lattice.a, *self.lattice.b)]
        tau, Y = self.tau, matrix_of(self.tau).imag
        # w = (angle_b - tau l)/(4 pi), and l may change by (2 pi m, pi n)
        l = [angles[0], angles[1] / 2]
        w = [(angles[2 + k] - l[0] * tau[0, k] - l[1] * tau[1, k]) / (4 * arb.pi()) for k in range(2)]
        m, n = (round(float(x)) for x in np.linalg.solve(Y * np.array([1 / 2, 1 / 4]), [complex_of(x).imag for x in w]))
        l = [centre(l[0] + 2 * arb.pi() * m), centre(l[1] + arb.pi() * n)]
        w = [centre((angles[2 + k] - l[0] * tau[0, k] - l[1] * tau[1, k]) / (4 * arb.pi())) for k in range(2)]
        return l, w

    def _forms_of_N(self) -> list[Form]:
        """Return the three `Form` numerators of N, component by component.

        N is these over the denominator, times exp(i l (zeta - start)).
        """
        points = around(self.motion.moments, self.at_start)
        shifted, factors = list[list[ComplexPair]](), Vector()
        for t, _ in points:
            way = self.zeta((t, acb(0)))
            zeta = [x + y for x, y in zip(way, self.start, strict=True)]
            shifted.append(self.pairs([x - y for x, y in zip(zeta, self.w, strict=True)]))
            factors.append(self.denominator.value(self.pairs(zeta)) / (acb(0, 1) * dot(self.l, way)).exp())
        return [
            self._form(shifted, [s.N[j] * x for (_, s), x in zip(points, factors, strict=True)], range(4))
            for j in range(3)
        ]


def _nearest_origin(reference: tuple[int, State], states: Sequence[tuple[int, State]]) -> tuple[int, State]:
    """Return the pair (axis, `State`) nearest to ``reference``, among ``states`` and their changes of sign.

    Only states with the axis of the reference count.
    """
    axis, state = reference

    def images(states: State) -> Iterator[State]:
        for signs in product((1, -1), repeat=3):
            M, K = ([n * x for n, x in zip(signs, v, strict=True)] for v in (states.M, states.K))
            yield State(M, K, [])

    def distance(image: State) -> float:
        return sum(abs(complex_of(x - y)) ** 2 for x, y in zip(image.components, state.components, strict=True))

    return axis, min((x for i, candidate in states if i == axis for x in images(candidate)), key=distance)


class Rough:
    """M and K of ``motion``, a `ThetaMotion`, from its theta functions in doubles, at arrays of complex times."""

    def __init__(self, motion: ThetaMotion) -> None:
        self.moments = motion.motion.moments
        self.hat: Array = matrix_of(motion.hat)
        self.inverse, self.to_arguments = np.linalg.inv(self.hat.imag), np.linalg.inv(matrix_of(motion.X)) * [[2], [1]]
        cell = np.array([[x, y] for x in (-1, 0, 1) for y in (-1, 0, 1)])
        forms = [motion.denominator, *motion.M, *motion.K]
        region = np.asarray(1j * np.pi * (cell @ self.hat.imag).T, complex)
        self.sums = Sums(motion.hat, forms, (acb(0), acb(0)), region)

    def states(self, times: Array) -> Array:
        """Return M and K at pairs of complex times (T_H, T_F), (m, 2), from the origin: complex, shape (m, 6).

        They are not finite where theta functions overflow.
        """
        v = times @ self.to_arguments.T
        # less an even period of hat, which changes all forms by one factor, v has a small imaginary part
        v = v - (2 * np.round(v.imag @ self.inverse / 2)) @ self.hat
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # such places are no start
            D, *values = self.sums.at(np.pi * v.T, np.zeros_like(v.T), slice(0, 7))
            return np.asarray((np.array(values) / D).T)

    def times_near(self, times: Array, target: Array) -> Array | None:
        """Return the complex times (2,) of the `target` state (6,), by Newton's method from several starts (m, 2).

        None if all starts fail.
        """
        size, before = float(np.linalg.norm(target)), np.inf
        for _ in range(NEWTON_STEPS):
            states = self.states(times)
            distance = np.linalg.norm(states - target, axis=1)
            if distance.min(initial=np.inf) < 1e-9 * size:
                return np.asarray(times[distance.argmin()])
            converging = distance < 4 * before
            times, states, before = times[converging], states[converging], distance[converging]
            ways = np.linalg.pinv(fields(self.moments, states)) @ (target - states)[..., None]
            times = times + ways[..., 0]
        return None


def frame(K: Sequence[fmpq]) -> tuple[Vector, Vector]:
    """Return unit vectors e_x and e_y, three balls each, that form a right-handed system with K/|K|."""
    size = arb(dot(K, K)).sqrt()
    n = [x / size for x in K]
    least = min(range(3), key=lambda i: abs(float(n[i].mid())))
    e = [arb(int(i == least)) for i in range(3)]
    x = cross(n, e)
    length = dot(x, x).sqrt()
    ex = [a / length for a in x]
    return ex, list(cross(n, ex))


def _least_squares(rows: list[Vector], values: Vector) -> tuple[Vector, float]:
    """Return (least-squares solution x of rows x = values, a list; largest residual over the largest value)."""
    A, B = acb_mat(rows), acb_mat([[x] for x in values])
    adjoint = A.transpose().conjugate()
    solution = (adjoint * A).solve(adjoint * B)
    residual = A * solution - B
    size = max(abs(x).mid() for x in values) or arb(1)  # they may be too small for a float
    error = max(abs(residual[i, 0]).mid() for i in range(A.nrows())) / size
    return [centre(solution[i, 0]) for i in range(A.ncols())], float(error.mid())


def _null(rows: list[Vector]) -> tuple[Vector, float]:
    """Return (vector orthogonal to all rows, residual) in the sense of least squares.

    Component 0 or 1 of the vector, whichever fits better, is 1; the residual is over the largest value.
    """
    vectors = list[tuple[float, Vector]]()
    for k in range(2):
        columns = [n for n in range(len(rows[0])) if n != k]
        solution, error = _least_squares([[row[n] for n in columns] for row in rows], [-row[k] for row in rows])
        solution.insert(k, acb(1))
        vectors.append((error, solution))
    error, vector = min(vectors, key=lambda x: x[0])
    return vector, error
