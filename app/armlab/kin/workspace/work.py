"""Long work in pieces: a generator yields None after each piece, and returns what it has found."""

from __future__ import annotations

from collections.abc import Generator
from typing import TypeVar

Result = TypeVar("Result")

Work = Generator[None, None, Result]


def result_of(work: Work[Result]) -> Result:
    """Do work at once and return what it returns."""
    while True:
        try:
            next(work)
        except StopIteration as done:
            result: Result = done.value
            return result
