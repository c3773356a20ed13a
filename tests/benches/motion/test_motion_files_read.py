"""Motions and plans as files, and back."""

import csv
import io
import math
from itertools import pairwise

import numpy as np
import pytest

from armlab.benches.motion.files.commands import (
    MOST_MADE,
    BackToWaypoints,
    MakeWaypoints,
    ReadMotion,
    reading,
)
from armlab.benches.motion.files.read import MOST_SAMPLES
from armlab.benches.motion.files.table import MOST_BYTES, MOST_COLUMNS, MOST_ROWS
from armlab.benches.motion.plan.commands import SetMove
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.limits import LastFor, LimitJerk, LimitTool
from armlab.benches.motion.plan.state import Plan, planned_now
from armlab.benches.motion.plan.words import judged, rounded_up
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import OpenClip
from armlab.session.state import State, apply
from support.plans import ROBOTS, opened, table


def sines(arm, t):
    """Return joint values (len(t), n) inside the limits, rad and m."""
    low, high = arm.limits.T
    return 0.5 * (low + high) + 0.3 * (high - low) * np.sin(np.multiply.outer(t, 1.0 + 0.2 * np.arange(arm.n)))


# -- tables ----------------------------------------------------------------------------------------------------------


def test_a_table_has_units_in_its_header_and_the_motion_in_its_rows():
    state = opened("scara")
    arm, motion = state[Joints].arm, planned_now(state).motion
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
    with pytest.raises(InputError, match=rf"10000 give \d+ rows for 20 s; expected at most {MOST_SAMPLES} rows"):
        table(with_planned(apply(state, LastFor(20.0))), 10_000.0)
    for rate in (0.0, -1.0, float("nan"), float("inf"), 10_001.0):
        with pytest.raises(InputError, match="samples a second: expected more than 0 and at most 10000"):
            table(state, rate)


def test_a_motion_at_its_limits_read_again_keeps_them_and_without_rates_but_for_the_jumps():
    state = with_planned(apply(opened(), LastFor(2.0)))
    again = planned_now(with_planned(apply(state, ReadMotion(table(state)))))
    assert again.violations == ()
    # A table with its rates is believed at its samples.
    fast = opened()
    with_rates = planned_now(with_planned(apply(fast, ReadMotion(table(fast)))))
    assert with_rates.violations == ()
    assert with_rates.fastest == pytest.approx(planned_now(fast).fastest, rel=1e-6)
    # Without them its acceleration swings over where it jumps.
    jumps = planned_now(fast).motion.edges
    over = planned_now(with_planned(apply(fast, ReadMotion(only_positions(fast, 200.0))))).violations
    assert over
    assert all(np.abs(jumps - 0.5 * (each.start + each.end)).min() < 0.06 for each in over)
    assert max(each.end - each.start for each in over) < 0.1


def only_positions(state, rate):
    """Return the planned motion as a table without its rates."""
    return "\n".join(",".join(row.split(",")[: 1 + state[Joints].arm.n]) for row in table(state, rate).splitlines())


def test_a_motion_read_with_its_rates_keeps_a_limit_of_tool_speed_in_the_least_time_that_is_told():
    state = opened("planar_2r")
    read = apply(apply(state, ReadMotion(table(state))), LimitTool(0.2))
    found = planned_now(with_planned(read))
    assert judged(found).kind == "no"
    assert found.least == pytest.approx(found.duration * found.figures.tool_speed / 0.2, rel=1e-3)
    assert judged(planned_now(with_planned(apply(read, LastFor(rounded_up(found.least)))))).kind == "ok"
    assert judged(planned_now(with_planned(apply(read, LastFor(0.99 * found.least))))).kind == "no"


def test_a_motion_read_with_its_rates_keeps_a_limit_of_jerk_if_it_was_planned_with_one():
    state = opened("planar_2r")
    read = apply(apply(state, ReadMotion(table(state))), LimitJerk(0.05))
    found = planned_now(with_planned(read))
    assert {each.quantity for each in found.violations} == {"jerk"}
    assert judged(planned_now(with_planned(apply(read, LastFor(rounded_up(found.least)))))).kind == "ok"
    smooth = with_planned(apply(apply(state, SetMove(1, law="double_s")), LimitJerk(0.05)))
    for rate in (50.0, 200.0, 1000.0):
        again = planned_now(with_planned(apply(smooth, ReadMotion(table(smooth, rate)))))
        assert judged(again).kind == "ok"
        assert again.least == pytest.approx(planned_now(smooth).least, rel=1e-3)


def test_a_motion_read_without_rates_has_the_least_time_of_its_jerk():
    state = opened("planar_2r", law="septic")
    smooth = with_planned(apply(state, LimitJerk(0.5)))
    read = apply(smooth, ReadMotion(only_positions(state, 50.0)))
    least = planned_now(with_planned(read)).least
    assert least == pytest.approx(planned_now(smooth).least, rel=0.02)
    assert judged(planned_now(with_planned(apply(read, LastFor(rounded_up(least)))))).kind == "ok"


@pytest.mark.parametrize("key", ROBOTS)
def test_a_table_read_again_is_the_same_motion(key):
    state = opened(key, points=3, law="quintic")
    motion = planned_now(state).motion
    again = with_planned(apply(state, ReadMotion(table(state))))
    found = planned_now(again).motion
    assert found.duration == pytest.approx(motion.duration, abs=1e-8)
    t = motion.sample(rate=200.0).t
    np.testing.assert_allclose(found.at(t), motion.at(t), rtol=0, atol=1e-6)
    between = 0.5 * (t[1:] + t[:-1])
    # Where the acceleration jumps the spline cannot: by (jump) h² / 27 at most, for h = 5 ms and 100 rad/s².
    np.testing.assert_allclose(found.at(between), motion.at(between), rtol=0, atol=1e-4)
    assert again[Plan].waypoints == state[Plan].waypoints


def test_a_smooth_motion_is_the_same_between_its_samples_too():
    state = opened(law="septic")
    motion = planned_now(state).motion
    found = planned_now(with_planned(apply(state, ReadMotion(table(state))))).motion
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
    head = "note,q4_deg,q3_mm,qdot1_rad_s,q2,q1_dot,theta2_ref,t_ms,q1_rad,time_sent,\n"
    rows = [
        f'"x y",{c[3] * 180.0 / math.pi!r},{1e3 * c[2]!r},7,{c[1]!r},8,9,{1e3 * s!r},{c[0]!r},10,\n'
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
    "t,q1_mm,q2\n0,0,0": "column q1_mm: expected joint 1, which is revolute, in rad, deg, degrees, °, got 'mm'",
    "t,q1_dot,q1_ref,q2\n0,0,0,0": "column q1_dot: expected joint 1, which is revolute, in rad, deg, .*got 'dot'",
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


def test_columns_of_others_are_passed_over_up_to_a_limit():
    state = opened("planar_2r")
    others = [f"x{k}" for k in range(MOST_COLUMNS - 3)]
    rows = [["t", "q1", "q2", *others], *(["0"] * MOST_COLUMNS, ["1"] * MOST_COLUMNS)]
    assert apply(state, ReadMotion("\n".join(map(",".join, rows)))) is not None
    for apart in (",", ";", "\t", " "):
        wide = "\n".join(apart.join([*row, "1"]) for row in rows)
        with pytest.raises(InputError, match=f"row 1: {MOST_COLUMNS + 1} columns are too many; at most {MOST_COLUMNS}"):
            apply(state, ReadMotion(wide))


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
    planned = planned_now(with_planned(apply(read, OpenClip("motion"))))
    assert planned.legs[0].stretch is None
    assert planned.duration == pytest.approx(planned_now(opened()).duration, abs=1e-8)
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
        curve = planned_now(with_planned(apply(read, MakeWaypoints(count, by)))).samples.q
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
    there_and_back = "".join(f"{t},{math.sin(math.pi * t)},0\n" for t in np.linspace(0.0, 2.0, 21))
    for count, by, says in (
        (2, "shape", "waypoints: the motion ends where it began; take more than 2"),
        (
            3,
            "time",
            "waypoints: at 3 evenly spaced times the arm is where it began; take more, or choose them by shape",
        ),
    ):
        with pytest.raises(InputError, match=says):
            apply(apply(state, ReadMotion(there_and_back)), MakeWaypoints(count, by))
    with pytest.raises(InputError, match="no recorded motion"):
        apply(state, MakeWaypoints(5))
    for count in (1, MOST_MADE + 1):
        with pytest.raises(InputError, match="expected 2 to 20"):
            apply(apply(state, ReadMotion(closed)), MakeWaypoints(count))
