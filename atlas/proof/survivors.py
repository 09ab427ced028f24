"""Why some mutants survive: what they say is true as well, or it cannot be told apart from what is meant."""

_SYMMETRIC = "The indices of a symmetric matrix are exchanged, which changes nothing."
_CONSTANTS = "A constant of integration is arbitrary: its sign, a factor or a shift gives another one."

REASONS = {
    "1.6": _SYMMETRIC,
    "1.32": _SYMMETRIC,
    "1.38": _SYMMETRIC,
    "mf18": _SYMMETRIC,
    "mf19": _SYMMETRIC,
    "The.1": _SYMMETRIC,
    "Aff100": _SYMMETRIC,
    "mf22": _SYMMETRIC,
    "text-inertia-tensor": _SYMMETRIC,
    "mf30.0": "Every moment of a ball is the same number, so one may stand for another.",
    "mf36": "The first column of the matrix is multiplied by the first component of m(0), which is 0.",
    "text-mass-matrix": "g1 = g2, so one may stand for the other.",
    "text-quadric-origin": "At the origin all components of omega are 0, whatever multiplies them or exchanges them.",
    "text-beta-range": "A weaker bound, or a smaller turn within the same bounds, is true as well.",
    "mf64": "Any of the initial components is a constant.",
    "mf67": "At t = 0 the first component of K is 0, whatever multiplies it.",
    "mf85": _CONSTANTS,
    "mf93": "The first component of B' is 0, whatever multiplies it.",
    "mf2": _CONSTANTS,
    "mf9": _CONSTANTS,
    "text-first-two-terms": "The numerator is 0, whatever divides it.",
    "text-trochoid-constant": "With the factor put right the constant is 0, whatever multiplies it.",
    "text-potentials": "The vector potential doesn't change with time, so its rate is 0, whatever multiplies it.",
    "theorem-equatorial-field": "With B3 = 0 the component hat B2 is 1.",
}
