"""Pages at which one person sits down after the other.

A page that has shown the lab before shows it again in half the time, since the browser has compiled its scripts.
It keeps them only while it stays with the lab: for a page from elsewhere, even an empty one, it begins a new process.
"""

from __future__ import annotations

from urllib.parse import urljoin

from playwright.sync_api import Browser, Page

from support.chromium import new_page
from support.page import LabPage

NOTHING = "/nothing"
"""What no lab has; its answer is a page of one line."""


class Desk:
    """The pages of one browser that wait for somebody: at most one whose scene is painted, and one with no picture.

    Parameters
    ----------
    browser : playwright Browser
    """

    def __init__(self, browser: Browser) -> None:
        self._browser = browser
        self._free: dict[bool, Page] = {}

    def sit_down(self, url: str, size: tuple[int, int], painted: bool) -> LabPage:
        """Open the lab as a new student, on a page that has been used before if one is free."""
        page = self._free.pop(painted, None) or new_page(self._browser.new_context(), painted)
        return LabPage(page, url, size)

    def get_up(self, lab: LabPage, painted: bool) -> None:
        """Leave a page as it was found: empty, alone, unknown to any lab, with nothing under the pointer."""
        lab.leave()
        context = lab.page.context
        for page in context.pages:
            if page != lab.page:
                page.close()
        if painted in self._free:
            context.close()
            return
        lab.page.mouse.move(-1, -1)
        lab.page.goto(urljoin(lab.url, NOTHING))
        context.clear_cookies()
        self._free[painted] = lab.page

    def take_away(self, lab: LabPage) -> None:
        """Close a page with which something is wrong."""
        lab.leave()
        lab.page.context.close()
