"""A lab for the tests of a module."""

from collections.abc import Iterator

import pytest

from support.lab import running_lab


@pytest.fixture(scope="module")
def url() -> Iterator[str]:
    with running_lab() as address:
        yield address
