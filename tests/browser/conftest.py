"""One lab and one browser for all tests with pictures."""

from collections.abc import Callable, Generator, Iterator

import pytest
from playwright.sync_api import Browser

from support.chromium import WITHOUT_A_CARD, chromium, new_page
from support.desk import Desk
from support.lab import running_lab
from support.page import COARSE, SMALL, LabPage

FAILED = pytest.StashKey[bool]()
NEXT = pytest.StashKey[pytest.Item | None]()


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """From here on Playwright's event loop runs in this thread; see `support.student.run`."""
    with chromium(WITHOUT_A_CARD) as started:
        yield started


@pytest.fixture(scope="session")
def url(desk: Desk, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    with running_lab(tmp_path_factory.mktemp("state")) as address:
        desk.lasting.add(address)
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


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_teardown(item: pytest.Item, nextitem: pytest.Item | None) -> None:
    """Note what comes next: only to another test with a page a page is left."""
    item.stash[NEXT] = nextitem


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
        if own or options or painted:
            desk.clear()
        if own or options:
            alone.append(LabPage(new_page(browser.new_context(**options), painted), address, size))
            return alone[-1]
        shared.append((desk.sit_down(address, size, painted), painted))
        return shared[-1][0]

    yield open_page
    for lab in alone:
        desk.take_away(lab)
    _end(request, desk, url, shared)
    assert [error for lab in alone for error in lab.errors] == []


@pytest.fixture
def stay(request: pytest.FixtureRequest, desk: Desk, url: str) -> Iterator[Callable[..., LabPage]]:
    """Use the lab as a new student, once in a test, where it does not matter whether the page has been loaded for it.

    Tests of how a page comes, of what it keeps for itself, such as open folds, and of the camera ask for `visit`.
    """
    used: list[tuple[LabPage, bool]] = []

    def take_over(path: str = "", size: tuple[int, int] = SMALL) -> LabPage:
        used.append((desk.take_over(url, path, size), False))
        return used[-1][0]

    yield take_over
    _end(request, desk, url, used)


def _end(request: pytest.FixtureRequest, desk: Desk, url: str, used: list[tuple[LabPage, bool]]) -> None:
    """Leave the pages of a test to the next one; those of a test that fails, or with complaints, are closed."""
    errors = [error for lab, _ in used for error in lab.errors]
    failed = bool(errors) or request.node.stash.get(FAILED, False)
    for lab, painted in used:
        if failed:
            desk.take_away(lab)
        elif painted or not _goes_on(request.node, url in desk.lasting):
            desk.get_up(lab, painted)
        else:
            desk.leave(lab)
    assert errors == []


def _goes_on(item: pytest.Item, lasting: bool) -> bool:
    """Return whether the next test has a page, and the lab of this one's is still there."""
    following = item.stash[NEXT]
    has_page = {"visit", "stay"} & set(getattr(following, "fixturenames", ()))
    return bool(has_page) and (lasting or getattr(following, "path", None) == item.path)
