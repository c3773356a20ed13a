"""Armlab: a robot-arm laboratory for a first robotics course.

The kinematics core works alone, in a script or a notebook:

>>> import armlab
>>> arm = armlab.load("planar_2r")
>>> arm.position([0.0, 0.0]).tolist()
[2.0, 0.0, 0.0]
"""

from __future__ import annotations

from armlab.content.robots import catalogue
from armlab.errors import ArmlabError, ContentError, InputError, UnknownName
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.dh import Row

__version__ = "0.1.0"

__all__ = ["Arm", "ArmlabError", "ContentError", "InputError", "Row", "UnknownName", "ik", "load", "robots"]


def load(key: str) -> Arm:
    """Return the arm of a robot file, such as ``"puma560"``.

    Raises
    ------
    UnknownName
        There is no such file; the text lists those there are.
    ContentError
        The file is broken.
    """
    return catalogue()[key].arm


def robots() -> list[str]:
    """Return the keys of all robots, by family."""
    return list(catalogue().robots)
