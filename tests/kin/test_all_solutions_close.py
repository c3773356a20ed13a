"""Solutions very near one another: one or two, told from how exactly each is known."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.ik.general_6r import search_of
from armlab.kin.ik.general_merge import merged
from armlab.kin.ik.problem import REACHED_M
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.rotations import rotation_from_axis_angle
from support.solutions import contains, no_duplicates, worst_error

H = math.pi / 2


def of_table(numbers):
    return Arm.from_dh([("R", a, alpha, d, 0.0) for a, alpha, d in numbers], task="pose")


NEARLY_KNOWN = {
    # Structured arms, moved by 1e-10, 1e-9 and 1e-4, at multiples of 90 degrees; and how far apart solutions are that
    # are known at least so well.
    "two singular values, 4e-7 and 3e-11": (
        [
            (-0.0400809192610585, -1.5707963267109797, -0.24235932279014882),
            (-0.4610572862673297, 3.841542942057574e-11, -0.43188722150592374),
            (1.6523815998483737e-11, 1.5707963268488523, -0.038040082080168056),
            (-0.6720311376386341, 3.332792867747665e-11, 0.738813683571708),
            (-4.8602002951561833e-11, -1.5707963268017455, 0.3031504827555952),
            (0.6247705272970617, 1.5707963268214042, 4.970894704734468e-11),
        ],
        [0.0, -H, -H, H, -H, 0.0],
        1e-5,
    ),
    "an error of 4e-15 and a singular value of 2e-11": (
        [
            (0.5552866879459596, 9.463654226038832e-11, 0.36840376982971196),
            (-0.27711995157523317, 1.5707963264464584, 1.331087466200953e-10),
            (9.641114023630417e-10, -1.5707963260805982, -2.0156012151649663e-10),
            (-3.170740483057082e-10, 1.5707963263302414, -0.6717329553003861),
            (0.06025746447538742, -2.6885311959052306e-10, 9.876307062426153e-10),
            (0.13065588503245723, -1.5707963271256482, 0.22635742650831098),
        ],
        [0.0, 0.0, 0.0, math.pi, -H, math.pi],
        3e-4,
    ),
    "an error of 3e-14 and a singular value of 2e-8": (
        [
            (0.22418506708376726, -1.5708291373749224, -3.776435855409315e-05),
            (-8.820163908305634e-05, -1.5708585037835798, 1.0259481503047763e-05),
            (0.16451769042455067, -1.5707380715289352, 2.6512903617361607e-05),
            (2.165754571564531e-05, -1.5707993216838254, 4.6470504366867174e-05),
            (0.43107330696530527, -1.5707694351018417, 7.684038112863538e-05),
            (7.590594773494095e-05, 1.5708157539404632, 6.284316170299655e-05),
        ],
        [-H, 0.0, math.pi, 0.0, math.pi, math.pi],
        1e-5,
    ),
}


@pytest.mark.parametrize("case", NEARLY_KNOWN)
def test_two_candidates_nearer_than_they_are_known_are_one(case):
    numbers, q, known = NEARLY_KNOWN[case]
    arm = of_table(numbers)
    assert no_duplicates(arm, solve_all(arm, arm.fk(q)).q, known)


def test_a_pair_with_an_error_of_some_ten_roundings_between_its_solutions_is_one():
    """Half-way between them, 1e-6 rad apart, the error is 1e-14 in one formula and 4e-15 in another."""
    arm = catalogue()["tx60"].arm
    q = [0.3853182584074588, -1.2461134283067985, 2.3360696777868504, 5.171900065522819, -2.197785950162865,
         1.559804850957249]  # fmt: skip
    found = solve_all(arm, arm.fk(q))
    assert no_duplicates(arm, found.q, 1e-5)
    assert len(found) == 4


def test_a_nearly_straight_hand_of_parallel_axes_hides_nothing_that_counts_as_reached():
    """The rotation has eight decimals: at q5 = pi it is 4e-9 rad off, q6 is anything, and one value led nowhere."""
    arm = catalogue()["ur10"].arm
    q = [1.5363352692408379, 3.0723719796660065, -0.7673759781203864, -1.1900623668438737, math.pi,
         -0.18642657778328386]  # fmt: skip
    T = np.array([
        [-0.0091713, -0.03321117, -0.99940628, -0.03039267],
        [-0.2660299, -0.96334885, 0.03445424, 1.0995564],
        [-0.96392115, 0.26618794, 0.0, -0.39082141],
        [0.0, 0.0, 0.0, 1.0],
    ])  # fmt: skip
    found = solve_all(arm, T)
    assert found.completeness == "infinite"
    assert worst_error(arm, found.q, T) < REACHED_M
    assert (np.abs(np.sin(found.q[:, 0] - q[0])) < 1e-5).any()


@pytest.mark.parametrize("robot", ["puma560", "stanford", "unimate"])
def test_a_nearly_straight_wrist_hides_nothing_that_counts_as_reached(robot):
    """The hand is turned a little out of the pose in which axes 4 and 6 are one line: any q4 still reaches it."""
    arm, rng = catalogue()[robot].arm, np.random.default_rng(3)
    for _ in range(12):
        q = rng.uniform(*arm.limits.T)
        q[4] = 0.0
        T = np.array(arm.fk(q))
        T[:3, :3] = rotation_from_axis_angle(rng.normal(size=3), 10.0 ** rng.uniform(-9.0, -6.1)) @ T[:3, :3]
        assert arm.fk(q) == pytest.approx(T, abs=REACHED_M)
        assert solve_all(arm, T).completeness == "infinite"


def test_two_candidates_with_a_third_solution_half_way_are_two():
    """Where families cross: half-way between them the error is rounding, but not on the way there."""
    arm = catalogue()["puma560"].arm
    loop = search_of(arm).loop
    hand = loop.hands(np.asarray(arm.fk([math.pi, math.pi, H, H, math.pi, -H])))
    some = np.array([
        [3.14159265358977, 3.141592653589964, H, -3.005220605214394, 3.1415926535899654, 0.13637204837539896],
        [3.14159265238727, 3.1415926624783945, H, -3.0071208636563798, 3.1415926625593693, 0.13447178993341363],
    ])  # fmt: skip
    assert len(merged(loop.links, some, hand)) == 2


THREE_IN_A_ROW = {
    # Structured arms, moved by 1e-8 and 1e-5; joint values of a pose; and of its solutions one that is hidden.
    "1e-4 apart": (
        [
            (0.8020572059690918, 4.713138215271331e-09, 0.4283634411315882),
            (-6.169758244493151e-10, 1.5707963175004878, -1.5649373700454805e-09),
            (-0.9088501023787844, 7.3673677994096475e-09, 0.7382492860929672),
            (9.640885849807528e-09, -1.5707963186001221, -8.533565809689871e-09),
            (8.146931355520496e-09, 1.5707963299709353, 0.9593285867747068),
            (1.321580418116386e-09, -4.936756842742214e-09, 7.120658004758296e-09),
        ],
        [math.pi, -H, math.pi, 0.0, 0.0, math.pi],
        [math.pi, -H, math.pi, 0.0, 0.0, math.pi],
    ),
    "5e-5 apart": (
        [
            (0.8020540926074092, 9.129529178228187e-06, 0.4283573111627934),
            (-9.037063895202582e-06, 1.5707991748243322, 4.295491813450408e-06),
            (-0.9088493135888012, 3.554797658628717e-07, 0.7382401986201755),
            (1.4928574537549167e-06, -1.5708058305855264, -7.032942867416987e-06),
            (5.780121466087256e-06, 1.5707942472985714, 0.9593254362813863),
            (9.802911489391445e-06, -7.559101487726237e-06, 6.277583351833824e-06),
        ],
        [-H, -H, H, -H, math.pi, math.pi],
        [-1.5707954880341726, -1.5707967367234201, 1.5709518091589691, -1.5708048789543112, 3.1415922258484454,
         -3.1414457233822874],
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", THREE_IN_A_ROW)
def test_of_three_solutions_in_a_row_the_middle_one_is_listed(case):
    """All three are ends of roots: two of them listed are not all. Known to rounding over singular values of 5e-9."""
    numbers, q, hidden = THREE_IN_A_ROW[case]
    arm = of_table(numbers)
    found = solve_all(arm, arm.fk(q))
    assert found.completeness == "complete"
    assert contains(arm, found.q, np.array(hidden), 1e-6)
