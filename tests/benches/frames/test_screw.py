"""The screw motion between two poses: both ways, the film, typed screws, and what is refused."""

import math

import numpy as np
import pytest
from scipy.linalg import expm

from armlab.benches.frames.screw.clip import CLIP
from armlab.benches.frames.screw.examples import EXAMPLES, ChooseScrewExample
from armlab.benches.frames.screw.facts import FACTS
from armlab.benches.frames.screw.film import DURATION, STOPS, part_of, ways_of
from armlab.benches.frames.screw.state import (
    CLIP_KEY,
    KINDS,
    DragPose,
    MakeScrew,
    PlacePose,
    Screw,
    SetPoseAngle,
    SetPosePosition,
)
from armlab.benches.frames.screw.ui.numbers import verdict
from armlab.benches.frames.screw.ui.page import around
from armlab.benches.frames.screw.ui.scene import axis_ends, ways_lines
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.rotations import axis_angle, rotation_about, skew
from armlab.kin.transforms import inverse, transform
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.state import State, apply
from armlab.ui.format import capitalised
from support.arms import random_pose
from support.done import done
from support.filled import Filled

ROBOT = catalogue()["planar_2r"]


def opened(*commands):
    return done(State.initial(ROBOT), *commands)


def between(rng):
    """A state with two random poses."""
    return opened(DragPose("first", random_pose(rng), 1), DragPose("second", random_pose(rng), 2))


def test_both_ways_begin_and_end_at_the_poses(rng):
    for _ in range(5):
        state = between(rng)
        found, part = state.derived(ways_of), state[Screw]
        for way in (found.at, found.straight):
            np.testing.assert_allclose(way(0.0), part.pose("first"), rtol=0, atol=1e-12)
            np.testing.assert_allclose(way(1.0), part.pose("second"), rtol=0, atol=1e-9)


def test_the_screw_is_the_exponential_of_its_twist_and_turns_as_slerp_does(rng):
    state = between(rng)
    found = state.derived(ways_of)
    bracket = np.zeros((4, 4))
    bracket[:3, :3], bracket[:3, 3] = skew(found.screw.twist[3:]), found.screw.twist[:3]
    s = np.linspace(0.0, 1.0, 7)
    for share, on_screw, straight in zip(s, found.at(s), found.straight(s), strict=True):
        np.testing.assert_allclose(on_screw, expm(share * bracket) @ found.first, rtol=0, atol=1e-10)
        np.testing.assert_allclose(straight[:3, :3], on_screw[:3, :3], rtol=0, atol=1e-9)


@pytest.mark.parametrize("yaws", [(30.0, 210.0), (90.0, -90.0), (180.0, 0.0), (-30.0, 150.0)])
def test_by_half_a_turn_both_ways_turn_in_the_same_sense(yaws):
    poses = (transform(rotation_about("z", math.radians(yaw)), [0.3 * k, 0.0, 0.1]) for k, yaw in enumerate(yaws))
    found = opened(*(DragPose(name, pose, 1) for name, pose in zip(("first", "second"), poses, strict=True)))
    ways, s = found.derived(ways_of), np.linspace(0.0, 1.0, 9)
    np.testing.assert_allclose(ways.straight(s)[:, :3, :3], ways.at(s)[:, :3, :3], rtol=0, atol=1e-12)
    np.testing.assert_allclose(ways.straight(1.0), found[Screw].pose("second"), rtol=0, atol=1e-9)


def test_the_way_of_the_origin_is_as_long_as_its_strokes(rng):
    found = between(rng).derived(ways_of)
    points = found.at(np.linspace(0.0, 1.0, 2001))[:, :3, 3]
    strokes = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    assert found.length == pytest.approx(strokes, rel=1e-5)
    assert found.chord <= found.length
    radii = np.linalg.norm(points - np.array([found.screw.foot(p) for p in points]), axis=1)
    np.testing.assert_allclose(radii, found.radius, rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    ("key", "kind"),
    [
        ("general", "screw"),
        ("bolt", "screw"),
        ("door", "rotation"),
        ("slide", "translation"),
        ("half", "screw"),
        ("same", "none"),
    ],
)
def test_examples_are_of_all_kinds_and_stay_until_a_pose_moves(key, kind):
    assert set(EXAMPLES) == {"general", "bolt", "door", "slide", "half", "same"}
    state = opened(ChooseScrewExample(key))
    assert state.derived(ways_of).screw.kind == kind
    assert capitalised(KINDS[kind]) in str(verdict(state))
    assert ("opposite axis is as good" in str(verdict(state))) == (key == "half")
    assert apply(state, Set(Screw, "straight", False))[Screw].example == key
    assert apply(state, SetPosePosition("first", 0, 0.77))[Screw].example == ""


def test_only_where_the_paths_differ_the_page_says_so():
    page = Filled("screw")
    assert "Only the positions differ" in page.text
    page.fill("example", "bolt")
    assert "The origin is on the axis, so that both paths are the same." in page.text
    assert "Only the positions differ" not in page.text


def test_the_origin_of_a_bolt_moves_on_its_axis_and_a_door_on_a_quarter_of_a_circle():
    bolt = opened(ChooseScrewExample("bolt")).derived(ways_of)
    assert bolt.radius == pytest.approx(0.0, abs=1e-12)
    assert bolt.length == pytest.approx(bolt.chord)
    door = opened(ChooseScrewExample("door")).derived(ways_of)
    assert door.length == pytest.approx(0.8 * math.pi / 2)
    np.testing.assert_allclose(door.foot, [0.0, 0.0, 0.2], rtol=0, atol=1e-12)


def test_a_typed_screw_puts_pose_2_where_it_brings_pose_1(rng):
    for direction, point in rng.normal(size=(5, 2, 3)):
        state = opened(MakeScrew(tuple(direction), tuple(point), 1.2, 0.3))
        screw = state.derived(ways_of).screw
        np.testing.assert_allclose(screw.direction, direction / np.linalg.norm(direction), rtol=0, atol=1e-9)
        np.testing.assert_allclose(screw.foot(point), point, rtol=0, atol=1e-9)
        assert screw.angle == pytest.approx(1.2, abs=1e-9)
        assert screw.distance == pytest.approx(0.3, abs=1e-9)
        assert state[Screw].axis == tuple(direction)
        assert state[Screw].pose("first").tolist() == opened()[Screw].pose("first").tolist()


def test_half_a_turn_typed_in_radians_is_one_about_the_axis_that_was_typed():
    page = Filled("screw")
    page.do(Set(Notation, "angle", "rad"), MakeScrew((0.0, 0.0, 1.0), (0.1, 0.0, 0.0), 1.0, 0.2))
    page.fill("screw angle", "3.1416")
    assert page.state.derived(ways_of).screw.half_turn
    assert "At half a turn the opposite axis is as good" in page.text
    np.testing.assert_allclose(page.state.derived(ways_of).screw.direction, [0.0, 0.0, 1.0], atol=1e-12)


def test_the_film_goes_at_an_even_rate_and_begins_again_when_a_pose_is_moved():
    state = opened(OpenClip(CLIP_KEY), Seek(1.0))
    assert part_of(state) == 0.25
    turned = axis_angle((state.derived(ways_of).at(0.25) @ inverse(state[Screw].pose("first")))[:3, :3])[1]
    assert turned == pytest.approx(0.25 * state.derived(ways_of).screw.angle)
    assert CLIP.duration(state) == DURATION
    assert CLIP.stops(state) == STOPS
    assert apply(state, SetPosePosition("first", 0, 0.2))[Timeline].time == 0.0
    assert part_of(opened()) == 0.5


def test_the_axis_is_drawn_through_the_feet_of_both_poses():
    found = opened(MakeScrew((0.0, 0.0, 1.0), (0.2, 0.1, 0.0), 1.0, -0.4)).derived(ways_of)
    low, high = axis_ends(found)
    np.testing.assert_allclose(low[:2], [0.2, 0.1], rtol=0, atol=1e-12)
    for pose in (found.first, found.second):
        assert low[2] < pose[2, 3] < high[2]


def test_the_straight_way_is_drawn_only_when_wanted_and_nothing_where_nothing_moves():
    found = opened().derived(ways_of)
    assert len(ways_lines(found, True)) > len(ways_lines(found, False)) > 10
    assert ways_lines(opened(ChooseScrewExample("same")).derived(ways_of), True) == []


def test_an_axis_far_away_is_not_brought_into_the_picture():
    near = around(
        opened(SetPoseAngle("second", 0, 0.0), SetPoseAngle("second", 1, 0.0), SetPoseAngle("second", 2, 1e-4))
    )
    assert np.abs(near).max() < 2.0


def test_facts_are_those_of_the_screw():
    h = math.sqrt(0.5)
    value = {key: fact.now(opened(ChooseScrewExample("door"))).value for key, fact in FACTS.facts.items()}
    assert value["kind"] == "rotation"
    assert value["pitch"] == pytest.approx(0.0, abs=1e-12)
    np.testing.assert_allclose(value["direction"], [0, 0, 1], rtol=0, atol=1e-12)
    np.testing.assert_allclose(np.reshape(value["pose"], (4, 4))[:3, 3], [0.8 * h, 0.8 * h, 0.2], rtol=0, atol=1e-12)
    slide = {key: fact.now(opened(ChooseScrewExample("slide"))).value for key, fact in FACTS.facts.items()}
    assert (slide["pitch"], slide["direction"], slide["angle"]) == (None, None, 0.0)
    assert slide["distance"] == pytest.approx(slide["chord"])
    assert slide["apart"] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (MakeScrew((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 1.0, 0.0), "zero has no direction"),
        (MakeScrew((0.0, 0.0, 1.0), (1e6, 0.0, 0.0), 1.0, 0.0), "point, x: expected at most 100 m either way"),
        (MakeScrew((0.0, 0.0, 1.0), (0.0, 0.0, 0.0), 1e3, 0.0), "angle: expected at most 3600° either way"),
        (MakeScrew((0.0, 0.0, 1.0), (0.0, 0.0, 0.0), 1.0, 1e6), "distance, z: expected at most 200 m either way"),
        (
            MakeScrew((0.0, 0.0, 1.0), (0.0, 0.0, 0.0), 1.0, 150.0),
            "pose 2, z: expected at most 100 m either way, got 150.1 m",
        ),
        (SetPosePosition("3", 0, 1.0), "pose: unknown name '3'"),
        (SetPosePosition("first", 3, 1.0), "axis: expected index 0 to 2"),
        (SetPoseAngle("first", 0, 1e9), "angles1"),
        (PlacePose("first", (1.0, 2.0), (0.0, 0.0, 0.0)), "position1"),
        (ChooseScrewExample("x"), "x"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    with pytest.raises(InputError, match=told):
        command.apply(opened())
