"""A limit that is given is kept, or refused with the reason: joints, jumps, durations, an arm's own."""

import re

import numpy as np
import pytest

import armlab
from armlab.errors import InputError
from armlab.kin.motion import (
    Limits,
    Sequential,
    Trajectory,
    coordinated,
    independent,
    law_bounds,
    law_type,
    minimum_time_spline,
    path_type,
    peaks,
    run_along,
    violations,
)
from armlab.kin.motion.law_types import free_law_types, law_types
from armlab.kin.motion.limits import NAMES

LIMITS = Limits([2.0, 1.0, 3.0], [5.0, 8.0, 2.0])


def test_a_deceleration_above_its_limit_is_refused():
    with pytest.raises(InputError, match="sddot_down: expected at most the limit of acceleration 1, got 10"):
        coordinated([0.0, 0.0], [1.0, 0.5], limits=Limits(acceleration=1.0), sddot_down=10.0)
    slow = coordinated([0.0, 0.0], [1.0, 0.5], limits=Limits(acceleration=1.0), sddot_down=0.25)
    np.testing.assert_allclose(peaks(slow, 2).peak, [1.0, 0.5], rtol=1e-9)


@pytest.mark.parametrize("asked", [0.15, 0.1, 0.05, 0.02, 0.001])
def test_along_any_path_a_deceleration_is_at_most_the_one_asked_for(asked):
    path, limits = path_type("quintic").path([[0.0, 0.0], [1.0, 0.5]]), Limits(1.0, 2.0)
    motion = run_along(path, "trapezoidal", limits, sddot_down=asked)
    assert 0.5 * asked < -motion.law.derivatives(motion.duration, (2,), before=True)[0] <= asked * (1.0 + 1e-9)
    assert violations(motion, limits) == []
    assert motion.duration > run_along(path, "trapezoidal", limits).duration
    assert motion.duration < 1.01 * run_along(path, "trapezoidal", limits, sddot_down=0.99 * asked).duration


@pytest.mark.parametrize("law", ["cubic", "quintic", "trapezoidal", "double_s", "cosine", "time_optimal"])
def test_a_duration_too_short_for_the_limits_is_refused_with_the_shortest_that_is_not(law):
    q = [0.0, 0.0, 0.0], [10.0, -4.0, 1.0]
    with pytest.raises(InputError, match=r"duration: .* ([\d.]+) s$") as refused:
        coordinated(*q, law, LIMITS, duration=1.0)
    shortest = float(str(refused.value).split()[-2])
    with pytest.raises(InputError, match="duration"):
        coordinated(*q, law, LIMITS, duration=shortest * (1.0 - 1e-4))
    found = coordinated(*q, law, LIMITS, duration=shortest)
    assert violations(found, LIMITS) == []


@pytest.mark.parametrize(
    "limits", [Limits(1.0, 1.0), Limits(1.0, 5.0), Limits(1.0, 50.0), Limits(0.9, 5.0), Limits(1.0, 2.0, 9.0)]
)
@pytest.mark.parametrize("duration", [1.0, 2.45])
def test_with_end_speeds_the_duration_that_is_told_holds_for_the_ramp_that_is_typed(limits, duration):
    law = "double_s" if limits.bounded[2] else "trapezoidal"
    line, ends = path_type("line").path([[0.0], [2.0]]), {"sdot_start": 0.3, "sdot_end": 0.1}
    fastest = run_along(line, law, limits, **ends)
    np.testing.assert_allclose(fastest.limits_at(np.array([0.0]), False)[1], [[0.6]], rtol=1e-12)
    both = r"without a duration it takes ([\d.]+) s, with ramps of 0\.333 T ([\d.]+) s is long enough$"
    with pytest.raises(InputError, match=both) as refused:
        run_along(line, law, limits, duration=duration, **ends)
    left_out, enough = map(float, re.search(both, str(refused.value)).groups())
    assert left_out == pytest.approx(fastest.duration, rel=1e-5)
    with pytest.raises(InputError, match="duration"):
        run_along(line, law, limits, duration=enough * (1.0 - 1e-4), **ends)
    found = run_along(line, law, limits, duration=enough, **ends)
    assert violations(found, limits, from_rest=False) == []


def test_where_shorter_ramps_would_do_both_durations_are_told():
    line = path_type("line").path([[0.0], [1.0]])
    both = r"without a duration it takes 1\.01 s, with ramps of 0\.333 T it takes at least 1\.5 s$"
    with pytest.raises(InputError, match=both):
        run_along(line, limits=Limits(1.0, 100.0), duration=1.2)
    assert run_along(line, limits=Limits(1.0, 100.0), duration=1.2, ramp=0.1).duration == pytest.approx(1.2)


def test_where_a_longer_time_keeps_no_limit_the_end_speeds_are_to_be_lowered():
    line, limits = path_type("line").path([[0.0], [1.0]]), Limits(3.0, 0.9)
    ends = {"sdot_start": 1.0, "sdot_end": 1.0}
    assert violations(run_along(line, limits=limits, duration=1.3, **ends), limits, from_rest=False) == []
    # At a mean speed of 1/2 it has to slow down to almost nothing and to speed up again.
    with pytest.raises(InputError, match=r"takes 0\.8409 s, or lower sdot_start or sdot_end$"):
        run_along(line, limits=limits, duration=2.0, **ends)


def test_an_end_speed_above_the_limit_is_refused():
    line = path_type("line").path([[0.0], [2.0]])
    with pytest.raises(InputError, match=r"sdot_start: expected at most the speed limit 0\.5, got 0\.6"):
        run_along(line, "trapezoidal", Limits(1.0, 1.0), sdot_start=0.6)


@pytest.mark.parametrize("law", list(free_law_types()))
def test_on_a_line_every_law_keeps_every_limit_or_refuses_it(law):
    for limits in (Limits(1.0), Limits(1.0, 2.0), Limits(1.0, 2.0, 30.0), Limits(jerk=5.0), Limits(np.inf, 2.0, 5.0)):
        kind, line = law_type(law), path_type("line").path([[0.0, 1.0], [1.0, 0.7]])
        if any(not limits.bounded[NAMES.index(need)] for need in kind.needs):
            with pytest.raises(InputError, match=r"limit of \w+: .* needs one"):
                run_along(line, law, limits)
            continue
        smooth = kind.law().continuity_from_rest
        kept = [name for name, finite in zip(NAMES, limits.bounded, strict=True) if finite]
        if NAMES.index(kept[-1]) > smooth:
            with pytest.raises(InputError, match=r"so no time keeps it|none of those given can hold back"):
                run_along(line, law, limits)
            continue
        assert violations(run_along(line, law, limits), limits) == []


def test_a_corner_exceeds_a_limit_of_acceleration_for_an_instant():
    corner = path_type("polyline").path([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    motion = Trajectory(corner, law_type("quintic").law(20.0))
    assert violations(motion, Limits(velocity=1.0)) == []
    found = violations(motion, Limits(1.0, 1.0))
    assert [(each.joint, each.quantity) for each in found] == [(1, "acceleration"), (2, "acceleration")]
    for each in found:
        assert each.start == each.end == pytest.approx(10.0, abs=1e-9)
    with pytest.raises(InputError, match=r"limit of acceleration: the velocity of joint 1 jumps at .* s, so no time"):
        run_along(corner, "quintic", Limits(1.0, 1.0))
    only_second = Limits(acceleration=[np.inf, 1.0])
    assert [each.joint for each in violations(motion, only_second)] == [2]


@pytest.mark.parametrize("duration", [None, 20.0])
@pytest.mark.parametrize("end", ["sdot_start", "sdot_end"])
def test_end_speeds_excuse_jumps_at_their_own_end_only(end, duration):
    line, corner = (path_type("polyline").path(q) for q in ([[0.0], [1.0]], [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]))
    for path, limits in ((line, Limits(1.0, 2.0, 5.0)), (corner, Limits(1.0, 2.0))):
        with pytest.raises(InputError, match=r"limit of \w+: the \w+ of joint 1 jumps at .* s, so no time keeps it"):
            run_along(path, "trapezoidal", limits, duration=duration, **{end: 0.01})
    for law, limits in (("trapezoidal", Limits(1.0, 2.0)), ("double_s", Limits(1.0, 2.0, 5.0))):
        motion = run_along(line, law, limits, duration=duration, **{end: 0.01})
        assert violations(motion, limits, from_rest=False) == []


@pytest.mark.parametrize("gap", [1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7])
@pytest.mark.parametrize("size", [1.0, 1e3])
def test_no_corner_hides_beside_two_waypoints_that_are_almost_the_same(gap, size):
    points = size * np.array([[1.0, 0.5], [2.0, 0.5], [2.0, 0.5 + gap], [2.0, 1.5]])
    with pytest.raises(InputError, match=r"waypoint 3: the same as waypoint 2|the velocity of joint 1 jumps"):
        run_along(path_type("polyline").path(points), "quintic", Limits(1.0, 2.0))


def test_a_constant_speed_jumps_at_both_ends_unless_it_was_moving_before():
    motion = coordinated([0.0], [1.0], "constant", duration=2.0)
    found = violations(motion, Limits(acceleration=1.0))
    assert [each.start for each in found] == [0.0, 2.0]
    assert violations(motion, Limits(acceleration=1.0), from_rest=False) == []
    with pytest.raises(InputError, match="limit of acceleration: the velocity of joint 1 jumps at 0 s"):
        coordinated([0.0], [1.0], "constant", Limits(1.0, 1.0))
    with pytest.raises(InputError, match="limit of acceleration: the speed of Constant speed jumps"):
        law_type("constant").within(Limits(1.0, 1.0))


def test_a_jumping_acceleration_exceeds_a_limit_of_jerk_wherever_it_jumps_and_once():
    motion = Sequential([coordinated([a], [a + 1.0], duration=3.0) for a in (0.0, 1.0)])
    found = violations(motion, Limits(jerk=10.0))
    np.testing.assert_allclose([each.start for each in found], [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0], rtol=0, atol=1e-9)
    for law in ("cubic", "trapezoidal", "bang_bang", "cosine", "table", "time_optimal"):
        with pytest.raises(InputError, match=r"limit of jerk: the acceleration of .* jumps"):
            coordinated([0.0], [1.0], law, Limits(1.0, 1.0, 10.0))


def test_a_jump_is_told_also_where_the_joint_exceeds_the_limit_at_another_time():
    thirds, hasty = (
        coordinated([0.0], [1.0], duration=21.0, ramp=1 / 3),
        coordinated([1.0], [2.0], "quintic", duration=1.0),
    )
    found = violations(Sequential([thirds, hasty]), Limits(jerk=10.0))
    np.testing.assert_allclose([each.start for each in found[:3]], [0.0, 7.0, 14.0], rtol=0, atol=1e-9)
    assert all(each.start == each.end for each in found[:3])
    # The last jump is where the jerk of the quintic is above its limit anyway, and is told once.
    assert found[3].start == pytest.approx(21.0, abs=1e-9)
    assert all(each.start < each.end for each in found[3:])


def test_the_limits_of_an_arm_stand_for_themselves():
    arm = armlab.load("canadarm2")
    start, end = np.zeros(arm.n), np.linspace(0.3, 0.9, arm.n)
    own = Limits(arm.speed_limits, arm.acceleration_limits)
    assert coordinated(start, end, "quintic", arm).duration == coordinated(start, end, "quintic", own).duration
    assert violations(coordinated(start, end, "quintic", arm), arm) == []
    half = Limits.of(arm, velocity=0.5 * arm.speed_limits)
    np.testing.assert_array_equal(half.acceleration, arm.acceleration_limits)
    assert coordinated(start, end, "quintic", half).duration > coordinated(start, end, "quintic", arm).duration
    outside = coordinated(start, start + 20.0, "quintic", arm)
    assert {each.quantity for each in violations(outside, arm)} == {"position"}


def test_an_arm_without_limits_says_so():
    arm = armlab.Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 2)
    with pytest.raises(InputError, match=r"limits: .* has none of its own; give Limits\(velocity"):
        coordinated([0.0, 0.0], [1.0, 1.0], "quintic", arm)
    # Those of its positions it has all the same.
    far = coordinated([0.0, 0.0], [4.0, 1.0], "quintic", duration=1.0)
    assert [(each.joint, each.quantity) for each in violations(far, arm)] == [(1, "position")]


def test_a_limit_that_no_motion_lasts_long_enough_for_is_refused():
    with pytest.raises(InputError, match=r"limit of velocity: expected a number from 1e-60 to 1e.60, got 1e-200"):
        coordinated([0.0], [1.0], limits=Limits(1e-200, 1.0))
    with pytest.raises(InputError, match="limits: the time within them"):
        coordinated([0.0], [1.0], limits=Limits(1e-59, 1.0))


def test_limits_are_written_as_they_can_be_typed():
    for limits in (Limits(), Limits(2.0), Limits([1.0, 2.0], jerk=3.0)):
        again = eval(repr(limits), {"Limits": Limits})
        for one, other in zip(limits.each, again.each, strict=True):
            np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("law", list(law_types()))
def test_independent_joints_keep_their_limits(law):
    limits = Limits(LIMITS.velocity) if law == "constant" else LIMITS
    more = {"shape": Limits(limits.velocity, limits.acceleration, 40.0)} if law == "double_s" else {}
    motion = independent([0.0, 1.0, 2.0], [1.0, 1.0, -3.0], law, limits, **more)
    assert violations(motion, limits) == []
    np.testing.assert_allclose(motion.at(motion.duration), [1.0, 1.0, -3.0], rtol=0, atol=1e-9)


def test_every_function_takes_limits_and_nothing_else(rng):
    path = path_type("spline").path(rng.normal(size=(4, 2)))
    for call in (
        lambda: law_bounds(path, 2.0),
        lambda: run_along(path, "quintic", 2.0),
        lambda: minimum_time_spline(rng.normal(size=(4, 2)), 2.0),
        lambda: violations(Trajectory(path, law_type("quintic").law()), 2.0),
    ):
        with pytest.raises(InputError, match="limits: expected Limits"):
            call()
