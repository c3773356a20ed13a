"""The section of the workspace as a part of the state: found in pieces, coloured, sliced, and gone into."""

import gc
import json
import math
import weakref
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from armlab.benches.workspace.section import found as found_module
from armlab.benches.workspace.section.facts import FACTS
from armlab.benches.workspace.section.found import Found, Question, finding, once_each
from armlab.benches.workspace.section.job import JOB, delivered, found_section
from armlab.benches.workspace.section.marks import silhouette, target_measured, tool_measured
from armlab.benches.workspace.section.slice import _smoothly, in_own_plane, section_picture, slice_of
from armlab.benches.workspace.section.state import (
    SLICES,
    GoInSection,
    GoToPoint,
    PlaceSlice,
    SectionView,
    found_of,
    question_of,
)
from armlab.content.robots import catalogue
from armlab.errors import ArmlabError, InputError
from armlab.kin.workspace.planar import lengths_of
from armlab.kin.workspace.section_size import Size
from armlab.kin.workspace.sections import section
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, LockJoint
from armlab.session.parts.robot import ChooseRobot
from armlab.session.parts.target import DragTarget
from armlab.session.state import State
from support.done import done

SEEN = frozenset({"section", "workspace"})


@cache
def whole(key):
    """Return a state in which the section of an arm is found."""
    return found_section(State.initial(catalogue()[key]))


def tool(state):
    return np.asarray(state[Joints].tool_pose[:3, 3])


def test_distances_from_the_axis_of_joint_1_are_facts_where_it_turns_only():
    names = ("inner", "outer", "lowest", "highest", "farthest")
    keys = ("planar_2r_unequal", "cartesian_3p")
    turns, slides = ({name: FACTS.facts[name].now(whole(key)).value for name in names} for key in keys)
    l1, l2 = lengths_of(catalogue()["planar_2r_unequal"].arm)
    assert turns["inner"] == pytest.approx(l1 - l2, abs=1e-6)
    assert turns["outer"] == turns["farthest"] == pytest.approx(l1 + l2, abs=1e-6)
    assert slides == dict.fromkeys(names)


def test_it_is_found_while_its_page_is_seen_and_only_once():
    state = State.initial(catalogue()["planar_2r"])
    assert JOB.wanted(state, frozenset({"workspace"})) is None
    wanted = JOB.wanted(state, SEEN)
    assert wanted.inputs.arm is state[Joints].arm
    done = -1.0
    for found in finding(wanted.inputs):
        if found is not None:
            assert found.done >= done
            done = found.done
            state = delivered(state, wanted.inputs, found)
            # What is under way is still the same work.
            again = JOB.wanted(state, SEEN)
            assert again is None or again.key == wanted.key
    assert found_of(state).finished
    assert JOB.wanted(state, SEEN) is None


def test_pictures_become_rarer_and_what_was_found_is_ready_for_a_distance(monkeypatch):
    arm = catalogue()["puma560"].arm
    last = section(arm, 32, 2048, wanted=1.0)
    monkeypatch.setattr(
        found_module, "sections", lambda _: iter([*[replace(last, finished=False)] * 400, replace(last)])
    )
    pictures = [each for each in finding(Question(arm, "reach", None)) if each is not None]
    assert 15 < len(pictures) < 30
    assert {"contours", "edges", "edge_cells", "walls", "faces"} <= set(pictures[-1].section.boundary.__dict__)


def test_colours_of_many_cells_are_found_a_part_at_a_time(monkeypatch):
    """The same, however few rows are summed at once, as from the sums of all cells with their neighbours."""
    arm = catalogue()["puma560"].arm
    known = Found(arm, section(arm, 32, 2048, wanted=1.0), 1.0, Size(1.0, 0.1, "m³"))
    monkeypatch.setattr(found_module, "SAMPLES", 3 * found_module.PIECE)
    pieces = [list(finding(Question(arm, "manipulability", known)))]
    monkeypatch.setattr(found_module, "TOGETHER", 1)
    pieces.append(list(finding(Question(arm, "manipulability", known))))
    assert len(pieces[1]) - len(pieces[0]) == (len(known.section.u) - 1) * sum(each is not None for each in pieces[0])
    once, by_rows = (each[-1] for each in pieces)
    assert once.coloured
    assert np.isfinite(once.values[known.section.filled]).all()
    np.testing.assert_array_equal(once.values, by_rows.values)


@pytest.mark.parametrize("planar", [False, True])
def test_a_section_is_drawn_twice_as_fine_as_places_between_its_cells_are_reached(planar):
    arm = catalogue()["planar_2r" if planar else "puma560"].arm
    found = section(arm, 32, 2048, wanted=1.0)
    u, v = (np.repeat(at, 2) + found.step * np.tile([-0.25, 0.25], len(at)) for at in (found.u, found.v))
    places = np.stack(np.meshgrid(u, v), axis=-1)
    np.testing.assert_array_equal(section_picture(Found(arm, found, 1.0)).reached, _smoothly(found, places))


def test_what_belongs_to_another_arm_is_let_go():
    state = whole("planar_2r")
    other = done(state, ChooseRobot("elbow_3r"))
    assert found_of(other) is None
    question = question_of(State.initial(catalogue()["planar_2r"]))
    assert delivered(other, question, found_of(state)) is other


def test_another_colour_keeps_the_section_and_is_an_average_of_what_the_measure_can_be():
    state = whole("elbow_3r")
    coloured = found_section(done(state, Set(SectionView, "colour", "manipulability")))
    found = found_of(coloured)
    assert found.section is found_of(state).section
    assert found.size == found_of(state).size
    values = found.values[found.section.filled]
    assert np.isfinite(values).all()
    # w of this elbow is a2 a3 |sin q3| times the distance from the axis: elbow up or down, the same at a place.
    i, j = np.nonzero(found.section.filled)
    truth = np.asarray(found.arm.manipulability(found.section.at(i, j)))
    # Near the boundary it rises too steeply for a mean over three cells.
    assert np.mean(np.abs(values - truth) < 0.06 * truth.max()) > 0.98
    assert question_of(coloured) is None


def test_nothing_can_be_gone_to_before_it_is_known():
    state = State.initial(catalogue()["puma560"])
    for command in (GoInSection(0.5, 0.5), GoToPoint((0.5, 0.0, 0.5))):
        with pytest.raises(InputError, match="not known yet"):
            command.apply(state)
    assert tool_measured(state) is None
    assert slice_of(state) is None


def test_the_tool_goes_where_the_section_was_clicked_and_stays_in_its_half_plane():
    state = whole("elbow_3r")
    joint = found_of(state).section.joint
    s = joint.split(tool(state))[2]
    for u, v in [(0.9, 0.7), (0.5, 1.4), (1.2, 0.5)]:
        moved = done(state, GoInSection(u, v))
        assert_allclose(joint.split(tool(moved)), [u, v, s], atol=1e-6)
        assert moved[Joints].arm.within_limits(moved[Joints].q)
    out = done(state, GoInSection(3.0, 0.6))
    assert_allclose(joint.split(tool(out)), [1.3, 0.6, s], atol=1e-4)


def test_a_place_joint_1_cannot_carry_here_is_gone_to_where_it_can():
    state = whole("scara")
    found = found_of(state)
    i, j = np.nonzero(found.section.filled)
    q = found.section.at(i[:1], j[:1])[0]
    u, v, _ = found.section.joint.split(found.arm.position(q))
    moved = done(state, GoInSection(float(u), float(v)))
    assert_allclose(found.section.joint.split(tool(moved))[:2], [u, v], atol=1e-6)


def test_joints_that_do_not_move_the_point_stay_and_held_ones_too():
    state = done(whole("scara"), LockJoint(3, True))
    before = state[Joints].q
    moved = done(state, GoInSection(0.5, 0.15))
    assert moved[Joints].q[3] == before[3]
    held = done(whole("elbow_3r"), LockJoint(0, True))
    point = tool(held) + np.array([0.0, 0.2, 0.0])
    assert done(held, GoToPoint(tuple(point.tolist())))[Joints].q[0] == held[Joints].q[0]


def test_tool_and_target_know_their_way_to_the_boundary():
    state = whole("elbow_3r")
    measured = tool_measured(state)
    r = np.linalg.norm(tool(state) - [0, 0, 0.6])
    assert_allclose(measured.to.distance, min(r - 0.3, 1.3 - r), atol=2e-4)
    assert target_measured(state) is None
    pose = np.array(state[Joints].tool_pose)
    pose[:3, 3] = [2.0, 0.0, 0.6]
    dragged = done(state, DragTarget(pose, object()))
    assert_allclose(target_measured(dragged).to.distance, -0.7, atol=1e-3)
    assert_allclose(target_measured(dragged).to.foot, [1.3, 0.0, 0.6], atol=1e-3)
    there = done(dragged, GoToPoint(tuple(target_measured(dragged).to.foot.tolist())))
    assert abs(tool_measured(there).to.distance) < 1e-3


@pytest.mark.parametrize("key", ["elbow_3r", "cartesian_3p", "scara"])
@pytest.mark.parametrize("kind", [kind for kind in SLICES if kind != "none"])
def test_every_point_of_a_slice_is_reached_and_lies_in_it(key, kind):
    state = whole(key)
    place = tool(state) @ np.eye(3)["xyz".index(kind)] if kind != "axis" else None
    state = done(state, Set(SectionView, "slice", kind), PlaceSlice(place))
    drawn, found = slice_of(state), found_of(state)
    rows, columns = np.nonzero(drawn.reached)
    assert len(rows) > 200
    height, width = drawn.reached.shape
    right = (columns + 0.5) / width * drawn.plane.width
    up = (rows + 0.5) / height * drawn.plane.height
    points = drawn.plane.corner + right[:, None] * drawn.plane.right + up[:, None] * drawn.plane.up
    rng = np.random.default_rng(1)
    for point in points[rng.choice(len(points), 25, replace=False)]:
        q = found.section.nearest(point)
        assert np.linalg.norm(found.arm.position(q) - point) < 6 * found.section.step
        if kind in "xyz":
            assert_allclose(point["xyz".index(kind)], place, atol=1e-9)


def test_a_slice_across_the_axis_has_the_area_it_must_have():
    state = done(whole("elbow_3r"), Set(SectionView, "slice", "z"), PlaceSlice(0.75))
    drawn = slice_of(state)
    pixel = drawn.plane.width / drawn.reached.shape[1] * drawn.plane.height / drawn.reached.shape[0]
    # A ball of radius 1.3 about z = 0.6 without one of 0.3.
    assert_allclose(drawn.reached.sum() * pixel, math.pi * (1.3**2 - 0.3**2), rtol=0.01)


def test_the_plane_of_a_planar_arm():
    drawn = in_own_plane(found_of(whole("planar_2r_unequal")))
    pixel = drawn.plane.width / drawn.reached.shape[1] * drawn.plane.height / drawn.reached.shape[0]
    assert_allclose(drawn.reached.sum() * pixel, math.pi * (1.5**2 - 0.5**2), rtol=0.01)
    assert in_own_plane(found_of(whole("elbow_3r"))) is None


@pytest.mark.parametrize("key", ["elbow_3r", "cartesian_3p", "scara", "planar_2r"])
def test_the_arm_seen_from_the_side_ends_at_the_tool(key):
    state = whole(key)
    found = found_of(state)
    end = silhouette(found, state[Joints].q)[-1]
    local = (tool(state) - found.section.joint.origin) @ found.section.joint.axes
    expected = local[:2] if key == "planar_2r" else found.section.joint.split(tool(state))[:2]
    assert_allclose(end, expected, atol=1e-9)


def test_how_it_is_looked_at_is_kept_and_damaged_files_are_refused():
    looked = (Set(SectionView, "colour", "sigma_min"), Set(SectionView, "slice", "y"))
    state = done(whole("elbow_3r"), *looked, PlaceSlice(0.2))
    data = json.loads(json.dumps(state[SectionView].to_json()))
    robot = catalogue()["elbow_3r"]
    back = SectionView.from_json(data, robot)
    assert (back.colour, back.slice, back.offset, back.found) == ("sigma_min", "y", 0.2, None)
    for damage in ({"colour": "green"}, {"slice": "w"}, {"offset": math.inf}, {"turn": "far"}):
        with pytest.raises((ArmlabError, ValueError)):
            SectionView.from_json(data | damage, robot)
    with pytest.raises(InputError, match="place of the slice"):
        PlaceSlice(1e6).apply(state)
    with pytest.raises(InputError, match=r"at most 10000 m either way, got 9000000 m$"):
        PlaceSlice(9e6).apply(state)
    with pytest.raises(InputError, match=r"at most 100 rad either way, got 157 rad$"):
        PlaceSlice(157.0).apply(done(state, Set(SectionView, "slice", "axis")))
    assert replace(back, found=None).for_robot(robot).slice == "y"


def test_what_follows_from_a_finding_is_worked_out_once_for_each_of_a_class_and_goes_with_it():
    class_of = [replace(found_of(whole("planar_2r"))) for _ in range(40)]
    asked = []
    follows = once_each(lambda found: asked.append(found.done) or len(asked))
    assert [follows(found) for found in class_of] == [follows(found) for found in class_of] == list(range(1, 41))
    kept = weakref.ref(class_of[0])
    del class_of[0]
    gc.collect()
    assert kept() is None
