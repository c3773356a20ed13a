"""One lab and one browser for all tests with pictures."""

from collections.abc import Callable, Generator, Iterator

import pytest
from playwright.sync_api import Browser

from support.chromium import WITHOUT_A_CARD, chromium, new_page
from support.desk import Desk
from support.lab import running_lab
from support.page import COARSE, SMALL, LabPage

FAILED = pytest.StashKey[bool]()


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """From here on Playwright's event loop runs in this thread; see `support.student.run`."""
    with chromium(WITHOUT_A_CARD) as started:
        yield started


@pytest.fixture(scope="session")
def url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    with running_lab(tmp_path_factory.mktemp("state")) as address:
        yield address


@pytest.fixture(scope="session")
def desk(browser: Browser) -> Desk:
    """The pages on which one test follows the other."""
    return Desk(browser)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Note which tests fail: nobody sits down at their pages again."""
    report = yield
    item.stash[FAILED] = item.stash.get(FAILED, False) or report.failed
    return report


@pytest.fixture
def visit(request: pytest.FixtureRequest, browser: Browser, desk: Desk, url: str) -> Iterator[Callable[..., LabPage]]:
    """Open the lab as a new student; every page is checked for complaints at the end.

    Only a test that looks at pixels asks for a page whose scene is painted, and one that leaves more behind on a page
    than `support.desk` clears away for a page of its ``own``.
    """
    shared: list[tuple[LabPage, bool]] = []
    alone: list[LabPage] = []

    def open_page(
        path: str = "", size: tuple[int, int] = SMALL, painted: bool = False, own: bool = False, **options: object
    ) -> LabPage:
        address, hash_sign, fragment = (url + path).partition("#")
        address += ("&" if "?" in address else "?") + COARSE + hash_sign + fragment
        if own or options:
            alone.append(LabPage(new_page(browser.new_context(**options), painted), address, size))
            return alone[-1]
        shared.append((desk.sit_down(address, size, painted), painted))
        return shared[-1][0]

    yield open_page
    errors = [error for lab in [*alone, *(each for each, _ in shared)] for error in lab.errors]
    failed = bool(errors) or request.node.stash.get(FAILED, False)
    for lab in alone:
        desk.take_away(lab)
    for lab, painted in shared:
        if failed:
            desk.take_away(lab)
        else:
            desk.get_up(lab, painted)
    assert errors == []
