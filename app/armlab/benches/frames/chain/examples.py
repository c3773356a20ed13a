"""Examples of chains of frames, each with a sentence on what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

from armlab.benches.frames.chain.state import FIRST, WORLD, Chain, Frame, Triple
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.fields import put
from armlab.session.state import Command, State


@dataclass(frozen=True)
class ChainExample:
    """Frames, a point, and the pair whose transform is shown.

    Attributes
    ----------
    key, title : str
    frames : tuple of Frame
    point : (float, float, float)
        In the frame ``given``, metres.
    given, reference, frame, selected : str
    globe : bool
    says : str
        Sentence on what to look at.
    """

    key: str
    title: str
    frames: tuple[Frame, ...]
    point: Triple
    given: str
    reference: str
    frame: str
    selected: str
    says: str
    globe: bool = False

    def values(self) -> dict[str, Any]:
        """Return the fields of the part."""
        return {
            "frames": self.frames,
            "point": self.point,
            "given": self.given,
            "reference": self.reference,
            "frame": self.frame,
            "selected": self.selected,
            "globe": self.globe,
            "example": self.key,
        }


def _turned(name: str, parent: str, position: Triple, *degrees: float) -> Frame:
    """Return a frame with roll, pitch and yaw in degrees."""
    roll, pitch, yaw = (math.radians(angle) for angle in degrees)
    return Frame(name, parent, position, (roll, pitch, yaw))


EXAMPLES = Registry(
    "example",
    (
        ChainExample(
            "chain",
            "World, A, B, C",
            FIRST,
            (0.2, 0.3, 0.0),
            "C",
            WORLD,
            "C",
            "B",
            "Every name that stands below on the left and above on the right cancels. Drag B: C hangs on it and moves "
            "along, and so does p, which is given in C.",
        ),
        ChainExample(
            "sphere",
            "The pole of a sphere⟦ (3.18)⟧",
            (_turned("S", WORLD, (3.0, 3.0, 0.0), 0.0, 0.0, -90.0),),
            (0.0, 1.0, 0.0),
            "S",
            WORLD,
            "S",
            "S",
            "The sphere has a radius of 1 m and is turned by 90° clockwise about z. Its pole is (0, 1, 0) m in the "
            "frame of the sphere and (4, 3, 0) m in the world⟦ (3.19)⟧.",
            globe=True,
        ),
        ChainExample(
            "rotations",
            "Three rotations⟦ (3.20)⟧",
            (
                _turned("A", WORLD, (0.0, 0.0, 0.0), 0.0, 0.0, 40.0),
                _turned("B", "A", (0.0, 0.0, 0.0), 0.0, 50.0, 0.0),
                _turned("C", "B", (0.0, 0.0, 0.0), 60.0, 0.0, 0.0),
            ),
            (0.3, 0.2, 0.25),
            "C",
            WORLD,
            "C",
            "A",
            "All frames have one origin and differ in orientation only. Compare under Operations what it takes to "
            "multiply the three matrices first, and to apply one after the other to the point.",
        ),
        ChainExample(
            "camera",
            "A camera beside a robot",
            (
                _turned("B", WORLD, (0.6, -0.2, 0.0), 0.0, 0.0, 90.0),
                _turned("K", WORLD, (0.0, 0.5, 0.9), 150.0, 0.0, -60.0),
                _turned("O", "K", (0.1, -0.1, 0.8), 0.0, 30.0, 0.0),
            ),
            (0.15, 0.0, 0.1),
            "O",
            "B",
            "O",
            "O",
            "The camera K knows where the object O is, and the robot needs it in its own base B: the way leads from B "
            "up to the world and down again, so the first factor is an inverse.",
        ),
        ChainExample(
            "two_robots",
            "Two robots⟦ (3.125)⟧",
            (
                _turned("A", WORLD, (-2.5, 1.0, 0.0), 0.0, 0.0, 0.0),
                _turned("EA", "A", (0.5 + math.sqrt(0.75), math.sqrt(0.75) - 0.5, 0.0), 0.0, 0.0, -30.0),
                _turned("EB", "EA", (0.0, 0.0, 0.0), 0.0, 0.0, 180.0),
                _turned("B", WORLD, (1.0, 2.0, 0.0), 0.0, 0.0, 30.0),
            ),
            (0.4, 0.2, 0.0),
            "EA",
            "B",
            "EB",
            "B",
            "The tools EA and EB of two robots are to meet and to point at each other. The transform is what robot B "
            "has to reach in its own base⟦ (3.133)⟧; the page Two robots solves for its joints.",
        ),
    ),
)


@dataclass(frozen=True)
class ChooseChainExample(Command):
    """Put the frames of an example in place."""

    key: str
    label: ClassVar[str] = "example of frames"

    def apply(self, state: State) -> State:
        """Return the state with the frames, the point and the pair of the example."""
        return put(state, state[Chain].with_values(EXAMPLES[self.key].values()))


BENCH = Bench("frames", 15, EXAMPLES, ChooseChainExample)
