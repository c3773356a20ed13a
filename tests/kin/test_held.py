"""Joints that are held: an arm of fewer joints, with the same answers."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ik.held import with_held
from armlab.kin.ik.solve_all import solve_all
from support.arms import random_arm, random_q
from support.solutions import contains, no_duplicates, worst_error


def test_the_arm_that_is_left_has_the_same_poses(rng):
    for k in range(30):
        arm = random_arm(rng, int(rng.integers(2, 8)), special=k % 2 == 0)
        q = random_q(arm, rng)
        held = {int(i): float(q[i]) for i in rng.choice(arm.n, int(rng.integers(1, arm.n)), replace=False)}
        rest = with_held(arm, held)
        if rest is None:
            assert arm.task.rotation == "phi" or arm.task.position not in ("", "xyz")
            continue
        kept = [i for i in range(arm.n) if i not in held]
        assert rest.n == len(kept)
        assert rest.limits.tolist() == arm.limits[kept].tolist()
        for _ in range(3):
            q[kept] = random_q(arm, rng)[kept]
            assert np.allclose(rest.fk(q[kept]), arm.fk(q), atol=1e-12)


@pytest.mark.parametrize(("key", "joint"), [("panda", 3), ("iiwa7", 3), ("gen3", 5), ("canadarm2", 1)])
def test_a_redundant_arm_with_one_joint_held_has_a_complete_list(key, joint, rng):
    arm = catalogue()[key].arm
    q = random_q(arm, rng)
    T = np.asarray(arm.fk(q))
    found = solve_all(arm, T, held={joint: q[joint - 1]})
    assert found.completeness == "complete"
    assert contains(arm, found.q, q)
    assert np.all(found.q[:, joint - 1] == q[joint - 1])
    assert worst_error(arm, found.q, T) < 1e-9
    assert no_duplicates(arm, found.q)
    assert f"q{joint} held" in found.why


@pytest.mark.parametrize("key", ["puma560", "elbow_3r", "scara", "planar_3r"])
def test_six_joints_with_one_held(key, rng):
    """The task asks for more than is left: the generator is found, and another value has no solution."""
    arm = catalogue()[key].arm
    q = random_q(arm, rng)
    T = np.asarray(arm.fk(q))
    found = solve_all(arm, T, held={1: q[0]})
    assert contains(arm, found.q, q)
    assert np.all(found.q[:, 0] == q[0])
    assert worst_error(arm, found.q, T) < 1e-9
    assert len(solve_all(arm, T, held={1: q[0] + 0.1234})) == 0


def test_all_joints_held(rng):
    arm = catalogue()["puma560"].arm
    q = random_q(arm, rng)
    held = {i + 1: float(q[i]) for i in range(6)}
    here = solve_all(arm, arm.fk(q), held=held)
    assert here.completeness == "complete"
    assert here.q.tolist() == [q.tolist()]
    assert here.method == "held"
    there = solve_all(arm, arm.fk(q + 0.1), held=held)
    assert there.completeness == "none"
    assert "All joints are held" in there.sentence


def test_held_values_stay_as_they_are_even_outside_the_limits():
    """Where the rest cannot be said as an arm: an angle about an axis that is no longer upright."""
    arm = Arm.from_dh(
        [("R", 0.4, 0.3, 0.1, 0.0), ("R", 0.4, 0.0, 0.0, 0.0), ("R", 0.3, 0.0, 0.0, 0.0), ("R", 0.2, 0.0, 0.0, 0.0)],
        limits=[[-0.5, 0.5]] * 4,
        task="xz",
    )
    q = np.array([3.0, 0.2, 0.3, -0.4])
    found = solve_all(arm, arm.fk(q), held={1: 3.0, 2: 0.2})
    assert found.method == "many_starts"
    assert contains(arm, found.q, q, 1e-5)
    assert np.all(found.q[:, :2] == [3.0, 0.2])
    assert not found.within_limits.any()


@pytest.mark.parametrize(
    ("held", "words"),
    [
        ({0: 0.1}, "joints 1 to 6"),
        ({7: 0.1}, "joints 1 to 6"),
        ({True: 0.1}, "joints 1 to 6"),
        ({2: math.nan}, "joint 2"),
        ({2: "here"}, "joint 2"),
        ([1, 2], "held"),
    ],
)
def test_bad_input_is_refused_in_words(held, words):
    with pytest.raises(InputError, match=words):
        solve_all(catalogue()["puma560"].arm, np.eye(4), held=held)
