"""The cut that nobody has chosen shows most of the workspace, and the camera has all of it in the picture."""

from functools import cache

import numpy as np
import pytest

from armlab.benches.workspace.cloud.cuts import AXES, SLICE, cut_of, place_of, range_of
from armlab.benches.workspace.cloud.examples import EXAMPLES, ChooseWorkspaceExample
from armlab.benches.workspace.cloud.job import sampled
from armlab.benches.workspace.cloud.samples import SHOWN, sampling
from armlab.benches.workspace.cloud.state import AUTO, LookAtWorkspace, SampleWorkspace, Workspace, question_of
from armlab.benches.workspace.cloud.ui.page import PANEL
from armlab.benches.workspace.cloud.view import kept
from armlab.benches.workspace.section.state import PlaceSlice, SectionView
from armlab.benches.workspace.what_if.job import compared
from armlab.benches.workspace.what_if.state import WhatIf
from armlab.benches.workspace.what_if.view import parts_of
from armlab.content.robots import catalogue, own_robot
from armlab.kin.arm import Arm
from armlab.kin.dh import Row
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.state import State, apply
from armlab.ui.camera import Camera, Wish
from armlab.ui.figure.figure import build_figure
from support.looking import Onlooker, degrees_off, upper_side

ARMS = ("planar_2r", "scara", "puma560", "panda")


@cache
def whole(key, seed=0):
    state = apply(State.initial(catalogue()[key]), LookAtWorkspace(count=26_000, seed=seed))
    return sampled(apply(state, SampleWorkspace()))


def share(state):
    return float(np.mean(state.derived(kept)))


def along(state, axis):
    arm = state[Joints].arm
    return (state[Workspace].found.shown.points - arm.base[:3, 3]) @ arm.base[:3, AXES.index(axis)]


def test_a_scara_shows_at_least_four_fifths_of_its_points_where_the_half_showed_a_sixth():
    state = whole("scara")
    assert len(state[Workspace].found.shown.points) == SHOWN
    assert share(apply(state, LookAtWorkspace(cut="front"))) < 0.2
    assert cut_of(state[Workspace]) == "none"
    assert share(state) >= 0.8


@pytest.mark.parametrize("key", ["planar_2r", "planar_3r", "planar_2r_unequal"])
def test_a_planar_workspace_is_drawn_whole(key):
    assert cut_of(whole(key)[Workspace]) == "none"
    assert share(whole(key)) == 1.0


@pytest.mark.parametrize("key", ["puma560", "panda", "elbow_3r"])
def test_an_arm_that_turns_round_is_cut_in_half_so_that_it_is_seen(key):
    assert cut_of(whole(key)[Workspace]) == "front"
    assert 0.4 <= share(whole(key)) < 0.6


@pytest.mark.parametrize("key", list(catalogue().robots))
def test_no_arm_hides_most_of_its_points_behind_a_cut_that_nobody_chose(key):
    assert share(whole(key)) >= 0.4


def test_the_cut_follows_from_the_points_alone_and_what_a_person_chose_is_kept():
    for seed in (1, 2):
        assert cut_of(whole("scara", seed)[Workspace]) == "none"
        assert cut_of(whole("puma560", seed)[Workspace]) == "front"
    chosen = apply(whole("scara"), LookAtWorkspace(cut="front"))
    assert cut_of(chosen[Workspace]) == "front"
    assert cut_of(apply(chosen, SampleWorkspace())[Workspace]) == "front"
    assert cut_of(apply(apply(chosen, ChooseRobot("puma560")), ChooseRobot("scara"))[Workspace]) == "front"
    robot = chosen[RobotPart].robot
    assert cut_of(Workspace.from_json(chosen[Workspace].to_json(), robot)) == "front"
    assert Workspace.from_json(whole("scara")[Workspace].to_json(), robot).cut == AUTO


def test_while_points_come_the_cut_is_that_of_all_of_them():
    state = apply(State.initial(catalogue()["scara"]), LookAtWorkspace(count=100_000))
    for found in sampling(question_of(state)):
        assert found is None or cut_of(Workspace(found=found)) == "none"


@pytest.mark.parametrize("key", ["scara", "puma560", "panda"])
@pytest.mark.parametrize("axis", AXES)
def test_a_slice_begins_where_most_points_are_and_its_slider_is_as_long_as_the_cloud(key, axis):
    state = apply(whole(key), LookAtWorkspace(cut=axis))
    part, places, half = state[Workspace], along(state, axis), SLICE * state[Joints].arm.reach
    low, high = range_of(part)
    np.testing.assert_allclose([low, high], [places.min(), places.max()], rtol=1e-6)
    assert low <= place_of(part) <= high
    drawn = int(np.count_nonzero(state.derived(kept)))
    # Rounding may lose the points at its very edges.
    assert drawn >= max(np.count_nonzero(np.abs(places - at) <= half) for at in np.linspace(low, high, 400)) - 3


def test_the_slice_of_a_scara_began_where_nothing_is():
    state = apply(whole("scara"), LookAtWorkspace(cut="z"))
    assert share(apply(state, LookAtWorkspace(offset=0.0))) < 0.25 * share(state)


def test_a_chosen_place_stays_until_another_axis_is_cut():
    state = apply(whole("puma560"), LookAtWorkspace(cut="z", offset=0.3))
    assert place_of(state[Workspace]) == 0.3
    assert place_of(apply(state, LookAtWorkspace(cut="z"))[Workspace]) == 0.3
    assert place_of(apply(state, LookAtWorkspace(edge=True))[Workspace]) == 0.3
    other = apply(state, LookAtWorkspace(cut="x"))
    assert other[Workspace].offset is None
    assert place_of(apply(state, LookAtWorkspace(cut="x", offset=0.1))[Workspace]) == 0.1


def test_examples_say_what_is_cut():
    for key in EXAMPLES:
        assert cut_of(apply(whole("planar_2r"), ChooseWorkspaceExample(key))[Workspace]) == EXAMPLES[key].cut


# -- in the picture --------------------------------------------------------------------------------------------------


def looked_at(state, aspect=1.5):
    """Return what the eye sees that has come from home to the page, and the camera."""
    robot = state[RobotPart].robot
    page = Onlooker(aspect)
    camera = Camera(page, lambda: state[Joints].q, lambda: Wish(PANEL.around(state), PANEL.faces(state)))
    camera.gaze.still = True
    camera.follow(robot, build_figure(robot.arm))
    camera.attend(frozenset({"workspace"}), PANEL.looks(state))
    return page


@pytest.mark.parametrize("key", ARMS)
@pytest.mark.parametrize("draw", ["cloud", "voxels"])
@pytest.mark.parametrize("aspect", [0.7, 1.5])
def test_the_whole_cloud_is_in_the_picture_of_every_window(key, draw, aspect):
    state = apply(whole(key), LookAtWorkspace(cut="none", draw=draw))
    page = looked_at(state, aspect)
    assert page.sees(state[Workspace].found.shown.points.astype(float))
    if draw == "voxels":
        voxels = state[Workspace].found.voxels
        assert page.sees(voxels.centres(voxels.count > 0).astype(float))


@pytest.mark.parametrize("axis", AXES)
def test_a_slice_of_a_cloud_is_looked_at_square(axis):
    state = apply(whole("puma560"), LookAtWorkspace(cut=axis))
    eye, base = looked_at(state).eye, state[Joints].arm.base
    normal = base[:3, AXES.index(axis)]
    assert abs(degrees_off(eye.back, normal) - (180.0 if eye.back @ normal < 0.0 else 0.0)) < 0.1
    assert degrees_off(upper_side(eye), base[:3, 1] if axis == "z" else base[:3, 2]) < 0.1


@pytest.mark.parametrize("axis", AXES)
def test_a_slice_stays_in_the_picture_wherever_it_is_moved(axis):
    state = apply(whole("puma560"), LookAtWorkspace(cut=axis))
    page, points = looked_at(state), state[Workspace].found.shown.points.astype(float)
    for place in np.linspace(*range_of(state[Workspace]), 9):
        assert page.sees(points[apply(state, LookAtWorkspace(offset=place)).derived(kept)])


def test_what_if_shows_all_of_a_body_that_would_mostly_be_cut_away():
    for key, least in (("scara", 1.0), ("puma560", 0.4)):
        state = compared(State.initial(catalogue()[key]))
        drawn = len(state.derived(parts_of).kept) / len(state[WhatIf].found.old.points)
        assert drawn >= least
        assert (drawn == 1.0) == (key == "scara")


def test_slices_go_as_far_as_an_arm_of_the_longest_links_reaches():
    arm = Arm.from_dh([Row("R", 0.0, np.pi / 2, 50.0), Row("R", 90.0, 0.0), Row("R", 80.0, 0.0)])
    state = apply(State.initial(own_robot(arm, "crane")), LookAtWorkspace(count=26_000))
    state = sampled(apply(state, SampleWorkspace()))
    for axis in AXES:
        state = apply(state, LookAtWorkspace(cut=axis))
        for end in range_of(state[Workspace]):
            there = apply(state, LookAtWorkspace(offset=end))
            assert there[Workspace].offset == end
            section = apply(apply(there, Set(SectionView, "slice", axis)), PlaceSlice(end))[SectionView]
            assert SectionView.from_json(section.to_json(), there[RobotPart].robot).offset == pytest.approx(end)
    assert abs(end) > 100.0
