"""Files and texts of tables: a robot file saved and loaded, the table copied for papers and spreadsheets, or pasted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from armlab.content.robots import Robot, catalogue, own_robot
from armlab.content.write_robot import robot_toml
from armlab.content.write_table import write_table
from armlab.session.edits import PasteTable
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, State
from armlab.ui.file_names import file_name
from armlab.ui.form import Form
from armlab.ui.html import Inside, tag
from armlab.ui.markup import copy_button, fold, row
from armlab.ui.units import Units
from armlab.ui.widgets import Gui

FORMATS = {"csv": "CSV", "markdown": "Markdown", "latex": "LaTeX"}
EXAMPLE = "a, alpha, d, theta\n0.3, 90, 0.2, q1\n0.25, 0, 0, q2 + 30"
PRESENT = "saved"
"""Name of the pose in which an edited arm is saved."""

HELP = (
    "CSV, Markdown, LaTeX or a robot file. A cell such as q1, θ₁* or q2 + 90° is the joint variable; "
    "lengths are in m, cm or mm."
)

MEANT = (
    "A table that does not tell its convention is read in the one that is chosen here. To read it in another one, "
    "choose that and press Apply again."
)

CONVENTIONS = {"standard": "Standard (Siciliano⟦, notes⟧)", "modified": "Modified (Craig)"}
READ_AS = {"": "As it seems", "standard": "Standard", "modified": "Modified"}


def files_markup(
    form: Form, robot: Robot, units: Units, save: Callable[[], None], read: Callable[[str], Command]
) -> Inside:
    """Return the buttons that save, load and copy."""
    angle = "deg" if units.in_degrees else "rad"
    copies = [copy_button(title, write_table(robot.arm, kind, angle), "chip") for kind, title in FORMATS.items()]
    hint = "Load a robot file or a table; it is read here and sent nowhere else"
    chosen = tag("input", type="file", accept=".toml,.csv,.tsv,.txt,.md,.tex", **form.bound("load", read))
    load = tag("label.chip", "Load file", chosen, title=hint)
    saves = form.chip("save", "Save TOML", save, "As a robot file")
    return fold("Files", row("File", (saves, load)), row("Copy as", copies))


def save(gui: Gui, state: State) -> None:
    """Let the browser save a robot file."""
    robot = saved_robot(state[RobotPart], state[Joints].q)
    gui.save(f"{file_name(robot.name)}.toml", robot_toml(robot))


def saved_robot(part: RobotPart, q: NDArray[np.float64]) -> Robot:
    """Return the arm as its file has it: an edited one with a name that says so, and with the present pose.

    The pose is the home of an arm that has none of its own.
    """
    robot = part.robot
    if not part.own:
        return robot
    poses = {name: pose for name, pose in robot.poses.items() if name != PRESENT}
    if not _has_own_poses(part):
        poses = {"home": q}
    elif not any(np.array_equal(pose, q) for pose in poses.values()):
        poses[PRESENT] = q
    return replace(robot, name=part.title, poses=poses)


def _has_own_poses(part: RobotPart) -> bool:
    """Return whether the poses of an arm are of its file, and not the one that every table has."""
    poses = part.robot.poses
    at_rest = own_robot(part.robot.arm, part.robot.name).poses
    if poses.keys() != at_rest.keys() or not all(np.array_equal(poses[name], q) for name, q in at_rest.items()):
        return True
    of_file = catalogue()[part.origin].poses if part.origin else {}
    return any(name in of_file and np.array_equal(of_file[name], q) for name, q in poses.items())


class PasteBox:
    """A field for a whole table, with its button."""

    def __init__(self, form: Form) -> None:
        self._form, self._text, self._convention = form, "", ""
        self.show()

    def show(self) -> None:
        """Show the field with the typed text."""
        form = self._form
        looks = {"rows": "5", "spellcheck": "false", "aria_label": "table", "placeholder": EXAMPLE}
        form.show(
            tag("textarea.paste", self._text, **looks, **form.bound("paste", self._keep)),
            row("Read as", form.chips("read-as", READ_AS, self._convention, "", self._choose)),
            tag("div.bar", form.chip("apply", "Apply", lambda: self.read(self._text))),
            tag("p.dim", HELP),
            tag("p.dim", MEANT),
        )

    def read(self, text: str) -> PasteTable:
        """Return the command that takes a table, pasted here or in a file, in the chosen convention."""
        return PasteTable(text, convention=self._convention)

    def _choose(self, convention: str) -> tuple[Command, ...]:
        self._convention = convention
        self.show()
        return ()

    def _keep(self, text: str) -> tuple[Command, ...]:
        """Keep the typed text; nothing is sent again, since the button may be pressed at once."""
        self._text = text
        return ()
