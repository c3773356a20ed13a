"""What lesson files say of motions: examples, starts of steps, checks, actions, evidence."""

import copy
import json
import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.motion.plan.actions import EditWaypoint, SetDuration, SetLimits, SetMoveKind
from armlab.benches.motion.plan.lesson import TAUGHT
from armlab.benches.motion.plan.seen_motion import SeenMotion, SeenMove, motion_in
from armlab.content.actions import Move, PlayFilm, TakeExample
from armlab.content.check import Words, read_check, read_state_check
from armlab.content.lesson_file import parse_lesson
from armlab.content.lesson_lines import LessonError
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import catalogue
from armlab.errors import ContentError, InputError, PluginError
from support.motion_lesson import MOTION

ROBOT = catalogue()["planar_2r"]
JOINT, SPACE = SeenMove("joint", "line", "trapezoidal"), SeenMove("cartesian", "overfly", "quintic")
RUNS = SeenMotion(
    waypoints=3,
    moves=(JOINT, SPACE),
    planned=True,
    whole=True,
    within=True,
    duration=1.32,
    fastest=1.2,
    velocity=0.95,
    acceleration=1.0,
    deviation=0.0021,
)


@pytest.fixture(scope="module")
def lesson():
    return parse_lesson("corners", MOTION)


def check(text, robot="planar_2r"):
    table = Table.parse("f.md", text)
    table.where = "step 1.check"
    return read_check(table, catalogue()[robot])


def seen(motion=RUNS, **changes):
    benches = {} if motion is None else {"motion": replace(motion, **changes)}
    return Observation.of(ROBOT.arm, [0.1, 0.2], benches=benches)


def read_again(data):
    return motion_in(Observation.from_json(data, ROBOT, {"motion": SeenMotion.from_json}))


# --- The file


def test_an_example_at_the_top_and_in_steps(lesson):
    assert (lesson.example, lesson.panel) == ("motion/corner_stop", "motion")
    assert [(step.example, step.panel) for step in lesson.steps] == [
        ("", ""),
        ("", ""),
        ("", ""),
        ("laws/triangle", "laws"),
        ("motion/spline", "motion"),
    ]
    assert [step.check is not None and step.check.observes == ("motion",) for step in lesson.steps] == [0, 1, 1, 0, 1]
    assert lesson.steps[1].live == ("duration",)
    assert "start" not in lesson.steps[3].html


def test_a_lesson_without_has_none():
    plain = parse_lesson("p", MOTION.replace('example = "motion/corner_stop"\n', ""))
    assert plain.example == ""
    only_panel = parse_lesson("p", MOTION.replace('example = "laws/triangle"\n', ""))
    assert (only_panel.steps[3].example, only_panel.steps[3].panel) == ("", "laws")


def test_the_actions(lesson):
    assert lesson.steps[1].solution == (SetMoveKind(None, path="overfly"), PlayFilm("motion"))
    assert lesson.steps[2].solution == (SetDuration(10.0),)
    assert lesson.steps[3].solution == (PlayFilm("laws"),)
    move, *rest = lesson.steps[4].solution
    assert isinstance(move, Move)
    assert rest[:5] == [
        EditWaypoint("add", None),
        EditWaypoint("set", 0),
        EditWaypoint("add", 5),
        EditWaypoint("remove", 5),
        TakeExample("motion/corner_stop"),
    ]
    assert rest[6:] == [
        EditWaypoint("add", 0),
        SetMoveKind(2, law="quintic"),
        SetLimits(0.8, 0.7, 0.4, 0.1),
    ]


@pytest.mark.parametrize(
    ("old", "new", "named", "says"),
    [
        ('"motion/corner_stop"\n+++', '"corner_stop"\n+++', "corner_stop", "example: expected BENCH/NAME such as"),
        ('"motion/corner_stop"\n+++', "3\n+++", "example = 3", "example: expected a text, got 3"),
        ('"laws/triangle"', '"laws triangle"', "laws triangle", "step 4.start.example: expected BENCH/NAME"),
        (
            'example = "laws/triangle"\npanel = "laws"\n',
            "",
            "```start",
            "step 4.start.example: missing; expected example",
        ),
        ('panel = "laws"', 'pannel = "laws"', "pannel", "step 4.start.pannel: unknown key; did you mean 'panel'"),
        (
            '```start\nexample = "motion/spline"',
            "```solution",
            "```solution",
            "step 5.solution: expected one in a step",
        ),
        ('path = "overfly"\n\n[[checks]]', 'path = "overflow"\n\n[[checks]]', "overflow", "unknown value 'overflow'"),
        ("at_most_s = 7", "at_most = 7", "at_most = 7", "step 2.check.checks"),
        ("at_least_s = 10", "at_least_s = 11", "at_least_s", "step 3.check.at_least_s: expected at most 10 s"),
        ("at_least_s = 10", "at_least_s = 0", "at_least_s", "step 3.check.at_least_s: expected a positive number"),
        (
            "velocity_percent = 60",
            "velocity_percent = 160",
            "160",
            "step 3.check.velocity_percent: expected at most 100",
        ),
        ("waypoints = 6", "waypoints = 1", "waypoints = 1", "waypoints: expected a whole number from 2"),
        ('to = 3\nlaw = "quintic"\nspace', "to = 1\nspace", "to = 1", "to: expected a whole number from 2"),
        ("seconds = 10", "seconds = -1", "seconds = -1", r"step 3.solution.do\[1\].seconds: expected a positive"),
        ("set = 1", "set = 1\nremove = 2", "remove = 2", "remove: expected one of set and remove"),
        ("set = 1", "set = 0", "set = 0", "set: expected a whole number from 1"),
        ("velocity_percent = 80", "velocity_percent = 180", "180", "velocity_percent: expected at most 100, got 180"),
        ('name = "motion/corner_stop"', 'name = "corner_stop"', "corner_stop", r"do\[6\].name: expected BENCH/NAME"),
        ("{{duration}}", "{{durration}}", "durration", "unknown live value 'durration'; did you mean 'duration'"),
    ],
)
def test_mistakes_are_told_with_their_lines(old, new, named, says):
    text = MOTION.replace(old, new, 1)
    assert text != MOTION
    with pytest.raises(LessonError, match=says) as error:
        parse_lesson("corners", text)
    assert named in text.split("\n")[error.value.line - 1]


def test_a_start_before_the_first_step_is_refused():
    with pytest.raises(LessonError, match="expected a block 'start' in a step"):
        parse_lesson("c", MOTION.replace("A square.", '```start\npanel = "laws"\n```'))


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('kind = "move_kind"\nto = 3', "space: missing; expected some of space, path, law, turning, stop"),
        ('kind = "move_kind"\nstop = false', "to: missing; expected the waypoint at which"),
        ('kind = "limits"', "velocity_percent: missing; expected some limit"),
        ('kind = "motion"\nseconds = 3', "seconds: unknown key"),
    ],
)
def test_actions_that_say_too_little_or_too_much(text, says):
    lesson = MOTION.replace('kind = "duration"\nseconds = 10', text)
    with pytest.raises(LessonError, match=rf"step 3.solution.do\[1\].{says}"):
        parse_lesson("c", lesson)


# --- The checks


def test_a_motion_that_runs():
    asked = check('kind = "motion_runs"')
    assert asked.is_met(seen())
    assert asked.says(seen()) == "The motion runs to its end in 1.32 s, within all limits."
    cases = (
        (None, {}, "The motion has not been planned yet."),
        (RUNS, {"planned": False}, "The motion has not been planned yet."),
        (RUNS, {"whole": False}, "The motion cannot be run to its end."),
        (
            RUNS,
            {"whole": False, "trouble": "move 1 → 2: out of reach"},
            "The motion cannot be run to its end: move 1 → 2: out of reach.",
        ),
        (RUNS, {"within": False}, "The motion exceeds a limit; within all limits it takes at least 1.20 s."),
        (
            RUNS,
            {"within": False, "fastest": 1.2012},
            "The motion exceeds a limit; within all limits it takes at least 1.21 s.",
        ),
        (
            RUNS,
            {"within": False, "fastest": 0.0},
            "The motion exceeds a limit that these moves keep in no time: choose another path or law.",
        ),
    )
    for motion, changes, says in cases:
        assert not asked.is_met(seen(motion, **changes))
        assert asked.says(seen(motion, **changes)) == says


def test_a_motion_in_time():
    asked = check('kind = "motion_runs"\nat_most_s = 1.1\nat_least_s = 0.9')
    assert asked.says(seen()) == "The motion takes 1.32 s; at most 1.10 s is required."
    assert asked.says(seen(duration=0.5)) == "The motion takes 0.50 s; at least 0.90 s is required."
    assert [asked.is_met(seen(duration=t)) for t in (0.89, 0.897, 1.0, 1.104, 1.11)] == [0, 1, 1, 1, 0]


def test_a_motion_with_more_to_it():
    words = Words(length=lambda value: f"{1000 * value:.1f} mm")
    many = check('kind = "motion_runs"\nwaypoints = 4')
    assert many.says(seen()) == "The motion has 3 waypoints; at least 4 are required."
    assert many.is_met(seen(waypoints=5))
    straight = check('kind = "motion_runs"\ndeviation_m = 0.001')
    assert straight.says(seen(), words) == "The tool leaves its path by 2.1 mm; at most 1.0 mm is required."
    assert straight.is_met(seen(deviation=0.001))
    gentle = check('kind = "motion_runs"\nvelocity_percent = 96\nacceleration_percent = 50')
    assert gentle.says(seen()) == "A joint uses 100 % of its limit of acceleration; at most 50 % is required."
    assert gentle.is_met(seen(acceleration=0.5))
    assert not gentle.is_met(seen(acceleration=0.5, velocity=0.97))
    for share, told in ((0.504, "50.4"), (0.50051, "50.1"), (0.999, "99.9"), (1.5, "150")):
        assert gentle.says(seen(acceleration=share)).startswith(f"A joint uses {told} % of its limit of acceleration;")


def test_a_move_of_a_kind():
    second = check('kind = "move_is"\nto = 3\nspace = "cartesian"\npath = "overfly"\nlaw = "quintic"')
    assert second.is_met(seen())
    assert second.is_met(seen(planned=False))
    assert second.says(seen()) == "The moves are as they should be."
    assert (
        second.says(seen(moves=(SPACE, JOINT)))
        == "The move 2 → 3 is in joint space; one in Cartesian space is required."
    )
    assert second.says(seen(moves=(SPACE,))) == "There is no waypoint 3."
    assert not second.is_met(seen(moves=(SPACE,)))
    every = check('kind = "move_is"\nlaw = "quintic"')
    assert not every.is_met(seen())
    assert every.says(seen()) == (
        "The move 1 → 2 has the law “Trapezoid of speed (bang-coast-bang)”; “Quintic” is required."
    )
    assert every.is_met(seen(moves=(SPACE, SPACE)))
    assert not every.is_met(seen(moves=()))
    assert every.says(seen(moves=())) == "There is no move."
    assert not every.is_met(seen(None))
    path = check('kind = "move_is"\nto = 2\npath = "spline"')
    assert path.says(seen()) == "The move 1 → 2 has the path “Straight line”; “Cubic spline” is required."


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('kind = "move_is"', "space: missing; expected some of space, path, law"),
        ('kind = "move_is"\nspace = "task"', "space: unknown value 'task'"),
        ('kind = "move_is"\nlaw = "quintik"', "law: unknown value 'quintik'; did you mean 'quintic'"),
        ('kind = "move_is"\npath = "circle"\nspace = "joint"', "space: the path 'circle' is in cartesian space only"),
        ('kind = "motion_played"\nat_most_s = 3', "at_most_s: unknown key"),
    ],
)
def test_mistakes_in_checks_of_motions(text, says):
    with pytest.raises(ContentError, match=f"step 1.check.{says}"):
        check(text)


def test_a_motion_that_was_played():
    asked = check('kind = "motion_played"')
    assert asked.is_met(seen(played=True))
    assert asked.says(seen(played=True)) == "You have played the motion to its end."
    assert not asked.is_met(seen(played=True, whole=False))
    assert asked.says(seen()) == "Play the motion to its end."
    assert asked.says(seen(time=0.5)) == "Play the motion to its end: it is at 0.50 s of 1.32 s."
    assert asked.says(seen(None)) == asked.says(seen(planned=False)) == "The motion has not been planned yet."
    assert asked.says(seen(whole=False, trouble="move 1 → 2: no")).endswith("to its end: move 1 → 2: no.")


def test_a_check_is_of_the_motion_also_for_its_mistakes():
    def state_check(text):
        return read_state_check(Table.parse("f.md", text), ROBOT, lambda says, where: says)

    joint = 'kind = "joint_at"\njoint = 1\nvalue_deg = 90\ntolerance_deg = 1\n'
    assert state_check(joint).observes == ()
    wrong = state_check(joint + '[[wrong]]\nkind = "move_is"\nspace = "joint"\nsays = "Joint."\n')
    assert wrong.observes == ("motion",)
    assert wrong.judge(seen(moves=(JOINT,))) == (False, "Joint.")


# --- Evidence


@pytest.mark.parametrize("key", ["q", "films", "facts", "plan"])
def test_what_evidence_has_already_is_no_key_of_a_bench(key):
    with pytest.raises(PluginError, match=f"a key that evidence has not yet, got '{key}'"):
        replace(TAUGHT, key=key)


def test_evidence_of_a_motion_comes_back_the_same():
    for motion in (RUNS, SeenMotion(), replace(RUNS, played=True, time=1.32)):
        assert read_again(json.loads(json.dumps(seen(motion).to_json()))) == motion
    assert "motion" not in seen(None).to_json()
    assert read_again(seen(None).to_json()) is None
    assert read_again(seen(whole=False, trouble="why").to_json()).trouble == ""


JUNK = [None, True, -1, 7, 1e300, math.nan, 10**400, "x", "y" * 100, [], [[]], {}, [["a", "b"]], {"a": 1}, 2.5]


def test_forged_motions_raise_a_sentence_and_nothing_else():
    good = seen(time=0.3).to_json()
    told = []
    for key in good["motion"]:
        for junk in JUNK:
            data = copy.deepcopy(good)
            data["motion"][key] = junk
            try:
                found = read_again(data)
            except InputError as error:
                told.append((key, str(error)))
            else:
                numbers = [found.duration, found.fastest, found.velocity, found.acceleration, found.deviation]
                assert np.isfinite(numbers).all()
                assert min(numbers) >= 0.0
                assert isinstance(found.waypoints, int)
    assert len(told) > 100
    assert all(f"observation.motion.{key}" in says and len(says) < 300 for key, says in told)
    for junk in (None, 3, [], {}, {**good["motion"], "more": 1}):
        with pytest.raises(InputError, match=r"observation\.motion: expected exactly the fields"):
            read_again({**good, "motion": junk})
    with pytest.raises(InputError, match="at most 100 moves"):
        read_again({**good, "motion": {**good["motion"], "moves": [["a", "b", "c"]] * 101}})
