"""Playback in a real browser: how many poses a second a student sees, and how true to the clock it is."""

from collections.abc import Iterator

from playwright.sync_api import Browser

import servers
from support.page import LabPage, chromium

TITLE = "Playback of the film: poses shown in Chromium with a software renderer"
WINDOWS = ((640, 420), (1400, 850))
SECONDS = 4.0
WATCH = """([name, seconds]) => new Promise(done => {
  const node = window.__viserMutable.nodeRefFromName[name];
  const began = performance.now();
  let last = '', poses = -1, frames = 0;
  const look = now => {
    frames += 1;
    const pose = [...node.position.toArray(), ...node.quaternion.toArray()].join();
    if (pose !== last) { poses += 1; last = pose; }
    if (now - began < 1000 * seconds) requestAnimationFrame(look);
    else done([poses, frames, (now - began) / 1000]);
  };
  requestAnimationFrame(look);
})"""


def measure() -> Iterator[str]:
    yield "| window, shadows | poses a second shown | pictures a second drawn | clock: film ÷ wall |"
    yield "| --- | --- | --- | --- |"
    with chromium() as browser:
        for window in WINDOWS:
            for shadows in (True, False):
                with servers.lab() as server:
                    poses, frames, clock = played(browser, server.url, window, shadows)
                size = f"{window[0]} x {window[1]}, {'on' if shadows else 'off'}"
                yield f"| {size} | {poses:.0f} | {frames:.0f} | {clock:.3f} |"


def played(browser: Browser, url: str, window: tuple[int, int], shadows: bool) -> tuple[float, float, float]:
    """Play the film; return poses and pictures a second, and how much faster than the wall's its clock runs."""
    with browser.new_context() as context:
        lab = LabPage(context, url, window)
        if not shadows:
            lab.open_tab("View")
            lab.page.get_by_label("Shadows").click()
        lab.open_tab("Robot")
        lab.press("film")
        lab.page.locator(".al-time").wait_for()
        lab.rest()
        lab.page.locator(".al-time button[data-cell=play]").click()
        lab.page.wait_for_timeout(500)
        before, poses, frames, seconds, after = (
            shown_time(lab),
            *lab.page.evaluate(WATCH, [lab.node("/film/moving"), SECONDS]),
            shown_time(lab),
        )
        return poses / seconds, frames / seconds, (after - before) / seconds


def shown_time(lab: LabPage) -> float:
    """Return the seconds on the bar; when it is made anew they are missing for a moment."""
    lab.page.wait_for_function("() => document.querySelector('.al-time .now')?.textContent")
    text: str = lab.page.locator(".al-time .now").inner_text()
    return float(text.split("/")[0])
