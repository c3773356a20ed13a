"""Examples of sections 5.2 and 7.2 of the notes: an arm, runs side by side, and what to look at."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from armlab.benches.control.follow.chosen import setup_of
from armlab.benches.control.follow.state import CLIP_KEY, Control
from armlab.kin.transforms import transform
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.examples import on_arm, with_clip_closed
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import with_clip
from armlab.session.run_targets import checked_target
from armlab.session.state import Command, State

START = (-0.3175604292915214, 0.6351208585830428)
"""Joint values, rad, that bring the tool of two links of 1 m to (1.9, 0) m."""


@dataclass(frozen=True)
class Example:
    """One example.

    Attributes
    ----------
    key, title : str
    robot : str
        Key of its file.
    runs : tuple of mapping
        What of each run is not at its default; see `armlab.benches.control.follow.chosen.setup_of`.
    says : str
        What to look at, in a sentence or two.
    target : (float, float, float) or None
        Position of the target, m, of runs that regulate; the tool's axes are wanted parallel to the world's.
    selected : int
    """

    key: str
    title: str
    robot: str
    runs: tuple[Mapping[str, Any], ...]
    says: str
    target: tuple[float, float, float] | None = None
    selected: int = 0


def _line(degrees: float, **more: Any) -> dict[str, Any]:
    """Return the line of the notes: from (1.9, 0) m at 0.6 m/s for 6 s."""
    return {
        "start": START,
        "speed": 0.6,
        "azimuth": math.radians(degrees),
        "duration": 6.0,
        "law": "open_loop",
        "inverse": "inverse",
        **more,
    }


def _short(**more: Any) -> dict[str, Any]:
    """Return a line of 2 s that keeps away from singularities."""
    return {"start": (0.2, 1.2), "speed": 0.3, "azimuth": math.radians(150.0), "duration": 4.0, "step": 2e-3, **more}


_DLS = {"law": "cartesian_tracking", "law_options": {"Kp": (10.0,)}, "inverse": "dls_variable", "step": 2e-3}
_CLIPPED = {"saturation": "clip", "limit": math.radians(300.0)}

EXAMPLES: Registry[Example] = Registry(
    "example",
    (
        Example(
            "line_170",
            "⟦5.2: ⟧Line at 170°",
            "planar_2r",
            (_line(170.0, name="170°, J⁻¹"),),
            "The line passes 330 mm from the base: a small peak of q̇₁, 104.9 °/s at 3.17 s, and an error at the end "
            'that comes from integration alone.⟦ The notes say "initial desired point"; they mean the final one.⟧',
        ),
        Example(
            "line_178",
            "⟦5.2: ⟧Line at 178°, nearly singular",
            "planar_2r",
            (_line(178.0, name="178°, J⁻¹"), _line(170.0, name="170°, J⁻¹")),
            "66 mm from the base the folded arm is almost singular: q̇₁ peaks at 518.6 °/s at 3.17 s. The arm does all "
            "it is told, so the tool stays on its line.",
        ),
        Example(
            "saturated",
            "⟦5.106: ⟧Speeds limited to 300 °/s",
            "planar_2r",
            (
                _line(178.0, **_CLIPPED, name="each joint clipped"),
                _line(178.0, saturation="scale", limit=math.radians(300.0), name="all slowed alike"),
                _line(178.0, **_CLIPPED, law="cartesian_tracking", name="clipped, with feedback"),
            ),
            "For a quarter of a second q̇₁ stays at 300 °/s; what was lost then is still missing, 4.8 cm"
            "⟦ (the notes: about 6)⟧. Slowed down alike, the joints keep the tool on its line, but late; feedback "
            "removes the error.",
        ),
        Example(
            "dls",
            "⟦5.2.1: ⟧Damped, line at 179.6°",
            "planar_2r",
            (_line(179.6, **_DLS, name="damped, with feedback"), _line(179.6, name="J⁻¹")),
            "J⁻¹ would need some 2600 °/s. Damped near the singularity the joints stay below 120 °/s; the tool is up "
            "to 25 mm from where it should be, and feedback brings it back.⟦ λ, path and K_p are ours: the notes do "
            "not give them.⟧",
        ),
        Example(
            "newton",
            "⟦5.100–5.105: ⟧Newton beside J⁻¹v",
            "planar_2r",
            (
                _line(170.0, step=0.01, integrator="euler", name="J⁻¹v, Euler, 10 ms"),
                _line(170.0, step=0.01, law="newton", name="Newton, 10 ms"),
            ),
            "Steps of 10 ms along J⁻¹v drift off the line. Newton's method, started at each sample where the arm is, "
            "corrects what the previous step left over.",
        ),
        Example(
            "joint_tracking",
            "⟦7.13–7.24: ⟧Tracking of the joints",
            "planar_2r",
            (
                _short(
                    law="joint_tracking", law_options={"K": (1.0, 3.0)}, offset=(-0.2, 0.1), name="error of the joints"
                ),
            ),
            "Each joint error dies out with its own gain: e₁ with 1/s, e₂ with 3/s⟦ (7.18 prints one k for both)⟧. The "
            "tool's error follows ė_p ≈ −J K J# e_p, which is no straight way back.",
        ),
        Example(
            "cartesian_tracking",
            "⟦7.25–7.28: ⟧Error in space or of joints",
            "planar_2r",
            (
                _short(law="cartesian_tracking", law_options={"Kp": (2.0,)}, offset=(0.2, -0.1), name="error in space"),
                _short(
                    law="joint_tracking", law_options={"K": (1.0, 4.0)}, offset=(0.2, -0.1), name="error of the joints"
                ),
                _short(law="open_loop", offset=(0.2, -0.1), name="no feedback"),
            ),
            "With the error in space the tool comes back to its line straight and exponentially, as long as J has full "
            "rank⟦: 7.27 does not hold at singularities⟧. The joints take it another way; without feedback it stays.",
        ),
        Example(
            "wrong_link",
            "⟦7.1: ⟧A link 2 % longer than assumed",
            "planar_2r",
            (
                _short(wrong=0.02, link=2, name="2 % wrong, feedback"),
                _short(wrong=0.02, link=2, law="open_loop", name="2 % wrong, none"),
                _short(name="known exactly"),
            ),
            "The controller brings to zero the error it computes, with the link lengths it assumes: some 20 mm of the "
            "true error stay, with any gain.",
        ),
        Example(
            "encoder",
            "⟦7.1: ⟧Encoder on link or motor",
            "planar_2r",
            (
                _short(counts=500, shaft="link", sampling=0.01, name="500 counts, link"),
                _short(counts=500, shaft="motor", ratio=100.0, sampling=0.01, name="500 counts, motor 1:100"),
            ),
            "On the link one count is 0.72°, and the joint speeds rattle; on the motor, before a gear of 1:100, it is "
            "a hundredth of that.",
        ),
        Example(
            "sampling",
            "⟦7.1: ⟧Sampling time and gain",
            "planar_2r",
            tuple(
                _short(offset=(0.02, 0.02), law_options={"Kp": (10.0,)}, sampling=T, name=f"T_s = {1000.0 * T:g} ms")
                for T in (0.01, 0.08, 0.16, 0.21)
            ),
            "With K_p = 10 1/s an error becomes (1 − K_p T_s) times itself at each sample: above 100 ms it changes "
            "sign, above 200 ms it grows.",
            selected=2,
        ),
        Example(
            "push",
            "⟦7.1: ⟧A push",
            "planar_2r",
            (
                _short(pushes=((1.5, 0.05, 0.0866, 0.0),), name="feedback"),
                _short(pushes=((1.5, 0.05, 0.0866, 0.0),), law="open_loop", name="no feedback"),
            ),
            "After 1.5 s the tool is pushed some 100 mm aside. Only the run that looks at its error comes back. Push "
            "again while it plays.",
        ),
        Example(
            "regulation",
            "⟦7.1: ⟧Regulation, drag the target",
            "planar_2r",
            (
                {
                    "start": (0.4, 1.3),
                    "reference": "target",
                    "law": "cartesian_regulation",
                    "law_options": {"Kp": (2.0,)},
                    "inverse": "dls_variable",
                    "duration": 4.0,
                    "step": 2e-3,
                    "name": "error in space",
                },
                {
                    "start": (0.4, 1.3),
                    "reference": "target",
                    "law": "joint_regulation",
                    "law_options": {"K": (2.0,)},
                    "duration": 4.0,
                    "step": 2e-3,
                    "name": "error of the joints",
                },
            ),
            "With q̇ = J# K e the tool goes straight to the target, with q̇ = K (q_d − q) along a curve; both as fast as "
            "exp(−2t). Drag the handle: the runs are computed again.",
            target=(-0.6, 1.2, 0.0),
        ),
        Example(
            "redundant",
            "⟦5.132–5.138: ⟧Self-motion of a 7R",
            "iiwa7",
            tuple(
                {
                    "start": (0.0, 0.6, 0.5, -1.4, 0.4, 0.9, 0.3),
                    "speed": 0.08,
                    "azimuth": math.radians(90.0),
                    "elevation": math.radians(-30.0),
                    "duration": 4.0,
                    "step": 0.01,
                    "null": null,
                    "null_gain": gain,
                    "name": name,
                }
                for null, gain, name in (
                    ("none", 1.0, "shortest q̇"),
                    ("middle", 200.0, "towards mid-range"),
                    ("manipulability", 60.0, "up w"),
                )
            ),
            "All three tools go the same way; what (I − J#J)ξ adds moves the joints only, towards the middle of their "
            "ranges or away from singularities.",
        ),
        Example(
            "planned",
            "⟦6.3.1: ⟧Executing a planned motion",
            "planar_2r",
            (
                {
                    "reference": "planned",
                    "law": "open_loop",
                    "offset": (0.05, -0.05),
                    "step": 2e-3,
                    "name": "J# ṗ alone",
                },
                {
                    "reference": "planned",
                    "law": "cartesian_tracking",
                    "offset": (0.05, -0.05),
                    "step": 2e-3,
                    "name": "with feedback",
                },
            ),
            "The motion of the tab Motion as a reference: q̇ = J# ṗ alone keeps any error it has, feedback removes it.",
        ),
    ),
)
"""Examples by key, in the order of the list."""

NAMES = frozenset(values["name"] for example in EXAMPLES.values() for values in example.runs if "name" in values)
"""Names that they give to runs."""


@dataclass(frozen=True)
class ChooseControlExample(Command):
    """Load the arm and the runs of an example, and open the selected one at its start."""

    key: str
    label: ClassVar[str] = "example of control"

    def apply(self, state: State) -> State:
        """Return the state with the example loaded."""
        example = EXAMPLES[self.key]
        state = on_arm(with_clip_closed(state), example.robot)
        return with_clip(state.replace(_put(example, state)), CLIP_KEY)


def _put(example: Example, state: State) -> Control:
    robot = state[RobotPart].robot
    opened = Control.initial(robot)
    runs = tuple(setup_of(robot, colour=colour, **values) for colour, values in enumerate(example.runs))
    target = opened.target
    if example.target is not None:
        target = checked_target(robot, np.array(transform(position=example.target), dtype=np.float64))
    return replace(opened, runs=runs, target=target, selected=example.selected, example=example.key)


BENCH = Bench("control", 60, EXAMPLES, ChooseControlExample)
