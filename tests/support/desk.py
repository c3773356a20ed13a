"""Pages at which one person sits down after the other.

A page that has shown the lab before shows it again in half the time, since the browser has compiled its scripts.
It keeps them only while it stays with the lab: for a page from elsewhere, even an empty one, it begins a new process.
In a quarter of the time the lab wipes a page, instead of the page being loaded again; see `support.wiped`.
"""

from __future__ import annotations

from urllib.parse import urljoin

from playwright.sync_api import Browser, Page

from support.chromium import new_page
from support.page import COARSE, LabPage
from support.wiped import MARKS, wipe

NOTHING = "/nothing"
"""What no lab has; its answer is a page of one line."""


class Desk:
    """The pages of one browser that wait for somebody: at most one whose scene is painted, and one with no picture.

    Parameters
    ----------
    browser : playwright Browser

    Attributes
    ----------
    lasting : set of str
        Addresses of labs that run until the browser closes.
    """

    def __init__(self, browser: Browser) -> None:
        self._browser = browser
        self._free: dict[bool, Page] = {}
        self._left: LabPage | None = None
        self._marks = ""
        self.lasting: set[str] = set()

    def sit_down(self, url: str, size: tuple[int, int], painted: bool = False) -> LabPage:
        """Open the lab as a new student, on a page that has been used before if one is free."""
        if self._left is not None and not painted:
            self._free[painted] = self._cleared(self._left)
            self._left = None
        page = self._free.pop(painted, None) or new_page(self._browser.new_context(), painted)
        return LabPage(page, url, size)

    def take_over(self, url: str, wish: str, size: tuple[int, int]) -> LabPage:
        """Return the lab as a new student finds it, on the page that was left there if there is one.

        Parameters
        ----------
        url : str
            Of the lab.
        wish : str
            What stands after it in the address.
        size : tuple of int
        """
        if self._left is not None and self._left.url.startswith(url) and self._left.tab("Joints").is_visible():
            lab, self._left = self._left, None
            try:
                wipe(lab, wish)
                lab.resize(size)
                found = lab.page.evaluate(MARKS)
            except BaseException:
                self.take_away(lab)
                raise
            if found == self._marks:
                return lab
            self.get_up(lab, False)
        lab = self.sit_down(f"{url}{wish}?{COARSE}", size)
        self._marks = self._marks or lab.page.evaluate(MARKS)
        return lab

    def leave(self, lab: LabPage) -> None:
        """Leave a page without a picture at its lab, for the next one."""
        self.clear()
        self._close_others(lab)
        self._left = lab

    def clear(self) -> None:
        """Let nobody take over the page that was left."""
        if self._left is not None:
            lab, self._left = self._left, None
            self.get_up(lab, False)

    def get_up(self, lab: LabPage, painted: bool) -> None:
        """Leave a page as it was found: empty, alone, unknown to any lab, with nothing under the pointer."""
        if painted in self._free:
            self.take_away(lab)
            return
        self._free[painted] = page = self._cleared(lab)
        page.goto(urljoin(lab.url, NOTHING))
        page.context.clear_cookies()

    def take_away(self, lab: LabPage) -> None:
        """Close a page with which something is wrong."""
        lab.leave()
        lab.page.context.close()

    def _cleared(self, lab: LabPage) -> Page:
        """Return the page alone, known to nobody, with nothing under the pointer."""
        lab.leave()
        self._close_others(lab)
        lab.page.mouse.move(-1, -1)
        lab.page.context.clear_cookies()
        return lab.page

    @staticmethod
    def _close_others(lab: LabPage) -> None:
        for page in lab.page.context.pages:
            if page != lab.page:
                page.close()
