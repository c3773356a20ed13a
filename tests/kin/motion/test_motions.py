"""Trajectories and what is made of them: chain rule, sequences, peaks, violations, bounds, scaling, coordination."""

from itertools import pairwise

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.motion.bounds import law_bounds
from armlab.kin.motion.coordinated import coordinated, independent
from armlab.kin.motion.law_types import law_type, law_types
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.minimum_time import minimum_time_spline
from armlab.kin.motion.path_types import path_type
from armlab.kin.motion.peaks import peaks, violations
from armlab.kin.motion.scaling import as_fast_as_allowed, optimal_scaling, scaled
from armlab.kin.motion.sequence import Separate, Sequential, Slowed
from armlab.kin.motion.trajectory import Trajectory, times_at
from armlab.kin.timing.table import acceleration_law

V, A = np.array([2.0, 1.0, 3.0]), np.array([5.0, 8.0, 2.0])


def motions(rng):
    """Return one motion of each make."""
    q = rng.normal(size=(6, 3))
    spline = Trajectory(path_type("spline").path(q), law_type("double_s").law(2.0))
    corners = [coordinated(a, b, "cubic", duration=0.5) for a, b in pairwise(q)]
    circle = Trajectory(path_type("circle").path(q[:3]), law_type("cosine").law(1.5))
    wobbling = law_type("table").law(2.0, rows=[[0, 2, 1], [2, 4, -0.9], [4, 5, 1]])
    return {
        "spline": spline,
        "corners": Sequential(corners),
        "circle": circle,
        "separate": independent(q[0], q[1], "double_s", Limits(V, A, 30.0)),
        "slowed": Slowed(spline, 1.7),
        "overfly": Trajectory(path_type("overfly").path(q), law_type("trapezoidal").law(3.0)),
        "table": Trajectory(path_type("lts_434").path(q[:4]), wobbling),
    }


NAMES = ["spline", "corners", "circle", "separate", "slowed", "overfly", "table"]


@pytest.fixture(params=NAMES)
def motion(request, rng):
    return motions(rng)[request.param]


def test_derivatives_in_time_are_those_of_differences(motion, rng):
    T, h = motion.duration, 1e-5 * motion.duration
    t = rng.uniform(2 * h, T - 2 * h, 300)
    t = t[np.abs(t[:, None] - motion.pieces).min(axis=1, initial=T) > 3 * h]
    for order in range(1, 4):
        differences = (motion.at(t + h, order - 1) - motion.at(t - h, order - 1)) / (2 * h)
        size = max(np.abs(motion.at(t, k)).max() for k in range(order + 1))
        np.testing.assert_allclose(motion.at(t, order), differences, rtol=0, atol=2e-6 * size)


def test_exact_peaks_are_those_of_dense_samples(motion):
    t = np.linspace(0, motion.duration, 100001)
    sides = [motion.limits_at(motion.edges, side) for side in (True, False)]
    for order in range(3):
        found = peaks(motion, order)
        dense = np.concatenate([motion.at(t, order), *(side[order] for side in sides)])
        size = np.abs(dense).max()
        assert np.all(found.highest >= dense.max(axis=0) - 1e-9 * size)
        assert np.all(found.lowest <= dense.min(axis=0) + 1e-9 * size)
        np.testing.assert_allclose(found.peak, np.abs(dense).max(axis=0), rtol=0, atol=1e-4 * size)
        at_peak = np.array([motion.at(found.peak_at[j], order)[j] for j in range(motion.m)])
        before = np.array([motion.at(found.peak_at[j] - 1e-9, order)[j] for j in range(motion.m)])
        reached = np.maximum(np.abs(at_peak), np.abs(before))
        assert np.all((reached > 0.999 * found.peak) | (found.peak_at == 0.0) | (found.peak < 1e-9 * size))


def test_violations_are_where_samples_exceed_and_nowhere_else(motion):
    limits = {"velocity": 0.6 * peaks(motion, 1).peak + 1e-9, "acceleration": 0.6 * peaks(motion, 2).peak + 1e-9}
    low, high = peaks(motion, 0).lowest, peaks(motion, 0).highest
    positions = np.column_stack([low + 0.2 * (high - low), high + 1.0])
    found = violations(motion, Limits(**limits), positions=positions)
    t = np.linspace(0, motion.duration, 20001)
    for quantity, order in (("position", 0), ("velocity", 1), ("acceleration", 2)):
        values = motion.at(t, order)
        for j in range(motion.m):
            if quantity == "position":
                outside = (values[:, j] < positions[j, 0]) | (values[:, j] > positions[j, 1])
            else:
                outside = np.abs(values[:, j]) > limits[quantity][j] * (1 + 1e-8)
            mine = [(v.start, v.end) for v in found if (v.joint, v.quantity) == (j + 1, quantity)]
            inside = np.zeros(len(t), dtype=bool)
            near = np.zeros(len(t), dtype=bool)
            for a, b in mine:
                inside |= (t >= a) & (t <= b)
                near |= (np.abs(t - a) < 1e-4) | (np.abs(t - b) < 1e-4)
            assert np.array_equal(inside | near, outside | near), (quantity, j)
    assert violations(motion, Limits(1.001 * peaks(motion, 1).peak + 1e-9)) == []


def test_limits_kept_exactly_are_not_violated(motion):
    fast, scaling = as_fast_as_allowed(motion, Limits(V[: motion.m], A[: motion.m]))
    assert violations(fast, Limits(V[: motion.m], A[: motion.m])) == []
    used = np.concatenate([peaks(fast, 1).peak / V, peaks(fast, 2).peak / A])
    assert used.max() == pytest.approx(1.0, rel=1e-9)
    assert fast.duration == pytest.approx(motion.duration * scaling.k)
    limit = (V if scaling.quantity == "velocity" else A)[scaling.joint - 1]
    order = 1 if scaling.quantity == "velocity" else 2
    assert peaks(fast, order).peak[scaling.joint - 1] == pytest.approx(limit, rel=1e-9)


def test_slowed_by_k_the_path_stays_and_derivatives_shrink(motion):
    slow = scaled(motion, 2.5)
    t = np.linspace(0, motion.duration, 101)[1:-1]
    for order in range(4):
        expected = motion.at(t, order) / 2.5**order
        size = np.abs(expected).max() + 1
        t_safe = np.abs(t[:, None] - motion.pieces).min(axis=1, initial=1) > 1e-6
        np.testing.assert_allclose(slow.at(2.5 * t, order)[t_safe], expected[t_safe], rtol=0, atol=1e-9 * size)


@pytest.mark.parametrize(
    ("name", "inside", "from_rest"),
    [("spline", 2, 2), ("corners", 1, 1), ("circle", 3, 1), ("separate", 2, 2), ("overfly", 1, 1)],
)
def test_the_class_of_a_motion(name, inside, from_rest, rng):
    found = motions(rng)[name]
    assert (found.continuity, found.continuity_from_rest) == (inside, from_rest)


def test_a_corner_without_a_stop_makes_the_velocity_jump_and_with_one_it_does_not():
    corner = path_type("polyline").path([[0, 0], [1, 0], [1, 1]])
    through = Trajectory(corner, law_type("quintic").law(2.0))
    assert through.continuity == 0
    np.testing.assert_allclose(through.breaks, [1.0], rtol=0, atol=1e-9)
    stopping = law_type("table").law(2.0, rows=[[0, 1, 1], [1, 2, -1], [2, 3, 1], [3, 4, -1]])
    assert Trajectory(corner, stopping).continuity == 1


def test_times_at_which_a_law_that_turns_back_passes_a_place():
    law = acceleration_law([[0, 1, 2], [1, 3, -2], [3, 4, 2]])
    # s = t^2, then 2 - (t - 2)^2, and back to 0.
    np.testing.assert_allclose(times_at(law, np.array([0.25])), [0.5, 3.5], rtol=0, atol=1e-9)


def test_a_law_that_leaves_the_path_is_refused():
    line = path_type("line").path([[0, 0], [1, 1]])
    with pytest.raises(InputError, match="law: s must stay from 0 to 1 along a path, and goes from 0 to 2"):
        Trajectory(line, law_type("quintic").law(1.0, 2.0))
    with pytest.raises(InputError, match="one that ends at s = 1"):
        Trajectory(line, law_type("quintic").law(1.0, 0.5))


def test_motions_that_do_not_meet_are_refused():
    one, other = (coordinated([0.0], [1.0], duration=1.0) for _ in range(2))
    with pytest.raises(InputError, match="motion 2: begins 1 from where motion 1 ends"):
        Sequential([one, other])
    with pytest.raises(InputError, match="motions: expected at least one"):
        Sequential([])
    with pytest.raises(InputError, match="motion 2: expected 1 coordinates as in motion 1, got 2"):
        Sequential([one, coordinated([1.0, 0.0], [1.0, 2.0], duration=1.0)])


def test_samples():
    samples = coordinated([0.0, 1.0], [1.0, 3.0], "quintic", duration=2.0).sample(rate=100)
    assert samples.t.shape == (201,)
    assert samples.q.shape == samples.qdddot.shape == (201, 2)
    assert samples.t[-1] == 2.0
    np.testing.assert_allclose(np.gradient(samples.q, samples.t, axis=0)[1:-1], samples.qdot[1:-1], rtol=0, atol=1e-2)
    with pytest.raises(InputError, match="either the number of samples or the rate"):
        coordinated([0.0], [1.0], duration=1.0).sample()


@pytest.mark.parametrize("law", list(law_types()))
def test_coordinated_joints_start_and_end_together_within_their_limits(law, rng):
    held = {"constant": Limits(V), "quintic": Limits(V, A, 50.0), "septic": Limits(V, A, 50.0)}
    held["double_s"] = held["quintic"]
    for _ in range(5):
        q_i, q_f = rng.normal(size=(2, 3))
        limits = held.get(law, Limits(V, A))
        found = coordinated(q_i, q_f, law, limits)
        np.testing.assert_allclose(found.at([0.0, found.duration]), [q_i, q_f], rtol=0, atol=1e-10)
        assert violations(found, limits) == []
        ratio = (found.at(0.37 * found.duration) - q_i) / (q_f - q_i)
        np.testing.assert_allclose(ratio, ratio[0], rtol=0, atol=1e-12)


def test_alone_each_joint_is_at_least_as_fast(rng):
    for _ in range(10):
        q_i, q_f = rng.normal(size=(2, 3))
        together = coordinated(q_i, q_f, limits=Limits(V, A))
        apart = independent(q_i, q_f, limits=Limits(V, A))
        assert apart.duration <= together.duration * (1 + 1e-12)
        assert isinstance(apart, Separate)
        np.testing.assert_allclose(apart.at(apart.duration), q_f, rtol=0, atol=1e-12)
        # One of the joints uses its speed or its acceleration up.
        assert np.all(np.maximum(peaks(apart, 1).peak / V, peaks(apart, 2).peak / A) >= 1 - 1e-9)


def test_a_joint_that_does_not_move_stays():
    found = independent([0.0, 1.0], [2.0, 1.0], limits=Limits(1.0, 1.0))
    assert np.all(found.at(np.linspace(0, found.duration, 11))[:, 1] == 1.0)
    with pytest.raises(InputError, match="end: the same as the start"):
        coordinated([1.0], [1.0], duration=1.0)


def test_a_law_within_the_bounds_keeps_every_joint_within_its_limits(rng):
    for _ in range(10):
        path = path_type("spline").path(rng.normal(size=(6, 3)))
        bounds = law_bounds(path, Limits(V, A))
        bounds = bounds if bounds.possible else bounds.lowered()
        assert bounds.possible
        trajectory = Trajectory(path, law_type("double_s").within(Limits(bounds.V, bounds.A, 1e3)))
        assert np.all(peaks(trajectory, 1).peak <= V * (1 + 1e-9))
        assert np.all(peaks(trajectory, 2).peak <= A * (1 + 1e-9))


def test_without_a_limit_of_speed_the_bends_alone_bound_it():
    path = path_type("circle").path([[1, 0], [0, 1], [-1, 0]])
    bounds = law_bounds(path, Limits(acceleration=1.0))
    assert not bounds.possible
    assert "Without a limit" in bounds.explanation
    lowered = bounds.lowered()
    assert lowered.possible
    assert lowered.V < bounds.V_bend == pytest.approx(1 / np.pi)
    assert law_bounds(path_type("line").path([[0.0], [2.0]]), Limits(acceleration=1.0)).A == 0.5
    assert np.inf == law_bounds(path, Limits(1.0)).A


def test_a_limit_of_jerk_cannot_be_kept_where_the_acceleration_jumps():
    smooth, rough = (coordinated([0.0], [1.0], law, duration=1.0) for law in ("quintic", "cubic"))
    found, scaling = as_fast_as_allowed(smooth, Limits(10.0, 50.0, 0.06))
    assert (scaling.quantity, scaling.k) == ("jerk", pytest.approx(10.0))
    assert peaks(found, 3).peak[0] == pytest.approx(0.06)
    with pytest.raises(InputError, match="limit of jerk: the acceleration of joint 1 jumps at 0 s"):
        as_fast_as_allowed(rough, Limits(10.0, 50.0, 0.06))


def test_the_jerk_of_a_joint_counts_also_where_the_acceleration_of_another_jumps():
    laws = [law_type(key).law(1.0) for key in ("quintic", "trapezoidal")]
    motion = Separate(np.zeros(2), np.ones(2), laws)
    for jumps in (False, True):
        found, scaling = as_fast_as_allowed(motion, Limits(10.0, 100.0, [1.0, np.inf]), jumps=jumps)
        assert (scaling.joint, scaling.quantity) == (1, "jerk")
        assert peaks(found, 3).peak[0] == pytest.approx(1.0)
    with pytest.raises(InputError, match="limit of jerk: the acceleration of joint 2 jumps at 0 s"):
        as_fast_as_allowed(motion, Limits(10.0, 100.0, 1.0))


def test_rounding_of_a_factor_of_time_hides_no_jump():
    constant = coordinated([0.0], [1.0], "constant", duration=0.7)
    both = independent([0.0, 1.0], [1.0, -1.0], "bang_bang", Limits([1.4, 0.98], [2.0, 3.0]))
    for k in np.linspace(0.5, 3.0, 401):
        slow, slower = Slowed(constant, k), scaled(both, k)
        assert slow.at(slow.duration, 1)[0] == pytest.approx(1.0 / (0.7 * k))
        assert [time for _, time in slow.jumps(1)] == [0.0, slow.duration]
        assert (slower.continuity, len(slower.jumps(2))) == (1, len(both.jumps(2)))
        chain = Sequential([coordinated([q], [q + 1], "constant", duration=T) for q, T in ((0.0, k), (1.0, 0.1))])
        assert np.all(chain.at([np.nextafter(k, 0.0), k, chain.duration], 1) > 0.0)


def test_joints_that_move_alike_have_as_many_jumps(rng):
    for v, a in [(1.3, 3.8), *rng.uniform([0.3, 0.3], [3.0, 6.0], (50, 2))]:
        joints = [j for j, _ in independent([0, 0], [1, 0.1], "trapezoidal", Limits([v, v / 10], [a, a / 10])).jumps(2)]
        assert joints.count(1) == joints.count(2) >= 3


def test_a_chosen_speed_below_the_largest():
    line = path_type("line").path([[0.0], [2.0]])
    bounds = law_bounds(line, Limits(1.0, 3.0), 0.25)
    assert (bounds.V, bounds.A) == (0.25, 1.5)
    assert "no joint exceeds its limits" in bounds.explanation
    with pytest.raises(InputError, match=r"speed: expected more than 0 and at most V = 0.5, got 0.6"):
        law_bounds(line, Limits(1.0, 3.0), 0.6)


@pytest.mark.parametrize("count", [2, 3, 7])
def test_optimised_intervals_are_faster_and_keep_the_limits(count, rng):
    found = minimum_time_spline(rng.normal(size=(count, 3)), Limits(V, A))
    assert found.duration <= found.by_distance * (1 + 1e-12)
    assert count < 7 or found.duration < 0.97 * found.by_distance
    assert found.intervals.sum() == pytest.approx(found.duration)
    assert found.intervals.shape == (count - 1,)
    assert violations(found.trajectory, Limits(V, A)) == []
    assert found.trajectory.continuity_from_rest == 1
    assert max((peaks(found.trajectory, 1).peak / V).max(), (peaks(found.trajectory, 2).peak / A).max()) > 1 - 1e-9


def test_optimised_intervals_also_with_virtual_knots(rng):
    found = minimum_time_spline(rng.normal(size=(4, 3)), Limits(V, A), ends="both")
    assert found.trajectory.continuity_from_rest == 2
    assert found.intervals.shape == (3,)
    with pytest.raises(InputError, match="v_start: expected zero"):
        minimum_time_spline(rng.normal(size=(4, 3)), Limits(V, A), v_start=[1.0, 0.0, 0.0])


def test_nothing_that_holds_back_is_said():
    with pytest.raises(InputError, match="none of them holds this motion back"):
        optimal_scaling(Limits(), [1.0], [1.0])
    with pytest.raises(
        InputError, match=r"limits: give Limits\(velocity=..., acceleration=...\), an arm, or a duration"
    ):
        coordinated([0.0], [1.0])
