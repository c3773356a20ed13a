"""Errata on the Denavit-Hartenberg axes, drawn on an arm: which joint an axis belongs to, and where D lies."""

from __future__ import annotations

import numpy as np

from armlab.benches.lessons.errata.on_arm.drawn import Drawn, Floats, OnArm, Segment, Unfit, line
from armlab.kin.arm import Arm

MODIFIED = (
    "The table of this arm is in the modified convention, in which z of frame i is the axis of joint i. The notes use "
    "the standard one."
)


def _only_standard(draw: OnArm) -> OnArm:
    def on_arm(arm: Arm, q: Floats) -> Drawn | Unfit:
        return draw(arm, q) if arm.convention == "standard" else Unfit(MODIFIED, "puma560")

    return on_arm


def _between(point: Floats, other: Floats, direction: Floats) -> Floats:
    """Return the shortest way from a point to a line."""
    way = other - point
    return np.asarray(way - (way @ direction) * direction)


def _axis_of_joint(arm: Arm, q: Floats) -> Drawn | Unfit:
    frames = np.asarray(arm.frames(q), dtype=np.float64)
    z, origin = frames[:, :3, 2], frames[:, :3, 3]
    apart = [float(np.linalg.norm(np.cross(z[i - 1], z[i]))) for i in range(1, arm.n + 1)]
    shifted = [float(np.linalg.norm(_between(origin[i - 1], origin[i], z[i]))) for i in range(1, arm.n + 1)]
    turned = max(apart) > 1e-9
    i = 1 + int(np.argmax(apart if turned else shifted))
    kind = "turns about" if arm.rows[i - 1].revolute else "slides along"
    angle = float(np.arctan2(apart[i - 1], z[i - 1] @ z[i]))
    return Drawn(
        f"Joint {i} {kind} z of frame {i - 1}, in blue. As printed, its axis would be z of frame {i}, in red.",
        angle if turned else shifted[i - 1],
        "rad" if turned else "m",
        (
            line(origin[i], z[i], arm, True, f"printed: z{i}"),
            line(origin[i - 1], z[i - 1], arm, False, f"joint {i}: z{i - 1}"),
        ),
        unseen="All axes of this arm lie in one line.",
    )


def _foot_of_normal(arm: Arm, q: Floats) -> Drawn | Unfit:
    if arm.n < 2:
        return Unfit("It takes two joints: the axis before the first one is not there.", "puma560")
    frames = np.asarray(arm.frames(q), dtype=np.float64)
    z, origin, x = frames[:, :3, 2], frames[:, :3, 3], frames[:, :3, 0]
    a = np.array([row.a for row in arm.rows])
    D = origin[1:] - a[:, None] * x[1:]  # of links 1 to n
    ways = [_between(D[i - 1], origin[i - 2], z[i - 2]) for i in range(2, arm.n + 1)]
    i = 2 + int(np.argmax([np.linalg.norm(way) for way in ways]))
    way, foot = ways[i - 2], D[i - 1]
    return Drawn(
        f"D of link {i} lies on the axis of joint {i}, in blue. As printed, it would lie on that of joint {i - 1}, "
        "in red.",
        float(np.linalg.norm(way)),
        "m",
        (
            line(foot + way, z[i - 2], arm, True, f"printed: axis {i - 1}"),
            Segment(foot, foot + way, True, arrow=False),
            line(foot, z[i - 1], arm, False, f"D on axis {i}"),
        ),
        unseen="Here each D lies on the axis before as well.",
    )


ON_ARM: dict[str, OnArm] = {"4.1a": _only_standard(_axis_of_joint), "4.1b": _only_standard(_foot_of_normal)}
"""Drawings, by the id of the erratum."""
