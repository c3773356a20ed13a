"""Closed forms worked by hand: their branches are all solutions, and what they say and draw is true."""

import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.convert import converted
from armlab.kin.ik.by_hand import Arc, Circle, Segment, Triangle, derived, every_derivation, method_of, why_not
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.task import Task
from armlab.kin.transforms import inverse, transform
from support.arms import random_pose, tool_by_products
from support.by_hand import evaluated
from support.solutions import apart, contains, same_set

COVERED = {
    "planar_2r": "planar",
    "planar_2r_unequal": "planar",
    "planar_3r": "planar",
    "planar_3r_unequal": "planar",
    "scara": "planar",
    "cylindrical_rpp": "planar",
    "cartesian_3p": "cartesian",
    "elbow_3r": "positioned",
    "polar_rrp": "positioned",
    "puma560": "wrist",
    "irb120": "wrist",
    "irb140": "wrist",
    "kr6r900": "wrist",
    "tx60": "wrist",
    "stanford": "wrist",
    "unimate": "wrist",
    "ur3e": "three_parallel",
    "ur5e": "three_parallel",
    "ur10": "three_parallel",
    "ur10e": "three_parallel",
    "ur10_notes": "three_parallel",
    "r4": "turning_plane",
    "openmanipulator_x": "turning_plane",
    "scorbot": "turning_plane",
    "youbot": "turning_plane",
}
FINITE = [key for key, kind in COVERED.items() if kind != "turning_plane"]
FREE = [key for key, kind in COVERED.items() if kind == "turning_plane"]

POSES = 12
"""Number of random poses of each arm."""


def arm_of(key):
    return catalogue()[key].arm


def drawn(arm, rng):
    """Return joint values anywhere: all angles, and slides as far as the arm is large, to both sides."""
    far = np.where(arm.revolute, math.pi, arm.length_scale)
    return rng.uniform(-far, far)


def by_hand(arm, T):
    """Return the joint values of all branches, (k, n)."""
    found = every_derivation(arm, T, np.zeros(arm.n))
    return np.array([one.q for one in found if one.q is not None]).reshape(-1, arm.n)


def as_one_list(arm, T):
    return same_set(arm, by_hand(arm, T), solve_all(arm, T).q, 1e-8)


@pytest.fixture
def seeded():
    return lambda key: np.random.default_rng([19, *key.encode()])


# -- which arms --------------------------------------------------------------------------------------------------


def test_these_arms_of_the_library_are_solved_by_hand_and_the_others_say_why_not():
    found = {key: method_of(robot.arm) for key, robot in catalogue().robots.items()}
    assert {key: one.key for key, one in found.items() if one is not None} == COVERED
    without = {key: why_not(arm_of(key)) for key, one in found.items() if one is None}
    assert sorted(without) == ["canadarm2", "gen3", "iiwa7", "manseur_doty", "panda", "trunk9"]
    assert "one equation of degree 16" in without.pop("manseur_doty")
    assert without.pop("trunk9").startswith("3 joints are to spare")
    assert without.pop("iiwa7").startswith("Once the angle of the elbow is chosen, formulas give the rest")
    assert all(said.startswith("One joint is to spare") for said in without.values())
    assert all(why_not(arm_of(key)) == "" for key in COVERED)


# -- the hostile judge -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", FINITE)
def test_the_branches_together_are_the_list_of_all_solutions(key, seeded):
    arm, rng = arm_of(key), seeded(key)
    for _ in range(POSES):
        q = drawn(arm, rng)
        T = arm.fk(q)
        # The list is polished until only rounding is left; here nothing is polished.
        assert as_one_list(arm, T)


@pytest.mark.parametrize("key", FREE)
def test_an_arm_with_a_free_hand_is_found_again_from_its_pose(key, seeded):
    """The wanted direction and roll of the hand are those of the pose: the values it was made from come back."""
    arm, rng = arm_of(key), seeded(key)
    for _ in range(POSES):
        q = drawn(arm, rng)
        T = arm.fk(q)
        found = [one for one in every_derivation(arm, T, np.zeros(arm.n)) if one.q is not None]
        assert 2 <= len(found) <= 4
        assert contains(arm, np.array([one.q for one in found]), q, 1e-8)
        for one in found:
            assert one.position_error < 1e-12
            np.testing.assert_allclose(arm.fk(one.q)[:3, 3], T[:3, 3], rtol=0, atol=1e-12)


@pytest.mark.parametrize("key", ["puma560", "kr6r900", "stanford", "ur5e", "elbow_3r", "scara", "planar_3r"])
def test_any_convention_base_and_tool_will_do(key, seeded):
    rng, arm = seeded(key), arm_of(key)
    # A task in axes of frame 0 fits a plane; a base may stand anywhere.
    tool = random_pose(rng) if arm.task.key == "pose" else np.asarray(arm.tool)
    other = replace(arm, base=random_pose(rng), tool=tool)
    for each in (other, converted(other, "modified")):
        assert method_of(each).key == COVERED[key]
        for _ in range(3):
            T = each.fk(drawn(each, rng))
            assert as_one_list(each, T)


def test_offsets_of_the_table_change_zeros_and_nothing_else(seeded):
    rng = seeded("offsets")
    for key in ("puma560", "ur5e", "stanford", "planar_3r", "r4"):
        arm = arm_of(key)
        offsets = rng.uniform(-3.0, 3.0, arm.n)
        rows = [
            replace(row, theta=row.theta + by) if row.revolute else replace(row, d=row.d + 0.1 * by)
            for row, by in zip(arm.rows, offsets, strict=True)
        ]
        other = Arm.from_dh(rows, arm.convention, arm.base, arm.tool, task=arm.task)
        q = drawn(arm, rng)
        moved = q - np.where(arm.revolute, offsets, 0.1 * offsets)
        assert contains(arm, by_hand(other, arm.fk(q)), moved, 1e-8)


# -- steps -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", COVERED)
def test_the_equations_are_true_with_the_numbers_beside_them(key, seeded):
    arm, rng = arm_of(key), seeded(key)
    for _ in range(3):
        T = arm.fk(drawn(arm, rng))
        for one in every_derivation(arm, T, np.zeros(arm.n)):
            for step in one.steps:
                for line in step.lines:
                    found = evaluated(line, step)
                    if found is None:
                        continue
                    left, right, angle = found
                    gap = np.abs(np.asarray(left) - right)
                    gap = np.abs(np.remainder(gap + math.pi, math.tau) - math.pi) if angle else gap
                    # A difference of squares under a root loses half the digits where it is small.
                    assert gap.max() < 1e-7, (key, step.key, line)


@pytest.mark.parametrize("lift", [0.0, math.pi])
def test_of_an_arm_that_hangs_the_coordinates_are_those_of_frame_0(lift):
    rows = [("R", 0, math.pi, 0, 0), ("R", 0.5, 0, 0, 0), ("P", 0.4, lift, 0.1, 0), ("R", 0, -lift, 0, 0)]
    arm = Arm.from_dh(rows, "modified", tool=transform(position=[0.2, 0.0, 0.05]), task="xyz phi")
    T = arm.fk([0.3, 0.5, 0.2, 0.1])
    found = {step.key: step.values for step in derived(arm, T, np.zeros(4)).steps}
    assert (found["q3"]["z"].symbol, found["q3"]["z"].value) == ("p_z", pytest.approx(T[2, 3]))
    x, y, _ = T[:3, 3]
    assert (found["c"]["p"].symbol, found["c"]["p"].value) == (r"(p_x,\, -p_y)", pytest.approx((x, -y)))
    for one in every_derivation(arm, T, np.zeros(4)):
        for step in one.steps:
            for line in step.lines:
                if not line.right.startswith("<p>"):
                    left, right, _ = evaluated(line, step)
                    assert math.isclose(left, right, abs_tol=1e-9)


@pytest.mark.parametrize("key", COVERED)
def test_each_step_finds_its_joint_and_the_last_pose_is_the_wanted_one(key, seeded):
    arm, rng = arm_of(key), seeded(key)
    T = arm.fk(drawn(arm, rng))
    for one in every_derivation(arm, T, np.zeros(arm.n)):
        assert len({step.key for step in one.steps}) == len(one.steps)
        if one.q is None:
            continue
        by_steps = {step.index: step.branches[step.chosen].value for step in one.steps if step.index >= 0}
        np.testing.assert_array_equal([by_steps[i] for i in range(arm.n)], one.q)
        got = tool_by_products(arm, one.q)
        np.testing.assert_allclose(got[:3, 3][arm.task.coordinates], T[:3, 3][arm.task.coordinates], atol=1e-9)
        if arm.task.rotation in ("full", "phi"):
            np.testing.assert_allclose(got[:3, :3], T[:3, :3], rtol=0, atol=1e-9)


def test_a_choice_of_one_step_decides_the_numbers_of_the_next():
    arm = arm_of("puma560")
    T = arm.fk([0.3, -0.7, 0.4, 0.9, 0.8, -1.1])
    seen = {}
    for sign in (0, 1):
        one = derived(arm, T, np.zeros(6), {"q1": sign, "q3": 0, "q5": 1})
        assert one.choices == {"q1": sign, "q3": 0, "q5": 1}
        seen[sign] = {step.key: step for step in one.steps}
        assert seen[sign]["q1"].sign == (1 if sign == 0 else -1)
    rho = [seen[sign]["q3"].values["rho"].value for sign in (0, 1)]
    assert rho[0] == pytest.approx(-rho[1])
    assert seen[0]["q2"].branches[0].value != pytest.approx(seen[1]["q2"].branches[0].value)


def test_the_branches_have_the_words_of_the_list_of_solutions():
    for key in ("puma560", "ur10e"):
        arm = arm_of(key)
        T = arm.fk([0.3, -0.7, 0.4, 0.9, 0.8, -1.1])
        found = solve_all(arm, T)
        for one in every_derivation(arm, T, np.zeros(6)):
            said = ", ".join(step.branches[step.chosen].title for step in one.steps if len(step.branches) == 2)
            k = int(np.argmin(apart(arm, found.q, one.q)))
            assert sorted(said.split(", ")) == sorted(found.names[k].split(", ")), key


@pytest.mark.parametrize("key", [*FINITE, *FREE])
def test_the_triangle_is_the_arm_itself(key, seeded):
    """The corners lie on the axes of the arm in the joint values that are found, and the sides have their lengths."""
    arm = arm_of(key)
    q = drawn(arm, seeded(key))
    T = arm.fk(q)
    found = [one for one in every_derivation(arm, T, np.zeros(arm.n)) if one.q is not None]
    for one in found:
        frames = inverse(arm.base) @ arm.frames(one.q)
        axes = frames[:-1] if arm.convention == "standard" else frames[1:]
        for step in one.steps:
            shapes = step.shapes
            assert all(np.isfinite(np.hstack([np.ravel(part) for part in parts_of(shape)])).all() for shape in shapes)
            for shape in shapes:
                of = step.values.get(getattr(shape, "of", ""))
                if isinstance(shape, Segment) and of is not None:
                    assert np.linalg.norm(shape.end - shape.start) == pytest.approx(abs(of.value), abs=1e-9)
                if isinstance(shape, Arc):
                    assert of.unit == "rad"
            if step.by != "law of cosines":
                continue
            (triangle,) = (shape for shape in shapes if isinstance(shape, Triangle))
            near, far = (shape for shape in shapes if isinstance(shape, Circle))
            elbow = triangle.corners[1]
            for circle in (near, far):
                assert np.linalg.norm(elbow - circle.centre) == pytest.approx(circle.radius, abs=1e-9)
                assert (elbow - circle.centre) @ circle.normal == pytest.approx(0.0, abs=1e-9)
            axis = axes[step.index]
            assert np.linalg.norm(np.cross(elbow - axis[:3, 3], axis[:3, 2])) < 1e-9


def parts_of(shape):
    return [value for name, value in vars(shape).items() if name not in ("of", "role", "name")]


# -- made-up arms ------------------------------------------------------------------------------------------------


def test_arms_that_nobody_has_built(seeded):
    rng = seeded("made up")
    H = math.pi / 2
    for _ in range(6):
        a1, a2, a3, d1, d2, d4, d5, d6 = rng.uniform(0.1, 0.6, 8)
        wrist = [("R", 0.0, H, d4, 0.0), ("R", 0.0, -H, 0.0, 0.0), ("R", 0.0, 0.0, d6, 0.0)]
        arms = [
            Arm.from_dh([("R", a1, -H, d1, 0.3), ("R", a2, 0.0, d2, 0.0), ("R", a3, H, 0.0, 0.2), *wrist]),
            Arm.from_dh([("R", a1, H, d1, 0.0), ("R", a2, H, 0.0, 0.4), ("P", 0.0, 0.0, 0.0, 0.0), *wrist]),
            Arm.from_dh([("P", 0.0, H, 0.0, H), ("P", 0.0, H, 0.0, H), ("P", 0.0, 0.0, 0.0, 0.0), *wrist]),
            Arm.from_dh(
                [
                    ("R", a1, H, d1, 0.0),
                    ("R", a2, 0.0, d2, 0.0),
                    ("R", a3, math.pi, 0.0, 0.0),
                    ("R", 0.0, H, d4, 0.0),
                    ("R", 0.0, -H, d5, 0.0),
                    ("R", 0.0, 0.0, d6, 0.0),
                ]
            ),
            Arm.from_dh([("R", 0.0, H, d1, 0.5), ("P", 0.0, H, d2, 0.0), ("R", 0.0, H, 0.1, 0.0)], task="xyz"),
        ]
        for arm in arms[:4]:
            assert method_of(arm) is not None
            T = arm.fk(drawn(arm, rng))
            assert as_one_list(arm, T)
        assert method_of(arms[4]) is None
        assert why_not(arms[4])


def test_a_wrist_alone_is_two_ways_to_turn(seeded):
    H = math.pi / 2
    rows = [("R", 0.0, H, 0.0, 0.2), ("R", 0.0, -H, 0.0, 0.0), ("R", 0.0, 0.0, 0.0, 0.0)]
    arm, rng = Arm.from_dh(rows, task=Task("", "full")), seeded("wrist")
    assert method_of(arm).key == "wrist"
    for _ in range(5):
        T = arm.fk(drawn(arm, rng))
        assert len(by_hand(arm, T)) == 2
        assert as_one_list(arm, T)


def test_an_arm_that_is_not_solved_by_hand_is_refused():
    arm = arm_of("manseur_doty")
    with pytest.raises(ValueError, match="not solved by hand"):
        derived(arm, arm.fk(np.zeros(6)), np.zeros(6))
