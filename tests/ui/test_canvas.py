"""How the arm moves on screen: at once under a hand, by a short move otherwise, half a second to another solution."""

import asyncio
from contextlib import nullcontext
from types import SimpleNamespace

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.ik.solve_all import solve_all
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.target import GoAnotherWay, Target, jumped_to
from armlab.session.state import State, apply
from armlab.ui import canvas as module
from armlab.ui.canvas import GLIDE_SECONDS, Canvas
from armlab.ui.figure.anatomy import anatomy_of
from armlab.ui.scene import arm as arm_layer

ELBOW = catalogue()["elbow_3r"]


class Clock:
    """A loop whose time passes only from one call to the next, as they were asked for."""

    def __init__(self):
        self.now, self.calls = 0.0, []

    def time(self):
        return self.now

    def call_later(self, wait, call):
        handle = SimpleNamespace(cancel=lambda: self.calls.remove(entry))
        entry = (self.now + wait, call)
        self.calls.append(entry)
        return handle

    def pass_until(self, time):
        while due := [entry for entry in self.calls if entry[0] <= time + 1e-12]:
            entry = min(due, key=lambda each: each[0])
            self.calls.remove(entry)
            self.now = entry[0]
            entry[1]()
        self.now = time


@pytest.fixture
def clock(monkeypatch):
    clock = Clock()
    monkeypatch.setattr(asyncio, "get_running_loop", lambda: clock)
    monkeypatch.setattr(module.adapter, "set_wxyz", lambda node, wxyz: None)
    return clock


@pytest.fixture
def canvas(clock):
    scene = SimpleNamespace(add_frame=lambda name, **_: SimpleNamespace(name=name))
    client = SimpleNamespace(scene=scene, atomic=nullcontext)
    drawn = SimpleNamespace(figure=SimpleNamespace(anatomy=anatomy_of(ELBOW.arm)))
    return Canvas(client, drawn, lambda command: None, np.zeros(3), 1)


def test_a_jump_to_a_solution_takes_half_a_second_however_near_it_is(canvas, clock):
    for goal in (np.array([0.1, 0.0, 0.0]), np.array([2.5, -2.0, 1.0])):
        began, start = clock.now, canvas.shown
        canvas.show_pose(goal, slow=True)
        clock.pass_until(began + 0.25)
        np.testing.assert_allclose(canvas.shown, 0.5 * (start + goal), atol=0.12 * np.abs(goal - start).max())
        clock.pass_until(began + GLIDE_SECONDS[1] - 0.05)
        assert np.abs(canvas.shown - goal).max() > 0.0
        clock.pass_until(began + GLIDE_SECONDS[1] + 0.05)
        np.testing.assert_array_equal(canvas.shown, goal)


def test_the_next_jump_goes_on_from_where_the_arm_is(canvas, clock):
    first, second = np.array([2.0, 0.0, 0.0]), np.array([-1.0, 1.0, 0.0])
    canvas.show_pose(first, slow=True)
    clock.pass_until(0.25)
    between = canvas.shown
    canvas.show_pose(second, slow=True)
    clock.pass_until(0.25 + 1.5 / 30.0)
    # One picture later it has gone on a little on its old way, and is far from both ends.
    assert np.abs(canvas.shown - between).max() < 0.3
    clock.pass_until(0.25 + 0.4)
    assert np.abs(canvas.shown - second).max() > 0.0
    clock.pass_until(0.25 + 0.6)
    np.testing.assert_array_equal(canvas.shown, second)


def test_under_a_hand_the_arm_is_where_it_is_at_once(canvas):
    canvas.show_pose(np.array([0.3, 0.0, 0.0]))
    np.testing.assert_array_equal(canvas.shown, [0.3, 0.0, 0.0])
    assert not canvas.gliding


def test_a_way_to_another_solution_is_a_jump_and_a_picture_of_a_self_motion_is_none():
    state = State.initial(ELBOW)
    assert apply(state, GoAnotherWay())[Target].jumps == 1
    other = solve_all(ELBOW.arm, state[Joints].tool_pose).q[0]
    assert jumped_to(state, other, jumps=0)[Target].jumps == 0


def test_the_arm_layer_shows_a_jump_slowly_and_every_other_motion_as_it_comes():
    seen = []
    canvas = SimpleNamespace(
        drawn=SimpleNamespace(glbs=[]), show_pose=lambda q, at_once, slow: seen.append((at_once, slow)), bare=False
    )
    state = State.initial(ELBOW)
    show = arm_layer.build(canvas, state)
    for command in (MoveJoint(0, 0.2), GoAnotherWay(), MoveJoint(0, 0.3)):
        state = apply(state, command)
        show(state)
    assert seen == [(False, False), (False, True), (False, False)]
