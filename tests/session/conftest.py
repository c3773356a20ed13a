"""Fixtures of the tests of the engine."""

import pytest

from armlab.content.robots import Robot, catalogue
from support.arms import KINDS


@pytest.fixture(params=KINDS)
def robot(request: pytest.FixtureRequest) -> Robot:
    """A robot of each kind of structure: what all of them can do is the mathematics' to show."""
    return catalogue()[request.param]
