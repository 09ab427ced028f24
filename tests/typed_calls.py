"""Calls that a user may type: mypy accepts those of `accepted_calls`, and refuses every line of `refused_calls`."""

from fractions import Fraction

import numpy as np
from scipy.spatial.transform import Rotation

import atlas


def use(*results: object) -> None:
    """Take results, which have to be right."""


def accepted_calls() -> None:
    """Numbers, arrays, fractions, bodies and fields."""
    body = atlas.SymmetricBody(2.0, [2.5, 3.0])
    ring = atlas.SymmetricBody.ring(mass=1, radius=np.linspace(1.0, 2.0, 5))
    field = atlas.Field(B=(0.0, 0.3, 1), mu=Fraction(1, 3))
    elementary = atlas.ElementaryMotion(1.5, (1.0, np.arange(3)), omega2=np.float32(0.7))
    atlas.ElementaryMotion(ring, field, omega2=Fraction(7, 10))
    atlas.ElementaryMotion(np.float64(1.5), np.array([1.0, 2.0]), 0.7, omega3=None)
    rotations: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = elementary.rotation([0.0, 1.0, 2])
    use(rotations.shape, float(elementary.k) + float(elementary.period), elementary.kind == "precession")
    moving = atlas.motion([[2, 0.1, 0], [0.1, 1.5, 0.2], [0, 0.2, 1]], field, (0.1, 0.2, 3.0), Rotation.identity())
    use(moving.spectrum("axis", least=0.1).names, moving.actions.values.sum(), moving.column(3, np.arange(4)))
    use(moving.sensitivity(1.0, ["omega1", "t"]), moving.sensitivity(1.0, "omega1", of="period"))
    top = atlas.TopMotion((1.0, 1.5), (0.1, 0.2), direction=(1, 2), omega=(0.3, 0.7, 0.2), linear=0.1)
    use(atlas.drift(top, [0.0, 1.0], drag=(0.1, 0.2)).action, body.ratio, body.mass_matrix[2])
    use(atlas.Hyperbola(body, (1.0, 2.0)).omega3(np.linspace(0.0, 1.0, 3)), atlas.Quadric(0.5, field).beta)
    times, rotation = np.arange(5.0), elementary.rotation(np.arange(5.0))
    fit = atlas.fit(times, "elementary", rotation=rotation, sigma=0.01, params={"ratio": 1.5}, loss="huber")
    use(fit.params.pretty_print, fit.motion.rotation(0.0), fit.predict(times))
    use(atlas.check(times, rotation, motion=moving).rows, atlas.ChargeMoments.shape("ring", 1.0, radius=2.0).J2)
    use(atlas.simulate((1.0, 1.0, 1.5), (0.0, 1.0, 2.0), (0.3, 0.7, 0.2), times, method="RK45").R)
    use(atlas.clebsch(body, (0.3, 0.7, 0.2), (0.0, 1.0, 2.0)).energy, elementary.trace(2.0, stop=3)[1])
    use(atlas.sweep("elementary", {"ratio": [0.5, 1.5], "B2": 1.0, "B3": 2.0, "omega2": 0.7}, ["k"])["k"])
    use(moving.plot(style="default").get_axes(), atlas.figure("hyperbola", ["default", {"font.size": 9}], ratio=1.5))


def refused_calls(motion: atlas.GeneralMotion) -> None:  # noqa: PLR0915  a list of calls
    """Text, None, other objects, unknown names, and results of a wrong type."""
    atlas.ElementaryMotion("oops", (1.0, 2.0), omega2=0.7)
    atlas.ElementaryMotion(1.5, None, omega2=0.7)
    atlas.ElementaryMotion(1.5, (1.0, 2.0), omega2=object())
    atlas.ElementaryMotion(1.5, (1.0, "2.0"), omega2=0.7)
    atlas.ElementaryMotion(1.5, (1.0, 2.0), omega2={"value": 0.7})
    atlas.ElementaryMotion(1.5, (1.0, 2.0), omega2=0.7, omega4=0.1)
    atlas.GeneralMotion(1.5, (1.0, 2.0), 1 + 2j)
    atlas.SymmetricBody("2.0", 3.0)
    atlas.SymmetricBody.sphere(1.0, ["2.0"])
    atlas.SymmetricBody.from_point_masses({1.0, 2.0}, [[0, 0, 1], [0, 0, 2]])
    atlas.Field(B="north")
    atlas.Field(B=(0.0, 0.3, 1.0)).frame(None)
    atlas.motion(1.5, (0.0, 1.0, 2.0), b"123")
    atlas.motion(1.5, (0.0, 1.0, 2.0), (0.3, 0.7, 0.2), attitude="upright")
    motion.rotation("noon")
    motion.rotation(0.0, out=[[1.0]])
    motion.column(0, 1.0)
    motion.spectrum("momentum")
    motion.sensitivity(1.0, 3)
    motion.quaternion(0.0, scalar_first="yes")
    motion.trace(periods="two")
    use(motion.frequency)
    motion.period.upper()
    use(motion.actions.lines)
    atlas.TopMotion((1.0, 1.5), (0.1, 0.2), (1, 2), (0.3, 0.7, 0.2), linear=None)
    atlas.EllipticMotion((1.0, 2.0, 3.0), (1.0, 2.0, 3.0), z="1")
    atlas.BallMotion(1.0, None, (0.1, 0.2))
    atlas.ParticleMotion(1.0, (0, 0, 1), (0, 0, 1), (0, 0, 0), velocity="fast")
    atlas.Hyperbola(1.5, (1.0, 2.0)).stability("0.7")
    atlas.Quadric(1.5, 1.0 + 1j)
    atlas.ChargeMoments.shape("cube", 1.0, radius=2.0)
    atlas.ChargeMoments.points([1.0], None)
    atlas.drift(atlas.BallMotion(1.0, 1.0, (0.1, 0.2)), [0.0, 1.0])
    atlas.fit([0.0, 1.0], "general", rotation="matrices")
    atlas.fit([0.0, 1.0], "generic", rotation=np.eye(3))
    atlas.fit([0.0, 1.0], rotation=np.eye(3), loss="square")
    atlas.check([0.0, 1.0], np.eye(3), motion="mine")
    atlas.check([0.0, 1.0], np.eye(3))
    atlas.simulate((1.0, 1.0, 1.5), (0.0, 1.0, 2.0), (0.3, 0.7, 0.2), [0.0], method="Euler")
    atlas.clebsch((1.0, 2.0, 3.0), "Omega", (0.0, 1.0, 2.0))
    atlas.sweep("elementary", {"ratio": 1.5}, 5)
    atlas.fit([0.0, 1.0], "general", rotation=np.eye(3), params=[1.5])
    atlas.fit([0.0, 1.0], "general", signal=np.eye(3))
    use(atlas.fit([0.0, 1.0], rotation=np.eye(3)).doubts)
    atlas.check([0.0, 1.0], np.eye(3), motion=motion, threshold="six")
    atlas.sweep("elementary", {"ratio": "1.5"}, ["k"])
    atlas.sweep("elementary", {"ratio": 1.5}, ["k"], out=3)
    atlas.report("atlas", out=3)
    motion.euler_angles(0.0, 3)
    atlas.Hyperbola(1.5, (1.0, 2.0)).closed(1.5, 2)
    atlas.figure("hyperbola", target=5)
    atlas.plotter(3)
