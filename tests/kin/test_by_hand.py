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
from armlab.kin.task import task_named
from armlab.kin.transforms import inverse
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
"""Number of random poses of each arm here; 200 of each were tried with the same seeds."""


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


@pytest.mark.parametrize("key", COVERED)
def test_each_step_finds_its_joint_and_the_last_pose_is_the_wanted_one(key, seeded):
    arm, rng = arm_of(key), seeded(key)
    T = arm.fk(drawn(arm, rng))
    for one in every_derivation(arm, T, np.zeros(arm.n)):
        assert len({step.key for step in one.steps}) == len(one.steps)
        if one.q is None:
            continue
        by_steps = {step.joint: step.branches[step.chosen].value for step in one.steps if step.joint >= 0}
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
            axis = axes[step.joint]
            assert np.linalg.norm(np.cross(elbow - axis[:3, 3], axis[:3, 2])) < 1e-9


def parts_of(shape):
    return [value for name, value in vars(shape).items() if name not in ("of", "role", "name")]


# -- special poses -----------------------------------------------------------------------------------------------


def at(key, **values):
    """Return an arm and joint values, those that are not named in general position."""
    arm = arm_of(key)
    q = np.array([0.4, -0.9, 1.1, 0.5, 0.8, -0.7])[: arm.n]
    for name, value in values.items():
        q[int(name[1:]) - 1] = value
    return arm, q


SINGULAR = [
    ("puma560", {"q5": 0.0}, "q5", "Wrist singularity: axis 4 and axis 6 are one line"),
    ("irb120", {"q5": 0.0}, "q5", "Wrist singularity"),
    ("stanford", {"q5": math.pi}, "q5", "Wrist singularity"),
    ("ur5e", {"q5": 0.0}, "q5", "Wrist singularity: the parallel axes and axis 6 are one line"),
    ("ur5e", {"q3": 0.0}, "q3", "Elbow singularity: the links are stretched"),
    ("elbow_3r", {"q3": 0.0}, "q3", "Elbow singularity: the links are stretched"),
    ("elbow_3r", {"q3": math.pi}, "q3", "Elbow singularity: the links are folded"),
    ("planar_2r", {"q2": 0.0}, "q2", "Elbow singularity: the links are stretched"),
    ("planar_2r", {"q2": math.pi}, "q1", "Singular: the tool point lies on axis 1"),
    ("scara", {"q2": 0.0}, "q2", "Elbow singularity"),
    ("polar_rrp", {"q3": 0.0}, "q3", "Singular: the tool point lies on the shoulder"),
]


@pytest.mark.parametrize(("key", "values", "step", "said"), SINGULAR)
def test_a_singular_pose_is_told_in_words_and_the_derivation_goes_on(key, values, step, said):
    arm, q = at(key, **values)
    found = [one for one in every_derivation(arm, arm.fk(q), q) if one.q is not None]
    for one in found:
        assert np.isfinite(one.q).all()
        # Between merged branches the root of what rounding leaves is free: 1e-16 of the pose is 1e-8 of the angle.
        assert one.position_error < 1e-7
        assert one.rotation_error < 1e-7
    there = min(found, key=lambda one: apart(arm, one.q, q))
    assert apart(arm, there.q, q) < 1e-6
    told = {each.key: each for each in there.steps}
    assert told[step].note.startswith(said)
    assert told[step].case in ("any", "merged")


def test_a_shoulder_singularity_lets_joint_1_stay():
    arm = arm_of("irb140")
    q1 = 0.7
    # The wrist centre is brought onto axis 1 by joints 2 and 3.
    wrist = arm.fk(np.zeros(6)) @ inverse(arm.tool)
    height = 0.352 + 0.45
    T = np.eye(4)
    T[:3, :3] = wrist[:3, :3] @ arm.tool[:3, :3]
    T[:3, 3] = np.array([0.0, 0.0, height]) + T[:3, 2] * (0.065 + 0.14)
    near = np.array([q1, 0.0, 0.0, 0.0, 0.0, 0.0])
    found = list(every_derivation(arm, T, near))
    first = {step.key: step for step in found[0].steps}["q1"]
    assert first.case == "any"
    assert first.note.startswith("Shoulder singularity: the wrist centre lies on axis 1")
    assert [one.q[0] for one in found if one.q is not None] == pytest.approx([q1] * sum(o.q is not None for o in found))
    assert all(one.position_error < 1e-9 for one in found if one.q is not None)


def test_what_may_be_any_keeps_its_present_value():
    for key, joint in (("puma560", 3), ("ur5e", 5)):
        for value in (0.9, -2.0):
            arm, q = at(key, q5=0.0)
            near = np.array(q)
            near[joint] = value
            every = [one for one in every_derivation(arm, arm.fk(q), near) if one.q is not None]
            free = [one for one in every if any(step.case == "any" for step in one.steps)]
            assert free
            for one in free:
                told = {step.key: step for step in one.steps}
                assert told[f"q{joint + 1}"].case == "any"
                assert told[f"q{joint + 1}"].branches[0].value == pytest.approx(value)
                assert one.position_error < 1e-9
                assert one.rotation_error < 1e-9


@pytest.mark.parametrize("key", COVERED)
def test_at_special_joint_values_nothing_is_nan_and_what_is_reached_is_reached(key, seeded):
    arm, rng = arm_of(key), seeded(key)
    some = np.array([0.0, math.pi / 2, -math.pi / 2, math.pi, 1e-9, 1e-6])
    for _ in range(15):
        q = np.where(arm.revolute, rng.choice(some, arm.n), rng.choice([0.0, 0.1, -0.1], arm.n))
        T = arm.fk(q)
        reached = 0
        for one in every_derivation(arm, T, q):
            assert np.isfinite(one.steps[-1].gap)
            if one.q is not None:
                assert np.isfinite(one.q).all()
                assert one.position_error < 1e-6
                assert one.rotation_error < 1e-6
                reached += 1
        # Where q6 of three parallel axes stays, the pose it was made from is among what is found.
        assert reached


# -- out of reach ------------------------------------------------------------------------------------------------


def moved_to(x, y, z=0.0):
    T = np.eye(4)
    T[:3, 3] = x, y, z
    return T


FAR = [
    ("planar_2r", (2.5, 0.0, 0.0), "q2", 0.5, "farther from axis 1 than both links in one line"),
    ("planar_2r_unequal", (0.0, 0.3, 0.0), "q2", 0.2, "nearer to axis 1 than the folded links can come"),
    ("planar_3r", (4.0, 0.0, 0.0), "q2", 1.0, "axis 3 is <gap> farther from axis 1"),
    ("elbow_3r", (0.0, 2.0, 0.6), "q3", 0.7, "the tool point is <gap> farther from the shoulder"),
    ("elbow_3r", (0.1, 0.0, 0.6), "q3", 0.2, "nearer to the shoulder than the folded links"),
    ("r4", (3.0, 0.0, 0.4), "q3", 3.0 - 0.2 - 0.9, "axis 4 is <gap> farther from the shoulder"),
]


@pytest.mark.parametrize(("key", "place", "step", "gap", "said"), FAR)
def test_a_pose_out_of_reach_names_the_step_and_by_how_much(key, place, step, gap, said):
    arm = arm_of(key)
    found = list(every_derivation(arm, moved_to(*place), np.zeros(arm.n)))
    least = min(found, key=lambda one: one.failed.gap)
    assert all(one.q is None for one in found)
    assert least.failed.key == step
    assert least.failed.note.startswith("Out of reach: ")
    assert said in least.failed.note
    assert least.failed.gap == pytest.approx(gap, abs=1e-12)
    assert least.failed.branches == ()


def test_a_wrist_centre_too_near_to_axis_1_names_joint_1():
    arm = arm_of("puma560")
    T = arm.fk(np.zeros(6))
    T[:3, 3] = np.array([0.05, 0.0, 1.0]) + 0.27 * T[:3, 2]
    one = derived(arm, T, np.zeros(6))
    assert one.failed.key == "q1"
    assert one.failed.gap == pytest.approx(0.15005 - 0.05, abs=1e-12)
    assert "nearer to axis 1 than the arm passes beside it" in one.failed.note


def test_the_borders_of_reach_belong_to_it():
    arm = arm_of("planar_2r")
    for far, case in ((2.0, "merged"), (2.0 + 5e-7, "merged"), (2.0 + 2e-6, "none"), (2.0 - 1e-6, "two")):
        step = derived(arm, moved_to(far, 0.0), np.zeros(2)).steps[0]
        assert step.case == case


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


def test_a_wrist_alone_is_two_ways_to_turn():
    H = math.pi / 2
    arm = Arm.from_dh([("R", 0.0, H, 0.0, 0.2), ("R", 0.0, -H, 0.0, 0.0), ("R", 0.0, 0.0, 0.0, 0.0)])
    arm = replace(arm, task=task_named("pose")) if arm.task.rotation != "full" else arm
    if method_of(arm) is not None:
        T = arm.fk([0.3, 0.8, -0.5])
        assert as_one_list(arm, T)


def test_an_arm_that_is_not_solved_by_hand_is_refused():
    arm = arm_of("manseur_doty")
    with pytest.raises(ValueError, match="not solved by hand"):
        derived(arm, arm.fk(np.zeros(6)), np.zeros(6))
