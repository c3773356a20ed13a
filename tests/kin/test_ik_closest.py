"""Without a start, the closest configuration to a target out of reach is looked for from samples near the target."""

import numpy as np
import pytest

from armlab.kin.arm import Arm
from armlab.kin.ik import solve
from armlab.kin.ik.samples import samples_of
from armlab.kin.ik.solve import LOWEST
from armlab.kin.ik.verdict import task_error_of

UNTIL = 20
"""Number of targets out of reach that are tried."""


@pytest.mark.parametrize("seed", range(4))
def test_a_valley_behind_a_limit_is_found_from_the_other_side(seed):
    # Downhill of 0, joint 2 ends at its lower limit, 203 mm away.
    rows = [("P", 0.3, 0.0, 0.0, np.pi / 2), ("R", 0.2, 0.0, 0.0, 0.0)]
    arm = Arm.from_dh(rows, limits=[(0.0, 0.53), (-1.84, 3.82)])
    target = np.eye(4)
    target[:3, 3] = 0.0438, 0.1084, 0.1728
    far = np.linalg.norm(
        np.array([0.0438, 0.1084 - 0.3])
    )  # from the axis of joint 2, around which the tool is at 0.2 m
    result = solve(arm, target, seed=seed)
    assert not result.success
    assert result.position_error == pytest.approx(abs(far - 0.2), abs=1e-6)
    assert solve(arm, target, q0=[0.0, 0.0]).position_error > 0.2


def test_twenty_thousand_samples_seldom_come_closer(rng):
    beaten = tried = 0
    while tried < UNTIL:
        arm = _random_arm(rng)
        low, high = arm.limits.T
        target = arm.fk(rng.uniform(low, high))
        target[:3, 3] += rng.uniform(-0.5, 0.5, 3)
        result = solve(arm, target)
        if arm.task.rotation != "none" or result.success:
            continue
        tried += 1
        tools = arm.position(rng.uniform(low, high, (20_000, arm.n))) - target[:3, 3]
        nearest = np.linalg.norm(tools[:, list(arm.task.coordinates)], axis=1).min()
        beaten += nearest < result.position_error - 1e-3
    assert beaten <= UNTIL // 20  # a valley may lie between all samples


def test_of_several_valleys_the_deepest_counts(rng):
    several = 0
    for _ in range(6 * UNTIL):
        arm = _random_arm(rng)
        target = arm.fk(rng.uniform(*arm.limits.T))
        target[:3, 3] += rng.uniform(-0.5, 0.5, 3)
        result = solve(arm, target)
        if arm.task.rotation != "none" or result.success:
            continue
        lows = samples_of(arm, 0).near(task_error_of(arm).target(target), LOWEST)
        depths = [solve(arm, target, q0=q, searches=1, complete=False).position_error for q in lows]
        assert result.position_error == pytest.approx(min(depths), abs=1e-6)
        several += max(depths) > min(depths) + 1e-3
    assert several > 1  # where all depths are equal, any of them passes


def test_with_weights_that_valley_counts_which_is_the_deepest_by_them():
    arm = Arm.from_dh([("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0)], limits=[(-0.7, 1.4), (-1.7, 1.5)])
    target, weights = np.eye(4), np.array([1.0, 0.1])
    target[0, 3] = 0.2
    everywhere = np.stack(np.meshgrid(*(np.linspace(*pair, 101) for pair in arm.limits)), axis=-1).reshape(-1, 2)

    def far(q):
        return np.linalg.norm(weights * (arm.position(q) - target[:3, 3])[..., :2], axis=-1)

    assert far(solve(arm, target, weights=weights).q) <= far(everywhere).min() + 1e-9


def _random_arm(rng):
    rows, limits = [], []
    for _ in range(rng.integers(2, 6)):
        kind = "P" if rng.random() < 0.3 else "R"
        a, d = rng.choice([0.0, 0.2, 0.3]), rng.choice([0.0, 0.0, 0.2])
        rows.append((kind, a, rng.choice([0.0, np.pi / 2, -np.pi / 2]), d, rng.choice([0.0, np.pi / 2])))
        middle, half = rng.uniform(-1.0, 1.0), rng.uniform(0.5, 3.0)
        limits.append((middle - half, middle + half) if kind == "R" else (0.0, rng.uniform(0.2, 0.8)))
    return Arm.from_dh(rows, limits=limits)
