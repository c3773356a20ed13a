"""Markup whose buttons, choices and fields carry their actions: commands, or functions from a text to commands."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

from armlab.errors import InputError
from armlab.session.session import Asked, Refuse, cut
from armlab.session.state import Command, Post
from armlab.teaching.shown_step import MOVED_ON
from armlab.ui import markup
from armlab.ui.fields import Fields, OnInput
from armlab.ui.html import Attribute, Inside, Markup, joined
from armlab.ui.remarks import remarks

Wish = Command | Sequence[Command] | None
"""Result of an action: commands, of which all are done or none; None if only this page has changed."""

Pressed = Command | Sequence[Command] | Callable[[], Wish]
"""Action of a button: commands, or a function that returns them or changes the page itself."""

Typed = Callable[[str], Wish]
"""Action of a field or a choice, which gets its text; an `InputError` is shown at the field."""

Picked = Callable[[float, float, int], Wish]
"""Action of a place, given in parts of its box from the upper left, and the number of the drag, 0 for a click."""


class Marks(dict[str, Attribute]):
    """Attributes of an element, for unpacking into `tag`."""


class Form:
    """Markup with controls that carry their actions.

    Controls made between two calls of `show` belong to the second call, and only those can be pressed or filled: a cell
    that is not on the page, disabled, or not among the options does nothing. A refusal, of a text by the form or of a
    command by the worker, is shown at the control that sent it, with the text as it was typed; remarks on a text
    (`armlab.ui.remarks`) stand below it.

    Parameters
    ----------
    make : callable
        Makes the `Fields` that hand cell and text to what it is given.
    post : callable
        Hands a command to the worker.
    again : callable
        Shows once more the page it is on.
    beside : bool
        Whether there is room for a refusal; otherwise it is a notice.
    """

    def __init__(
        self, make: Callable[[OnInput], Fields], post: Post, again: Callable[[], None], beside: bool = True
    ) -> None:
        self._fields, self._post, self._again, self._beside = make(self._asked), post, again, beside
        self._of: object = None
        self._bound: dict[str, Typed] = {}
        self._binding: dict[str, Typed] = {}
        self._drags: set[str] = set()

    @property
    def channel_id(self) -> str:
        """Identifier to which the page's script sends a text of its own; see `takes`."""
        return self._fields.channel_id

    @property
    def stale(self) -> bool:
        """Whether the student has typed or pressed since the markup was shown; see `Fields.stale`."""
        return self._fields.stale

    def forgive(self) -> None:
        """Show the fields with their valid values at the next `show`."""
        self._fields.forgive()

    # -- what can stand in the markup ----------------------------------------------------------------------------

    def button(
        self,
        cell: str,
        inside: Inside,
        action: Pressed,
        kind: str = "",
        hint: str = "",
        label: str = "",
        pressed: bool | None = None,
        off: bool = False,
        **more: str,
    ) -> Markup:
        """Return a button; see `markup.button`. One that is off cannot be pressed."""
        self._press(cell, action, off)
        return markup.button(self._fields.channel_id, cell, inside, kind, hint, label, pressed, off, **more)

    def chip(
        self, cell: str, text: str, action: Pressed, hint: str = "", pressed: bool | None = None, off: bool = False
    ) -> Markup:
        """Return a small button with a text."""
        self._press(cell, action, off)
        return markup.chip(self._fields.channel_id, cell, text, hint, pressed, off)

    def chips(self, name: str, texts: Mapping[str, str], chosen: str, hint: str, action: Typed) -> Markup:
        """Return a chip for each option, key to text, with cells ``name key``; the action gets the key."""
        return joined(
            self.chip(f"{name} {key}", text, _with(action, key), hint, key == chosen) for key, text in texts.items()
        )

    def select(
        self, cell: str, label: str, texts: Mapping[str, str], chosen: str, action: Typed, hint: str = ""
    ) -> Markup:
        """Return a choice among options, key to text; the action gets the key. An empty key chooses nothing."""
        self._binding[cell] = lambda key: action(key) if key and key in texts else ()
        return markup.select(self._fields.channel_id, cell, label, markup.options(texts, chosen), hint)

    def select_in_groups(
        self, cell: str, label: str, groups: Mapping[str, Mapping[str, str]], chosen: str, action: Typed
    ) -> Markup:
        """Return a choice among options in groups, title to key to text; the action gets the key."""
        known = {key for texts in groups.values() for key in texts}
        self._binding[cell] = lambda key: action(key) if key in known else ()
        return markup.select(self._fields.channel_id, cell, label, markup.groups(groups, chosen))

    def field(
        self, cell: str, value: str, label: str, action: Typed, below: str = "", off: bool = False, **more: str
    ) -> Markup:
        """Return a field; Enter goes on to the field ``below``; ``more`` attributes. The action gets the text."""
        if not off:
            self._binding[cell] = action
        return self._fields.field(cell, value, label, off, below, **more)

    def area(self, cell: str, value: str, label: str, lines: int, action: Typed) -> Markup:
        """Return a field of several lines. The action gets the text."""
        self._binding[cell] = action
        return self._fields.area(cell, value, label, lines)

    def place(self, cell: str, action: Picked, drag: bool = False) -> Marks:
        """Return the attributes of an element that can be clicked at a place or, with ``drag``, dragged.

        See `moved` for the commands of a drag.
        """
        bind = self.moved if drag else self.bound
        return Marks(bind(cell, lambda text: action(*_place(text))), data_pick="drag" if drag else True)

    def bound(self, cell: str, action: Typed) -> Marks:
        """Return the attributes of an element of the caller's own that sends a text."""
        self.takes(cell, action)
        return Marks(data_chan=self._fields.channel_id, data_cell=cell)

    def moved(self, cell: str, action: Typed) -> Marks:
        """Return the attributes of an element that sends texts while a hand moves something.

        Its commands wait by themselves, so that a newer one may replace them; a refusal of theirs is a notice.
        """
        self._drags.add(cell)
        return self.bound(cell, action)

    def takes(self, cell: str, action: Typed) -> None:
        """Bind a text that the page's script sends by itself."""
        self._binding[cell] = action

    def shows(self, *of: object) -> bool:
        """Return whether the form shows markup made of the same objects, and nothing was typed or pressed since.

        Then it need not be made again. Whoever asks makes it of these things alone.
        """
        same = of == self._of and not self.stale
        self._of = of
        return same

    # -- what comes of it ----------------------------------------------------------------------------------------

    def show(self, *inside: Inside) -> None:
        """Show content; the controls made since the last call are the ones that can be used from now on."""
        self._bound, self._binding = self._binding, {}
        self._fields.show(*inside)

    def _refused(self, cell: str, text: str, why: str) -> Wish:
        """Show the reason of a refusal, at the field or in a notice."""
        if self._beside:
            self._fields.refuse(cell, text, cut(why))
            return None
        return Refuse(why)

    def visible(self, on: bool) -> None:
        """Show or hide the whole form."""
        self._fields.visible(on)

    def _press(self, cell: str, action: Pressed, off: bool) -> None:
        if not off:
            self._binding[cell] = lambda _: action() if callable(action) else action

    def _asked(self, cell: str, text: str) -> None:
        action = self._bound.get(cell)
        if self._fields.outdated:
            self._post(Refuse(MOVED_ON))
            return
        if action is None:
            return
        with remarks() as said:
            try:
                wish = action(text)
            except InputError as refusal:
                wish = self._refused(cell, text, str(refusal))
        if said and self._beside:
            self._fields.remark(said[0])
        if wish is None:
            self._again()
            return
        asked = (wish,) if isinstance(wish, Command) else tuple(wish)
        if cell in self._drags or not self._beside:
            for command in asked:
                self._post(command)
        elif asked:
            refuse = self._fields.refuse_later(cell, text)
            self._post(Asked(asked, refuse))


def _with(action: Typed, key: str) -> Callable[[], Wish]:
    return lambda: action(key)


def _place(text: str) -> tuple[float, float, int]:
    """Return a place sent by a page; `InputError` if its text is none."""
    try:
        x, y, *drag = (float(each) for each in text.split(","))
        number = int(drag[0]) if drag else 0
    except (ValueError, OverflowError):
        raise InputError(f"expected a place, got {text[:40]!r}") from None
    if len(drag) > 1 or not math.isfinite(x + y):
        raise InputError(f"expected a place, got {text[:40]!r}")
    return x, y, number
