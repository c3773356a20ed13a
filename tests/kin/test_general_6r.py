"""Every solution of any six turns: against descents from everywhere, borders, families, bad input."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ik import general_family
from armlab.kin.ik.general_6r import solve_general, solve_general_batch
from armlab.kin.ik.general_complex import Roots
from armlab.kin.ik.general_search import Search
from support.arms import random_pose, tool_by_products
from support.solutions import by_many_starts, contains, no_duplicates, same_set, worst_error

H = math.pi / 2


def six(rng, special, scale=1.0):
    """Return a random 6R; special ones have quarter-turn twists and half of their lengths zero."""
    while True:
        rows = []
        for _ in range(6):
            alpha = float(rng.choice([0.0, H, -H])) if special else float(rng.uniform(-3, 3))
            a, d = scale * rng.uniform(-1, 1, 2) * (rng.random(2) > (0.5 if special else 0.0))
            rows.append(("R", float(a), alpha, float(d), float(rng.uniform(-3, 3))))
        base, tool = random_pose(rng), random_pose(rng)
        base[:3, 3] *= scale
        tool[:3, 3] *= scale
        arm = Arm.from_dh(rows, ("standard", "modified")[rng.integers(2)], base=base, tool=tool, task="pose")
        if regular(arm, rng.uniform(-3, 3, 6)):
            return arm


def regular(arm, q):
    """Return whether the arm can move its tool in every way from here, clearly."""
    J = np.asarray(arm.jacobian(q)) / np.array([arm.length_scale] * 3 + [1.0] * 3)[:, None]
    return float(np.linalg.svd(J, compute_uv=False)[-1]) > 2e-3


def posed(arm, rng):
    while True:
        q = rng.uniform(-math.pi, math.pi, 6)
        if regular(arm, q):
            return q, tool_by_products(arm, q)


@pytest.mark.parametrize("special", [False, True])
@pytest.mark.parametrize("seed", [0, 2, 4, 6, 8, 10, 14])  # 2, 4, 6, 8 and 16 solutions
def test_all_that_a_thousand_descents_find(special, seed):
    rng = np.random.default_rng(100 * special + seed)
    arm = six(rng, special)
    q, T = posed(arm, rng)
    found = solve_general(arm, T)
    assert found.completeness == "complete"
    assert contains(arm, found.q, q)
    for row in by_many_starts(arm, T):
        assert contains(arm, found.q, row, 1e-4)
    assert worst_error(arm, found.q, T) < 1e-9
    assert no_duplicates(arm, found.q)
    assert len(found) % 2 == 0 or found.singular.any()
    assert len(found) <= 16


@pytest.mark.parametrize("scale", [1e-3, 300.0])
def test_the_size_of_the_arm_does_not_matter(scale, rng):
    for _ in range(5):
        arm = six(rng, special=True, scale=scale)
        q, T = posed(arm, rng)
        assert contains(arm, solve_general(arm, T).q, q)


@pytest.mark.parametrize("key", ["puma560", "ur10", "manseur_doty"])
def test_the_order_is_canonical_and_the_answer_the_same_bit_by_bit(key, rng):
    arm = catalogue()[key].arm
    T = np.asarray(arm.fk(rng.uniform(-3, 3, 6)))
    first, second = solve_general(arm, T), solve_general(arm, T.copy())
    assert first.q.tobytes() == second.q.tobytes()
    assert first.reason == second.reason
    keys = np.round(first.q, 6)
    assert [tuple(row) for row in keys] == sorted(tuple(row) for row in keys)
    assert (first.q > -math.pi).all()
    assert (first.q <= math.pi).all()


def test_a_batch_gives_what_single_calls_give(rng):
    arm = catalogue()["manseur_doty"].arm
    poses = [np.asarray(arm.fk(rng.uniform(-3, 3, 6))) for _ in range(6)] + [np.eye(4)]
    for found, T in zip(solve_general_batch(arm, poses), poses, strict=True):
        assert same_set(arm, found.q, solve_general(arm, T).q)
    assert solve_general_batch(arm, []) == []


def test_errors_are_those_of_the_forward_kinematics(rng):
    arm = catalogue()["manseur_doty"].arm
    found = solve_general(arm, arm.fk(rng.uniform(-3, 3, 6)))
    assert found.position_error.max() < 1e-12
    assert found.rotation_error.max() < 1e-12


@pytest.mark.parametrize("key", ["puma560", "ur5e", "irb140"])
@pytest.mark.parametrize(("gap", "tolerance"), [(1e-3, 1e-5), (1e-5, 1e-6)])
def test_just_beside_a_singular_pose_nothing_is_lost(key, gap, tolerance, rng):
    """A nearly straight elbow: two branches about twice the gap apart, which may count as one where it is tiny."""
    arm = catalogue()[key].arm
    for _ in range(4):
        q = rng.uniform(-2, 2, 6)
        q[2] = straight(arm) + gap
        found = solve_general(arm, tool_by_products(arm, q))
        assert contains(arm, found.q, q, tolerance)
        assert worst_error(arm, found.q, tool_by_products(arm, q)) < 1e-9


def straight(arm):
    """Return the value of joint 3 that stretches the arm: where the wrist is farthest from axis 2."""
    angles = np.linspace(-math.pi, math.pi, 20001)
    frames = np.asarray(arm.frames(np.column_stack([np.zeros((len(angles), 2)), angles, np.zeros((len(angles), 3))])))
    far = np.linalg.norm(frames[:, 4, :3, 3] - frames[:, 1, :3, 3], axis=1)
    return float(angles[np.argmax(far)])


def test_a_family_and_what_stands_for_it():
    arm = catalogue()["puma560"].arm
    T = np.asarray(arm.fk([0.3, 0.5, -0.9, 0.4, 0.0, -0.6]))
    found = solve_general(arm, T)
    assert found.completeness == "infinite"
    assert len(found.families) >= 1
    for curve in found.families:
        assert len(curve) > 10
        assert worst_error(arm, curve, T) < 1e-9
        assert np.linalg.norm(np.diff(curve, axis=0), axis=1).max() < 0.75
    assert "a curve of singular configurations" in found.reason


def test_a_long_curve_that_closes_is_given_once_around():
    """Four joints turn and turn back on a way of 25 rad: further than one goes in one direction to see it close."""
    numbers = [(-0.82, 0.0, 0.12), (0.92, -H, 0.0), (0.0, -H, 0.0), (0.88, 0.0, 0.0), (0.0, H, 0.0), (0.5, -H, 0.0)]
    arm = Arm.from_dh([("R", a, alpha, d, 0.0) for a, alpha, d in numbers], task="pose")
    T = np.asarray(arm.fk([0.0, -H, 0.0, math.pi, 0.0, -H]))
    found = solve_general(arm, T)
    assert (found.completeness, len(found.families)) == ("infinite", 2)
    for curve in found.families:
        assert worst_error(arm, curve, T) < 1e-10
        apart = np.linalg.norm((curve[:, None] - curve + math.pi) % (2 * math.pi) - math.pi, axis=2)
        around = np.append(np.diagonal(apart, 1), apart[-1, 0])
        # One step is 0.35 rad and the last, which closes the curve, up to twice as long.
        assert around.max() < 0.7
        assert 22.0 < around.sum() < 30.0
        assert apart[np.triu_indices(len(curve), 1)].min() > 0.3


def test_an_arm_of_fewer_than_six_freedoms():
    """Four parallel axes: what it reaches, it reaches in infinitely many ways."""
    rows = [("R", 0.5, 0.0, 0.1, 0.0), ("R", 0.4, 0.0, 0.0, 0.0), ("R", 0.3, 0.0, 0.0, 0.0), ("R", 0.2, H, 0.0, 0.0)]
    arm = Arm.from_dh([*rows, ("R", 0.1, H, 0.1, 0.0), ("R", 0.1, 0.0, 0.1, 0.0)], task="pose")
    q = np.array([0.3, -0.5, 0.8, 0.2, -0.4, 0.6])
    T = np.asarray(arm.fk(q))
    found = solve_general(arm, T)
    assert found.completeness == "infinite"
    assert worst_error(arm, found.q, T) < 1e-9


def test_out_of_reach_is_said_with_a_length():
    arm = catalogue()["manseur_doty"].arm
    T = np.eye(4)
    T[0, 3] = 1e6
    found = solve_general(arm, T)
    assert len(found) == 0
    assert found.completeness == "complete"
    assert "farther" in found.reason
    assert " m" in found.reason


def test_no_lengths_at_all(rng):
    """Six turns about one point: the place is fixed, the orientation has infinitely many."""
    arm = Arm.from_dh([("R", 0.0, alpha, 0.0, 0.0) for alpha in (H, 0.4, H, -0.7, H, 0.0)], task="pose")
    found = solve_general(arm, arm.fk(rng.uniform(-3, 3, 6)))
    assert found.completeness == "infinite"
    elsewhere = np.asarray(arm.fk(np.zeros(6))).copy()
    elsewhere[:3, 3] += 0.2
    assert len(solve_general(arm, elsewhere)) == 0


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda arm: solve_general(arm, np.full((4, 4), np.nan)), "T"),
        (lambda arm: solve_general(arm, np.diag([2.0, 1.0, 1.0, 1.0])), "T"),
        (lambda arm: solve_general(arm, np.eye(3)), "T"),
        (lambda arm: solve_general(arm, np.eye(4), tolerance=0.0), "tolerance"),
        (lambda arm: solve_general(arm, np.eye(4), tolerance=math.nan), "tolerance"),
        (lambda arm: solve_general_batch(arm, [np.eye(4), np.zeros((4, 4))]), "pose 2"),
        (lambda arm: solve_general_batch(arm, "poses"), "poses"),
        (lambda _: solve_general(catalogue()["stanford"].arm, np.eye(4)), "six revolute"),
        (lambda _: solve_general(catalogue()["panda"].arm, np.eye(4)), "six revolute"),
    ],
)
def test_bad_input_is_refused_in_words(call, words):
    with pytest.raises(InputError, match=words):
        call(catalogue()["manseur_doty"].arm)


def test_a_pass_that_misses_a_root_is_not_believed(monkeypatch):
    """The roots are counted: with one pair less than the arm has, others are asked."""
    arm = catalogue()["manseur_doty"].arm
    T = arm.fk(catalogue()["manseur_doty"].home)
    whole = solve_general(arm, T)
    assert len(whole) % 2 == 0
    roots = Search.roots

    def missing_two(self, hands, number):
        found = roots(self, hands, number)
        return [Roots(one.q[2:], one.regular[2:]) for one in found] if number == 0 else found

    monkeypatch.setattr(Search, "roots", missing_two)
    again = solve_general(arm, T)
    assert again.passes > whole.passes
    assert same_set(arm, again.q, whole.q)


def test_curves_are_followed_for_a_number_of_steps_in_all(monkeypatch):
    """Here the wrist is straight with the hand at either of two places; what is not followed is known to move."""
    arm = catalogue()["puma560"].arm
    T = arm.fk([0.0, H, H, 0.0, 0.0, 0.0])
    all_of_them = solve_general(arm, T)
    monkeypatch.setattr(general_family, "MOST_POINTS", 10)
    some = solve_general(arm, T)
    assert len(all_of_them.families) == 2
    assert len(some.families) == 1
    assert some.completeness == "infinite"


NEARLY_SPECIAL = {
    "like a PUMA": (
        [
            (-2.2237471266012685e-05, -1.5708635119827008, 0.0),
            (0.4318, 0.0, 0.1491),
            (0.0203, H, -2.0520849263699763e-05),
            (0.0, -1.5707937822095162, 0.4331),
            (0.0, 1.57088495087289, 8.64598816358434e-07),
            (1.4111216683114994e-05, 0.0, 0.05632087128658537),
        ],
        [math.pi, 0.0, 1.917, H, 0.0, 2.265],
    ),
    "like a UR": (
        [
            (0.0, 1.4148107936750662, 4.222260771451307e-11),
            (0.5326492705319354, 1.5710355056670862, -0.35448024799265765),
            (0.4, 1.5494572673448984e-05, 8.678123813458262e-08),
            (-0.35, 0.0, 0.5964061775313585),
            (0.0, -H, -0.09444644641884836),
            (-0.8888018923902659, 5.29674415145928e-10, 0.0),
        ],
        [0.0, math.pi, 0.0, H + 0.2, -0.5267952025863449, -0.4475341473890536],
    ),
}


@pytest.mark.parametrize("name", list(NEARLY_SPECIAL))
def test_roots_from_infinity_do_not_stand_for_those_that_nearly_merge(name):
    """A singular pose of a nearly special arm: as many regular roots as ever, and yet a solution is none of them."""
    links, q = NEARLY_SPECIAL[name]
    arm = Arm.from_dh([("R", *link, 0.0) for link in links])
    found = solve_general(arm, arm.fk(q))
    assert found.completeness != "complete" or contains(arm, found.q, np.array(q), 1e-3)
