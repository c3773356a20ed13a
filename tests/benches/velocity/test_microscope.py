"""The singularity microscope: what it is aimed at, what it finds beside singularities, and what it refuses."""

import json
import math

import numpy as np
import pytest

from armlab.benches.velocity.microscope.commands import AimAlong, BringNear, SetComponent, SetDamping, SetSpeed
from armlab.benches.velocity.microscope.examples import EXAMPLES, ChooseMicroscopeExample
from armlab.benches.velocity.microscope.looked import known_places, looked, near
from armlab.benches.velocity.microscope.state import Microscope
from armlab.content.robots import catalogue, own_robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.session.bench import choosing
from armlab.session.edits import SetCell
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.state import State, apply
from support.done import done


def opened(key, *commands):
    return done(State.initial(catalogue()[key]), *commands)


def answers(state):
    return {each.key: each for each in state.derived(looked).answers}


def test_2r_at_q2_zero_has_finite_bars_but_for_the_inverse_and_says_elbow():
    state = opened("planar_2r", MoveJoint(0, 0.5), MoveJoint(1, 0.0))
    look = state.derived(looked)
    assert look.singular
    along = np.array([math.cos(0.5), math.sin(0.5)])
    lost = math.degrees(math.acos(min(1.0, abs(float(look.lost @ along)))))
    assert lost < 1.0
    for each in look.answers:
        if each.key == "inverse":
            assert each.step.qdot is None
            assert "singular" in each.step.says
        else:
            assert np.isfinite(each.step.qdot).all()
        assert not math.isnan(each.error + each.along)
    found = state.derived(near)
    assert found.pose.away == 0.0
    assert found.why[0].kind == "elbow"
    # The joint speeds that leave the tool where it is: q1 and q2 of the 2R with l1 = l2 as -1 to 2.
    v = look.V[:, -1]
    assert float(v[1] / v[0]) == pytest.approx(-2.0, abs=1e-9)


@pytest.mark.parametrize("q2", [0.3, 0.01, 1e-5, 1e-9])
def test_beside_it_the_inverse_is_exact_and_fast_and_damping_is_neither(q2):
    found = answers(opened("planar_2r", MoveJoint(1, q2)))
    assert found["inverse"].error < 1e-5
    assert np.abs(found["inverse"].step.qdot).max() >= 0.1 / q2
    assert np.abs(found["dls_constant"].step.qdot).max() < 0.3 / (2.0 * 0.1) + 1e-9
    if q2 < 0.1:
        assert found["dls_variable"].error > 0.1


def test_every_known_place_of_every_robot_is_where_it_says(robot):
    state = opened(robot.key, Set(Microscope, "distance", 0.0))
    for i, place in enumerate(known_places(state)):
        assert place.says
        at = apply(state, BringNear(i))
        look = at.derived(looked)
        assert look.singular
        assert at.derived(near).why
        beside = apply(apply(state, Set(Microscope, "distance", 0.05)), BringNear(i))
        assert 0.0 < beside.derived(looked).inverse_condition < 0.2
        units = look.task.joint_units[place.pose.place]
        moved = beside[Joints].q[place.pose.place] - place.pose.q[place.pose.place]
        assert abs(moved) == pytest.approx(0.05 * units, abs=1e-9)
        for aim in ("lost", "across"):
            for each in apply(at, Set(Microscope, "aim", aim)).derived(looked).answers:
                assert each.step.says or np.isfinite(each.step.qdot).all()


@pytest.mark.parametrize(
    ("limits", "expected"),
    [((-150.0, 0.0), -3.0), ((0.0, 150.0), 3.0), ((-150.0, 1.0), -3.0), ((-1.0, 150.0), 3.0), ((-2.0, 1.0), -2.0)],
)
@pytest.mark.parametrize("home", [0.0, 1.0, -1.0])
def test_the_arm_is_brought_to_the_side_that_the_limits_allow(limits, expected, home):
    rows = [("R", 1.0, 0.0, 0.0, math.radians(turn)) for turn in (0.0, home)]
    around = np.radians([(-180.0, 180.0), np.subtract(limits, home)])
    state = State.initial(own_robot(Arm.from_dh(rows, limits=around), "own"))
    moved = done(state, Set(Microscope, "distance", math.radians(3.0)), BringNear(0))
    assert math.degrees(moved[Joints].q[1]) + home == pytest.approx(expected)


def test_the_wish_follows_the_aim():
    state = opened("puma560", SetSpeed(0.2))
    look = state.derived(looked)
    np.testing.assert_allclose(look.wish, 0.2 * look.U[:, -1], rtol=0, atol=1e-15)
    across = apply(state, Set(Microscope, "aim", "across")).derived(looked)
    assert abs(float(across.wish @ look.lost)) < 1e-12
    own = apply(state, AimAlong(2))[Microscope]
    assert own.own == (0.0, 0.0, pytest.approx(0.2 * own.task.length), 0.0, 0.0, 0.0)
    typed = apply(state, SetComponent(3, 0.5)).derived(looked)
    natural = look.natural(look.wish)
    natural[3] = 0.5
    np.testing.assert_allclose(typed.natural(typed.wish), natural, rtol=0, atol=1e-12)
    faster = apply(apply(state, AimAlong(2)), SetSpeed(0.4))[Microscope]
    assert faster.own[2] == pytest.approx(2.0 * own.own[2])


def test_damping_is_what_is_set():
    state = opened("planar_2r", MoveJoint(1, 0.0), SetDamping("lambda", 0.25), SetDamping("lambda_max", 0.5))
    found = answers(state)
    assert (found["dls_constant"].step.damping, found["dls_variable"].step.damping) == pytest.approx((0.25, 0.5))
    assert answers(apply(state, SetDamping("lambda_max", 0.0)))["dls_variable"].step.damping == 0.0
    assert apply(state, Set(Microscope, "method", "transpose"))[Microscope].method == "transpose"


@pytest.mark.parametrize("key", list(EXAMPLES))
def test_an_example_is_put_in_place(key):
    state = opened("scara", choosing(f"microscope/{key}"))
    example, look = EXAMPLES[key], state.derived(looked)
    assert state[RobotPart].robot.key == example.robot
    for joint, degrees in example.degrees.items():
        assert math.degrees(state[Joints].q[joint - 1]) == pytest.approx(degrees)
    assert look.part.aim == example.aim
    assert look.inverse_condition < 0.1
    found = {each.key: each for each in look.answers}
    if key == "stretched":
        assert all(np.abs(found[k].step.qdot).max() < 1e-12 for k in found if k != "inverse")
    if key == "stretched_across":
        assert (found["pinv"].along, found["transpose"].along) == pytest.approx((1.0, 1.0))
        assert found["inverse"].step.qdot is None
    if key == "wrist":
        assert state.derived(near).why[0].kind == "wrist"
        assert look.V[3, -1] * look.V[5, -1] < -0.4
    if key == "elbow":
        assert state.derived(near).why[0].kind == "elbow"


@pytest.mark.parametrize(
    ("command", "says"),
    [
        (Set(Microscope, "aim", "up"), "unknown name 'up'"),
        (AimAlong(2), r"component \(counted from 0\): expected 0 to 1, got 2"),
        (SetComponent(5, 1.0), r"component \(counted from 0\): expected 0 to 1, got 5"),
        (SetComponent(0, math.inf), "own: expected finite numbers"),
        (SetSpeed(0.0), "speed: expected at least 1e-06 and at most 100"),
        (SetSpeed(math.nan), "speed: expected finite numbers"),
        (SetDamping("lambda", -1.0), "lambda: expected at least 0"),
        (SetDamping("epsilon", 0.0), "epsilon: expected at least 1e-06"),
        (SetDamping("colour", 1.0), "unknown name 'colour'"),
        (Set(Microscope, "method", "newton"), "unknown name 'newton'"),
        (Set(Microscope, "distance", -0.1), "distance: expected no negative number"),
        (BringNear(7), "singularity: expected 1 to 2, got 8"),
        (ChooseMicroscopeExample("nothing"), "unknown name 'nothing'"),
    ],
)
def test_nonsense_is_refused(command, says):
    with pytest.raises(InputError, match=says):
        opened("planar_2r", command)


def test_an_example_is_one_until_something_of_it_is_changed():
    state = opened("puma560", ChooseMicroscopeExample("wrist"))
    assert state[Microscope].example == "wrist"
    assert (
        apply(apply(state, Set(Microscope, "method", "pinv")), Set(Microscope, "distance", 0.1))[Microscope].example
        == "wrist"
    )
    for command in (
        MoveJoint(0, 0.3),
        SetSpeed(0.2),
        Set(Microscope, "aim", "across"),
        SetDamping("lambda", 0.1),
        BringNear(0),
    ):
        assert apply(state, command)[Microscope].example == ""


def test_a_velocity_of_nothing_is_refused():
    state = opened("planar_2r", AimAlong(0))
    with pytest.raises(InputError, match="expected another one than 0"):
        apply(state, SetComponent(0, 0.0))


def test_it_is_written_read_back_and_fitted_to_another_arm():
    state = opened("planar_2r", SetComponent(1, 0.4), SetDamping("epsilon", 0.3), Set(Microscope, "method", "pinv"))
    part, robot = state[Microscope], state[RobotPart].robot
    read = Microscope.from_json(json.loads(json.dumps(part.to_json())), robot)
    assert read.to_json() == part.to_json()
    assert apply(state, ChooseRobot("planar_2r_unequal"))[Microscope].own == part.own
    other = apply(state, ChooseRobot("puma560"))[Microscope]
    assert (other.aim, len(other.own), other.method) == ("lost", 6, "pinv")
    for damage in ({"aim": "up"}, {"own": [1.0]}, {"speed": 0.0}, {"method": "x"}, {"damping": {"lambda": -1.0}}):
        with pytest.raises((InputError, KeyError)):
            Microscope.from_json({**part.to_json(), **damage}, robot)


def test_an_arm_of_millimetres_has_a_velocity_that_can_be_read_back():
    state = opened("planar_3r", *(SetCell(i, "a", 0.001) for i in range(3)))
    part, robot = state[Microscope], state[RobotPart].robot
    assert part.sized(part.own) == pytest.approx(0.3)
    assert Microscope.from_json(json.loads(json.dumps(part.to_json())), robot).own == part.own


@pytest.mark.parametrize("key", ["planar_2r", "scara", "puma560"])
def test_the_size_on_the_page_is_that_of_the_typed_velocity(key):
    state = opened(key, SetComponent(1, 0.4))
    part = state[Microscope]
    assert part.speed == pytest.approx(np.linalg.norm(state.derived(looked).wish), rel=1e-12)
    faster = apply(state, SetSpeed(2.0 * part.speed))
    np.testing.assert_allclose(faster[Microscope].own, 2.0 * np.array(part.own), rtol=1e-12)
    assert apply(faster, Set(Microscope, "aim", "lost"))[Microscope].speed == 2.0 * part.speed


@pytest.mark.parametrize("speed", [1e-308, 1e-170, 9e-7, 101.0, 1e308])
def test_a_size_that_would_be_lost_in_rounding_is_refused(speed):
    with pytest.raises(InputError, match="speed: expected at least 1e-06 and at most 100"):
        opened("planar_2r", SetSpeed(speed))
    for aimed in (opened("planar_2r", SetSpeed(1e-6)), opened("puma560", AimAlong(1), SetSpeed(100.0))):
        for each in aimed.derived(looked).answers:
            assert np.isfinite(each.error)
        read = Microscope.from_json(json.loads(json.dumps(aimed[Microscope].to_json())), aimed[RobotPart].robot)
        assert read.own == aimed[Microscope].own


@pytest.mark.parametrize("speed", [1e-6, 0.3, 100.0])
def test_what_an_edit_of_the_table_leaves_can_be_written_and_read(speed):
    """With another reach lengths are scaled otherwise."""
    state = opened("puma560", AimAlong(1), SetSpeed(speed))
    for value in (0.01, 20.0):
        edited = apply(state, SetCell(1, "a", value))
        part = edited[Microscope]
        assert part.speed == pytest.approx(np.linalg.norm(edited.derived(looked).wish), rel=1e-9)
        assert Microscope.from_json(part.to_json(), edited[RobotPart].robot).to_json() == part.to_json()


def test_a_held_joint_that_would_have_to_move_is_named():
    state = opened("planar_2r", LockJoint(1, True))
    with pytest.raises(InputError, match="joint 2 is held"):
        apply(state, BringNear(0))
    free = opened("planar_2r", LockJoint(0, True))
    assert apply(free, BringNear(0))[Joints].q[1] != free[Joints].q[1]
