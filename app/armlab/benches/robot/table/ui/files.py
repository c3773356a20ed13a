"""Tables in and out: a robot file saved and loaded, the table copied for papers and spreadsheets, one pasted."""

from __future__ import annotations

from armlab.content.robots import Robot
from armlab.content.write_robot import robot_toml
from armlab.content.write_table import write_table
from armlab.session.edits import PasteTable
from armlab.session.state import Command
from armlab.ui.fields import Fields
from armlab.ui.file_names import file_name
from armlab.ui.format import escaped
from armlab.ui.markup import chip, copy_button, row
from armlab.ui.units import Units
from armlab.ui.widgets import Gui

FORMATS = {"csv": "CSV", "markdown": "Markdown", "latex": "LaTeX"}
EXAMPLE = "a, alpha, d, theta\n0.3, 90, 0.2, q1\n0.25, 0, 0, q2 + 30"
HELP = (
    "CSV, Markdown, LaTeX or a robot file. A cell such as q1, θ₁* or q2 + 90° is the joint variable; "
    "lengths are in m or mm."
)


class Files:
    """Buttons that save, load and copy."""

    def __init__(self, fields: Fields, units: Units) -> None:
        self._fields, self._units = fields, units

    def show(self, robot: Robot) -> None:
        """Show the buttons of this arm."""
        channel, angle = self._fields.channel_id, "deg" if self._units.in_degrees else "rad"
        copies = "".join(
            copy_button(title, write_table(robot.arm, form, angle), "chip") for form, title in FORMATS.items()
        )
        load = (
            '<label class="chip" title="Load a robot file or a table; it is read here and sent nowhere else">Load file'
            f'<input type="file" accept=".toml,.csv,.tsv,.txt,.md,.tex" data-chan="{channel}" data-cell="load"></label>'
        )
        save = chip(channel, "save", "Save TOML", "As a robot file")
        self._fields.show(f"<h3>Files</h3>{row('File', save + load)}{row('Copy as', copies)}")


def save(gui: Gui, robot: Robot) -> None:
    """Have the browser save a robot file."""
    gui.save(f"{file_name(robot.name)}.toml", robot_toml(robot))


class PasteBox:
    """A field for a whole table, with its button."""

    def __init__(self, fields: Fields) -> None:
        self._fields, self._text = fields, ""
        channel = fields.channel_id
        fields.show(
            f'<textarea class="paste" rows="5" spellcheck="false" aria-label="table" data-chan="{channel}"'
            f' data-cell="paste" placeholder="{escaped(EXAMPLE)}"></textarea>'
            f'<div class="bar">{chip(channel, "apply", "Apply")}</div>'
            f'<p class="dim">{escaped(HELP)}</p>'
        )

    def typed(self, cell: str, text: str) -> Command | None:
        """Keep what was typed; return the command when it is to be applied."""
        if cell == "paste":
            self._text = text
            return None
        return PasteTable(self._text)
