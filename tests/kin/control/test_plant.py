"""What is not ideal, what can be followed, and that no number is ever none."""

import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.control import (
    CircleReference,
    FixedJoints,
    FixedPose,
    JointReference,
    LineReference,
    Push,
    Settings,
    ToolReference,
    believed,
    control_laws,
    encoder,
    plant,
    rate_inverses,
    simulate,
)
from armlab.kin.control.encoder import read_off
from armlab.kin.control.joint_reference import halfway
from armlab.kin.control.null_term import middle_slopes
from armlab.kin.control.reference import JointAims
from armlab.kin.control.run import pushed_joints
from armlab.kin.control.scaled_task import ScaledTask
from armlab.kin.convert import converted
from armlab.kin.motion import ToolPath, Trajectory, held, law_type, path_type
from armlab.kin.rotations import rotation_about
from armlab.kin.transforms import transform
from support.arms import random_q
from support.control import TWO_R, bent, notes_line, notes_run


def _between(start, rng):
    path = path_type("polyline").path([start, start + rng.uniform(-0.3, 0.3, len(start))])
    return Trajectory(path, law_type("quintic").law(duration=2.0))


# -- the plant -------------------------------------------------------------------------------------------------------


def test_held_commands_lag_and_shorter_periods_lag_less():
    errors = []
    for sampling in (0.2, 0.1, 0.05):
        q, line = notes_line(170)
        slow = plant(TWO_R, sampling=sampling)
        run = simulate(TWO_R, "cartesian_tracking", line, q, Settings(inverse="inverse", step=0.005, plant=slow))
        held_for = round(sampling / 0.005)
        assert (np.diff(run.qdot[:-1], axis=0).any(axis=1).nonzero()[0] + 1).tolist() == list(
            range(held_for, run.steps, held_for)
        )
        errors.append(run.error_position.max())
    assert errors[0] > errors[1] > errors[2] > 1e-4


def test_too_slow_sampling_makes_a_gain_unstable():
    # e+ = (1 - K T) e for a single joint: |1 - 10 * 0.25| > 1.
    goal = FixedJoints([1.0, 0.5], 5.0)
    stable, wild = (
        simulate(
            TWO_R,
            "joint_regulation",
            goal,
            [0.9, 0.4],
            Settings(law_options={"K": [10.0]}, plant=plant(TWO_R, sampling=T)),
        )
        for T in (0.05, 0.25)
    )
    assert np.abs(stable.error_joint[-1]).max() < 1e-9
    assert np.abs(wild.error_joint[-1]).max() > 10.0


def test_an_encoder_on_the_link_is_coarser_than_one_on_the_motor():
    on_link, on_motor = (encoder(1000, shaft, 50.0) for shaft in ("link", "motor"))
    turning = np.array([True, False])
    np.testing.assert_allclose(on_link.resolution(turning), [2.0 * math.pi / 1000.0, 1e-5])
    np.testing.assert_allclose(on_motor.resolution(turning), on_link.resolution(turning) / 50.0)
    q = read_off(np.array([0.123456, -2.0]), np.array([0.01, 0.5]))
    np.testing.assert_allclose(q, [0.12, -2.0])
    goal, errors = FixedJoints([1.0, 0.5], 4.0), []
    for shaft in ("link", "motor"):
        seen = plant(TWO_R, encoder=encoder(500, shaft, 100.0))
        run = simulate(TWO_R, "joint_regulation", goal, [0.8, 0.8], Settings(step=0.004, plant=seen))
        errors.append(np.abs(run.error_joint[-1]).max())
        assert errors[-1] <= 0.5 * seen.encoder.resolution(np.array([True]))[0] + 1e-3 * errors[0]
    assert errors[0] > 10.0 * errors[1]


def test_a_wrong_link_length_stays_as_an_error_that_feedback_does_not_see():
    q, line = notes_line(170)
    wrong = plant(TWO_R, wrong_by=0.02, link=2)
    known = believed(TWO_R, wrong)
    assert [row.a for row in known.rows] == pytest.approx([1.0, 1.0 / 1.02])
    run = simulate(TWO_R, "cartesian_tracking", line, q, Settings(inverse="inverse", step=0.005, plant=wrong))
    assert 0.01 < run.error_position[-1] < 0.03
    np.testing.assert_allclose(known.position(run.q[-1]), run.p_wanted[-1], atol=1e-3)
    assert believed(TWO_R, plant(TWO_R)) is TWO_R
    whole = believed(TWO_R, plant(TWO_R, wrong_by=-0.1))
    assert [row.a for row in whole.rows] == pytest.approx([1.0 / 0.9] * 2)


@pytest.mark.parametrize("key", ["planar_2r", "r4", "ur5e", "panda", "gripper"])
def test_the_same_link_is_wrong_in_both_conventions(key, rng):
    gripper = transform(rotation_about("y", 0.5 * math.pi), [0.0, 0.1, 0.2])
    arm = replace(TWO_R, tool=gripper) if key == "gripper" else catalogue()[key].arm
    other = converted(arm, "standard" if arm.convention == "modified" else "modified")
    q = random_q(arm, rng)
    moved = []
    for link in range(arm.n + 1):
        wrong = plant(arm, wrong_by=0.02, link=link)
        known = believed(arm, wrong).fk(q)
        np.testing.assert_allclose(believed(other, wrong).fk(q), known, atol=1e-12)
        moved.append(np.linalg.norm((known - arm.fk(q))[:3, 3]) > 1e-3)
    assert all(moved) or arm.n > 2


def test_what_stands_before_joint_1_is_known_to_the_controller():
    arm = Arm.from_dh([("R", 0.5, 0.0, 0.0, 0.0), ("R", 1.0, 0.0, 0.0, 0.0)], convention="modified")
    wrong = plant(arm, wrong_by=0.02)
    q = [0.3, 0.8]
    np.testing.assert_allclose(believed(arm, wrong).fk(q), believed(converted(arm, "standard"), wrong).fk(q))
    assert believed(arm, wrong).rows[0].a == 0.5


@pytest.mark.parametrize("law", ["open_loop", "cartesian_tracking"])
def test_a_push_is_made_good_with_feedback_only(law):
    q, line = notes_line(170)
    pushed = plant(TWO_R, pushes=(Push(2.0, (0.0, -0.05, 0.0)),))
    run = simulate(TWO_R, law, line, q, Settings(inverse="inverse", step=0.005, plant=pushed))
    assert run.pushed == (2.0,)
    k = run.index(2.0)
    assert run.error_position[k - 1] < 1e-6
    assert run.error_position[k] == pytest.approx(0.05, rel=0.05)
    if law == "open_loop":
        assert run.error_position[-1] > 0.02
    else:
        assert run.error_position[-1] < 1e-6


def test_limits_of_the_arm_are_those_of_its_file_unless_others_are_given():
    arm = catalogue()["planar_2r"].arm
    q, line = notes_line(178)
    run = simulate(
        arm, "open_loop", line, q, Settings(inverse="inverse", plant=plant(arm, saturation="clip"), step=0.01)
    )
    assert run.peak_speeds[0] == pytest.approx(math.pi)


# -- references ------------------------------------------------------------------------------------------------------


def test_the_velocity_of_every_reference_is_the_derivative_of_its_pose(rng):
    arm = catalogue()["puma560"].arm
    home = np.asarray(catalogue()["puma560"].home, dtype=float)
    pose = np.asarray(arm.fk(home))
    way = path_type("line").path([pose[:3, 3], pose[:3, 3] + [0.1, 0.2, 0.0]])
    references = [
        LineReference(pose, [0.1, 0.0, -0.2], 2.0),
        CircleReference(pose, pose[:3, 3] + [0.1, 0.0, 0.0], [0.0, 0.3, 1.0], 1.5, 2.0),
        FixedPose(pose, 2.0),
        FixedJoints(home, 2.0),
        JointReference(_between(home, rng)),
        ToolReference(ToolPath(way, held(pose[:3, :3])), law_type("quintic").law(duration=2.0)),
    ]
    t, h = np.array([0.3, 0.9, 1.7]), 1e-6
    for reference in references:
        assert reference.duration == 2.0
        before, now, after = (reference.tool(arm, t + shift) for shift in (-h, 0.0, h))
        rate = (after.poses[:, :3, 3] - before.poses[:, :3, 3]) / (2.0 * h)
        np.testing.assert_allclose(now.twists[:, :3], rate, atol=1e-7)
        turning = (
            (after.poses[:, :3, :3] - before.poses[:, :3, :3]) / (2.0 * h) @ np.swapaxes(now.poses[:, :3, :3], 1, 2)
        )
        np.testing.assert_allclose(now.twists[:, 3:], turning[:, [2, 0, 1], [1, 2, 0]], atol=1e-7)
    circle = references[1].tool(arm, np.linspace(0.0, 2.0, 9)).poses[:, :3, 3]
    np.testing.assert_allclose(np.linalg.norm(circle - pose[:3, 3] - [0.1, 0.0, 0.0], axis=1), 0.1, atol=1e-12)


# -- never no number -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("law", list(control_laws()))
@pytest.mark.parametrize("inverse", list(rate_inverses()))
def test_no_number_is_ever_nan_at_singular_poses(law, inverse):
    line = LineReference(TWO_R.fk([0.0, 0.0]), [-0.3, 0.1, 0.0], 1.0)
    run = simulate(TWO_R, law, line, [0.0, 0.0], Settings(inverse=inverse, step=0.01))
    for name in ("q", "qdot", "qdot_wanted", "p", "error", "sigma_min", "damping"):
        assert np.isfinite(getattr(run, name)).all(), name
    if inverse == "inverse" and control_laws()[law].inverts:
        assert run.steps == 0
        assert "J⁻¹ does not exist" in run.stopped


def test_j_inverse_stops_with_a_sentence_where_a_joint_would_have_to_be_endlessly_fast():
    q = np.array([0.0, 1e-7])
    line = LineReference(TWO_R.fk(q), [-0.5, 0.0, 0.0], 1.0)
    run = simulate(TWO_R, "open_loop", line, q, Settings(inverse="inverse"))
    assert (run.finished, run.steps) == (False, 0)
    assert run.stopped.startswith("joint 2 would have to be faster than a million rad/s")
    assert np.isfinite(run.q).all()


@pytest.mark.parametrize("law", ["open_loop", "cartesian_tracking", "newton"])
@pytest.mark.parametrize("integrator", ["euler", "rk4"])
def test_j_inverse_stops_beyond_the_workspace_and_says_why(law, integrator):
    outwards = LineReference(TWO_R.fk(bent(1)), [0.6, 0.0, 0.0], 6.0)
    run = simulate(TWO_R, law, outwards, bent(1), Settings(inverse="inverse", integrator=integrator))
    # The tool is at the end of its reach, 0.1 m away, after 1/6 s.
    assert 0.16 < run.duration < 0.6
    assert "joint 2 would have to move by more than 57° in one step of 1 ms" in run.stopped
    assert np.isfinite(run.q).all()
    assert np.abs(np.diff(run.q, axis=0)).max() <= 1.0
    # Motors with a limit can do no such thing: they tremble, and the run goes on.
    slow = plant(TWO_R, saturation="clip", speed_limits=3.0)
    settings = Settings(inverse="inverse", integrator=integrator, plant=slow)
    if law == "open_loop":
        assert simulate(TWO_R, law, outwards, bent(1), settings).peak_speeds.max() <= 3.0


def test_the_first_joint_beyond_its_limits_is_told_with_its_time():
    def turned(limits, kind="R"):
        rows = [(kind, 0.0, 0.0, 0.0, 0.0), ("R", 1.0, 0.0, 0.0, 0.0)]
        arm = Arm.from_dh(rows, limits=[limits, (-3.0, 3.0)])
        goal = FixedJoints([2.0, 0.1], 4.0)
        return simulate(arm, "joint_regulation", goal, [0.0, 0.0], Settings(law_options={"K": [1.0]}, step=0.01))

    # q1 = 2 (1 - exp(-t)) passes 1 at t = ln 2.
    for kind in ("R", "P"):
        joint, time = turned((-1.0, 1.0), kind).left_range()
        assert joint == 0
        assert time == pytest.approx(np.log(2.0), abs=0.011)
    assert turned((-2.5, 2.5)).left_range() is None
    # A whole turn further on the joint stands at the same place.
    assert turned((-2.5 - 2.0 * np.pi, 2.5 - 2.0 * np.pi)).left_range() is None
    assert turned((-2.5 - 2.0 * np.pi, 2.5 - 2.0 * np.pi), "P").left_range() == (0, 0.0)


@pytest.mark.parametrize("key", ["planar_3r", "scara", "stanford", "cartesian_3p", "ur5e", "panda", "trunk9", "youbot"])
def test_tracking_works_on_all_kinds_of_arms(key):
    robot = catalogue()[key]
    arm, home = robot.arm, np.asarray(robot.home, dtype=float)
    inside = arm.clip(home + 0.05 * np.where(arm.revolute, 1.0, 0.2 * arm.length_scale))
    goal = np.asarray(arm.fk(inside))
    run = simulate(
        arm, "cartesian_regulation", FixedPose(goal, 3.0), home, Settings(inverse="dls_variable", step=0.005)
    )
    assert run.finished
    assert run.error_position[-1] < 1e-2 * max(run.error_position[0], 1e-6)


# -- refused in words ------------------------------------------------------------------------------------------------


def test_what_cannot_be_run_is_refused_in_words():
    q, line = notes_line(170)
    for settings, law, words in (
        (Settings(step=0.0), "open_loop", "step: expected a positive number"),
        (Settings(step=1e-6), "open_loop", "at most 200000 steps"),
        (Settings(integrator="heun"), "open_loop", "integrator: unknown name"),
        (Settings(inverse="none"), "open_loop", "inverse: unknown name"),
        (Settings(), "pid", "control law: unknown name"),
        (Settings(null="dance"), "open_loop", "null-space term: unknown name"),
        (Settings(law_options={"Kp": [1.0, 2.0, 3.0]}), "cartesian_tracking", "K_p: expected one gain, or 2"),
        (Settings(law_options={"K": [1.0, 2.0, 3.0]}), "joint_tracking", "K: expected one gain, or 2"),
        (Settings(law_options={"Kp": [-1.0]}), "cartesian_tracking", "Kp: expected"),
    ):
        with pytest.raises(InputError, match=words):
            simulate(TWO_R, law, line, q, settings)
    with pytest.raises(InputError, match="q0: expected"):
        simulate(TWO_R, "open_loop", line)
    with pytest.raises(InputError, match="q0: expected 2 finite"):
        simulate(TWO_R, "open_loop", line, [0.0, np.nan])
    with pytest.raises(InputError, match="duration: expected at most"):
        LineReference(np.eye(4), [0.0, 0.0, 0.0], 1e4)
    with pytest.raises(InputError, match="circle: expected a start away"):
        CircleReference(np.eye(4), [0.0, 0.0, 0.0], [0.0, 0.0, 1.0], 1.0, 1.0)
    with pytest.raises(InputError, match="q: expected joint values, got 'abc'"):
        FixedJoints("abc", 1.0)
    for arguments, words in (
        ({"sampling": -1.0}, "sampling time"),
        ({"wrong_by": 0.9}, "at most 50 %"),
        ({"link": 3}, "link: expected 1 to 2"),
        ({"saturation": "soft"}, "saturation: unknown name"),
        ({"speed_limits": -1.0}, "speed limit of joint 1"),
        ({"pushes": (Push(-1.0, (0.0, 0.0, 0.0)),)}, "time of a push"),
    ):
        with pytest.raises(InputError, match=words):
            plant(TWO_R, **arguments)
    with pytest.raises(InputError, match="encoder on: unknown name"):
        encoder(100, "table")
    with pytest.raises(InputError, match="counts of the encoder"):
        encoder(2)


def test_a_thinned_run_has_the_ends_and_the_extremes():
    run = notes_run(178, limit=300.0)
    thin = run.thinned(200)
    assert 200 <= len(thin.t) <= 215
    assert thin.peak_speeds.tolist() == run.peak_speeds.tolist()
    assert thin.error_position.max() == run.error_position.max()
    assert thin.sigma_min.min() == run.sigma_min.min()
    assert (thin.t[0], thin.t[-1]) == (run.t[0], run.t[-1])
    np.testing.assert_allclose(thin.at(3.0), run.at(3.0), atol=5e-3)
    assert run.thinned(100_000) is run
    assert run.at(-1.0).tolist() == run.q[0].tolist()
    assert run.at(99.0).tolist() == run.q[-1].tolist()
    assert (run.index(1.2344), run.index(-5.0), run.index(50.0)) == (1234, 0, 6000)


# -- arms that slide and turn ----------------------------------------------------------------------------------------


def test_the_stroke_of_a_sliding_joint_is_no_length_a_controller_can_be_wrong_about():
    arm = Arm.from_dh([("P", 0.2, 0.0, 0.5, 0.0), ("R", 1.0, 0.0, 0.3, 0.0)])
    rows = believed(arm, plant(arm, wrong_by=0.25)).rows
    assert [(row.a, row.d) for row in rows] == [pytest.approx((0.16, 0.5)), pytest.approx((0.8, 0.24))]


@pytest.mark.parametrize("key", ["scara", "stanford"])
def test_a_push_displaces_the_tool_by_what_it_says(key):
    arm, rng = catalogue()[key].arm, np.random.default_rng(5)
    assert np.ptp(ScaledTask(arm).joint_units) > 0.0
    for q in random_q(arm, rng, 5):
        by = 1e-3 * rng.uniform(-1.0, 1.0, 3)
        moved = arm.jacobian(q)[:3] @ pushed_joints(arm, q, Push(0.0, tuple(by)))
        np.testing.assert_allclose(moved, by, atol=1e-9)


def test_the_way_to_the_middle_is_the_slope_of_its_objective():
    arm, rng = catalogue()["stanford"].arm, np.random.default_rng(6)
    task, (low, high) = ScaledTask(arm), arm.limits.T
    assert np.ptp(task.joint_units) > 0.0

    def objective(q):
        return -np.sum(((q - 0.5 * (low + high)) / (high - low)) ** 2) / (2.0 * arm.n)

    q, N = random_q(arm, rng), np.linalg.qr(rng.normal(size=(arm.n, 2)))[0]
    steps = (1e-5 * N * task.joint_units[:, None]).T
    expected = [(objective(q + step) - objective(q - step)) / 2e-5 for step in steps]
    np.testing.assert_allclose(middle_slopes(task, q, N), expected, rtol=1e-6, atol=1e-9)


def test_the_samples_halfway_lie_on_the_cubic():
    t = np.linspace(0.0, 1.0, 6)
    cubic = [np.polynomial.Polynomial(row) for row in [[2.0, -1.0, 3.0, 0.5], [0.0, 1.0, -4.0, 1.0]]]
    aims = JointAims(np.stack([p(t) for p in cubic], axis=1), np.stack([p.deriv()(t) for p in cubic], axis=1))
    found, fine = halfway(aims, 0.2), np.linspace(0.0, 1.0, 11)
    np.testing.assert_allclose(found.q, np.stack([p(fine) for p in cubic], axis=1), atol=1e-12)
    np.testing.assert_allclose(found.qdot, np.stack([p.deriv()(fine) for p in cubic], axis=1), atol=1e-12)
