"""Armlab: a robot-arm laboratory for a first robotics course.

The kinematics core works alone, in a script or a notebook:

>>> import armlab
>>> arm = armlab.load("planar_2r")
>>> arm.position([0.0, 0.0]).tolist()
[2.0, 0.0, 0.0]
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from armlab.errors import ArmlabError, ContentError, InputError, UnknownName
from armlab.version import VERSION

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from armlab.kin import ik
    from armlab.kin.arm import Arm
    from armlab.kin.dh import Row

__version__ = VERSION

__all__ = [
    "Arm",
    "ArmlabError",
    "ContentError",
    "InputError",
    "Row",
    "UnknownName",
    "check_lesson",
    "ik",
    "load",
    "robots",
]

_LATER = {"Arm": "armlab.kin.arm:Arm", "Row": "armlab.kin.dh:Row", "ik": "armlab.kin.ik"}
"""Names that are imported when somebody first asks for them: the lab serves its page before it needs NumPy."""


def __getattr__(name: str) -> object:
    if name not in _LATER:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module, _, inside = _LATER[name].partition(":")
    found = import_module(module)
    globals()[name] = getattr(found, inside) if inside else found
    return globals()[name]


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


def load(key: str) -> Arm:
    """Return the arm of a robot file, such as ``"puma560"``.

    Raises
    ------
    UnknownName
        There is no such file; the text lists those there are.
    ContentError
        The file is broken.
    """
    from armlab.content.robots import catalogue

    return catalogue()[key].arm


def robots() -> list[str]:
    """Return the keys of all robots, by family."""
    from armlab.content.robots import catalogue

    return list(catalogue().robots)


def check_lesson(key: str, q: ArrayLike, step: int = 1, variant: int = 0) -> tuple[bool, str]:
    """Return whether joint values meet the check of a lesson's step, and what the lesson says, as on screen.

    Parameters
    ----------
    key : str
        Such as ``"first_arm"``.
    q : array_like, shape (n,)
        Radians and metres.
    step : int
        From 1.
    variant : int
        Of a lesson that varies.

    Raises
    ------
    UnknownName, ContentError
        There is no such lesson, or its file cannot be used.
    InputError
        There is no such step, or nothing to check in it; q is of another shape or outside the joint limits.

    Examples
    --------
    >>> import armlab
    >>> armlab.check_lesson("first_arm", [0.0, 0.0])[0]
    True
    """
    from armlab.teaching.play import check_at

    return check_at(key, q, step, variant)
