"""How neighbouring axes lie, and what is free."""

import math
import re

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.convert import converted
from armlab.kin.relations import axis_relations, end_freedoms
from support.arms import random_arm, random_q

H = math.pi / 2


def axes_of(arm, q):
    frames = arm.frames(q)
    frames = frames[:-1] if arm.convention == "standard" else frames[1:]
    return frames[:, :3, 3], frames[:, :3, 2]


def kind_seen(p1, z1, p2, z2, scale):
    """The relation of two lines from their points and directions."""
    normal = np.cross(z1, z2)
    if np.linalg.norm(normal) < 1e-9:
        return "coincident" if np.linalg.norm(np.cross(p2 - p1, z1)) < 1e-9 * scale else "parallel"
    return "intersecting" if abs((p2 - p1) @ normal) / np.linalg.norm(normal) < 1e-9 * scale else "skew"


def assert_seen(arm, rng):
    relations = axis_relations(arm)
    assert [(r.first, r.second) for r in relations] == [(i, i + 1) for i in range(1, arm.n)]
    for q in random_q(arm, rng, 4):
        p, z = axes_of(arm, q)
        for r in relations:
            i, j = r.first - 1, r.second - 1
            assert kind_seen(p[i], z[i], p[j], z[j], arm.length_scale) == r.kind
            assert (abs(z[i] @ z[j]) < 1e-9) == r.perpendicular
            assert z[i] @ z[j] == pytest.approx(math.cos(r.alpha), abs=1e-12)


def test_the_relations_are_those_of_the_axes_in_every_configuration(robot, rng):
    assert_seen(robot.arm, rng)


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("special", [False, True])
def test_the_relations_of_random_arms_are_those_of_their_axes(convention, special, rng):
    for n in (2, 4, 7):
        assert_seen(random_arm(rng, n, convention=convention, special=special), rng)


def test_both_conventions_see_the_same_axes(robot):
    other = converted(robot.arm, "modified" if robot.arm.convention == "standard" else "standard")
    mine, theirs = axis_relations(robot.arm), axis_relations(other)
    assert [(r.kind, r.a, r.alpha) for r in mine] == [(r.kind, r.a, r.alpha) for r in theirs]


@pytest.mark.parametrize(
    ("key", "kinds"),
    [
        ("planar_3r", ["parallel", "parallel"]),
        ("scara", ["parallel", "parallel", "coincident"]),
        ("stanford", ["intersecting", "intersecting", "coincident", "intersecting", "intersecting"]),
        ("puma560", ["intersecting", "parallel", "skew", "intersecting", "intersecting"]),
        ("ur10", ["intersecting", "parallel", "parallel", "intersecting", "intersecting"]),
    ],
)
def test_the_relations_of_known_arms(key, kinds):
    assert [relation.kind for relation in axis_relations(catalogue()[key].arm)] == kinds


def freedom(rows, convention="standard"):
    return axis_relations(Arm.from_dh(rows, convention))[0].freedom


def test_parallel_axes_leave_d_free():
    text = freedom([("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0)])
    assert text == (
        "z0 and z1 are parallel: they have infinitely many common normals, so the place of x1 along z0 is free; "
        "it is usually chosen so that d1 = 0."
    )


def test_intersecting_axes_leave_the_sense_of_x_free():
    text = freedom([("R", 0, H, 0.3, 0), ("R", 0.4, 0, 0, 0)])
    assert "z0 and z1 meet: a1 = 0 and x1 is parallel to z0 × z1 in either sense" in text
    assert "sign of α1" in text


def test_axes_in_one_line_define_only_sums_or_differences():
    text = freedom([("R", 0, 0, 0.3, 0), ("R", 0.4, 0, 0, 0)])
    assert "x1 may be any direction perpendicular to it" in text
    assert "only the sums of θ1 and θ2 and of d1 and d2" in text
    assert "only the differences of" in freedom([("R", 0, math.pi, 0.3, 0), ("R", 0.4, 0, 0, 0)])


def test_skew_axes_leave_only_the_sense_free():
    assert "exactly one common normal" in freedom([("R", 0.2, H, 0.3, 0), ("R", 0.4, 0, 0, 0)])


@pytest.mark.parametrize(("first", "second", "named"), [("P", "R", "Joint 1"), ("R", "P", "Joint 2")])
def test_the_place_of_a_slide_is_free(first, second, named):
    crossed = freedom([(first, 0.2, H, 0, 0), (second, 0, 0, 0, 0)])
    assert crossed == (
        f"{named} slides: only the direction of its axis matters, its place is free, so a1 may be chosen 0; "
        "x1 is parallel to z0 × z1 in either sense."
    )
    assert "x1 is then any direction perpendicular" in freedom([(first, 0.2, 0, 0, 0), (second, 0, 0, 0, 0)])


def test_a_parallel_slide_can_lie_on_one_of_its_neighbours_only():
    relations = axis_relations(catalogue()["scara"].arm)
    assert "a2 may be chosen 0, which fixes a3;" in relations[1].freedom
    assert "a3 may be chosen 0, which fixes a2;" in relations[2].freedom
    assert "which fixes" not in freedom([("R", 0.2, 0, 0, 0), ("P", 0, 0, 0, 0)])


@pytest.mark.parametrize(("a", "sign_of_a"), [(0.0, 1.0), (0.2, -1.0)])
def test_the_other_sense_of_x_changes_what_is_told(a, sign_of_a, rng):
    rows = [("R", a, 0.7, 0.3, 0.4), ("R", 0.4, 0.2, 0.1, 0.1)]
    told = freedom(rows)
    assert "sign" in told
    assert "turns θ1 and θ2 by 180°" in told
    other = [("R", sign_of_a * a, -0.7, 0.3, 0.4 + math.pi), ("R", 0.4, 0.2, 0.1, 0.1 + math.pi)]
    q = rng.uniform(-3, 3, 2)
    np.testing.assert_allclose(Arm.from_dh(other).fk(q), Arm.from_dh(rows).fk(q), rtol=0, atol=1e-12)


def test_of_a_slide_at_an_end_only_the_direction_is_told():
    arm = Arm.from_dh([("P", 0.1, H, 0, 0), ("R", 0.1, H, 0, 0), ("P", 0, 0, 0, 0)])
    assert "joint 1 slides, so z0 is parallel to it" in end_freedoms(arm)[0]
    assert "joint 3 slides, so z3 is parallel to it" in end_freedoms(converted(arm, "modified"))[1]


def test_two_slides_are_named_together():
    assert freedom([("P", 0, H, 0, 0), ("P", 0, 0, 0, 0)]).startswith("Joints 1 and 2 slide:")


def test_the_modified_convention_names_its_own_z():
    assert freedom([("R", 0, 0, 0, 0), ("R", 0.4, 0, 0, 0)], "modified").startswith("z1 and z2 are parallel")


def test_every_sentence_is_one_sentence(robot):
    for text in [r.freedom for r in axis_relations(robot.arm)] + list(end_freedoms(robot.arm)):
        assert re.fullmatch(r"[A-Zz][^.]*\.", text)


def test_the_ends_of_the_chain():
    arm = Arm.from_dh([("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0)])
    first, last = end_freedoms(arm)
    assert first.startswith("Frame 0: z0 lies on the axis of joint 1; the direction of x0")
    assert "z2 is free; x2 must meet z1, the axis of joint 2, at a right angle" in last
    first, last = end_freedoms(converted(arm, "modified"))
    assert "a0 = α0 = d1 = 0" in first
    assert "z2 lies on the axis of joint 2" in last
    assert "θ1 = 0" in end_freedoms(Arm.from_dh([("P", 0, 0, 0, 0)], "modified"))[0]


def test_a_nearly_parallel_pair_is_told_apart_at_the_tolerance():
    def kind(alpha, a):
        return axis_relations(Arm.from_dh([("R", a, alpha, 0, 0), ("R", 1.0, 0, 0, 0)]))[0].kind

    assert kind(math.pi - 1e-10, 1.0) == "parallel"
    assert kind(1e-8, 1.0) == "skew"
    assert kind(1e-8, 1e-10) == "intersecting"
    assert kind(0.0, 1e-8) == "parallel"
    assert kind(0.0, 1e-10) == "coincident"
