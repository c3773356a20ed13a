"""Folds of formulas, by which their values at many points are found, or how they are printed."""

from __future__ import annotations

from typing import Protocol, TypeVar

T = TypeVar("T")


class Fold(Protocol[T]):
    """A way to make something of a formula, from its innermost parts outwards; see `Expression.folded`."""

    def number(self, value: float) -> T:
        """Return what is made of a number."""
        ...

    def name(self, name: str) -> T:
        """Return what is made of a variable."""
        ...

    def operation(self, operation: str, arguments: list[T]) -> T:
        """Return what is made of an operation, ``+ - * / ^ minus`` or the name of a function, on its arguments."""
        ...
