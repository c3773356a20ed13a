"""The sweep of one joint: where it goes, where it stops, and the curves over its range."""

import math

import numpy as np
import pytest

from armlab.benches.velocity.ellipsoid import state_sweep as sweep
from armlab.benches.velocity.ellipsoid.clip import CLIP
from armlab.benches.velocity.ellipsoid.state import LookAtBlock, Manipulability, VelocityBlock, blocks_of
from armlab.benches.velocity.ellipsoid.state_sweep import SECONDS, Sweep, SweepJoint, curves, put_back, singularities
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.dh import Row
from armlab.session.edits import RemoveJoint, SetCell, SetKind
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import OpenClip, Seek, Step, Timeline
from armlab.session.state import State, apply


def opened(key="puma560", joint=1):
    state = apply(State.initial(catalogue()[key]), SweepJoint(joint))
    return apply(state, OpenClip("sweep"))


def test_opening_it_moves_nothing_and_it_ends_where_it_began():
    state = opened()
    before = State.initial(catalogue()["puma560"])[Joints].q
    np.testing.assert_array_equal(state[Joints].q, before)
    end = apply(apply(state, Seek(3.0)), Seek(SECONDS))
    np.testing.assert_allclose(end[Joints].q, before, atol=1e-12)


def test_it_goes_through_the_whole_range_smoothly_and_moves_one_joint_only():
    state = opened()
    q0 = state[Joints].q
    times = np.linspace(0.0, SECONDS, 1601)
    values = []
    for time in times:
        state = apply(state, Seek(float(time)))
        np.testing.assert_array_equal(np.delete(state[Joints].q, 1), np.delete(q0, 1))
        values.append(state[Joints].q[1])
    low, high = state[Joints].arm.limits[1]
    assert min(values) == pytest.approx(low, abs=1e-4)
    assert max(values) == pytest.approx(high, abs=1e-4)
    speed = np.abs(np.diff(values)) / np.diff(times)
    assert speed.max() < 1.9 * 2.0 * (high - low) / SECONDS  # 15/8 of the mean: minimum jerk
    assert speed[0] < 0.01
    assert speed[-1] < 0.01


def test_stops_are_limits_middle_and_singularities():
    state = opened("planar_2r")
    low, high = state[Joints].arm.limits[1]
    seen = []
    for _ in CLIP.stops(state):
        state = apply(state, Step(True))
        seen.append(state[Joints].q[1])
    np.testing.assert_allclose(seen, [low, 0.0, high], atol=1e-6)
    elbow = opened("elbow_3r", 2)
    at = [apply(elbow, Seek(time))[Joints].q[2] for time in CLIP.stops(elbow)]
    middle = 0.5 * elbow[Joints].arm.limits[2].sum()
    assert any(abs(value) < 1e-6 for value in at)
    assert any(abs(value - middle) < 1e-9 for value in at)
    assert at == sorted(at)


def test_curves_are_those_of_the_notes_for_the_2r_arm():
    found = curves(opened("planar_2r"))
    np.testing.assert_allclose(found.w, np.abs(np.sin(found.values)), atol=1e-12)
    assert found.inverse_condition.max() <= 1.0
    np.testing.assert_allclose(singularities(opened("planar_2r")).places, [-math.pi, 0.0, math.pi], atol=1e-6)


def test_curves_do_not_depend_on_where_the_joint_stands_but_on_the_others():
    state = opened()
    assert curves(apply(state, Seek(2.0))) is curves(state)
    assert curves(apply(state, MoveJoint(2, 0.3))) is not curves(state)
    turned = apply(state, LookAtBlock("rotation"))
    assert curves(turned).w is not curves(state).w
    assert turned[Manipulability].block.key == "rotation"


def test_where_it_always_is_singular_no_place_is_named():
    state = apply(opened("elbow_3r", 1), MoveJoint(2, 0.0))
    found = curves(state)
    assert not found.inverse_condition.any()
    assert singularities(state).everywhere
    assert singularities(state).places == ()


def test_singularities_close_to_a_limit_are_found():
    state = opened("youbot", 2)
    low, high = state[Joints].arm.limits[2]
    places = np.array(singularities(state).places)
    np.testing.assert_allclose(np.degrees(places), [-31.2458, 145.8836], atol=1e-3)
    assert low < places[0]
    assert places[1] < high
    q = state[Joints].q.copy()
    for place in places:
        q[2] = place
        assert state[Manipulability].block.ellipsoid(q).inverse_condition < 1e-6
    assert any(apply(state, Seek(t))[Joints].q[2] == pytest.approx(places[1], abs=1e-6) for t in CLIP.stops(state))


@pytest.mark.parametrize("low", [-0.1, -0.001, -2.0])
def test_a_singularity_in_the_first_interval_is_found(low):
    limits = [[-math.pi, math.pi], [math.radians(low), math.radians(150.0)]]
    arm = Arm.from_dh([Row("R", a=0.5), Row("R", a=0.4)], limits=limits, task="xy")
    swept = (VelocityBlock(arm, "translation"), 1, np.zeros(2).tobytes())
    np.testing.assert_allclose(sweep._singularities(swept).places, [0.0], atol=1e-6)


def test_the_zeros_of_a_single_row_are_singularities():
    swept = (VelocityBlock(Arm.from_dh([Row("R", a=1.0), Row("R", a=0.4)], task="x"), "translation"), 0)
    found = sweep._singularities((*swept, np.zeros(2).tobytes()))
    np.testing.assert_allclose(found.places, [-math.pi, 0.0, math.pi], atol=1e-6)


def test_the_fitted_rows_are_those_of_the_arm(robot, rng):
    """Along one joint the Jacobian is a short sum of sines and cosines, or affine."""
    arm = robot.arm
    for key in blocks_of(arm):
        q = rng.uniform(arm.limits[:, 0], arm.limits[:, 1])
        for joint in range(arm.n):
            swept = (VelocityBlock(arm, key), joint, q.tobytes())
            values = rng.uniform(*arm.limits[joint], 7)
            np.testing.assert_allclose(sweep._fitted(swept)(values), sweep._scaled_rows(swept, values), atol=1e-9)


def test_the_value_on_the_curve_is_that_of_the_arm():
    state = apply(opened("puma560", 2), Seek(1.7))
    found = curves(state)
    w = state[Manipulability].block.ellipsoid(state[Joints].q).w
    assert np.interp(state[Joints].q[2], found.values, found.w) == pytest.approx(w, abs=1e-3)


def test_another_joint_begins_anew_from_where_it_stands():
    state = apply(apply(opened(), Seek(3.0)), SweepJoint(2))
    assert state[Timeline].time == 0.0
    q = state[Joints].q
    np.testing.assert_array_equal(apply(state, Seek(SECONDS))[Joints].q, q)


def test_closing_forgets_the_start():
    state = apply(apply(opened(), Seek(3.0)), OpenClip(""))
    assert state[Sweep].start is None
    again = apply(state, OpenClip("sweep"))
    assert again[Sweep].start == state[Joints].q[1]


def test_the_joint_goes_back_unless_a_hand_has_moved_it():
    before = State.initial(catalogue()["puma560"])[Joints].q
    state = apply(opened(), Seek(3.0))
    assert state[Joints].q[1] != before[1]
    np.testing.assert_array_equal(put_back(state)[Joints].q, before)
    by_hand = apply(state, MoveJoint(1, 0.1))
    assert put_back(by_hand) is by_hand
    other = apply(state, MoveJoint(3, 0.1))
    assert put_back(other)[Joints].q[1] == before[1]
    assert put_back(other)[Joints].q[3] == 0.1
    closed = State.initial(catalogue()["puma560"])
    assert put_back(closed) is closed


def test_another_joint_lets_the_one_before_go_back():
    before = State.initial(catalogue()["puma560"])[Joints].q
    np.testing.assert_array_equal(apply(apply(opened(), Seek(3.0)), SweepJoint(2))[Joints].q, before)


def test_an_edit_of_the_table_does_not_make_the_joint_jump():
    state = apply(opened("elbow_3r", 1), Seek(3.0))
    start, value = state[Sweep].start, state[Joints].q[1]
    edited = apply(state, SetCell(0, "d", 0.5))
    assert edited[RobotPart].robot is not state[RobotPart].robot
    assert edited[Sweep].start == start
    assert apply(edited, Seek(3.0))[Joints].q[1] == pytest.approx(value, abs=1e-12)
    gone = apply(state, RemoveJoint(0))
    assert gone[Sweep].joint == 0
    assert gone[Sweep].start == start


def test_a_joint_of_another_kind_begins_anew():
    state = apply(opened("elbow_3r", 1), Seek(3.0))
    assert apply(state, SetKind(1, "P"))[Sweep].start is None


def test_a_held_joint_is_not_swept():
    state = apply(State.initial(catalogue()["puma560"]), LockJoint(1, True))
    with pytest.raises(InputError, match="joint 2 is held"):
        apply(state, OpenClip("sweep", play=True))
    with pytest.raises(InputError, match="expected 1 to 6, got 7"):
        apply(state, SweepJoint(6))


def test_it_is_written_and_read_and_damage_is_noticed():
    robot = catalogue()["puma560"]
    part = opened()[Sweep]
    assert Sweep.from_json(part.to_json(), robot).to_json() == part.to_json() == {"joint": 1, "start": part.start}
    for damaged in ({"joint": 6, "start": None}, {"joint": 0, "start": math.inf}):
        with pytest.raises(InputError):
            Sweep.from_json(damaged, robot)


def test_closing_the_bar_in_mid_sweep_puts_the_joint_back():
    state = State.initial(catalogue()["puma560"])
    q = state[Joints].q
    swept = apply(apply(apply(state, SweepJoint(3)), OpenClip("sweep", play=True)), Seek(3.0))
    assert abs(swept[Joints].q[3] - q[3]) > 0.1
    closed = apply(swept, OpenClip(""))
    np.testing.assert_array_equal(closed[Joints].q, q)
    by_hand = apply(apply(swept, MoveJoint(3, 0.5)), OpenClip(""))
    assert by_hand[Joints].q[3] == 0.5
