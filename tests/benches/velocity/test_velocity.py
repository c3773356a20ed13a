"""The bench of velocities without a page: parts and sum, points of a link, the drive, examples, bad input."""

import json

import numpy as np
import pytest

from armlab.benches.velocity.speeds.clip import CLIP
from armlab.benches.velocity.speeds.commands import (
    DrawVelocities,
    LookAtLink,
    MoveAlone,
    SetAllSpeeds,
    SetLinkPoint,
    SetSpeed,
    Unfold,
)
from armlab.benches.velocity.speeds.examples import EXAMPLES, ChooseVelocityExample
from armlab.benches.velocity.speeds.motion import (
    first_at_limit,
    higher_of,
    measured_velocity,
    moving_of,
    speeds_of,
    time_left,
    two_points_of,
)
from armlab.benches.velocity.speeds.state import Velocity, drawn_scales, ends_of, fastest
from armlab.content.robots import catalogue
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.session.bench import choosing
from armlab.session.edits import RemoveJoint, SetCell
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.timeline import OpenClip, Play, Seek, Timeline, duration
from armlab.session.state import State, apply
from support.arms import random_arm
from support.done import done


def opened(key="puma560", *commands):
    return done(State.initial(catalogue()[key]), *commands)


def with_speeds(state, speeds):
    for joint, value in enumerate(speeds):
        state = apply(state, SetSpeed(joint, float(value)))
    return state


def at(state, q):
    return state.replace(state[Joints].moved_to(q))


# -- parts and sum -----------------------------------------------------------------------------------------------------


def test_the_parts_sum_to_the_finite_difference_of_the_tool(robot, rng):
    """Within 1 % is wanted; it is much closer, for the difference is central."""
    state = State.initial(robot)
    limits = robot.arm.limits
    for _ in range(3):
        speeds = rng.uniform(-1, 1, robot.arm.n) * [fastest(robot.arm, i) for i in range(robot.arm.n)]
        moved = at(with_speeds(state, speeds), rng.uniform(limits[:, 0], limits[:, 1]))
        parts, way = moving_of(moved).parts[:3].sum(axis=1), measured_velocity(moved)
        np.testing.assert_allclose(parts, way, rtol=0, atol=1e-5 * max(1.0, np.abs(way).max()))
        np.testing.assert_allclose(moving_of(moved).twist[:3], parts, rtol=0, atol=1e-12)


@pytest.mark.parametrize("axes", ["world", "base", "tool"])
def test_j_in_other_axes_gives_the_same_vectors(axes, rng):
    state = opened("ur5e", Set(Velocity, "axes", axes))
    moving = moving_of(at(state, rng.uniform(-1, 1, 6)))
    np.testing.assert_allclose(moving.axes @ moving.matrix[:3], moving.J[:3], rtol=0, atol=1e-14)
    np.testing.assert_allclose(moving.axes @ moving.matrix[3:], moving.J[3:], rtol=0, atol=1e-14)


def test_the_linear_part_of_a_revolute_joint_is_across_its_axis_and_the_lever(robot):
    moving = moving_of(State.initial(robot))
    for j in np.flatnonzero(robot.arm.revolute):
        z, part = moving.J[3:, j], moving.J[:3, j]
        assert abs(z @ part) < 1e-12
        np.testing.assert_allclose(part, np.cross(z, moving.point - moving.origins[j]), rtol=0, atol=1e-12)


def test_a_held_joint_gives_nothing():
    state = opened("planar_2r", SetSpeed(0, 0.5), SetSpeed(1, 0.5), LockJoint(0, True))
    np.testing.assert_array_equal(speeds_of(state), [0.0, 0.5])
    np.testing.assert_array_equal(moving_of(state).parts[:, 0], np.zeros(6))


def test_speeds_stay_inside_the_limits_of_the_joint():
    state = opened("planar_2r", SetSpeed(0, 1e6))
    assert state[Velocity].qdot[0] == pytest.approx(fastest(state[Joints].arm, 0))
    with pytest.raises(InputError, match="qdot: expected finite numbers"):
        SetSpeed(0, float("nan")).apply(state)


def test_one_alone_all_and_none():
    state = opened("puma560", MoveAlone(2))
    assert np.count_nonzero(state[Velocity].qdot) == 1
    assert state[Velocity].qdot[2] > 0.0
    state = apply(apply(state, SetAllSpeeds(False)), MoveAlone(4))
    assert np.flatnonzero(state[Velocity].qdot).tolist() == [4]
    assert np.count_nonzero(apply(state, SetAllSpeeds(True))[Velocity].qdot) == 6


def test_arrows_fit_and_their_scale_is_a_round_number(robot):
    arm, part = robot.arm, State.initial(robot)[Velocity]
    q = np.random.default_rng(5).uniform(arm.limits[:, 0], arm.limits[:, 1], (200, arm.n))
    parts = arm.jacobian(q) * np.array(part.qdot)
    for half, scale in zip((parts[:, :3], parts[:, 3:]), drawn_scales(arm, part.qdot), strict=True):
        mantissa = scale / 10.0 ** np.floor(np.log10(scale) + 1e-9)
        assert min(abs(mantissa - step) for step in (1, 2, 3, 5)) < 1e-9
        lengths = scale * np.linalg.norm(half.sum(axis=2), axis=1)
        assert np.quantile(lengths, 0.85) < 0.95 * arm.length_scale
        assert lengths.max() == 0.0 or lengths.max() > 0.05 * arm.length_scale
    assert drawn_scales(arm, (0.0,) * arm.n) == (1.0, 1.0)


# -- two points --------------------------------------------------------------------------------------------------------


def test_two_points_of_every_link_move_as_the_link_does(robot, rng):
    arm = robot.arm
    state = with_speeds(State.initial(robot), rng.uniform(-0.5, 0.5, arm.n))
    h = 1e-6
    for link in range(1, arm.n + 1):
        state = apply(state, LookAtLink(link))
        second = tuple(rng.uniform(-0.5, 0.5, 3).tolist())
        state = apply(state, SetLinkPoint(1, second))
        found = two_points_of(state)
        q, speeds = state[Joints].q, speeds_of(state)
        for point, velocity in zip(state[Velocity].points, (found.v1, found.v2), strict=True):
            ends = [(arm.frames(q + sign * h * speeds)[link] @ [*point, 1.0])[:3] for sign in (1, -1)]
            np.testing.assert_allclose(velocity, (ends[0] - ends[1]) / (2 * h), rtol=0, atol=1e-7)
        assert abs(found.across @ found.lever) < 1e-12


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_the_ends_of_a_link_are_on_the_axes_of_its_joints(convention, rng):
    for _ in range(5):
        arm = random_arm(rng, 5, convention=convention)
        arm = Arm.from_dh([("R", r.a, r.alpha, r.d, r.theta) for r in arm.rows], convention, arm.base, arm.tool)
        frames = arm.frames(np.zeros(5))
        axes = frames[:-1] if convention == "standard" else frames[1:]
        for link in range(1, 6):
            near, far = ((frames[link] @ [*point, 1.0])[:3] for point in ends_of(arm, link))
            on = axes[link - 1]
            assert np.linalg.norm(np.cross(near - on[:3, 3], on[:3, 2])) < 1e-12
            if link < 5:
                after = axes[link]
                assert np.linalg.norm(np.cross(far - after[:3, 3], after[:3, 2])) < 1e-12
            else:
                np.testing.assert_allclose(far, arm.fk(np.zeros(5))[:3, 3], rtol=0, atol=1e-12)


def test_a_link_without_length_still_has_two_points(robot):
    for link in range(1, robot.arm.n + 1):
        near, far = ends_of(robot.arm, link)
        assert np.linalg.norm(np.subtract(near, far)) > 1e-9


# -- examples ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", list(EXAMPLES))
def test_every_example_stands_as_it_says(key):
    state = apply(opened("scara"), choosing(f"velocity/{key}"))
    example = EXAMPLES[key]
    assert state[RobotPart].robot.key == example.robot
    np.testing.assert_allclose(state[Joints].q, example.q, rtol=0, atol=1e-12)
    np.testing.assert_allclose(state[Velocity].qdot, example.qdot, rtol=0, atol=1e-12)
    assert state[Velocity].example == key
    assert apply(state, SetSpeed(0, 0.123))[Velocity].example == ""


def test_what_the_examples_say_is_so():
    kernel = moving_of(opened("puma560", ChooseVelocityExample("kernel")))
    assert np.abs(kernel.J[:3, 0]).max() < 1e-12
    np.testing.assert_allclose(kernel.twist, [0, 0, 0, 0, 0, np.radians(60)], rtol=0, atol=1e-12)
    sliding = moving_of(opened("puma560", ChooseVelocityExample("sliding")))
    np.testing.assert_array_equal(sliding.J[3:, 2], np.zeros(3))
    assert np.linalg.norm(sliding.J[:3, 2]) == pytest.approx(1.0)
    wrist = moving_of(opened("puma560", ChooseVelocityExample("wrist")))
    np.testing.assert_allclose(wrist.J[:, 3], wrist.J[:, 5], rtol=0, atol=1e-12)
    np.testing.assert_allclose(wrist.twist, np.zeros(6), rtol=0, atol=1e-12)
    state = opened("puma560", ChooseVelocityExample("curving"))
    v, a = higher_of(state).twist[:3], higher_of(state).acceleration[:3]
    r = moving_of(state).point - moving_of(state).origins[0]
    np.testing.assert_allclose(a, -(v @ v) / (r @ r) * r, rtol=0, atol=1e-12)
    two = two_points_of(opened("puma560", ChooseVelocityExample("two_points")))
    assert np.linalg.norm(two.v1 - two.v2) > 0.1
    assert np.linalg.norm(two.lever) == pytest.approx(1.0)


# -- the drive ---------------------------------------------------------------------------------------------------------


def test_the_drive_moves_the_joints_with_their_speeds_until_a_limit_and_back():
    state = with_speeds(opened("planar_2r"), [0.2, -0.3])
    before = state[Joints].q
    state = apply(state, OpenClip("speeds"))
    np.testing.assert_array_equal(state[Joints].q, before)
    end = duration(state)
    assert end == pytest.approx(time_left(state))
    state = apply(state, Seek(1.0))
    np.testing.assert_allclose(state[Joints].q - before, [0.2, -0.3], rtol=0, atol=1e-12)
    state = apply(state, Seek(1e9))
    assert state[Timeline].time == pytest.approx(end)
    last = first_at_limit(state)
    limits = state[Joints].arm.limits[last]
    assert min(abs(limits - state[Joints].q[last])) < 1e-9
    assert duration(state) == pytest.approx(end)
    np.testing.assert_allclose(apply(state, Seek(0.0))[Joints].q, before, rtol=0, atol=1e-9)


def test_a_changed_speed_or_a_hand_is_where_the_drive_goes_on_from():
    state = apply(with_speeds(opened("planar_2r"), [0.2, 0.0]), OpenClip("speeds"))
    state = apply(apply(state, Play(True)), Seek(1.0))
    middle = state[Joints].q
    state = apply(state, SetSpeed(1, 0.4))
    np.testing.assert_array_equal(state[Joints].q, middle)
    assert state[Timeline].time == 1.0
    state = apply(state, Seek(1.5))
    np.testing.assert_allclose(state[Joints].q - middle, [0.1, 0.2], rtol=0, atol=1e-12)
    state = apply(state, MoveJoint(0, -1.0))
    assert state[Joints].q[0] == -1.0
    state = apply(state, Seek(2.0))
    assert state[Joints].q[0] == pytest.approx(-0.9, abs=1e-12)
    assert duration(state) == pytest.approx(2.0 + time_left(state))


def test_a_hand_takes_the_arm_away_from_an_example_and_driving_with_its_speeds_does_not():
    state = apply(opened(), ChooseVelocityExample("curving"))
    driven = apply(apply(state, OpenClip("speeds", play=True)), Seek(0.4))
    assert driven[Joints].q[0] > state[Joints].q[0]
    assert driven[Velocity].example == "curving"
    assert apply(state, MoveJoint(1, 0.2))[Velocity].example == ""


def test_nothing_moves_without_speeds_and_closing_forgets():
    state = apply(apply(opened("planar_2r"), SetAllSpeeds(False)), OpenClip("speeds"))
    assert CLIP.duration(state) == 0.0
    assert first_at_limit(state) is None
    assert state[Velocity].reached == 0.0
    assert apply(state, OpenClip(""))[Velocity].reached is None


# -- kept, and refused -------------------------------------------------------------------------------------------------


def test_it_survives_being_written_down_and_another_arm():
    state = opened(
        "ur5e",
        SetSpeed(1, -0.4),
        Set(Velocity, "axes", "tool"),
        LookAtLink(3),
        SetLinkPoint(0, (0.1, 0.2, 0.3)),
        DrawVelocities("points", True),
        Unfold("higher", True),
    )
    data = json.loads(json.dumps(state[Velocity].to_json()))
    back = Velocity.from_json(data, catalogue()["ur5e"])
    for name in ("qdot", "axes", "link", "points", "marks", "unfolded", "reached", "example"):
        assert getattr(back, name) == getattr(state[Velocity], name)
    other = apply(state, ChooseRobot("planar_2r"))[Velocity]
    assert (len(other.qdot), other.axes, other.link) == (2, "tool", 2)
    edited = apply(state, RemoveJoint(0))[Velocity]
    assert edited.qdot[0] == pytest.approx(-0.4)
    assert len(edited.qdot) == 5


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("qdot", [0.1]),
        ("qdot", [float("nan")] * 6),
        ("link", 7),
        ("link", 0),
        ("axes", "mine"),
        ("marks", ["glitter"]),
        ("unfolded", ["all"]),
        ("points", [[0, 0, 0], [0, 0, 1e9]]),
        ("points", [[0, 0], [0, 0, 0]]),
        ("reached", -1.0),
    ],
)
def test_damaged_files_are_refused(name, value):
    data = State.initial(catalogue()["puma560"])[Velocity].to_json()
    with pytest.raises(InputError):
        Velocity.from_json({**data, name: value}, catalogue()["puma560"])


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (SetSpeed(6, 0.1), "joint: expected 1 to 6, got 7"),
        (MoveAlone(-1), "joint: expected 1 to 6, got 0"),
        (LookAtLink(0), "link: expected a whole number, at least 1, got 0"),
        (LookAtLink(7), "link: expected 1 to 6, got 7"),
        (DrawVelocities("all", False), "all"),
        (SetLinkPoint(2, (0.0, 0.0, 0.0)), "expected 0 to 1, got 2"),
        (SetLinkPoint(0, (0.0, 0.0, 1e6)), "point of a link, z: expected at most 100 m"),
        (Set(Velocity, "axes", "mine"), "mine"),
        (DrawVelocities("all", True), "all"),
        (Unfold("all", True), "all"),
        (ChooseVelocityExample("none"), "none"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    with pytest.raises((InputError, UnknownName), match=told):
        command.apply(opened())


def test_an_edited_table_keeps_the_link_and_its_typed_points():
    ends = opened("puma560", LookAtLink(2))
    edited = apply(ends, SetCell(1, "a", 0.6))
    assert edited[Velocity].link == 2
    assert edited[Velocity].points == ends_of(edited[Joints].arm, 2) != ends[Velocity].points
    typed = apply(ends, SetLinkPoint(0, (0.1, 0.2, 0.3)))
    assert apply(typed, SetCell(1, "a", 0.6))[Velocity].points == typed[Velocity].points
    assert apply(typed, RemoveJoint(0))[Velocity].link == 1
    gone = apply(typed, RemoveJoint(1))
    assert gone[Velocity].link == gone[Joints].arm.n == 5


def test_the_slowest_of_speeds_takes_as_long_as_it_takes():
    state = opened("planar_2r", SetAllSpeeds(False), SetSpeed(0, 1e-308))
    assert time_left(state) == np.inf
    assert first_at_limit(state) == 0
    assert duration(apply(state, OpenClip("speeds"))) == 120.0
