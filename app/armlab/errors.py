"""The exceptions of Armlab.

```
ArmlabError
├── InputError (also a ValueError)      a caller's argument is wrong
│   ├── UnknownName (also a KeyError)   a name that does not exist; lists those that do
│   ├── Outdated                        asked of something that is not shown any more
│   └── DeadLink                        a link leads nowhere
├── ContentError                        a robot or lesson file is wrong: file, key, problem
└── PluginError                         a module found by folder cannot be used
```

Every text says where, what was expected, what came instead, and what is available.
An inverse-kinematics problem without a solution is a result, never an exception.
"""

from __future__ import annotations

import traceback
from collections.abc import Iterable
from difflib import get_close_matches


class ArmlabError(Exception):
    """Anything Armlab refuses to do."""


class InputError(ArmlabError, ValueError):
    """An argument is wrong."""


class UnknownName(InputError, KeyError):
    """A name that does not exist."""

    def __init__(self, where: str, got: object, available: Iterable[str]) -> None:
        super().__init__(f"{where}: unknown name {got!r}{suggestion(str(got), available)}")

    def __str__(self) -> str:  # KeyError would print the text in quotes
        return str(self.args[0])


class Outdated(InputError):
    """A wish belongs to something that is not shown any more, so that it cannot be refused there."""


class DeadLink(InputError):
    """A link leads nowhere; what is said of it stands until it is closed, since it may be read late."""


class ContentError(ArmlabError):
    """A file of content is wrong.

    Parameters
    ----------
    file : str
        Name of the file as a person knows it.
    key : str
        Where in the file, such as ``joints[2].alpha_deg``; empty for the whole file.
    problem : str
        What was expected, what came, and what is available.
    """

    def __init__(self, file: str, key: str, problem: str) -> None:
        super().__init__(f"{file}: {key}: {problem}" if key else f"{file}: {problem}")
        self.file, self.key, self.problem = file, key, problem


class PluginError(ArmlabError):
    """A module found by folder lacks its constant, or two share a key."""


def suggestion(got: str, available: Iterable[str]) -> str:
    """Return ``"; did you mean 'x'? Available: ..."`` for a misspelt name; empty ones are not listed.

    >>> suggestion("puma", ["", "puma560", "ur10"])
    "; did you mean 'puma560'? Available: puma560, ur10"
    """
    names = sorted(filter(None, available))
    close = get_close_matches(got, names, n=1)
    hint = f"; did you mean {close[0]!r}?" if close else "."
    listed = ", ".join(names) if names else "nothing"
    return f"{hint} Available: {listed}"


def in_one_line(error: BaseException) -> str:
    """Return what went wrong and where, for a log that strangers can write into: short, and never more than a line.

    >>> try:
    ...     int("x")
    ... except ValueError as error:
    ...     in_one_line(error).startswith("ValueError: invalid literal for int() with base 10: 'x' (")
    True
    """
    frames = traceback.extract_tb(error.__traceback__)
    place = f" ({frames[-1].filename.rpartition('/')[2]}:{frames[-1].lineno})" if frames else ""
    said = " ".join(str(error).split())
    return f"{type(error).__name__}: {said[:160]}{place}"
