"""Examples of axis and angle, each with a sentence on what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.body.axis.state import Axis
from armlab.benches.body.forms.commands import SetBodyTurn, SetWholeAxis
from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.state import Body
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.fields import Set
from armlab.session.state import Command, State


@dataclass(frozen=True)
class AxisExample:
    """An axis, an angle, and what is shown of them.

    Attributes
    ----------
    key, title : str
    axis : (float, float, float)
        Need not be of unit length.
    angle : float
        Radians.
    shown, near : str
        As of the part.
    says : str
        Sentence on what to look at.
    """

    key: str
    title: str
    axis: tuple[float, float, float]
    angle: float
    shown: str
    near: str
    says: str


EXAMPLES = Registry(
    "example",
    (
        AxisExample(
            "steps",
            "1.1 rad about (1, 2, −2)",
            (1.0, 2.0, -2.0),
            1.1,
            "steps",
            "zero",
            "One body is carried to where r is z, turned about z, and carried back. The other one turns about r at "
            "once.",
        ),
        AxisExample(
            "third",
            "A third of a turn about (1, 1, 1)",
            (1.0, 1.0, 1.0),
            2.0 * math.pi / 3.0,
            "eigen",
            "zero",
            "R moves x to y, y to z and z to x: it is a permutation, and its eigenvalues are the third roots of 1.",
        ),
        AxisExample(
            "tiny",
            "10⁻⁸ rad about (0, 3, 4)",
            (0.0, 3.0, 4.0),
            1e-8,
            "inverse",
            "zero",
            "The trace is 3 to the last digit, so arccos finds no rotation at all. The difference of R and Rᵀ still "
            "has every digit of the angle.",
        ),
        AxisExample(
            "almost_half",
            "10⁻⁸ rad less than half a turn",
            (0.0, 3.0, 4.0),
            math.pi - 1e-8,
            "inverse",
            "pi",
            "The trace is −1 to the last digit, and arccos finds half a turn.",
        ),
        AxisExample(
            "half",
            "Half a turn about (1, 2, 2)",
            (1.0, 2.0, 2.0),
            math.pi,
            "inverse",
            "pi",
            "R is symmetric: its difference from Rᵀ tells nothing of r, which is found from R = 2 r rᵀ − I, up to its "
            "sign⟦ (3.68)⟧.",
        ),
        AxisExample(
            "none",
            "No rotation",
            (1.0, 2.0, 2.0),
            0.0,
            "inverse",
            "zero",
            "R is I whatever r is.",
        ),
    ),
)


@dataclass(frozen=True)
class ChooseAxisExample(Command):
    """Turn the body by the angle of an example about its axis, and show of it what is meant."""

    key: str
    label: ClassVar[str] = "example of axis and angle"

    def apply(self, state: State) -> State:
        """Return the state with the rotation of the example."""
        example = EXAMPLES[self.key]
        for command in (
            SetWholeAxis(example.axis),
            SetBodyTurn(example.angle),
            Set(Axis, "shown", example.shown),
            Set(Axis, "near", example.near),
        ):
            state = command.apply(state)
        return state


def example_of(state: State) -> str:
    """Return the key of the example that is in place; empty if there is none."""
    angle = state.derived(forms_of).angle
    for key, example in EXAMPLES.items():
        if state[Body].axis == example.axis and math.isclose(angle, example.angle, rel_tol=1e-12):
            return key
    return ""


BENCH = Bench("axis", 13, EXAMPLES, ChooseAxisExample)
