"""Samples of an arm: where searches begin."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.ik.samples import COUNT, samples_of
from armlab.kin.ik.verdict import task_error_of
from support.arms import random_q


@pytest.mark.parametrize(
    "key", ["planar_2r", "planar_3r", "scara", "scorbot", "puma560", "panda", "trunk9", "stanford"]
)
def test_the_nearest_has_the_least_error_of_the_task(key, rng):
    """The judge is the compiled error: chords of turns, lengths in half reaches."""
    arm = catalogue()[key].arm
    task, samples = task_error_of(arm), samples_of(arm, 0)
    for _ in range(3):
        target = task.target(np.asarray(arm.fk(random_q(arm, rng))))
        errors = np.array([task.at(q.tolist(), target)[2].scaled2 for q in samples.q])
        order = np.argsort(errors)
        near = samples.near(target, 5)
        # Features of an angle phi and of columns are chords, too: equal up to rounding.
        assert np.allclose([task.at(q.tolist(), target)[2].scaled2 for q in near], errors[order[:5]], atol=1e-9)
        assert task.at(samples.nearest(target).tolist(), target)[2].scaled2 == pytest.approx(errors.min(), abs=1e-9)


def test_they_are_inside_the_limits_and_the_same_for_the_same_seed(robot):
    arm = robot.arm
    samples = samples_of(arm, 3)
    assert samples.q.shape == (COUNT, arm.n)
    assert all(arm.within_limits(q) for q in samples.q[::50])
    assert samples_of(arm, 3) is samples
    assert not np.array_equal(samples_of(arm, 4).q, samples.q)


def test_more_than_there_are_come_in_order():
    arm = catalogue()["planar_2r"].arm
    samples = samples_of(arm, 0)
    target = task_error_of(arm).target(np.asarray(arm.fk([0.3, 0.4])))
    assert samples.near(target, COUNT + 5).shape == (COUNT, 2)
    assert np.array_equal(samples.near(target, COUNT + 5)[0], samples.nearest(target))
