"""Closed forms worked by hand at singular poses, on borders and out of reach."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.ik.branches import branch_names
from armlab.kin.ik.by_hand import derived, every_derivation, method_of
from armlab.kin.transforms import inverse, transform
from support.solutions import apart

COVERED = [key for key, robot in catalogue().robots.items() if method_of(robot.arm) is not None]


def arm_of(key):
    return catalogue()[key].arm


# -- special poses -----------------------------------------------------------------------------------------------


def at(key, **values):
    """Return an arm and joint values, those that are not named in general position."""
    arm = arm_of(key)
    q = np.array([0.4, -0.9, 1.1, 0.5, 0.8, -0.7])[: arm.n]
    for name, value in values.items():
        q[int(name[1:]) - 1] = value
    return arm, q


SINGULAR = [
    ("puma560", {"q5": 0.0}, "q5", "Wrist singularity: axis 4 and axis 6 coincide"),
    ("irb120", {"q5": 0.0}, "q5", "Wrist singularity"),
    ("stanford", {"q5": math.pi}, "q5", "Wrist singularity"),
    ("ur5e", {"q5": 0.0}, "q5", "Wrist singularity: the parallel axes and axis 6 coincide"),
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


@pytest.mark.parametrize("height", [0.5, -0.4])
def test_of_a_point_above_or_below_the_shoulder_no_elbow_is_higher_than_the_other(height):
    arm = arm_of("elbow_3r")
    shoulder = arm.frames(np.zeros(3))[1][:3, 3]
    found = derived(arm, transform(position=shoulder + np.array([0.0, 0.0, height])), np.zeros(3))
    (bend,) = (step for step in found.steps if step.by == "law of cosines")
    assert [branch.title for branch in bend.branches] == ["elbow beside", "elbow beside"]
    assert "elbow beside" in branch_names(arm, found.q[None])[0]


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
def test_at_special_joint_values_nothing_is_nan_and_what_is_reached_is_reached(key):
    arm, rng = arm_of(key), np.random.default_rng([20, *key.encode()])
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
    ("planar_3r", (4.0, 0.0, 0.0), "q2", 1.0, "axis 3 is {gap} farther from axis 1"),
    ("elbow_3r", (0.0, 2.0, 0.6), "q3", 0.7, "the tool point is {gap} farther from the shoulder"),
    ("elbow_3r", (0.1, 0.0, 0.6), "q3", 0.2, "nearer to the shoulder than the folded links"),
    ("r4", (3.0, 0.0, 0.4), "q3", 3.0 - 0.2 - 0.9, "axis 4 is {gap} farther from the shoulder"),
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


@pytest.mark.parametrize("key", COVERED)
def test_out_of_reach_every_number_and_every_point_is_finite(key):
    arm, rng = arm_of(key), np.random.default_rng([21, *key.encode()])
    for far in (0.0, 0.05, 3.0):
        T = arm.fk(rng.uniform(-1.0, 1.0, arm.n))
        T[:3, 3] = arm.base[:3, 3] + far * arm.reach * rng.normal(size=3)
        for one in every_derivation(arm, T, np.zeros(arm.n)):
            for step in one.steps:
                assert all(np.isfinite(each.value).all() for each in step.values.values()), step.key
                for shape in step.shapes:
                    numbers = [value for value in vars(shape).values() if not isinstance(value, str)]
                    assert all(np.isfinite(value).all() for value in numbers)
                assert (one.q is None) == (one.failed is not None)


def test_a_wrist_centre_too_near_to_axis_1_names_joint_1():
    arm = arm_of("puma560")
    T = arm.fk(np.zeros(6))
    T[:3, 3] = np.array([0.05, 0.0, 1.0]) + 0.27 * T[:3, 2]
    one = derived(arm, T, np.zeros(6))
    assert one.failed.key == "q1"
    assert one.failed.gap == pytest.approx(0.15005 - 0.05, abs=1e-12)
    assert "nearer to axis 1 than the offset of the arm allows" in one.failed.note


def test_the_borders_of_reach_belong_to_it():
    arm = arm_of("planar_2r")
    for far, case in ((2.0, "merged"), (2.0 + 5e-7, "merged"), (2.0 + 2e-6, "none"), (2.0 - 1e-6, "two")):
        step = derived(arm, moved_to(far, 0.0), np.zeros(2)).steps[0]
        assert step.case == case


def test_a_target_beside_the_plane_of_an_arm_has_no_joint_values():
    """The axes of this modified table are oblique to frame 0, so that its task is the whole position."""
    table = [("R", 0.0, math.radians(40.0), 0.0, 0.0), ("R", 1.0, 0.0, 0.0, 0.0)]
    arm = Arm.from_dh(table, convention="modified", tool=transform(position=[0.8, 0.0, 0.0]))
    T = arm.fk([0.3, 0.7])
    assert derived(arm, T, [0.3, 0.7]).q is not None
    beside = T.copy()
    beside[2, 3] += 0.2
    for found in every_derivation(arm, beside, [0.3, 0.7]):
        assert found.q is None
        assert found.failed.gap == pytest.approx(0.2 * math.cos(math.radians(40.0)))
        assert "beside the plane" in found.failed.note
