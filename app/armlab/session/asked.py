"""The part of a target that counts, all that an arm controls or less, and the error that is kept smaller."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.weights import Weights, checked_weights
from armlab.kin.rotations import rotation_about
from armlab.kin.task import Task

ASKS = {"": "Pose", "position": "Position", "approach": "Approach"}
"""Parts of a target that may count, by key; the first is all that the task of the arm controls."""

ASKED = {"position": "only the position is asked for", "approach": "only position and approach direction are asked for"}
"""Sentences on less than that, by key."""

FAVOURS = {"": "Both", "position": "Position", "orientation": "Orientation"}
"""Errors that may be kept smaller where the target cannot be reached, by key."""

MORE = 10.0
"""Weight of the favoured error, relative to the other: half a reach counts as much as 10 rad, or 0.1 rad."""


def asks_of(arm: Arm) -> dict[str, str]:
    """Return the parts of a target that may count for an arm, key to words: its task, and less of it."""
    task = arm.task
    fewer = {
        "position": bool(task.position) and task.rotation != "none",
        "approach": task.position == "xyz" and task.rotation == "full",
    }
    return {key: words for key, words in ASKS.items() if fewer.get(key, True)}


def asked_arm(arm: Arm, asks: str) -> Arm:
    """Return an arm with the task that is asked for; the arm itself for its own task, and where it has no less."""
    return _with_less(arm, asks) if asks and asks in asks_of(arm) else arm


@lru_cache(maxsize=32)
def _with_less(arm: Arm, asks: str) -> Arm:
    rotation = "approach" if asks == "approach" else "none"
    return replace(arm, task=Task(arm.task.position, rotation))  # type: ignore[arg-type]


def can_favour(arm: Arm) -> bool:
    """Return whether the task of an arm has both a position and an orientation."""
    return bool(arm.task.position) and arm.task.rotation != "none"


def weights_of(arm: Arm, favours: str) -> Weights | None:
    """Return weights of the task components of an arm that keep the favoured error smaller; None for equal ones."""
    if not favours or not can_favour(arm):
        return None
    places = len(arm.task.position)
    of_place, of_turn = (MORE, 1.0) if favours == "position" else (1.0, MORE)
    return checked_weights(arm, [of_place] * places + [of_turn] * (arm.task.m - places))


def turned_like(T: NDArray[np.floating], tool: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return a pose (4, 4) turned about its own z axis until it is nearest to the orientation of another."""
    pose = np.array(T, dtype=np.float64)
    apart = pose[:3, :3].T @ tool[:3, :3]
    pose[:3, :3] = pose[:3, :3] @ rotation_about("z", math.atan2(apart[1, 0] - apart[0, 1], apart[0, 0] + apart[1, 1]))
    return pose
