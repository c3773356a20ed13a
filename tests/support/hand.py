"""What is done with hand and keyboard, counted: typing is no click."""

from __future__ import annotations

from support.page import LabPage


class Hand:
    """Counts what is pressed on a page.

    Attributes
    ----------
    clicks : int
    """

    def __init__(self, lab: LabPage) -> None:
        self.lab, self.clicks = lab, 0

    def on(self, cell: str) -> None:
        """Press a button of our own markup."""
        self.clicks += 1
        self.lab.press(cell)

    def at(self, x: float, y: float) -> None:
        """Press a place of the page for a moment, as a hand does."""
        self.clicks += 1
        mouse = self.lab.page.mouse
        mouse.move(x, y)
        self.lab.frames(3)  # the page looks for what is under the pointer in the frame after it moved
        mouse.down()
        self.lab.frames(3)
        mouse.up()
        self.lab.rest()

    def find(self, text: str) -> None:
        """Press the magnifier, type, and take what is found first with Enter."""
        page = self.lab.page
        self.clicks += 1
        page.locator("button[data-search]").first.click()
        page.keyboard.type(text)
        page.keyboard.press("Enter")
        page.wait_for_function("() => !document.getElementById('al-search').open")
        self.lab.rest()
