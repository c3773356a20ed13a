"""Force ellipsoids beside those of velocity, the unit circle of a 2R, and curves over distance and time."""

import math

import numpy as np
import pytest

from armlab.benches.motion.plan.clip import CLIP
from armlab.benches.velocity.ellipsoid.curves import MOST, along_motion, over_distance, present_distance
from armlab.benches.velocity.ellipsoid.state import (
    LookAtBlock,
    Manipulability,
    VelocityBlock,
    blocks_of,
    placed,
    present,
)
from armlab.benches.velocity.ellipsoid.state_circle import MarkSpeeds, UnitCircle, mapped
from armlab.content.robots import catalogue
from armlab.errors import InputError, UnknownName
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.robot import ChooseRobot
from armlab.session.round_numbers import round_above, round_below
from armlab.session.state import State, apply
from support.plans import opened


def state_of(key):
    return State.initial(catalogue()[key])


def test_force_half_axes_are_the_inverses_and_never_nan(robot, rng):
    low, high = robot.arm.limits.T
    for key in blocks_of(robot.arm):
        block = VelocityBlock(robot.arm, key)
        assert block.force_unit == ("N" if key == "translation" else "N m")
        assert 0.0 < block.drawn_force < math.inf
        for q in (*rng.uniform(low, high, (5, robot.arm.n)), robot.arm.clip(np.zeros(robot.arm.n))):
            found = placed(block, q)
            assert not np.isnan(found.half_forces).any()
            for i in range(block.m):
                if i in found.lost:
                    assert found.half_forces[i] == math.inf
                else:
                    assert found.half_forces[i] * found.sigma[i] == pytest.approx(1.0, abs=1e-9)
            assert not found.half_forces[block.m :].any()


def test_the_choice_is_kept_written_and_read():
    robot = catalogue()["puma560"]
    state = apply(apply(state_of("puma560"), Set(Manipulability, "shown", "both")), LookAtBlock("rotation"))
    part = state[Manipulability]
    assert (part.shown, part.block.key, part.velocity, part.force) == ("both", "rotation", True, True)
    assert Manipulability.from_json(part.to_json(), robot) == part
    assert Manipulability.from_json("rotation", robot).shown == "velocity"
    assert apply(state, Set(Manipulability, "shown", "both")) is state
    assert apply(state, ChooseRobot("planar_2r"))[Manipulability].shown == "both"
    with pytest.raises(UnknownName, match=r"shown: unknown name 'power'\. Available: both, force, velocity"):
        apply(state, Set(Manipulability, "shown", "power"))
    with pytest.raises(UnknownName, match=r"shown: unknown name 'power'\. Available: both, force, velocity"):
        Manipulability.from_json(["rotation", "power"], robot)


def test_the_circle_of_joint_speeds_becomes_the_ellipse():
    state = apply(state_of("planar_2r"), MarkSpeeds(0.7))
    found = state.derived(mapped)
    ellipsoid = placed(state[Manipulability].block, state[Joints].q).ellipsoid
    sizes = np.linalg.norm(found.ellipse, axis=1)
    assert 0.98 * ellipsoid.sigma[0] < sizes.max() <= ellipsoid.sigma[0] + 1e-12
    assert ellipsoid.sigma[1] - 1e-12 <= sizes.min() < 1.1 * ellipsoid.sigma[1]
    np.testing.assert_allclose(found.ellipse[0], found.ellipse[-1], atol=1e-12)
    np.testing.assert_allclose(
        found.velocity, state[Joints].arm.jacobian(state[Joints].q)[:2] @ found.speeds, atol=1e-12
    )
    J = state[Joints].arm.jacobian(state[Joints].q)[:2]
    np.testing.assert_allclose(J @ found.preimages, found.axes, atol=1e-12)
    inside = np.linalg.solve(J @ J.T, found.velocity)
    assert inside @ found.velocity == pytest.approx(1.0, abs=1e-12)
    assert state_of("planar_3r").derived(mapped) is None


def test_the_mark_is_checked_written_and_read():
    robot = catalogue()["planar_2r"]
    part = apply(state_of("planar_2r"), MarkSpeeds(1.2))[UnitCircle]
    assert UnitCircle.from_json(part.to_json(), robot) == part
    assert part.for_robot(catalogue()["puma560"]) == part.for_edited(robot, (0, 1)) == part
    for bad in (math.nan, math.inf):
        with pytest.raises(InputError, match="angle: expected finite"):
            apply(state_of("planar_2r"), MarkSpeeds(bad))


def test_curves_over_the_distance_have_their_maximum_at_the_root_of_two():
    found = over_distance(catalogue()["planar_2r"].arm)
    assert found.link.best == pytest.approx(math.sqrt(2.0), abs=1e-12)
    assert found.r[np.argmax(found.w)] == pytest.approx(math.sqrt(2.0), abs=2.0 / 300)
    sigma = found.link.sigma(found.roundest)
    assert sigma[0] / sigma[1] == pytest.approx(1.618, abs=1e-3)
    assert found.roundest == pytest.approx(0.8165, abs=1e-3)
    assert over_distance(catalogue()["puma560"].arm) is None
    unequal = over_distance(catalogue()["planar_2r_unequal"].arm)
    assert unequal.link.best == pytest.approx(math.sqrt(1.25), abs=1e-12)


def test_the_present_distance_is_on_the_curve():
    state = apply(state_of("planar_2r"), MoveJoint(1, 1.1))
    found = placed(state[Manipulability].block, state[Joints].q).ellipsoid
    sigma = over_distance(state[Joints].arm).link.sigma(present_distance(state))
    np.testing.assert_allclose(sigma, found.sigma, atol=1e-12)


def test_scales_are_round():
    for value, below, above in ((1.0, 1.0, 1.0), (0.3, 0.2, 0.5), (999.9, 500.0, 1000.0), (5.0, 5.0, 5.0)):
        assert round_below(value) == pytest.approx(below)
        assert round_above(value) == pytest.approx(above)


@pytest.mark.parametrize("key", ["planar_2r", "puma560", "scara"])
def test_along_a_motion_the_ellipsoid_is_that_of_every_moment(key):
    state = opened(key, 3)
    found = along_motion(state)
    assert 2 < len(found.t) <= MOST
    assert found.t[-1] == pytest.approx(CLIP.duration(state), abs=1e-9)
    for k in (0, len(found.t) // 3, len(found.t) - 1):
        shape = CLIP.at(state, float(found.t[k])).derived(present).ellipsoid
        assert shape.w == pytest.approx(found.w[k], abs=1e-6)
        assert shape.sigma_min == pytest.approx(found.sigma_min[k], abs=1e-6)
    assert along_motion(state) is found
    turned = apply(state, LookAtBlock("rotation")) if key == "puma560" else None
    assert turned is None or along_motion(turned) is not found


def test_without_a_plan_there_is_nothing_along_it():
    assert along_motion(state_of("planar_2r")) is None
