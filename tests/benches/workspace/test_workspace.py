"""The sampled workspace of a student: settings, sampling in pieces, cancelling, the cut, clicks, files."""

from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.workspace.cloud.cuts import SLICE
from armlab.benches.workspace.cloud.examples import EXAMPLES
from armlab.benches.workspace.cloud.files import as_csv, as_ply
from armlab.benches.workspace.cloud.job import delivered, sampled, wanted
from armlab.benches.workspace.cloud.job_boundary import delivered as delivered_boundary
from armlab.benches.workspace.cloud.job_boundary import with_boundary
from armlab.benches.workspace.cloud.samples import SHOWN, sampling
from armlab.benches.workspace.cloud.state import (
    AimAtSample,
    CancelWorkspace,
    ClearWorkspace,
    GoToSample,
    LookAtWorkspace,
    SampleWorkspace,
    Workspace,
    question_of,
)
from armlab.benches.workspace.cloud.view import EDGE, boundary, drawing, kept, pointed_at
from armlab.content.robots import catalogue
from armlab.errors import InputError, UnknownName
from armlab.session.bench import PutInPlace
from armlab.session.parts.joints import Joints, LockJoint
from armlab.session.parts.robot import ChooseRobot
from armlab.session.parts.target import Target
from armlab.session.state import State, apply


def state_of(key, **settings):
    return apply(State.initial(catalogue()[key]), LookAtWorkspace(**{"count": 26_000, **settings}))


def whole(key, **settings):
    return sampled(apply(state_of(key, **settings), SampleWorkspace()))


@pytest.mark.parametrize("key", ["planar_2r_unequal", "cartesian_3p", "scara", "puma560", "panda"])
def test_every_point_is_one_the_arm_reaches_inside_its_limits(key):
    state = whole(key)
    arm, shown = state[Joints].arm, state[Workspace].found.shown
    q = shown.q.astype(float)
    assert np.all((q >= arm.limits[:, 0]) & (q <= arm.limits[:, 1]))
    np.testing.assert_allclose(arm.position(q), shown.points, atol=1e-5 * max(arm.reach, 1.0))


def test_it_comes_in_pieces_and_grows():
    question = question_of(state_of("puma560", count=100_000))
    found = list(sampling(question))
    assert len(found) > 2
    done = [each.done for each in found]
    assert done == sorted(done)
    assert done[-1] == 100_000
    assert found[-1].finished
    assert len(found[0].shown.points) < len(found[-1].shown.points) == SHOWN
    np.testing.assert_array_equal(found[0].shown.points, found[-1].shown.points[: len(found[0].shown.points)])
    assert [int(each.voxels.count.sum()) for each in found] == done


def test_the_same_seed_gives_the_same_cloud_and_another_another():
    first, same, other = whole("elbow_3r", seed=3), whole("elbow_3r", seed=3), whole("elbow_3r", seed=4)
    np.testing.assert_array_equal(first[Workspace].found.shown.points, same[Workspace].found.shown.points)
    assert not np.array_equal(first[Workspace].found.shown.points, other[Workspace].found.shown.points)


def test_another_colour_keeps_the_points_and_the_chosen_one():
    state = apply(whole("elbow_3r"), GoToSample(7))
    before = state[Workspace].found
    state = apply(state, LookAtWorkspace(measure="sigma_min"))
    assert state[Workspace].asked is not None
    state = sampled(state)
    after = state[Workspace].found
    np.testing.assert_array_equal(before.shown.points, after.shown.points)
    assert not np.allclose(before.shown.values, after.shown.values)
    assert state[Workspace].chosen == 7


def test_it_can_be_cancelled_at_any_time_and_what_there_is_stays():
    state = apply(state_of("puma560", count=10_000_000), SampleWorkspace())
    question = state[Workspace].asked
    assert wanted(state, frozenset()).inputs == question
    pieces = sampling(question)
    state = delivered(state, question, next(pieces))
    state = apply(state, CancelWorkspace())
    assert wanted(state, frozenset()) is None
    there = state[Workspace].found
    assert there.done > 0
    assert not there.finished
    # What was already on its way is let go.
    assert delivered(state, question, next(pieces)) is state
    assert apply(state, ClearWorkspace())[Workspace].found is None


def test_another_arm_has_none_and_old_pieces_are_let_go():
    state = apply(state_of("puma560"), SampleWorkspace())
    question = state[Workspace].asked
    found = next(sampling(question))
    other = apply(delivered(state, question, found), ChooseRobot("scara"))
    assert other[Workspace].found is None
    assert other[Workspace].asked is None
    assert delivered(other, question, found) is other
    with pytest.raises(InputError, match="sample it first"):
        apply(other, GoToSample(0))


def test_what_is_cut_away():
    state = whole("elbow_3r", cut="front")
    points = state[Workspace].found.shown.points
    left = points[state.derived(kept)]
    assert 0.4 < len(left) / len(points) < 0.6
    azimuth = np.radians(-50.0)
    assert np.all(left[:, :2] @ [np.cos(azimuth), np.sin(azimuth)] <= 1e-6)
    state = apply(state, LookAtWorkspace(cut="z", offset=0.5))
    thin = points[state.derived(kept)][:, 2]
    assert len(thin) > 0
    assert np.all(np.abs(thin - 0.5) <= SLICE * state[Joints].arm.reach + 1e-6)
    assert np.all(apply(state, LookAtWorkspace(cut="none")).derived(kept))


def test_a_planar_arm_is_never_cut_in_half():
    assert np.all(whole("planar_2r", cut="front").derived(kept))


def test_a_click_means_the_first_point_on_the_line_of_sight():
    state = whole("elbow_3r", cut="none")
    points = state[Workspace].found.shown.points.astype(float)
    wanted_point = points[123]
    direction = np.array([0.3, -0.5, 0.2])
    origin = wanted_point - 10.0 * direction
    index = pointed_at(state, origin, direction)
    away = points[index] - wanted_point
    ray = direction / np.linalg.norm(direction)
    # What is meant lies on the line, not behind the point aimed at.
    assert np.linalg.norm(away - (away @ ray) * ray) <= 0.012 * state[Joints].arm.reach
    assert away @ ray <= 1e-9
    assert pointed_at(state, origin, -direction) is None
    assert pointed_at(state, [50.0, 50.0, 50.0], [1.0, 0.0, 0.0]) is None
    assert pointed_at(state, origin, [0.0, 0.0, 0.0]) is None


def test_a_click_goes_to_what_is_drawn_only():
    state = whole("elbow_3r", cut="front")
    hidden = int(np.flatnonzero(~state.derived(kept))[0])
    point = state[Workspace].found.shown.points[hidden].astype(float)
    direction = np.array([0.0, 0.0, -1.0])
    assert pointed_at(state, point + np.array([0.0, 0.0, 9.0]), direction) != hidden


def test_the_arm_goes_to_a_sample_and_the_target_too():
    state = whole("puma560")
    there = apply(state, GoToSample(11))
    found = there[Workspace].found
    np.testing.assert_allclose(there[Joints].q, found.shown.q[11], atol=1e-6)
    np.testing.assert_allclose(there[Joints].tool_pose[:3, 3], found.shown.points[11], atol=1e-5)
    assert there[Target].pose is None
    aimed = apply(state, AimAtSample(11))
    np.testing.assert_allclose(aimed[Target].pose[:3, 3], found.shown.points[11], atol=1e-5)
    np.testing.assert_allclose(aimed[Joints].tool_pose, aimed[Target].pose, atol=1e-6)


def test_held_joints_stay_when_the_arm_goes_to_a_sample():
    state = apply(whole("panda"), LockJoint(0, True))
    there = apply(state, GoToSample(5))
    assert there[Joints].q[0] == state[Joints].q[0]


def test_the_target_is_put_at_a_sample_also_where_a_held_joint_keeps_the_arm_away():
    state = apply(whole("elbow_3r"), LockJoint(1, True))
    for index in range(3):
        aimed = apply(state, AimAtSample(index))
        point = state[Workspace].found.shown.points[index]
        np.testing.assert_allclose(aimed[Target].pose[:3, 3], point, atol=1e-5)
        assert aimed[Joints].q[1] == state[Joints].q[1]
        assert np.linalg.norm(aimed[Joints].tool_pose[:3, 3] - point) > 1e-3


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"measure": "w"}, "measure"),
        ({"count": 5}, "samples"),
        ({"seed": -1}, "seed: expected a whole number, at least 0, got -1"),
        ({"draw": "fog"}, "draw: unknown name 'fog'"),
        ({"cut": "q"}, "cut"),
        ({"offset": float("nan")}, "offset: expected finite numbers, got nan"),
        ({"offset": -2e4}, "place of the slice: expected at most 10000 m either way, got -20000 m"),
        ({"seed": 2**31}, "seed: expected a whole number, at most 2.14748e"),
    ],
)
def test_settings_that_are_none_are_refused(settings, said):
    state = state_of("puma560")
    with pytest.raises((InputError, UnknownName), match=said):
        apply(state, LookAtWorkspace(**settings))


@pytest.mark.parametrize("index", [-1, SHOWN])
def test_samples_that_are_not_there_are_refused(index):
    with pytest.raises(InputError, match=r"sample \(counted from 0\): expected 0 to 25999, got"):
        apply(whole("planar_2r"), GoToSample(index))


def test_settings_are_saved_and_damaged_ones_refused():
    state = state_of("puma560", measure="inverse_condition", cut="y", offset=0.2, seed=5)
    data, robot = state[Workspace].to_json(), catalogue()["puma560"]
    again = Workspace.from_json(data, robot)
    assert again.to_json() == data
    assert again.found is None
    damaged = (("measure", "w"), ("count", 3), ("count", 26_000.0), ("edge", 1), ("offset", "x"), ("seed", "x"))
    for name, value in damaged:
        with pytest.raises((InputError, UnknownName), match=r"expected|Available"):
            Workspace.from_json({**data, name: value}, robot)


@pytest.mark.parametrize("other", [{"measure": "manipulability"}, {"draw": "voxels"}, {"cut": "z"}])
def test_another_look_is_no_example_any_more(other):
    state = apply(state_of("planar_2r"), PutInPlace("workspace/puma"))
    assert apply(state, LookAtWorkspace(seed=3, clicks=False))[Workspace].example == "puma"
    assert apply(state, LookAtWorkspace(**other))[Workspace].example == ""


@pytest.mark.parametrize("key", list(EXAMPLES))
def test_every_example_can_be_sampled(key):
    state = sampled(apply(State.initial(catalogue()["puma560"]), PutInPlace(f"workspace/{key}")))
    part = state[Workspace]
    assert part.example == key
    assert part.found.finished
    assert np.isfinite(part.found.shown.values).all()
    # In a box w is the same everywhere.
    assert (part.found.high > part.found.low) is (key != "box")


def test_files_hold_what_is_drawn():
    found = whole("scara")[Workspace].found
    head, _, body = as_ply(found).partition(b"end_header\n")
    assert head.startswith(b"ply\nformat binary_little_endian 1.0\n")
    assert b"element vertex 26000" in head
    table = np.frombuffer(body, dtype="<f4").reshape(-1, 4)
    np.testing.assert_array_equal(table[:, :3], found.shown.points)
    lines = as_csv(found).splitlines()
    assert lines[0].startswith("x (m),y (m),z (m),manipulability")
    assert lines[0].endswith("q4 (rad)")
    row = np.array([float(value) for value in lines[5].split(",")])
    np.testing.assert_allclose(row[:3], found.shown.points[4], rtol=1e-5)
    np.testing.assert_allclose(row[4:], found.shown.q[4], rtol=1e-5, atol=1e-7)


def test_a_name_of_several_lines_ends_no_head_of_a_file():
    found = whole("planar_2r")[Workspace].found
    arm = replace(found.question.arm, name="two\nend_header\nlines")
    named = replace(found, question=replace(found.question, arm=arm))
    assert as_ply(named).split(b"\n")[2].startswith(b"comment workspace of two end_header lines, first ")


def test_a_boundary_comes_ready_for_what_shows_it():
    ready = with_boundary(apply(whole("elbow_3r"), LookAtWorkspace(draw="surface")))[Workspace].section
    assert {"contours", "edges", "edge_cells"} <= set(ready.boundary.__dict__)


def test_what_is_near_the_boundary_is_drawn_once_it_is_known():
    state = apply(whole("elbow_3r", cut="none"), LookAtWorkspace(edge=True))
    points = state[Workspace].found.shown.points
    # While the boundary is being found, everything stays.
    assert np.all(state.derived(kept))
    known = with_boundary(state)
    left = points[known.derived(kept)]
    arm = known[Joints].arm
    r = np.linalg.norm(points - [0.0, 0.0, arm.rows[0].d], axis=1)
    l2, l3 = arm.rows[1].a, arm.rows[2].a
    away = np.minimum(l2 + l3 - r, r - abs(l2 - l3))
    clear = np.abs(away - EDGE * arm.reach) > 0.02
    np.testing.assert_array_equal(known.derived(kept)[clear], (away <= EDGE * arm.reach)[clear])
    assert 0 < len(left) < len(points)


def test_the_surface_is_found_once_for_everybody():
    asked = apply(whole("elbow_3r"), LookAtWorkspace(draw="surface"))
    assert boundary(asked) is None
    first, second = with_boundary(asked), with_boundary(asked)
    assert first[Workspace].section is second[Workspace].section
    assert len(boundary(first).faces) < len(boundary(apply(first, LookAtWorkspace(cut="none"))).faces)
    other = apply(first, ChooseRobot("scara"))
    assert other[Workspace].section is None
    assert delivered_boundary(other, first[Joints].arm, first[Workspace].section) is other


def test_a_planar_workspace_has_no_surface_to_draw():
    state = apply(state_of("elbow_3r", draw="surface"), ChooseRobot("planar_2r"))
    assert drawing(state) == "cloud"
    assert drawing(apply(state, ChooseRobot("elbow_3r"))) == "surface"
