"""The regions of planar arms: the tool is told to be in one and moved into it, along its line; the target beside it."""

import math

import numpy as np
import pytest

from armlab.benches.workspace.dexterous.places import (
    GoToRegion,
    StandStretched,
    outermost,
    possible_joints,
    target_distance,
    tool_standing,
)
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.workspace.planar import lengths_of, orientations
from armlab.kin.workspace.planar_pose import Place, configurations, place_of
from armlab.kin.workspace.planar_regions import regions
from armlab.session.edits import SetLimits
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint, RandomPose
from armlab.session.parts.target import PlaceTarget
from armlab.session.state import State, apply


def state_of(key):
    """Return the state with an arm of the catalogue."""
    return State.initial(catalogue()[key])


@pytest.mark.parametrize("key", ["planar_2r", "planar_2r_unequal", "planar_3r", "planar_3r_unequal"])
def test_the_tool_goes_into_every_region_and_is_said_to_be_there(key):
    state = apply(state_of(key), RandomPose())
    found = regions(lengths_of(state[Joints].arm))
    for index, region in enumerate(found):
        now = apply(state, GoToRegion(index))
        assert tool_standing(now).region is region
        for way, signs in enumerate(region.ways):
            stretched = apply(now, StandStretched(index, way))
            assert tool_standing(stretched).region is region
            assert np.linalg.svd(stretched[Joints].arm.jacobian(stretched[Joints].q)[:2])[1][1] < 1e-9
            assert len(signs) == stretched[Joints].arm.n
    with pytest.raises(InputError, match="region"):
        apply(state, GoToRegion(len(found)))
    with pytest.raises(InputError, match="singular"):
        apply(state, StandStretched(0, 9))


def test_held_joints_are_not_moved_into_a_region_without_a_word():
    held = apply(apply(state_of("planar_3r"), MoveJoint(1, 1.0)), LockJoint(1, True))
    found = regions(lengths_of(held[Joints].arm))
    outside = max((i for i, region in enumerate(found) if region.ways), key=lambda i: found[i].high)
    with pytest.raises(InputError, match="held"):
        apply(held, GoToRegion(outside))
    with pytest.raises(InputError, match="joint 2 is held"):
        apply(held, StandStretched(outside, 0))


def test_every_region_that_the_limits_allow_on_the_line_of_the_tool_is_entered():
    state = apply(state_of("planar_3r"), SetLimits(2, -math.pi / 2, math.pi / 2))
    found = regions(lengths_of(state[Joints].arm))
    for q in ([0.2, 0.1, -0.1], [0.861, -1.446, -1.442], [-1.9, 2.9, 1.4]):
        state = state.replace(state[Joints].moved_to(q))
        for index, region in enumerate(found):
            assert tool_standing(apply(state, GoToRegion(index))).region is region


@pytest.mark.parametrize("held", [(0,), (1,), (2,), (0, 1), (0, 2), (1, 2)])
def test_a_region_is_entered_with_held_joints_where_they_allow_it(held):
    state = apply(state_of("planar_3r_unequal"), MoveJoint(1, 2.0))
    place = place_of(state[Joints].arm, state[Joints].q)
    for joint in held:
        state = apply(state, LockJoint(joint, True))
    entered = 0
    for index, region in enumerate(regions(lengths_of(state[Joints].arm))):
        try:
            now = apply(state, GoToRegion(index))
        except InputError:
            continue
        entered += 1
        assert tool_standing(now).region is region
        assert tool_standing(now).place.theta == pytest.approx(place.theta, abs=1e-6)
        np.testing.assert_array_equal(now[Joints].q[list(held)], state[Joints].q[list(held)])
    assert entered


def test_the_limits_are_told_where_they_keep_the_tool_out():
    state = apply(apply(state_of("planar_3r"), SetLimits(1, -0.2, 0.2)), SetLimits(2, -0.2, 0.2))
    with pytest.raises(InputError, match="joint limits"):
        apply(state, GoToRegion(0))


def test_the_tool_stays_on_its_line_when_it_changes_region():
    state = apply(state_of("planar_3r"), MoveJoint(0, 2.0))
    theta = place_of(state[Joints].arm, state[Joints].q).theta
    now = apply(state, GoToRegion(0))
    assert place_of(now[Joints].arm, now[Joints].q).theta == pytest.approx(theta, abs=1e-9)


def test_joint_3_can_be_where_the_arcs_say():
    """Over thousands of angles: a configuration exists where the circle about the tool point is marked."""
    arm = catalogue()["planar_3r_unequal"].arm
    lengths = lengths_of(arm)
    for r in (0.3, 0.9, 1.5, 1.9, 2.0):
        place = Place(r, 0.7, 0.0)
        arcs = possible_joints(arm, lengths, place)
        measure = sum(last - first for first, last in arcs)
        assert measure == pytest.approx(float(orientations(lengths, r)), abs=1e-9)
        for angle in np.linspace(-np.pi, np.pi, 41):
            exists = len(configurations(arm, place._replace(psi=angle + np.pi - place.theta))) > 0
            inside = any(math.remainder(angle - 0.5 * (a + b), math.tau) ** 2 <= (0.5 * (b - a)) ** 2 for a, b in arcs)
            assert exists == inside


def test_the_target_is_told_apart_from_the_tool():
    state = state_of("planar_3r")
    assert target_distance(state) is None
    T = np.array(state[Joints].tool_pose)
    T[:2, 3] = [3.5, 0.0]
    state = apply(state, PlaceTarget(T))
    assert target_distance(state) == pytest.approx(3.5)
    assert tool_standing(state).place.r <= 3.0 + 1e-9
    assert outermost(state).shape == (4, 3)
    assert outermost(state_of("puma560")) is None
    assert tool_standing(state_of("puma560")) is None
