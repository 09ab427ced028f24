"""Errors of five flight simulators on one free body.

NASA published the motion of a tumbling brick from several simulators, without a verdict. The closed form has one: the
difference of each trajectory from the exact motion.
"""

from collections.abc import Iterator

import numpy as np
from scipy.spatial.transform import Rotation

from atlas.motions.any_body import motion
from atlas.pictures import Curve, Plane, Scene
from atlas.pictures.layers import FloatArray
from atlas.places import folder

ROW = "three moments"
SEEN = "Of five flight simulators, two are right."
RECORDS = ("tumbling_brick.csv",)
INERTIA = (0.00189422, 0.006211019, 0.007194665)
"""Moments of inertia of the brick, in slug ft^2."""
START = (10.0, 20.0, 30.0)
"""Initial angular velocity along the axes of the body, in degrees per second."""
EARTH = 7.292115e-5
"""Angular velocity of the Earth, in rad/s."""
ROLES = ("main", "second", "third", "fourth", "fifth")


def scene() -> Scene:
    """Draw the errors of the angular velocity and of the attitude over time, a curve for each simulator."""
    error_tables = dict(errors())
    largest_errors = {name: error[:, 1:].max(axis=0) for name, error in error_tables.items()}
    exact_names = [name for name, (rate, _) in largest_errors.items() if rate < 1e-8]
    exact, other_rates = (
        " and ".join(exact_names),
        [rate for name, (rate, _) in largest_errors.items() if name not in exact_names],
    )
    return Scene(
        caption=(
            f"Simulators {exact} follow the closed form within $10^{{-8}}$ degrees. "
            "Error of each trajectory of NASA's tumbling brick, check-case 2: (a) of the angular velocity, "
            "(b) of the attitude, its angle to the exact one."
        ),
        alt=(
            "Two panels of errors over 30 seconds, on logarithmic scales, with a curve for each of five simulators. "
            f"Those of simulators {exact} stay near 1e-10 and 1e-9 degrees; those of the others lie up to "
            f"{min(other_rates):.0e} to {max(other_rates):.0e} degrees per second from the exact angular velocity."
        ),
        panels=tuple(
            Plane(
                tuple(
                    Curve(error[1:, [0, column]], role, f"simulator {name}")
                    for role, (name, error) in zip(ROLES, error_tables.items(), strict=True)
                ),
                "time (s)",
                label,
                x_limits=(0.0, 30.0),
                y_limits=(1e-11, 10.0),
                y_scale="log",
                title=title,
            )
            for column, label, title in (
                (1, "error (deg/s)", "(a) angular velocity"),
                (2, "error (deg)", "(b) attitude"),
            )
        ),
        columns=2,
        size=(178.0, 56.0),
    )


def errors() -> Iterator[tuple[str, FloatArray]]:
    """Yield (name, table) for each simulator; columns of the table (N, 3) are time in s and two errors.

    These are the error of Omega in deg/s and the angle of the error of R in deg, against the closed form of the
    free body.
    """
    lines = [
        line for line in (folder("reports") / "data" / RECORDS[0]).read_text("utf-8").splitlines() if line[0] != "#"
    ]
    table = np.array([line.split(",") for line in lines[1:]], dtype=float)
    exact = motion(INERTIA, (0.0, 0.0, 0.0), np.radians(START))
    for name in np.unique(table[:, 0]):
        t, rates, angles, longitude = np.split(table[table[:, 0] == name, 1:], [1, 4, 7], axis=1)
        rate = np.linalg.norm(rates - np.degrees(exact.angular_velocity(t[:, 0])), axis=1)
        local = Rotation.from_matrix([[0, 0, -1], [0, 1, 0], [1, 0, 0]]) * Rotation.from_euler("ZYX", angles, True)
        attitudes = (Rotation.from_euler("z", np.radians(longitude) + EARTH * t) * local).as_matrix()
        distance = np.linalg.norm(attitudes[:1] @ exact.rotation(t[:, 0]) - attitudes, axis=(1, 2)) / np.sqrt(8)
        yield f"{name:.0f}", np.column_stack([t[:, 0], rate, np.degrees(2 * np.arcsin(np.minimum(distance, 1.0)))])
