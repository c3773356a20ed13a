"""The map of basins as a part of the state: asked for, drawn in pieces, cancelled, kept, and where films begin."""

import json
import math
from functools import cache

import numpy as np
import pytest

from armlab.benches.iterate.basins.job import JOB, drawn, known_solutions, run
from armlab.benches.iterate.basins.state import (
    ONE_JOINT,
    Basins,
    CancelBasins,
    DrawBasins,
    MapJoints,
    MapMethod,
    MapRest,
    StartInMap,
    TakeJoint,
    belongs_elsewhere,
    refusal,
)
from armlab.benches.iterate.runs.commands import AimAt, ChooseTask
from armlab.benches.iterate.runs.job import with_films
from armlab.benches.iterate.runs.state import Iterations, vector_of
from armlab.content.robots import catalogue
from armlab.errors import ArmlabError, InputError
from armlab.kin import ik
from armlab.kin.ik.iterate.basins import FAILED
from armlab.session.edits import AddJoint, RemoveJoint, SetCell
from armlab.session.field_words import SetFields
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.target import PlaceTarget
from armlab.session.parts.timeline import Timeline
from armlab.session.session import Session, Undo
from armlab.session.state import State, apply
from armlab.session.store import state_from_text
from support.arms import KINDS
from support.done import done

NOBODY = frozenset()


def opened(key="planar_2r", *commands):
    return done(State.initial(catalogue()[key]), *commands)


@cache
def mapped(key="planar_2r", *commands):
    """Return a state with a small map; each is drawn once."""
    return drawn(opened(key, Set(Basins, "points", 64), *commands, DrawBasins()))


def test_nothing_is_computed_until_it_is_asked_for_and_then_whether_or_not_somebody_looks():
    state = opened()
    assert JOB.wanted(state, frozenset({"basins", "iterations"})) is None
    asked = apply(state, DrawBasins())
    wanted = JOB.wanted(asked, NOBODY)
    assert wanted.inputs is asked[Basins].drawing
    # Whatever else happens meanwhile, it is the same work.
    moved = apply(apply(asked, MoveJoint(0, 0.3)), MapMethod("gradient"))
    assert JOB.wanted(moved, NOBODY).key == wanted.key
    # The same question again is another map.
    assert JOB.wanted(apply(asked, DrawBasins()), NOBODY).key != wanted.key


def test_the_map_comes_in_pieces_and_is_done_once():
    state = apply(opened("planar_2r", Set(Basins, "points", 64)), DrawBasins())
    question = state[Basins].drawing
    done = []
    for found in run(question):
        if found is not None:
            state = JOB.delivered(state, question, found)
            done.append(state[Basins].map.done)
            assert (state[Basins].drawing is None) == (done[-1] == 1.0)
    assert done == sorted(set(done))
    assert len(done) > 2
    assert state[Basins].finished is state[Basins].map
    assert JOB.wanted(state, NOBODY) is None
    assert (state[Basins].map.found.index != FAILED).mean() > 0.7


def test_a_cancelled_map_keeps_what_it_has_and_late_pieces_are_let_go():
    state = apply(opened("planar_2r", Set(Basins, "points", 64)), DrawBasins())
    question = state[Basins].drawing
    pieces = (found for found in run(question) if found is not None)
    next(pieces)
    state = JOB.delivered(state, question, next(pieces))
    state = apply(state, CancelBasins())
    part = state[Basins]
    assert part.drawing is None
    assert 0.0 < part.map.done < 1.0
    assert part.finished is None
    assert JOB.wanted(state, NOBODY) is None
    assert JOB.delivered(state, question, next(pieces)) is state
    assert apply(state, CancelBasins()) is state


def test_colours_and_names_follow_the_list_of_all_solutions():
    found = mapped("elbow_3r")[Basins].map
    known = known_solutions(found.question)
    np.testing.assert_array_equal(found.found.solutions, known.q)
    assert found.names == known.names
    assert "shoulder" in found.names[0]
    assert "4" in found.known or "four" in found.known.lower()


def test_a_film_begun_in_the_map_ends_in_its_solution():
    state = mapped()
    found = state[Basins].map
    # On the middle of a pixel whose neighbours agree with it: away from edges.
    for x, y in ((0.55, 0.7), (0.6, 0.3), (0.3, 0.8)):
        index, steps = found.outcome(x, y)
        begun = with_films(apply(state, StartInMap(x, y)))
        part = begun[Iterations]
        assert part.start == found.start(x, y)
        assert begun[Timeline].clip == "iterations"
        assert begun[Timeline].time == 0.0
        assert part.run.method == "newton"
        assert part.limits == "none"
        film = part.film
        assert film.success == (index != FAILED)
        if film.success:
            assert film.last == steps
            turned = np.abs(np.exp(1j * film.q[-1]) - np.exp(1j * found.found.solutions[index]))
            assert turned.max() < 2e-3


def test_a_film_is_made_with_all_that_the_map_was_made_with():
    state = mapped(
        "planar_3r",
        TakeJoint(3),
        MapMethod("dls_constant", "lambda", 0.05),
        SetFields.of(Basins, most=50, limits="clamp"),
    )
    other = apply(apply(state, MapMethod("gradient")), Set(Basins, "most", 200))
    other = apply(apply(other, ChooseTask(None)), AimAt(catalogue()["planar_3r"].arm.fk([0.1, 0.2, 0.3])))
    assert belongs_elsewhere(other)
    begun = apply(other, StartInMap(0.6, 0.6))
    part, asked = begun[Iterations], state[Basins].map.question
    assert part.run.method == "dls_constant"
    assert part.run.values["lambda"] == 0.05
    assert (part.most, part.limits) == (50, "clamp")
    assert vector_of(begun) == asked.task
    assert part.target.tobytes() == asked.target
    assert not belongs_elsewhere(begun)
    # The other run stays as it was.
    assert len(part.runs) == len(state[Iterations].runs)
    assert len({run.colour for run in part.runs}) == len(part.runs)


def test_a_run_like_the_maps_is_selected_and_none_is_overwritten():
    state = mapped("planar_2r", MapMethod("gradient"))
    runs = state[Iterations].runs
    assert [run.method for run in runs] == ["newton", "gradient"]
    begun = apply(state, StartInMap(0.5, 0.5))
    assert begun[Iterations].runs == runs
    assert begun[Iterations].selected == 1


def test_places_in_the_map_are_those_of_its_pixels():
    found = mapped()[Basins].map
    side = math.tau / 64
    np.testing.assert_allclose(found.start(0.0, 0.0), [-math.pi + side / 2] * 2, atol=1e-12)
    np.testing.assert_allclose(found.start(1.0, 1.0), [math.pi - side / 2] * 2, atol=1e-12)
    for joint, value, part in ((0, 0.0, 0.5), (1, -math.pi / 2, 0.25), (0, math.pi / 2 + math.tau, 0.75)):
        assert found.part(joint, value) == pytest.approx(part, abs=1e-12)
    for k in range(64):
        assert found.part(0, found.start((k + 0.5) / 64, 0.5)[0]) == pytest.approx((k + 0.5) / 64, abs=1e-12)


def test_the_map_stays_and_says_so_when_the_target_moves_and_goes_with_the_arm():
    state = mapped()
    assert not belongs_elsewhere(state)
    found = state[Basins].map
    turned = apply(state, MoveJoint(0, 0.3))
    assert not belongs_elsewhere(turned)
    pose = np.array(turned[Joints].tool_pose)
    pose[0, 3] -= 0.2
    moved = apply(turned, PlaceTarget(pose))
    assert belongs_elsewhere(moved)
    assert moved[Basins].map is found
    again = drawn(apply(moved, DrawBasins()))
    assert not belongs_elsewhere(again)
    assert apply(moved, ChooseRobot("elbow_3r"))[Basins].map is None
    assert apply(moved, SetCell(0, "a", 1.3))[Basins].map is None
    drawing = apply(apply(moved, DrawBasins()), ChooseRobot("scara"))
    assert JOB.wanted(drawing, NOBODY) is None


def test_what_was_chosen_goes_along_with_edits_of_the_table():
    state = opened("elbow_3r", MapMethod("ccd"), MapRest(0, 0.4), Set(Basins, "points", 256))
    assert state[Basins].joints == (1, 2)
    added = apply(state, AddJoint(-1))
    assert added[Basins].joints == (2, 3)
    assert added[Basins].rest[1] == 0.4
    assert (added[Basins].run.method, added[Basins].points) == ("ccd", 256)
    removed = apply(added, RemoveJoint(3))
    assert max(removed[Basins].joints) < 3
    apply(removed, MapJoints(0, 2))
    one = apply(apply(opened("planar_2r"), RemoveJoint(1)), MapMethod("newton"))
    with pytest.raises(InputError, match="two different joints"):
        apply(one, DrawBasins())


def test_undo_leaves_the_map_and_takes_the_start_back():
    session = Session("token", catalogue()["planar_2r"], mapped())
    start, q = session.state[Iterations].start, session.state[Joints].q
    session.apply(StartInMap(0.7, 0.2), 0.0)
    assert session.state[Iterations].start != start
    found = session.state[Basins].map
    session.apply(Undo(), 9.0)
    assert session.state[Iterations].start == start
    np.testing.assert_array_equal(session.state[Joints].q, q)
    assert session.state[Basins].map is found


@pytest.mark.parametrize("key", KINDS)
def test_every_arm_opens_and_what_is_chosen_is_read_back(key):
    state = opened(
        key, MapMethod("dls_constant", "lambda", 0.2), SetFields.of(Basins, points=64, most=50, limits="clamp")
    )
    back = state_from_text(json.dumps({"format": 1, "parts": state.to_json()}))[Basins]
    assert back.to_json() == state[Basins].to_json()
    assert (back.run.values["lambda"], back.points, back.most, back.limits) == (0.2, 64, 50, "clamp")
    arm = state[Joints].arm
    if arm.n > arm.task.m:
        assert "redundant" in refusal(state)
        with pytest.raises(InputError, match="redundant"):
            apply(state, DrawBasins())
    else:
        assert refusal(state) == ""
        assert apply(state, DrawBasins())[Basins].drawing is not None


@pytest.mark.parametrize(
    "damage",
    [
        {"joints": [0, 0]},
        {"joints": [0, 7]},
        {"joints": [1]},
        {"rest": [0.0]},
        {"rest": [0.0, math.nan]},
        {"points": 63},
        {"points": 10**6},
        {"most": 10**9},
        {"limits": "maybe"},
        {"run": ["newtom", {}, 0]},
        {"run": ["flow", {}, 0]},
        {"run": ["gradient", {"alpha": -1.0}, 0]},
        {"run": []},
    ],
)
def test_damaged_files_are_refused(damage):
    robot = catalogue()["planar_2r"]
    data = {**Basins.initial(robot).to_json(), **damage}
    with pytest.raises((ArmlabError, ValueError, TypeError, LookupError)):
        Basins.from_json(data, robot)


@pytest.mark.parametrize(
    ("command", "said"),
    [
        (StartInMap(0.5, 0.5), "there is no map yet"),
        (MapMethod("newtom"), "unknown name 'newtom'"),
        (MapMethod("flow"), "unknown name 'flow'"),
        (MapMethod("gradient", "beta", 1.0), "unknown name 'beta'"),
        (MapMethod("gradient", "alpha", math.nan), "expected 0.0001 to 100, got nan"),
        (MapMethod("gradient", "alpha", 1e9), "expected 0.0001 to 100"),
        (MapJoints(0, 5), "two different joints of 1 to 2"),
        (MapJoints(-1, 0), "two different joints"),
        (MapRest(5, 0.0), "joint: expected 1 to 2, got 6"),
        (MapRest(0, math.inf), "rest: expected finite numbers"),
        (MapRest(0, 1e7), "ten turns"),
        (Set(Basins, "points", 65), "points: unknown name 65"),
        (Set(Basins, "most", 7), "most: unknown name 7"),
        (Set(Basins, "limits", "maybe"), "limits: unknown name"),
        (TakeJoint(3), "joint: expected 1 to 2, got 3"),
    ],
)
def test_bad_wishes_are_refused_in_words_and_change_nothing(command, said):
    with pytest.raises(InputError, match=said):
        apply(opened(), command)


def test_places_outside_the_map_are_refused():
    state = mapped()
    for x, y in ((-0.01, 0.5), (0.5, 1.01), (math.nan, 0.5)):
        with pytest.raises(InputError, match="place in the map"):
            apply(state, StartInMap(x, y))


def test_the_joints_change_places_instead_of_becoming_the_same():
    state = opened("elbow_3r")
    assert apply(state, MapJoints(2, 2))[Basins].joints == (2, 1)
    assert apply(state, MapJoints(1, 2)) is state
    assert apply(state, MapJoints(0, 2))[Basins].joints == (0, 2)


def test_position_only_of_the_3r_is_refused_with_what_to_do_and_the_third_joint_makes_it_two_arms():
    arm = catalogue()["planar_3r"].arm
    state = opened("planar_3r", ChooseTask(ik.task_vector(arm, "xy")))
    assert "lock joints or take one as a task component" in refusal(state)
    taken = apply(state, TakeJoint(3))
    assert refusal(taken) == ""
    vector = vector_of(taken)
    assert vector.names == ("p_x", "p_y", "q_3")
    # The wanted value is one with which the target can be reached: the map has its two arms.
    found = mapped("planar_3r", ChooseTask(ik.task_vector(arm, "xy")), TakeJoint(3))[Basins].map
    assert len(found.found.solutions) == 2
    np.testing.assert_allclose(found.found.solutions[:, 2], vector.joints[0][1], atol=1e-6)
    assert all(name.startswith("elbow") for name in set(found.names))
    assert len(set(found.names)) == 2


def test_a_locked_joint_stays_where_it_stands_and_its_map_is_one_of_the_film():
    arm = catalogue()["planar_3r"].arm
    state = opened(
        "planar_3r", ChooseTask(ik.task_vector(arm, "xy")), AimAt(), LockJoint(2, True), Set(Basins, "points", 64)
    )
    assert refusal(state) == ""
    state = drawn(apply(state, DrawBasins()))
    found = state[Basins].map
    assert found.question.rest[2] == state[Joints].q[2]
    assert len(found.found.solutions) == 2
    index, steps = found.outcome(0.6, 0.4)
    film = with_films(apply(state, StartInMap(0.6, 0.4)))[Iterations].film
    assert film.success == (index != FAILED)
    assert film.last == steps
    with pytest.raises(InputError, match="the held joints have changed"):
        apply(apply(state, LockJoint(2, False)), StartInMap(0.5, 0.5))
    both = apply(opened("planar_2r"), LockJoint(0, True))
    assert "not locked" in refusal(both)
    with pytest.raises(InputError, match="two joints that are not locked"):
        apply(both, DrawBasins())


def test_a_target_out_of_reach_is_white_and_says_that_there_is_no_solution():
    pose = np.eye(4)
    pose[:3, 3] = [3.0, 0.0, 0.0]
    found = drawn(opened("planar_2r", SetFields.of(Basins, points=64, most=50), AimAt(pose), DrawBasins()))[Basins].map
    assert (found.found.index == FAILED).all()
    assert found.names == ()
    assert "no" in found.known.lower()


def test_starts_as_the_arm_stands():
    state = apply(opened("puma560", MoveJoint(3, 0.7)), MapRest())
    np.testing.assert_array_equal(state[Basins].rest, state[Joints].q)
    assert apply(state, MapRest()) is state


def test_the_gradient_reaches_both_arms_with_what_a_map_begins_with():
    """With an unsuitable step size, target or number of steps the map would be white."""
    state = mapped("planar_2r", MapMethod("gradient"))
    assert state[Basins].run.values == {"alpha": 0.3}
    index = state[Basins].map.found.index
    assert (index == FAILED).mean() < 0.05
    assert set(np.unique(index)) >= {0, 1}


def test_another_arm_has_another_step_size_and_an_edited_one_keeps_it():
    state = opened("planar_2r", MapMethod("gradient", "alpha", 0.25))
    assert apply(state, SetCell(0, "a", 0.9))[Basins].run.values == {"alpha": 0.25}
    assert apply(state, ChooseRobot("elbow_3r"))[Basins].run.values["alpha"] != 0.25


def test_an_arm_that_had_one_joint_and_gets_a_second_has_two_axes():
    one = opened("planar_2r", RemoveJoint(1))
    assert one[Basins].joints == (0, 0)
    assert refusal(one) == ONE_JOINT
    two = apply(one, AddJoint(0))
    assert sorted(two[Basins].joints) == [0, 1]
    Basins.from_json(two[Basins].to_json(), two[RobotPart].robot)
