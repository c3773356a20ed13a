"""The bench of timing laws: what changes it, its examples, film and calculator, and what is refused."""

import json
import math

import numpy as np
import pytest

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.laws.bounds import Bounded, joint_paths
from armlab.benches.motion.laws.clip import CLIP, present_time
from armlab.benches.motion.laws.commands import (
    AddLaw,
    AsFastAsAllowed,
    ChooseBoundPath,
    ChooseLaw,
    LeaveAsTyped,
    RemoveLaw,
    SetBound,
    SetBoundOption,
    SetLawOption,
    SetQuantity,
    Stretch,
    StretchOptimally,
    TakeBounds,
)
from armlab.benches.motion.laws.examples import EXAMPLES, ChooseLawExample
from armlab.benches.motion.laws.state import Laws
from armlab.benches.motion.laws.timing import excesses
from armlab.benches.motion.laws.words import optimal_text
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.motion import free_law_types
from armlab.kin.timing.table import PLUS_MINUS_ONE
from armlab.session.fields import Set
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.timeline import OpenClip, Seek, Step, Timeline, duration
from armlab.session.state import apply
from support.laws import after, bench, example

# -- the state ---------------------------------------------------------------------------------------------------------


def test_laws_are_added_chosen_and_taken_away():
    state = after(AddLaw())
    part = state[Laws]
    assert [entry.colour for entry in part.entries] == [0, 1, 2]
    assert len({entry.chosen.key for entry in part.entries}) == 3
    with pytest.raises(InputError, match="at most 3 laws"):
        apply(state, AddLaw())
    part = after(Set(Laws, "scaled", 2), RemoveLaw(1), state=state)[Laws]
    assert [entry.colour for entry in part.entries] == [0, 2]
    assert part.scaled == 1
    # The law that is stretched stays the same one where its place changes.
    assert after(Set(Laws, "scaled", 1), RemoveLaw(0), state=state)[Laws].scaled == 0
    one = after(Set(Laws, "scaled", 2), RemoveLaw(1), RemoveLaw(0), state=state)
    with pytest.raises(InputError, match="the last law cannot be removed"):
        apply(one, RemoveLaw(0))
    assert apply(one, AddLaw())[Laws].entries[1].colour == 0
    assert apply(one, ChooseLaw(0, one[Laws].entries[0].chosen.key)) is one


def test_a_law_that_needs_a_limit_is_not_the_one_that_is_added():
    """Without V, A and J only bang-bang and the like could be as fast as allowed."""
    state = after(SetQuantity("speed", None), AsFastAsAllowed(True), AddLaw())
    assert state[Laws].entries[2].chosen.key not in ("constant", "double_s")


def test_a_table_is_left_as_typed_or_stretched():
    state = after(ChooseLawExample("bang_coast_bang"), LeaveAsTyped(1, False), SetQuantity("speed", 0.5))
    assert state[Laws].laws[1].peak_speed == pytest.approx(0.5)
    typed = apply(state, LeaveAsTyped(1, True))[Laws]
    assert typed.laws[1].duration == 3.0
    assert [each.order for each in excesses(typed.entries[1], typed.timing)] == [1]
    with pytest.raises(InputError, match="it cannot be scaled to end at 1"):
        apply(after(ChooseLawExample("plus_minus_one")), LeaveAsTyped(0, False))


@pytest.mark.parametrize("key", list(EXAMPLES))
def test_examples_are_put_in_place_written_and_read_back(key):
    state = after(OpenClip("laws"), Seek(1.0), ChooseLawExample(key))
    part = state[Laws]
    assert part.example == key
    assert part.bounds_shown == EXAMPLES[key].bounds_shown
    assert state[Timeline].time == 0.0
    read = Laws.from_json(json.loads(json.dumps(part.to_json())), state[RobotPart].robot)
    assert read == part
    assert apply(state, SetQuantity("distance", 7.0))[Laws].example == ""
    assert apply(state, Set(Laws, "bounds_shown", not part.bounds_shown))[Laws].example == key
    assert apply(state, ChooseRobot("puma560"))[Laws] == part


def test_the_sentences_of_examples_are_true():
    same = example("same_limits")
    assert min(law.duration for law in same.laws) == same.laws[0].duration
    double, trapezoid = example("double_s").laws
    assert double.duration > trapezoid.duration
    assert (double.continuity_from_rest, trapezoid.continuity_from_rest) == (2.0, 1.0)
    jumps = np.diff(np.concatenate([[0.0], trapezoid.at(trapezoid.edges[:-1], 2), [0.0]]))
    assert np.count_nonzero(np.abs(jumps) > 1e-9) == 4
    assert [law.continuity_from_rest for law in example("smoothness").laws] == [1.0, 2.0, 3.0]
    assert [float(law.at(0.0, 3)) == 0.0 for law in example("smoothness").laws] == [False, False, True]
    ends = example("end_speeds")
    for law in ends.laws:
        np.testing.assert_allclose(law.at([0.0, law.duration], 1), [0.3, 0.6], rtol=0, atol=1e-9)
    one, other = example("bang_coast_bang").laws
    t = np.linspace(0.0, 3.0, 50)
    np.testing.assert_allclose(one.at(t), other.at(t), rtol=0, atol=1e-12)
    assert PLUS_MINUS_ONE[-1][1] == 8


def test_the_film_lasts_as_long_as_the_slowest_and_stops_where_formulas_change():
    state = after(ChooseLawExample("bang_coast_bang"), Stretch(2.0), OpenClip("laws"))
    assert duration(state) == pytest.approx(6.0)
    assert CLIP.stops(state) == pytest.approx((1.0, 2.0, 3.0, 4.0))
    stepped = after(Step(True), Step(True), state=state)
    assert present_time(stepped) == pytest.approx(2.0)
    assert present_time(after()) == 0.0
    assert after(Seek(6.0), Stretch(1.0), state=state)[Timeline].time == pytest.approx(3.0)


# -- bounds ------------------------------------------------------------------------------------------------------------


def test_more_or_fewer_joints_keep_limits_and_drop_the_options_of_the_path():
    part = bench(SetBound("knots", [[0, 0, 0], [1, 2, 3]]))
    assert part.bounded.v_max == (3.0, 2.0, 2.0)
    assert part.bounded.path == Chosen("polynomial")
    one = bench(SetBound("knots", [[0], [1]]), SetBound("a_max", [4.0]))
    assert (one.bounded.v_max, one.bounded.a_max) == ((3.0,), (4.0,))
    assert pytest.approx(3.0) == one.bounded.found.V


@pytest.mark.parametrize("key", list(joint_paths()))
def test_every_path_between_joints_gives_a_bound(key):
    rows = [[float(i), 0.4 * i * i] for i in range(joint_paths()[key].least)]
    # The spline takes any number of knots; from there each kind is chosen.
    state = after(ChooseBoundPath("spline"), SetBound("knots", rows), ChooseBoundPath(key))
    bounded = state[Laws].bounded
    assert bounded.path.key == key
    assert 0.0 < bounded.found.V < math.inf
    assert Bounded.from_json(json.loads(json.dumps(bounded.to_json()))) == bounded


def test_the_bound_holds_on_the_path():
    """|qdot| of the fastest trapezoid within V and A never exceeds the limits of the joints."""
    state = after(SetBound("a_max", [9.0, 8.0]), SetBound("speed", 0.4), TakeBounds(), ChooseLaw(0, "trapezoidal"))
    part = state[Laws]
    path = joint_paths()["polynomial"].path(part.bounded.knots, **part.bounded.path.options)
    law = part.laws[0]
    t = np.linspace(0.0, law.duration, 2000)
    s, speed, acceleration = law.derivatives(t, (0, 1, 2))
    q1, q2 = path.derivatives(np.clip(s, 0.0, 1.0), (1, 2))
    assert np.all(np.abs(q1 * speed[:, None]) <= np.array([3.0, 2.0]) + 1e-9)
    assert np.all(np.abs(q1 * acceleration[:, None] + q2 * speed[:, None] ** 2) <= np.array([9.0, 8.0]) + 1e-9)


# -- what is refused ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("command", "says"),
    [
        (SetQuantity("duration", 0.0), "duration: expected more than 0 s, got 0 s"),
        (SetQuantity("duration", math.nan), "duration: expected finite numbers"),
        (SetQuantity("duration", None), "duration T: expected a positive number, got nothing"),
        (SetQuantity("duration", 1e9), "duration T: expected 0.0001 to 1 000 000 s, got 1e+09 s"),
        (SetQuantity("distance", 1e9), "distance L: expected 0.0001 to 1 000 000, got 1e+09"),
        (SetQuantity("distance", -1.0), "distance: expected more than 0"),
        (SetQuantity("speed", 0.0), "speed: expected more than 0"),
        (SetQuantity("acceleration", 0.0), "acceleration: expected more than 0"),
        (SetQuantity("jerk", math.inf), "jerk: expected finite numbers"),
        (SetQuantity("mood", 1.0), "unknown quantity 'mood'"),
        (ChooseLaw(0, "sine"), "sine"),
        (ChooseLaw(5, "cubic"), "law (counted from 0): expected 0 to 1, got 5"),
        (SetLawOption(0, "ramp", 0.2), "ramp"),
        (LeaveAsTyped(0, True), "cubic"),
        (Stretch(0.0), "k: expected at least 0.001 and at most 1000, got 0"),
        (Stretch(math.nan), "k: expected"),
        (Set(Laws, "scaled", 2), "law to stretch: expected 1 to 2"),
        (ChooseLawExample("nothing"), "nothing"),
        (SetBound("knots", [[1.0, 2.0]]), "waypoints"),
        (SetBound("knots", [[1.0, 2.0], [1.0, 2.0]]), "waypoint"),
        (SetBound("knots", [[0.0] * 4, [1.0] * 4]), "1 to 3 joints"),
        (SetBound("knots", [[float(i)] for i in range(41)]), "at most 40 rows"),
        (SetBound("knots", [[0.0, math.nan], [1.0, 1.0]]), "knots: expected finite numbers"),
        (SetBound("v_max", [0.0, 1.0]), "v_max: expected a positive number"),
        (SetBound("v_max", [1.0, 1.0, 1.0]), "limit of velocity: expected one number, or 2: one for each joint"),
        (SetBound("v_max", None), "v_max: expected limits of speed, a joint each, got nothing"),
        (SetBound("speed", 0.6), "speed: expected more than 0 and at most V = 0.5"),
        (SetBound("mood", 0.6), "unknown field 'mood'"),
        (ChooseBoundPath("helix"), "helix"),
        (SetBoundOption("mood", 1.0), "mood"),
    ],
)
def test_nonsense_is_refused_and_the_field_is_named(command, says):
    with pytest.raises(InputError) as refusal:
        apply(after(), command)
    assert says in str(refusal.value)


@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("ramp", 0.6, "ramp: expected more than 0 and at most 0.5, got 0.6"),
        ("ramp", 0.0, "ramp: expected more than 0"),
        ("sdot_start", -1.0, "sdot_start: expected at least 0"),
        ("sdot_start", 50.0, "sdot_start and sdot_end"),
    ],
)
def test_ramps_and_end_speeds_of_a_trapezoid_are_checked(name, value, says):
    with pytest.raises(InputError) as refusal:
        after(ChooseLaw(0, "trapezoidal"), SetLawOption(0, name, value))
    assert says in str(refusal.value)


@pytest.mark.parametrize(
    ("rows", "says"),
    [
        ([[0, 1, 1], [2, 3, -1]], "row 2: it must begin at 1 s"),
        ([[0, 1, 1], [0.5, 3, -1]], "row 2: it must begin at 1 s"),
        ([[0, 0, 1]], "row 1: it must end after 0 s"),
        ([[0, 1]], "rows"),
        ([[k, k + 1, 1] for k in range(61)], "rows: expected at most 60, got 61"),
        ([[0, 1, math.nan]], "rows: expected finite numbers"),
        ([[0, 1, 1e300], [1, 2, -1e300]], "Table of accelerations"),
    ],
)
def test_rows_with_gaps_are_refused_by_number(rows, says):
    with pytest.raises(InputError) as refusal:
        after(ChooseLawExample("plus_minus_one"), SetLawOption(0, "rows", rows))
    assert says in str(refusal.value)


def test_limits_a_law_needs_are_asked_for():
    fast = after(AsFastAsAllowed(True))
    with pytest.raises(InputError, match=r"limit of jerk: Double S \(bounded jerk\) needs one"):
        apply(fast, ChooseLaw(0, "double_s"))
    with pytest.raises(InputError, match="at least one of velocity, acceleration and jerk"):
        after(SetQuantity("speed", None), SetQuantity("acceleration", None), AsFastAsAllowed(True))
    assert "V, A, J: no limit is given" in optimal_text(bench(ChooseLawExample("same_time")))
    with pytest.raises(InputError, match="no limit is given"):
        after(ChooseLawExample("same_time"), StretchOptimally())


@pytest.mark.parametrize(
    "damage",
    [
        {"laws": []},
        {"laws": [{"law": {"key": "cubic"}, "as_typed": True, "colour": 0}]},
        {"laws": [{"law": {"key": "cubic"}, "as_typed": False, "colour": 7}]},
        {"laws": [{"law": {"key": "cubic"}, "as_typed": False, "colour": 0}] * 2},
        {"laws": [{"law": {"key": "trapezoidal", "options": {"ramp": 2.0}}, "as_typed": False, "colour": 0}]},
        {"scaled": 3},
        {"k": -1.0},
        {"k": math.nan},
        {"timing": {**Laws().to_json()["timing"], "duration": 0.0}},
        {"bounds": {**Bounded().to_json(), "v_max": [0.0, 0.0]}},
        {"bounds": {**Bounded().to_json(), "knots": [[0.0], [1.0]]}},
    ],
)
def test_a_damaged_file_is_not_read(damage):
    with pytest.raises(InputError):
        Laws.from_json({**Laws().to_json(), **damage}, catalogue()["planar_2r"])


def test_works_saved_under_the_former_names_of_options_open():
    part = bench(ChooseLawExample("end_speeds"))
    data = part.to_json()
    for each, name in ((each, name) for each in data["laws"] for name in ("start", "end")):
        options = each["law"].get("options", {})
        if f"sdot_{name}" in options:
            options[f"v_{name}"] = options.pop(f"sdot_{name}")
    assert "v_start" in str(data)
    assert Laws.from_json(data, catalogue()["planar_2r"]).entries == part.entries
    braking = {"key": "trapezoidal", "options": {"deceleration": 0.5}}
    assert Chosen.from_json(braking, free_law_types()).options == {"sddot_down": 0.5}
    # A deceleration above the limit was taken then, and is refused now.
    data["laws"][0]["law"] = {"key": "trapezoidal", "options": {"deceleration": 9.0}}
    opened = Laws.from_json({**data, "timing": {**data["timing"], "fastest": True}}, catalogue()["planar_2r"])
    assert opened.entries[0].chosen == Chosen("trapezoidal")
    table = {"key": "table", "options": {"v_start": 0.7}}
    assert Chosen.from_json(table, free_law_types()).options == {"sdot_first": 0.7}
