"""One lab and one browser for all tests with pictures."""

from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Browser

from support.lab import running_lab
from support.page import COARSE, SMALL, WITHOUT_A_CARD, LabPage, chromium


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """From here on Playwright's event loop runs in this thread; see `support.student.run`."""
    with chromium(WITHOUT_A_CARD) as started:
        yield started


@pytest.fixture(scope="session")
def url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    with running_lab(tmp_path_factory.mktemp("state")) as address:
        yield address


@pytest.fixture
def visit(browser: Browser, url: str) -> Iterator[Callable[..., LabPage]]:
    """Open the lab as a new student; every page is checked for complaints at the end.

    Only a test that looks at pixels asks for a page whose scene is painted.
    """
    contexts, pages = [], []

    def open_page(path: str = "", size: tuple[int, int] = SMALL, painted: bool = False, **options: object) -> LabPage:
        context = browser.new_context(**options)
        contexts.append(context)
        address, hash_sign, fragment = (url + path).partition("#")
        address += ("&" if "?" in address else "?") + COARSE
        pages.append(LabPage(context, address + hash_sign + fragment, size, painted))
        return pages[-1]

    yield open_page
    for context in contexts:
        context.close()
    assert [error for page in pages for error in page.errors] == []
