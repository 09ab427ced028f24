"""Judges of the quadric and of the hyperbola."""

from itertools import chain

import numpy as np

from atlas.core.hyperbola import Hyperbola
from atlas.core.quadric import Quadric
from atlas.exact import hyperbola as exact_hyperbola
from atlas.exact import quadric as exact_quadric
from atlas.exact.digits import enclosed
from atlas.study import hostile
from atlas.study.judging import BITS, described, exact_ratio, judging, ratio_of, with_more
from atlas.study.ulps import Tally, own

POINTS = 8
"""Points of each hyperbola."""


def judge_hyperbola(motion: hostile.Motion, regime: str, tally: Tally) -> None:
    """Judge the hyperbola at the motion's omega2: ordinate, frequencies, stability."""
    inputs = described(motion)
    if motion.omega2 == -motion.B2 or motion.B2 == 0:
        return
    with judging(tally, "hyperbola", regime, inputs):
        exact = exact_hyperbola.Hyperbola(exact_ratio(motion), (motion.B2, motion.B3))
        found = Hyperbola(ratio_of(motion), (motion.B2, motion.B3))
        k, phi = found.frequencies(motion.omega2)
        true_k, true_phi = enclosed(lambda: exact.frequencies(motion.omega2), BITS)
        pairs = (
            ("omega3 of the hyperbola", found.omega3(motion.omega2), exact.omega3(motion.omega2)),
            ("k of the hyperbola", k, true_k),
            ("phi of the hyperbola", phi, true_phi),
            ("stability", found.stability(motion.omega2), exact.stability(motion.omega2)),
        )
        for name, value, true in pairs:
            tally.add(name, regime, own([value], [true]), with_more(inputs))
        if motion.B3:
            points = [(x, y) for x, y in zip(*found.sample(POINTS), strict=True) if np.isfinite(y)]
            errors = own((y for _, y in points), (exact.omega3(x) for x, _ in points))
            tally.add("points of the hyperbola", regime, errors, lambda i: inputs | {"at": float(points[i][0]).hex()})


def judge_quadric(motion: hostile.Motion, regime: str, tally: Tally) -> None:
    """Judge the quadric of the motion's body and field."""
    inputs = described(motion)
    with judging(tally, "quadric", regime, inputs):
        exact = exact_quadric.Quadric(exact_ratio(motion), (motion.B2, motion.B3))
        found = Quadric(ratio_of(motion), (motion.B2, motion.B3))
        pairs = (
            ("beta", [found.beta], lambda: [exact.beta]),
            ("a2", [found.a2], lambda: [exact.a2]),
            ("a3", [found.a3], lambda: [exact.a3]),
            ("semi-axes", found.semi_axes, lambda: exact.semi_axes),
            ("canonical axes", np.ravel(found.axes), lambda: list(chain(*exact.axes))),
        )
        for name, values, ball in pairs:
            tally.add(name, regime, own(values, enclosed(ball, BITS)), with_more(inputs))
