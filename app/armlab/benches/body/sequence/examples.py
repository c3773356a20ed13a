"""Examples of three turns about moving and about fixed axes, each with a sentence on what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.body.forms.commands import SetBodyTurns
from armlab.benches.body.forms.state import Body
from armlab.benches.body.sequence.state import Sequence
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.fields import Set
from armlab.session.state import Command, State

SAME = 1e-9
"""Difference of an angle, radians, up to which an example is in place."""


@dataclass(frozen=True)
class SequenceExample:
    """Three turns.

    Attributes
    ----------
    key, title : str
    axes : str
    fixed : bool
    degrees : (float, float, float)
    order : "reverse" or "same"
        In which order the other body makes them.
    says : str
        Sentence on what to look at.
    """

    key: str
    title: str
    axes: str
    fixed: bool
    degrees: tuple[float, float, float]
    order: str
    says: str


EXAMPLES = Registry(
    "example",
    (
        SequenceExample(
            "rpy",
            "Roll, pitch, yaw⟦ (3.102)⟧",
            "xyz",
            True,
            (20.0, 30.0, 40.0),
            "reverse",
            "Roll, pitch and yaw about the axes of the base are yaw, pitch and roll about those of the body⟦. In the "
            "matrix of 3.103 two entries are misprinted: (1,2) is cos φ sin θ sin ψ − sin φ cos ψ, and (2,3) is "
            "sin φ sin θ cos ψ − cos φ sin ψ⟧.",
        ),
        SequenceExample(
            "zxz",
            "Euler angles ZXZ⟦ (3.80)⟧",
            "zxz",
            False,
            (30.0, 50.0, -40.0),
            "reverse",
            "The first axis and the third are both z, but the body has carried the third one along⟦. In the matrix of "
            "3.82 entry (2,1) is misprinted: it is sin φ cos ψ + cos φ cos θ sin ψ⟧.",
        ),
        SequenceExample(
            "quarters",
            "Quarter turns in the same order",
            "xyz",
            False,
            (90.0, 90.0, 90.0),
            "same",
            "Both bodies turn by a quarter about x, y and z. They end differently, since an axis that moves along is "
            "elsewhere by then.",
        ),
        SequenceExample(
            "lock",
            "A middle angle of 90°",
            "zyx",
            False,
            (40.0, 90.0, 20.0),
            "reverse",
            "The third axis of the moving body comes to lie on the line of the first: both turns are about z, and only "
            "their difference counts.",
        ),
    ),
)


@dataclass(frozen=True)
class ChooseSequenceExample(Command):
    """Put the three turns of an example in place, and the order of the other body."""

    key: str
    label: ClassVar[str] = "example of three turns"

    def apply(self, state: State) -> State:
        """Return the state with the turns of the example."""
        example = EXAMPLES[self.key]
        angles = tuple(math.radians(angle) for angle in example.degrees)
        state = SetBodyTurns(example.axes, example.fixed, angles).apply(state)
        return Set(Sequence, "order", example.order).apply(state)


def example_of(state: State) -> str:
    """Return the key of the example that is in place; empty if there is none."""
    part = state[Body]
    for key, example in EXAMPLES.items():
        angles = zip(part.angles, example.degrees, strict=True)
        near = all(abs(angle - math.radians(degrees)) < SAME for angle, degrees in angles)
        if near and (part.axes, part.fixed, state[Sequence].order) == (example.axes, example.fixed, example.order):
            return key
    return ""


BENCH = Bench("sequence", 12, EXAMPLES, ChooseSequenceExample)
