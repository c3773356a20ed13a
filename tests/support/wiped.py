"""A page that is given to the next person without being loaded again: the lab forgets, and builds all of it anew."""

from __future__ import annotations

import asyncio
from typing import Any
from urllib.parse import urlsplit

from armlab.session.panel_commands import OpenWindow
from armlab.session.parts.panels import Panels, Window
from armlab.session.session import StartFresh
from armlab.session.state import Command
from armlab.ui.wished import wished
from support.at_rest import OPEN
from support.page import LabPage
from support.patience import WAIT, Patience

MARKS = """() => JSON.stringify([
  [...document.documentElement.attributes].map(each => [each.name, each.value]).filter(([name]) => name !== 'style'),
  document.querySelectorAll('[data-floating-window], dialog[open], [role=dialog]').length,
  document.querySelectorAll('[data-dock-region=right] [data-dock-strip]').length,
  { ...localStorage }, { ...sessionStorage },
  Object.keys(window).filter(name => isNaN(name)).sort(), ...[requestAnimationFrame, setTimeout].map(String),
])"""
"""What a page keeps for itself, unknown to the lab: how it is laid out, what covers it, what it has stored.

Also what a test has put into it.
"""

BLURRED = "() => document.activeElement?.blur()"


def wipe(lab: LabPage, wish: str) -> None:
    """Let the lab of a page forget all that was done there, and grant it the wish of another link, if any.

    Of what the page showed nothing stays: panels, and all that is drawn, go and are made anew.
    """
    running = next(each.lab for each in OPEN if each.port == urlsplit(lab.url).port)
    asyncio.run_coroutine_threadsafe(_begin_anew(running, wish), running.loop).result(WAIT)  # type: ignore[union-attr]
    lab.page.mouse.move(-1, -1)
    lab.page.evaluate(BLURRED)
    lab.tab("Joints").click()
    lab.ready()
    lab.dismiss_toasts()


async def _begin_anew(lab: Any, wish: str) -> None:
    view = await _only_view(lab)
    first = OpenWindow(view.client.client_id, Window.on("joints"))
    for command in (StartFresh(), first):
        await _done(lab, view, command)
    await _done(lab, view, wished(view.session.state, wish))
    lab.runner.forget(view.session)
    assert len(view.session.state[Panels].windows) == 1
    with view.client.atomic():
        for tab in view._tabs.values():
            tab._gui.clear()
            tab._built, tab._show, tab._shown = "", None, None
        view._robot = view._shown = None
        view.show()


async def _only_view(lab: Any) -> Any:
    """Return the page that is left once the lab knows that all others have gone."""
    patience = Patience()
    while len(lab._views) != 1:
        assert patience.left(), "more than one page is open, or none"
        await asyncio.sleep(0.01)
    return next(iter(lab._views.values()))


async def _done(lab: Any, view: Any, command: Command | None) -> None:
    """Wait until the worker has done a command."""
    if command is not None:
        lab.worker.post(view.session, command, view.client.client_id)
    while not lab.worker.idle:
        await asyncio.sleep(0.002)
