"""Live values: quantities of the arm for texts of lessons, as ``{{name}}``, and those that benches add."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.content.check import Words, signed
from armlab.content.live_value import LiveValue, always
from armlab.content.observation import Observation
from armlab.content.vocabulary import vocabularies, with_added
from armlab.kin.arm import Arm
from armlab.kin.length_power import POWERS, length_power
from armlab.kin.rotations import euler_zyx

SINGULAR = 1e-9
"""Singular values, relative to the largest, up to this count as zero."""

_DECIMALS = 4
_UPRIGHT = 1e-9
"""Largest deviation of the base's z axis from the world's, by component, with which the arm turns about z."""


def live_values(arm: Arm) -> dict[str, LiveValue]:
    """Return the live values of an arm, by name."""
    return {name: value for name, value in all_live_values(arm.n).items() if not value.missing(arm)}


def all_live_values(n: int) -> dict[str, LiveValue]:
    """Return all live values for n joints, including those that only some arms have."""
    joints = {f"q{i + 1}": _joint(i) for i in range(n)}
    points = {f"p{letter}": _coordinate(k) for k, letter in enumerate("xyz")}
    own = {**joints, **points, **_OTHERS}
    return with_added("live value", own, (each.live for each in vocabularies().values()))


def task_jacobian(observation: Observation) -> NDArray[np.float64]:
    """Return the rows of the Jacobian that the arm's task controls, in the axes of frame 0, shape (m, n).

    Rows of position are in metres, those of rotation have none; see `armlab.kin.task`.
    """
    arm = observation.arm
    turn = arm.base[:3, :3].T
    J = np.asarray(arm.jacobian(observation.q), dtype=np.float64)
    linear, angular = turn @ J[:3], turn @ J[3:]
    tool = turn @ observation.tool_pose[:3, :3]
    rotation = {"none": np.eye(3)[:0], "phi": np.eye(3)[2:], "approach": tool[:, :2].T, "full": np.eye(3)}
    return np.vstack([linear[arm.task.coordinates], rotation[arm.task.rotation] @ angular])


def _joint(i: int) -> LiveValue:
    def missing(arm: Arm) -> str:
        return "" if i < arm.n else f"the arm has {arm.n} joints"

    def text(observation: Observation, words: Words) -> str:
        value = float(observation.q[i])
        return words.angle(value) if observation.arm.revolute[i] else words.length(value)

    return LiveValue(missing, text)


def _coordinate(k: int) -> LiveValue:
    return LiveValue(always, lambda observation, words: words.length(float(observation.tool_pose[k, 3])))


def _angle(k: int) -> LiveValue:
    """Return yaw (0), pitch (1) or roll (2) of R = Rz(yaw) Ry(pitch) Rx(roll), notes 3.104-3.108."""
    return LiveValue(
        always, lambda observation, words: words.angle(float(euler_zyx(observation.tool_pose[:3, :3])[0][k]))
    )


def _not_planar(arm: Arm) -> str:
    upright = abs(arm.base[2, 2] - 1.0) < _UPRIGHT
    plane = arm.task.rotation == "phi" or (arm.task.rotation == "none" and arm.task.position in ("x", "y", "xy"))
    return "" if upright and plane else "it is for arms whose hand turns about the world's z axis only"


def _phi(observation: Observation, words: Words) -> str:
    x = observation.tool_pose[:2, 0]
    return words.angle(math.atan2(x[1], x[0]))


def _reach(observation: Observation, words: Words) -> str:
    return words.length(float(np.linalg.norm(observation.tool_pose[:3, 3] - observation.arm.base[:3, 3])))


def _manipulability(observation: Observation, words: Words) -> str:
    del words
    power = length_power(observation.arm)
    unit = "(mixed units)" if power is None else POWERS[power]
    return f"{signed(float(observation.arm.manipulability(observation.q)), _DECIMALS)} {unit}".rstrip()


def _not_square(arm: Arm) -> str:
    if arm.task.m == arm.n:
        return ""
    return f"its task has {arm.task.m} components and it has {arm.n} joints: the Jacobian is not square"


def _determinant(observation: Observation, words: Words) -> str:
    del words
    unit = POWERS[length_power(observation.arm) or 0]
    return f"{signed(float(np.linalg.det(task_jacobian(observation))), _DECIMALS)} {unit}".rstrip()


def _mixed(arm: Arm) -> str:
    """Return the reason why singular values would combine metres and radians; empty when they do not."""
    if not arm.task.position or (arm.task.rotation == "none" and bool(arm.revolute.all() or not arm.revolute.any())):
        return ""
    return "the entries of its Jacobian have different units, so that its singular values have none"


def _singular_values(observation: Observation) -> NDArray[np.float64]:
    values = np.linalg.svd(task_jacobian(observation), compute_uv=False)
    return np.asarray(values, dtype=np.float64)


def _smallest(observation: Observation, words: Words) -> str:
    del words
    arm = observation.arm
    unit = " m" if arm.task.position and arm.revolute.all() else ""
    return f"{signed(float(_singular_values(observation)[-1]), _DECIMALS)}{unit}"


def _condition(observation: Observation, words: Words) -> str:
    del words
    sigma = _singular_values(observation)
    return "∞" if sigma[-1] <= SINGULAR * sigma[0] else signed(float(sigma[0] / sigma[-1]), 2)


def _rank(observation: Observation, words: Words) -> str:
    """Return the rank, with lengths divided by the arm's length scale: it does not depend on units."""
    del words
    arm = observation.arm
    rows = np.where(np.arange(arm.task.m) < len(arm.task.position), 1.0 / arm.length_scale, 1.0)
    columns = np.where(arm.revolute, 1.0, arm.length_scale)
    sigma = np.linalg.svd(rows[:, None] * task_jacobian(observation) * columns, compute_uv=False)
    return str(int(np.sum(sigma > SINGULAR * max(float(sigma[0]), 1.0))))


_OTHERS = {
    "phi": LiveValue(_not_planar, _phi),
    "roll": _angle(2),
    "pitch": _angle(1),
    "yaw": _angle(0),
    "r": LiveValue(always, _reach),
    "w": LiveValue(always, _manipulability),
    "det J": LiveValue(_not_square, _determinant),
    "sigma_min": LiveValue(_mixed, _smallest),
    "condition": LiveValue(_mixed, _condition),
    "rank": LiveValue(always, _rank),
}
