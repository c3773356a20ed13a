"""Parts whose fields are declared: read back as they were written, junk refused, and set by one command."""

import dataclasses
import json
import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.control.loop.state import CLIP_KEY, Loop
from armlab.benches.motion.laws.sign_commands import ReadSigns
from armlab.benches.motion.laws.state import Laws
from armlab.benches.motion.space_curve.state import SpaceCurve
from armlab.benches.workspace.dexterous.state import Dexterous
from armlab.content.robots import catalogue
from armlab.errors import InputError, UnknownName
from armlab.session.edits import SetCell
from armlab.session.field_words import SetFields
from armlab.session.fields import EXAMPLE, FieldPart, Set, declarations, fields_of, put
from armlab.session.parts.robot import ChooseRobot
from armlab.session.parts.target import Target
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.session import Session, Undo
from armlab.session.state import State, apply, part_types

DECLARED = [kind for kind in part_types() if issubclass(kind, FieldPart)]
BESPOKE = [kind for kind in DECLARED if "to_json" in vars(kind)]
"""Those that were written in another form before fields were declared, and still are."""

ARMS = ("planar_2r", "puma560", "panda", "scara", "stanford")
ROBOT, ORIGIN = catalogue()["puma560"], (0, 1, 2, 3, 4, 5)
JUNK = (None, "x", -1e300, 1e300, math.nan, math.inf, [], [1.0], [[1.0]], {}, True, object())


@pytest.fixture(params=DECLARED, ids=lambda kind: kind.key)
def kind(request):
    return request.param


def plain_fields(kind):
    """Return the fields that a form can ask for, and what they survive, by name."""
    return {name: (field, declarations(kind)[name].kept) for name, field in fields_of(kind).items()}


def values(part):
    """Return the values of the declared fields, by name; arrays as lists, which can be compared."""
    found = {name: getattr(part, name) for name in declarations(type(part))}
    return {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in found.items()}


def other_values(part, field, robot):
    """Return values that a field may have instead of its own."""
    now = getattr(part, field.key)
    if field.kind == "flag":
        return [not now]
    if field.kind == "choice":
        return [key for key, _ in field.choices if key != now]
    if field.kind == "text":
        return ["other"]
    if now is None:
        return [field.low, field.high]
    step = 1 if field.kind == "whole" else 0.25
    near = [value for value in (field.low, field.high, 1, 2) if math.isfinite(value)]
    if field.kind == "vector":
        return [[each + 0.25 for each in now], [0.5] * len(now)]
    return [value for value in (now + step, now - step, *near) if value != now and field.low <= value <= field.high]


def test_there_are_parts_that_declare_their_fields():
    assert Loop in DECLARED


@pytest.mark.parametrize("arm", ARMS)
def test_a_part_is_written_and_read_back_and_what_is_missing_is_as_it_opens(kind, arm):
    robot = catalogue()[arm]
    part = kind.initial(robot)
    data = json.loads(json.dumps(part.to_json()))
    assert kind.from_json(data, robot).to_json() == part.to_json()
    if kind in BESPOKE or kind.bare:
        return
    assert list(data) == [each.under for each in declarations(kind).values() if not each.later]
    assert kind.from_json({}, robot).to_json() == part.to_json()
    assert kind.from_json({"unheard_of": 1}, robot).to_json() == part.to_json()


def test_a_field_that_came_later_is_written_once_it_has_another_value():
    """What was saved before is written as it was."""
    state = State.initial(catalogue()["puma560"])
    assert declarations(Laws)["signs"].later
    assert "signs" not in state[Laws].to_json()
    changed = apply(state, ReadSigns("eighths"))[Laws]
    assert changed.to_json()["signs"]["plus"][1] == [0.375, 4.0]
    assert Laws.from_json(json.loads(json.dumps(changed.to_json())), ROBOT).signs == changed.signs


def test_junk_is_refused_with_a_sentence_and_changes_nothing(kind):
    state = State.initial(catalogue()["puma560"])
    for name in declarations(kind):
        for junk in JUNK:
            try:
                changed = apply(state, Set(kind, name, junk))
            except InputError:
                continue
            held = changed[kind].to_json()
            assert kind.from_json(json.loads(json.dumps(held, allow_nan=False)), ROBOT).to_json() == held
    if kind not in BESPOKE and not kind.bare:
        with pytest.raises(InputError, match="expected fields by name"):
            kind.from_json([], ROBOT)


@pytest.mark.parametrize("arm", ARMS)
def test_a_field_is_set_and_no_other(kind, arm):
    robot = catalogue()[arm]
    state = State.initial(robot)
    for name, field in fields_of(kind).items():
        for value in other_values(state[kind], field, robot):
            try:
                changed = apply(state, Set(kind, name, value))[kind]
            except InputError:
                continue
            before, after = values(state[kind]), values(changed)
            assert after[name] != before[name]
            assert {key for key in after if after[key] != before[key]} <= {name, EXAMPLE}
            assert values(kind.from_json(json.loads(json.dumps(changed.to_json())), robot)) == after


def test_what_is_kept_survives_another_arm_and_edits_of_the_table(kind):
    other = catalogue()["planar_3r"]
    part, of_other = State.initial(ROBOT)[kind], values(kind.initial(other))
    for name, (field, kept) in plain_fields(kind).items():
        for value in other_values(part, field, ROBOT):
            try:
                changed = part.with_values({name: value})
            except InputError:
                continue
            edited, there = values(changed.for_edited(ROBOT, ORIGIN)), values(changed.for_robot(other))
            if kept:
                assert edited[name] == values(changed)[name]
            if kept == "always":
                # Unless it does not fit the other arm, which then opens as it would.
                assert there[name] == values(changed)[name] or there == of_other


def test_an_unknown_field_is_named_with_those_there_are():
    with pytest.raises(UnknownName, match=r"unknown name 'colour'.*mass"):
        apply(State.initial(ROBOT), Set(Loop, "colour", 1.0))


def test_a_field_that_is_set_to_what_it_is_changes_nothing():
    state = State.initial(ROBOT)
    assert apply(state, Set(Loop, "mass", state[Loop].mass)) is state


def test_the_film_of_a_part_begins_again_and_another_one_does_not():
    state = apply(apply(State.initial(ROBOT), OpenClip(CLIP_KEY)), Seek(1.0))
    assert apply(state, Set(Loop, "mass", 2.0))[Timeline].time == 0.0
    assert put(state, replace(state[Loop], mass=2.0))[Timeline].time == 0.0
    other = apply(apply(State.initial(ROBOT), OpenClip("sweep")), Seek(1.0))
    assert apply(other, Set(Loop, "mass", 2.0))[Timeline].time == 1.0


def test_what_only_says_what_is_drawn_is_no_step_and_leaves_the_example_and_the_film():
    look, work = Set(SpaceCurve, "arrows", True), Set(SpaceCurve, "duration", 7.0)
    assert (look.undoable, work.undoable) == (False, True)
    assert not SetFields.of(SpaceCurve, arrows=True).undoable
    assert SetFields.of(SpaceCurve, arrows=True, duration=7.0).undoable
    state = apply(apply(State.initial(ROBOT), OpenClip(SpaceCurve.clip)), Seek(1.0))
    looked = apply(state, look)
    assert (looked[SpaceCurve].arrows, looked[SpaceCurve].example, looked[Timeline].time) == (True, "frenet", 1.0)
    worked = apply(state, work)
    assert (worked[SpaceCurve].example, worked[Timeline].time) == ("", 0.0)
    assert apply(looked, look) is looked


def test_an_undo_says_the_title_of_the_field():
    session = Session.fresh("s", ROBOT)
    session.apply(Set(Loop, "gain", 3.0), 0.0)
    assert session.history.undo_label == "gain of the controller"
    session.apply(Undo(), 1.0)
    assert session.state[Loop].gain == 10.0
    assert Set(Loop, "nothing", 1).label == "loop"


def test_another_arm_leaves_what_has_nothing_to_do_with_it():
    state = apply(State.initial(ROBOT), Set(Loop, "mass", 3.0))
    assert apply(state, ChooseRobot("planar_2r"))[Loop].mass == 3.0


def test_a_choice_among_numbers_is_held_as_it_is_offered():
    state = apply(State.initial(ROBOT), SetFields.of(Dexterous, share=True, count=400_000.0))
    assert (type(state[Dexterous].share), type(state[Dexterous].count)) == (float, int)
    with pytest.raises(UnknownName, match=r"share: unknown name 2\.0; .* Available: 0\.25, 0\.5"):
        apply(state, Set(Dexterous, "share", 2.0))


def test_what_an_edited_table_cannot_have_falls_and_what_any_arm_can_have_stays():
    state = apply(State.initial(ROBOT), SetFields.of(Dexterous, method="wrist", count=400_000))
    edited = apply(state, SetCell(4, "a", 0.1))
    assert (edited[Dexterous].method, edited[Dexterous].count) == ("", 400_000)


def test_a_field_that_is_an_array_is_set_written_and_known_again():
    pose = catalogue()["scara"].arm.fk([0.1, 0.2, 0.1, 0.3])
    state = apply(State.initial(ROBOT), Set(Target, "pose", pose.tolist()))
    assert Target.from_json(state[Target].to_json(), ROBOT).to_json() == state[Target].to_json()
    assert state[Target].to_json()["pose"] == state[Target].pose.tolist()
    assert apply(state, Set(Target, "pose", state[Target].pose)) is state
    assert apply(state, Set(Target, "pose", None))[Target].pose is None


APART = [
    kind
    for kind in DECLARED
    if kind.for_edited is FieldPart.for_edited and len(declarations(kind)) == len(dataclasses.fields(kind))
]
"""Parts that have nothing to do with the arm, or with its table only."""


@pytest.mark.parametrize("kind", APART, ids=lambda kind: kind.key)
def test_what_stays_as_it_is_stays_the_same_object(kind):
    """Pages are made anew, and work begins anew, when a part they look at is another one."""
    part = State.initial(ROBOT)[kind]
    assert part.for_edited(ROBOT, ORIGIN) is part
    assert len(APART) > 8
