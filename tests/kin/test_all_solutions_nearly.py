"""Poses that are reached by a family only within what counts as reached: its members are solutions, too."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.ik.nearly_still import slack_ways
from armlab.kin.ik.problem import REACHED_M
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.rotations import rotation_from_axis_angle
from support.solutions import apart, no_duplicates, worst_error


def pushed(arm, q, size):
    """Return the pose of a singular configuration, moved by a size (m and rad) in the way the tool cannot take."""
    T = np.array(arm.fk(q))
    way = size * np.linalg.svd(np.asarray(arm.jacobian(q)))[0][:, -1]
    angle = float(np.linalg.norm(way[3:]))
    T[:3, 3] += way[:3]
    T[:3, :3] = rotation_from_axis_angle(way[3:] / angle, angle) @ T[:3, :3]
    return T


STRAIGHT = {
    # Wrists that are straight, pushed off that: where the shoulder or the elbow is nearly singular as well, the exact
    # solutions are bent by up to 1e-3, and every q4 comes as near as q.
    "puma560": ([2.2701957216650626, -0.27489464934747004, 1.3841055814401633, 1.9246870860045333, math.pi,
                 0.5186103294369053], 3.7e-7),
    "tx60": ([-1.5558364893755092, 2.0489510362005237, 2.0727633501115728, 2.0994607631624476, math.pi,
              1.2199785108824868], -2.55e-7),
    "kr6r900": ([-2.519925276796826, -0.5024941702522718, 3.2247338854782344, 0.48421046880382246, 4.5e-10,
                 -2.0940024768599734], -6.17e-9),
    "irb120": ([1.67698796705371, 6.095241726243169, -0.9922290325485698, -1.3051751141703698, 1.7e-7,
                1.4652685416968634], 5.33e-8),
    "ur10": ([-2.7646173288242895, 2.521533594761761, -1.699726495094694, -2.7498714837666296, math.pi,
              -0.36316109977612543], 9.76e-9),
    "ur10e": ([0.3647438442622801, 2.3163536725667413, -1.5061231641560122, 2.5324338552220107, math.pi,
               -0.9869873238684117], 1.77e-7),
}  # fmt: skip


@pytest.mark.parametrize("robot", STRAIGHT)
def test_a_pose_beside_a_straight_wrist_is_reached_with_any_turn_of_it(robot):
    q, size = STRAIGHT[robot]
    arm = catalogue()[robot].arm
    T = pushed(arm, q, size)
    found = solve_all(arm, T)
    assert found.completeness == "infinite"
    assert worst_error(arm, found.q, T) < REACHED_M
    assert "stays within what counts as reached" in found.sentence


def test_a_straight_wrist_under_a_nearly_singular_shoulder_hides_no_turn_of_it():
    """The exact solutions are 4e-4 rad away in q1, and slack in two directions that mix with the wrist."""
    arm = catalogue()["tx60"].arm
    q = [-2.4635735219684283, -0.1966843404807852, 6.663714547257431, 1.1174279178176043, math.pi, -0.8535382783192214]
    T = np.array(arm.fk(q))
    T[:3, 3] += [5.6e-10, -1.667e-9, -2.571e-9]
    found = solve_all(arm, T)
    assert found.completeness == "infinite"
    assert worst_error(arm, found.q, T) < REACHED_M


def test_two_singular_values_that_are_small_together_need_no_slack_direction():
    """Nor does the step that is looked for lead anywhere: both are 4e-3 of the largest."""
    assert slack_ways(np.empty((0, 6))).shape == (0, 6)


def test_where_a_straight_wrist_hides_that_an_elbow_is_stretched_too_far_something_is_found():
    """Joints 2 to 4 are stretched and pushed out by 4e-7; the values of joint 6 that follow from the wrist lead far
    out of their reach."""
    arm = catalogue()["ur10e"].arm
    q = [2.1181330380869356, 2.569508506288174, -1.9135084382442347, 3.0314903538719107, -0.017895268607315717,
         1.1261033635917608]  # fmt: skip
    T = pushed(arm, q, -4.17e-7)
    found = solve_all(arm, T)
    assert len(found) > 0
    assert worst_error(arm, found.q, T) < REACHED_M
    assert found.completeness != "complete" or apart(arm, found.q, np.array(q)).min() < 1e-2


@pytest.mark.parametrize("robot", ["elbow_3r", "planar_2r"])
def test_a_point_beside_the_first_axis_is_reached_with_any_turn_about_it(robot):
    arm = catalogue()[robot].arm
    q = np.array([0.4, 1.2, 0.0][: arm.n]) if arm.n == 3 else np.array([0.4, math.pi])
    if arm.n == 3:
        # The elbow that puts the tool above the axis: a zero of its distance, bisected.
        low, high = 0.0, math.pi
        first = across(arm, q, low)
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if across(arm, q, middle) * first > 0.0 else (low, middle)
        q[2] = low
    T = np.array(arm.fk(q))
    T[:2, 3] += 4e-7 * np.array([math.cos(2.0), math.sin(2.0)])
    found = solve_all(arm, T)
    assert found.completeness == "infinite"
    assert worst_error(arm, found.q, T) < REACHED_M


def across(arm, q, elbow):
    """Return how far in front of the first axis the tool is, on the side joint 1 looks to."""
    p = np.asarray(arm.fk([q[0], q[1], elbow]))[:2, 3]
    return float(p @ [math.cos(q[0]), math.sin(q[0])])


def test_a_list_of_a_family_has_no_member_twice():
    """Joint 6 is nearly free: two of its values led to the same one, 7e-9 rad apart."""
    arm = catalogue()["ur3e"].arm
    q = [0.48749603562964416, 0.994820509859469, 2.7065162753816052e-09, 1.8258013204786872, 3.5254726515115277e-09,
         -1.3909174775003499]  # fmt: skip
    found = solve_all(arm, arm.fk(q))
    assert found.completeness == "infinite"
    assert no_duplicates(arm, found.q, 1e-6)


def test_what_stands_still_exactly_is_said_to_do_so():
    arm = catalogue()["puma560"].arm
    found = solve_all(arm, arm.fk(np.radians([0.0, 0.0, 90.0, 0.0, 0.0, 0.0])))
    assert found.completeness == "infinite"
    assert "while the tool stands still" in found.sentence
    assert "counts as reached" not in found.sentence
