"""A viser server made by the adapter, with one student and hardly anything on the page."""

from __future__ import annotations

import asyncio
import threading

from armlab.ui import adapter
from support.fake_browser import FakeBrowser
from support.student import run


class Bare:
    """A viser server with one student, a slider, some markup and a handle."""

    def __init__(self):
        self.server = adapter.make_server(0)
        self.heard, self.client = [], None
        self.there = threading.Event()
        self.server.on_client_connect(self._build)

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
            browser = FakeBrowser(f"http://127.0.0.1:{self.server.get_port()}", None)
            await browser.connect()
            await browser.until(lambda: "/target" in browser.nodes and self.there.is_set())
            await work(browser, do)
            await browser.close()

        run(main())
