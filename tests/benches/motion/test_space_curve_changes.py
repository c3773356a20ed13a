"""What a person changes in the laboratory of geometry: points, places, laws, bad input, and what is kept."""

import json
import math

import numpy as np
import pytest

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.space_curve.commands import (
    AddPoint,
    ChooseCurve,
    ChooseLaw,
    GoTo,
    LookAt,
    OwnTimes,
    RemovePoint,
    SetAngle,
    SetOption,
    SetPoint,
    TakeOrientation,
    TypeFormula,
    WriteIn,
)
from armlab.benches.motion.space_curve.examples import EXAMPLES, ChooseExample
from armlab.benches.motion.space_curve.laid import moment
from armlab.benches.motion.space_curve.state import (
    MOST_POINTS,
    SpaceCurve,
    curve_of,
    time_of,
)
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.timeline import Seek, Step, Timeline
from armlab.session.state import apply
from support.space_curves import after, at


def test_points_are_added_moved_and_removed_and_the_film_rewinds():
    state = after(ChooseExample("spline"), Seek(2.0))
    count = len(state[SpaceCurve].points)
    state = after(AddPoint(), SetPoint(count, 2, 0.9), state=state)
    assert state[Timeline].time == 0.0
    assert state[SpaceCurve].points[count][2] == 0.9
    assert state[SpaceCurve].example == ""
    np.testing.assert_allclose(curve_of(state).given.at(1.0), state[SpaceCurve].points[-1], rtol=0, atol=1e-12)
    assert len(apply(state, RemovePoint(0))[SpaceCurve].points) == count
    for _ in range(MOST_POINTS - count - 1):
        state = apply(state, AddPoint())
    with pytest.raises(InputError, match=f"at most {MOST_POINTS}"):
        apply(state, AddPoint())


def test_the_film_goes_where_it_is_sent_and_stops_at_pieces():
    state = after(ChooseExample("square"))
    assert at(state, 0.25).s == pytest.approx(0.25)
    times = []
    for _ in range(9):
        state = apply(state, Step(True))
        times.append(time_of(state))
    assert {1.0, 2.0, 3.0} <= {round(t, 9) for t in times}
    assert times == sorted(times)
    with pytest.raises(InputError, match="on the curve"):
        apply(state, GoTo(1.2))


def test_a_curve_with_times_of_its_own_is_moved_in_them():
    state = after(ChooseCurve("overfly"), ChooseLaw("cubic"), OwnTimes())
    part = state[SpaceCurve]
    assert part.law == Chosen("constant")
    assert part.duration == pytest.approx(curve_of(state).given.duration)
    speed = np.linalg.norm(moment(curve_of(state), 0.01).velocity)
    assert speed == pytest.approx(1.0)
    with pytest.raises(InputError, match="no times of its own"):
        after(ChooseCurve("line"), OwnTimes())


@pytest.mark.parametrize(
    ("commands", "says"),
    [
        ((ChooseCurve("circle"), SetPoint(0, 0, math.nan)), "waypoint 1: expected three finite numbers"),
        ((ChooseCurve("line"), SetPoint(1, 0, 1e9)), "waypoint 2: expected coordinates"),
        (
            (
                ChooseExample("circle"),
                SetPoint(1, 0, 0.5),
                SetPoint(1, 1, 0.0),
                SetPoint(2, 2, 0.0),
            ),
            "waypoint 3: the three points are on a straight line",
        ),
        ((ChooseExample("square"), SetPoint(1, 0, -0.6)), "waypoint 2: the same as waypoint 1"),
        ((ChooseExample("overfly"), SetOption("curve", "amount", [5.0])), "waypoint 2"),
        ((SetOption("law", "nothing", 1.0),), "unknown name"),
        ((TypeFormula(1, "5 s^"),), r"y\(s\): the formula breaks off"),
        ((TypeFormula(0, "6 q"),), r"x\(s\): unknown name 'q'"),
        ((TypeFormula(0, "1/s"),), r"x\(s\) at s = 0: .*division by zero"),
        ((TypeFormula(0, "sin(3000 s)"),), "changes too quickly"),
        ((TypeFormula(0, ""),), r"x\(s\): expected a formula"),
        ((TypeFormula(0, "2"), TypeFormula(1, "2"), TypeFormula(2, "2")), "stays at one point"),
        ((Set(SpaceCurve, "duration", 0.0),), "T: expected 0.05 to 120 s, got 0"),
        ((Set(SpaceCurve, "duration", math.nan),), "duration: expected"),
        ((ChooseCurve("nothing"),), "unknown name"),
        ((ChooseLaw("nothing"),), "unknown name"),
        ((ChooseExample("nothing"),), "unknown name"),
        ((SetAngle("A", 0, math.nan),), "angles of A"),
        ((SetAngle("B", 0, 1e5),), "angles of B"),
        ((TypeFormula(3, "s"),), r"axis \(counted from 0\): expected 0 to 2, got 3"),
        ((TypeFormula(-1, "s"),), r"axis \(counted from 0\): expected 0 to 2, got -1"),
        ((SetAngle("A", 3, 0.1),), r"angle of A \(counted from 0\): expected 0 to 2, got 3"),
        ((SetAngle("B", -1, 0.1),), r"angle of B \(counted from 0\): expected 0 to 2, got -1"),
        ((WriteIn("xxz"),), "unknown name"),
        ((RemovePoint(7),), "expected 1 to 3"),
        ((Set(SpaceCurve, "nothing", True),), "unknown name"),
        ((LookAt("nothing"),), "unknown name"),
        ((TakeOrientation("A", "nothing"),), "unknown name"),
    ],
)
def test_nonsense_is_refused_with_a_reason(commands, says):
    *before, last = commands
    state = after(*before)
    with pytest.raises(InputError, match=says):
        apply(state, last)


def test_it_is_written_read_back_and_kept_with_another_arm():
    for key in EXAMPLES:
        state = after(ChooseExample(key))
        part = state[SpaceCurve]
        read = SpaceCurve.from_json(json.loads(json.dumps(part.to_json())), state[RobotPart].robot)
        assert read == part
        assert apply(state, ChooseRobot("scara"))[SpaceCurve] == part
    good = SpaceCurve().to_json()
    for damage in (
        {"formula": ["s +", "s", "s"]},
        {"points": [[0, 0]]},
        {"curve": {"key": "nothing"}},
        {"duration": math.nan},
        {"axes": "xxz"},
        {"start": [0, 0]},
        {"law": {"key": "cubic", "options": {"nothing": 1}}},
    ):
        with pytest.raises((InputError, ValueError)):
            SpaceCurve.from_json({**good, **damage}, catalogue()["puma560"])
