"""Planar parts and slides inside an arm, and arms with joints to spare."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.relations import Axes
from armlab.kin.spare import spare_joints
from armlab.kin.structure import structure_of
from support.arms import random_arm, random_pose

H = math.pi / 2
R, P = "R", "P"


def axes_of(arm, q):
    frames = arm.frames(q)
    frames = frames[:-1] if arm.convention == "standard" else frames[1:]
    return frames[:, :3, 3], frames[:, :3, 2]


def with_run(rng, run, place, others="RRR"):
    """A general arm with a run of joints in it whose axes and links are given; the run's last link is general."""
    rows = [(kind, *rng.uniform((0.2, 0.4, -0.5, -3), (0.6, 1.1, 0.5, 3))) for kind in others]
    *front, (kind, _, _, d, theta) = run
    rows[place:place] = [*front, (kind, 0.3, 0.9, d, theta)]
    return Arm.from_dh(rows, tool=random_pose(rng), task="pose")


def poses_found(arm, rng, starts=400):
    """Count the solutions for one reachable pose that Newton finds from many starts."""
    target = arm.fk(rng.uniform(-1.5, 1.5, arm.n))
    q = rng.uniform(-math.pi, math.pi, (starts, arm.n))

    def gap(q):
        T = arm.fk(q)
        S = target[:3, :3] @ np.swapaxes(T[:, :3, :3], 1, 2)
        turn = np.stack([S[:, 2, 1] - S[:, 1, 2], S[:, 0, 2] - S[:, 2, 0], S[:, 1, 0] - S[:, 0, 1]], axis=1) / 2
        return np.hstack([target[:3, 3] - T[:, :3, 3], turn]), np.trace(S, axis1=1, axis2=2)

    for _ in range(60):
        J = arm.jacobian(q)
        damped = J.swapaxes(1, 2) @ J + 1e-10 * np.eye(arm.n)
        step = np.linalg.solve(damped, J.swapaxes(1, 2) @ gap(q)[0][..., None])[..., 0]
        q += step * np.minimum(1.0, 0.7 / np.maximum(np.linalg.norm(step, axis=1), 1e-300))[:, None]
    left, trace = gap(q)
    q = q[(np.linalg.norm(left, axis=1) < 1e-9) & (trace > 2.9)]
    seen = np.hstack([np.where(arm.revolute, np.cos(q), q), np.where(arm.revolute, np.sin(q), 0.0)])
    different = []
    for point in seen:
        if all(np.linalg.norm(point - other) > 1e-3 for other in different):
            different.append(point)
    return len(different)


THREE = [(R, 0.5, 0, 0.1, 0), (R, 0.4, 0, 0.2, 0), (R, 0, 0, 0, 0)]


@pytest.mark.parametrize("place", range(4))
def test_any_six_turns_with_three_parallel_ones_have_at_most_eight_solutions(place, rng):
    for _ in range(3):
        arm = with_run(rng, THREE, place)
        structure = structure_of(arm)
        assert (structure.key, structure.most_solutions) == ("three_parallel", 8)
        assert structure.joints == (place + 1, place + 2, place + 3)
        assert 1 <= poses_found(arm, rng) <= 8


@pytest.mark.parametrize(
    ("run", "others", "most"),
    [
        ([(R, 0.4, 0, 0.1, 0), (R, 0.3, 0, 0.2, 0), (P, 0, 0, 0, 0.4), (R, 0, 0, 0, 0)], "RR", 4),
        ([(R, 0.4, 0, 0.1, 0), (P, 0.2, 0, 0.2, 0.3), (R, 0.5, 0, 0, 0), (R, 0, 0, 0, 0)], "RR", 4),
        ([(R, 0.4, H, 0.1, 0), (P, 0.2, -H, 0.2, 0), (R, 0, 0, 0, 0)], "RRR", 8),
        ([(R, 0.4, 0, 0.1, 0), (R, 0.5, 0, 0.2, 0), (R, 0, 0, 0, 0)], "PRR", 4),
        ([(R, 0.4, H, 0.1, 0), (P, 0.2, H, 0.2, H), (P, 0, 0, 0, 0)], "RRR", 4),
    ],
)
def test_slides_count_in_a_planar_part(run, others, most, rng):
    for place in (0, len(others)):
        arm = with_run(rng, run, place, others)
        structure = structure_of(arm)
        key = "three_parallel" if "P" in others else "planar_part"
        assert (structure.key, structure.closed_form, structure.most_solutions) == (key, True, most)
        assert structure.joints == tuple(range(place + 1, place + 1 + len(run)))
        assert most is None or 1 <= poses_found(arm, rng) <= most


def test_turns_in_one_line_are_no_planar_part():
    run = [(R, 0.4, 0, 0.1, 0), (P, 0.4, 0, 0.2, math.pi), (R, 0.5, 0, 0, 0), (R, 0, 0, 0, 0)]
    assert structure_of(with_run(np.random.default_rng(2), run, 0, "RR")).key == "general"


def test_a_scara_with_two_turns_more_is_not_called_general():
    rows = [(R, 0.4, 0, 0.1, 0), (R, 0.3, 0, 0.2, 0), (P, 0, 0, 0.2, 0), (R, 0, H, 0, 0)]
    structure = structure_of(Arm.from_dh([*rows, (R, 0.1, H, 0.1, 0), (R, 0.1, 0, 0.1, 0)]))
    assert structure.why == (
        "Joints 1, 2 and 4 form a planar 3R and joint 3 slides at a right angle to its plane: the other joints "
        "separate from it."
    )


def test_a_general_arm_says_what_was_tested():
    why = structure_of(catalogue()["manseur_doty"].arm).why
    assert "None of the sufficient conditions known to this lab was found" in why
    assert "degree at most 16" in why


@pytest.mark.parametrize(
    ("rows", "task", "told"),
    [
        ([(R, 1, 0, 0, 0)] * 4, None, "With joint 4 fixed: Planar 3R (joints 1, 2 and 3)."),
        ([(R, 1, 0, 0, 0)] * 5, None, "With joints 4 and 5 fixed: Planar 3R (joints 1, 2 and 3)."),
        ([(R, 0.3, 0.7, 0.2, 0)] * 4, "xyz", "With joint 4 fixed: Positioning arm RRR (joints 1, 2 and 3)."),
    ],
)
def test_an_arm_with_joints_to_spare_has_a_closed_form_where_fixing_some_leaves_one(rows, task, told):
    structure = structure_of(Arm.from_dh(rows, task=task))
    assert structure.closed_form
    assert structure.most_solutions is None
    assert "infinitely many solutions" in structure.why
    assert structure.why.endswith(told)
    assert "None of the" not in structure.why


@pytest.mark.parametrize("key", ["canadarm2", "gen3", "panda", "iiwa7"])
def test_seven_joints_are_no_reason_against_a_closed_form(key):
    structure = structure_of(catalogue()[key].arm)
    assert (structure.closed_form, structure.free) == (True, 1)


def test_a_general_arm_of_seven_joints_has_no_known_closed_form():
    rows = [(R, 0.2 + 0.05 * i, 0.4 + 0.1 * i, 0.1, 0.3) for i in range(7)]
    structure = structure_of(Arm.from_dh(rows))
    assert (structure.key, structure.closed_form, structure.free) == ("redundant", False, 1)
    assert "With one fixed, none of the sufficient conditions known to this lab was found" in structure.why


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_the_arm_that_is_left_has_the_axes_of_the_others(convention, rng):
    for special in (False, True):
        for _ in range(8):
            arm = random_arm(rng, 7, convention=convention, special=special)
            spare = spare_joints(arm)
            p, z = axes_of(arm, spare.samples[0])
            for fixed, left in spare.with_fixed():
                kept = [k - 1 for k in range(1, 8) if k not in fixed]
                assert [arm.rows[k].kind for k in kept] == [row.kind for row in left.rows]
                for j, k, (a, alpha) in zip(kept, kept[1:], Axes(left).links[1:-1], strict=False):
                    across = np.cross(z[j], z[k])
                    assert z[j] @ z[k] == pytest.approx(math.cos(alpha), abs=1e-9)
                    apart = (
                        np.linalg.norm(np.cross(p[k] - p[j], z[j]))
                        if np.linalg.norm(across) < 1e-9
                        else abs((p[k] - p[j]) @ across) / np.linalg.norm(across)
                    )
                    assert a == pytest.approx(apart, abs=1e-7)


def test_the_angle_of_one_turn_is_the_joint_value_but_for_sense_and_constant():
    why = structure_of(Arm.from_dh([(R, 1, 0, 0, 0.3)])).why
    assert why == "The angle gives the joint value, up to its sign and a constant."


@pytest.mark.parametrize(
    ("rows", "task", "most"),
    [
        ([(P, 0.1, 0.7, 0, 0), (R, 0.2, 0.3, 0.1, 0), (P, 0.1, 0.8, 0, 0.3), (P, 0, 0, 0, 0.2)], "xyz phi", None),
        ([(P, 0.1, 0.0, 0, 0), (R, 0.2, 0.3, 0.1, 0), (P, 0.1, 0.8, 0, 0.3), (P, 0, 0, 0, 0.2)], "xyz phi", 1),
        (
            [(P, 0.1, 0.7, 0, 0), (R, 0.2, 0.3, 0, 0), (P, 0.1, 0.8, 0, 0.3), (P, 0, 0.4, 0, 1), (R, 0, 0.4, 0, 0)],
            "xyz approach",
            2,
        ),
    ],
)
def test_three_slides_with_fewer_turns(rows, task, most):
    structure = structure_of(Arm.from_dh(rows, tool=random_pose(np.random.default_rng(5)), task=task))
    assert (structure.key, structure.closed_form, structure.most_solutions) == ("three_slides", True, most)
