"""The methods of a record in words, in the order of the tables, and the role that each plays in a figure."""

TITLES = {
    "ours": "atlas",
    "ours_grid": "atlas, grid",
    "alone": "atlas, one by one",
    "plain": "plain NumPy",
    "lambdify": "sympy lambdify",
    "rotation": "SciPy Rotation",
    "ours_out": "atlas, out=",
    "ours_out_far": "atlas, out=, far",
    "grid": "atlas, grid",
    "grid_out": "atlas, grid, out=",
    "even_out": "atlas, times of the grid, out=",
    "third_axis": "atlas, third axis alone",
    "omega": "atlas, Omega alone",
    "plain_out": "plain NumPy, out=",
    "plain_out_far": "plain NumPy, out=, far",
    "fill": "filling the memory",
}

CASES = {
    "elementary": "elementary motion",
    "general": "general motion",
    "ball": "charged ball",
    "particle": "charged particle",
    "heavy": "heavy top",
    "asymmetric": "three moments",
}

SCALARS, SURFACE, MATRIX = "omega3, k, phi of a curve", "quadric with its axes", "R at one time of each motion"
NUTATION, TURNED = "period, angles, moduli of each general motion", "R at one time of each general motion"
ANY, EVEN = "R of the general motion at any times", "R of the general motion on a grid"
"""Quantities of many rows, and of many matrices of one motion."""

LINES = {
    "ours": "main",
    "ours_out": "main",
    "ours_grid": "seventh",
    "grid_out": "seventh",
    "plain": "second",
    "plain_out": "second",
    "lambdify": "third",
    "rotation": "sixth",
    "RK45": "pole",
    "DOP853": "fifth",
    "LSODA": "eighth",
    "Radau": "reference",
    "heyoka": "fourth",
    "fill": "limit",
    "ours_out/2": "fourth",
    "grid_out/2": "fifth",
}

OURS = ("ours", "ours_grid", "ours_out", "ours_out_far", "grid", "grid_out", "even_out", "third_axis")


def title(method: str) -> str:
    """Return the name of a method in words; one that is not known keeps its own."""
    return TITLES.get(method, method)


def case_title(case: str) -> str:
    """Return the name of a case in words."""
    return CASES.get(case, case)
