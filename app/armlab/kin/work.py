"""Long work in pieces: a generator yields None after each piece and returns the result."""

from __future__ import annotations

from collections.abc import Generator
from typing import TypeVar

Result = TypeVar("Result")

Work = Generator[None, None, Result]


def result_of(work: Work[Result]) -> Result:
    """Do all work at once and return its result."""
    while True:
        try:
            next(work)
        except StopIteration as done:
            result: Result = done.value
            return result
