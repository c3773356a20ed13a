"""The live Denavit-Hartenberg table: numbers typed, joints added, both conventions, relations of the axes, files."""

from __future__ import annotations

from armlab.benches.robot.table.state import Point
from armlab.benches.robot.table.ui.editor import DhEditor
from armlab.benches.robot.table.ui.ends import ends_markup, point_line
from armlab.benches.robot.table.ui.facts import Facts, axes_section, closed_form_card, facts_of
from armlab.benches.robot.table.ui.files import CONVENTIONS, PasteBox, files_markup, save
from armlab.content.robots import Robot
from armlab.content.tables import single_notes
from armlab.kin.convert import Link
from armlab.kin.dh import Convention
from armlab.session.edits import MOST_TEXT, Convert, RestoreTable
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Post, State
from armlab.ui.factors import product_latex
from armlab.ui.format import mathml
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui, Html

HINT = "Write the same arm in the other convention"
BACK = "Restore the table of the file"
TASK_CHANGED = "The task cannot be expressed in the axes of the new frame 0; it is now"


class TablePanel:
    """The panel, which stays while the table is edited so that the cursor stays in its cell."""

    def __init__(self, gui: Gui, state: State, post: Post) -> None:
        self._gui, self._state, self._units = gui, state, units_of(state)
        self._robot: Robot | None = None
        self._facts: Facts | None = None
        self._pair = 1
        self._head, self._table = gui.form(post), gui.form(post)
        self._editor = DhEditor(self._table, self._units)
        self._axes = gui.form(post)
        self._card: Html = gui.html()
        self._ends = gui.form(post)
        self._point: Html = gui.html()
        self._files = gui.form(post, MOST_TEXT)
        with gui.fold("Paste a table"):
            self._pasted = gui.form(post, MOST_TEXT)
            self._box = PasteBox(self._pasted)

    def show(self, state: State) -> None:
        """Show a state; results from the table are computed only when that has changed."""
        before, self._state, robot = self._state, state, state[RobotPart].robot
        if robot is not self._robot:  # a mistake was about the table before
            self._table.forgive()
            self._ends.forgive()
        other = robot is not self._robot
        if other or state[Point] is not before[Point] or self._table.stale or self._ends.stale:
            self._editor.show(robot.arm)
            self._ends.show(ends_markup(self._ends, state, self._units))
        if self._facts is None or other:
            self._robot, self._facts = robot, facts_of(robot.arm)
            self._card.show(closed_form_card(self._facts.structure))
        if other or self._head.stale:
            self._show_head()
        if other or self._axes.stale:
            self._axes.show(axes_section(self._axes, self._facts, self._pair, self._units, self._choose_pair))
        if other or self._files.stale:
            self._files.show(files_markup(self._files, robot, self._units, self._save, self._box.read))
        if self._pasted.stale:
            self._box.show()
        self._point.show(point_line(state, self._units))

    def _save(self) -> None:
        save(self._gui, self._state)

    def _choose_pair(self, pair: int) -> None:
        self._pair = pair

    def _show_head(self) -> None:
        part, form = self._state[RobotPart], self._head
        arm = part.robot.arm
        title: Inside = part.robot.name
        if part.own and part.origin:
            back = tag("span.copies", form.button("restore", BACK, RestoreTable(), "copy"))
            title = part.title, back
        told = single_notes(part.robot.summary) if part.own and not part.origin else []
        forms = [form.chip(key, text, Convert(key), HINT, key == arm.convention) for key, text in CONVENTIONS.items()]
        self._head.show(
            tag("h3", title),
            [tag("p.dim", note) for note in told],
            tag("div.bar", forms),
            tag("div.eq.small", mathml(step_formula(arm.convention, self._units), block=True)),
            moved_lines(part, self._units),
        )


def step_formula(convention: Convention, units: Units) -> str:
    """Return the matrix of a row as the product of its moves, in LaTeX with the letters of the book."""
    i = units.book.index
    return rf"{{}}^{{{i}-1}}T_{{{i}}}={product_latex(convention, units, i, f'{i}-1')}"


def moved_lines(part: RobotPart, units: Units) -> Markup | None:
    """Return what the change of convention has moved into base and tool, if that was the last edit."""
    if part.moved is None:
        return None
    n, base, tool = part.robot.arm.n, part.moved.base, part.moved.tool
    lines = []
    if base.moves:
        lines.append(joined("base: ", _moves(base, units), " moved here from row 1"))
    if tool.moves and part.robot.arm.convention == "modified":
        lines.append(joined("tool: ", _moves(tool, units), f" moved here from row {n}"))
    elif tool.moves:
        back = _moves(Link(0.0 - tool.a, 0.0 - tool.alpha), units)
        lines.append(joined(f"row {n}: ", back, " moved here from the tool"))
    told = joined(lines, between="; ") if lines else "base and tool stay as they are"
    task = "" if part.moved.task_kept else f" {TASK_CHANGED} {part.robot.arm.task.title}."
    return tag("p.dim", "The same arm; ", told, f".{task}")


def _moves(link: Link, units: Units) -> Markup:
    moves = []
    if link.a != 0.0:
        moves.append(joined("T", tag("sub", "x"), f"({units.constant(link.a, False)})"))
    if link.alpha != 0.0:
        moves.append(joined("R", tag("sub", "x"), f"({units.constant(link.alpha, True)})"))
    return joined(moves, between=" ")


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the table and the parts around it."""
    return TablePanel(gui, state, post).show


PANEL = Panel((RobotPart, Joints, Point), build, rebuilds=(Notation,))
