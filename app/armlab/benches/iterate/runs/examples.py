"""Examples of section 4.4 of the notes: an arm, a start, a target and runs, and what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from armlab.benches.iterate.runs.state import CLIP_KEY, Iterations
from armlab.benches.iterate.runs.worked import FLOW, run_of
from armlab.kin.ik.iterate import task_vector
from armlab.kin.ik.iterate.record import Limits
from armlab.kin.transforms import transform
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.examples import on_arm, with_clip_closed
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import with_clip
from armlab.session.state import Command, State


@dataclass(frozen=True)
class Example:
    """One example.

    Attributes
    ----------
    key, title : str
    robot : str
        Key of its file.
    start : tuple of float
        rad or m.
    position : tuple of float
        Of the target in the world, m; the tool's axes are wanted parallel to the world's.
    runs : tuple of (str, dict)
        Key of the method, and its parameters that are not at their defaults.
    says : str
        What to look at, in one sentence.
    task : str
        Key of the task; empty for the arm's own.
    joints : dict
        Joints (1-based) that are components, with their wanted values in rad or m.
    limits : "clamp" or "none"
    most : int
    """

    key: str
    title: str
    robot: str
    start: tuple[float, ...]
    position: tuple[float, float, float]
    runs: tuple[tuple[str, dict[str, float]], ...]
    says: str
    task: str = ""
    joints: dict[int, float] = field(default_factory=dict)
    limits: Limits = "none"
    most: int = 60


def _degrees(*values: float) -> tuple[float, ...]:
    return tuple(math.radians(value) for value in values)


EXAMPLES: Registry[Example] = Registry(
    "example",
    (
        Example(
            "orders",
            "Newton and gradient: quadratic, linear",
            "planar_2r",
            (0.2, 1.0),
            (0.9, 0.7, 0.0),
            (("newton", {}), ("gradient", {"alpha": 0.5}), ("broyden", {})),
            "In the plot of the error Newton's curve bends down, for its correct digits double with each step; the "
            "gradient's is a straight line.",
            most=80,
        ),
        Example(
            "step_size",
            "Gradient: a step size below and one above the bound",
            "planar_2r",
            _degrees(20.0, 60.0),
            (0.9, 0.7, 0.0),
            (("gradient", {"alpha": 0.8}), ("gradient", {"alpha": 1.2})),
            "Both begin alike, but above 2/σ_max² a step of the gradient goes too far and the error never dies out: "
            "with a fixed α it may well diverge.",
        ),
        Example(
            "stretched",
            "The stretched arm that stays stuck",
            "planar_2r",
            (0.0, 0.0),
            (1.0, 0.0, 0.0),
            (("gradient", {}), ("newton", {}), ("dls_constant", {}), (FLOW, {})),
            "The target lies on the line of the stretched arm: Jᵀe = 0 though e is not, and no method takes a step; "
            "move the start a little and look again.",
        ),
        Example(
            "jump",
            "The jump of Newton beside a singularity",
            "planar_2r",
            _degrees(10.0, 2.0),
            (1.2, 0.8, 0.0),
            (("newton", {}), ("dls_sigma", {})),
            "At the start the arm is almost stretched and det J almost 0, so Newton's first step turns the joints by "
            "turns; the damped step of the other run stays small.",
        ),
        Example(
            "redundant",
            "Redundant 3R: the shortest step J#e",
            "planar_3r",
            _degrees(0.0, 30.0, 30.0),
            (1.2, 1.2, 0.0),
            (("newton", {}), ("null_space_w", {}), ("ccd", {})),
            "Three joints for two components: every run ends with the tool on the target but in another "
            "configuration, for there are infinitely many.",
            task="xy",
            most=100,
        ),
        Example(
            "two_arms",
            "3R with the task vector (p_x, p_y, q₃)",
            "planar_3r",
            _degrees(0.0, 70.0, 10.0),
            (1.2, 1.2, 0.0),
            (("newton", {}), ("dls_error", {})),
            "With q₃ = 30° as third component the arm is a 2R with a bent forearm and has two solutions, the two pale "
            "arms: which one is reached depends on the start.",
            task="xy",
            joints={3: math.radians(30.0)},
        ),
        Example(
            "lyapunov",
            "Continuous Jacobian transpose and its Lyapunov function",
            "planar_2r",
            _degrees(20.0, 60.0),
            (0.9, 0.7, 0.0),
            ((FLOW, {"gain": 1.0}), (FLOW, {"gain": 4.0})),
            "V = ½ eᵀKe never rises, and dV/dt is never above 0; four times the gain is four times as fast on the "
            "same way.",
        ),
    ),
)
"""Examples by key, in the order of the list."""


@dataclass(frozen=True)
class ChooseExample(Command):
    """Load arm, start, target, task vector and runs of an example, and open its film at the start."""

    key: str
    label: ClassVar[str] = "example of iterations"

    def apply(self, state: State) -> State:
        """Return the state with the example loaded."""
        example = EXAMPLES[self.key]
        state = on_arm(with_clip_closed(state), example.robot)
        return with_clip(state.replace(_put(example, state)), CLIP_KEY)


def _put(example: Example, state: State) -> Iterations:
    arm = state[RobotPart].robot.arm
    chosen = example.task or example.joints
    target = np.array(transform(position=example.position), dtype=np.float64)
    target.setflags(write=False)
    return Iterations(
        state[RobotPart].robot,
        start=example.start,
        target=target,
        task=task_vector(arm, example.task or None, joints=example.joints) if chosen else None,
        runs=tuple(run_of(method, given, colour) for colour, (method, given) in enumerate(example.runs)),
        limits=example.limits,
        most=example.most,
        example=example.key,
    )


BENCH = Bench("iterations", 10, EXAMPLES, ChooseExample)
