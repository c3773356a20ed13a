"""Runs: the notes' experiments, and the laws of chapter 7."""

import math
import re

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.control import (
    FixedJoints,
    FixedPose,
    JointReference,
    LineReference,
    Settings,
    error_decay,
    plant,
    predicted_error,
    simulate,
    space_error_rate,
)
from armlab.kin.motion import Trajectory, law_type, path_type
from support.arms import random_q
from support.control import TWO_R, bent, notes_line, notes_run

GANTRY = Arm.from_dh(
    [("P", 0.0, -math.pi / 2, 0.0, -math.pi / 2), ("P", 0.0, math.pi / 2, 0.0, math.pi / 2), ("P", 0.0, 0.0, 0.0, 0.0)],
    limits=[[-2.0, 2.0]] * 3,
)


# -- the notes' experiments ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "degrees", "elbow"),
    [("C5.2-idk-170-elbow-", 170, -1), ("C5.2-idk-178-elbow+", 178, 1), ("C5.2-idk-178-elbow-", 178, -1)],
)
def test_c52_lines_through_the_workspace(truth, name, degrees, elbow):
    case = truth[name]["expected"]
    run = notes_run(degrees, elbow)
    assert run.finished
    np.testing.assert_allclose(run.q[0], case["q0"], atol=1e-12)
    peaks = np.degrees(run.peak_speeds)
    assert peaks[0] == pytest.approx(case["peak_qd1_deg_s"], abs=1e-2)
    assert peaks[1] == pytest.approx(case["peak_qd2_deg_s"], abs=1e-2)
    assert run.peak_times[0] == pytest.approx(case["t_peak_qd1"], abs=2e-3)
    np.testing.assert_allclose(run.p[-1][:2], case["p_end"], atol=1e-9)
    np.testing.assert_allclose(run.q[-1], case["q_end"], atol=1e-6)
    assert np.linalg.norm(run.p, axis=1).min() == pytest.approx(case["rho"], abs=1e-6)
    assert run.error_position[-1] < 1e-11


def test_c52_errors_the_notes_print_are_those_of_a_thousand_steps(truth):
    case = truth["C5.2-idk-notes-errors"]
    for degrees, name in ((170, "final_error_170"), (178, "final_error_178")):
        run = notes_run(degrees, step=0.006)
        assert run.steps == 1000
        assert run.error_position[-1] == pytest.approx(case["expected"][name], abs=case["tol"])


@pytest.mark.parametrize("elbow", [1, -1])
def test_c52_saturation_leaves_five_centimetres(truth, elbow):
    case = truth[f"C5.2-idk-saturated-elbow{'+' if elbow > 0 else '-'}"]
    run = notes_run(178, elbow, limit=300.0)
    assert run.error_position[-1] == pytest.approx(case["expected"]["final_error_m"], abs=case["tol"])
    assert np.degrees(run.peak_speeds[0]) == pytest.approx(case["expected"]["peak_qd1_deg_s"], abs=1e-9)
    assert run.saturated_time == pytest.approx(case["expected"]["saturated_time_s"], abs=1e-3)
    assert np.abs(run.qdot_wanted).max() > math.radians(350.0)
    assert (run.saturated == (np.abs(run.qdot_wanted).max(axis=1) > math.radians(300.0))).all()


def test_c52_saturation_with_euler_and_ten_milliseconds(truth):
    case = truth["C5.2-idk-saturated-euler10ms"]
    run = notes_run(178, limit=300.0, step=0.01, integrator="euler")
    assert run.error_position[-1] == pytest.approx(case["expected"]["final_error_m"], abs=case["tol"])


@pytest.mark.parametrize("degrees", [179.6, 179.5, 178.0])
def test_c521_damping_gives_up_millimetres_that_feedback_brings_back(truth, degrees):
    case = truth[f"C5.2.1-dls-{degrees}"]
    inputs, expected = case["inputs"], case["expected"]
    run = notes_run(
        degrees,
        law="cartesian_tracking",
        inverse="dls_variable",
        inverse_options={"lambda_max": inputs["lambda_max"], "epsilon": inputs["sigma_eps"]},
        law_options={"Kp": [inputs["Kp"]]},
        step=2e-3,
    )
    assert 1000.0 * run.error_position.max() == pytest.approx(expected["max_error_mm"], abs=case["tol"])
    assert 1000.0 * run.error_position[-1] == pytest.approx(expected["final_error_mm"], abs=1e-6)
    np.testing.assert_allclose(np.degrees(run.peak_speeds), expected["peak_qd_deg_s"], atol=0.2)
    assert run.damping.max() > 0.0


def test_scaling_keeps_the_direction_of_the_tool_where_clipping_bends_it():
    away = {}
    for key in ("clip", "scale"):
        q, line = notes_line(178)
        limits = plant(TWO_R, saturation=key, speed_limits=math.radians(300.0))
        run = simulate(TWO_R, "open_loop", line, q, Settings(inverse="inverse", plant=limits, step=0.004))
        along = line.velocity[:2] / 0.6
        off = (run.p[:, :2] - run.p[0, :2]) @ np.array([-along[1], along[0]])
        away[key] = np.abs(off).max()
        assert np.abs(run.qdot).max() <= math.radians(300.0) * (1.0 + 1e-12)
    assert away["scale"] < 1e-9
    assert away["clip"] > 0.005


# -- laws ------------------------------------------------------------------------------------------------------------


def test_c72_joint_errors_die_out_each_with_its_own_gain(truth):
    case = truth["C7.2-joint-error"]
    K, e0, t = (case["inputs"][name] for name in ("K", "e0", "t"))
    np.testing.assert_allclose(error_decay(K, e0, t), case["expected"]["e"], rtol=0, atol=case["tol"])
    goal = np.array([0.7, 1.1])
    run = simulate(TWO_R, "joint_regulation", FixedJoints(goal, t), goal - e0, Settings(law_options={"K": K}))
    np.testing.assert_allclose(run.error_joint[-1], case["expected"]["e"], rtol=0, atol=1e-12)
    np.testing.assert_allclose(run.error_joint, error_decay(K, e0, run.t), atol=1e-12)


def test_c13_errors_in_space_die_out_each_with_its_own_gain(truth):
    case = truth["C1.3-error-decay"]
    kx, ky, e0, t = (case["inputs"][name] for name in ("kx", "ky", "e0", "t"))
    np.testing.assert_allclose(error_decay([kx, ky], e0, t), case["expected"]["e"], rtol=0, atol=case["tol"])
    q, line = bent(1) + 0.4, None
    start = np.array(TWO_R.fk(q))
    start[:2, 3] += e0
    line = LineReference(start, [-0.3, 0.2, 0.0], t)
    run = simulate(TWO_R, "cartesian_tracking", line, q, Settings(law_options={"Kp": [kx, ky]}))
    np.testing.assert_allclose(run.error[-1], case["expected"]["e"], rtol=0, atol=1e-9)


def test_c72_rate_of_the_error_in_space_under_joint_tracking(truth):
    case = truth["C7.2-ep-dot"]
    inputs = case["inputs"]
    arguments = inputs["q"], inputs["q_d"], inputs["qd_dot"], inputs["K"]
    rate = space_error_rate(TWO_R, *arguments)
    np.testing.assert_allclose(rate[:2], case["expected"]["ep_dot"], rtol=0, atol=case["tol"])
    assert np.abs(rate[:2] - case["printed_value_if_wrong"]["ep_dot_7_23"]).max() > 0.01


def test_the_rate_of_the_error_in_space_is_that_of_the_runs(rng):
    arm = catalogue()["puma560"].arm
    start = np.asarray(random_q(arm, rng), dtype=float)
    motion = _between(start, rng)
    K = [2.0, 4.0, 3.0, 5.0, 1.0, 6.0]
    run = simulate(arm, "joint_tracking", JointReference(motion), start + 0.05, Settings(law_options={"K": K}))
    k = 700
    difference = (run.p_wanted - run.p)[[k - 1, k + 1]]
    rate = (difference[1] - difference[0]) / (2.0 * run.step)
    q_d, qdot_d = motion.derivatives(run.t[k], (0, 1))
    np.testing.assert_allclose(rate, space_error_rate(arm, run.q[k], q_d, qdot_d, K), atol=1e-6)


def _between(start, rng):
    path = path_type("polyline").path([start, start + rng.uniform(-0.3, 0.3, len(start))])
    return Trajectory(path, law_type("quintic").law(duration=2.0))


def test_the_prediction_of_7_24_is_close_while_the_error_is_small_and_exact_for_one_gain():
    goal = np.array([0.4, 1.2])
    e0 = np.array([0.02, -0.015])
    for gains, most in (([3.0, 3.0], 3e-3), ([2.0, 5.0], 6e-3)):
        run = simulate(TWO_R, "joint_regulation", FixedJoints(goal, 2.0), goal - e0, Settings(law_options={"K": gains}))
        found = predicted_error(TWO_R, run.t, run.q, np.array(gains), run.error[0])
        assert np.abs(found - run.error).max() < most * np.abs(run.error).max() * 10.0
        assert np.abs(run.error[0]).max() > 0.01
    one = predicted_error(GANTRY, np.linspace(0, 1, 11), np.zeros((11, 3)), np.full(3, 2.0), np.array([0.1, 0.2, -0.3]))
    np.testing.assert_allclose(one, error_decay([2.0] * 3, [0.1, 0.2, -0.3], np.linspace(0, 1, 11)), rtol=1e-6)
    stiff = predicted_error(GANTRY, np.linspace(0, 1, 3), np.zeros((3, 3)), np.full(3, 1e3), np.ones(3))
    assert np.abs(stiff[1:]).max() < 1e-100


@pytest.mark.parametrize(
    ("changed", "text"),
    [
        ({"t": [], "q": np.zeros((0, 3))}, "t: expected numbers of shape (1,), got shape (0,)"),
        ({"q": np.zeros((2, 2))}, "q: expected numbers of shape (2, 3), got shape (2, 2)"),
        ({"K": 2.0}, "K: expected numbers of shape (3,), got shape ()"),
        ({"e0": "none"}, "e0: expected numbers of shape (3,), got 'none'"),
    ],
)
def test_a_prediction_says_what_it_needs(changed, text):
    given = {"t": [0.0, 1.0], "q": np.zeros((2, 3)), "K": np.ones(3), "e0": np.ones(3)}
    with pytest.raises(InputError, match=re.escape(text)):
        predicted_error(GANTRY, **given | changed)


def test_at_a_singularity_the_error_along_the_lost_direction_stays():
    # ERR-7.27: J J# is not the identity for the stretched arm; e = (-1, 0.1) has a part along it.
    goal = np.array(TWO_R.fk([0.0, 0.0]))
    goal[:2, 3] += [-1.0, 0.0]
    run = simulate(
        TWO_R, "cartesian_regulation", FixedPose(goal, 3.0), [0.0, 0.0], Settings(law_options={"Kp": [1.0]}, step=0.01)
    )
    assert run.finished
    assert run.error_position[-1] == pytest.approx(1.0, abs=1e-9)
    beside = simulate(
        TWO_R,
        "cartesian_regulation",
        FixedPose(goal, 12.0),
        [0.0, 0.1],
        Settings(inverse="dls_variable", law_options={"Kp": [1.0]}, step=0.01),
    )
    assert beside.error_position[-1] < 1e-3


def test_regulation_reaches_a_pose_of_a_six_axis_arm_from_afar(rng):
    arm = catalogue()["puma560"].arm
    home = np.asarray(catalogue()["puma560"].home, dtype=float)
    goal = arm.fk(home + np.array([0.4, -0.3, 0.3, 0.5, -0.6, 0.4]))
    run = simulate(arm, "cartesian_regulation", FixedPose(goal, 4.0), home, Settings(inverse="dls_variable", step=2e-3))
    assert run.finished
    assert run.error_position[-1] < 1e-6
    assert run.error_rotation[-1] < 1e-6
    assert run.error_rotation[0] > 0.3


def test_newton_does_not_drift_where_euler_along_the_velocity_does():
    q, line = notes_line(170)
    open_loop = simulate(TWO_R, "open_loop", line, q, Settings(inverse="inverse", step=0.01, integrator="euler"))
    newton = simulate(TWO_R, "newton", line, q, Settings(inverse="inverse", step=0.01))
    assert open_loop.error_position[-1] > 1e-3
    assert newton.error_position.max() < 1e-11


@pytest.mark.parametrize("sampling", [0.25, 0.3, 0.4, 0.6])
def test_newton_is_at_the_end_in_time_also_where_the_last_period_is_shorter(sampling):
    q = [0.3, 1.0]
    line = LineReference(TWO_R.fk(q), [-0.2, 0.0, 0.0], 1.0)
    run = simulate(TWO_R, "newton", line, q, Settings(inverse="inverse", plant=plant(TWO_R, sampling=sampling)))
    assert run.error_position[-1] < 1e-6


def test_joint_tracking_of_a_line_finds_its_joint_values(rng):
    arm = catalogue()["puma560"].arm
    home = np.asarray(catalogue()["puma560"].home, dtype=float)
    line = LineReference(arm.fk(home), [0.0, 0.06, -0.04], 2.0)
    run = simulate(arm, "joint_tracking", line, home, Settings(step=0.005))
    assert run.finished
    assert run.error_position.max() < 1e-7
    assert run.error_rotation.max() < 1e-7
    offset = simulate(arm, "joint_tracking", line, home + 0.02, Settings(step=0.005, law_options={"K": [4.0]}))
    np.testing.assert_allclose(offset.error_joint[-1], offset.error_joint[0] * math.exp(-8.0), atol=1e-6)


def test_joint_tracking_stops_where_the_reference_leaves_the_workspace():
    line = LineReference(TWO_R.fk(bent(1)), [0.1, 0.0, 0.0], 4.0)
    run = simulate(TWO_R, "joint_tracking", line, bent(1), Settings(step=0.01))
    assert not run.finished
    assert "no joint values were found" in run.stopped
    assert 0.9 < run.duration <= 1.0
    far = LineReference(TWO_R.fk(bent(1)) + np.pad([[5.0]], ((0, 3), (3, 0))), [0.0, 0.0, 0.0], 1.0)
    none = simulate(TWO_R, "joint_tracking", far, bent(1))
    assert (none.steps, none.finished) == (0, False)
    assert none.at(0.3).tolist() == bent(1).tolist()


def test_redundant_arms_move_by_themselves_and_the_tool_does_not_care():
    arm, home = catalogue()["iiwa7"].arm, np.asarray(catalogue()["iiwa7"].home, dtype=float)
    line = LineReference(arm.fk(home), [0.03, 0.02, -0.03], 2.0)
    runs = {
        key: simulate(arm, "cartesian_tracking", line, home, Settings(step=0.01, null=key, null_gain=2.0))
        for key in ("none", "middle", "manipulability")
    }
    for run in runs.values():
        assert run.error_position.max() < 1e-7
    middle, ranges = arm.limits.mean(axis=1), np.ptp(arm.limits, axis=1)

    def away(run):
        return np.sum(((run.q[-1] - middle) / ranges) ** 2)

    def w(run):
        return float(arm.manipulability(run.q[-1]))

    assert away(runs["middle"]) < away(runs["none"])
    assert w(runs["manipulability"]) > w(runs["none"])
