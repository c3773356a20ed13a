"""Live values: what the text of a lesson shows of the arm."""

import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.motion.plan.seen_motion import SeenMotion
from armlab.content.check import Words
from armlab.content.live import all_live_values, live_values, task_jacobian
from armlab.content.live_value import NONE
from armlab.content.observation import Observation
from armlab.content.robots import catalogue
from armlab.kin.arm import MAX_JOINTS, Arm

ROBOTS = catalogue().robots
NOT_WHOLE = SeenMotion(), SeenMotion(planned=True, duration=0.7, fastest=0.7)


def seen(robot, q):
    motion = SeenMotion(planned=True, whole=True, within=True, duration=1.324, fastest=1.2)
    return Observation.of(ROBOTS[robot].arm, q, benches={"motion": motion})


def shown(robot, q, name):
    return live_values(ROBOTS[robot].arm)[name](seen(robot, q))


def test_a_planar_2r_by_hand():
    q = np.radians([30, 90])
    # p = (c30 + c120, s30 + s120) = (0.866 - 0.5, 0.5 + 0.866), phi = 120 degrees, det J = l1 l2 s2 = 1.
    assert shown("planar_2r", q, "q1") == "30.0°"
    assert shown("planar_2r", q, "px") == "0.366 m"
    assert shown("planar_2r", q, "py") == "1.366 m"
    assert shown("planar_2r", q, "pz") == "0.000 m"
    assert shown("planar_2r", q, "phi") == "120.0°"
    assert shown("planar_2r", q, "yaw") == "120.0°"
    assert shown("planar_2r", q, "r") == "1.414 m"
    assert shown("planar_2r", q, "det J") == "1.0000 m²"
    assert shown("planar_2r", q, "w") == "1.0000 m²"
    assert shown("planar_2r", q, "rank") == "2"
    # J = [[-s1 - s12, -s12], [c1 + c12, c12]]: sigma^2 are the eigenvalues of [[2, 1], [1, 1]] here.
    smallest = math.sqrt((3 - math.sqrt(5)) / 2)
    assert shown("planar_2r", q, "sigma_min") == f"{smallest:.4f} m"
    assert shown("planar_2r", q, "condition") == f"{1 / smallest**2:.2f}"


def test_the_times_of_the_planned_motion():
    assert (shown("planar_2r", [0, 0], "duration"), shown("planar_2r", [0, 0], "fastest")) == ("1.32 s", "1.20 s")
    values = live_values(ROBOTS["planar_2r"].arm)
    for benches in ({}, *({"motion": motion} for motion in NOT_WHOLE)):
        no_whole_motion = replace(seen("planar_2r", [0, 0]), benches=benches)
        assert values["duration"](no_whole_motion) == values["fastest"](no_whole_motion) == NONE


def test_singular_places():
    q = [0.3, 0.0]
    assert shown("planar_2r", q, "rank") == "1"
    assert shown("planar_2r", q, "condition") == "∞"
    assert shown("planar_2r", q, "det J") == "0.0000 m²"
    assert shown("planar_2r", [0.3, -1.0], "det J") == "−0.8415 m²"


@pytest.mark.parametrize("key", list(ROBOTS))
def test_every_live_value_of_every_robot_has_a_text(key, rng):
    arm = ROBOTS[key].arm
    values = live_values(arm)
    assert {f"q{i + 1}" for i in range(arm.n)} | {"px", "py", "pz", "r", "w", "rank", "roll"} <= set(values)
    assert f"q{arm.n + 1}" not in values
    for q in (ROBOTS[key].home, rng.uniform(arm.limits[:, 0], arm.limits[:, 1])):
        for name, value in values.items():
            text = value(seen(key, q))
            assert text, name
            assert text != NONE
            assert "-" not in text


@pytest.mark.parametrize("key", list(ROBOTS))
def test_the_task_jacobian_has_the_manipulability_of_the_arm(key, rng):
    arm = ROBOTS[key].arm
    q = rng.uniform(arm.limits[:, 0], arm.limits[:, 1])
    sigma = np.linalg.svd(task_jacobian(seen(key, q)), compute_uv=False)
    assert math.isclose(float(np.prod(sigma)), float(arm.manipulability(q)), rel_tol=1e-9, abs_tol=1e-12)
    assert sigma.shape == (min(arm.n, arm.task.m),)


def test_what_an_arm_does_not_have():
    puma = live_values(ROBOTS["puma560"].arm)
    assert "phi" not in puma
    assert "sigma_min" not in puma
    assert "det J" in puma
    assert "det J" not in live_values(ROBOTS["iiwa7"].arm)
    assert "phi" in live_values(ROBOTS["scara"].arm)
    assert "sigma_min" in live_values(ROBOTS["cartesian_3p"].arm)
    reason = all_live_values(MAX_JOINTS)["det J"].missing(ROBOTS["iiwa7"].arm)
    assert reason == "its task has 6 components and it has 7 joints: the Jacobian is not square"


def test_a_value_the_arm_on_the_table_does_not_have_is_a_dash():
    last = all_live_values(MAX_JOINTS)["q6"]
    assert last(seen("planar_2r", [0, 0])) == NONE
    assert all_live_values(MAX_JOINTS)["det J"](seen("iiwa7", ROBOTS["iiwa7"].home)) == NONE


def test_the_units_of_the_student_are_used():
    words = Words(length=lambda value: f"{1000 * value:.0f} mm", angle=lambda value: f"{value:.2f} rad")
    values = live_values(ROBOTS["polar_rrp"].arm)
    q = [0.5, 0.25, 0.4]
    assert values["q1"](seen("polar_rrp", q), words) == "0.50 rad"
    assert values["q3"](seen("polar_rrp", q), words) == "400 mm"


def test_the_task_is_that_of_the_base_however_it_stands():
    rows = [("R", 1.0, 0.0, 0.0, 0.0), ("R", 0.5, 0.0, 0.0, 0.0)]
    base = np.eye(4)
    base[:3, :3] = [[0, 0, 1], [1, 0, 0], [0, 1, 0]]
    flat, upright = (Arm.from_dh(rows, base=each, task="xy") for each in (None, base))
    seen_flat, seen_upright = (Observation.of(arm, [0.4, 1.1]) for arm in (flat, upright))
    np.testing.assert_allclose(task_jacobian(seen_upright), task_jacobian(seen_flat), rtol=0, atol=1e-12)
    assert "phi" in live_values(flat)
    assert "phi" not in live_values(upright)
