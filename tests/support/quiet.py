"""Wait for a lab's answer on its page, with few looks: a look costs the page more than most of what it looks for."""

from __future__ import annotations

import time
from collections.abc import Callable

from playwright.sync_api import Page

from support.at_rest import Traffic, told
from support.patience import Patience

LOOK = """async () => {
  const frame = () => new Promise(drawn => requestAnimationFrame(drawn));
  const mutable = window.__viserMutable, until = performance.now() + 150;
  const still = () => mutable.messageQueue.length === 0 && mutable.getRenderRequestState === 'ready'
    && window.__passed.timers.size === 0
    && [...document.images].every(image => image.complete)
    && document.getAnimations().every(one => one.effect.getComputedTiming().endTime === Infinity);
  do { await frame(); await frame(); } while (!still() && performance.now() < until);
  const shown = JSON.stringify([
    Object.values(mutable.nodePoseData).map(pose => pose && [pose.position, pose.wxyz]),
    Object.keys(mutable.nodeRefFromName).length,
    [...document.querySelectorAll('[role=slider]')].map(thumb => thumb.getAttribute('aria-valuenow')),
    document.body.innerText,
  ]);
  let digest = 0, other = 7;
  for (let k = 0; k < shown.length; k++) {
    digest = (31 * digest + shown.charCodeAt(k)) | 0;
    other = (131 * other + shown.charCodeAt(k)) | 0;
  }
  return [still(), `${digest} ${other} ${shown.length}`, window.__passed.up, window.__passed.down];
}"""
"""Whether the page has nothing left to do, a digest of what it shows once that is drawn, and what it said and heard."""

LEAST = QUIET = 0.4
"""Seconds: after the first a page that has been the same for the second has probably had its answer."""

BUSY = 0.02
"""Seconds between two questions to a lab that is at work."""

APART = 0.1
"""Seconds between two looks at the page of such a lab."""


def wait_for_answer(page: Page, others: Callable[[], Traffic], most: float) -> None:
    """Wait for a lab's answer, seconds at most.

    It has come when nothing is left to do in page and lab, nothing is on its way between them, and the page has drawn
    it. Where that cannot be told, since other programs or processes take part, or where a film plays or long work goes
    on, it is enough that nothing in scene and panel has changed for a while after all commands are done and all that
    the labs of this process had sent before the page was looked at has come.

    Parameters
    ----------
    page : playwright Page
    others : callable
        What the other open pages and their labs have said to each other.
    most : float
    """
    patience = Patience(most)
    since, before = time.monotonic() + LEAST, ""
    quiet: tuple[object, ...] | None = None
    looked = 0.0
    while patience.left():
        lab = told()
        if lab is not None and not lab.idle and time.monotonic() < looked + APART:
            time.sleep(BUSY)
            continue
        sent = 0 if lab is None else lab.traffic.sent
        still, seen, up, down = page.evaluate(LOOK)
        looked = time.monotonic()
        elsewhere = others()
        pages = Traffic(up + elsewhere.received, down + elsewhere.sent)
        lab = told()
        if seen != before:
            before, since, quiet = seen, max(since, looked), None
        now = (pages, seen) if still and lab is not None and lab.idle and lab.traffic == pages else None
        if now is not None and now == quiet:
            return
        quiet = now
        under_way = sent > pages.sent or (lab is not None and lab.traffic.received < pages.received)
        if under_way or not (lab is None or lab.answered):
            # What was seen was seen before this answer was told, or had arrived.
            since = max(since, time.monotonic())
        if time.monotonic() > since + QUIET:
            return
