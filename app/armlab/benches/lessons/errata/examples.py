"""Examples of errata, each with a sentence on what to look at."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.lessons.errata.state import Errata
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.examples import on_arm
from armlab.session.fields import put
from armlab.session.state import Command, State


@dataclass(frozen=True)
class ErrataExample:
    """One example.

    Attributes
    ----------
    key, title : str
    erratum : str
        Its id.
    says : str
        What to look at, in a sentence or two.
    robot : str
        Key of the arm on which it is drawn; empty for the one on the table.
    quiet : bool
        Whether it is run where it is not seen.
    """

    key: str
    title: str
    erratum: str
    says: str
    robot: str = ""
    quiet: bool = False


EXAMPLES: Registry[ErrataExample] = Registry(
    "example",
    (
        ErrataExample(
            "invisible",
            "An error that a test does not show",
            "6.95",
            "With intervals of equal length both formulas agree to the last digit at all 20 points. With uneven ones "
            "the printed one is wrong at each of them.",
            quiet=True,
        ),
        ErrataExample(
            "one_factor",
            "One half too many",
            "3.66",
            "Up to 0.34 rad at any axis and angle. At a quarter turn, where the second argument is 0, it is not seen.",
        ),
        ErrataExample(
            "last_joint",
            "The last joint moves the tool, too",
            "5.58",
            "The red arrow is the velocity of the tool as printed: the part of joint 2 is missing. Bend the elbow, and "
            "see it change.",
            "planar_2r",
        ),
        ErrataExample(
            "which_axis",
            "Which axis belongs to which joint",
            "4.1a",
            "The axis about which the joint turns is blue; the one that the text before 4.10 names is red. A table "
            "filled in by it describes another arm.",
            "puma560",
        ),
        ErrataExample(
            "sign",
            "A sign that turns the arm round",
            "4.82",
            "The red arm has the printed first angle: it points away from the point. Two of the four solutions end so.",
            "polar_rrp",
        ),
        ErrataExample(
            "rates",
            "Rates of angles are no angular velocity",
            "5.43",
            "The red arrow is what the rotation matrix makes of the rates of roll, pitch and yaw; the tool turns about "
            "the blue one.",
            "puma560",
        ),
    ),
)


@dataclass(frozen=True)
class ChooseErrataExample(Command):
    """Look at the erratum of an example, with its arm if it brings one."""

    key: str
    label: ClassVar[str] = "example of an erratum"

    def apply(self, state: State) -> State:
        """Return the state with the example."""
        example = EXAMPLES[self.key]
        if example.robot:
            state = on_arm(state, example.robot)
        return put(state, Errata(chosen=example.erratum, quiet=example.quiet, example=example.key))


BENCH = Bench("errata", 16, EXAMPLES, ChooseErrataExample)
