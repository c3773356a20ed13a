"""Markup with the lab's own input fields, and the way back for the text that a student types."""

from __future__ import annotations

import json
import logging
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field

import viser
from markupsafe import escape

from armlab.content.notes import for_reader
from armlab.ui import adapter, markup
from armlab.ui.html import Inside, Markup, joined, tag

log = logging.getLogger(__name__)

OnInput = Callable[[str, str], None]
"""Callback that gets the cell and the typed or pressed text."""

LONGEST_CELL = 200
"""Largest number of characters in the name of a cell."""

LONGEST_TYPED = 20_000
"""Largest number of characters from a field, except those that read files; the longest table has fewer."""

SEEN, READ = 1.0, 8.0
"""Least time for which a sentence is shown, seconds: after another press, as on the way out of a field, and while other
content changes beside it."""

LARGEST_NUMBER = 2**53
"""Bound of the numbers of messages, below which they are exact in a page."""


@dataclass
class _Mistake:
    """An input that was refused.

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
        """Return whether the sentence has been shown for so many seconds."""
        return time.monotonic() - self._made > seconds

    def is_over(self, content: str) -> bool:
        """Return whether the content beside the sentence has changed, and there was time to read the sentence."""
        if self._beside is None:
            self._beside = content
        return self._beside != content and self.stood(READ)


class Fields:
    """Markup with the lab's own input fields, whose values arrive when Enter is pressed or the field is left.

    Make the fields with `field`; the page's script sends the typed text through a hidden text control.

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
    has_notes : bool
        Whether their reader has the course notes; see `armlab.content.notes`.

    Attributes
    ----------
    outdated : bool
        Whether the text that came last was meant for a question (an element with ``data-of``) that is not shown any
        more: its page had not heard of that when it was typed or pressed.
    """

    def __init__(
        self,
        gui: viser.GuiApi,
        on_input: OnInput,
        longest: int | None = None,
        scope: str = "",
        has_notes: bool = False,
    ) -> None:
        self._class, self._has_notes = f"al {scope}".rstrip(), has_notes
        self.channel = gui.add_text("channel", "", visible=False)
        self.html = gui.add_html("")
        self._on_input, self._longest, self.outdated = on_input, longest, False
        self._revision = self._shown_revision = self._heard = 0
        self._content, self._sent = Markup(), ""
        self._mistake: _Mistake | None = None
        self._remark: _Mistake | None = None
        self._made = set[str]()  # the fields made since the last `show`
        self._lock = threading.Lock()
        adapter.on_event(self.channel, "on_update", lambda _: self._receive())

    def _receive(self) -> None:
        try:
            cell, text, number, *of = json.loads(adapter.take_value(self.channel))
        except (ValueError, TypeError, RecursionError):
            log.warning("a page that is not ours wrote into a field")
            return
        self._heard = number if isinstance(number, int) and abs(number) < LARGEST_NUMBER else 0
        with self._lock:
            if self._mistake is not None and (self._mistake.cell == cell or self._mistake.stood(SEEN)):
                self._mistake = None
            self._remark = None
            self._revision += 1  # so that the next `show` also replaces a text that was not taken
        # Whatever else a page says of itself is of no question.
        self.outdated = any(isinstance(each, str) and f' data-of="{escape(each)}"' not in self._sent for each in of)
        longest = LONGEST_TYPED if self._longest is None else self._longest + 1
        cell, read = _whole(_cut(cell, LONGEST_CELL)), _whole(_cut(text, longest))
        if self._longest is None and isinstance(text, str) and len(text) > longest:
            self.refuse(cell, read, f"expected at most {longest} characters, got {len(text)}")
            self.show(self._content)
        else:
            self._on_input(cell, read)

    @property
    def stale(self) -> bool:
        """Whether the student has typed or pressed since the markup was shown, so that its content may be outdated."""
        return self._revision != self._shown_revision

    @property
    def channel_id(self) -> str:
        """Identifier to which buttons in the markup send their ``data-cell``; it belongs in their ``data-chan``."""
        return adapter.gui_id(self.channel)

    def refuse(self, cell: str, text: str, why: str) -> None:
        """Show the typed text as refused, with the reason below the fields.

        It stays until the next input, except one that follows at once elsewhere. The sentence of a field is removed
        when the field has another value or is gone; one of any other element when the markup changes and there was time
        to read.
        """
        self._mistake = _Mistake(cell, text[:LONGEST_TYPED], why)

    def refuse_later(self, cell: str, text: str) -> Callable[[str], bool]:
        """Return a function that refuses the text typed last, from any thread.

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

    def remark(self, text: str) -> None:
        """Show a sentence on what was typed below the fields, until the next input or a change when it could be read.

        Nothing is refused.
        """
        self._remark = _Mistake("", "", text)

    def forgive(self) -> None:
        """Show the fields with their valid values at the next `show`."""
        self._mistake = None

    def forgive_seen(self) -> None:
        """Do what an input of one's own does after one elsewhere on the page: forgive, unless it follows at once."""
        with self._lock:
            if self._mistake is not None and self._mistake.stood(SEEN):
                self._mistake = None
                self._revision += 1  # so that the next `show` is not left out

    def field(self, cell: str, value: str, label: str, disabled: bool = False, below: str = "", **more: str) -> Markup:
        """Return the markup of one input field; Enter goes on to the field ``below``; ``more`` attributes."""
        value, wrong = self._refused(cell, value)
        attributes = {"inputmode": "decimal", "data_below": below, **more, **wrong}
        return markup.field(self.channel_id, cell, value, label, disabled, **attributes)

    def area(self, cell: str, value: str, label: str, lines: int) -> Markup:
        """Return the markup of an input field of several lines, for a typed table."""
        value, wrong = self._refused(cell, value)
        return markup.area(self.channel_id, cell, value, label, lines, **wrong)

    def _refused(self, cell: str, value: str) -> tuple[str, dict[str, str]]:
        """Return the content of a field, and the attributes that mark it as refused."""
        self._made.add(cell)
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
        """Show or hide the whole element."""
        if self.html.visible != on:
            self.html.visible = on

    def show(self, *inside: Inside) -> None:
        """Show content that holds the fields."""
        content = joined(*inside)
        self._shown_revision, self._content = self._revision, content
        made, self._made = self._made, set()
        mistake = self._mistake
        if mistake is not None:
            in_field = mistake.instead is not None
            over = mistake.cell not in made if in_field else mistake.is_over(content)
            mistake = self._mistake = None if over else mistake
        if mistake is not None:
            content += tag("p.no", f"✕ {mistake.why}", role="alert")
        if self._remark is not None and self._remark.is_over(self._content):
            self._remark = None
        if self._remark is not None:
            content += tag("p.dim", self._remark.why, role="status")
        # The page numbers what it sends: fields whose text is not in here yet keep it.
        marks = {"data_revision": self._revision, "data_heard": self._heard}
        self._sent = for_reader(tag("div", content, class_=self._class, **marks), self._has_notes)
        adapter.set_content(self.html, self._sent)


def _cut(said: object, longest: int) -> str:
    """Return a text cut to a length; anything but text, which no page of the lab sends, becomes empty."""
    return said[:longest] if isinstance(said, str) else ""


def _whole(text: str) -> str:
    """Return text without halves of characters, which could be kept but never sent to a page again."""
    return text.encode("utf-8", "replace").decode("utf-8")
