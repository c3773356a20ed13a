"""Pictures that a page draws by itself, large below the scene, and the button that shows them, or a plot, so."""

from __future__ import annotations

from collections.abc import Callable

from armlab.ui.columns import csv_of
from armlab.ui.form import Form, Pressed
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.tray_picture import Picture
from armlab.ui.widgets import Gui

KEY = "KeyX"
"""The key that shows the plots of the open page large; see `armlab.js`."""

_SIGN: Markup = tag(
    "svg", tag("path", d="M7 2H2v5M9 14h5V9M2 2l4.5 4.5M14 14L9.5 9.5"), viewBox="0 0 16 16", aria_hidden="true"
)


def large_button(form: Form, action: Pressed, cell: str = "large") -> Markup:
    """Return the button that shows a plot large."""
    return form.button(cell, _SIGN, action, "copy", "Show large, below the scene (X)", "Enlarge", data_key=KEY)


class LargeChart:
    """A picture of a page that the tray shows, too.

    Parameters
    ----------
    gui : Gui
    title : str or markup
    file : str
        Name of its files, without an ending.

    Attributes
    ----------
    on, file, title, drawn, clip, at
        As of `armlab.ui.tray.Enlarged`.
    """

    def __init__(self, gui: Gui, title: Inside, file: str) -> None:
        self.on, self.file, self.title, self.clip = True, file, title, ""
        self.drawn: object = None
        self.at: float | None = None
        self._gui, self._enlarge = gui, gui.enlarges(self)
        self._make: Callable[[], Picture] | None = None

    def show(self, of: object, make: Callable[[], Picture], at: float | None = None) -> None:
        """Set what it is drawn of, how it is drawn when someone looks, and the value of x that is marked."""
        self.drawn, self._make, self.at = of, make, at

    def button(self, form: Form) -> Markup:
        """Return the button that shows it large."""
        return large_button(form, self._enlarge, f"large-{self.file}")

    def picture(self) -> Picture | None:
        """Return the picture; None before the first `show`."""
        return None if self._make is None else self._make()

    def save(self) -> None:
        """Let the browser save its curves as a table, with two columns for each."""
        picture = self.picture()
        if picture is None:
            return
        names = [name for each in picture.drawn for name in (picture.x, each.curve.name)]
        columns = [column for each in picture.drawn for column in (each.x, each.y)]
        self._gui.save(f"{self.file}.csv", csv_of(names, columns))
