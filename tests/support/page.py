"""Drive the lab's page in a real browser, as a person would."""

from __future__ import annotations

import io
import time
from collections.abc import Callable, Sequence
from weakref import WeakSet

import numpy as np
from PIL import Image
from playwright.sync_api import ConsoleMessage, Locator, Page, Request, WebSocket

from armlab.session.pages import pages
from support.at_rest import Traffic
from support.folds import revealed, unfold
from support.patience import WAIT, Patience
from support.quiet import wait_for_answer

OF_VISER = (
    "THREE.Clock: This module has been deprecated",
    "THREE.WebGLRenderer: ",
    "This browser does not support reading",
    "[.WebGL",
)
"""How warnings begin that viser's libraries give of themselves, and they and the browser of the graphics card."""

SMALL = (900, 600)
"""A small window, for tests of what the lab does; tests of its layout ask for the real sizes."""

COARSE = "fixedDpr=0.5"
"""Draws the scene with half the pixels each way, which a software renderer can keep up with."""

OPEN: WeakSet[LabPage] = WeakSet()
"""The pages that were opened."""

FITTED = """() => {
  const canvas = document.querySelector('canvas').getBoundingClientRect();
  const dock = document.querySelector('[data-dock-region=right]')?.getBoundingClientRect();
  const right = (dock ?? canvas).right;
  return Math.abs(right - innerWidth) <= 1 && Math.abs(canvas.bottom - innerHeight) <= 1;
}"""
"""Whether picture and panels have followed the window."""

SETTLING = 10.0
"""Seconds for which a page may still lay itself out anew."""

HANDLE = 0.14
"""Length of the handle's arrows, in sizes of the arm."""


class LabPage:
    """One person's use of a page.

    Parameters
    ----------
    page : playwright Page
        Made by `support.chromium.new_page`.
    url : str
    size : tuple of int

    Attributes
    ----------
    page : playwright Page
    url : str
        Where the use of it began.
    errors : list of str
        What the page complained about: errors, and warnings other than those `OF_VISER`.
    requests : list of str
        Every address it asked for.
    """

    def __init__(self, page: Page, url: str, size: tuple[int, int] = SMALL) -> None:
        self.page, self.url = page, url
        OPEN.add(self)
        self.page.set_default_timeout(1e3 * WAIT)
        self.page.set_viewport_size({"width": size[0], "height": size[1]})
        self.errors: list[str] = []
        self.requests: list[str] = []
        self._heard = {"pageerror": self._fails, "console": self._says, "request": self._asks, "websocket": self._asks}
        for event, listener in self._heard.items():
            self.page.on(event, listener)
        self.page.goto(url)
        self.ready()
        self.dismiss_toasts()

    def _fails(self, error: Exception) -> None:
        self.errors.append(str(error))

    def _says(self, message: ConsoleMessage) -> None:
        tolerated = message.type == "warning" and message.text.startswith(OF_VISER)
        if message.type in ("error", "warning") and not tolerated:
            self.errors.append(message.text)

    def _asks(self, asking: Request | WebSocket) -> None:
        self.requests.append(asking.url)

    def leave(self) -> None:
        """End the use of the page, which stays open for others."""
        for event, listener in self._heard.items():
            self.page.remove_listener(event, listener)
        OPEN.discard(self)

    def ready(self) -> None:
        """Wait until the arm is there, with all that the open panel and lesson show of it, or what covers it."""
        bodies = "Object.keys(window.__viserMutable?.nodeRefFromName ?? {}).some(n => n.endsWith('/body'))"
        covered = "document.querySelector('.ask .dim')"
        self.page.wait_for_function(f"() => {bodies} || {covered}")
        self.rest()

    def dismiss_toasts(self) -> None:
        """Close viser's note about software rendering, which is true here."""
        close = "document.querySelectorAll('.mantine-Notification-root button').forEach(button => button.click())"
        self.page.evaluate(f"() => {{ {close} }}")
        self.page.wait_for_function("() => !document.querySelector('.mantine-Notification-root')")

    def address(self) -> str:
        """Return what the address bar shows."""
        address: str = self.page.evaluate("() => location.href")
        return address

    # -- the scene -----------------------------------------------------------------------------------------------

    def nodes(self) -> list[str]:
        """Return the names of all nodes that are in the scene; those of an arm that has gone keep their names."""
        names: list[str] = self.page.evaluate(
            """() => {
              const { nodeRefFromName, scene } = window.__viserMutable;
              const within = node => node && (node === scene || within(node.parent));
              return Object.entries(nodeRefFromName).filter(([, node]) => within(node)).map(([name]) => name);
            }"""
        )
        return names

    def node(self, suffix: str) -> str:
        """Return the node whose name ends like this."""
        return next(name for name in self.nodes() if name.endswith(suffix))

    def on_screen(self, node: str, local: Sequence[float] = (0.0, 0.0, 0.0)) -> np.ndarray:
        """Return the pixel of a point given in the axes of a node."""
        point = self.page.evaluate(
            """([name, p]) => {
              const m = window.__viserMutable, o = m.nodeRefFromName[name];
              o.updateWorldMatrix(true, false); m.camera.updateMatrixWorld();
              const v = o.position.clone().set(...p).applyMatrix4(o.matrixWorld).project(m.camera);
              const r = m.canvas.getBoundingClientRect();
              return [r.left + (v.x + 1) / 2 * r.width, r.top + (1 - v.y) / 2 * r.height];
            }""",
            [node, list(local)],
        )
        return np.array(point)

    def on_screen_at_rest(self, node: str, points: np.ndarray) -> np.ndarray:
        """Return the pixels of points, (n, 3), given in the axes of a node, once the camera has stopped moving."""
        seen: list[np.ndarray] = []

        def stays() -> bool:
            self.frames(3)
            seen.append(np.array([self.on_screen(node, point) for point in points.tolist()]))
            return len(seen) > 1 and bool(np.abs(seen[-1] - seen[-2]).max() < 0.5)

        self.until(stays)
        return seen[-1]

    def scene(self) -> list[float]:
        """Return left and right end of the scene, and the width of the window, in pixels."""
        ends: list[float] = self.page.evaluate(
            """() => {
              const box = document.querySelector('canvas[data-engine]').getBoundingClientRect();
              return [box.left, box.right, innerWidth];
            }"""
        )
        return ends

    def target(self) -> np.ndarray:
        """Return where the page has the handle, in the world."""
        return np.array(self.page.evaluate("() => window.__viserMutable.nodePoseData['/target'].position"))

    def camera(self) -> list[float]:
        """Return the pose of the page's camera."""
        pose: list[float] = self.page.evaluate(
            """() => {
              const camera = window.__viserMutable.camera;
              return [...camera.position.toArray(), ...camera.quaternion.toArray()];
            }"""
        )
        return pose

    def picture(self) -> np.ndarray:
        """Return the page as pixels."""
        return np.asarray(Image.open(io.BytesIO(self.page.screenshot())).convert("RGB")).astype(int)

    def drag_handle(
        self, axis: int, size: float, pixels: Sequence[float], steps: int = 12, node: str = "/target"
    ) -> None:
        """Grab an arrow of a handle and drag it by so many pixels; ``size`` is that of the arm."""
        tip = [0.0, 0.0, 0.0]
        tip[axis] = 0.75 * HANDLE * size
        start = self.on_screen(node, tip)
        self.page.mouse.move(*start)
        self.frames(3)  # the page looks for what is under the pointer in the frame after it moved
        self.page.mouse.down()
        for k in range(1, steps + 1):
            self.page.mouse.move(*(start + np.asarray(pixels) * k / steps))
            self.frames(1)
        self.frames(3)
        self.page.mouse.up()
        self.rest()

    def resize(self, size: tuple[int, int]) -> None:
        """Give the window another size, and wait until the page has fitted itself to it."""
        self.page.set_viewport_size({"width": size[0], "height": size[1]})
        self.page.wait_for_function(FITTED)
        self.rest()

    # -- the panels ----------------------------------------------------------------------------------------------

    def tab(self, title: str) -> Locator:
        """Return a tab of the dock."""
        return self.page.locator(f'[data-dock-tab][data-name="{title}"]')

    def open_tab(self, name: str) -> None:
        """Open a tab, or the page that has this key, this title, or this name among the pages of its tab."""
        known = pages()
        page = known.get(name) or next((each for each in known.values() if name in (each.title, each.name)), None)
        assert page is not None, f"no page is called {name!r}; there are {[each.title for each in known.values()]}"
        self.tab(known[page.tab or page.key].title).click()
        self.rest()
        if page.tab or (page.page and name != page.title):
            self.press(page.key)

    def slider_track(self, joint: int) -> str:
        """Return a selector of the slider of a joint, 1-based."""
        name = "q" + str(joint).translate(str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"))
        identifier = self.page.locator("label", has_text=name).first.get_attribute("for")
        return f'[id="{identifier}"]'

    def slider_value(self, joint: int) -> float:
        """Return what the slider of a joint shows."""
        thumb = self.page.locator(f"{self.slider_track(joint)} [role=slider]").first
        return float(thumb.get_attribute("aria-valuenow") or "nan")

    def slider_values(self, count: int) -> np.ndarray:
        """Return what all sliders show."""
        return np.array([self.slider_value(i + 1) for i in range(count)])

    def drag_slider(self, joint: int, fraction: float) -> None:
        """Drag the thumb of a slider to a fraction of its track."""
        track = self.page.locator(self.slider_track(joint)).first.bounding_box()
        thumb = self.page.locator(f"{self.slider_track(joint)} [role=slider]").first.bounding_box()
        assert track is not None
        assert thumb is not None
        x, y = thumb["x"] + thumb["width"] / 2, thumb["y"] + thumb["height"] / 2
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        goal = track["x"] + fraction * track["width"]
        for k in range(1, 11):
            self.page.mouse.move(x + (goal - x) * k / 10, y)
            self.frames(1)
        self.page.mouse.up()
        self.rest()

    def unfold(self, title: str) -> None:
        """Open the folded part of the panel with this title, unless it is open."""
        unfold(self.page, title)
        self.rest()

    def press(self, cell: str) -> None:
        """Press a button of our own markup, also in a part of the panel that is folded."""
        # The names of the pages of a tab that was opened before are there, and not seen.
        button = f'button[data-cell="{cell}"]'
        revealed(self.page.locator(f"{button}:not(.page), {button}.page:visible").first).click()
        self.rest()

    def type_into(self, cell: str, text: str) -> None:
        """Fill a field of our own markup, also in a part of the panel that is folded, and press Enter."""
        field = revealed(self.page.locator(f'input[data-cell="{cell}"]'))
        field.fill(text)
        field.press("Enter")
        self.rest()

    def hint(self) -> str:
        """Return the line over the scene; empty when there is none."""
        line = self.page.locator(".al-hint")
        return line.inner_text() if line.count() else ""

    def frames(self, count: int) -> None:
        """Wait until the page has drawn so many frames, however slow the machine."""
        self.page.evaluate(
            """async count => {
              for (let k = 0; k < count; k++) await new Promise(drawn => requestAnimationFrame(drawn));
            }""",
            count,
        )

    def rest(self, most: float = 15.0) -> None:
        """Wait for the lab's answer; see `support.quiet`."""
        wait_for_answer(self.page, self._others, most)

    def _others(self) -> Traffic:
        """Return what the other open pages have said to their labs and heard of them, as the pages count."""
        pages = [lab.page for lab in OPEN if lab is not self and not lab.page.is_closed()]
        counts = [page.evaluate("() => [window.__passed.up, window.__passed.down]") for page in pages]
        return Traffic(sum(up for up, _ in counts), sum(down for _, down in counts))

    def says(self, text: str) -> bool:
        """Return whether scene or panel show a text, folded parts included."""
        found: bool = self.page.evaluate("text => document.body.textContent.includes(text)", text)
        return found

    def waits_for(self, text: str) -> None:
        """Wait until scene or panel show a text."""
        self.until(lambda: self.says(text))

    def still(self, seconds: float) -> None:
        """Give what must not come the time to come."""
        time.sleep(seconds)
        self.rest()

    def until(self, condition: Callable[[], bool]) -> None:
        """Wait for something to come true."""
        patience = Patience()
        while not condition():
            assert patience.left(), "the condition did not come true"
            time.sleep(0.1)

    def finds_none(self, script: str) -> None:
        """Expect that a script which lists defects of the layout finds none once the page has settled."""
        patience = Patience(SETTLING)
        while found := self.page.evaluate(script):
            assert patience.left(), found
            time.sleep(0.1)
