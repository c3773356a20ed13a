"""Trials of chapter 4, frames and workspace: the Denavit-Hartenberg parameters, WS1 and WS2, where a 2R is singular."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from armlab.kin.dh import link_transform
from armlab.kin.errata.arms import STEP, point_2r
from armlab.kin.errata.draws import Floats, Generator, direction, signed
from armlab.kin.errata.trial import Forms, Quiet, Trial

TURNS = 720
"""Number of orientations of the hand that are tried at a point."""

TRIED = 7
"""Number of orientations that are tried at the origin."""

AROUND = 4000
"""Number of corners of a boundary whose area is measured."""


class Rows(NamedTuple):
    """The constants of revolute joints, metres and radians, each of shape (n,)."""

    a: Floats
    alpha: Floats
    d: Floats


def chain(rows: Rows, q: Floats) -> Floats:
    """Return the frames 0 to n of a standard table of revolute joints, shape (n + 1, 4, 4)."""
    frames = [np.eye(4)]
    for a, alpha, d, angle in zip(*rows, q, strict=True):
        frames.append(frames[-1] @ np.asarray(link_transform(a, alpha, d, angle), dtype=np.float64))
    return np.array(frames)


def _rows(rng: Generator, n: int, alpha: float | None = None) -> Rows:
    turned = signed(rng, 0.3, 2.8, n) if alpha is None else np.full(n, alpha)
    return Rows(rng.uniform(0.2, 0.8, n), turned, signed(rng, 0.1, 0.5, n))


def _turning_axis(rows: Rows, q: Floats, joint: int) -> Forms:
    """4.1a: the axis about which a joint turns everything after it; ``joint`` counts from 1."""
    frames = chain(rows, q)
    moved, step = q.copy(), STEP * np.eye(len(q))[joint - 1]
    R = [chain(rows, each)[-1][:3, :3] for each in (moved - step, moved + step)]
    rate = (R[1] - R[0]) / (2.0 * STEP) @ frames[-1][:3, :3].T
    omega = [rate[2, 1], rate[0, 2], rate[1, 0]]
    return Forms(frames[joint][:3, 2], frames[joint - 1][:3, 2], omega)


def _foot(rows: Rows, q: Floats, link: int) -> Forms:
    """4.1b: the distance of D of a link from the axis on which it is said to lie.

    D is where the common normal of the axes z of frames link - 1 and link meets the first of them.
    """
    frames = chain(rows, q)
    z, origin = frames[:, :3, 2], frames[:, :3, 3]
    across, between = np.cross(z[link - 1], z[link]), origin[link] - origin[link - 1]
    along = float(np.cross(between, z[link]) @ across / (across @ across))
    D = origin[link - 1] + along * z[link - 1]
    ends = [float(np.linalg.norm(np.cross(D - origin[i], z[i]))) for i in (link - 2, link - 1)]
    return Forms(ends[0], ends[1], 0.0)


def _coincident(z: Floats, chosen: Floats) -> Forms:
    """4.1c: the scalar product of x of a frame with the axis of its joint, which a table takes to be 0."""
    across = chosen - (chosen @ z) * z
    return Forms(float(chosen @ z), float(across @ z / np.linalg.norm(across)), 0.0)


def _area(l1: float, l2: float) -> Forms:
    """4.19: the area of WS1 of a 2R; surfaces, here circles, that meet have none."""
    angles = np.linspace(-math.pi, math.pi, AROUND, endpoint=False)
    areas = []
    for q2 in (0.0, math.pi):
        x, y = point_2r(l1, l2, np.array([angles, np.full(AROUND, q2)]))
        areas.append(0.5 * abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))))
    return Forms(0.0, math.pi * ((l1 + l2) ** 2 - (l1 - l2) ** 2), areas[0] - areas[1])


def _at_the_origin(length: float, start: float) -> Forms:
    """4.6: how many of some orientations a 2R of equal links has at the origin."""
    tried = start + np.linspace(0.0, 2.0 * math.pi, TRIED, endpoint=False)
    reached = [float(np.linalg.norm(point_2r(length, length, [phi, math.pi]))) < 1e-12 for phi in tried]
    return Forms(2.0, float(TRIED), float(sum(reached)))


def _orange(length: float, distance: float) -> Forms:
    """4.40: whether a point is in the region in which not all orientations are possible, 1 if it is."""
    phi = np.linspace(0.0, 2.0 * math.pi, TURNS, endpoint=False)
    wrist = np.hypot(distance - length * np.cos(phi), length * np.sin(phi))
    share = float(np.mean(wrist <= 2.0 * length))
    printed = distance < 3.0 * length and not math.isclose(distance, length)
    return Forms(float(printed), float(length < distance < 3.0 * length), float(share < 1.0))


def _boundary(l1: float, l2: float, outer: bool, bearing: float) -> Forms:
    """4.63: the cosine of q2 on the boundary of the workspace."""
    q2 = 0.0 if outer else math.pi
    p = point_2r(l1, l2, [bearing, q2])
    return Forms(1.0, 1.0 if outer else -1.0, (float(p @ p) - l1**2 - l2**2) / (2.0 * l1 * l2))


def _unequal(rng: Generator, outer: bool) -> tuple[float, float, bool, float]:
    l1 = float(rng.uniform(0.8, 1.5))
    return l1, l1 * float(rng.uniform(0.3, 0.8)), outer, float(rng.uniform(-3.0, 3.0))


TRIALS = (
    Trial(
        "4.1a",
        "an arm of four joints, a configuration and one of its joints",
        lambda rng: (_rows(rng, 4), rng.uniform(-3.0, 3.0, 4), int(rng.integers(1, 5))),
        _turning_axis,
        "length of the difference of the axes, as unit vectors",
        "central differences of the orientation of the last frame",
        1e-7,
        norm="length",
        quiet=Quiet(
            lambda rng: (_rows(rng, 4, 0.0), rng.uniform(-3.0, 3.0, 4), int(rng.integers(1, 5))),
            "for an arm all of whose axes are parallel",
        ),
    ),
    Trial(
        "4.1b",
        "an arm of four joints, a configuration and one of its links",
        lambda rng: (_rows(rng, 4), rng.uniform(-3.0, 3.0, 4), int(rng.integers(2, 5))),
        _foot,
        "distance of D from the axis on which it is said to lie",
        "the common normal of the two axes as lines in space",
        unit="m",
    ),
    Trial(
        "4.1c",
        "an axis and a direction chosen at will",
        lambda rng: (direction(rng), direction(rng)),
        _coincident,
        "scalar product of x and z, which is 0 in a table",
        "the matrix of a row, in which both are orthogonal",
        1e-9,
    ),
    Trial(
        "4.19",
        "two lengths",
        lambda rng: tuple(rng.uniform(0.3, 1.5, 2).tolist()),
        _area,
        "area of the workspace of a 2R",
        f"the area inside of the outer and the inner boundary, as polygons of {AROUND} corners",
        1e-4,
        "m²",
    ),
    Trial(
        "4.6",
        "a length and a direction",
        lambda rng: (float(rng.uniform(0.3, 1.5)), float(rng.uniform(0.0, 3.0))),
        _at_the_origin,
        f"orientations at the origin, of {TRIED} that were tried",
        "the direct kinematics with the arm folded",
    ),
    Trial(
        "4.40",
        "a length and a point nearer than it",
        lambda rng: (length := float(rng.uniform(0.4, 1.2)), length * float(rng.uniform(0.05, 0.95))),
        _orange,
        "whether some orientation is not possible, 1 if so",
        f"{TURNS} orientations of the hand",
        quiet=Quiet(
            lambda rng: (length := float(rng.uniform(0.4, 1.2)), length * float(rng.uniform(1.1, 2.9))),
            "between l and 3 l",
        ),
    ),
    Trial(
        "4.63",
        "a 2R of unequal links at its inner boundary",
        lambda rng: _unequal(rng, False),
        _boundary,
        "cosine of q₂",
        "the direct kinematics and 4.50",
        quiet=Quiet(lambda rng: _unequal(rng, True), "at the outer boundary"),
    ),
)
"""The trials of frames and workspace."""
