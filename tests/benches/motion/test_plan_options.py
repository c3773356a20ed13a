"""Options of the moves of a plan: those that depend on each other, and lengths over joints of both kinds."""

from contextlib import chdir
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.files.script import motion_script
from armlab.benches.motion.plan.commands import AllMovesLike, SetMove, SetMoveOption, refuse_pathless
from armlab.benches.motion.plan.examples import TakeExample
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.moves import Move, Stretch, Waypoint
from armlab.benches.motion.plan.paths import joint_path, joint_scales
from armlab.benches.motion.plan.points import (
    AddWaypoint,
    RemoveWaypoint,
    SetAtWaypoint,
    SetWaypointJoint,
    SetWaypointPose,
    ShiftWaypoint,
)
from armlab.benches.motion.plan.state import Plan, planned_now
from armlab.benches.motion.plan.words import judged
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.motion import path_types
from armlab.kin.rotations import rotation_about
from armlab.session.parts.joints import Joints, RandomPose
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State, apply
from support.done import done
from support.plans import opened

KINDS = path_types()


def arm_of(robot):
    return State.initial(catalogue()[robot])[Joints].arm


def after(chosen, name, value):
    return chosen.with_option(KINDS[chosen.key], name, value)


@pytest.mark.parametrize("robot", ["scara", "cylindrical_rpp", "stanford"])
@pytest.mark.parametrize(
    "path",
    [
        Chosen("overfly", (("speed", (0.5,)),)),
        Chosen("spline"),
        Chosen("blends", (("spacing", "centripetal"),)),
    ],
    ids=lambda path: path.key,
)
def test_the_way_of_an_arm_with_both_kinds_of_joints_adds_no_metre_to_a_radian(robot, path, rng):
    arm = arm_of(robot)
    scales = joint_scales(arm)
    np.testing.assert_array_equal(scales, np.where(arm.revolute, 1.0, arm.length_scale))
    knots = rng.uniform(*arm.limits.T, size=(4, arm.n))
    found = joint_path(arm, Stretch(0, 3, Move(path=path)), knots)
    lengths = np.linalg.norm(np.diff(knots / scales, axis=0), axis=1)
    if path.key == "overfly":
        assert found.duration == pytest.approx(lengths.sum() / 0.5, rel=1e-12)
        return
    shares = np.cumsum(np.sqrt(lengths) if path.options else lengths)[:-1]
    shares /= (np.sqrt(lengths) if path.options else lengths).sum()
    if path.key == "spline":
        np.testing.assert_allclose(found.pieces, shares, rtol=0, atol=1e-12)
        np.testing.assert_allclose(found.at(shares), knots[1:-1], rtol=0, atol=1e-12)
    # A blend is half before and half after the time of its waypoint.
    else:
        np.testing.assert_allclose(found.pieces[1:-1].reshape(-1, 2).mean(axis=1), shares, rtol=0, atol=1e-12)


@pytest.mark.parametrize("robot", ["cartesian_3p", "planar_2r"])
def test_an_arm_of_one_kind_keeps_its_units(robot):
    assert joint_scales(arm_of(robot)) is None


def test_a_refusal_counts_both_waypoints_of_a_line_from_the_beginning_of_the_plan():
    arm = arm_of("planar_2r")
    stretch = Stretch(3, 6, Move(path=Chosen("overfly", (("amount", (0.6, 0.1)), ("by", "d2")))))
    says = (
        r"move 4 → 7: waypoint 5: its blend does not fit: between waypoints 5 and 6 the blends take 116.7 % of the line"
    )
    with pytest.raises(InputError, match=says):
        joint_path(arm, stretch, np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 0.6], [2.0, 0.6]]))


@pytest.mark.parametrize("path", ["helix", "clothoid"])
def test_a_refusal_counts_both_waypoints_of_the_way_that_a_direction_is_along(path):
    state = done(opened("puma560"), TakeExample("corner_stop"), SetMove(3, path=path))
    side = "side" if path == "helix" else "normal"
    with pytest.raises(InputError, match=f"move 3 → 4: {side}: expected a direction across the way from .* 3 to 4"):
        apply(state, SetMoveOption(3, "path", side, [0.0, 1.0, 0.0]))


@pytest.mark.parametrize(
    ("k", "path", "expected"),
    [
        (1, "circle", "circle circle spline spline"),
        (2, "circle", "circle circle spline spline"),
        (3, "circle", "spline spline circle circle"),
        (4, "circle", "spline spline circle circle"),
        (2, "lts_434", "lts_434 lts_434 lts_434 spline"),
        (4, "lts_434", "spline lts_434 lts_434 lts_434"),
    ],
)
def test_a_path_through_few_waypoints_is_that_of_the_chosen_move(k, path, expected):
    state = done(opened("puma560"), TakeExample("spline"))
    if path == "circle":
        state = done(state, SetMove(1, space="cartesian"))
    part = done(state, SetMove(k, path=path))[Plan]
    assert [move.path.key for move in part.moves] == expected.split()
    assert part.stretch_to(k).move.path.key == path


def arcs(count):
    """Return the state with so many moves that are all arcs; of an odd number the last runs straight."""
    state = done(
        opened("puma560", count + 1), SetMove(1, space="cartesian"), AllMovesLike(1), SetMove(1, path="circle")
    )
    return done(state, AllMovesLike(1))


def laid(state):
    return [(part.title, part.move.path.key) for part in state[Plan].parts]


def test_waypoints_are_added_behind_an_arc_of_four_one_by_one():
    state = done(opened("puma560", 4), SetMove(1, path="lts_434"))
    for count in (5, 6, 7):
        state = done(state, RandomPose(), AddWaypoint())
        assert len(state[Plan].waypoints) == count
    assert laid(state) == [("1 → 4", "lts_434"), ("4 → 7", "lts_434")]
    assert laid(done(state, RemoveWaypoint(6)))[1:] == [("4 → 5", "line"), ("5 → 6", "line")]


def test_a_circle_for_the_half_arc_that_is_left_over_is_refused_in_a_sentence():
    state = arcs(3)
    assert laid(state) == [("1 → 3", "circle"), ("3 → 4", "line")]
    with pytest.raises(InputError, match=r"move 3 → 4: Circle through three points takes 3 waypoints .* there are 2"):
        apply(state, SetMove(3, path="circle"))


def test_a_move_that_is_straight_for_want_of_waypoints_says_so():
    lines = judged(planned_now(with_planned(arcs(3)))).lines
    takes = "takes 3 waypoints with moves of one kind between them"
    assert f"move 3 → 4: a straight line here: Circle through three points {takes}" in lines
    assert not [line for line in judged(planned_now(with_planned(arcs(4)))).lines if "straight line" in line]


def test_a_circle_behind_half_an_arc_is_that_of_the_chosen_move():
    state = done(opened("puma560", 4), SetMove(1, space="cartesian"), AllMovesLike(1), SetMove(1, path="circle"))
    state = done(
        state, RemoveWaypoint(1), RandomPose(), AddWaypoint(), SetMove(2, path="line"), SetMove(3, path="line")
    )
    assert state[Plan].moves[0].path.key == "circle"
    assert [key for _, key in laid(state)] == ["line"] * 3
    for k in (2, 3):
        assert done(state, SetMove(k, path="circle"))[Plan].stretch_to(k).move.path.key == "circle"
    assert laid(done(state, SetMove(3, path="circle"))) == [("1 → 2", "line"), ("2 → 4", "circle")]
    assert laid(done(state, SetMove(1, path="circle"))) == [("1 → 3", "circle"), ("3 → 4", "line")]


def test_half_an_arc_is_changed_as_it_is_shown_and_a_stop_that_goes_brings_the_arc_back():
    slow = done(arcs(2), SetMove(2, law="constant"), SetMove(1, stop=True))
    assert [(part.move.path.key, part.move.law.key) for part in slow[Plan].parts] == [("line", "trapezoidal")] * 2
    assert done(slow, SetMoveOption(2, "law", "ramp", 0.3))[Plan].parts[1].move.law.options == {"ramp": 0.3}
    assert done(slow, SetMove(2, law="constant"))[Plan].parts[1].move.law.key == "constant"
    assert laid(done(slow, AllMovesLike(2))) == [("1 → 2", "line"), ("2 → 3", "line")]
    assert laid(done(slow, SetMove(1, stop=False))) == [("1 → 3", "circle")]
    cubic = done(slow, SetMove(1, law="cubic"), SetMove(2, law="cubic"), SetMove(1, stop=False))
    assert laid(cubic) == [("1 → 3", "circle")]


@pytest.mark.parametrize("rest", [SetAtWaypoint(1, "wait", 0.5), SetMove(1, stop=True)])
@pytest.mark.parametrize("k", [1, 2])
def test_a_circle_across_a_rest_is_refused_in_a_sentence(k, rest):
    state = done(opened("puma560"), TakeExample("circle"), SetMove(1, path="line"), rest)
    says = f"move {k} → {k + 1}: Circle through three points takes 3 waypoints .* or take the rest at waypoint 2 away"
    with pytest.raises(InputError, match=says):
        apply(state, SetMove(k, path="circle"))


@pytest.mark.parametrize(("path", "spaces"), [("blends", ("joint", "cartesian")), ("circle", ("cartesian", "joint"))])
def test_a_path_that_another_space_has_not_becomes_a_line_that_rests_at_its_ends(path, spaces):
    state = done(opened("puma560"), TakeExample("circle"), SetMove(1, path="line"), SetMove(2, path="line"))
    state = done(
        state, *(SetMove(k, space=spaces[0]) for k in (1, 2)), SetMove(1, path=path), SetMove(1, law="constant")
    )
    moves = done(state, SetMove(1, space=spaces[1]))[Plan].moves
    assert (moves[0].path.key, moves[0].law.key) == ("line", "trapezoidal")


def test_other_ends_of_a_spline_drop_what_they_cannot_use():
    chosen = after(after(Chosen("spline"), "v_start", (0.1, 0.2)), "duration", 3.0)
    assert after(chosen, "ends", "both").given == (("duration", 3.0), ("ends", "both"), ("v_start", (0.1, 0.2)))
    natural = after(chosen, "ends", "natural")
    assert natural.given == (("duration", 3.0), ("ends", "natural"))
    assert after(after(natural, "a_start", (0.5, 0.5)), "ends", None).given == (("duration", 3.0),)
    assert after(chosen, "times", (0.0, 1.0)).given == (("times", (0.0, 1.0)), ("v_start", (0.1, 0.2)))


def test_an_amount_in_metres_is_not_taken_for_seconds():
    chosen = after(Chosen("overfly"), "amount", (0.05,))
    assert after(chosen, "by", "d2").options == {"by": "d2", "amount": (0.05,)}
    assert after(chosen, "by", "time").options == {"by": "time"}
    timed = after(after(chosen, "by", "time"), "amount", (0.2,))
    assert after(timed, "shape", "quartic").options == {"by": "time", "amount": (0.2,), "shape": "quartic"}
    assert after(timed, "by", None).options == {}


def test_what_is_written_down_is_read_back_with_options_that_depend_on_each_other():
    for options in ({"by": "time", "amount": (0.2,)}, {"ends": "both", "a_end": (1.0,), "v_start": (1.0,)}):
        chosen = Chosen.of(KINDS, "overfly" if "by" in options else "spline", **options)
        assert chosen.options == options
        assert Chosen.from_json(chosen.to_json(), KINDS) == chosen


def test_an_option_that_cannot_be_used_is_refused_in_words():
    state = State.initial(catalogue()["planar_2r"])
    part = state[Plan]
    moves = tuple(Move(path=Chosen("spline"), law=Chosen("constant")) for _ in part.moves)
    state = state.replace(replace(part, moves=moves))
    with pytest.raises(InputError, match="a_start: cannot be used while velocities are given at both ends"):
        apply(state, SetMoveOption(1, "path", "a_start", [0.1, 0.1]))
    state = apply(state, SetMoveOption(1, "path", "ends", "natural"))
    state = apply(state, SetMoveOption(1, "path", "a_start", [0.1, 0.1]))
    assert apply(state, SetMoveOption(1, "path", "ends", "clamped"))[Plan].moves[0].path.options == {"ends": "clamped"}


def with_list(path, name, value, points=3):
    """Return a state with a path through waypoints with an option that lists values."""
    state = opened("planar_2r", points)
    return apply(apply(state, SetMove(1, path=path)), SetMoveOption(1, "path", name, value))


@pytest.mark.parametrize("edit", [AddWaypoint(), RemoveWaypoint(1)])
@pytest.mark.parametrize(
    ("path", "name", "value"),
    [
        ("hermite", "velocities", [[0.0, 0.0], [0.1, 0.2], [0.3, 0.0], [0.0, 0.0]]),
        ("spline", "times", [0.0, 1.0, 2.5, 3.0]),
        ("overfly", "amount", [0.01, 0.02]),
        ("overfly", "speed", [0.5, 0.6, 0.7]),
        ("blends", "blend", [0.01, 0.02, 0.02, 0.01]),
    ],
)
def test_values_for_another_number_of_waypoints_are_dropped(path, name, value, edit):
    state = with_list(path, name, value, points=4)
    assert name in state[Plan].moves[0].path.options
    state = apply(apply(state, RandomPose()), edit)
    refuse_pathless(state[Joints].arm, state[Plan])
    assert name not in state[Plan].moves[0].path.options


def test_moves_that_become_one_stretch_drop_what_was_listed_for_the_shorter():
    state = apply(opened("planar_2r", 4), SetMove(2, stop=True))
    state = apply(apply(state, SetMove(1, path="hermite")), SetMoveOption(1, "path", "velocities", [[0.0, 0.0]] * 3))
    assert (
        apply(state, AllMovesLike(1))[Plan].moves == (Move(path=Chosen("hermite"), law=state[Plan].moves[0].law),) * 3
    )


def test_a_wait_that_divides_a_path_elsewhere_drops_what_was_listed():
    state = apply(opened("planar_2r", 5), SetAtWaypoint(2, "wait", 0.5))
    state = apply(apply(state, SetMove(1, path="spline")), SetMoveOption(1, "path", "times", [0.0, 1.0, 3.0]))
    shifted = apply(state, ShiftWaypoint(2, -1))[Plan]
    assert "times" not in shifted.moves[0].path.options
    assert apply(state, ShiftWaypoint(0, 1))[Plan].moves == state[Plan].moves


def test_times_of_virtual_knots_stay_as_long_as_they_fit_the_intervals():
    state = with_list("spline", "ends", "both", points=6)
    state = apply(state, SetMoveOption(1, "path", "spacing", "uniform"))
    state = apply(
        apply(state, SetMoveOption(1, "path", "duration", 5.0)), SetMoveOption(1, "path", "virtual", [0.9, 4.5])
    )
    for kept in (SetMove(1, law="cubic"), ShiftWaypoint(0, 1), AllMovesLike(1), RemoveWaypoint(5)):
        assert apply(state, kept)[Plan].moves[0].path.options["virtual"] == (0.9, 4.5)
    more = apply(apply(state, RandomPose()), AddWaypoint())[Plan].moves[0].path.options
    assert more == {"ends": "both", "spacing": "uniform", "duration": 5.0}


def test_derivatives_at_the_ends_belong_to_no_waypoint_and_stay():
    state = apply(opened("planar_2r", 2), SetMove(1, path="polynomial"))
    state = apply(state, SetMoveOption(1, "path", "start", [[0.1, 0.1]]))
    given = state[Plan].moves[0].path.options["start"]
    assert apply(state, SetMove(1, law="cubic"))[Plan].moves[0].path.options["start"] == given


@pytest.mark.parametrize(
    ("robot", "joint", "says"),
    [
        ("puma560", 0, "waypoint 2: joint 1 goes from −160° to 160°"),
        ("scara", 2, "waypoint 2: joint 3 goes from 0 m to "),
    ],
)
def test_a_joint_outside_its_limits_is_told_what_they_are(robot, joint, says):
    with pytest.raises(InputError) as refusal:
        apply(State.initial(catalogue()[robot]), SetWaypointJoint(1, joint, 50.0))
    assert str(refusal.value).startswith(says)
    assert str(refusal.value).endswith("°" if joint == 0 else " m")


def makes_the_same_motion(state, folder):
    """Run the script of a plan, and compare what it writes with the planned motion."""
    motion = planned_now(state).motion
    with chdir(folder):
        exec(motion_script(state[RobotPart], planned_now(state), 40.0, "motion.csv"), {"__name__": "script"})
    rows = np.loadtxt(folder / "motion.csv", delimiter=",", skiprows=1)
    np.testing.assert_allclose(rows[:, 1 : 1 + state[Joints].arm.n], motion.sample(rate=40.0).q, rtol=0, atol=1e-9)


def test_the_script_of_a_plan_lays_the_same_way(rng, tmp_path):
    state = State.initial(catalogue()["scara"])
    arm, part = state[Joints].arm, state[Plan]
    points = tuple(Waypoint(tuple(q)) for q in rng.uniform(*(0.5 * arm.limits.T), size=(4, arm.n)).tolist())
    moves = (Move(path=Chosen("overfly", (("speed", (0.7,)),))),) * 3
    makes_the_same_motion(
        with_planned(state.replace(replace(part, waypoints=points, moves=moves, example=""))), tmp_path
    )


def test_the_script_of_a_whole_circle_makes_the_same_motion(tmp_path):
    state = done(opened("puma560"), TakeExample("circle"), SetMoveOption(1, "path", "full", True))
    pose = state[Plan].waypoints[2].wanted(state[Joints].arm)
    pose[:3, :3] = rotation_about("z", 0.3) @ pose[:3, :3]
    state = done(state, SetWaypointPose(2, pose), SetAtWaypoint(2, "wait", 0.5))
    makes_the_same_motion(with_planned(state), tmp_path)
