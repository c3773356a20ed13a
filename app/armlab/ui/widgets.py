"""The controls of a panel, all made here: callbacks get only what a student does, never the lab's own writes."""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, cast

import viser

from armlab.content.languages import ENGLISH
from armlab.content.notes import for_reader
from armlab.errors import in_one_line
from armlab.session.state import Post
from armlab.ui import adapter, markup
from armlab.ui.camera import Camera
from armlab.ui.fields import Fields
from armlab.ui.form import Form
from armlab.ui.html import Inside, tag
from armlab.ui.png import rgba_png
from armlab.ui.tray import Enlarged, Tray

log = logging.getLogger(__name__)

REST = 0.4
"""Time after a student's last touch before the lab writes to the same control, seconds, so that it does not pull at
it."""

LINGER = 2.0
"""Time for which the channels of replaced fields still accept input that is on its way, seconds."""


class Control:
    """A control with a value.

    Parameters
    ----------
    handle : viser handle
    on_change : callable
        Called with the value that the student has set.
    """

    def __init__(self, handle: Any, on_change: Callable[[Any], None]) -> None:
        self.handle = handle
        self._touched = 0.0
        self._later: asyncio.TimerHandle | None = None
        adapter.on_event(handle, "on_update", lambda _: self._change(on_change))

    def _change(self, on_change: Callable[[Any], None]) -> None:
        self._touched = time.monotonic()
        self._write_no_longer()
        on_change(self.handle.value)

    def _write_no_longer(self) -> None:
        if self._later is not None:
            self._later.cancel()
            self._later = None

    def show(self, value: Any) -> None:
        """Show a value; while the student is moving the control, show it when it has come to rest."""
        self._write_no_longer()
        wait = self._touched + REST - time.monotonic()
        if wait > 0.0 and self.handle.value != value:
            self._later = asyncio.get_running_loop().call_later(wait, adapter.set_value, self.handle, value)
        else:
            adapter.set_value(self.handle, value)

    def visible(self, on: bool) -> None:
        """Show or hide the control."""
        if self.handle.visible != on:
            self.handle.visible = on

    def span(self, label: str, low: float, high: float, step: float) -> None:
        """Give a slider a label and a range."""
        handle = self.handle
        if (handle.label, handle.min, handle.max) != (label, low, high):
            handle.label, handle.min, handle.max, handle.step = label, low, high, step

    def enable(self, on: bool) -> None:
        """Enable or disable the control."""
        if self.handle.disabled == on:
            self.handle.disabled = not on


class Choice(Control):
    """A drop-down of named options; values are the keys."""

    def __init__(self, handle: Any, options: Mapping[str, str], on_change: Callable[[str], None]) -> None:
        self._titles = dict(options)
        keys = {title: key for key, title in options.items()}
        super().__init__(handle, lambda title: on_change(keys[title]))

    def show(self, value: str) -> None:
        """Show the option with this key."""
        super().show(self._titles[value])


class Html:
    """A piece of markup, which is sent only when it changes.

    Parameters
    ----------
    handle : viser html handle
    scope : str
        Class whose style it has besides the common one.
    has_notes : bool
        Whether its reader has the course notes; see `armlab.content.notes`.
    """

    def __init__(self, handle: Any, scope: str = "", has_notes: bool = False) -> None:
        self.handle, self._class, self._has_notes = handle, f"al {scope}".rstrip(), has_notes

    def show(self, *inside: Inside) -> None:
        """Show new content."""
        adapter.set_content(self.handle, for_reader(tag("div", *inside, class_=self._class), self._has_notes))

    def visible(self, on: bool) -> None:
        """Show or hide the element."""
        if self.handle.visible != on:
            self.handle.visible = on


class Fold:
    """A part of a panel that a person folds and unfolds; whether it is open only the page knows."""

    def __init__(self, head: Html, holder: Any) -> None:
        self._head, self._holder = head, holder

    def visible(self, on: bool) -> None:
        """Show or hide all of it, with its head."""
        self._head.visible(on)
        if self._holder.visible != on:
            self._holder.visible = on


def _remove(handles: Sequence[Any]) -> None:
    for handle in reversed(handles):
        if not adapter.is_removed(handle):
            handle.remove()


class Segments:
    """A row of choices of which one is chosen."""

    def __init__(self, fields: Fields, label: str, options: Mapping[str, str], hint: str) -> None:
        self._fields, self._label, self._options, self._hint = fields, label, options, hint

    def show(self, value: str) -> None:
        """Mark the chosen one."""
        chips = markup.chips(self._fields.channel_id, self._options, value, self._hint)
        self._fields.show(markup.row(self._label, chips, wide=True, hint=self._hint))

    def visible(self, on: bool) -> None:
        """Show or hide the row."""
        self._fields.visible(on)


class Gui:
    """The maker of all controls of one panel, which can remove them again.

    Attributes
    ----------
    camera : Camera
        The camera of this browser.
    open_panel : callable
        Brings a panel to the front, by its key.
    scope : str
        Class under which the stylesheets of the bench hold.
    has_notes : bool
        Whether the reader has the course notes; see `armlab.content.notes`. It holds for what is made from then on.
    again : callable
        Shows once more what these controls belong to: something has changed, or was refused, that is in no state.
    page : str
        Key of the page to which the controls belong.
    plots : list of Enlarged
        Its plots.
    tray : Tray or None
        Where they are shown large.
    language : str
        Key of the language in which they are read: texts that are shown are said in it by themselves, a saved file
        to read has to be.
    """

    def __init__(self, client: viser.ClientHandle, camera: Camera, open_panel: Callable[[str], None]) -> None:
        self._client, self._gui, self.camera, self.open_panel = client, client.gui, camera, open_panel
        self.scope, self.has_notes, self.language = "", False, ENGLISH
        self.again: Callable[[], None] = lambda: None
        self.page, self.plots, self.tray = "", list[Enlarged](), cast(Tray | None, None)
        self._made: list[Any] = []
        self._channels: list[Any] = []
        self._fields: list[Fields] = []
        self._drawing: set[asyncio.Task[None]] = set()

    @property
    def window(self) -> int:
        """The number of the window of the browser in which the controls are."""
        return self._client.client_id

    @property
    def origin(self) -> str:
        """The address under which this browser knows the lab, without a slash at its end."""
        return adapter.said_by_front(self._client, adapter.ORIGIN_HEADER)

    @property
    def reader(self) -> tuple[str, str]:
        """The token of this browser, and the address that it comes from."""
        return (
            adapter.said_by_front(self._client, adapter.TOKEN_HEADER),
            adapter.said_by_front(self._client, adapter.ADDRESS_HEADER),
        )

    def clear(self, linger: bool = False) -> None:
        """Remove all controls; if they linger, a button pressed just before still works."""
        _remove(self._made)
        if linger:
            asyncio.get_running_loop().call_later(LINGER, _remove, self._channels)
        else:
            _remove(self._channels)
        self._made, self._channels, self._fields, self.plots = [], [], [], []

    def _keep(self, handle: Any) -> Any:
        self._made.append(handle)
        return handle

    def slider(
        self,
        label: str,
        low: float,
        high: float,
        step: float,
        value: float,
        on_change: Callable[[float], None],
        hint: str | None,
    ) -> Control:
        """Add a slider with its number box; a hint appears over the control above it."""
        return Control(self._keep(self._gui.add_slider(label, low, high, step, value, hint=hint)), on_change)

    def checkbox(self, label: str, value: bool, on_change: Callable[[bool], None], hint: str) -> Control:
        """Add a check box."""
        return Control(self._keep(self._gui.add_checkbox(label, value, hint=hint)), on_change)

    def dropdown(
        self, label: str, options: Mapping[str, str], value: str, on_change: Callable[[str], None], hint: str
    ) -> Choice:
        """Add a drop-down; ``options`` maps keys to texts."""
        options = {key: for_reader(text, self.has_notes) for key, text in options.items()}
        hint = for_reader(hint, self.has_notes)
        handle = self._gui.add_dropdown(label, tuple(options.values()), initial_value=options[value], hint=hint)
        return Choice(self._keep(handle), options, on_change)

    def buttons(self, label: str, names: Sequence[str], on_click: Callable[[str], None], hint: str) -> None:
        """Add a row of buttons."""
        handle = self._keep(self._gui.add_button_group(label, tuple(names), hint=hint))
        adapter.on_event(handle, "on_click", lambda _: on_click(handle.value))

    def segments(
        self, label: str, options: Mapping[str, str], value: str, on_change: Callable[[str], None], hint: str
    ) -> Segments:
        """Add a row of choices; ``options`` maps keys to texts."""
        segments = Segments(self.fields(lambda key, _: on_change(key)), label, options, hint)
        segments.show(value)
        return segments

    def confirm(
        self,
        title: str,
        text: Inside,
        yes: str,
        on_yes: Callable[[], None],
        more: Inside = None,
        no: str = "No, go back",
    ) -> Callable[[], None]:
        """Ask for confirmation of an action that cannot be undone; below a paragraph there may be more.

        Returns a function that takes the question away, if it is still there.
        """
        modal = self._gui.add_modal(title)

        def close() -> None:
            if not modal.closed:
                modal.close()

        def agreed() -> None:
            close()
            on_yes()

        with modal:
            asked = Form(lambda on_input: Fields(self._gui, on_input), lambda command: None, lambda: None)
            # The way back is the one that stands out, has the focus, and is the Escape key.
            back = asked.button("confirm-no", no, close, "main", data_escape="1", data_autofocus="1")
            asked.show(tag("p", text), more, tag("div.bar", back, asked.chip("confirm-yes", yes, agreed)))
        return close

    def button(self, label: str, on_click: Callable[[], None], hint: str, icon: viser.IconName | None = None) -> Any:
        """Add a button; returns the handle, whose ``visible`` and ``label`` may be set."""
        handle = self._keep(self._gui.add_button(label, hint=hint, icon=icon))
        adapter.on_event(handle, "on_click", lambda _: on_click())
        return handle

    def html(self, *inside: Inside) -> Html:
        """Add markup."""
        element = Html(self._keep(self._gui.add_html("")), self.scope, self.has_notes)
        element.show(*inside)
        return element

    def heading(self, *inside: Inside) -> None:
        """Add a heading."""
        self.html(tag("h3", *inside))

    def fields(self, on_input: Callable[[str, str], None], longest: int | None = None) -> Fields:
        """Add markup with input fields; ``on_input`` gets the cell and the text; see `Fields`."""

        def heard(cell: str, text: str) -> None:
            if self.page:  # on a bench all forms are about the same values
                for each in self._fields:
                    if each is not fields:
                        each.forgive_seen()
            on_input(cell, text)

        fields = Fields(self._gui, heard, longest, self.scope, self.has_notes)
        self._fields.append(fields)
        self._channels.append(fields.channel)
        self._keep(fields.html)
        return fields

    def form(self, post: Post, longest: int | None = None) -> Form:
        """Add markup whose controls carry their actions; see `Form`, and `Fields` for the longest text."""
        return Form(lambda on_input: self.fields(on_input, longest), post, lambda: self.again())

    def enlarges(self, plot: Enlarged) -> Callable[[], None]:
        """Take a plot among those of the page; returns a function that shows it large."""
        self.plots.append(plot)

        def enlarge() -> None:
            if self.tray is not None:
                self.tray.open(self.page, plot)

        return enlarge

    def uplot(self, data: tuple[Any, ...], series: tuple[Any, ...], x: str, height: int) -> Any:
        """Add the bare chart of a `Plot`; returns the handle."""
        axis = {"font": "11px sans-serif", "labelFont": "11px sans-serif", "labelSize": 16, "labelGap": 0}
        # Lines that are seen on light and dark ground alike, which viser's own are not.
        axis |= {"ticks": {"width": 1, "size": 5}, "grid": {"width": 1, "stroke": "rgb(128 140 155 / .25)"}}
        axes: Any = ({**axis, "label": x, "size": 26}, {**axis, "size": 46, "space": 24})
        return self._keep(
            self._gui.add_uplot(
                data,
                series,
                scales={"x": {"time": False}},
                axes=axes,
                legend={"show": False},
                height=height,
                padding=(6, 10, 0, 0),
            )
        )

    def save(self, name: str, content: str | bytes) -> None:
        """Let the browser save a file: a text, or bytes."""
        data = content.encode() if isinstance(content, str) else content
        self._client.send_file_download(name, data, save_immediately=True)

    def save_picture(self, name: str, on_failure: Callable[[str], None]) -> None:
        """Let the browser draw the scene without the layers over it, and save that as a PNG file."""
        if self._drawing:
            on_failure("the last picture is still being made")
            return

        async def draw() -> None:
            try:
                pixels = await adapter.picture_of(self._client)
            except Exception as failure:
                if adapter.has_gone(self._client):
                    return
                log.error("no picture: %s", in_one_line(failure))
                on_failure(f"the picture could not be made: {failure}")
            else:
                self.save(name, rgba_png(pixels))

        task = asyncio.get_running_loop().create_task(draw())
        self._drawing.add(task)
        task.add_done_callback(self._drawing.discard)

    @contextmanager
    def fold(self, title: Inside, opened: bool = False) -> Iterator[Fold]:
        """Put the controls made inside into a part of the panel that a person folds and unfolds."""
        head = self.html(markup.fold(title, opened=opened, kind="kit-holds"))
        # The page's style leaves of the folder only that it holds what is inside; see `kit.css`.
        holder = self._keep(self._gui.add_folder(""))
        with holder:
            yield Fold(head, holder)
