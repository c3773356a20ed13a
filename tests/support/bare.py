"""A viser server made by the adapter, with one student and hardly anything on the page."""

from __future__ import annotations

import asyncio
import threading
from contextlib import ExitStack

from aiohttp import web

from armlab.front.direct import DirectLine
from armlab.front.limits import Limits, Meter
from armlab.running_loop import running_loop
from armlab.ui import adapter
from armlab.ui.manners import Manners
from support.fake_browser import FakeBrowser
from support.student import run

SAID = {"X-Armlab-Token": "token"}
"""What is said of its student."""


class Bare:
    """A viser server with one student, a slider, some markup and a handle."""

    def __init__(self):
        self.heard, self.client, self.manners = [], None, Manners()
        self.there = threading.Event()
        self._opened = ExitStack()
        loop = self._opened.enter_context(running_loop("bare"))
        self.server, serve = adapter.make_server(loop, self.manners)
        self._line, self._meter = DirectLine(serve, Limits()), Meter(Limits())
        self.server.on_client_connect(self._build)
        self._runner = asyncio.run_coroutine_threadsafe(self._listen(), loop).result()
        self._opened.callback(lambda: asyncio.run_coroutine_threadsafe(self._runner.cleanup(), loop).result())
        self._opened.callback(adapter.stop_server, self.server)

    async def _listen(self):
        app = web.Application()
        app.router.add_get("/", self._visit)
        runner = web.AppRunner(app, shutdown_timeout=0.1)
        await runner.setup()
        await web.TCPSite(runner, "127.0.0.1", 0).start()
        return runner

    async def _visit(self, request):
        return (await self._line.serve(request, SAID, self._meter)).response

    def stop(self):
        """End the server."""
        self._opened.close()

    async def _build(self, client):
        self.client = client
        self.slider = client.gui.add_slider("Joint", -1.0, 1.0, 0.01, 0.0)
        self.markup = client.gui.add_html("before")
        self.frame = client.scene.add_frame("/frame")
        self.handle = client.scene.add_transform_controls("/target")
        adapter.on_event(self.slider, "on_update", lambda event: self.heard.append(event.target.value))
        adapter.on_event(self.handle, "on_update", lambda event: self.heard.append(event.phase))
        self.there.set()

    def run(self, work):
        """Run ``work(browser, do)`` with a connected browser; ``do`` calls something on viser's loop."""
        loop = self.server.get_event_loop()

        async def do(function):
            async def there():
                found = function()
                self.client.flush()
                return found

            return await asyncio.wrap_future(asyncio.run_coroutine_threadsafe(there(), loop))

        async def main():
            browser = FakeBrowser(f"http://127.0.0.1:{self._runner.addresses[0][1]}", None)
            await browser.connect()
            await browser.until(lambda: "/target" in browser.nodes and self.there.is_set())
            await work(browser, do)
            await browser.close()

        run(main())
