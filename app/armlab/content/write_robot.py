"""Robots in the format of robot files; reading one gives the same arm."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.content.arithmetic import shortest, shortest_degrees
from armlab.content.robots import Expected, Robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_from_sequence
from armlab.kin.task import NAMED

EXACT = 1e-15
"""Largest error with which angles reproduce a rotation; otherwise its nine entries are written."""


def robot_toml(robot: Robot) -> str:
    """Return the text of a robot file; `parse_robot` reads the same arm from it.

    Lengths come back as the same floats; angles, which the file has in degrees, to a unit in the last place.

    Raises
    ------
    InputError
        The arm has a task without a name.
    """
    arm = robot.arm
    if arm.task.key not in NAMED:
        raise InputError(f"task: expected one with a name ({', '.join(NAMED)}), got {arm.task.title!r}")
    words = (("name", robot.name), ("family", robot.family), ("summary", robot.summary))
    also = [f"words = [{', '.join(map(_text, robot.words))}]"] if robot.words else []
    lines = [*(f"{key} = {_text(value)}" for key, value in words), *also, f'convention = "{arm.convention}"']
    lines += [f'task = "{arm.task.key}"', f"source = {_text(robot.source)}", "", "[camera]"]
    lines += [f"azimuth_deg = {shortest(robot.camera.azimuth_deg)}"]
    lines += [
        f"elevation_deg = {shortest(robot.camera.elevation_deg)}",
        f"distance = {shortest(robot.camera.distance)}",
    ]
    for name, T in (("base", arm.base), ("tool", arm.tool)):
        if not np.array_equal(T, np.eye(4)):
            lines += ["", f"[{name}]", *_pose(T)]
    for i in range(arm.n):
        lines += ["", "[[joints]]", *_joint(arm, i)]
    for name, q in robot.poses.items():
        lines += ["", "[[poses]]", f"name = {_text(name)}", _joint_values(arm, q)]
    for expected in robot.expected:
        lines += ["", "[[expected]]", *_expected(arm, expected)]
    return "\n".join(lines) + "\n"


def _joint(arm: Arm, i: int) -> Iterable[str]:
    row, (low, high) = arm.rows[i], arm.limits[i]
    yield f'type = "{row.kind}"'
    lengths = (("a", shortest(row.a)), ("d", shortest(row.d)))
    angles = (("alpha_deg", shortest_degrees(row.alpha)), ("theta_deg", shortest_degrees(row.theta)))
    yield from (f"{key} = {value}" for key, value in (lengths[0], angles[0], lengths[1], angles[1]) if value != "0")
    unit, written = ("deg", shortest_degrees) if row.revolute else ("m", shortest)
    yield f"limits_{unit} = [{written(float(low))}, {written(float(high))}]"
    for key, bound in (
        (f"speed_{unit}_s", arm.speed_limits[i]),
        (f"acceleration_{unit}_s2", arm.acceleration_limits[i]),
    ):
        if math.isfinite(bound):
            yield f"{key} = {written(float(bound))}"


def _pose(T: NDArray[np.float64]) -> Iterable[str]:
    """Yield position and rotation; the angles as roll, pitch, yaw with R = Rz(yaw) Ry(pitch) Rx(roll)."""
    yield f"position = {_numbers(T[:3, 3])}"
    written = [shortest_degrees(angle) for angle in roll_pitch_yaw(T[:3, :3])]
    R = rotation_from_sequence("xyz", np.radians([float(angle) for angle in written]), fixed=True)
    nearest = np.round(R)
    R = np.where(np.abs(R - nearest) < 1e-12, nearest, R)  # as the reader does
    if np.abs(R - T[:3, :3]).max() > EXACT:
        yield f"rotation = [{', '.join(_numbers(row) for row in T[:3, :3])}]"
    elif written != ["0", "0", "0"]:
        yield f"rpy_deg = [{', '.join(written)}]"


def roll_pitch_yaw(R: NDArray[np.float64]) -> tuple[float, float, float]:
    """Return the three angles, radians; roll is computed last, so that they also fit at pitch = ±90 degrees."""
    yaw = math.atan2(R[1, 0], R[0, 0])
    pitch = math.atan2(-R[2, 0], math.hypot(R[0, 0], R[1, 0]))
    s, c = math.sin(yaw), math.cos(yaw)
    roll = math.atan2(s * R[0, 2] - c * R[1, 2], c * R[1, 1] - s * R[0, 1])
    return roll, pitch, yaw


def _expected(arm: Arm, expected: Expected) -> Iterable[str]:
    if expected.flange:
        yield 'of = "flange"'
    yield _joint_values(arm, expected.q)
    yield f"position = {_numbers(expected.T[:3, 3])}"
    if np.isfinite(expected.T[:3, :3]).all():
        yield f"rotation = [{', '.join(_numbers(row) for row in expected.T[:3, :3])}]"
    yield f"tolerance = {shortest(expected.tolerance)}"
    yield f"source = {_text(expected.source)}"


def _joint_values(arm: Arm, q: NDArray[np.float64]) -> str:
    kinds = set(arm.revolute.tolist())
    key = "q_deg_m" if len(kinds) == 2 else "q_deg" if True in kinds else "q_m"
    values = [
        shortest_degrees(float(value)) if turns else shortest(float(value))
        for value, turns in zip(q, arm.revolute, strict=True)
    ]
    return f"{key} = [{', '.join(values)}]"


def _numbers(values: Sequence[float] | NDArray[np.float64]) -> str:
    return f"[{', '.join(shortest(float(value)) for value in values)}]"


def _text(text: str) -> str:
    """Return a basic string of TOML; it is escaped as in JSON, with DEL escaped as well."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
