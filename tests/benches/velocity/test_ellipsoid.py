"""Which velocities the ellipsoid is of, where it is placed, and what counts as a joint speed of 1."""

import math

import numpy as np
import pytest

from armlab.benches.velocity.ellipsoid.facts import FACTS
from armlab.benches.velocity.ellipsoid.state import (
    LookAtBlock,
    Manipulability,
    PlacedEllipsoid,
    VelocityBlock,
    blocks_of,
    placed,
    present,
)
from armlab.benches.velocity.ellipsoid.ui.words import verdict_of
from armlab.content.robots import catalogue, own_robot
from armlab.errors import UnknownName
from armlab.kin.arm import Arm
from armlab.kin.dh import Row
from armlab.kin.ellipsoid import velocity_ellipsoid
from armlab.kin.transforms import transform
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.robot import ChooseRobot
from armlab.session.state import State, apply
from support.arms import random_pose, random_q, wrist_alone


def state_of(key):
    return State.initial(catalogue()[key])


def test_half_axes_are_reached_by_joint_speeds_of_length_one_and_by_no_more(robot, rng):
    """Seen from outside: finite differences of the tool point, for random joint speeds of unit length."""
    block = VelocityBlock(robot.arm, "translation")
    if block.key not in blocks_of(robot.arm):
        return
    q = random_q(robot.arm, rng)
    found = placed(block, q)
    speeds = np.ones(robot.arm.n) if block.speeds is None else block.speeds
    np.testing.assert_allclose(found.centre, robot.arm.fk(q)[:3, 3], atol=1e-12)
    np.testing.assert_allclose(found.axes.T @ found.axes, np.eye(3), atol=1e-9)
    assert np.linalg.det(found.axes) > 0.0
    for _ in range(5):
        rate = rng.normal(size=robot.arm.n)
        rate /= np.linalg.norm(rate)
        h = 1e-6
        v = (robot.arm.position(q + h * speeds * rate) - robot.arm.position(q - h * speeds * rate)) / (2.0 * h)
        along = found.axes.T @ v
        k = len(found.ellipsoid.sigma)
        assert np.all(np.abs(along[:k]) <= found.sigma[:k] + 1e-6 * (1.0 + found.sigma[0]))
    best = speeds * found.ellipsoid.joint_directions[:, 0]
    v = (robot.arm.position(q + h * best) - robot.arm.position(q - h * best)) / (2.0 * h)
    task = block.axes(q)
    assert np.linalg.norm(task.T @ v) == pytest.approx(found.sigma[0], rel=1e-5, abs=1e-8)


def test_rotation_and_translation_are_never_mixed(robot):
    for key in blocks_of(robot.arm):
        block = VelocityBlock(robot.arm, key)
        q = robot.home
        rows = block.rows(q)
        J = robot.arm.jacobian(q)
        half = J[:3] if key == "translation" else J[3:]
        assert rows.shape == (block.m, robot.arm.n)
        assert block.unit == ("m/s" if key == "translation" else "rad/s")
        np.testing.assert_allclose(block.axes(q).T @ half, rows, atol=1e-12)


def test_planar_arms_have_a_flat_ellipse_in_their_plane():
    state = state_of("planar_2r")
    found = state.derived(present)
    assert found.sigma[2] == 0.0
    np.testing.assert_allclose(np.abs(found.axes[:, 2]), [0.0, 0.0, 1.0], atol=1e-12)
    assert found.lost == ()
    # Notes, section 5.3: w = |sin q2| for links of 1 m.
    assert found.ellipsoid.w == pytest.approx(abs(math.sin(state[Joints].q[1])), abs=1e-12)


def test_a_stretched_arm_has_lost_the_radial_direction():
    found = apply(apply(state_of("planar_2r"), MoveJoint(1, 0.0)), MoveJoint(0, 0.7)).derived(present)
    assert found.lost == (1,)
    np.testing.assert_allclose(np.abs(found.axes[:, 1]), [math.cos(0.7), math.sin(0.7), 0.0], atol=1e-9)


def test_arms_that_slide_are_measured_by_their_limits():
    arm = catalogue()["cylindrical_rpp"].arm
    block = VelocityBlock(arm, "translation")
    np.testing.assert_array_equal(block.speeds, arm.speed_limits)
    assert VelocityBlock(catalogue()["puma560"].arm, "translation").speeds is None
    assert VelocityBlock(catalogue()["cartesian_3p"].arm, "translation").speeds is None
    unknown = Arm.from_dh([Row("R", a=1.0), Row("P", alpha=0.5)])
    np.testing.assert_array_equal(VelocityBlock(unknown, "translation").speeds, [1.0, 1.0])


def test_a_block_that_is_zero_but_for_rounding_has_lost_every_direction(rng):
    for d in (0.1, 0.2, 0.4, 0.5, 0.7):
        arm = wrist_alone(random_pose(rng), d)
        block = VelocityBlock(arm, "translation")
        assert placed(block, random_q(arm, rng)).lost == (0, 1, 2)
        assert max(block.drawn, block.drawn_force) < 10.0
        assert VelocityBlock(arm, "rotation").size == 1.0


def test_one_coordinate_is_lost_where_its_row_is_zero_but_for_rounding():
    block = VelocityBlock(Arm.from_dh([Row("R", a=1.0), Row("R", a=1.0)], task="x"), "translation")
    for first in (0.0, math.pi):
        found = placed(block, np.array([first, 0.0]))
        assert (found.lost, found.ellipsoid.inverse_condition) == ((0,), 0.0)
        assert verdict_of(block, found)[:2] == ("no", "Singular")


@pytest.mark.parametrize(("rows", "lost"), [(1, 2), (2, 1)])
def test_fewer_joints_than_coordinates_leave_axes_without_speed(rows, lost):
    table = [Row("R", a=0.4, alpha=1.1, d=0.2), Row("R", a=0.3)][:rows]
    arm = Arm.from_dh(table, task="xyz")
    found = placed(VelocityBlock(arm, "translation"), np.full(rows, 0.4))
    assert len(found.lost) == lost
    assert found.ellipsoid.w > 0.0


def test_the_drawn_scale_is_a_round_number_and_fits(robot):
    for key in blocks_of(robot.arm):
        block = VelocityBlock(robot.arm, key)
        mantissa = block.drawn / 10.0 ** math.floor(math.log10(block.drawn) + 1e-9)
        assert min(abs(mantissa - step) for step in (1.0, 2.0, 5.0)) < 1e-9
        assert 0.05 < block.drawn * block.typical / (2.0 * robot.arm.length_scale) < 0.25


def test_the_choice_is_kept_where_the_arm_has_it_and_refused_where_it_has_not():
    state = apply(state_of("puma560"), LookAtBlock("rotation"))
    assert state[Manipulability].block.key == "rotation"
    assert apply(state, LookAtBlock("rotation")) is state
    assert apply(state, ChooseRobot("ur5e"))[Manipulability].block.key == "rotation"
    planar = apply(state, ChooseRobot("planar_2r"))
    assert planar[Manipulability].block.key == "translation"
    assert planar[Manipulability].block.arm is planar[Joints].arm
    with pytest.raises(UnknownName, match="rotation"):
        apply(planar, LookAtBlock("rotation"))


def test_it_is_written_and_read_and_damage_is_noticed():
    robot = catalogue()["puma560"]
    part = apply(state_of("puma560"), LookAtBlock("rotation"))[Manipulability]
    assert Manipulability.from_json(part.to_json(), robot) == part
    with pytest.raises(UnknownName):
        Manipulability.from_json("force", robot)


def test_the_direction_of_an_ellipse_is_a_fact_in_the_plane_of_x_and_y_alone():
    def told(arm, *q):
        state = State.initial(own_robot(arm, "2R"))
        return FACTS.facts["longest_direction"].now(state.replace(state[Joints].moved_to(np.array(q)))).value

    rows = [Row("R", 1.0, 0.0), Row("R", 0.5, 0.0)]
    assert told(Arm.from_dh(rows), 0.4, 0.0) == pytest.approx(0.4 - np.pi / 2)
    upright = transform(np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]))
    assert told(Arm.from_dh(rows, base=upright), 0.4, 0.0) is None
    # With these links the ellipse is a circle, which has no longest axis.
    assert told(Arm.from_dh([Row("R", np.sqrt(0.5), 0.0), Row("R", 0.5, 0.0)]), 0.4, 0.75 * np.pi) is None


@pytest.mark.parametrize(
    ("half_axes", "is_round"),
    [
        ([2, 2, 2], True),
        ([2, 2, 1], False),
        ([2, 1, 1], False),
        ([1, 1 - 1e-9], True),
        ([2, 1.9999], False),
        ([0, 0], True),
    ],
)
def test_it_is_round_where_all_half_axes_are_alike(half_axes, is_round):
    found = velocity_ellipsoid(np.diag(np.array(half_axes, dtype=float)))
    assert PlacedEllipsoid(np.zeros(3), np.eye(3), np.zeros(3), found).is_round is is_round
