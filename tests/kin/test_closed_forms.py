"""Closed forms: the cases of the notes, random poses of every robot and of arms nobody has built, borders."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.convert import converted
from armlab.kin.dh import Row
from armlab.kin.ik.answer import verified_rows
from armlab.kin.ik.closed_form import closed_form_of, closed_forms
from armlab.kin.ik.general_6r import solve_general
from armlab.kin.ik.many_starts import many_starts
from armlab.kin.ik.screws import screws_of
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.transforms import inverse
from support.arms import random_pose, random_q, tool_by_products
from support.solutions import contains, no_duplicates, same_set, worst_error

H = math.pi / 2
EXACT = 2e-9

WITH_ONE = {
    "planar_2r": "planar_2r",
    "planar_2r_unequal": "planar_2r",
    "planar_3r": "planar",
    "planar_3r_unequal": "planar",
    "elbow_3r": "elbow",
    "polar_rrp": "polar",
    "cartesian_3p": "cartesian",
    "cylindrical_rpp": "cylindrical",
    "scara": "scara",
    "puma560": "spherical_wrist",
    "stanford": "spherical_wrist",
    "unimate": "spherical_wrist",
    "irb120": "spherical_wrist",
    "irb140": "spherical_wrist",
    "kr6r900": "spherical_wrist",
    "tx60": "spherical_wrist",
    "ur10": "three_parallel",
    "ur10_notes": "three_parallel",
    "ur10e": "three_parallel",
    "ur3e": "three_parallel",
    "ur5e": "three_parallel",
}


def arm_of(rows, **more):
    return Arm.from_dh([tuple(row) for row in rows], **more)


def planar(l1=1.0, l2=1.0, **more):
    return Arm.from_dh([("R", l1, 0.0, 0.0, 0.0), ("R", l2, 0.0, 0.0, 0.0)], **more)


def pose_at(x, y, z=0.0):
    T = np.eye(4)
    T[:3, 3] = x, y, z
    return T


@pytest.mark.parametrize("name", list(WITH_ONE))
def test_every_robot_that_has_a_closed_form_uses_it(name):
    form, why = closed_form_of(catalogue()[name].arm)
    assert form.key == WITH_ONE[name]
    assert why


def test_no_other_robot_claims_one():
    assert {name for name in catalogue().robots if closed_form_of(catalogue()[name].arm)} == set(WITH_ONE)


def test_closed_forms_have_titles_and_their_own_places():
    forms = list(closed_forms().values())
    assert len({form.order for form in forms}) == len(forms)
    assert all(form.title for form in forms)


@pytest.mark.parametrize("name", list(WITH_ONE))
def test_random_poses_of_the_robots(name, rng):
    arm = catalogue()[name].arm
    for _ in range(3):
        q = random_q(arm, rng)
        T = np.asarray(arm.fk(q))
        found = solve_all(arm, T)
        assert found.completeness == "complete"
        assert found.method == WITH_ONE[name]
        assert contains(arm, found.q, q)
        assert worst_error(arm, found.q, T) < EXACT
        assert no_duplicates(arm, found.q)
        assert len(set(found.names)) == len(found.names)


@pytest.mark.parametrize("name", ["puma560", "irb140", "kr6r900", "ur10", "ur3e", "tx60"])
def test_closed_form_and_general_solver_agree(name, rng):
    arm = catalogue()[name].arm
    for _ in range(4):
        T = np.asarray(arm.fk(random_q(arm, rng)))
        assert same_set(arm, solve_all(arm, T).q, solve_general(arm, T).q)


@pytest.mark.parametrize("name", ["stanford", "unimate", "elbow_3r", "polar_rrp", "scara"])
def test_closed_form_and_many_starts_agree(name, rng):
    arm = catalogue()[name].arm
    for _ in range(3):
        T = np.asarray(arm.fk(random_q(arm, rng)))
        found = solve_all(arm, T)
        searched = verified_rows(arm, T, list(many_starts(arm, inverse(arm.base) @ T)))
        assert same_set(arm, found.q, np.array(searched))


@pytest.mark.parametrize("name", ["C1.7-PUMA-ik", "C1.7-Unimate-ik", "C4.3-UR10-notes", "C4.3-UR10-manufacturer"])
def test_cases_of_six_joints(truth, name):
    case = truth[name]
    arm = arm_of(case["inputs"]["dh"])
    T = np.eye(4)
    if "T" in case["inputs"]:
        T = np.array(case["inputs"]["T"])
    else:
        T[:3, :3], T[:3, 3] = case["inputs"]["R"], case["inputs"]["p"]
    found = solve_all(arm, T)
    assert len(found) == case["expected"]["n"] == 8
    assert same_set(arm, found.q, np.array(case["expected"]["q"]), 1e-7)
    assert found.completeness == "complete"
    assert worst_error(arm, found.q, T) < EXACT
    if "n_q3_positive" in case["expected"]:
        assert int((found.q[:, 2] > 0.0).sum()) == case["expected"]["n_q3_positive"]


def test_case_of_the_scara(truth):
    case = truth["C1.7-SCARA-ik"]
    arm = arm_of(case["inputs"]["dh"])
    found = solve_all(arm, case["inputs"]["T"])
    assert same_set(arm, found.q, np.array(case["expected"]["q"]), 1e-9)
    assert found.method == "scara"


def test_planar_2r_on_both_circles_and_outside(truth):
    case = truth["C4.3.3-2R-ik-boundary"]
    arm = planar(case["inputs"]["l1"], case["inputs"]["l2"])
    for which in ("outer", "inner"):
        found = solve_all(arm, pose_at(*case["inputs"][f"p_{which}"]))
        assert same_set(arm, found.q, np.array([case["expected"][f"q_{which}"]]), case["tol"])
        assert found.completeness == "complete"
    out = truth["C4.3.3-2R-ik-out"]
    found = solve_all(arm, pose_at(*out["inputs"]["p"]))
    assert len(found) == out["expected"]["n_solutions"] == 0
    assert found.completeness == "none"
    assert f"{out['expected']['cos_q2']:.3f}" in found.sentence


def test_just_inside_the_border_there_are_two_just_outside_none():
    """Up to what counts as reached, which is said; a little farther it is said how far."""
    arm = planar()
    assert len(solve_all(arm, pose_at(2.0 - 1e-9, 0.0))) == 2
    nearly = solve_all(arm, pose_at(2.0 + 1e-7, 0.0))
    assert np.allclose(nearly.q, [[0.0, 0.0]], atol=1e-9)
    assert "100 nm of the target, which counts as reached" in nearly.sentence
    beyond = solve_all(arm, pose_at(2.0 + 2e-6, 0.0))
    assert beyond.completeness == "none"
    assert "It is 2 µm out of reach." in beyond.sentence


def test_the_four_of_the_elbow_and_of_the_polar_arm(rng):
    elbow = Arm.from_dh([("R", 0.0, H, 0.6, 0.0), ("R", 0.8, 0.0, 0.0, 0.0), ("R", 0.5, 0.0, 0.0, 0.0)])
    q = np.array([0.7, 0.4, -0.9])
    found = solve_all(elbow, elbow.fk(q))
    assert len(found) == 4
    assert contains(elbow, found.q, q)
    polar = Arm.from_dh([("R", 0.0, H, 0.5, 0.0), ("R", 0.0, H, 0.0, H), ("P", 0.0, 0.0, 0.0, 0.0)])
    found = solve_all(polar, pose_at(0.4, -0.3, 0.9))
    assert len(found) == 4
    assert int((found.q[:, 2] > 0.0).sum()) == 2
    assert int(found.within_limits.sum()) == 2


def moved(arm, rng):
    """Return the same geometry with other zeros, base and tool."""
    rows = [
        Row(row.kind, row.a, row.alpha, row.d, row.theta + rng.uniform(-3, 3) * (row.kind == "R")) for row in arm.rows
    ]
    tool = random_pose(rng) @ arm.tool if arm.task.key in ("pose", "xyz") else arm.tool
    return Arm.from_dh(rows, arm.convention, base=random_pose(rng) @ arm.base, tool=tool, task=arm.task)


@pytest.mark.parametrize("name", list(WITH_ONE))
def test_other_zeros_base_tool_and_convention(name, rng):
    for _ in range(1):
        arm = moved(catalogue()[name].arm, rng)
        for one in (arm, converted(arm, "modified")):
            if closed_form_of(one) is None:
                # A long tool makes another structure; only the place of three joints has one for every tool.
                assert one.n == 3
                continue
            q = random_q(one, rng)
            T = tool_by_products(one, q)
            found = solve_all(one, T)
            assert contains(one, found.q, q)
            assert worst_error(one, found.q, T) < EXACT
            assert len(set(found.names)) == len(found.names)


@pytest.mark.parametrize("kinds", ["RRR", "RRP", "RPR", "PRR", "RPP", "PRP", "PPR"])
def test_any_three_joints_place_the_tool(kinds, rng):
    """Random axes, and special ones: right angles and lengths of zero."""
    solved = 0
    for k in range(12):
        special = k % 2 == 1
        rows = []
        for kind in kinds:
            alpha = rng.choice([0.0, H, -H, math.pi]) if special else rng.uniform(-3, 3)
            a, d = rng.uniform(0.1, 0.8, 2) * (rng.random(2) > (0.4 if special else 0.0))
            rows.append((kind, float(a), float(alpha), float(d), float(rng.uniform(-3, 3))))
        arm = Arm.from_dh(rows, ("standard", "modified")[k % 4 // 2], tool=random_pose(rng), task="xyz")
        if closed_form_of(arm) is None:
            continue
        q = random_q(arm, rng)
        T = np.asarray(arm.fk(q))
        found = solve_all(arm, T)
        assert contains(arm, found.q, q), (k, rows)
        assert worst_error(arm, found.q, T) < EXACT
        assert no_duplicates(arm, found.q)
        solved += 1
    assert solved >= 6


@pytest.mark.parametrize("kinds", ["RRR", "RRP", "PRR", "RPR"])
def test_any_arm_with_a_wrist_of_any_angles(kinds, rng):
    for k in range(4):
        right = k % 2 == 0
        rows = [
            (kind, float(rng.uniform(0.1, 0.5)), float(rng.uniform(-2, 2)), float(rng.uniform(-0.3, 0.3)), 0.3)
            for kind in kinds
        ]
        a4, a5 = (H, -H) if right else rng.uniform(0.6, 2.4, 2)
        rows += [("R", 0.0, float(a4), 0.4, 0.2), ("R", 0.0, float(a5), 0.0, -0.5), ("R", 0.0, 0.3, 0.1, 1.0)]
        rows[2] = (*rows[2][:1], 0.0, *rows[2][2:])
        arm = Arm.from_dh(rows, tool=random_pose(rng), base=random_pose(rng))
        form = closed_form_of(arm)
        assert form is not None
        assert form[0].key == "spherical_wrist"
        q = random_q(arm, rng)
        T = np.asarray(arm.fk(q))
        found = solve_all(arm, T)
        assert contains(arm, found.q, q)
        assert worst_error(arm, found.q, T) < EXACT
        if kinds == "RRR":
            assert same_set(arm, found.q, solve_general(arm, T).q)


def test_the_first_three_axes_may_be_the_wrist(rng):
    for _ in range(5):
        rows = [("R", 0.0, H, 0.3, 0.1), ("R", 0.0, -H, 0.0, 0.2)]
        rows += [("R", *map(float, rng.uniform(0.2, 0.6, 3)), 0.4) for _ in range(3)] + [("R", 0.2, 0.0, 0.1, 0.0)]
        arm = Arm.from_dh(rows, tool=random_pose(rng))
        assert closed_form_of(arm)[0].key == "three_meeting"
        q = random_q(arm, rng)
        found = solve_all(arm, arm.fk(q))
        assert contains(arm, found.q, q)
        assert same_set(arm, found.q, solve_general(arm, arm.fk(q)).q)


@pytest.mark.parametrize("first", [2, 3])
def test_three_parallel_axes_of_any_arm(first, rng):
    for _ in range(10):
        links = [(0.0, float(rng.uniform(0.5, 2.5))) for _ in range(5)]
        links[first - 1], links[first] = (0.5, 0.0), (-0.4, math.pi)
        if first == 2:
            links[0] = (0.2, links[0][1])
        else:
            links[4] = (0.2, links[4][1])
        rows = [("R", a, alpha, float(rng.uniform(-0.3, 0.3)), 0.3) for a, alpha in [*links, (0.1, 0.4)]]
        arm = Arm.from_dh(rows, tool=random_pose(rng))
        form = closed_form_of(arm)
        assert form is not None
        assert form[0].key == "three_parallel"
        q = random_q(arm, rng)
        found = solve_all(arm, arm.fk(q))
        assert contains(arm, found.q, q)
        assert same_set(arm, found.q, solve_general(arm, arm.fk(q)).q)


@pytest.mark.parametrize("kinds", ["RRR", "RRP", "RPR", "PRR", "RPP", "PRP", "PPR"])
def test_planar_arms_of_every_sequence(kinds, rng):
    """Slides in the plane between turns, by quarter twists."""
    for _ in range(10):
        rows = [["R" if kind == "R" else "P", 0.0, 0.0, 0.0, 0.0] for kind in kinds]
        # Every axis is turned into the direction it must have: z for turns, across it for slides.
        upright = [kind == "R" for kind in kinds]
        base = np.eye(4)
        if not upright[0]:
            base[:3, :3] = [[0, 0, 1], [1, 0, 0], [0, 1, 0]]
        for i, row in enumerate(rows):
            after = upright[i + 1] if i + 1 < len(rows) else upright[i]
            row[1] = float(rng.uniform(0.2, 0.8)) if upright[i] and after else 0.0
            row[2] = 0.0 if upright[i] == after else (H if after else -H)
            row[4] = float(rng.uniform(-3, 3)) if upright[i] else 0.0
            if upright[i] is False and after is False and i + 1 < len(rows):
                row[2], row[4] = H, H
        arm = Arm.from_dh([tuple(row) for row in rows], base=base, tool=random_pose(rng), task="pose")
        s = screws_of(arm)
        up = np.abs((arm.base[:3, :3] @ s.z.T)[2])
        flat = all(abs(z - (kind == "R")) < 1e-9 for z, kind in zip(up, kinds, strict=True))
        if not flat or abs(abs(arm.base[2, 2]) - 1.0) > 1e-9:
            continue
        arm = Arm.from_dh(arm.rows, base=base, tool=arm.tool, task="xy phi")
        assert closed_form_of(arm)[0].key == "planar"
        q = random_q(arm, rng)
        found = solve_all(arm, arm.fk(q))
        assert contains(arm, found.q, q), kinds
        assert worst_error(arm, found.q, np.asarray(arm.fk(q))) < EXACT


TURNING = {
    "planar RP": [("R", 0.2, -H, 0.0, 0.0), ("P", 0.0, H, 0.0, 0.0)],
    "cylindrical RPP": [("R", 0.15, 0.0, 0.4, 0.0), ("P", 0.0, -H, 0.0, 0.0), ("P", 0.0, 0.0, 0.0, 0.0)],
    "polar RRP": [("R", 0.0, -H, 0.4, 0.0), ("R", 0.0, H, 0.15, 0.0), ("P", 0.0, 0.0, 0.0, 0.0)],
    "RRP, tool beside the slide": [("R", 0.0, -H, 0.4, 0.0), ("R", 0.0, H, 0.0, 0.0), ("P", 0.1, 0.0, 0.0, 0.0)],
    "Stanford": [
        ("R", 0.0, -H, 0.412, 0.0),
        ("R", 0.0, H, 0.154, 0.0),
        ("P", 0.0, 0.0, 0.0, 0.0),
        ("R", 0.0, -H, 0.0, 0.0),
        ("R", 0.0, H, 0.0, 0.0),
        ("R", 0.0, 0.0, 0.26, 0.0),
    ],
}


@pytest.mark.parametrize("name", list(TURNING))
def test_a_slide_at_its_turning_point_has_one_solution_not_none(name, rng):
    """Where the last slide is at zero its two values merge, and only rounding is left of the constant term."""
    arm = arm_of(TURNING[name])
    for _ in range(20):
        q = random_q(arm, rng)
        q[2 if arm.n > 2 else 1] = 0.0
        assert solve_all(arm, arm.fk(q)).completeness in ("complete", "infinite")


ROUNDED = {
    "RRP, axes 1 and 2 antiparallel": [("R", 0.4, math.pi, 0.3, 0.0), ("R", 0.3, 0.0, 0.0, 0.0), ("P", 0, 0, 0, 0)],
    "RRP, axes 2 and 3 antiparallel": [("R", 0.4, 0.0, 0.3, 0.0), ("R", 0.3, math.pi, 0.0, 0.0), ("P", 0, 0, 0, 0)],
    "PRR": [("P", 0.65, -H, 0.0, 0.0), ("R", 0.0, -H, 0.43, H), ("R", 0.67, H, 0.0, 0.0)],
    "RPP": [("R", 0.0, 0.0, 0.3, 0.0), ("P", 0.0, -H, 0.0, -H), ("P", 0.0, 0.0, 0.0, 0.0)],
    "RPR, all but planar": [("R", 0.0, -H, 0.3, 0.0), ("P", 0.0, H, 0.0, 0.0), ("R", 0.4, 0.0, 0.0, 0.0)],
    "RRR": [("R", 0.0, H, 0.3, 0.0), ("R", 0.5, math.pi, 0.0, 0.0), ("R", 0.4, 0.0, 0.1, 0.0)],
}


@pytest.mark.parametrize("name", list(ROUNDED))
def test_angles_of_the_table_may_be_rounded_to_any_number_of_decimals(name, rng):
    """A coefficient that nearly vanishes is neither taken for zero nor divided by."""
    for decimals in range(4, 12):
        rows = [
            (kind, a, round(alpha, decimals), d, round(theta, decimals)) for kind, a, alpha, d, theta in ROUNDED[name]
        ]
        arm = Arm.from_dh(rows, task="xyz")
        for _ in range(3):
            q = np.where(arm.revolute, rng.uniform(-3.0, 3.0, 3), rng.uniform(0.1, 0.9, 3))
            found = solve_all(arm, arm.fk(q))
            assert found.completeness in ("infinite", "at least") or contains(arm, found.q, q, 1e-4), (decimals, q)


def test_slides_that_a_turn_makes_parallel_leave_one_of_them_free():
    """With an offset across them no target is reached, and it is said how far away it is."""
    rows = [("P", 0.0, H, 0.0, 0.0), ("R", 0.0, -H, 0.0, 0.0), ("P", 0.2, H, 0.0, 0.0)]
    arm = Arm.from_dh(rows, "modified")
    assert arm.task.key == "xy phi"
    for q2 in (0.0, math.pi, 1e-10):
        T = np.asarray(arm.fk([0.3, q2, 0.4]))
        found = solve_all(arm, T)
        assert found.completeness == "infinite"
        assert worst_error(arm, found.q, T) < EXACT
    assert "Joints 1 and 3 slide in one direction" in solve_all(arm, arm.fk([0.3, 0.0, 0.4])).sentence
    assert solve_all(arm, pose_at(1.0, 0.0) @ arm.fk([0.3, 0.0, 0.4])).completeness == "none"
