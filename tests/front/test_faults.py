"""A lab of a class that dies is started again, and its students find their arms."""

import json
import socket
import time

import numpy as np
import pytest

from armlab.errors import ArmlabError
from armlab.front import processes as module
from armlab.front.processes import LabProcesses
from support.fake_browser import cookie_of
from support.lab import running_lab
from support.patience import Patience
from support.student import run, student


def wait_for(condition):
    patience = Patience()
    while not condition():
        assert patience.left(), "the condition did not come true"
        time.sleep(0.05)


async def first_joint(url, cookie, value=None):
    """Return where joint 1 of a student stands, after it has been moved if a value is given."""
    browser = await student(url, cookie)
    if value is not None:
        await browser.set_value(browser.slider(1), value)
        watching = await student(url, cookie)
        await watching.until(lambda: watching.slider(1)["value"] == value)
        await watching.close()
    found = browser.slider(1)["value"]
    await browser.close()
    return found


def saved(folder):
    """Return where joint 1 of the only student stands in the file, in degrees."""
    files = list((folder / "sessions").glob("*.json"))
    return np.degrees(json.loads(files[0].read_text())["parts"]["joints"]["q"][0]) if files else None


def can_be_reached(address):
    with socket.socket(socket.AF_UNIX) as asking:
        return asking.connect_ex(address) == 0


def test_a_lab_that_dies_is_started_again_and_its_students_find_their_arms(tmp_path, labs):
    with running_lab(tmp_path, labs=1) as url:
        (opened,) = labs
        cookie, (process,) = cookie_of(url), opened._processes
        assert run(first_joint(url, cookie, 33.0)) == 33.0
        wait_for(lambda: saved(tmp_path) == pytest.approx(33.0))
        process.kill()
        wait_for(lambda: opened._processes[0] is not process and can_be_reached(opened.addresses[0]))
        assert run(first_joint(url, cookie)) == 33.0


def test_a_lab_that_cannot_be_started_is_said_and_leaves_no_process(monkeypatch):
    monkeypatch.setattr(module.sys, "executable", "/bin/true")
    with pytest.raises(ArmlabError, match="a lab process could not be started"):
        LabProcesses(2, "puma560", None)


def test_a_lab_that_dies_again_and_again_is_started_more_and_more_seldom(monkeypatch):
    labs = LabProcesses(1, "puma560", None)
    started = []
    monkeypatch.setattr(labs, "_start_again", lambda k: started.append(time.monotonic()))
    labs._processes[0].kill()
    labs._processes[0].wait()
    wait_for(lambda: len(started) == 3)
    labs.stop()
    assert started[1] - started[0] >= 1.0
    assert started[2] - started[1] >= 2.0
