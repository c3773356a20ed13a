"""Lessons: the arm, its initial state, and the steps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.content.actions import Action
from armlab.content.check import StateCheck
from armlab.content.question import Choices, Question
from armlab.content.robots import Camera, Robot

LOCKS = ("robot", "table", "joints", "target")
"""Parts that a lesson can lock: the choice of another arm, the DH table, the joints, the handle of the target."""


@dataclass(frozen=True, eq=False)
class Step:
    """One step: what to read, and what to do or to answer, if anything.

    Attributes
    ----------
    title : str
    line : int
        Line of its heading in the file, from 1.
    example : str
        The example put in place when the step is shown, as in `Lesson`; empty to go on with the present state.
    panel : str
        The panel that is opened when it is shown; empty for none.
    begin : tuple of Action
        Actions, after the example, when the step is shown.
    html : str
    check : StateCheck or None
    question : Question or None
    hints : tuple of str
        HTML; unlocked one after the other.
    reveal_html : str
        Shown when the question is answered or the check is met; empty for none.
    solution : tuple of Action
        Actions that solve the step; empty when the file has none.
    live : tuple of str
        Names of the live values in any text of the step, sorted; see `armlab.content.live`.
    """

    title: str
    line: int
    example: str
    panel: str
    begin: tuple[Action, ...]
    html: str
    check: StateCheck | None
    question: Question | None
    hints: tuple[str, ...]
    reveal_html: str
    solution: tuple[Action, ...]
    live: tuple[str, ...]

    @property
    def texts(self) -> str:
        """All that is to be read at the step, as HTML: text, question, hints, and what is said of wrong answers."""
        texts = [self.html, *self.hints, self.reveal_html]
        if self.question is not None:
            options = self.question.form.options if isinstance(self.question.form, Choices) else ()
            texts += [self.question.html, *options, *(wrong.says for wrong in self.question.wrong)]
        if self.check is not None:
            texts += [wrong.says for wrong in self.check.wrong]
        return "".join(texts)


@dataclass(frozen=True, eq=False)
class Lesson:
    """A lesson file, with the values of one variant.

    Attributes
    ----------
    key : str
        Name of the file or folder without ending.
    file : str
        Its name in messages.
    title, chapter : str
    after : tuple of str
        Keys of the lessons that it needs.
    can : tuple of str
        Sentences on what one can do afterwards.
    minutes : int
        Time that it takes; 0 where the file does not say.
    listed : bool
        Whether it is in lists and can be opened by itself; otherwise only assignments open it.
    teaches : tuple of str
        Rows of the inventory.
    robot : str
        Key of its arm in the catalogue; "own" for an arm of the lesson's own.
    robot_used : Robot
        The arm itself.
    start : ndarray, shape (n,)
        Initial joint values, rad and m, read-only.
    panel : str
        The panel that is opened; empty for none.
    example : str
        The example of a bench that is put in place, such as ``"motion/corner_fly"``; empty for none.
    begin : tuple of Action
        Actions after that.
    overlays : tuple of str
        Switches of what is drawn besides the arm.
    target : ndarray, shape (4, 4), or None
        Initial pose of the handle, in the world.
    camera : Camera or None
        Initial view of the arm; None for that of the robot.
    locked : frozenset of str
        Some of `LOCKS`.
    locked_joints : tuple of int
        Joints that cannot be moved, from 1.
    hidden : tuple of str
        Keys of panels that are not there.
    variant : int
    values : mapping of str to float or str
        Values of the variant.
    varies : bool
        Whether other variants differ.
    digest : str
        16 hexadecimal digits of SHA-256 over text and pictures.
    intro_html : str
    live : tuple of str
        Names of the live values of the introduction.
    steps : tuple of Step
    """

    key: str
    file: str
    title: str
    chapter: str
    after: tuple[str, ...]
    can: tuple[str, ...]
    minutes: int
    listed: bool
    teaches: tuple[str, ...]
    robot: str
    robot_used: Robot
    start: NDArray[np.float64]
    panel: str
    example: str
    begin: tuple[Action, ...]
    overlays: tuple[str, ...]
    target: NDArray[np.float64] | None
    camera: Camera | None
    locked: frozenset[str]
    locked_joints: tuple[int, ...]
    hidden: tuple[str, ...]
    variant: int
    values: Mapping[str, float | str]
    varies: bool
    digest: str
    intro_html: str
    live: tuple[str, ...]
    steps: tuple[Step, ...]
