"""Fixtures of the tests of the front."""

import pytest

from armlab.front import start as start_module
from armlab.front.processes import LabProcesses


@pytest.fixture
def labs(monkeypatch):
    """The lab processes of each lab that is opened."""
    found = []

    class Noted(LabProcesses):
        def __init__(self, *arguments):
            super().__init__(*arguments)
            found.append(self)

    monkeypatch.setattr(start_module, "LabProcesses", Noted)
    return found
