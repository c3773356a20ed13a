"""From a move of the pointer on the handle to the frame that shows the arm moved, in a real browser."""

from collections.abc import Iterator, Sequence

import numpy as np
from playwright.sync_api import Browser

import servers
from armlab.content.robots import catalogue
from armlab.ui.figure.anatomy import anatomy_of
from rounds import TINY, quantile, sized
from support.chromium import chromium, new_page
from support.page import HANDLE, LabPage

TITLE = "Pointer to picture: Chromium with a software renderer, 640 x 420"
WINDOW = (640, 420)
STEPS, ROUNDS = sized((40, 3), (2, 1))
BARE_HANDLE = 0.4
RECORD = """(() => {
  const record = window.__record = {moved: 0, shown: 0};
  addEventListener('pointermove', event => { record.moved = event.timeStamp; record.shown = 0; }, true);
  const isPose = m => /^Set(Orientation|Position)Message$/.test(m.type) && /arm|echo/.test(m.name);
  const after = () => requestAnimationFrame(() => { record.shown ||= performance.now(); });
  const Plain = window.Worker;
  window.Worker = class extends Plain {
    constructor(...a) {
      super(...a);
      this.addEventListener('message', ({data}) => {
        // The page takes the batch in at the next frame; the one after shows that it was drawn.
        if (data?.type === 'message_batch' && data.messages.some(isPose)) requestAnimationFrame(after);
      });
    }
  };
})()"""


def measure() -> Iterator[str]:
    yield "| server | p50 | p95 |"
    yield "| --- | --- | --- |"
    size = anatomy_of(catalogue()["puma560"].arm).size
    kinds = {
        "Armlab": (servers.lab, HANDLE * size, ()),
        "Armlab, shadows off": (servers.lab, HANDLE * size, ("Shadows",)),
        "bare viser: six cylinders, no ground": (servers.bare, BARE_HANDLE, ()),
    }
    if TINY:
        del kinds["Armlab"]  # with shadows off it does all that is done with shadows on
    found: dict[str, list[float]] = {name: [] for name in kinds}
    with chromium() as browser:
        for _ in range(ROUNDS):
            for name, (start, handle, off) in kinds.items():
                with start() as server:
                    found[name].extend(dragged(browser, server.url, handle, off))
    for name, times in found.items():
        yield f"| {name} | {quantile(times, 0.5):.0f} ms | {quantile(times, 0.95):.0f} ms |"


def dragged(browser: Browser, url: str, handle: float, off: Sequence[str]) -> Iterator[float]:
    """Drag the upward arrow in single steps, each after the answer to the one before; yield milliseconds."""
    with browser.new_context() as context:
        context.add_init_script(RECORD)
        lab = LabPage(new_page(context, painted=not TINY), url, WINDOW)
        if lab.page.locator("button[data-cell=welcome-leave]").count():
            lab.press("welcome-leave")  # in so small a window the card lies over the handle
        if off:
            lab.open_tab("View")
            for switch in off:
                lab.page.get_by_label(switch).click()
            lab.rest()
        start = lab.on_screen("/target", [0.0, 0.0, 0.75 * handle])
        lab.page.mouse.move(*start)
        lab.frames(3)
        lab.page.mouse.down()
        lab.page.mouse.move(start[0], start[1] - 8.0)
        lab.rest()
        for k in range(STEPS):
            lab.page.mouse.move(start[0], start[1] - 8.0 - 20.0 * np.sin(0.2 * (k + 1)))
            lab.page.wait_for_function("() => window.__record.shown")
            yield lab.page.evaluate("() => window.__record.shown - window.__record.moved")
            lab.page.wait_for_timeout(60)  # past the page's own limit of 20 events a second
        lab.page.mouse.up()
