"""Fixtures of the tests of commands: a working folder with lessons, a command line, the work of students."""

import shutil
from collections.abc import Iterator

import numpy as np
import pytest

from armlab import resources
from armlab.cli import main
from armlab.content import lessons as library_module
from armlab.content.lessons import Library
from armlab.content.robots import catalogue
from armlab.session.parts.joints import MoveJoint
from armlab.session.state import State, apply
from armlab.teaching.hand_in import hand_in
from armlab.teaching.lesson_commands import Answer, GoToStep, OpenLesson, SignAs
from armlab.teaching.parts.lesson import LessonPart
from support.command import end_all
from support.small_lessons import TWO_STEPS, VARIED


@pytest.fixture(autouse=True)
def nothing_left_running() -> Iterator[None]:
    yield
    end_all()


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A working folder with a folder of lessons, and a lab that has one lesson; read anew by each test."""
    real, lab = resources.folder, tmp_path / "lab"
    lab.mkdir()
    shutil.copytree(str(real("lessons") / "first_arm"), lab / "first_arm")
    monkeypatch.setattr(resources, "folder", lambda name: lab if name == "lessons" else real(name))
    found = Library([lab])
    monkeypatch.setattr(library_module, "library", lambda: found)
    monkeypatch.chdir(tmp_path)
    mine = tmp_path / "mine"
    mine.mkdir()
    (mine / "v.md").write_text(VARIED, encoding="utf-8")
    before, _, after = TWO_STEPS.rpartition("## Same")
    (mine / "t.md").write_text(f"{before}## Sum{after}", encoding="utf-8")
    return tmp_path


@pytest.fixture
def typed(capsys, place):
    """Run a command line in this process; returns exit status, output and complaints."""

    def run(*arguments):
        capsys.readouterr()
        try:
            status = main([str(argument) for argument in arguments])
        except SystemExit as end:
            status = end.code
        return status, *capsys.readouterr()

    return run


@pytest.fixture
def work(place):
    """Write the work of a student on variant 3 of the lesson v: all done but the last answer."""
    library_module.add_folder(place / "mine")

    def write(path, student="Ada Lovelace", variant=3):
        state = State.initial(catalogue()["puma560"])
        for command in (SignAs(student), OpenLesson("v", variant=variant)):
            state = apply(state, command)
        goal = state[LessonPart].lesson.values["goal"]
        for command in (MoveJoint(0, np.radians(goal)), GoToStep(1), Answer(f"{goal:g}"), GoToStep(2), Answer("1")):
            state = apply(state, command)
        path = place / path
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(hand_in(state), encoding="utf-8")
        return path

    return write
