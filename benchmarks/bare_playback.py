"""The judge of our playback: the bare viser server that moves the joints of its first client 60 times a second."""

import asyncio
import threading
import time

import numpy as np
import viser

import bare_server
from swinging import moved

AT = np.array([0.5, 0.0, 0.5])
"""Where the sphere of the first client stays, m."""


class Playing(bare_server.Student):
    first = True

    def __init__(self, client: viser.ClientHandle, wake: threading.Event, waiting: dict) -> None:
        super().__init__(client, wake, waiting)
        if Playing.first:
            Playing.first = False
            loop = client._viser_server.get_event_loop()
            threading.Thread(target=self.play, args=(loop,), daemon=True).start()

    def play(self, loop: asyncio.AbstractEventLoop) -> None:
        began = time.perf_counter()
        while True:
            now = time.perf_counter() - began
            loop.call_soon_threadsafe(self.write, AT, moved(now))
            time.sleep(max(0.0, began + now + 1 / 60 - time.perf_counter()))


if __name__ == "__main__":
    bare_server.Student = Playing
    bare_server.main()
