"""Plans as files, and scripts that make a motion again."""

import io
import json
import re
import runpy
import subprocess
import sys
import warnings
from contextlib import chdir, redirect_stderr, redirect_stdout
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.motion.files.commands import (
    ReadMotion,
    ReadPlan,
    reading,
)
from armlab.benches.motion.files.read import column_names, plan_json
from armlab.benches.motion.files.script import motion_script
from armlab.benches.motion.plan.commands import SetMove
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.limits import LastFor, LimitJerk, LimitTool, UseShare
from armlab.benches.motion.plan.moves import Waypoint
from armlab.benches.motion.plan.state import Plan, planned_now, question
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin import ik
from armlab.session.edits import SetLimits
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import OpenClip
from armlab.session.state import State, apply
from support.plans import ROBOTS, opened, table

# -- plans -----------------------------------------------------------------------------------------------------------


def edited_plan(key):
    """Return a plan in which something is not as it opens."""
    state = opened(key, points=4)
    for command in (UseShare(velocity=0.5), LimitTool(0.4), LimitJerk(0.2)):
        state = apply(state, command)
    for command in (SetMove(1, law="double_s"), SetMove(2, space="cartesian"), LastFor(12.0)):
        try:
            state = apply(state, command)
        except InputError:
            continue
    return state


@pytest.mark.parametrize("key", ROBOTS)
def test_a_plan_read_again_is_exactly_the_same(key):
    state = edited_plan(key)
    text = plan_json(state)
    other = apply(State.initial(catalogue()[key]), ReadPlan(text))
    assert other.derived(question) == state.derived(question)
    again = plan_json(other)
    assert again == text
    recorded = apply(opened(key), ReadMotion(table(opened(key))))
    assert apply(opened(key), ReadPlan(plan_json(recorded))).derived(question) == recorded.derived(question)


def test_a_plan_of_another_arm_brings_its_arm_along():
    text = plan_json(edited_plan("ur10e"))
    state = apply(State.initial(catalogue()["puma560"]), reading("\ufeff\n" + text))
    assert state[RobotPart].robot is catalogue()["ur10e"]
    assert plan_json(state) == text
    assert planned_now(with_planned(state)).whole


def test_a_plan_of_an_own_table_brings_the_table_along():
    own = apply(State.initial(catalogue()["planar_2r"]), SetLimits(0, -3.0, 2.5))
    text = plan_json(own)
    state = apply(State.initial(catalogue()["puma560"]), ReadPlan(text))
    assert state[RobotPart].own
    np.testing.assert_allclose(state[Joints].arm.limits[0], [-3.0, 2.5], atol=1e-12)
    assert state[Plan].waypoints == own[Plan].waypoints
    # The same table stays as it is, so that the question is exactly the same.
    assert apply(own, ReadPlan(text)).derived(question) == own.derived(question)


def test_what_goes_on_in_the_lab_does_not_travel():
    state = apply(opened(), OpenClip("motion"))
    assert state[Plan].before is not None
    assert "before" not in json.loads(plan_json(state))["plan"]
    read = apply(state, ReadPlan(plan_json(opened(points=3))))
    assert read[Plan].before == state[Plan].before


def changed(path, value):
    data = json.loads(plan_json(opened("planar_2r")))
    place = data
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    return json.dumps(data)


BROKEN = [
    ("{", "plan, row 1, column 2: "),
    ('{\n"format": }', "plan, row 2, column 11: "),
    ("{" * 100_000, "plan: the file does not hold|plan, row 1"),
    ('{"format": "other"}', 'expected a file with "format": "armlab plan"'),
    (("version",), 2, "expected version 1 of the format, got 2"),
    (("robot",), "pumpa560", "unknown name 'pumpa560'"),
    (("robot",), {"toml": "nonsense"}, "plan: the file lacks what a plan needs"),
    (("plan",), [], "plan: expected waypoints and moves by name"),
    (("plan", "waypoints"), [], "expected 1 to 100 waypoints"),
    (("plan", "waypoints"), {}, "plan, waypoints: expected a list"),
    (("plan", "waypoints", 1, "q"), [0.0], "waypoint 2: expected 2 finite joint values"),
    (("plan", "waypoints", 1, "q"), [0.0, 400.0], "plan, waypoint 2: joint 2 is outside its limits"),
    (("plan", "waypoints", 1, "q"), [0.0, float("nan")], "expected finite numbers, got NaN"),
    (("plan", "waypoints", 1, "q"), None, "waypoint 2: expected 2 finite joint values"),
    (("plan", "moves", 0, "path"), {"key": "polynominal"}, "unknown name 'polynominal'"),
    (("plan", "velocity"), [1.0], "limits of velocity: expected 2"),
    (("plan", "duration"), -1.0, "duration"),
    (("plan", "recorded"), {"t": [0.0, 0.0], "q": [[0, 0], [0, 0]]}, "row 2: its time is not later"),
]


@pytest.mark.parametrize("case", BROKEN, ids=[f"{case[0]!s:.40}" + f"{case[1]!s:.20}" for case in BROKEN])
def test_a_broken_plan_is_refused_in_words(case):
    text = case[0] if isinstance(case[0], str) else changed(*case[:2])
    with pytest.raises(InputError, match=case[-1]):
        apply(opened("planar_2r"), ReadPlan(text))


def test_two_waypoints_at_one_place_are_refused():
    data = json.loads(plan_json(opened("planar_2r")))
    data["plan"]["waypoints"][1] = data["plan"]["waypoints"][0]
    with pytest.raises(InputError, match="waypoint 2: the same configuration as waypoint 1"):
        apply(opened("planar_2r"), ReadPlan(json.dumps(data)))


# -- scripts ---------------------------------------------------------------------------------------------------------


def run_alone(folder):
    """Run the script in an interpreter of its own, which takes a second or two to get going; return what it says."""
    done = subprocess.run(
        [sys.executable, "-W", "error", "again.py"], cwd=folder, capture_output=True, text=True, timeout=60, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout + done.stderr


def run_here(folder):
    """Run the script in this interpreter, with names of its own and warnings as errors; return what it says."""
    said = io.StringIO()
    with chdir(folder), redirect_stdout(said), redirect_stderr(said), warnings.catch_warnings():
        warnings.simplefilter("error")
        runpy.run_path("again.py", run_name="__main__")
    return said.getvalue()


def table_of_script(state, folder, run, rate=40.0):
    """Run the script of a plan; returns its header and the numbers it has written."""
    text = motion_script(state[RobotPart], planned_now(state), rate, "motion.csv")
    (folder / "again.py").write_text(text, encoding="utf-8")
    assert run(folder) == ""
    head, *rows = (folder / "motion.csv").read_text().splitlines()
    return head, np.array([row.split(",") for row in rows], dtype=float)


def assert_same(state, folder, run):
    head, found = table_of_script(state, folder, run)
    arm, motion = state[Joints].arm, planned_now(state).motion
    assert tuple(head.split(",")) == column_names(arm)
    samples = motion.sample(rate=40.0)
    assert len(found) == len(samples.t)
    np.testing.assert_allclose(found[:, 0], samples.t, rtol=0, atol=1e-9)
    np.testing.assert_allclose(found[:, 1 : 1 + arm.n], samples.q, rtol=0, atol=1e-9)
    np.testing.assert_allclose(found[:, 1 + arm.n : 1 + 2 * arm.n], samples.qdot, rtol=0, atol=1e-8)


def through_joints():
    state = opened(points=5)
    for command in (SetMove(1, path="spline"), SetMove(2, path="spline"), SetMove(3, law="double_s")):
        state = apply(state, command)
    return apply(apply(state, UseShare(velocity=0.6)), LimitTool(0.5))


def in_space():
    """Return a turn on one line, a spline through three poses, and a joint move."""
    state = opened("ur10e", points=5)
    q = np.array(state[Plan].waypoints[0].q)
    steps = np.array(
        [[0, 0, 0, 0, 0, 0], [3, 1, -2, 1, 2, 4], [5, 2, 1, -3, 1, 5], [6, 4, 2, -2, 3, 6], [8, 1, 3, 1, 0, 4]]
    )
    points = tuple(Waypoint(tuple(row)) for row in (q + 0.1 * steps).tolist())
    state = state.replace(replace(state[Plan], waypoints=points))
    state = apply(state, SetMove(1, space="cartesian", turning="euler", stop=True))
    for k in (2, 3):
        state = apply(state, SetMove(k, space="cartesian"))
    return apply(state, SetMove(2, path="spline"))


def round_corners_in_space():
    """Return straight lines through three poses, at whose corners the tool also begins to turn another way."""
    return apply(in_space(), SetMove(2, path="polyline"))


def by_the_wrist():
    return apply(apply(opened(), SetMove(1, space="cartesian", turning="wrist")), LastFor(7.0))


def aside():
    """Return moves that begin elsewhere than their waypoints say: one typed out of its place, one on another branch."""
    state = opened("planar_2r", points=4)
    arm = state[Joints].arm
    points = [Waypoint(q) for q in ((0.1, 0.6), (0.3, 0.9), (0.8, 1.2), (1.4, 0.7))]
    shifted = arm.fk(points[1].q).copy()
    shifted[0, 3] -= 0.2
    points[1] = Waypoint(tuple(ik.solve(arm, shifted, points[1].q).q.tolist()), tuple(shifted.ravel().tolist()))
    points[2] = Waypoint((0.8 + 1.2, -1.2))
    state = state.replace(replace(state[Plan], waypoints=tuple(points)))
    return apply(state, SetMove(2, space="cartesian"))


def own_table():
    state = apply(State.initial(catalogue()["scara"]), SetLimits(0, -2.5, 2.5))
    return apply(state, SetMove(1, law="septic"))


def each_joint_by_itself():
    """Return a move in which each joint goes by itself, slowed by the tool, and one that begins where it ended."""
    state = opened("puma560", points=3, law="double_s")
    for command in (SetMove(1, apart=True), SetMove(2, apart=True, law="quintic"), LimitJerk(0.2), LimitTool(0.4)):
        state = apply(state, command)
    return state


def each_joint_by_itself_in_a_time():
    return apply(each_joint_by_itself(), LastFor(9.0))


def time_optimal():
    """Return a spline of joints and a line in space, each as fast as can be, and a corner that is not stopped at."""
    state = opened("puma560", points=6)
    for k in (1, 2):
        state = apply(apply(state, SetMove(k, path="spline")), SetMove(k, law="time_optimal"))
    for k in (4, 5):
        state = apply(state, SetMove(k, path="polyline"))
    return apply(state, LimitTool(0.9))


def time_optimal_in_space_in_a_time():
    state = apply(opened("ur10e"), SetMove(1, space="cartesian"))
    return apply(apply(state, SetMove(1, law="time_optimal")), LastFor(9.0))


def recorded():
    state = opened("planar_2r")
    return apply(apply(state, ReadMotion(table(state, 30.0))), LastFor(5.0))


@pytest.mark.parametrize(
    "make",
    [
        through_joints,
        in_space,
        round_corners_in_space,
        by_the_wrist,
        aside,
        own_table,
        each_joint_by_itself,
        each_joint_by_itself_in_a_time,
        time_optimal,
        time_optimal_in_space_in_a_time,
        recorded,
    ],
)
def test_a_script_makes_the_same_motion_and_says_nothing(make, tmp_path):
    state = with_planned(make())
    assert planned_now(state).whole
    assert_same(state, tmp_path, run_alone if make is in_space else run_here)


def test_a_script_holds_only_what_it_needs_and_no_words_of_a_student():
    state = with_planned(own_table())
    robot = replace(state[RobotPart].robot, name='x"""\nimport os')
    text = motion_script(replace(state[RobotPart], robot=robot), planned_now(state), 40.0, "motion.csv")
    assert "import os" not in text
    compile(text, "again.py", "exec")
    assert re.search(r"^from armlab\.kin\.motion import Limits, Trajectory, law_type, path_type$", text, re.MULTILINE)


def test_of_a_plan_that_ends_early_the_script_makes_what_can_be_run(tmp_path):
    state = opened("planar_2r", points=3)
    away = np.eye(4)
    away[0, 3] = 2.5
    far = replace(state[Plan].waypoints[2], pose=tuple(away.ravel().tolist()))
    state = state.replace(replace(state[Plan], waypoints=(*state[Plan].waypoints[:2], far)))
    state = with_planned(apply(state, SetMove(2, space="cartesian")))
    assert not planned_now(state).whole
    assert_same(state, tmp_path, run_alone)
