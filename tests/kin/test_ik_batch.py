"""One solution for each of many poses, by themselves or along a path."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.transforms import transform
from support.arms import random_q

TWO_R = Arm.from_dh([("R", 1, 0, 0, 0)] * 2)


def at(*position):
    return transform(position=[*position, 0.0])


def test_a_batch_is_each_pose_by_itself(rng):
    arm = catalogue()["puma560"].arm
    T = arm.fk(random_q(arm, rng, 6)).reshape(2, 3, 4, 4)
    found = ik.solve_batch(arm, T, seed=4)
    assert found.success.shape == found.position_error.shape == found.rotation_error.shape == (2, 3)
    assert found.q.shape == (2, 3, 6)
    assert len(found) == 6
    for index, result in zip(np.ndindex(2, 3), found.results, strict=True):
        alone = ik.solve(arm, T[index], seed=4)
        assert alone.q.tolist() == found.q[index].tolist() == result.q.tolist()
        assert found.success[index] == alone.success
    single = ik.solve_batch(arm, T[0, 0])
    assert single.q.shape == (6,)
    assert single.success.shape == ()
    none = ik.solve_batch(arm, np.zeros((0, 4, 4)))
    assert none.q.shape == (0, 6)
    assert len(none) == 0


def test_starts_of_a_batch_are_shared_or_one_for_each():
    T = TWO_R.fk([[0.4, 0.9], [0.5, 1.0]])
    shared = ik.solve_batch(TWO_R, T, q0=[0.3, -0.8])
    assert np.all(shared.q[:, 1] < 0)
    own = ik.solve_batch(TWO_R, T, q0=[[0.3, 0.8], [0.6, -0.9]])
    assert (own.q[:, 1] > 0).tolist() == [True, False]


def test_along_a_path_an_arm_keeps_its_branch_and_its_turn():
    t = np.linspace(0.0, 2.0 * math.pi, 80)
    arm = Arm.from_dh(TWO_R.rows, limits=[[-12, 12], [-3, 3]])
    T = np.array([at(1.3 * math.cos(a), 1.3 * math.sin(a)) for a in 1.5 * t])
    for elbow in (1.5, -1.5):
        found = ik.solve_batch(arm, T, q0=[-0.5 * elbow, elbow], follow=True)
        assert found.success.all()
        assert np.abs(np.diff(found.q, axis=0)).max() < 0.2
        assert np.all(np.sign(found.q[:, 1]) == np.sign(elbow))
    # More than one and a half turns, which only following can count.
    assert found.q[-1, 0] - found.q[0, 0] == pytest.approx(3 * math.pi, abs=1e-6)


def test_a_path_goes_on_behind_a_pose_that_cannot_be_reached():
    T = np.array([at(1.2, 0.1), at(5.0, 0.0), at(1.2, 0.2)])
    found = ik.solve_batch(TWO_R, T, q0=[-0.5, 1.5], follow=True)
    assert found.success.tolist() == [True, False, True]
    assert np.abs(found.q[2] - found.q[0]).max() < 0.3


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ({"T": np.eye(3)}, r"T: expected shape \(..., 4, 4\), got \(3, 3\)"),
        ({"T": "poses"}, r"T: expected poses of shape \(..., 4, 4\), got 'poses'"),
        ({"T": [np.eye(4), np.diag([1, 1, -1, 1])]}, r"T\[1\]: .* not a rotation"),
        ({"T": [np.eye(4), np.full((4, 4), np.nan)]}, r"T\[1\]: every entry must be finite"),
        ({"q0": [0.0]}, r"q0: expected finite numbers of shape \(2,\) or \(3, 2\)"),
        ({"q0": [[0.0, 0.0]] * 2}, r"q0: expected finite numbers of shape \(2,\) or \(3, 2\)"),
        ({"q0": [0.0, np.nan]}, "q0: expected finite numbers of shape"),
        ({"q0": [[0.0, 0.0]] * 3, "follow": True}, "q0: expected 2 finite numbers"),
        ({"locked": [True, False]}, "locked: give q0"),
        ({"method": "magic"}, "method: unknown name 'magic'"),
    ],
)
def test_wrong_input_of_a_batch_is_named(arguments, text):
    with pytest.raises(InputError, match=text):
        ik.solve_batch(TWO_R, **{"T": [np.eye(4)] * 3, **arguments})
