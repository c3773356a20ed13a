"""Fixtures of all tests."""

from __future__ import annotations

import gc
import json
from collections.abc import Callable, Generator, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from armlab.content.robots import Robot, catalogue
from support.compiling import compile_in_turns, turns
from support.order import ordered

if TYPE_CHECKING:
    from armlab.front.start import Running

DATA = Path(__file__).parent / "data"


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_collection(session: pytest.Session) -> Generator[None, object, object]:
    """Let the workers share the work of compiling what they collect, and nobody look for garbage among the tests."""
    compile_in_turns(*turns(session.config))
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.set_threshold(100_000, 20, 20)  # memory is there: garbage may lie a while
        gc.enable()


@pytest.hookimpl(trylast=True)  # after tests that were not asked for have been left out
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Let every worker begin with what takes longest; see `support.order`."""
    workers = getattr(config, "workerinput", {}).get("workercount", 1)
    items[:] = ordered(items, _comes_first, lambda item: item.path, workers)


def _comes_first(item: pytest.Item) -> bool:
    return any(item.get_closest_marker(name) is not None for name in ("browser", "together"))


@pytest.fixture
def rng() -> np.random.Generator:
    """The same random numbers in every run."""
    return np.random.default_rng(20260)


@pytest.fixture(params=list(catalogue().robots))
def robot(request: pytest.FixtureRequest) -> Robot:
    """Each robot file in turn."""
    return catalogue()[request.param]


@pytest.fixture(scope="session")
def truth() -> dict[str, dict[str, Any]]:
    """Numeric cases of the course notes, each cross-checked by other means, by identifier."""
    cases = json.loads((DATA / "truth.json").read_text(encoding="utf-8"))
    return {case["id"]: case for case in cases}


@pytest.fixture(scope="module")
def url() -> Iterator[str]:
    """A lab for the tests of a module."""
    from support.lab import running_lab  # most tests need none

    with running_lab() as address:
        yield address


@pytest.fixture
def open_lab() -> Iterator[Callable[..., Running]]:
    """Opens labs as `support.lab.open_lab` does; those that still run at the end of the test are stopped."""
    from support import lab as labs  # most tests need none

    opened: list[Running] = []

    def open_one(*arguments: Any, **options: Any) -> Running:
        opened.append(labs.open_lab(*arguments, **options))
        return opened[-1]

    yield open_one
    for lab in opened:
        lab.stop()


@pytest.fixture
def reads_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a refusal count as read as soon as it is there; otherwise a person has a second for it."""
    monkeypatch.setattr("armlab.ui.fields.SEEN", 0.0)
