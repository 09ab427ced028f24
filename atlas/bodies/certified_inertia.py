"""Principal moments and axes of a symmetric matrix of rational numbers, as balls."""

from typing import Any

from flint import arb, fmpq_mat, fmpq_poly

from atlas.arithmetic.numbers import cross, dot


def principal_axes(matrix: Any) -> tuple[list[Any], list[list[Any]]]:
    """Return (values, axes) of a symmetric matrix as lists of balls: three principal values, ascending, three rows.

    The matrix is three rows of three rationals (`fmpq`), and no multiple of the unit matrix. The rows are the principal
    axes, in the order of the values, and a rotation.
    """

    def unit(v: Any) -> list[arb]:
        return [x / dot(v, v).sqrt() for x in v]

    (a, d, e), (d2, b, f), (e2, f2, c) = matrix
    d, e, f = (d + d2) / 2, (e + e2) / 2, (f + f2) / 2
    of_pairs = a * b + a * c + b * c - d * d - e * e - f * f
    determinant = fmpq_mat([[a, d, e], [d, b, f], [e, f, c]]).det()
    roots = fmpq_poly([-determinant, of_pairs, -(a + b + c), 1]).complex_roots()
    values = sorted(((x.real, n) for x, n in roots), key=lambda root: float(root[0].mid()))
    simple = list[list[arb]]()
    for value in (value for value, count in values if count == 1):
        rows = [[a - value, arb(d), arb(e)], [arb(d), b - value, arb(f)], [arb(e), arb(f), c - value]]
        axis = unit(max((cross(rows[i], rows[i - 1]) for i in range(3)), key=lambda v: float(dot(v, v).mid())))
        simple.append([-x for x in axis] if max(axis, key=lambda x: abs(float(x.mid()))) < 0 else axis)
    moments = [x for x, n in values for _ in range(n)]
    if len(simple) == 3:
        row1, row2, row3 = simple
        return moments, [row1, row2, row3 if dot(cross(row1, row2), row3) > 0 else [-x for x in row3]]
    (axis,) = simple
    least = min(range(3), key=lambda i: abs(float(axis[i].mid())))
    row2 = unit(cross(axis, [arb(i == least) for i in range(3)]))
    frame = [list(cross(row2, axis)), row2, axis]
    return moments, frame if values[0][1] == 2 else [axis, *frame[:2]]
