"""The five planning steps: what comes of each, with numbers that are checked by other means."""

import math

import numpy as np
import pytest

from armlab.benches.motion.plan.commands import SetMove, SetMoveOption
from armlab.benches.motion.plan.examples import TakeExample
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.limits import SampleBy, UseShare
from armlab.benches.motion.plan.points import AddWaypoint, SelectWaypoint, SetWaypointPose
from armlab.benches.motion.plan.question import Feasible
from armlab.benches.motion.plan.state import Plan
from armlab.benches.motion.steps.state import PART, SAMPLING, STEPS, PlanSteps
from armlab.benches.motion.steps.ui import words
from armlab.benches.motion.steps.ui.page import MOST_CHIPS, steps_markup
from armlab.benches.motion.steps.worked import BETWEEN, DRAWN_APART, UNSEEN, between, kept, length_of, nearest_on, steps
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.rotations import axis_angle
from armlab.session.fields import Set
from armlab.session.parts.joints import RandomPose
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from armlab.ui.units import Units
from support.forms import asked

ARMS = ["puma560", "planar_2r", "cartesian_3p", "scara", "panda", "planar_3r"]
CARTESIAN = SetMove(1, space="cartesian")


def planned(key, *commands):
    state = State.initial(catalogue()[key])
    for command in commands:
        state = apply(state, command)
    return with_planned(state)


def out_of_reach():
    """Return the plan of a line that passes nearer to the base than the arm can reach."""
    arm = catalogue()["planar_2r_unequal"].arm
    ends = np.radians([[20.0, 120.0], [150.0, 120.0]])
    return planned("planar_2r_unequal", *(SetWaypointPose(k, arm.fk(q)) for k, q in enumerate(ends)), CARTESIAN)


def through_the_base():
    """Return the plan of a line on which the arm would have to turn its elbow past the limit."""
    poses = np.tile(np.eye(4), (2, 1, 1))
    poses[:, 0, 3] = 1.2, -1.1
    return planned("planar_2r", *(SetWaypointPose(k, pose) for k, pose in enumerate(poses)), CARTESIAN)


@pytest.mark.parametrize("key", ARMS)
@pytest.mark.parametrize("count", [2, 4, 201, 1001])
def test_samples_lie_on_the_path_evenly_and_their_solutions_reach_them(key, count):
    found = steps(planned(key, CARTESIAN, SampleBy(count)))
    assert found is not None
    assert found.in_space
    np.testing.assert_allclose(np.diff(found.followed.s), 1.0 / (count - 1), rtol=1e-9)
    first, last = found.knot_poses[0, :3, 3], found.knot_poses[-1, :3, 3]
    line = first + found.followed.s[:, None] * (last - first)
    np.testing.assert_allclose(found.samples, line, atol=1e-9)
    assert found.length == pytest.approx(np.linalg.norm(last - first), rel=1e-9)
    assert found.spacing == pytest.approx(found.length / (count - 1), rel=1e-9)
    reached = found.arm.position(found.followed.q)
    np.testing.assert_allclose(reached, found.samples, atol=1e-7 * found.arm.length_scale)


@pytest.mark.parametrize("key", ARMS)
def test_more_samples_keep_the_tool_nearer_to_its_path(key):
    apart = {}
    for count in (4, 7, 31, 201, 1001):
        found = steps(planned(key, CARTESIAN, SampleBy(count)))
        apart[count] = found.apart.distance.max()
        # Between samples it is looked at where the planning looks, and in more places while they are few.
        slack = 1e-6 * found.leg.deviation + 1e-12
        assert found.leg.deviation - slack <= apart[count] <= 1.5 * found.leg.deviation + slack
        if count - 1 <= BETWEEN:
            at = np.isin(found.apart.s, found.followed.s)
            assert at.sum() == count
            assert found.apart.distance[at].max() <= 1e-8 * found.arm.length_scale
    if key == "cartesian_3p":
        # Its joints are the coordinates: the spline is the line itself.
        assert max(apart.values()) < 1e-12
    else:
        assert apart[4] > 5e-5
        assert apart[4] > apart[7] > apart[31] > apart[201]
        # A cubic spline misses by the fourth power of the step; of an arm with joints to spare the solutions depend on
        # the samples a little.
        order = math.log(apart[31] / apart[201]) / math.log(200 / 30)
        assert order > 2.0 if key == "panda" else order == pytest.approx(4.0, abs=0.7)


def test_distance_and_turn_are_those_of_the_poses():
    found = steps(planned("puma560", CARTESIAN, SampleBy(4)))
    k = found.apart.worst
    pose, wanted = found.arm.fk(found.path.at(found.apart.s[k])), found.way.pose(found.apart.s[k])
    assert found.apart.distance[k] == pytest.approx(np.linalg.norm(pose[:3, 3] - wanted[:3, 3]), rel=1e-9)
    assert found.apart.turn[k] == pytest.approx(float(axis_angle(pose[:3, :3].T @ wanted[:3, :3])[1]), rel=1e-6)
    assert 0.5e-3 < found.apart.distance[k] < 20e-3
    _, turned = axis_angle(found.knot_poses[0, :3, :3].T @ found.knot_poses[1, :3, :3])
    assert found.turn == pytest.approx(float(turned), rel=1e-9)


@pytest.mark.parametrize("key", ARMS)
def test_a_joint_move_goes_from_knots_to_joints_at_once(key):
    state = planned(key)
    found = steps(state)
    assert not found.in_space
    assert found.way is None
    assert found.followed is None
    assert found.samples.shape == (0, 3)
    assert found.least_singular is None
    assert found.branch == ""
    np.testing.assert_allclose([q for _, q in found.shown_arms], [point.q for point in state[Plan].waypoints])
    assert [s for s, _ in found.shown_arms] == [0.0, 1.0]
    # The tool against a straight line, by the cross product.
    a, b = found.knot_poses[:, :3, 3]
    s = np.linspace(0.0, 1.0, 401)
    q = np.array(state[Plan].waypoints[0].q) + s[:, None] * np.subtract(*[p.q for p in state[Plan].waypoints[::-1]])
    tool = found.arm.position(q)
    side = np.linalg.norm(np.cross(tool - a, (b - a) / np.linalg.norm(b - a)), axis=1)
    assert found.apart.distance.max() >= side.max() - 1e-4 * found.arm.length_scale
    assert found.tool_length >= found.length - 1e-9
    if key == "cartesian_3p":
        assert found.apart.distance.max() < 1e-12


def test_a_path_that_cannot_be_followed_shows_the_steps_before():
    found = steps(out_of_reach())
    assert not found.followed.whole
    assert found.followed.stops
    assert found.path is None
    assert found.apart is None
    assert found.tool_length == 0.0
    assert found.leg.trouble
    counted = np.bincount(found.worth, minlength=4)
    assert counted[Feasible.NOT_REACHED] > 0
    assert counted[Feasible.YES] > 0
    assert counted.sum() == len(found.samples) == 201
    assert 0 < len(found.shown_arms) <= 5
    for s, q in found.shown_arms:
        np.testing.assert_allclose(found.arm.position(q), found.way.pose(s)[:3, 3], atol=1e-8)
    least, at = found.least_singular
    assert least == np.nanmin(found.followed.singular_value)
    assert 0.0 <= at <= 1.0


def test_samples_that_are_all_solved_can_be_of_two_branches():
    found = steps(through_the_base())
    assert found.followed.reached.all()
    assert [stop.kind for stop in found.followed.stops] == ["limit"]
    assert found.path is None
    assert found.apart is None
    assert len(found.shown_arms) == 5


def test_the_orientation_is_smooth_where_the_path_has_no_corner():
    arc, lines = steps(planned("puma560", TakeExample("circle"))), steps(planned("puma560", CARTESIAN))
    units = Units(Notation())
    assert "smoothly through the waypoints" in str(words.path(arc, units))
    assert "about one axis" in str(words.path(lines, units))


def test_stretches_are_told_apart_by_the_selected_waypoint():
    state = State.initial(catalogue()["puma560"])
    state = apply(apply(state, AddWaypoint()), SetMove(2, space="cartesian"))
    state = with_planned(state)
    for k, (first, last, in_space) in {0: (0, 1, False), 1: (0, 1, False), 2: (1, 2, True)}.items():
        found = steps(apply(state, SelectWaypoint(k)))
        assert (found.stretch.first, found.stretch.last, found.in_space) == (first, last, in_space)
        np.testing.assert_allclose(found.knot_poses[-1, :3, 3], found.drawn[-1], atol=1e-9)


def test_without_a_plan_there_are_no_steps_and_old_numbers_are_kept_while_they_hold():
    fresh = State.initial(catalogue()["planar_2r"])
    assert steps(fresh) is None
    state = with_planned(fresh)
    one, other = steps(state), steps(state)
    assert one is not other
    assert kept(other, one) is one
    assert kept(None, one) is None
    assert kept(one, None) is one
    slower = steps(with_planned(apply(state, UseShare(velocity=0.5))))
    assert kept(slower, one) is slower


def test_places_between_samples_hold_the_samples_and_their_middles():
    rng = np.random.default_rng(3)
    for count in (2, 3, 4, 60, BETWEEN, BETWEEN + 1):
        s = np.concatenate([[0.0], np.sort(rng.random(count - 2)), [1.0]])
        found = between(s)
        assert (np.diff(found) > 0.0).all()
        for place in (*s, *(0.5 * (s[1:] + s[:-1]))):
            assert np.abs(found - place).min() < 1e-12
    many = np.linspace(0.0, 1.0, BETWEEN + 2)
    np.testing.assert_allclose(between(many), 0.5 * (many[1:] + many[:-1]))


def test_nearest_points_of_straight_lines_are_nearest():
    rng = np.random.default_rng(5)
    for _ in range(20):
        corners, points = rng.normal(size=(4, 3)), rng.normal(size=(30, 3))
        corners[2] = corners[1]  # a line without length
        near = nearest_on(corners, points)
        share = np.linspace(0.0, 1.0, 2001)[:, None, None]
        dense = (corners[:-1] + share * np.diff(corners, axis=0)).reshape(-1, 3)
        best = np.linalg.norm(points[:, None] - dense, axis=2).min(axis=1)
        np.testing.assert_allclose(np.linalg.norm(points - near, axis=1), best, atol=2e-3)
        assert (np.linalg.norm(points - near, axis=1) <= best + 1e-12).all()
    assert length_of(np.array([[0.0, 0, 0], [3, 4, 0], [3, 4, 2]])) == pytest.approx(7.0)


def test_the_step_that_is_shown_is_kept_and_checked():
    state = State.initial(catalogue()["planar_2r"])
    assert state[PlanSteps].shown == 1
    for k in STEPS:
        state = apply(state, Set(PlanSteps, "shown", k))
        assert state[PlanSteps].shown == k
        assert PlanSteps.from_json(state[PlanSteps].to_json(), catalogue()["planar_2r"]) == state[PlanSteps]
    assert apply(state, Set(PlanSteps, "shown", 5)) is state
    assert state.with_robot(catalogue()["puma560"])[PlanSteps].shown == 5
    for wrong in (0, 6, 2.5, True, "1", None, [1]):
        with pytest.raises(InputError, match="shown: expected a whole number"):
            apply(state, Set(PlanSteps, "shown", wrong))
        with pytest.raises(InputError, match="shown: expected a whole number"):
            PlanSteps.from_json(wrong, catalogue()["planar_2r"])
    assert not Set(PlanSteps, "shown", 5).undoable
    assert PART.part is PlanSteps


@pytest.mark.parametrize("key", ARMS)
def test_small_distances_are_drawn_larger_but_never_large(key):
    for count in (2, 4, 10, 201):
        found = steps(planned(key, CARTESIAN, SampleBy(count)))
        most = found.apart.distance.max() / found.arm.length_scale
        assert found.larger >= 1.0
        assert found.larger == 1.0 or UNSEEN <= most <= found.larger * most <= DRAWN_APART
        if UNSEEN <= most <= 1e-3:
            assert found.larger * most >= 0.01
    assert steps(planned(key)).larger == 1.0
    assert steps(out_of_reach()).larger == 1.0


def test_stretches_steps_and_samples_are_chosen_on_the_page():
    state = planned("planar_2r", RandomPose(), AddWaypoint(), SetMove(1, space="cartesian"), SelectWaypoint(1))
    state = apply(state, Set(PlanSteps, "shown", SAMPLING))

    def typed(cell, text="", state=state):
        return asked(lambda form: steps_markup(form, state, steps(state)), cell, text)

    assert typed("step 4") == (Set(PlanSteps, "shown", 4),)
    assert typed("stretch 2") == (SelectWaypoint(2),)
    assert typed("stretch 7") == typed("step 6") == ()
    assert typed("samples", "50") == (SampleBy(50.0),)
    with pytest.raises(InputError, match="expected a number, got 'many'"):
        typed("samples", "many")
    # Where there are many, by a list.
    state = planned("planar_2r", *[RandomPose(), AddWaypoint()] * MOST_CHIPS, SelectWaypoint(1))
    assert typed("stretch", "3", state) == (SelectWaypoint(3),)
    assert typed("stretch", "99", state) == ()


@pytest.mark.parametrize(("key", "options"), [("spline", {}), ("blends", {}), ("blends", {"shape": "quartic"})])
def test_what_is_said_of_a_joint_move_is_true_of_its_path(key, options):
    chosen = [SetMoveOption(1, "path", name, value) for name, value in options.items()]
    found = steps(planned("puma560", TakeExample("spline"), SetMove(1, path=key), *chosen))
    units = Units(Notation())
    said = f"{words.path(found, units)}{words.joints(found, units, ('blue', 'red'))}"
    places = found.path.at(np.linspace(0.0, 1.0, 2001))
    meets = np.linalg.norm(places[:, None] - found.knot_q, axis=2).min(axis=0) < 1e-2
    assert len(meets) > 2
    assert ("are interpolated" in said) == bool(meets.all())
    assert ("pass by each knot between" in said) == (not meets[1:-1].any())
    assert "parabolic" not in said
    assert ("a quartic instead of each corner" in said) == ("shape" in options)
