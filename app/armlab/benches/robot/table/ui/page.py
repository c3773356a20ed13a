"""The live Denavit-Hartenberg table: every number typed, joints added, both conventions, what the axes say, files."""

from __future__ import annotations

from armlab.benches.robot.table.state import Point
from armlab.benches.robot.table.ui.editor import DhEditor
from armlab.benches.robot.table.ui.ends import ends_fields, ends_typed, point_line
from armlab.benches.robot.table.ui.facts import Facts, axes_section, closed_form_card, facts_of
from armlab.benches.robot.table.ui.files import Files, PasteBox, save
from armlab.content.robots import Robot
from armlab.errors import ArmlabError
from armlab.kin.arm import Arm
from armlab.kin.convert import Link
from armlab.kin.dh import Convention
from armlab.session.edits import MOST_TEXT, Convert, PasteTable, RestoreTable
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.session import Refuse
from armlab.session.state import Command, Post, State
from armlab.ui.factors import product_latex
from armlab.ui.fields import Fields
from armlab.ui.format import escaped, mathml
from armlab.ui.markup import button, chips
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui, Html

CONVENTIONS = {"standard": "Standard (Siciliano, notes)", "modified": "Modified (Craig)"}
HINT = "Write the same arm in the other convention"
BACK = "Back to the file's table"
TASK_CHANGED = "What it controlled cannot be said in the axes of the other frame 0; it is now"


class TablePanel:
    """What the panel shows; it stays while the table is edited, so that the cursor stays in its cell."""

    def __init__(self, gui: Gui, state: State, post: Post) -> None:
        self._gui, self._state, self._post, self._units = gui, state, post, units_of(state)
        self._robot: Robot | None = None
        self._facts: Facts | None = None
        self._pair = 1
        self._head = gui.fields(lambda cell, _: self._post(RestoreTable() if cell == "restore" else Convert(cell)))
        self._table = gui.fields(self._cell)
        self._editor = DhEditor(self._table, self._units)
        self._axes = gui.fields(self._choose_pair)
        self._card: Html = gui.html()
        self._ends: Fields = gui.fields(self._end)
        self._point: Html = gui.html()
        files = gui.fields(self._file, MOST_TEXT)
        self._files = Files(files, self._units)
        with gui.folder("Paste a table"):
            box = gui.fields(self._pasted, MOST_TEXT)
            self._box = PasteBox(box)

    # -- what a person does --------------------------------------------------------------------------------------

    def _cell(self, cell: str, text: str) -> None:
        try:
            command = self._editor.typed(self._arm, cell, text)
        except ArmlabError as refusal:
            self._refuse(self._table, cell, text, refusal)
        else:
            self._edit(command, self._table, cell, text)

    def _end(self, cell: str, text: str) -> None:
        try:
            command = ends_typed(self._state, cell, text, self._units)
        except ArmlabError as refusal:
            self._refuse(self._ends, cell, text, refusal)
        else:
            self._edit(command, self._ends, cell, text)

    def _choose_pair(self, cell: str, _: str) -> None:
        number = cell.removeprefix("axes-")
        if number.isdecimal():
            self._pair = int(number[:4])
            self._show_axes()

    def _file(self, cell: str, text: str) -> None:
        if cell == "save":
            save(self._gui, self._state[RobotPart].robot)
        else:
            self._post(PasteTable(text))

    def _pasted(self, cell: str, text: str) -> None:
        command = self._box.typed(cell, text)
        if command is not None:
            self._post(command)

    def _edit(self, command: Command | None, fields: Fields, cell: str, text: str) -> None:
        """Hand in a command; one that the present state refuses is told beside its field."""
        if command is None:
            self._show_fields()
            return
        try:
            command.apply(self._state)
        except ArmlabError as refusal:
            self._refuse(fields, cell, text, refusal)
        else:
            self._post(command)

    def _refuse(self, fields: Fields, cell: str, text: str, refusal: ArmlabError) -> None:
        fields.refuse(cell, text, str(refusal))
        self._post(Refuse(str(refusal)))
        self._show_fields()

    # -- showing -------------------------------------------------------------------------------------------------

    @property
    def _arm(self) -> Arm:
        return self._state[RobotPart].robot.arm

    def show(self, state: State) -> None:
        """Show a state; what follows from the table is made anew only when that has changed."""
        before, self._state, robot = self._state, state, state[RobotPart].robot
        if robot is not self._robot:  # a mistake was about the table before
            self._table.forgive()
            self._ends.forgive()
        if robot is not self._robot or state[Point] is not before[Point] or self._table.stale or self._ends.stale:
            self._show_fields()
        if robot is not self._robot:
            self._robot, self._facts = robot, facts_of(robot.arm)
            self._show_head()
            self._show_axes()
            self._card.show(closed_form_card(self._facts.structure))
            self._files.show(robot)
        self._point.show(point_line(state, self._units))

    def _show_fields(self) -> None:
        self._editor.show(self._arm)
        self._ends.show(ends_fields(self._ends, self._state, self._units))

    def _show_axes(self) -> None:
        assert self._facts is not None
        self._axes.show(axes_section(self._facts, self._pair, self._axes.channel_id, self._units))

    def _show_head(self) -> None:
        part, channel = self._state[RobotPart], self._head.channel_id
        arm = part.robot.arm
        back = ""
        if part.own and part.origin:
            back = f'<span class="copies">{button(channel, "restore", BACK, "copy")}</span>'
        forms = chips(channel, CONVENTIONS, arm.convention, HINT)
        name = escaped(part.robot.name) + (", edited" if part.own and part.origin else "")
        summary = f'<p class="dim">{escaped(part.robot.summary)}</p>' if part.own and not part.origin else ""
        formula = f'<div class="eq small">{mathml(step_formula(arm.convention, self._units), block=True)}</div>'
        self._head.show(
            f'<h3>{name}{back}</h3>{summary}<div class="bar">{forms}</div>{formula}{moved_lines(part, self._units)}'
        )


def step_formula(convention: Convention, units: Units) -> str:
    """Return the matrix of a row as the product of its moves, in LaTeX with the letters of the book."""
    i = units.book.index
    return rf"{{}}^{{{i}-1}}T_{{{i}}}={product_latex(convention, units, i, f'{i}-1')}"


def moved_lines(part: RobotPart, units: Units) -> str:
    """Return what the change of convention has put into base and tool, where that was the last edit."""
    if part.moved is None:
        return ""
    n, base, tool = part.robot.arm.n, part.moved.base, part.moved.tool
    lines = []
    if base.moves:
        lines.append(f"base: {_moves(base, units)} moved here from row 1")
    if tool.moves and part.robot.arm.convention == "modified":
        lines.append(f"tool: {_moves(tool, units)} moved here from row {n}")
    elif tool.moves:
        lines.append(f"row {n}: {_moves(Link(0.0 - tool.a, 0.0 - tool.alpha), units)} moved here from the tool")
    told = "; ".join(lines) or "base and tool stay as they are"
    task = "" if part.moved.task_kept else f" {TASK_CHANGED} {part.robot.arm.task.title}."
    return f'<p class="dim">The same arm; {told}.{task}</p>'


def _moves(link: Link, units: Units) -> str:
    moves = []
    if link.a != 0.0:
        moves.append(f"T<sub>x</sub>({units.constant(link.a, False)})")
    if link.alpha != 0.0:
        moves.append(f"R<sub>x</sub>({units.constant(link.alpha, True)})")
    return " ".join(moves)


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the table and what belongs to it."""
    return TablePanel(gui, state, post).show


PANEL = Panel((RobotPart, Joints, Point), build, rebuilds=(Notation,))
