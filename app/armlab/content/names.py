"""The name of a lesson or an assignment in its key: what one person has loaded has digits of its content behind it."""

from __future__ import annotations

MARK = "-"
"""Character in the key of everything that is held; see `armlab.content.held`."""


def named(key: str) -> str:
    """Return the name in a key: that of its file.

    >>> named("reach_up-0123456789abcdef0123"), named("first_arm")
    ('reach_up', 'first_arm')
    """
    return key.partition(MARK)[0]
