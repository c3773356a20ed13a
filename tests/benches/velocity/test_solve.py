"""The bench that solves for joint speeds: its part, its answers, its self-motion, its pictures and its examples."""

import math

import numpy as np
import pytest

from armlab.benches.velocity.solve.clip import SECONDS
from armlab.benches.velocity.solve.examples import EXAMPLES, ChooseSolveExample
from armlab.benches.velocity.solve.found import found
from armlab.benches.velocity.solve.motion import BeginAlong, SlideAlong, begun, looked_for, part_of
from armlab.benches.velocity.solve.pictures import DragTo, StandAt, contour, flat, norm_curve, refusal, square, suited
from armlab.benches.velocity.solve.state import CLIP_KEY, Aim, AskFor, SetComponent, Solve
from armlab.content.robots import catalogue, own_robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.dh import Row
from armlab.session.bench import PutInPlace, benches
from armlab.session.edits import RemoveJoint, SetCell
from armlab.session.fields import Set
from armlab.session.history import History
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.state import State, apply

TIGHT = 1e-9


def opened(key="planar_2r"):
    return State.initial(catalogue()[key])


def example(key):
    return apply(opened(), ChooseSolveExample(key))


def tool(state):
    return np.asarray(state[Joints].tool_pose)


# -- the part --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", list(catalogue().robots))
def test_every_arm_opens_with_a_velocity_of_its_task_and_is_written_and_read(key):
    state = opened(key)
    part = state[Solve]
    assert len(part.twist) == state[Joints].arm.task.m
    assert any(part.twist)
    solved = found(state)
    np.testing.assert_allclose(solved.J @ solved.answer.qdot, solved.answer.reached, rtol=0, atol=1e-10)
    back = State.from_json(state.to_json(), state[RobotPart].robot)[Solve]
    assert back.to_json() == part.to_json()


@pytest.mark.parametrize(
    "damage",
    [
        {"twist": [1.0]},
        {"twist": [1.0, math.nan]},
        {"rows": "position"},
        {"rows": "nothing"},
        {"pair": [0, 0]},
        {"pair": [0, 7]},
        {"pair": [0.5, 1.5]},
        {"pair": [0, math.inf]},
        {"example": ["one"]},
        {"rows": None},
        {"start": [0.0]},
        {"start": [0.0, math.inf]},
    ],
)
def test_a_damaged_file_is_refused(damage):
    state = opened()
    with pytest.raises(InputError):
        Solve.from_json(state[Solve].to_json() | damage, state[RobotPart].robot)


def test_components_are_typed_and_dragged():
    state = apply(opened("puma560"), SetComponent(4, 0.3))
    state = apply(state, Aim((0.1, 0.2, -0.3)))
    assert state[Solve].twist == (0.1, 0.2, -0.3, 0.0, 0.3, 0.0)
    assert not Aim.undoable
    for command, match in (
        (SetComponent(6, 0.0), r"component \(counted from 0\): expected 0 to 5"),
        (SetComponent(0, math.nan), "twist: expected finite numbers"),
        (SetComponent(0, 1e9), "twist: expected at least -100 and at most 100"),
        (Aim((1.0, 2.0)), "velocity: expected 3"),
    ):
        with pytest.raises(InputError, match=match):
            apply(state, command)


def test_position_alone_is_asked_where_it_is_less():
    state = apply(opened("planar_3r"), AskFor("position"))
    assert found(state).J.shape == (2, 3)
    assert found(state).answer.verdict == "many"
    with pytest.raises(InputError, match="position alone"):
        apply(opened(), AskFor("position"))
    with pytest.raises(InputError):
        apply(opened(), AskFor("everything"))


def test_another_arm_and_another_table_keep_what_fits():
    state = apply(apply(opened("planar_3r"), SetComponent(0, 0.4)), Set(Solve, "pair", (1, 2)))
    longer = apply(state, SetCell(0, "a", 1.3))
    assert longer[Solve].twist[0] == 0.4
    assert longer[Solve].arm is longer[Joints].arm
    assert longer[Solve].pair == (1, 2)
    assert apply(state, RemoveJoint(2))[Solve].pair == (0, 1)
    assert len(apply(state, ChooseRobot("puma560"))[Solve].twist) == 6


# -- the answers -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "case"), [("stretched_30", "C5.2.3-sing2R-30"), ("stretched_90", "C5.2.3-sing2R-90")])
def test_the_stretched_2r_reaches_what_the_notes_say(truth, name, case):
    solved, expected = found(example(name)), truth[case]["expected"]
    np.testing.assert_allclose(solved.answer.qdot, expected["qdot"], rtol=0, atol=TIGHT)
    np.testing.assert_allclose(solved.answer.reached, expected["v_perp"], rtol=0, atol=TIGHT)


def test_the_redundant_3r_has_the_joint_speeds_of_the_notes(truth):
    solved = found(example("redundant_3r"))
    expected = truth["C5.2.2-pinv-3R"]["expected"]
    np.testing.assert_allclose(solved.answer.qdot, expected["qdot"], rtol=0, atol=TIGHT)
    assert max(solved.penrose) < 1e-12


def test_the_2r_driven_to_its_stretched_pose_loses_one_direction_within_a_degree():
    state = opened()
    for q2 in np.linspace(1.0, 0.0, 11):
        state = apply(state, MoveJoint(1, float(q2)))
    solved = found(state)
    assert solved.singular
    (reason,) = solved.reasons
    assert "elbow" in reason.says.lower()
    assert "boundary" in reason.says
    along = tool(state)[:3, 3] / np.linalg.norm(tool(state)[:3, 3])
    assert abs(reason.direction @ along) > math.cos(math.radians(1.0))
    lost = solved.vectors(solved.spaces.lost[:, 0])[0]
    assert abs(lost @ along) > math.cos(math.radians(1.0))
    assert solved.answer.free.shape == (2, 1)
    assert np.isfinite(solved.answer.qdot).all()


@pytest.mark.parametrize("key", list(EXAMPLES))
def test_every_example_is_put_in_place_and_shows_what_it_says(key):
    state = example(key)
    wanted = EXAMPLES[key]
    arm = state[Joints].arm
    q = [math.radians(value) if turns else value for value, turns in zip(wanted.q, arm.revolute, strict=True)]
    np.testing.assert_allclose(state[Joints].q, q, rtol=0, atol=1e-12)  # inside the limits
    solved = found(state)
    verdicts = {"one": "one", "stretched_30": "none", "stretched_90": "many", "redundant_3r": "many"}
    verdicts |= {"singular_3r": "none", "elbow_stretched": "none", "seven": "many", "wrist": "none"}
    if key in verdicts:
        assert solved.answer.verdict == verdicts[key]
    kinds = {"on_the_axis": "shoulder", "elbow_stretched": "elbow", "rrp_upright": "shoulder", "wrist": "wrist"}
    if key in kinds:
        assert [reason.kind for reason in solved.reasons] == [kinds[key]]
    assert state[Solve].example == key
    assert apply(state, MoveJoint(0, 0.123))[Solve].example == ""
    assert apply(opened(), PutInPlace(f"solve/{key}"))[Solve].example == key


def test_the_bench_is_found():
    assert set(benches()["solve"].examples) == set(EXAMPLES)
    with pytest.raises(InputError, match="example"):
        apply(opened(), ChooseSolveExample("no such"))


# -- the self-motion -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", ["redundant_3r", "seven", "wrist"])
def test_the_tool_stays_while_the_slider_moves_the_arm(key):
    state = apply(example(key), BeginAlong())
    before, solved = tool(state), found(state)
    assert part_of(state) is not None
    moved = []
    for part in (0.1, 0.35, 0.6, 0.9):
        state = apply(state, SlideAlong(part))
        now = tool(state)
        np.testing.assert_allclose(now[:3, 3], before[:3, 3], rtol=0, atol=1e-9)
        if solved.arm.task.rotation != "none":
            np.testing.assert_allclose(now, before, rtol=0, atol=1e-9)
        assert part_of(state) == pytest.approx(part, abs=0.01)
        moved.append(state[Joints].q)
    assert np.ptp(np.array(moved), axis=0).max() > 0.1


def test_where_nothing_moves_the_slider_says_so():
    for key in ("one", "stretched_90"):
        state = example(key)
        assert not looked_for(state)
        looked = apply(state, BeginAlong())
        assert looked_for(looked)
        assert part_of(looked) is None
        assert apply(looked, BeginAlong()) is looked
        assert not looked_for(apply(looked, LockJoint(0, True)))
        np.testing.assert_array_equal(looked[Joints].q, state[Joints].q)
        with pytest.raises(InputError, match="no motion of the joints leaves the tool where it is"):
            apply(state, SlideAlong(0.5))
    with pytest.raises(InputError, match="from 0 to 1"):
        apply(example("seven"), SlideAlong(math.nan))


def test_a_hand_takes_the_arm_off_its_self_motion():
    state = apply(apply(example("redundant_3r"), BeginAlong()), SlideAlong(0.3))
    assert begun(apply(state, MoveJoint(0, state[Joints].q[0] + 1.0))) is None
    held = apply(example("seven"), LockJoint(2, True))
    before = held[Joints].q[2]
    with pytest.raises(InputError, match="no motion"):
        apply(held, SlideAlong(0.4))
    assert held[Joints].q[2] == before


@pytest.mark.parametrize("key", ["redundant_3r", "seven"])
def test_the_film_goes_along_and_comes_back(key):
    begin = example(key)
    state = apply(begin, OpenClip(CLIP_KEY))
    start = begin[Joints].q
    seen = []
    for time in np.linspace(0.0, SECONDS, 9):
        state = apply(state, Seek(float(time)))
        seen.append(state[Joints].q)
        np.testing.assert_allclose(tool(state)[:3, 3], tool(begin)[:3, 3], rtol=0, atol=1e-9)
    gap = seen[-1] - start
    np.testing.assert_allclose(gap - 2.0 * np.pi * np.round(gap / (2.0 * np.pi)), 0.0, atol=1e-6)
    assert np.abs(np.diff(seen, axis=0)).max() > 0.1
    closed = apply(state, OpenClip(""))
    assert closed[Timeline].clip == ""
    assert closed[Solve].start is None


def test_there_is_no_film_where_nothing_moves():
    with pytest.raises(InputError, match="nothing to play"):
        apply(example("one"), OpenClip(CLIP_KEY))


# -- the pictures ----------------------------------------------------------------------------------------------------


def test_the_singular_set_of_the_2r_is_stretched_and_folded():
    state = opened()
    place = square(state)
    assert not place.always
    values = np.unique(np.round(np.abs(place.singular[:, :, 1]), 3))
    assert values.tolist() == [0.0, round(math.pi, 3)]


def test_the_singular_set_of_two_joints_of_a_3r_is_where_their_determinant_vanishes():
    state = apply(opened("planar_3r"), Set(Solve, "pair", (1, 2)))
    arm, place = state[Joints].arm, square(state)
    assert len(place.singular) > 20
    for q2, q3 in place.singular[::7, 0]:
        J = arm.jacobian([state[Joints].q[0], q2, q3])[:2, 1:]
        assert abs(np.linalg.det(J)) < 2e-2 * arm.length_scale**2


def test_two_equations_are_those_of_the_task(truth):
    state = example("one")
    two = flat(state)
    np.testing.assert_allclose(two.J, found(state).J, rtol=0, atol=1e-12)
    np.testing.assert_allclose(two.answer.qdot, found(state).answer.qdot, rtol=0, atol=1e-12)
    assert two.determinant == pytest.approx(math.sin(state[Joints].q[1]), abs=1e-12)


def test_the_norm_grows_without_bound_towards_det_zero():
    state = example("one")
    curve = norm_curve(state)
    some = np.isfinite(curve.norm)
    near = np.abs(curve.determinant[some]) < 0.05
    assert curve.norm[some][near].max() > 5.0 * curve.norm[some].min()
    here = np.argmin(np.abs(curve.determinant - flat(state).determinant))
    assert curve.norm[here] >= curve.norm[some].min()


def test_a_place_in_the_square_is_where_the_joints_go():
    state = apply(opened(), StandAt(0.75, 0.25))
    np.testing.assert_allclose(state[Joints].q, [math.pi / 2, -math.pi / 2], rtol=0, atol=1e-12)
    with pytest.raises(InputError, match="place in the square"):
        apply(state, StandAt(math.nan, 0.0))


def test_one_drag_in_the_square_is_one_step_of_undo():
    history, state = History(), opened()
    for command in (DragTo(0.6, 0.5, 1), DragTo(0.7, 0.4, 1), DragTo(0.2, 0.4, 2)):
        before, state = state, apply(state, command)
        history.note(before, state, command, 0.0)
    np.testing.assert_allclose(state[Joints].q, (np.array([0.2, 0.4]) - 0.5) * math.tau, rtol=0, atol=1e-12)
    state = history.undo(state)
    np.testing.assert_allclose(state[Joints].q, (np.array([0.7, 0.4]) - 0.5) * math.tau, rtol=0, atol=1e-12)
    assert history.undo(state)[Joints].q.tolist() == opened()[Joints].q.tolist()


def test_other_arms_are_refused_in_a_sentence():
    assert "parallel axes" in refusal(opened("puma560"))
    assert refusal(opened("scara")) == ""
    assert next(iter(suited())) == "planar_2r"
    assert [refusal(opened(key)) for key in suited()] == [""] * len(suited())
    assert "slides out of the plane" in refusal(apply(opened("scara"), Set(Solve, "pair", (0, 2))))
    with pytest.raises(InputError, match="parallel axes"):
        apply(opened("puma560"), StandAt(0.5, 0.5))
    # Axes that are parallel along another line than z of frame 0 are not said to be none.
    upright = Arm.from_dh([Row("R", 0.0, math.pi / 2), Row("R", 0.5, 0.0)], "modified")
    assert "along z of frame 0" in refusal(State.initial(own_robot(upright, "upright")))
    with pytest.raises(InputError, match="two joints"):
        apply(opened(), Set(Solve, "pair", (1, 1)))


def test_the_contour_of_a_circle_is_a_circle():
    x = np.linspace(-2.0, 2.0, 41)
    values = x[:, None] ** 2 + x[None, :] ** 2 - 1.0
    radii = np.linalg.norm(contour(x, x, values), axis=-1)
    np.testing.assert_allclose(radii, 1.0, atol=0.01)
