"""Runs of kinematic control: how the arm plays them, the job that makes them, and what is kept."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.control.follow.chosen import setup_of
from armlab.benches.control.follow.clip import configuration
from armlab.benches.control.follow.commands import (
    AddRun,
    SetOffset,
    SetStart,
    SetValue,
)
from armlab.benches.control.follow.examples import ChooseControlExample
from armlab.benches.control.follow.job import JOB, todo, with_outcomes
from armlab.benches.control.follow.runs import direction, outcome_of
from armlab.benches.control.follow.state import Control, fresh, questions
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.transforms import transform
from armlab.session.arm_on_clip import standing
from armlab.session.edits import SetCell
from armlab.session.job import Deliver
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.timeline import OpenClip, Seek, Step, Timeline, duration
from armlab.session.state import State, apply
from support.control import done, opened, short_run


@pytest.fixture(scope="module")
def short():
    return short_run()


# -- playing ---------------------------------------------------------------------------------------------------------


def test_the_arm_plays_the_run_and_is_put_back(short):
    before = short[Joints].q
    state = apply(short, OpenClip("control"))
    assert duration(state) == 0.5
    state = apply(state, Seek(0.3))
    np.testing.assert_allclose(state[Joints].q, standing(state[Joints].arm, short[Control].outcome.run.at(0.3)))
    state = apply(state, Step(True))
    assert state[Timeline].time > 0.3
    closed = apply(state, OpenClip(""))
    np.testing.assert_array_equal(closed[Joints].q, before)
    assert closed[Control].before is None


def test_steps_lead_to_the_instants_at_which_joints_are_fastest():
    state = done(opened(), ChooseControlExample("newton"))
    end = state[Control].outcome.run.duration
    fastest = {peak.time for peak in state[Control].outcome.figures.speeds if 0.0 < peak.time < end}
    assert fastest
    state, met = apply(state, OpenClip("control")), []
    while state[Timeline].time < end:
        state = apply(state, Step(True))
        met.append(state[Timeline].time)
    assert met == [*sorted(fastest), end]


def test_a_new_run_moves_the_arm_where_it_was_played_and_not_where_a_hand_put_it(short):
    state = apply(apply(short, OpenClip("control")), Seek(0.4))
    changed = done(state, SetOffset((0.2, 0.0)))
    np.testing.assert_allclose(changed[Joints].q, configuration(changed, 0.4))
    moved = apply(state, MoveJoint(0, 1.0))
    after = done(moved, SetOffset((0.2, 0.0)))
    assert after[Joints].q[0] == 1.0


def test_a_run_that_becomes_shorter_is_played_at_its_end(short):
    state = apply(apply(short, OpenClip("control")), Seek(0.5))
    shorter = done(state, SetValue("duration", 0.2))
    assert shorter[Timeline].time == pytest.approx(0.2)
    np.testing.assert_allclose(shorter[Joints].q, configuration(shorter, 0.2))


def test_directions_are_those_of_frame_0_of_a_base_that_is_turned():
    robot = catalogue()["planar_2r"]
    turned = Arm.from_dh(
        [("R", 1.0, 0.0, 0.0, 0.0)] * 2, base=transform([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    )
    along = direction(turned, setup_of(robot, azimuth=math.pi / 6))
    # 30 degrees from the x of frame 0, which is the y of the world.
    np.testing.assert_allclose(along, [-0.5, math.sqrt(0.75), 0.0], atol=1e-12)


def test_joints_beyond_their_limits_are_shown_by_whole_turns():
    state = done(opened(), ChooseControlExample("line_170"), SetStart((0.3175604, -0.6351209)))
    end = state[Control].outcome.run.q[-1]
    assert end[0] > math.pi
    state = apply(state, Seek(6.0))
    assert state[Joints].q[0] == pytest.approx(end[0] - 2.0 * math.pi, abs=1e-9)


# -- the job and the part --------------------------------------------------------------------------------------------


def test_the_job_works_while_somebody_looks_and_in_short_pieces(short):
    state = apply(short, SetValue("speed", 0.23))
    assert JOB.wanted(state, frozenset({"velocity"})) is None
    wanted = JOB.wanted(state, frozenset({"control"}))
    assert JOB.wanted(apply(state, OpenClip("control")), frozenset()) is not None
    pieces = list(JOB.run(wanted.inputs))
    delivered = apply(state, Deliver(JOB, wanted.inputs, pieces[-1]))
    assert fresh(delivered)
    assert JOB.wanted(delivered, frozenset({"control"})) is None
    long = apply(state, SetValue("step", 1e-3))
    assert len(list(JOB.run(todo(long)))) > 4


def test_what_was_found_for_another_arm_is_thrown_away(short):
    state = apply(short, SetValue("speed", 0.23))
    missing = todo(state)
    found = [each for each in JOB.run(missing) if each is not None][-1]
    other = apply(state, ChooseRobot("scara"))
    assert JOB.delivered(other, missing, found)[Control].outcomes == {}


def test_it_is_written_down_and_read_back_on_every_arm(robot):
    state = State.initial(robot)
    state = apply(state, SetOffset(tuple(0.01 for _ in range(robot.arm.n))))
    state = apply(apply(state, AddRun()), SetValue("counts", 1000))
    data = json.loads(json.dumps(state.to_json()))
    back = State.from_json(data, state[RobotPart].robot)
    assert back[Control].runs == state[Control].runs
    np.testing.assert_array_equal(back[Control].target, state[Control].target)


def test_every_arm_opens_with_a_run_that_works(robot):
    setup = replace(State.initial(robot)[Control].run, step=0.02, duration=0.5)
    state = State.initial(robot)
    state = state.replace(replace(state[Control], runs=(setup,)))
    outcome = outcome_of(state.derived(questions)[0])
    assert outcome.refused == ""
    assert outcome.run.finished
    assert np.isfinite(outcome.run.q).all()


@pytest.mark.parametrize(
    "damage",
    [
        {"selected": 3},
        {"push": -1.0},
        {"target": [[1.0]]},
        {"runs": []},
        {"before": [0.0]},
    ],
)
def test_damaged_files_are_refused(damage):
    data = {**opened()[Control].to_json(), **damage}
    with pytest.raises((InputError, ValueError, KeyError)):
        Control.from_json(data, catalogue()["planar_2r"])


@pytest.mark.parametrize(
    "damage",
    [{"start": [0.0]}, {"speed": float("nan")}, {"law": "x"}, {"pushes": [[1.0, 2.0]]}, {"colour": 7}, {"mass": 1.0}],
)
def test_damaged_runs_are_refused(damage):
    robot = catalogue()["planar_2r"]
    data = opened()[Control].to_json()
    data["runs"][0] = {**data["runs"][0], **damage}
    with pytest.raises((InputError, ValueError)):
        Control.from_json(data, robot)


def test_an_edited_table_keeps_the_runs_and_another_arm_begins_anew(short):
    edited = apply(short, SetCell(0, "a", 0.8))
    assert edited[Control].runs == short[Control].runs
    assert edited[Control].outcomes == {}
    assert with_outcomes(edited)[Control].outcome.run.finished
    other = apply(short, ChooseRobot("scara"))
    assert len(other[Control].run.start) == 4
    assert setup_of(catalogue()["scara"]).start == other[Control].run.start
