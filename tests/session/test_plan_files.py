"""Motions and plans as files, and back."""

import csv
import io
import json
import math
import re
import subprocess
import sys
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.edits import SetLimits
from armlab.session.jobs.plan import with_plan
from armlab.session.parts.joints import Joints, RandomPose
from armlab.session.parts.plan import Plan, planned, question
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import OpenClip
from armlab.session.plan_commands import SetMove
from armlab.session.plan_files import MOST_SAMPLES, column_names, motion_csv, plan_json
from armlab.session.plan_files_commands import (
    MOST_MADE,
    BackToWaypoints,
    MakeWaypoints,
    ReadMotion,
    ReadPlan,
    reading,
)
from armlab.session.plan_files_script import motion_script
from armlab.session.plan_files_table import MOST_BYTES, MOST_ROWS
from armlab.session.plan_limits import LastFor, LimitJerk, LimitTool, UseShare
from armlab.session.plan_moves import Waypoint
from armlab.session.plan_points import AddWaypoint
from armlab.session.state import State, apply

ROBOTS = ["puma560", "ur10e", "panda", "planar_2r", "scara", "cartesian_3p"]


def opened(key="puma560", points=2, law=None):
    """Return the state of an arm with a plan of so many waypoints, worked out."""
    state = State.initial(catalogue()[key])
    for _ in range(points - 2):
        state = apply(apply(state, RandomPose()), AddWaypoint())
    if law is not None:
        state = apply(state, SetMove(1, law=law))
    return with_plan(state)


def table(state, rate=200.0):
    return motion_csv(state[Joints].arm, planned(state).motion, rate)


def sines(arm, t):
    """Return joint values (len(t), n) inside the limits, rad and m."""
    low, high = arm.limits.T
    return 0.5 * (low + high) + 0.3 * (high - low) * np.sin(np.multiply.outer(t, 1.0 + 0.2 * np.arange(arm.n)))


# -- tables ----------------------------------------------------------------------------------------------------------


def test_a_table_has_units_in_its_header_and_the_motion_in_its_rows():
    state = opened("scara")
    arm, motion = state[Joints].arm, planned(state).motion
    head, *rows = csv.reader(io.StringIO(table(state, 50.0)))
    assert head[:5] == ["time_s", "q1_rad", "q2_rad", "q3_m", "q4_rad"]
    assert head[5:] == [f"qdot{i}_{u}_s" for i, u in zip("1234", ["rad", "rad", "m", "rad"], strict=True)] + [
        f"qddot{i}_{u}_s2" for i, u in zip("1234", ["rad", "rad", "m", "rad"], strict=True)
    ]
    values = np.array(rows, dtype=float)
    t = values[:, 0]
    assert (t[0], t[-1]) == (0.0, pytest.approx(motion.duration, abs=1e-9))
    assert np.ptp(np.diff(t)) < 1e-11
    assert 1.0 / np.diff(t).max() >= 50.0 - 1e-6
    exact = motion.sample(rate=50.0)
    for order, wanted in enumerate((exact.q, exact.qdot, exact.qddot)):
        found = values[:, 1 + order * arm.n : 1 + (order + 1) * arm.n]
        np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-12 if order == 0 else 1e-9)
    assert "-0.000000000" not in table(state, 50.0)


def test_too_many_samples_are_refused_with_their_number():
    state = opened()
    with pytest.raises(InputError, match=rf"10000 make \d+ rows of 20 s; expected at most {MOST_SAMPLES} rows"):
        table(with_plan(apply(state, LastFor(20.0))), 10_000.0)
    for rate in (0.0, -1.0, float("nan"), float("inf"), 10_001.0):
        with pytest.raises(InputError, match="samples a second: expected more than 0 and at most 10000"):
            table(state, rate)


def test_a_motion_at_its_limits_read_again_exceeds_them_only_where_its_acceleration_jumps():
    state = with_plan(apply(opened(), LastFor(2.0)))
    again = planned(with_plan(apply(state, ReadMotion(table(state)))))
    assert again.violations == ()
    fast = opened()
    jumps = planned(fast).motion.edges
    over = planned(with_plan(apply(fast, ReadMotion(table(fast))))).violations
    assert over
    assert all(np.abs(jumps - 0.5 * (each.start + each.end)).min() < 0.06 for each in over)
    assert max(each.end - each.start for each in over) < 0.1


@pytest.mark.parametrize("key", ROBOTS)
def test_a_table_read_again_is_the_same_motion(key):
    state = opened(key, points=3, law="quintic")
    motion = planned(state).motion
    again = with_plan(apply(state, ReadMotion(table(state))))
    found = planned(again).motion
    assert found.duration == pytest.approx(motion.duration, abs=1e-8)
    t = motion.sample(rate=200.0).t
    np.testing.assert_allclose(found.at(t), motion.at(t), rtol=0, atol=1e-6)
    between = 0.5 * (t[1:] + t[:-1])
    # Where the acceleration jumps the spline cannot: by (jump) h² / 27 at most, for h = 5 ms and 100 rad/s².
    np.testing.assert_allclose(found.at(between), motion.at(between), rtol=0, atol=1e-4)
    assert again[Plan].waypoints == state[Plan].waypoints


def test_a_smooth_motion_is_the_same_between_its_samples_too():
    state = opened(law="septic")
    motion = planned(state).motion
    found = planned(with_plan(apply(state, ReadMotion(table(state))))).motion
    t = np.linspace(0.0, motion.duration, 5003)
    np.testing.assert_allclose(found.at(t), motion.at(t), rtol=0, atol=1e-6)


HEADERS = {
    "own": ("time_s,q1_rad,q2_rad", ",", 1.0),
    "plain": ("t,q1,q2", ",", 1.0),
    "degrees": ("time,q1_deg,q2_deg", ",", 180.0 / np.pi),
    "brackets": ("Time [s];q1 [deg];q2 [deg]", ";", 180.0 / np.pi),
    "round": ("t (s)\ttheta1 (rad)\tJoint 2 (rad)", "\t", 1.0),
    "signs": ('"t, s","θ₁, °","q₂, °"', ",", 180.0 / np.pi),
    "numpy": ("# time q1 q2", " ", 1.0),
    "none": ("", ",", 1.0),
}


@pytest.mark.parametrize(
    ("style", "comma"), [(style, comma) for style, (_, apart, _) in HEADERS.items() for comma in {False, apart != ","}]
)
def test_headers_of_other_tools_and_decimal_commas_are_read(style, comma):
    head, apart, factor = HEADERS[style]
    state = State.initial(catalogue()["planar_2r"])
    t = np.linspace(0.0, 2.0, 41)
    q = sines(state[Joints].arm, t)
    rows = [apart.join(f"{value:.12f}" for value in row) for row in np.column_stack([t, factor * q])]
    text = "\ufeff" + "\r\n".join([head, *rows, ""] if head else [*rows, ""])
    recorded = apply(state, ReadMotion(text.replace(".", ",") if comma else text))[Plan].recorded
    np.testing.assert_allclose(recorded.t, t, rtol=0, atol=1e-11)
    np.testing.assert_allclose(recorded.q, q, rtol=0, atol=1e-11)


def test_columns_stand_in_any_order_beside_others_and_in_other_units():
    state = State.initial(catalogue()["scara"])
    arm = state[Joints].arm
    t = np.linspace(0.0, 1.0, 11)
    q = sines(arm, t)
    head = "note,q4_deg,q3_mm,qdot1_rad_s,q2,t_ms,q1_rad,\n"
    rows = [
        f'"x y",{c[3] * 180.0 / math.pi!r},{1e3 * c[2]!r},7,{c[1]!r},{1e3 * s!r},{c[0]!r},\n'
        for s, c in zip(t.tolist(), q.tolist(), strict=True)
    ]
    recorded = apply(state, ReadMotion(head + "".join(rows)))[Plan].recorded
    np.testing.assert_allclose(recorded.t, t, rtol=0, atol=1e-12)
    np.testing.assert_allclose(recorded.q, q, rtol=0, atol=1e-12)


WRONG = {
    "": "the file is empty",
    "\ufeff \r\n\t": "the file is empty",
    "PK\x03\x04\x00": "row 1, column 1: expected text in UTF-8, got a binary file",
    "hello world": "row 1: no column time, q1, q2; there are: hello, world",
    "t,q1\n0,0\n1,0": "row 1: no column q2; there are: t, q1",
    "t,q1,q2,q3\n0,0,0,0": "row 1, column q3: there is no joint 3; this arm has joints 1 to 2",
    "t,q1,q2,q2_deg\n0,0,0,0": "row 1: joint 2 is there twice, in columns q2 and q2_deg",
    "t,q1_mm,q2\n0,0,0": "column q1_mm: expected joint 1, which turns, in rad, deg, degrees, °, got 'mm'",
    "t_h,q1,q2\n0,0,0": "column t_h: expected the time in s, sec, seconds, ms, got 'h'",
    "0,0,0,0\n1,0,0,0": "expected the names time, q1 to q2, or 3 numbers in this order, got 4 numbers",
    "t,q1,q2\n0,0,0\n\n1,nan,0": "row 4, column q1: expected a finite number, got 'nan'",
    "t,q1,q2\n0,0,0\n1,0,-inf": "row 3, column q2: expected a finite number, got '-inf'",
    "t,q1,q2\n0,0,0\n1,<b>x</b>,0": "row 3, column q1: expected a number, got '<b>x</b>'",
    "t,q1,q2\n0,0,0\n1,1_0,0": "row 3, column q1: expected a number, got '1_0'",
    "t,q1,q2\n0,0,0\n1,,0": "row 3, column q1: expected a number, got ''",
    "t,q1,q2\n0,0,0\n1,0": "row 3: expected 3 cells, got 2",
    "t,q1,q2\n0,0,1,0,0": "row 2: expected 3 cells, got 5; decimal commas need semicolons between the cells",
    "t;q1;q2\n0;0;0\n0,5;0;0\n0,5;1;0": "row 4, column t: 0.5 s is not later than 0.5 s in the row before",
    "t,q1,q2\n0,0,0\n2,0,0\n1,0,0": "row 4, column t: 1 s is not later than 2 s in the row before",
    "t,q1,q2\n0,0,0\n1,0,90": "row 3, column q2: 90 rad is outside the limits of joint 2, .*name the column q2_deg",
    "t,q1_deg,q2\n0,0,0\n1,400,0": "row 3, column q1_deg: 400 deg is outside the limits of joint 1, -[0-9.]* to",
    "t,q1,q2\n0,0,0": "expected at least two rows",
    "t,q1,q2": "expected at least two rows",
    "t,q1,q2\n0,0,0\n601,0,0": "it lasts 601 s; at most 600 s can be shown",
}


@pytest.mark.parametrize("text", WRONG)
def test_a_wrong_table_is_refused_with_row_and_column(text):
    state = opened("planar_2r")
    with pytest.raises(InputError, match=WRONG[text]):
        apply(state, ReadMotion(text))


def test_what_is_too_long_is_refused_with_its_limit():
    state = opened("planar_2r")
    line = "{},0,0\n"
    many = "t,q1,q2\n" + "".join(line.format(k) for k in range(2 * MOST_ROWS + 1))
    with pytest.raises(InputError, match=f"{2 * MOST_ROWS + 1} rows are too many; .*keep one row in 3"):
        apply(state, ReadMotion(many))
    for text in ("0,0,0\n" * 10_000_000, "−" * (MOST_BYTES // 2), "{" + " " * MOST_BYTES):
        with pytest.raises(InputError, match=r"the file is larger than 1\.5 MB"):
            apply(state, reading(text))


def test_every_cut_of_a_table_is_read_or_refused():
    state = opened("planar_2r")
    text = table(state, 5.0)
    refused = 0
    for end in range(0, len(text), 7):
        try:
            apply(state, ReadMotion(text[:end]))
        except InputError:
            refused += 1
    assert refused > len(text) / 7 * 0.2


def test_a_recorded_motion_plays_in_its_own_time_and_the_waypoints_wait():
    state = apply(opened(points=3), LastFor(9.0))
    text = table(opened())
    read = apply(state, ReadMotion(text))
    assert (read[Plan].duration, read[Plan].example) == (None, "")
    plan = planned(with_plan(apply(read, OpenClip("motion"))))
    assert plan.legs[0].stretch is None
    assert plan.duration == pytest.approx(planned(opened()).duration, abs=1e-8)
    back = apply(read, BackToWaypoints())
    assert (back[Plan].waypoints, back[Plan].moves) == (state[Plan].waypoints, state[Plan].moves)
    assert back[Plan].recorded is None
    assert apply(back, BackToWaypoints()) is back


# -- waypoints of a motion -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("by", ["time", "shape"])
def test_waypoints_are_samples_of_the_motion_and_the_more_the_closer(by):
    state = State.initial(catalogue()["puma560"])
    arm = state[Joints].arm
    t = np.linspace(0.0, 6.0, 601)
    q = sines(arm, t)
    names = ",".join(["t", *(f"q{i + 1}" for i in range(arm.n))])
    text = "\n".join([names, *(",".join(map(repr, row)) for row in np.column_stack([t, q]).tolist())])
    read = apply(state, ReadMotion(text))
    missed = []
    for count in (3, 8, 20):
        part = apply(read, MakeWaypoints(count, by))[Plan]
        assert len(part.waypoints) == count == len(part.moves) + 1
        assert part.recorded is None
        knots = np.array([point.q for point in part.waypoints])
        away = np.linalg.norm(knots[:, None] - q, axis=2)
        assert away.min(axis=1).max() < 1e-9
        assert (np.diff(away.argmin(axis=1)) > 0).all()
        curve = planned(with_plan(apply(read, MakeWaypoints(count, by)))).samples.q
        missed.append(np.linalg.norm(q[:, None] - curve, axis=2).min(axis=1).max())
    assert missed[2] < 0.15 < missed[1] < missed[0]


def test_farthest_points_are_the_corners():
    state = State.initial(catalogue()["planar_2r"])
    corners = np.array([[0.0, 0.0], [0.9, 0.1], [0.9, 0.8], [0.1, 0.8]])
    way = np.concatenate([np.linspace(a, b, 50)[:-1] for a, b in pairwise(corners)])
    q = np.vstack([way, corners[-1:]])
    rows = "\n".join(f"{k},{a!r},{b!r}" for k, (a, b) in enumerate(q.tolist()))
    part = apply(apply(state, ReadMotion(rows)), MakeWaypoints(4))[Plan]
    np.testing.assert_allclose([point.q for point in part.waypoints], corners, atol=1e-12)
    # More than there are corners make no more waypoints.
    assert len(apply(apply(state, ReadMotion(rows)), MakeWaypoints(15))[Plan].waypoints) == 4


def test_a_closed_motion_a_pause_and_a_standing_arm():
    state = State.initial(catalogue()["planar_2r"])
    closed = "0,0,0\n1,0.5,0.5\n2,0.5,0.5\n3,0.5,0.5\n4,0,0\n"
    for by in ("time", "shape"):
        part = apply(apply(state, ReadMotion(closed)), MakeWaypoints(5, by))[Plan]
        assert [point.q[0] for point in part.waypoints] == [0.0, 0.5, 0.0]
        with pytest.raises(InputError, match="the arm stands still"):
            apply(apply(state, ReadMotion("0,0,0\n1,0,0\n")), MakeWaypoints(5, by))
    with pytest.raises(InputError, match="no recorded motion"):
        apply(state, MakeWaypoints(5))
    for count in (1, MOST_MADE + 1):
        with pytest.raises(InputError, match="expected 2 to 20"):
            apply(apply(state, ReadMotion(closed)), MakeWaypoints(count))


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
    assert planned(with_plan(state)).whole


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
    (("robot",), {"toml": "nonsense"}, "plan: the file does not hold what a plan needs"),
    (("plan",), [], "plan: the file does not hold what a plan needs"),
    (("plan", "waypoints"), [], "expected 1 to 100 waypoints"),
    (("plan", "waypoints"), {}, "expected 1 to 100 waypoints"),
    (("plan", "waypoints", 1, "q"), [0.0], "waypoint: expected 2 finite joint values"),
    (("plan", "waypoints", 1, "q"), [0.0, 400.0], "plan, waypoint 2: joint 2 is outside its limits"),
    (("plan", "waypoints", 1, "q"), [0.0, float("nan")], "expected finite numbers, got NaN"),
    (("plan", "waypoints", 1, "q"), None, "plan: the file does not hold|waypoint"),
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


def table_of_script(state, folder, rate=40.0):
    """Run the script of a plan; returns its header and the numbers it has written."""
    text = motion_script(state[RobotPart], planned(state), rate, "motion.csv")
    (folder / "again.py").write_text(text, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-W", "error", "again.py"], cwd=folder, capture_output=True, text=True, timeout=60, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    head, *rows = (folder / "motion.csv").read_text().splitlines()
    return head, np.array([row.split(",") for row in rows], dtype=float)


def assert_same(state, folder):
    head, found = table_of_script(state, folder)
    arm, motion = state[Joints].arm, planned(state).motion
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


def by_the_wrist():
    return apply(apply(opened(), SetMove(1, space="cartesian", turning="wrist")), LastFor(7.0))


def aside():
    """Return moves that begin elsewhere than their waypoints say: one typed out of its place, one on another branch."""
    state = opened("planar_2r", points=4)
    arm = state[Joints].arm
    points = [Waypoint(q) for q in ((0.1, 0.6), (0.3, 0.9), (0.8, 1.2), (1.4, 0.7))]
    shifted = arm.fk(points[1].q).copy()
    shifted[0, 3] -= 0.2
    points[1] = replace(points[1], pose=tuple(shifted.ravel().tolist()))
    points[2] = Waypoint((0.8 + 1.2, -1.2))
    state = state.replace(replace(state[Plan], waypoints=tuple(points)))
    return apply(state, SetMove(2, space="cartesian"))


def own_table():
    state = apply(State.initial(catalogue()["scara"]), SetLimits(0, -2.5, 2.5))
    return apply(state, SetMove(1, law="septic"))


def recorded():
    state = opened("planar_2r")
    return apply(apply(state, ReadMotion(table(state, 30.0))), LastFor(5.0))


@pytest.mark.parametrize("make", [through_joints, in_space, by_the_wrist, aside, own_table, recorded])
def test_a_script_makes_the_same_motion_and_says_nothing(make, tmp_path):
    state = with_plan(make())
    assert planned(state).whole
    assert_same(state, tmp_path)


def test_a_script_holds_only_what_it_needs_and_no_words_of_a_student():
    state = with_plan(own_table())
    robot = replace(state[RobotPart].robot, name='x"""\nimport os')
    text = motion_script(replace(state[RobotPart], robot=robot), planned(state), 40.0, "motion.csv")
    assert "import os" not in text
    compile(text, "again.py", "exec")
    assert re.search(r"^from armlab\.kin\.motion import Trajectory, law_type, path_type$", text, re.MULTILINE)


def test_of_a_plan_that_ends_early_the_script_makes_what_can_be_run(tmp_path):
    state = opened("planar_2r", points=3)
    away = np.eye(4)
    away[0, 3] = 2.5
    far = replace(state[Plan].waypoints[2], pose=tuple(away.ravel().tolist()))
    state = state.replace(replace(state[Plan], waypoints=(*state[Plan].waypoints[:2], far)))
    state = with_plan(apply(state, SetMove(2, space="cartesian")))
    assert not planned(state).whole
    assert_same(state, tmp_path)
