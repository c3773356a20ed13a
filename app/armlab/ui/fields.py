"""Markup with input fields of our own, and the way back of what a person types there."""

from __future__ import annotations

import json
import logging
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field

import viser

from armlab.ui import adapter, markup
from armlab.ui.html import Inside, Markup, joined, tag

log = logging.getLogger(__name__)

OnInput = Callable[[str, str], None]
"""Gets the cell and the text of what a person typed or pressed."""

LONGEST_CELL = 200
"""Characters of the name of a cell."""

LONGEST_TYPED = 20_000
"""Characters that a field hands on, besides those that read files: the longest table has fewer."""

SEEN, READ = 1.0, 8.0
"""Seconds that a sentence is there at least: whatever else is pressed, as on the way out of a field, and while
something else goes on beside it."""

LARGEST_NUMBER = 2**53
"""Numbers of messages below it are exact in a page."""


@dataclass
class _Mistake:
    """What was refused.

    Attributes
    ----------
    cell, text, why : str
    instead : str or None
        What the field would show without it; None of what is no field.
    """

    cell: str
    text: str
    why: str
    instead: str | None = None
    _made: float = field(default_factory=time.monotonic)
    _beside: str | None = None

    def stood(self, seconds: float) -> bool:
        """Whether it has been there for so long."""
        return time.monotonic() - self._made > seconds

    def is_over(self, content: str) -> bool:
        """Whether what stands beside it is not what it was refused beside, and it could be read."""
        if self._beside is None:
            self._beside = content
        return self._beside != content and self.stood(READ)


class Fields:
    """Markup with input fields of our own, whose values arrive when Enter is pressed or the field is left.

    Make the fields with `field`; the page's script sends what a person typed through a hidden text control.

    Parameters
    ----------
    gui : GuiApi
    on_input : callable
        Called with the cell and the text.
    longest : int or None
        Characters of a text that its reader takes; of a longer one it gets one more, and says that it is too long.
        Where nothing is said, more than `LONGEST_TYPED` are refused here: reading is done where all students wait, and
        some of it takes the square of the length.
    scope : str
        Class whose style they have besides the common one.
    """

    def __init__(self, gui: viser.GuiApi, on_input: OnInput, longest: int | None = None, scope: str = "") -> None:
        self._class = f"al {scope}".rstrip()
        self.channel = gui.add_text("channel", "", visible=False)
        self.html = gui.add_html("")
        self._on_input, self._longest = on_input, longest
        self._revision = self._shown_revision = self._heard = 0
        self._content = Markup()
        self._mistake: _Mistake | None = None
        self._lock = threading.Lock()
        adapter.on_event(self.channel, "on_update", lambda _: self._receive())

    def _receive(self) -> None:
        try:
            cell, text, number = json.loads(adapter.take_value(self.channel))
        except (ValueError, TypeError, RecursionError):
            log.warning("a page that is not ours wrote into a field")
            return
        self._heard = number if isinstance(number, int) and abs(number) < LARGEST_NUMBER else 0
        with self._lock:
            if self._mistake is not None and (self._mistake.cell == cell or self._mistake.stood(SEEN)):
                self._mistake = None
            self._revision += 1  # so that the next `show` also replaces a text that was not taken
        longest = LONGEST_TYPED if self._longest is None else self._longest + 1
        cell, read = _whole(_cut(cell, LONGEST_CELL)), _whole(_cut(text, longest))
        if self._longest is None and isinstance(text, str) and len(text) > longest:
            self.refuse(cell, read, f"expected at most {longest} characters, got {len(text)}")
            self.show(self._content)
        else:
            self._on_input(cell, read)

    @property
    def stale(self) -> bool:
        """Whether a person has typed or pressed since the markup was shown: what stands there may not hold."""
        return self._revision != self._shown_revision

    @property
    def channel_id(self) -> str:
        """Where buttons in the markup send their ``data-cell``: put it into their ``data-chan``."""
        return adapter.gui_id(self.channel)

    def refuse(self, cell: str, text: str, why: str) -> None:
        """Show what was typed, marked, and below the fields why not.

        It stands until the next input, except for one that follows at once elsewhere. Of a field it goes when another
        value is to be shown there, and of what is no field when other markup is, if it could be read by then.
        """
        self._mistake = _Mistake(cell, text[:LONGEST_TYPED], why)

    def refuse_later(self, cell: str, text: str) -> Callable[[str], bool]:
        """Return what refuses what was typed just now, from any thread.

        It returns whether the refusal is shown: not once something else was typed, or the fields are gone.
        """
        revision, text = self._revision, text[:LONGEST_TYPED]

        def refuse(why: str) -> bool:
            with self._lock:
                if revision != self._revision or adapter.is_removed(self.html):
                    return False
                self.refuse(cell, text, why)
                self._revision += 1  # so that it counts as stale, although it may have been shown meanwhile
            return True

        return refuse

    def forgive(self) -> None:
        """Show the fields as they hold with the next `show`."""
        self._mistake = None

    def field(self, cell: str, value: str, label: str, disabled: bool = False, below: str = "", **more: str) -> Markup:
        """Return the markup of one input field; Enter goes on to the field ``below``; ``more`` attributes."""
        value, wrong = self._refused(cell, value)
        attributes = {"inputmode": "decimal", "data_below": below, **more, **wrong}
        return markup.field(self.channel_id, cell, value, label, disabled, **attributes)

    def area(self, cell: str, value: str, label: str, lines: int) -> Markup:
        """Return the markup of an input field of several lines, for a table a person types."""
        value, wrong = self._refused(cell, value)
        return markup.area(self.channel_id, cell, value, label, lines, **wrong)

    def _refused(self, cell: str, value: str) -> tuple[str, dict[str, str]]:
        """Return what stands in a field, and the marks of what was refused there."""
        mistake = self._mistake
        if mistake is None or mistake.cell != cell:
            return value, {}
        if mistake.instead is None:
            mistake.instead = value
        if mistake.instead != value:
            self._mistake = None
            return value, {}
        return mistake.text, {"aria_invalid": "true", "title": mistake.why}

    def visible(self, on: bool) -> None:
        """Show or hide the whole."""
        if self.html.visible != on:
            self.html.visible = on

    def show(self, *inside: Inside) -> None:
        """Show this, which holds the fields."""
        content = joined(*inside)
        self._shown_revision, self._content = self._revision, content
        mistake = self._mistake
        if mistake is not None and mistake.instead is None and mistake.is_over(content):
            mistake = self._mistake = None
        if mistake is not None:
            content += tag("p.no", f"✕ {mistake.why}", role="alert")
        # The page numbers what it sends: fields whose text is not in here yet keep it.
        marks = {"data_revision": self._revision, "data_heard": self._heard}
        adapter.set_content(self.html, tag("div", content, class_=self._class, **marks))


def _cut(said: object, longest: int) -> str:
    """Return a text that is not longer; what is no text a page of ours does not send, and it may be large."""
    return said[:longest] if isinstance(said, str) else ""


def _whole(text: str) -> str:
    """Return text without half characters, which could be kept but never sent to a page again."""
    return text.encode("utf-8", "replace").decode("utf-8")
