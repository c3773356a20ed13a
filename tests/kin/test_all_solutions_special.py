"""What is said of all solutions at special poses and of special arms: complete, infinitely many, none. All true."""

import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.ik.general_6r import search_of, solve_general
from armlab.kin.ik.problem import REACHED_M, REACHED_RAD
from armlab.kin.ik.solve import solve
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.rotations import rotation_from_axis_angle
from support.solutions import apart, contains, no_duplicates, worst_error

H = math.pi / 2


def moved(arm, size, rng):
    """Return an arm with every number of its table moved by about ``size``."""
    rows = [
        (row.kind, *(np.array([row.a, row.alpha, row.d, row.theta]) + size * rng.normal(size=4))) for row in arm.rows
    ]
    return Arm.from_dh(rows, arm.convention, base=arm.base, tool=arm.tool, task="pose")


def structured(rng):
    """Return a 6R with quarter-turn twists and half of its lengths zero that moves its tool in every way."""
    while True:
        numbers = rng.uniform(-1.0, 1.0, (6, 2)) * (rng.random((6, 2)) > 0.5)
        rows = [("R", a, float(rng.choice([0.0, H, -H])), d, 0.0) for a, d in numbers.tolist()]
        arm = Arm.from_dh(rows, task="pose")
        if np.linalg.svd(np.asarray(arm.jacobian(rng.uniform(-3.0, 3.0, 6))), compute_uv=False)[-1] > 1e-2:
            return arm


def is_true(arm, q, found, T):
    """Assert that an answer does not contradict the configuration the pose was made of, nor itself."""
    assert found.completeness != "none"
    assert worst_error(arm, found.q, T) < REACHED_M
    assert no_duplicates(arm, found.q, 1e-9)
    if found.completeness == "complete":
        # Where k solutions merge, rounding moves them by its k-th root.
        assert apart(arm, found.q, q).min() < 1e-3


@pytest.mark.parametrize("key", ["puma560", "tx60", "manseur_doty", "ur5e", "irb120", "kr6r900"])
def test_quarter_turns_everywhere(key):
    arm, rng = catalogue()[key].arm, np.random.default_rng(90)
    for _ in range(6):
        q = rng.integers(-2, 3, 6) * H
        T = np.asarray(arm.fk(q))
        is_true(arm, q, solve_all(arm, T), T)


def test_the_straight_wrist_under_a_singular_shoulder_is_not_hidden():
    """A double root, torn apart by rounding, once hid q5 = 0."""
    arm = catalogue()["puma560"].arm
    q = np.radians([0.0, 0.0, 90.0, 0.0, 0.0, 0.0])
    found = solve_all(arm, arm.fk(q))
    assert found.completeness == "infinite"
    near = [np.abs((curve - q + math.pi) % (2 * math.pi) - math.pi).max(axis=1).min() for curve in found.families]
    assert contains(arm, found.q, q, 0.3) or min(near) < 0.3


def test_the_arm_of_sixteen_with_its_first_joint_at_zero():
    arm, rng = catalogue()["manseur_doty"].arm, np.random.default_rng(1)
    for _ in range(12):
        q = np.array([0.0, *rng.uniform(-3.0, 3.0, 5)])
        found = solve_all(arm, arm.fk(q))
        assert found.completeness == "complete"
        assert contains(arm, found.q, q, 1e-5)


@pytest.mark.parametrize("size", [1e-3, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10])
def test_two_neighbouring_axes_nearly_one_line(size):
    """What moves the tool by less than what counts as reached is a family; nothing of it is unreachable."""
    rng = np.random.default_rng(int(-math.log10(size)))
    for _ in range(3):
        rows = [
            ["R", *rng.uniform(-1.0, 1.0, 1), rng.uniform(-3.0, 3.0), rng.uniform(-1.0, 1.0), 0.0] for _ in range(6)
        ]
        k = int(rng.integers(0, 5))
        rows[k][1] = rows[k][2] = size
        arm, q = Arm.from_dh(rows, task="pose"), rng.uniform(-3.0, 3.0, 6)
        T = np.asarray(arm.fk(q))
        found = solve_all(arm, T)
        is_true(arm, q, found, T)
        assert len(found) > 0


@pytest.mark.parametrize("size", [1e-2, 1e-4, 1e-6, 1e-7, 1e-8])
def test_arms_that_are_nearly_special(size):
    rng = np.random.default_rng(int(-math.log10(size)))
    for lattice in (False, False, False, True, True):
        arm = moved(structured(rng), size, rng)
        q = rng.integers(-2, 3, 6) * H if lattice else rng.uniform(-3.0, 3.0, 6)
        T = np.asarray(arm.fk(q))
        found = solve_all(arm, T)
        is_true(arm, q, found, T)
        if not lattice:
            assert found.completeness == "complete"


@pytest.mark.parametrize("key", ["puma560", "ur5e"])
@pytest.mark.parametrize("size", [1e-3, 1e-4])
def test_calibrated_arms_keep_their_proof(key, size):
    rng = np.random.default_rng(5)
    arm = moved(catalogue()[key].arm, size, rng)
    for _ in range(4):
        q = rng.uniform(-3.0, 3.0, 6)
        found = solve_all(arm, arm.fk(q))
        assert found.completeness == "complete"
        assert contains(arm, found.q, q)


@pytest.mark.parametrize("gap", [1e-2, 2e-4, 1e-5, 2e-6])
@pytest.mark.parametrize("key", ["puma560", "irb140"])
def test_two_solutions_near_each_other_are_two(key, gap):
    """An elbow that is bent by half the gap: the other solution is bent as much the other way."""
    arm, rng = catalogue()[key].arm, np.random.default_rng(3)
    angles = np.linspace(-math.pi, math.pi, 8, endpoint=False)
    frames = np.asarray(arm.frames(np.column_stack([np.zeros((8, 2)), angles, np.zeros((8, 3))])))
    far = np.linalg.norm(frames[:, 4, :3, 3] - frames[:, 1, :3, 3], axis=1)
    # The cosine law: the square of the distance is a constant plus a multiple of cos(q3 - straight).
    c, s = np.cos(angles) @ far**2, np.sin(angles) @ far**2
    for _ in range(3):
        q = rng.uniform(-1.5, 1.5, 6)
        q[4] = 0.7
        q[2] = math.atan2(s, c) + gap / 2.0
        found = solve_all(arm, arm.fk(q))
        assert contains(arm, found.q, q, gap / 10.0)
        away = np.sort(apart(arm, found.q, q))
        assert 0.3 * gap < away[1] < 5.0 * gap


def test_two_solutions_of_one_flat_valley_are_two():
    """Between them, 2e-5 rad apart, the error is 4e-13: a Newton step from there leads far out before it comes back."""
    table = [
        (0.0, H, 0.19163226741930317),
        (0.0, H, -0.19956488729206345),
        (0.4602996818173577, -H, 0.4695077009830575),
        (-0.07578421121243983, -H, 0.0),
        (0.0, -H, 0.7179613097248765),
        (-0.5748595284510465, 0.0, 0.41758501836741346),
    ]
    arm = Arm.from_dh([("R", a, alpha, d, 0.0) for a, alpha, d in table], task="pose")
    q = np.array([1.66921528508314, -0.00865982837418373, 1.4451241389555205, -1.935731540189043, 1.0418052026048263,
                  -1.0813376797164078])  # fmt: skip
    found = solve_all(arm, arm.fk(q))
    away = np.sort(apart(arm, found.q, q))
    # Known to the rounding over the singular value 1e-7.
    assert away[0] < 1e-7
    assert 1e-5 < away[1] < 1.5e-5


def test_two_solutions_that_rounding_hardly_tells_apart_are_one():
    """Half-way between them, 3e-7 rad apart, the error is some ten roundings."""
    numbers = [
        (8.033470360243704e-08, 1.570796387639008, 0.9070892516602884),
        (-0.4454345584080685, -1.5707963825687705, 6.595277493838439e-08),
        (0.2191217821695391, 1.5707962535123319, -3.062825405099281e-08),
        (0.9568093876655797, 1.5707962830279627, 1.8547568214099707e-08),
        (7.162917770693687e-08, -1.5707963144237262, -0.6812657106189365),
        (-0.3176568519686602, -1.5707962702330025, 6.236899167807265e-08),
    ]
    arm = Arm.from_dh([("R", a, alpha, d, 0.0) for a, alpha, d in numbers], task="pose")
    q = np.array([H, H, math.pi, -H, H, 0.0])
    found = solve_all(arm, arm.fk(q))
    assert (apart(arm, found.q, q) < 1e-3).sum() == 1


def test_a_wrist_that_is_straight_but_for_a_nanoradian_hides_nothing():
    """Its last angle then comes from parts of vectors of 1e-9, and here the elbow is nearly folded, too."""
    arm = catalogue()["ur10_notes"].arm
    q = np.array([-1.960795944164644, 2.05025386665724, 0.549362085116783, 4.476897910822949, -8.57e-10, -0.035])
    for wrist in (-8.57e-10, 2e-10, 1e-8, 3e-7):
        q[4] = wrist
        found = solve_all(arm, arm.fk(q))
        assert np.abs(found.q[:, 0] - q[0]).min() < 1e-6
        assert found.completeness != "complete" or contains(arm, found.q, q, 1e-4)


def test_where_two_solutions_merge_one_is_listed():
    arm = catalogue()["planar_2r"].arm
    assert len(solve_all(arm, arm.fk([0.4, 0.0]))) == 1


@pytest.mark.parametrize("key", ["planar_2r", "planar_2r_unequal", "elbow_3r"])
def test_a_pose_typed_with_eight_decimals_for_a_stretched_arm_is_reached_by_both(key):
    arm, rng = catalogue()[key].arm, np.random.default_rng(8)
    for _ in range(10):
        q = rng.uniform(-1.2, 1.2, arm.n)
        q[-1] = 0.0
        T = np.round(np.asarray(arm.fk(q)), 8)
        assert solve(arm, T, q).success
        found = solve_all(arm, T)
        assert contains(arm, found.q, q, 1e-3)
        assert worst_error(arm, found.q, T) < REACHED_M


@pytest.mark.parametrize("width", [1e-3, 3e-2])
def test_a_family_of_a_straight_wrist_is_shown_inside_narrow_limits(width):
    """Listed are members every 45 degrees; within a degree there is one that no list of them has."""
    arm, q = catalogue()["puma560"].arm, np.array([0.3, 0.4, 0.5, 0.37, 0.0, 0.2])
    narrow = replace(arm, limits=np.stack([q - 0.3 * width, q + 0.7 * width], axis=1))
    T = np.asarray(arm.fk(q))
    found = solve_all(narrow, T)
    assert found.completeness == "infinite"
    assert found.within_limits.any()
    assert worst_error(arm, found.q, T) < 1e-9


def test_a_double_root_at_a_limit_is_inside():
    """Rounding moves it by 1e-8, which is outside limits that end there."""
    arm, q = catalogue()["ur10e"].arm, np.radians([-45.0, 0.0, 180.0, -90.0, -90.0, -90.0])
    T = np.asarray(arm.fk(q))
    width = np.array([0.003, 0.03, 0.01, 0.02, 0.01, 0.03])
    for side in (0.0, 1.0):
        narrow = replace(arm, limits=np.stack([q - side * width, q + (1.0 - side) * width], axis=1))
        found = solve_all(narrow, T)
        assert found.within_limits.sum() == 1
        assert worst_error(arm, found.q, T) < 1e-9


@pytest.mark.parametrize("size", [1e-7, 4e-7, 5.5e-7, 6e-7])
def test_where_branches_merge_just_beyond_a_pose_every_one_of_them_is_listed(size):
    """Pushed off a stretched elbow by less than counts as reached, by a way and a turn at once; both shoulders."""
    arm = catalogue()["tx60"].arm
    q = np.array(
        [-1.0347946141629303, -2.2048536858479606, 0.0, -2.549761780868626, 0.52447204165695, 3.04035367923579]
    )
    T, L = np.asarray(arm.fk(q)).copy(), arm.length_scale
    lost = np.linalg.svd(np.asarray(arm.jacobian(q)) / np.repeat([L, 1.0], 3)[:, None])[0][:, -1]
    lost = lost * math.copysign(size, lost[:3] @ T[:3, 3])
    T[:3, 3] += L * lost[:3]
    T[:3, :3] = rotation_from_axis_angle(lost[3:] / np.linalg.norm(lost[3:]), np.linalg.norm(lost[3:])) @ T[:3, :3]
    found = solve_all(arm, T)
    assert len(found) == 4
    assert apart(arm, found.q, q).min() < 1e-3


def test_how_far_out_of_reach_is_said():
    arm = Arm.from_dh([("R", 1.0, 0, 0, 0)] * 2)
    for beyond, words in ((3e-6, "It is 3 µm out of reach."), (4e-4, "It is 400 µm out of reach.")):
        T = np.asarray(arm.fk([0.3, 0.0])).copy()
        T[:2, 3] *= 1.0 + beyond / 2.0
        found = solve_all(arm, T)
        assert found.completeness == "none"
        assert words in found.sentence


def test_one_meaning_of_reached():
    """Just inside and just outside of it `solve` and `solve_all` agree."""
    arm = Arm.from_dh([("R", 1.0, 0, 0, 0)] * 2)
    for share, there in ((0.9, True), (1.1, False)):
        T = np.asarray(arm.fk([0.3, 0.0])).copy()
        T[:2, 3] *= 1.0 + share * REACHED_M / 2.0
        assert solve(arm, T, [0.3, 0.0]).success is there
        assert (len(solve_all(arm, T)) > 0) is there
    assert REACHED_M == REACHED_RAD == 1e-6


@pytest.mark.parametrize(("key", "number"), [("puma560", 8), ("ur5e", 8), ("manseur_doty", 16)])
def test_the_roots_of_an_arm_are_counted(key, number):
    search = search_of(catalogue()[key].arm)
    assert search.number == number


def test_a_pose_out_of_reach_is_proven_to_be(rng):
    arm = catalogue()["manseur_doty"].arm
    T = np.asarray(arm.fk(rng.uniform(-3.0, 3.0, 6))).copy()
    T[:3, 3] *= 2.75 / np.linalg.norm(T[:3, 3])
    found = solve_general(arm, T)
    assert len(found) == 0
    assert found.completeness == "complete"
    assert "none of the 16 roots" in found.reason or "farther" in found.reason


def test_two_candidates_in_a_bent_valley_are_one():
    """Half-way between them on the chord, 5e-7 and 9e-7 rad long, the error is 4e-14; beside it, on the bottom of the
    valley, it is 1e-15, which is rounding: a fold with singular values below 1e-8."""
    arm = catalogue()["tx60"].arm
    q = [-0.4045992845285733, 0.0, 3.141592663589793, -0.8112381707979899, -1.5707962267948965, -0.22455290367118952]
    found = solve_all(arm, arm.fk(q))
    assert no_duplicates(arm, found.q, 1e-5)
    assert len(found) == 2
    table = [
        (-0.08164894549767343, -1.3960862490041916, -0.23958982875711232),
        (-0.4481703175767251, 2.72414464477818, -0.822768035887004),
        (-0.36095513399002144, -2.5516542789030465, 0.4335761935528073),
        (-0.7302647938052524, -1.6362102779183143, 0.9899355989714707),
        (-0.181407739539587, 1.3174899061591034, -0.5634029925320976),
        (-0.20044444216235768, -0.22609886254698575, -0.552116649338791),
    ]
    general = Arm.from_dh([("R", a, alpha, d, 0.0) for a, alpha, d in table], task="pose")
    q = [2.7525603928307563, 0.6148802560522587, -1.4497298833934595, -1.98710227505899, -1.6807366847255123,
         1.7549564054483504]  # fmt: skip
    assert no_duplicates(general, solve_all(general, general.fk(q)).q, 1e-5)


def test_what_the_closed_form_found_at_a_very_singular_pose_is_not_lost():
    """Elbow, shoulder and wrist nearly singular at once: descents come only near, elimination tells no roots apart."""
    arm = catalogue()["ur10"].arm
    q = [-2.2461968070543206, 2.1901561599257935, -2.8238331208783323, 2.618597687548411, 5.67139611151877e-05,
         -0.016039575711923583]  # fmt: skip
    found = solve_all(arm, arm.fk(q))
    assert len(found) > 0
    assert worst_error(arm, found.q, arm.fk(q)) < REACHED_M
    # Known to the rounding over the singular value 2e-10, along its direction.
    assert apart(arm, found.q, np.array(q)).min() < 1e-4 or found.completeness == "infinite"


def test_solutions_that_a_rounded_table_leaves_side_by_side_are_told_of():
    """At a fold of an arm whose angles are quarter and half turns but for their digits, and not their middle."""
    quarter, half = 1.57079633, 3.14159265
    rows = [
        ("R", 0.0, -quarter, 0.0, 0.0),
        ("P", -0.9949502207312069, half, -0.04297382714338105, quarter),
        ("R", 0.6378354636338068, 0.0, 0.0, 0.0),
        ("R", 0.0, quarter, -0.020751626075412144, 0.0),
        ("R", 0.0, -quarter, 0.0, 0.0),
        ("R", 0.0, 0.0, 0.7270563762827467, 0.0),
    ]
    arm = Arm.from_dh(rows, task="pose")
    q = [-0.9884440641598204, 0.0, 0.0, -2.384262991358076, 1.3920004051452022, 0.08037932330645559]
    found = solve_all(arm, arm.fk(q))
    assert found.completeness == "at least"
    assert np.round(found.q[:, 0], 6).tolist() == [-0.988444] * 2 + [2.152542] * 2 + [2.153755] * 2
    assert max(np.abs(arm.fk(row) - arm.fk(q)).max() for row in found.q) < 1e-9
