"""Playback in a real browser: how many poses of a moving arm a student sees a second, and how true its clock is."""

import asyncio
import contextlib
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from playwright.sync_api import Browser, BrowserContext, Page

import drag
import servers
import swinging
from rounds import TINY, quantile, sized
from support.chromium import chromium, new_page
from support.page import LabPage

TITLE = "Playback of a moving arm: poses shown in Chromium with a software renderer"
WINDOWS = sized({(640, 420): (0, 10), (1400, 850): (0,)}, {(640, 420): (1,)})
"""Each with the numbers of other students who drag meanwhile."""

ROUNDS, SECONDS = sized((3, 5.0), (1, 0.5))
EASING = sized(4.0, 0.1)
"""Seconds in which the page finds out how much it can draw."""

EXPLAINED = """\
Shadows on at rest; the median in brackets; p95 is that of the others, from their hand to the new pose. While a clip
plays and pictures are too few, the page leaves out shadows and then pixels. Where no graphics card draws, edges are not
smoothed; a way is drawn with the few segments it needs, for each of them costs such a machine as much as many
triangles."""

COUNT = """(() => {
  const kind = WebGL2RenderingContext.prototype, draw = kind.drawElements;
  kind.drawElements = function (...all) { window.__drawn = true; return draw.apply(this, all); };
})()"""
WATCH = """([name, seconds, axis]) => new Promise(done => {
  const page = window.__viserMutable, node = page.nodeRefFromName[name], began = performance.now(), seen = [];
  let pictures = 0;
  const look = now => {
    pictures += Number(window.__drawn ?? 0);
    window.__drawn = false;
    const angle = 2 * Math.atan2(node.quaternion[axis], node.quaternion.w);
    if (angle !== seen.at(-1)?.[1]) seen.push([now / 1000, angle]);
    if (now - began < 1000 * seconds) requestAnimationFrame(look);
    else done([seen, pictures, (now - began) / 1000, page.canvas.width / page.canvas.clientWidth]);
  };
  requestAnimationFrame(look);
})"""


@dataclass(frozen=True)
class Seen:
    """What a student saw: poses and pictures a second, pixel ratio, clock over the wall's; seconds of the others."""

    poses: float
    pictures: float
    ratio: float
    clock: float
    others: float = float("nan")


def measure() -> Iterator[str]:
    yield from EXPLAINED.splitlines()
    yield ""
    yield "| window | others dragging | server | pixel ratio | poses a second shown | drawn | clock ÷ wall | p95 |"
    yield "| --- | --- | --- | --- | --- | --- | --- | --- |"
    with chromium() as browser:
        for window, classes in WINDOWS.items():
            for others in classes:
                found: dict[str, list[Seen]] = {"Armlab": [], "bare viser": []}
                for _ in range(ROUNDS):
                    for name, seen in found.items():
                        seen.append(played(browser, window, others, name == "Armlab"))
                for name, seen in found.items():
                    yield f"| {window[0]} x {window[1]} | {others} | {name} | {row(seen)} |"


def row(seen: list[Seen]) -> str:
    best = max(seen, key=lambda each: each.poses)
    median = np.median([each.poses for each in seen])
    p95 = "–" if np.isnan(best.others) else f"{1e3 * best.others:.0f} ms"
    rates = f"{best.poses:.0f} ({median:.0f}) | {best.pictures:.0f}"
    return f"{best.ratio:.2f} | {rates} | {best.clock:.3f} | {p95}"


def played(browser: Browser, window: tuple[int, int], others: int, ours: bool) -> Seen:
    """Show one student a clip while others drag."""
    started = servers.lab() if ours else servers.started([str(servers.HERE / "bare_playback.py")], has_front=False)
    with started as server, browser.new_context() as context:
        context.add_init_script(COUNT)
        page, node = (open_ours if ours else open_bare)(context, server.url, window)
        page.wait_for_timeout(1000 * EASING)
        with dragging(server, others, ours) as latencies:
            seen, pictures, seconds, ratio = page.evaluate(WATCH, [node, SECONDS, "z" if ours else "y"])
        times, angles = np.array(seen).T
        clock = np.polyfit(times, np.unwrap(angles, period=4.0 * np.pi), 1)[0] / swinging.SPEED
        p95 = quantile(latencies, 0.95) if others else float("nan")
        return Seen(len(seen) / seconds, pictures / seconds, ratio, float(clock), p95)


def open_ours(context: BrowserContext, url: str, window: tuple[int, int]) -> tuple[Page, str]:
    """Read the motion from a file, play it with its plan in sight; return the page, and the node of joint 1."""
    lab = LabPage(new_page(context, painted=not TINY), url, window)
    lab.open_tab("Motion")
    lab.press("motion_files")
    file = {"name": "motion.csv", "mimeType": "text/csv", "buffer": swinging.table().encode()}
    lab.page.locator('input[type=file][data-cell="read-motion"]').set_input_files(file)
    lab.page.get_by_text("From a file").wait_for()
    lab.press("motion")
    lab.press("play-motion")
    lab.page.locator(".al-time").wait_for()
    return lab.page, lab.node("/arm/1")


def open_bare(context: BrowserContext, url: str, window: tuple[int, int]) -> tuple[Page, str]:
    page = new_page(context, painted=not TINY)
    page.set_viewport_size({"width": window[0], "height": window[1]})
    page.goto(url)
    page.wait_for_function("() => window.__viserMutable?.nodeRefFromName?.['/arm/0/1/2/3/4/5/body']")
    return page, "/arm/0"


@contextlib.contextmanager
def dragging(server: servers.Server, others: int, ours: bool) -> Iterator[list[float]]:
    """Have other students drag at 20 events a second; their latencies are in the list afterwards."""
    latencies: list[float] = []
    if not others:
        yield latencies
        return
    points, angles = drag.script()
    ready = threading.Event()

    async def prepare(_browser: object) -> None:
        ready.set()

    def reader(browser: drag.FakeBrowser) -> drag.Reader:
        return drag.by_first_joint(browser, angles) if ours else drag.by_echo(points)

    with ThreadPoolExecutor(1) as pool:
        drags = pool.submit(lambda: asyncio.run(drag.drive(server, others, points, reader, prepare)))
        ready.wait(30.0)
        threading.Event().wait(drag.SETTLING + 0.5)
        yield latencies
        latencies += drags.result()[0]
