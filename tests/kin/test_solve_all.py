"""One entry for all solutions: the right way for each arm, honest words, limits, bad input, random arms."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ik.answer import SURFACE
from armlab.kin.ik.solutions import MOST_EQUIVALENTS, wrapped_rows
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.ik.spare_joints import FAMILIES, REPRESENTATIVES
from armlab.kin.task import Task
from support.arms import QUARTERS, random_pose, random_q
from support.solutions import apart, contains, no_duplicates, worst_error

H = math.pi / 2

REDUNDANT = ("openmanipulator_x", "r4", "scorbot", "youbot", "canadarm2", "gen3", "iiwa7", "panda", "trunk9")


def judged(arm, found, T, far=1.0):
    """Assert what holds for every answer."""
    k = len(found)
    assert found.q.shape == (k, arm.n)
    assert len(found.names) == k
    assert len(set(found.names)) == k
    assert worst_error(arm, found.q, T) < 2e-9 * far
    assert no_duplicates(arm, found.q, 1e-7)
    for curve in found.families:
        assert worst_error(arm, curve, T) < 2e-9 * far
    assert (k == 0) if found.completeness == "none" else k > 0 or found.completeness == "at least"
    assert found.sentence
    assert found.why
    assert found.within_limits.tolist() == [arm.within_limits(row) for row in found.q]
    rows = [tuple(row) for row in np.round(found.q, 6) + 0.0]
    assert rows == sorted(rows)


def test_every_robot(robot, rng):
    arm = robot.arm
    for _ in range(2):
        q = random_q(arm, rng)
        T = np.asarray(arm.fk(q))
        found = solve_all(arm, T)
        judged(arm, found, T)
        assert len(found) > 0
        if found.completeness == "complete":
            assert contains(arm, found.q, q)
        else:
            assert robot.key in REDUNDANT
            assert found.completeness == "infinite"


@pytest.mark.parametrize("key", ["planar_2r", "stanford", "manseur_doty", "panda", "youbot"])
def test_the_same_call_gives_the_same_bits(key, rng):
    arm = catalogue()[key].arm
    T = np.asarray(arm.fk(random_q(arm, rng)))
    first, second = solve_all(arm, T, seed=3), solve_all(arm, T.copy(), seed=3)
    assert first.q.tobytes() == second.q.tobytes()
    assert first.names == second.names
    assert first.sentence == second.sentence
    assert all(a.tobytes() == b.tobytes() for a, b in zip(first.families, second.families, strict=True))


@pytest.mark.parametrize("key", REDUNDANT)
def test_families_stay_inside_the_limits(key, rng):
    arm = catalogue()[key].arm
    T = np.asarray(arm.fk(random_q(arm, rng)))
    found = solve_all(arm, T)
    judged(arm, found, T)
    assert found.method == "self_motion"
    assert found.within_limits.all()
    assert len(found) <= max(FAMILIES * REPRESENTATIVES, SURFACE)
    for curve in found.families:
        assert all(arm.within_limits(row, 1e-8) for row in curve)


def test_a_family_that_only_passes_through_the_limits_is_shown_inside_them():
    """Descents know no limits and hardly ever end within 2 degrees; the curves they end on lead through them."""
    arm = catalogue()["planar_3r"].arm
    narrow = Arm.from_dh(arm.rows, limits=[[0.30, 0.34], [-3, 3], [-3, 3]], task="xy")
    T = np.asarray(narrow.fk([0.32, 0.4, -0.8]))
    found = solve_all(narrow, T)
    assert found.completeness == "infinite"
    assert found.within_limits.all()
    assert np.ptp(found.q[:, 0]) > 0.03


def test_what_is_outside_says_by_how_much():
    arm = Arm.from_dh([("R", 1.0, 0, 0, 0), ("R", 1.0, 0, 0, 0)], limits=[[-3, 3], [0.0, 1.2]])
    found = solve_all(arm, arm.fk([0.0, 1.0]))
    assert found.within_limits.tolist() == [True, False]
    assert found.how_far_out == ("", "joint 2 by 57.3° below")
    assert found.beyond.round(9).tolist() == [[0.0, 0.0], [0.0, -1.0]]
    assert "1 of them within the joint limits" in found.sentence
    slide = Arm.from_dh([("R", 0, H, 0, 0), ("P", 0, 0, 0, 0)], limits=[[-3, 3], [0.2, 0.5]], task="xy")
    found = solve_all(slide, slide.fk([0.3, 0.7]))
    assert "joint 2 by 200 mm above" in found.how_far_out
    assert "None of them within" in found.sentence


def test_angles_come_nearest_to_the_limits_when_no_turn_is_inside():
    arm = Arm.from_dh([("R", 1.0, 0, 0, 0)] * 2, limits=[[math.radians(200), math.radians(300)], [-3, 3]])
    rows = wrapped_rows(arm, np.radians([[-170.0, 0.0], [-50.0, 0.0], [-95.0, 0.0], [-70.0, 0.0]]))
    assert np.degrees(rows[:, 0]).round(6).tolist() == [190.0, 310.0, 265.0, 290.0]


def test_half_a_turn_is_positive_unless_the_limits_say_otherwise():
    arm = Arm.from_dh([("R", 1.0, 0, 0, 0)] * 2, limits=[[-math.pi, math.pi], [-math.pi, 1.0]])
    rows = wrapped_rows(arm, np.array([[-math.pi, -math.pi], [math.pi + 4e-16, math.pi]]))
    assert (rows[:, 0] > 3.0).all()
    assert (rows[:, 1] < -3.0).all()


def test_whole_turn_copies():
    turns = 2.0 * math.pi
    arm = Arm.from_dh([("R", 1.0, 0, 0, 0), ("R", 1.0, 0, 0, 0)], limits=[[-turns, turns], [-3, 3]])
    found = solve_all(arm, arm.fk([0.5, 1.0]))
    k = next(k for k, row in enumerate(found.q) if row[1] > 0)
    copies = found.equivalents(k)
    assert copies.round(9).tolist() == np.round([[0.5 - turns, 1.0], [0.5, 1.0]], 9).tolist()
    for copy in copies:
        assert np.allclose(arm.fk(copy), arm.fk(found.q[k]), atol=1e-12)
    narrow = Arm.from_dh(arm.rows, limits=[[-3, 3], [0.0, 0.5]])
    assert solve_all(narrow, narrow.fk([0.5, 1.0])).equivalents(0).shape == (0, 2)
    wide = Arm.from_dh([("R", 0.2, 0.1, 0.1, 0.0)] * 6, limits=[[-50 * turns, 50 * turns]] * 6)
    assert len(solve_all(wide, wide.fk([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])).equivalents(0)) == MOST_EQUIVALENTS


def test_a_slide_outside_its_stroke_has_no_copies():
    arm = catalogue()["polar_rrp"].arm
    found = solve_all(arm, arm.fk([0.3, 0.4, 0.5]))
    for k in range(len(found)):
        assert (len(found.equivalents(k)) > 0) == bool(found.within_limits[k])


@pytest.mark.parametrize(
    ("T", "words"),
    [
        (np.diag([2.0, 1.0, 1.0, 1.0]), "T"),
        (np.diag([-1.0, 1.0, 1.0, 1.0]), "T"),
        (np.full((4, 4), np.nan), "T"),
        (np.eye(3), "T"),
        ("pose", "T"),
    ],
)
def test_what_is_no_pose_is_refused_in_words(T, words):
    with pytest.raises(InputError, match=words):
        solve_all(catalogue()["puma560"].arm, T)


def test_a_seed_that_is_no_number_is_refused():
    with pytest.raises(InputError, match="seed"):
        solve_all(catalogue()["panda"].arm, np.eye(4), seed=-1)


def test_a_million_metres_away(robot):
    """No arm that only turns reaches it; slides, whose strokes do not restrict solutions, may."""
    T = np.asarray(robot.arm.fk(robot.arm.clip(np.zeros(robot.arm.n)))).copy()
    T[:3, 3] += 1e6
    found = solve_all(robot.arm, T)
    judged(robot.arm, found, T, far=1e6)
    assert not found.within_limits.any()
    if robot.arm.revolute.all():
        assert found.completeness == "none"
        assert "No solution" in found.sentence


@pytest.mark.parametrize("n", range(1, 8))
@pytest.mark.parametrize("task", [None, "pose", "xyz"])
def test_no_lengths_at_all(n, task):
    arm = Arm.from_dh([("R", 0.0, H * (i % 2), 0.0, 0.0) for i in range(n)], task=task)
    q = np.linspace(0.2, 0.9, n)
    T = np.asarray(arm.fk(q))
    found = solve_all(arm, T)
    judged(arm, found, T)
    assert found.completeness != "none"
    far = T.copy()
    far[:3, 3] += 0.5
    if arm.task.position:
        assert len(solve_all(arm, far)) == 0


@pytest.mark.parametrize("key", ["planar_2r", "elbow_3r", "puma560", "ur10", "manseur_doty", "scara"])
def test_one_length_is_zero(key, rng):
    arm = catalogue()[key].arm
    for i, row in enumerate(arm.rows):
        if row.a == 0.0:
            continue
        rows = [(r.kind, 0.0 if k == i else r.a, r.alpha, r.d, r.theta) for k, r in enumerate(arm.rows)]
        without = Arm.from_dh(rows, arm.convention, base=arm.base, tool=arm.tool, task=arm.task)
        q = random_q(without, rng)
        T = np.asarray(without.fk(q))
        found = solve_all(without, T)
        judged(without, found, T)
        assert found.completeness != "none"
        if found.completeness == "complete":
            assert contains(without, found.q, q)


def test_equal_limits_leave_the_list_and_say_what_is_outside(rng):
    arm = catalogue()["puma560"].arm
    q = random_q(arm, rng)
    stuck = Arm.from_dh(arm.rows, arm.convention, base=arm.base, tool=arm.tool, limits=np.column_stack([q, q]))
    found = solve_all(stuck, arm.fk(q))
    assert len(found) == 8
    assert int(found.within_limits.sum()) == 1
    assert np.allclose(found.q[found.within_limits][0], q, atol=1e-9)


@pytest.mark.parametrize("n", [7, 8, 10, 12])
def test_long_arms(n):
    rng = np.random.default_rng(n)
    rows = [("R", *map(float, rng.uniform(-0.4, 0.4, 3)), 0.0) for _ in range(n)]
    arm = Arm.from_dh(rows)
    T = np.asarray(arm.fk(random_q(arm, rng)))
    found = solve_all(arm, T)
    judged(arm, found, T)
    assert found.completeness == "infinite"


def test_one_joint():
    arm = Arm.from_dh([("R", 0.7, 0.0, 0.0, 0.0)], task="xyz")
    assert solve_all(arm, arm.fk([2.0])).q.round(9).tolist() == [[2.0]]
    off = np.asarray(arm.fk([2.0])).copy()
    off[2, 3] = 0.1
    none = solve_all(arm, off)
    assert none.completeness == "none"
    assert "circle" in none.sentence
    slide = Arm.from_dh([("P", 0.0, 0.0, 0.0, 0.0)], task="xyz")
    assert solve_all(slide, slide.fk([0.4])).q.round(9).tolist() == [[0.4]]


def test_the_general_search_says_that_it_proves_nothing(rng):
    """A slide among six joints without a wrist."""
    rows = [("R", 0.3, 0.9, 0.1, 0.0)] * 3 + [("P", 0.2, 0.7, 0.1, 0.3)] + [("R", 0.2, -1.1, 0.2, 0.0)] * 2
    arm = Arm.from_dh(rows, task="pose")
    q = random_q(arm, rng)
    T = np.asarray(arm.fk(q))
    found = solve_all(arm, T)
    judged(arm, found, T)
    assert found.completeness == "at least"
    assert found.method == "many_starts"
    assert contains(arm, found.q, q)
    assert "a search cannot prove" in found.sentence


def drawn(seed):
    """Return any arm with any task, and joint values; angle tasks for arms that cannot tilt the hand only."""
    rng = np.random.default_rng(seed)
    n, special = int(rng.integers(1, 9)), bool(rng.random() < 0.5)
    rows = []
    for _ in range(n):
        alpha = float(rng.choice(QUARTERS)) if special else float(rng.uniform(-3, 3))
        theta = float(rng.choice(QUARTERS)) if special else float(rng.uniform(-3, 3))
        a, d = rng.uniform(-0.6, 0.6, 2) * (rng.random(2) > (0.5 if special else 0.0))
        rows.append(("R" if rng.random() < 0.75 else "P", float(a), alpha, float(d), theta))
    base, tool = (np.eye(4) if rng.random() < 0.5 else random_pose(rng) for _ in range(2))
    positions, rotations = ("", "x", "xy", "xz", "xyz"), ("none", "approach", "full")
    task = Task(positions[rng.integers(1, 5)], rotations[rng.integers(3)]) if rng.random() < 0.4 else None
    arm = Arm.from_dh(rows, ("standard", "modified")[rng.integers(2)], base=base, tool=tool, task=task)
    q = random_q(arm, rng)
    if rng.random() < 0.4:
        q = np.where(arm.revolute, rng.choice([0.0, H, -H, math.pi], n), q)
    return arm, q, rng


@pytest.mark.parametrize("block", range(6))
def test_random_arms_random_tasks(block):
    """Nothing raised, nothing wrong, and the known configuration is found wherever the list is called complete."""
    for seed in range(20 * block, 20 * block + 7):
        arm, q, rng = drawn(seed)
        T = np.asarray(arm.fk(q))
        found = solve_all(arm, T)
        judged(arm, found, T)
        assert found.completeness != "none", seed
        if found.completeness == "complete":
            # Where branches merge an error of 1e-9 of the pose is one of its root in the angles.
            assert apart(arm, found.q, q).min() < 1e-4, seed
        else:
            assert len(found) > 0, seed
        elsewhere = random_pose(rng)
        judged(arm, solve_all(arm, elsewhere), elsewhere)
