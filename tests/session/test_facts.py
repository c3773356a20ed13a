"""Facts that benches publish: of the kind they say, and worked out again from what is kept as evidence."""

import json
import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from armlab.benches.control.loop.facts import FACTS as LOOP
from armlab.benches.iterate.runs.state import Iterations
from armlab.content.bench_words import BenchWord
from armlab.content.checks.fact import FactIs
from armlab.content.observation import Observation
from armlab.content.robots import catalogue
from armlab.content.seen_fact import read_value
from armlab.errors import InputError, UnknownName
from armlab.session import facts
from armlab.session.facts import (
    KINDS,
    Fact,
    Facts,
    evidence_of,
    fact_of,
    facts_again,
    facts_of_benches,
    seen_facts,
    unfit,
    worked_out,
)
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.parts.timeline import OpenClip, Seek
from armlab.session.state import State, apply
from armlab.session.words import command_of

PAGES = list(facts_of_benches())
ARMS = ("planar_2r", "puma560", "scara")

CHANGES = {
    "body.atan2": [("set_coordinate", {"index": 0, "value": -0.6})],
    "body.axis": [("set", {"shown": "inverse"})],
    "body.forms": [("place_body", {"key": "lock"}), ("set_body_entry", {"row": 0, "column": 0, "value": 0.3})],
    "body.integral": [("set_piece", {"law": 0, "piece": 0, "what": 3, "value": 0.7}), ("reverse_law", {"law": 1})],
    "body.meanings": [("turn_elementary", {"axis": "z"}), ("set_vector", {"index": 1, "value": -0.4})],
    "body.order": [("set_order_angle", {"which": 0, "value_deg": 40}), ("scale_angles", {"factor": 0.5})],
    "body.products": [("choose_product", {"axes": "xyz"}), ("type_entry", {"text": "sin(α) cos(β)"})],
    "body.quaternion": [("set_second", {"index": 2, "value": -0.5})],
    "body.sequence": [("set", {"order": "same"})],
    "body.skew": [("set_skew_entry", {"row": 0, "column": 1, "value": 0.3}), ("set", {"shown": "dyads", "first": 3})],
    "control.exponential": [("move_time", {"t": 1.5}), ("sum_terms", {"terms": 7})],
    "control.follow": [("set_value", {"key": "duration", "value": 2.0})],
    "control.loop": [("set", {"gain": 25})],
    "drive.gears": [("set_wheels", {"teeth": [20, 30, 50]}), ("set", {"load_torque": 6.0})],
    "drive.harmonic": [("set_circular", {"teeth": 63}), ("show_turns", {"turns": 2})],
    "drive.joint": [("set_drive", {"joint": 0, "name": "backlash", "value_deg": 0.05})],
    "frames.chain": [
        ("set_frame_position", {"name": "A", "axis": 1, "value": 0.4}),
        ("look_at_frames", {"frame": "B"}),
    ],
    "frames.coordinates": [("set_cylindrical", {"name": "theta", "value_deg": 200})],
    "frames.screw": [("set_pose_angle", {"which": "second", "index": 0, "value_deg": 40})],
    "frames.table": [("set_height", {"value_mm": 250}), ("turn_table", {"value_deg": 20})],
    "frames.two": [("set_robot_base", {"robot": "B", "axis": 0, "value": 1.2})],
    "drive.motor": [("choose_motor_example", {"key": "own"}), ("set", {"R": 1.1, "shown": "state"})],
    "drive.power": [("set", {"kind": "hydraulic", "given": "load", "mass": 1.5})],
    "drive.torque": [("set", {"coils": 3, "motion": "free", "duration": 3.0})],
    "help.identities": [("set_side", {"side": "right", "text": "2 sin(x) cos(x)"}), ("other_points", {})],
    "iterate.newton_1d": [("type_equation", {"text": "x^2 - 3"})],
    "iterate.runs": [("set", {"most": 3})],
    "lessons.errata": [
        ("choose", {"key": "4.110"}),
        ("point_at", {"place": [2]}),
        ("correct", {"typed": "x - f/d"}),
        ("set", {"seed": 3}),
    ],
    "motion.curves": [("set_knot", {"k": 1, "cell": "q", "value": 3})],
    "motion.laws": [
        ("set_quantity", {"name": "duration", "value": 3}),
        ("set_signs", {"side": "plus", "intervals": "0-1, 2-3"}),
    ],
    "motion.pick": [("pick_and_place", {})],
    "motion.space_curve": [("set", {"duration": 7})],
    "pose.spaces": [("set", {"task": "xyz"}), ("move_end", {"x": 0.3, "y": 0.4})],
    "pose.tool": [("look_at", {"reference": "0", "frame": "1"})],
    "robot.taught": [("set", {"offset_deg": 0.3}), ("visit_again", {})],
    "robot.history": [("judge", {"thing": "mill", "says": False}), ("suppose", {"flag": "harms", "on": True})],
    "robot.market": [("take_span", {"first": 1, "last": 3})],
    "robot.normal": [("place_lines", {"kind": "parallel"})],
    "robot.table": [("set_point", {"xyz_mm": [50, 0, 0]})],
    "robot.trainer": [("start_trainer", {})],
    "sensor.absolute": [("set", {"code": "binary", "offset": 0.3}), ("turn_to", {"angle_deg": 179})],
    "sensor.calibration": [("set", {"degree": 4, "drift": 0.2, "age": 3})],
    "sensor.incremental": [("set_moves", {"angles_deg": [50, -80, 120]}), ("set", {"index": True})],
    "sensor.measure": [("correct_aim", {}), ("set", {"count": 30})],
    "sensor.pose": [("set", {"approach": "same", "times": 12})],
    "sensor.speed": [("set_counts", {"counts": 70})],
    "target.solutions": [],
    "velocity.ellipsoid": [("set_ellipsoid", {"shown": "force"})],
    "velocity.microscope": [("set_speed", {"speed": 0.5})],
    "velocity.solve": [("set_component", {"index": 0, "value": 0.3})],
    "velocity.speeds": [("set_speed", {"joint": 0, "value_deg": 12})],
    "velocity.statics": [("set_component", {"kind": "moment", "axis": 2, "value": 4})],
    "velocity.turning": [("set_turning", {"what": "angles", "index": 1, "value_deg": 80})],
    "workspace.cloud": [("look_at_workspace", {"count": 100_000, "seed": 4})],
    "workspace.section": [],
    "workspace.what_if": [("suppose", {"row": 0, "field": "a", "value": 1.4})],
}
"""What a person does on each page before its facts are looked at."""


def worked_at(page, robot="planar_2r"):
    """Return a state in which a person has moved the arm and worked at a page, with its long work done."""
    state = apply(State.initial(catalogue()[robot]), MoveJoint(1, 0.9))
    for name, given in CHANGES[page]:
        state = apply(state, command_of(BenchWord(f"{page}.{name}", given, "f.md", "", "")))
    return worked_out(state, facts_of_benches()[page])


def words_of(page):
    return [f"{page}.{name}" for name in facts_of_benches()[page].facts]


def seen_of(state):
    return Observation.of(state[Joints].arm, state[Joints].q, target=state[Target].pose)


def test_many_benches_publish_facts_and_each_is_tried_here():
    assert len(PAGES) >= 12
    assert set(CHANGES) == set(PAGES)


def is_of_kind(value, kind):
    if kind == "truth":
        return isinstance(value, bool)
    if kind == "text":
        return isinstance(value, str)
    if kind == "numbers":
        return isinstance(value, tuple) and all(isinstance(each, float) for each in value)
    return isinstance(value, float) and (kind == "number" or value == int(value))


@cache
def opened(robot):
    """Return the state a student begins with; what pages compute of it is computed once."""
    return State.initial(catalogue()[robot])


@pytest.mark.parametrize("page", PAGES)
def test_a_fact_is_what_it_says_or_not_known(page):
    known = set()
    for robot in ARMS:
        state = opened(robot)
        for when in (state, worked_out(state, facts_of_benches()[page])):
            for name, fact in facts_of_benches()[page].facts.items():
                seen = fact.now(when)
                assert fact.kind in KINDS
                assert seen.value is None or is_of_kind(seen.value, fact.kind), (robot, name, seen)
                known |= {name} if seen.value is not None else set()
    never = facts_of_benches()[page].facts.keys() - known
    # A law with phases, a singular configuration nearby, boxes, a body in gimbal lock, a typed matrix or formula, an
    # elementary rotation, and a rotor that is let go, are not there when these arms open; a planar 3R is none of them.
    absent = {"triangle", "coasting", "away", "from_goal", "defined", "distance", "turned"}
    absent |= {"typed_off", "axis", "alpha", "arms", "r", "r_residual", "tools_apart"}
    assert never <= absent


@pytest.mark.parametrize("page", PAGES)
def test_facts_are_worked_out_again_from_what_is_written_down(page):
    state, words = worked_at(page), words_of(page)
    data = json.loads(json.dumps(evidence_of(state, words)))
    data["told"] = dict.fromkeys(words, 999.0)
    again = facts_again(data, words, seen_of(state), catalogue()["planar_2r"], True)
    for word, seen in seen_facts(state, words).items():
        np.testing.assert_equal(again[word].value, seen.value, word)


class Watched(State):
    """A state that notes of which parts it is asked."""

    def __init__(self, state):
        super().__init__(state, state.at)
        self.asked = set()

    def __getitem__(self, kind):
        self.asked.add(kind)
        return super().__getitem__(kind)


@pytest.mark.parametrize("page", PAGES)
def test_facts_follow_from_the_parts_that_are_kept_as_evidence(page):
    found = facts_of_benches()[page]
    for state in (opened("puma560"), worked_at(page)):
        for fact in found.facts.values():
            watched = Watched(state)
            fact.now(watched)
            assert watched.asked <= {Joints, Target, RobotPart, *found.parts}, fact.title


def test_a_rotation_on_the_way_is_that_of_the_film_where_it_was_paused():
    word = "body.quaternion.on_the_way"
    state = apply(apply(worked_at("body.quaternion"), OpenClip("quaternion_way")), Seek(1.0))
    again = facts_again(evidence_of(state, [word]), [word], seen_of(state), catalogue()["planar_2r"], True)
    np.testing.assert_equal(again[word].value, seen_facts(state, [word])[word].value)
    assert again[word].value != seen_facts(worked_at("body.quaternion"), [word])[word].value


@pytest.mark.parametrize("page", ["iterate.runs", "workspace.section"])
def test_what_takes_long_is_taken_down_as_told_when_work_is_only_opened(page):
    state, words = worked_at(page), words_of(page)
    data = json.loads(json.dumps(evidence_of(state, words)))
    told = facts_again(data, words, seen_of(state), catalogue()["planar_2r"], False)
    for word, seen in seen_facts(state, words).items():
        assert told[word].value == seen.value


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (None, "what they follow from is missing"),
        ([], "what they follow from is missing"),
        ({"parts": {}}, "the part 'statics' is missing"),
        ({"parts": {"statics": 3}}, "the part 'statics' is not usable"),
        ({"parts": {"statics": {"force": [1, 2, "x"]}}}, "the part 'statics' is not usable"),
    ],
)
def test_broken_evidence_is_a_sentence(data, says):
    state = worked_at("velocity.statics")
    with pytest.raises(InputError, match=says):
        facts_again(data, words_of("velocity.statics"), seen_of(state), catalogue()["planar_2r"], True)


@pytest.mark.parametrize("value", [[1.0] * 101, 1e9, "x" * 100, {"a": 1}])
def test_what_is_told_has_a_size(value):
    state = worked_at("iterate.runs")
    data = {**evidence_of(state, words_of("iterate.runs")), "told": {"iterate.runs.steps": value}}
    with pytest.raises(InputError, match=r"told\.iterate\.runs\.steps"):
        facts_again(data, words_of("iterate.runs"), seen_of(state), catalogue()["planar_2r"], False)


def test_a_result_of_other_settings_is_not_known():
    state = worked_at("iterate.runs")
    assert seen_facts(state, ["iterate.runs.steps"])["iterate.runs.steps"].value == 3
    other = state.replace(replace(state[Iterations], most=9))
    assert seen_facts(other, ["iterate.runs.steps"])["iterate.runs.steps"].value is None


def test_the_numbers_are_those_of_the_course():
    """Statics of a straight 2R by hand: a force of 10 N along y at reach 2 m and 1 m needs 20 and 10 N m."""
    state = State.initial(catalogue()["planar_2r"])
    for command in (MoveJoint(0, 0.0), MoveJoint(1, 0.0)):
        state = apply(state, command)
    for axis, value in ((0, 0.0), (1, 10.0)):
        given = {"kind": "force", "axis": axis, "value": value}
        state = apply(state, command_of(BenchWord("velocity.statics.set_component", given, "f.md", "", "")))
    found = seen_facts(state, words_of("velocity.statics"))
    np.testing.assert_allclose(found["velocity.statics.torques"].value, (20.0, 10.0), rtol=0, atol=1e-9)
    assert math.isclose(found["velocity.statics.largest_torque"].value, 20.0, abs_tol=1e-9)
    assert found["velocity.statics.needs_nothing"].value is False
    table = seen_facts(state, words_of("robot.table"))
    assert abs(table["robot.table.determinant"].value) < 1e-12
    assert seen_facts(state, ["velocity.ellipsoid.condition"])["velocity.ellipsoid.condition"].value == math.inf


def test_a_fact_that_is_refused_or_no_number_is_not_known():
    def refused(state):
        raise InputError("not for this arm")

    for value in (refused, lambda state: math.nan, lambda state: [1.0, math.nan]):
        assert Fact("x", value).now(State.initial(catalogue()["planar_2r"])).value is None


def test_unknown_facts_are_a_sentence():
    with pytest.raises(UnknownName, match=r"page with facts: unknown name 'velocity\.nowhere'.*velocity\.statics"):
        fact_of("velocity.nowhere.x")
    with pytest.raises(UnknownName, match=r"fact of control\.loop: unknown name 'tim'.*time_constant"):
        fact_of("control.loop.tim")


@pytest.mark.parametrize(
    ("asked", "says"),
    [
        (FactIs("control.loop.gain", value="x"), "expected a number, for the gain"),
        (FactIs("control.loop.gain", value=1.0), "expected a tolerance above zero"),
        (FactIs("control.loop.gain", component=1, at_least=1.0), "it is a number and has no components"),
        (FactIs("control.loop.gain", at_least=1.0, degrees=True), "it is no angle, its unit is none"),
        (FactIs("velocity.statics.torques", at_least=1.0), "it is several numbers, torques (N m) or"),
        (FactIs("velocity.statics.needs_nothing", at_least=1.0), "expected true or false"),
        (FactIs("iterate.runs.status", value=True), "expected a text"),
        (FactIs("iterate.runs.steps", value=(1.0,)), "expected a whole number"),
    ],
)
def test_a_check_that_does_not_fit_its_fact_is_told(asked, says):
    (told,) = unfit(asked, fact_of(asked.fact)[1])
    assert told.startswith(says)


@pytest.mark.parametrize(
    "asked",
    [
        FactIs("control.loop.gain", value=1.0, tolerance=0.1),
        FactIs("control.loop.phase", at_least=-1.0, degrees=True),
        FactIs("velocity.statics.torques", component=2, at_most=1.0),
        FactIs("velocity.statics.torques", value=(1.0, 2.0), tolerance=0.1),
        FactIs("iterate.runs.steps", value=3.0),
        FactIs("velocity.statics.needs_nothing", value=True),
    ],
)
def test_a_check_that_fits_its_fact_is_left_in_peace(asked):
    assert list(unfit(asked, fact_of(asked.fact)[1])) == []


def test_facts_know_their_page():
    assert isinstance(LOOP, Facts)
    assert (LOOP.key, LOOP.panel) == ("control.loop", "loop")


@pytest.mark.parametrize(
    ("value", "told"),
    [
        (2.5, 2.5),
        ((1.0, 2.0), [1.0, 2.0]),
        (True, True),
        (None, None),
        (math.inf, None),
        (1e9, None),
        ((1.0, math.nan), None),
        ("x" * 1000, None),
    ],
)
def test_what_a_file_cannot_hold_of_a_fact_is_not_told(value, told):
    assert facts._tellable(value) == told
    read_value(facts._tellable(value), "fact")
