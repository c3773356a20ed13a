"""The template of a lesson: small, complete, and with a comment on each of its parts."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.content.arithmetic import shortest
from armlab.content.robots import Robot

TURN_DEG, SLIDE = 30.0, 0.25
"""Motion of the joint in the template: an angle in degrees, or a fraction of its stroke."""

PART_OF_RANGE = 0.005
"""Tolerance of the joint, relative to its range: random configurations hardly ever meet it."""

PART_OF_REACH = 0.01
"""Tolerance of the question, relative to the reach."""

_AXES = "xyz"


def new_lesson(robot: Robot) -> str:
    """Return the text of a lesson about an arm, ready to be read, solved and handed in."""
    joint = _Joint.of(robot)
    goal = joint.goal(robot.home)
    point = np.round(robot.arm.position(goal), 3) + 0.0
    axis = int(np.argmax(np.abs(point)))
    tolerance = _nice(PART_OF_REACH * 2.0 * robot.arm.length_scale)
    others = [k for k in range(3) if abs(point[k] - point[axis]) > 4.0 * tolerance]
    other = max(others, key=lambda k: abs(point[k]), default=axis)
    # Where all coordinates are the same, the wrong answer that is named is another one.
    wrong = float(point[other]) if others else float(point[axis]) + 10.0 * tolerance
    kinds = set(robot.arm.revolute.tolist())
    key = "q_deg" if kinds == {True} else "q_m" if kinds == {False} else "q_deg_m"
    return _TEMPLATE.format(
        robot=robot.key,
        name=robot.name,
        q=f"{key} = {_values(robot, goal)}",
        wrong_q=f"{key} = {_values(robot, joint.beyond(robot.home))}",
        verb="Turn" if joint.turns else "Slide",
        joint=joint.number,
        unit=joint.unit,
        written=rf"{shortest(joint.value)}\text{{{'°' if joint.turns else ' m'}}}",
        value=shortest(joint.value),
        wrong_value=shortest(joint.wrong),
        tolerance=shortest(joint.tolerance),
        coordinate=_AXES[axis],
        answer=shortest(float(point[axis])),
        answer_tolerance=shortest(tolerance),
        wrong_answer=shortest(wrong),
        wrong_says=json.dumps(f"This is $p_{_AXES[other]}$." if others else "This is too far out.", ensure_ascii=False),
    )


@dataclass(frozen=True)
class _Joint:
    """The joint that is to be moved.

    Attributes
    ----------
    number : int
        Number of the joint, from 1.
    turns : bool
    value, wrong, tolerance : float
        Goal, position after the typical mistake, and tolerance, in ``unit``.
    """

    number: int
    turns: bool
    value: float
    wrong: float
    tolerance: float

    @property
    def unit(self) -> str:
        return "deg" if self.turns else "m"

    @classmethod
    def of(cls, robot: Robot) -> _Joint:
        """Return the first joint, moved towards the limit that is farther away."""
        turns = bool(robot.arm.revolute[0])
        factor = math.degrees(1.0) if turns else 1.0
        low, high = (float(limit) * factor for limit in robot.arm.limits[0])
        start = float(robot.home[0]) * factor
        room = max(high - start, start - low)
        sign = 1.0 if high - start >= start - low else -1.0
        step = sign * (min(TURN_DEG, room / 3.0) if turns else SLIDE * min(room, high - low))
        digits = 0 if turns and abs(step) >= 5.0 else 3
        value, wrong = (round(start + part * step, digits) for part in (1.0, 2.0))
        return cls(1, turns, value, wrong, _nice(PART_OF_RANGE * (high - low)))

    def goal(self, home: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the goal configuration, shape (n,)."""
        return self._moved(home, self.value)

    def beyond(self, home: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the configuration of the typical mistake, shape (n,)."""
        return self._moved(home, self.wrong)

    def _moved(self, home: NDArray[np.float64], value: float) -> NDArray[np.float64]:
        q = home.copy()
        q[0] = math.radians(value) if self.turns else value
        return q


def _nice(value: float) -> float:
    """Return the largest of 1, 2 or 5 times a power of ten that is not above a positive value."""
    power = 10.0 ** math.floor(math.log10(value))
    digit = max(digit for digit in (1, 2, 5) if digit * power <= value * (1.0 + 1e-12))
    return float(f"{digit * power:.1g}")


def _values(robot: Robot, q: NDArray[np.float64]) -> str:
    shown = np.where(robot.arm.revolute, np.degrees(q), q)
    return f"[{', '.join(shortest(float(f'{value:.9g}')) for value in shown)}]"


_TEMPLATE = """\
+++
# Between these lines stands what the lesson is about. Lines like this one are for authors only.
title = "My lesson"
chapter = "My lessons"
# What one has to have done before, by the names of lessons; what one can do afterwards; how long it takes.
after = []
minutes = 5
can = ["Move a joint to an angle, and read a coordinate of the hand."]
# Rows of the inventory; the index of the lab finds them by word and equation.
teaches = ["S1.1-direct-kinematics"]
robot = "{robot}"
# The panel that is open at first, and what is drawn besides the arm.
panel = "joints"
overlays = ["frames"]
+++

What stands before the first step introduces the lesson. Text is **Markdown**, formulas are LaTeX: $p = f(q)$.
The arm is the {name}.

## Move a joint

{verb} joint {joint} to $q_{joint} = {written}$. It is at {{{{q{joint}}}}} as it stands: this number is live.

```check
# Met as soon as the arm is so. Other kinds are in the guide for authors: tool_at, tool_pose, singular, ...
kind = "joint_at"
joint = {joint}
value_{unit} = {value}
tolerance_{unit} = {tolerance}

# A mistake you expect, and what to say to it. The configuration shows `armlab lesson check` that it is found.
[[wrong]]
says = "This is too far: twice the way."
kind = "joint_at"
joint = {joint}
value_{unit} = {wrong_value}
tolerance_{unit} = {tolerance}
{wrong_q}
```

```hint
The slider of joint {joint} is in the panel *Joints*; you can also type the number beside it.
```

```solution
# Never shown to students: `armlab lesson check` plays it, the solution sheet lists it.
{q}
```

## Read a coordinate

The arm stands as after the first step, the other joints as they were at first.

```question
kind = "number"
text = "How large is $p_{coordinate}$, the ${coordinate}$ coordinate of the hand?"
answer = {answer}
unit = "m"
tolerance = {answer_tolerance}

[[wrong]]
answer = {wrong_answer}
says = {wrong_says}
```

```reveal
Shown when it is answered: $p_{coordinate} = {answer}\\,\\text{{m}}$.
```
"""
