"""An arm with some joints held at a value, as an arm with fewer joints."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import wrong
from armlab.kin.dh import Row
from armlab.kin.ik.screws import Screws, screws_of
from armlab.kin.lines import PARALLEL_ANGLE, Line, common_normal
from armlab.kin.transforms import inverse, transform

Vector = NDArray[np.float64]

ROUNDING = 1e-13
"""Length, in length scales of the arm, below which a length of the remaining arm counts as zero."""


def checked_held(arm: Arm, held: Mapping[int, float] | None) -> dict[int, float]:
    """Return held joints, 0-based, from a mapping of 1-based joints to values in rad or m.

    Raises
    ------
    InputError
        A joint the arm does not have, or a value that is not a finite number.
    """
    if held is None:
        return {}
    if not isinstance(held, Mapping):
        raise wrong("held", "a mapping of joints (1-based) to values", held)
    found = {}
    for joint, value in held.items():
        if isinstance(joint, bool) or not isinstance(joint, (int, np.integer)) or not 1 <= joint <= arm.n:
            raise InputError(f"held: expected joints 1 to {arm.n}, got {joint!r}")
        if not isinstance(value, (int, float, np.floating)) or not math.isfinite(value):
            raise wrong(f"held, joint {joint}", "a finite number", value)
        found[int(joint) - 1] = float(value)
    return found


def with_held(arm: Arm, held: Mapping[int, float]) -> Arm | None:
    """Return the arm that is left when joints (0-based) are held: same base, tool, task and values of the others.

    Its table has the standard convention and is read off the joint axes by their common normals (notes 4.8-4.13).

    Returns
    -------
    Arm or None
        None where the task cannot be said in the axes of the new frame 0, or all joints are held.
    """
    kept = [i for i in range(arm.n) if i not in held]
    if not kept:
        return None
    s = _moved(screws_of(arm), held, kept)
    first = _frame_zero(s.z[0], s.o[0])
    free = arm.task.position in ("", "xyz") and arm.task.rotation != "phi"
    if first is None and not free:
        return None
    start = _any_frame(s.z[0], s.o[0]) if first is None else first
    rows: list[Row] = []
    x, place = start[:3, 0], start[:3, 3]
    for j, k in pairwise(range(len(kept))):
        normal = common_normal(Line(place, s.z[j]), Line(s.o[k], s.z[k]), scale=arm.length_scale)
        d = _length(float((normal.foot1 - place) @ s.z[j]), arm)
        rows.append(Row("R" if s.kinds[j] == "R" else "P", normal.a, normal.alpha, d, _turn(x, normal.normal, s.z[j])))
        x, place = normal.normal, normal.foot2
    rows.append(Row("R" if s.kinds[-1] == "R" else "P"))
    z = s.z[-1]
    end = transform(np.column_stack([x, np.cross(z, x), z]), place)
    tool = _orthonormal(inverse(end) @ s.home)
    tool[:3, 3] = [_length(value, arm) for value in tool[:3, 3].tolist()]
    return Arm.from_dh(
        rows,
        base=_orthonormal(arm.base @ start),
        tool=tool,
        limits=arm.limits[kept],
        task=arm.task,
        name=arm.name,
    )


def _moved(s: Screws, held: Mapping[int, float], kept: list[int]) -> Screws:
    """Return the remaining joint axes, moved by the held joints."""
    T, z, o = np.eye(4), [], []
    for i in range(len(s.kinds)):
        if i in held:
            T = T @ s.move(i, held[i])
        else:
            z.append(T[:3, :3] @ s.z[i])
            o.append(T[:3, :3] @ s.o[i] + T[:3, 3])
    return Screws("".join(s.kinds[i] for i in kept), np.array(z), np.array(o), np.asarray(T @ s.home), s.scale)


def _frame_zero(z: Vector, o: Vector) -> Vector | None:
    """Return a frame on the first axis with the axes of frame 0, or y and z reversed; None when it is not parallel."""
    if float(np.hypot(z[0], z[1])) > PARALLEL_ANGLE:
        return None
    sense = math.copysign(1.0, z[2])
    return np.asarray(transform(np.diag([1.0, sense, sense]), o), dtype=np.float64)


def _any_frame(z: Vector, o: Vector) -> Vector:
    x = np.cross(z, np.eye(3)[int(np.argmin(np.abs(z)))])
    x = x / np.linalg.norm(x)
    return np.asarray(transform(np.column_stack([x, np.cross(z, x), z]), o), dtype=np.float64)


def _length(value: float, arm: Arm) -> float:
    """Return a length, with rounding set to 0: in an arm without lengths it would become the length scale."""
    return 0.0 if abs(value) < ROUNDING * arm.length_scale else value


def _turn(x: Vector, to: Vector, z: Vector) -> float:
    return math.atan2(float(np.cross(x, to) @ z), float(x @ to))


def _orthonormal(T: NDArray[np.floating]) -> Vector:
    """Return the pose with its rotation made exactly orthonormal."""
    U, _, V = np.linalg.svd(T[:3, :3])
    return np.asarray(transform(U @ V, T[:3, 3]), dtype=np.float64)
