"""A picture that the page itself has to draw: a page that never sends it, or goes, holds up nobody."""

import logging
import sys
import threading
import time

from support.patience import Patience
from support.student import run, student


def waiting_for_pictures():
    return [thread for thread in threading.enumerate() if thread.name.startswith("armlab-renders")]


def test_a_page_that_never_sends_its_picture_holds_up_nobody_and_may_go(url, caplog):
    async def main():
        stranger = await student(url)
        await stranger.open("workspace")
        await stranger.press("sample")
        await stranger.until(lambda: 'data-cell="png"' in stranger.html())
        await stranger.press("png")
        await stranger.press("png")
        await stranger.until(lambda: any("still being made" in each for each in [stranger.html(), *stranger.notices]))
        assert waiting_for_pictures(), "what waits for a page is no thread that a newcomer needs"
        await stranger.close()
        other = await student(url)
        await other.close()

    with caplog.at_level(logging.WARNING):
        run(main())
        patience = Patience()
        while not _all_idle():
            assert patience.left(), "it still waits for a page that has gone"
            time.sleep(0.05)
    assert "no picture" not in caplog.text


def _all_idle():
    """Return whether none of these threads waits for a page any more."""
    frames = sys._current_frames()
    return all(frames[thread.ident].f_code.co_name == "_worker" for thread in waiting_for_pictures())
