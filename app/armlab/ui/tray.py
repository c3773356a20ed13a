"""The tray below the scene: the plots of the open page, large.

While it is closed nothing is sent or computed for it. While it is open the page says which plots it shows, with how
many points; of these each is sent when it has changed.
"""

from __future__ import annotations

import json
import logging
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import viser

from armlab.session.pages import pages
from armlab.session.parts.timeline import OpenClip, Seek, clips
from armlab.session.state import Post
from armlab.ui import adapter
from armlab.ui.fields import Fields
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.tray_picture import Picture

log = logging.getLogger(__name__)

FEWEST_POINTS, MOST_POINTS = 200, 6000
"""Bounds of the number of points of a curve for which a page may ask."""

MOST_SHOWN = 12
"""Largest number of plots that are sent."""


class Enlarged(Protocol):
    """A plot that the tray can show.

    Attributes
    ----------
    on : bool
        Whether it is seen on its page.
    file : str
        Name of its files, without an ending.
    title : markup
    drawn : object
        Another one each time the picture has changed.
    clip : str
        Key of the clip whose time is the abscissa; empty if it is another quantity.
    at : float or None
        Value of x that is marked.
    """

    on: bool
    file: str
    title: Inside
    drawn: object
    clip: str
    at: float | None

    def picture(self) -> Picture | None:
        """Return what is drawn; None while there is nothing."""

    def save(self) -> None:
        """Let the browser save the table of its curves."""


@dataclass(frozen=True)
class Look:
    """The wish of a page: plots by their keys, and the number of points of a curve."""

    keys: tuple[str, ...] = ()
    points: int = FEWEST_POINTS


class Tray:
    """The tray of one browser.

    Parameters
    ----------
    client : viser.ClientHandle
    post : callable
    again : callable
        Shows the present state once more.
    """

    def __init__(self, client: viser.ClientHandle, post: Post, again: Callable[[], None]) -> None:
        self._gui, self._post, self._again = client.gui, post, again
        self._form = Form(lambda on_input: Fields(client.gui, on_input), lambda _: None, again, beside=False)
        self._mark = client.gui.add_html("")
        self._slots: list[_Slot] = []
        self._plots: dict[str, Enlarged] = {}
        self._page, self._asked = "", ("", 0)
        self._wanted: Enlarged | None = None
        self._look = Look()

    def open(self, page: str, plot: Enlarged) -> None:
        """Open the tray with a plot of a page."""
        self._page, self._wanted = page, plot
        self._again()

    def follow(self) -> None:
        """Show what a page has changed by itself, which is in no state."""
        if self._page:
            self._again()

    def show(self, opened: Mapping[str, Sequence[Enlarged]]) -> None:
        """Show what has changed.

        Parameters
        ----------
        opened : mapping of str to sequence of Enlarged
            The plots of the pages that are open, by the keys of these. The tray is closed when its page is.
        """
        if not self._page:
            return
        if self._page not in opened:
            self._close("")
            return
        self._plots = _by_key(opened[self._page])
        self._show_head()
        keys = [key for key in self._look.keys if key in self._plots]
        while len(self._slots) < len(keys):
            self._slots.append(_Slot(self._gui.add_html("")))
        for i, slot in enumerate(self._slots):
            if i < len(keys):
                slot.show(keys[i], self._plots[keys[i]], self._look.points)
            else:
                slot.clear()
        at = {key: self._plots[key].at for key in keys if not self._plots[key].clip}
        adapter.set_content(self._mark, tag("i", hidden=True, data_tray_at=json.dumps(at)))

    def _show_head(self) -> None:
        """Tell the page which plots there are, and with which to begin."""
        if self._wanted is not None:
            key = next((key for key, plot in self._plots.items() if plot is self._wanted), "")
            self._asked, self._wanted = (key, self._asked[1] + 1), None
        listed = [
            {"key": key, "title": _plain(plot.title), "clip": plot.clip, "file": plot.file}
            for key, plot in self._plots.items()
        ]
        head = {"page": pages()[self._page].name, "asked": self._asked, "plots": listed, "chan": self._form.channel_id}
        self._form.takes("close", self._close)
        self._form.takes("look", self._look_at)
        self._form.takes("csv", self._save)
        self._form.takes("clip", self._open_clip)
        self._form.show(tag("i", id="al-tray", hidden=True, data_tray=json.dumps(head)))

    # -- what the page says --------------------------------------------------------------------------------------

    def _close(self, _: str) -> None:
        self._page, self._plots, self._look = "", {}, Look()
        self._form.show()
        adapter.set_content(self._mark, Markup())
        for slot in self._slots:
            slot.clear()

    def _look_at(self, text: str) -> None:
        try:
            said = json.loads(text)
            keys = tuple(str(key) for key in said["keys"][:MOST_SHOWN])
            points = min(max(int(said["points"]), FEWEST_POINTS), MOST_POINTS)
        except (ValueError, TypeError, KeyError, OverflowError):
            log.warning("a page that is not ours told of its tray")
            return
        self._look = Look(keys, points)

    def _save(self, key: str) -> tuple[()]:
        if key in self._plots:
            self._plots[key].save()
        return ()

    def _open_clip(self, text: str) -> tuple[()]:
        """Open the clip of a plot at the time at which a hand points: a clip at its start has no bar on other pages."""
        try:
            said = json.loads(text)
            plot, time = self._plots.get(str(said["key"])), float(said["time"])
        except (ValueError, TypeError, KeyError, OverflowError):
            log.warning("a page that is not ours asked for a clip")
            return ()
        if plot is not None and plot.clip in clips() and math.isfinite(time):
            self._post(OpenClip(plot.clip))
            self._post(Seek(time))
        return ()


class _Slot:
    """A place of the page that holds one plot."""

    def __init__(self, handle: Any) -> None:
        self._handle = handle
        self._holds: tuple[object, ...] = ()

    def show(self, key: str, plot: Enlarged, points: int) -> None:
        """Send a plot unless it is there already."""
        holds = (key, plot, plot.drawn, points)
        if len(holds) == len(self._holds) and all(a is b or a == b for a, b in zip(holds, self._holds, strict=True)):
            return
        self._holds = holds
        picture = plot.picture()
        if picture is None:
            adapter.set_content(self._handle, Markup())
            return
        looks, numbers = picture.described(points)
        mark = tag("i", hidden=True, data_tray_plot=key, data_picture=json.dumps(looks), data_numbers=numbers)
        adapter.set_content(self._handle, mark)

    def clear(self) -> None:
        """Send nothing more."""
        if self._holds:
            self._holds = ()
            adapter.set_content(self._handle, Markup())


def _by_key(plots: Sequence[Enlarged]) -> dict[str, Enlarged]:
    """Return the plots that are seen by their files, which are numbered where two have the same."""
    found: dict[str, Enlarged] = {}
    for plot in plots:
        if plot.on:
            key, number = plot.file, 1
            while key in found:
                number += 1
                key = f"{plot.file} {number}"
            found[key] = plot
    return found


_OVER = {ord("˙"): "\u0307", ord("¨"): "\u0308"}
"""Dots as formulas have them, apart from the letter, and as they combine with it."""


def _plain(title: Inside) -> str:
    """Return a title without its elements; a dot that a formula has over a letter combines with it."""
    return joined(title).striptags().translate(_OVER)
