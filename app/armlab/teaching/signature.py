"""The name with which a student signs work."""

LONGEST_NAME = 80
"""Longest name of a student, in characters."""


def signed(name: str) -> str:
    """Return a name as it is kept: on one line, and not too long."""
    return " ".join(name.split())[:LONGEST_NAME]
