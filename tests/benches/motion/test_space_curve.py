"""The laboratory of geometry without a page: curves, numbers of the notes, turns, commands, bad input."""

import math

import numpy as np
import pytest

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.space_curve.commands import (
    ChooseCurve,
    ChooseLaw,
    SetAngle,
    SetPoint,
    TakeOrientation,
    WriteIn,
)
from armlab.benches.motion.space_curve.examples import EXAMPLES, ChooseExample
from armlab.benches.motion.space_curve.facts import FACTS
from armlab.benches.motion.space_curve.formula import formula_path
from armlab.benches.motion.space_curve.laid import FORMULA, Question, kinds, laid, moment
from armlab.benches.motion.space_curve.stage import sphere_of, stage_of
from armlab.benches.motion.space_curve.state import (
    MOST_POINTS,
    NOTES,
    SpaceCurve,
    curve_of,
    moment_of,
    turn_of,
    turn_place,
)
from armlab.benches.motion.space_curve.turn import rotation_of
from armlab.errors import InputError
from armlab.kin.motion import free_law_types
from armlab.kin.motion.geometry import curvature
from armlab.kin.rotations import is_rotation
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import OpenClip, Seek, Timeline, duration
from armlab.session.state import apply
from support.space_curves import S, after, at, opened

# -- the numbers of the notes -----------------------------------------------------------------------------------------


def test_the_frenet_example_of_the_notes(truth):
    case, state = truth["C6.3.2-frenet"], after(ChooseExample("frenet"))
    expected, tol = case["expected"], case["tol"]
    for k, s in enumerate(case["inputs"]["s"]):
        now = at(state, s)
        np.testing.assert_allclose(now.s, s, rtol=0, atol=1e-12)
        np.testing.assert_allclose(now.d1, expected["dp"][k], rtol=0, atol=1e-9)
        np.testing.assert_allclose(np.linalg.norm(now.d1), expected["norm"][k], rtol=0, atol=1e-9)
        for name, vector in (("t", now.frame.tangent), ("n", now.frame.normal), ("b", now.frame.binormal)):
            np.testing.assert_allclose(vector, expected[name][k], rtol=0, atol=max(tol, 1e-10))
        np.testing.assert_allclose(now.frame.curvature, expected["kappa"][k], rtol=0, atol=max(tol, 1e-11))
        assert abs(now.frame.torsion) < 1e-12
        np.testing.assert_allclose(np.cross(now.d1, now.d2), expected["cross"], rtol=0, atol=1e-10)
    # The printed 6.145 is no unit vector.
    printed = case["printed_value_if_wrong"]["t_at_0_3"]
    assert np.linalg.norm(np.array(printed) - at(state, 0.3).frame.tangent) > 40.0


def test_the_arc_length_of_the_notes(truth):
    case, state = truth["C6.1-arclength"], after(ChooseExample("frenet"))
    for s, sigma in zip(case["inputs"]["s"], case["expected"]["sigma"], strict=True):
        assert at(state, s).sigma == pytest.approx(sigma, abs=case["tol"])
    assert curve_of(state).arc.length == pytest.approx(case["expected"]["sigma"][-1], abs=case["tol"])


def test_path_derivatives_and_curvature_in_any_dimension(truth):
    case = truth["C6.1-path-derivs"]
    assert case["inputs"]["q"] == "(2s²+1, 3s²−2s)"
    path = formula_path(("2s^2+1", "3s^2-2s", "0"))
    s, rate, change = case["inputs"]["s"], case["inputs"]["sdot"], case["inputs"]["sddot"]
    d1, d2 = path.at(s, 1)[:2], path.at(s, 2)[:2]
    np.testing.assert_allclose(d1 * rate, case["expected"]["qdot"], rtol=0, atol=case["tol"])
    np.testing.assert_allclose(d1 * change + d2 * rate**2, case["expected"]["qddot"], rtol=0, atol=case["tol"])
    case = truth["C6.1-curvature-nD"]
    found = curvature(case["inputs"]["dq"], case["inputs"]["ddq"])
    assert found == pytest.approx(case["expected"]["kappa"], abs=case["tol"])


def test_the_circle_through_three_points_of_the_notes(truth):
    case, state = truth["C6.3.2-circle-3pts"], after(ChooseExample("circle"))
    assert [list(point) for point in state[SpaceCurve].points] == case["inputs"]["p"]
    found = curve_of(state)
    np.testing.assert_allclose(found.given.centre, case["expected"]["center"], rtol=0, atol=case["tol"])
    assert found.given.radius == pytest.approx(case["expected"]["radius"], abs=case["tol"])
    np.testing.assert_allclose(found.frame.curvature, 1.0 / found.given.radius, rtol=1e-12)


def test_the_over_fly_of_the_notes_with_its_jumps_of_the_acceleration(truth):
    case, state = truth["C6.3.2-overfly"], after(ChooseExample("overfly"))
    given, expected, found = case["inputs"], case["expected"], curve_of(state)
    assert [list(point) for point in state[SpaceCurve].points] == [given["A"], given["B"], given["C"]]
    path = found.given
    assert float(path.blend_times[0]) == pytest.approx(expected["dT"], abs=1e-12)
    assert (float(path.d1[0]), float(path.d2[0])) == pytest.approx((given["d1"], expected["d2"]))
    begins = 1.0 / given["v1"] - 0.5 * expected["dT"]
    middle = moment(found, begins + 0.5 * expected["dT"])
    np.testing.assert_allclose(middle.p, expected["p_mid"], rtol=0, atol=case["tol"])
    acceleration = middle.tangential + middle.centripetal
    np.testing.assert_allclose(acceleration, expected["acc"], rtol=0, atol=case["tol"])
    # 6.118-6.119 are wrong: inside the blend it is the constant of 6.120 up to both ends, outside it is zero.
    for t, inside in ((begins + 1e-6, True), (begins - 1e-6, False), (begins + expected["dT"] - 1e-6, True)):
        now = moment(found, t)
        wanted = expected["acc"] if inside else np.zeros(3)
        np.testing.assert_allclose(now.tangential + now.centripetal, wanted, rtol=0, atol=1e-9)
    distance = np.linalg.norm(path.at(np.linspace(0, 1, 20001)) - np.array(given["B"]), axis=1).min()
    assert distance == pytest.approx(expected["min_dist_to_B"], abs=1e-6)


# -- curves ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", EXAMPLES)
def test_every_example_can_be_put_in_place_and_played(key):
    state = after(ChooseExample(key))
    assert state[SpaceCurve].example == key
    assert (state[Timeline].clip, state[Timeline].time) == ("space_curve", 0.0)
    end = duration(state)
    for part in (0.0, 0.37, 1.0):
        now = moment_of(apply(state, Seek(part * end)))
        assert np.isfinite(now.p).all()
        assert -1e-12 <= now.sigma <= curve_of(state).arc.length * (1 + 1e-12)


@pytest.mark.parametrize("by_length", [False, True])
@pytest.mark.parametrize("key", ["frenet", "helix", "twisted", "clothoid", "spline"])
def test_velocity_and_acceleration_are_the_derivatives_of_the_motion(key, by_length):
    found = curve_of(after(ChooseExample(key), Set(SpaceCurve, "by_length", by_length), ChooseLaw("quintic")))
    h = 1e-4
    for t in (0.7, 1.9, 3.1):
        before, now, later = (moment(found, t + shift) for shift in (-h, 0.0, h))
        scale = max(found.peaks)
        np.testing.assert_allclose((later.p - before.p) / (2 * h), now.velocity, rtol=0, atol=1e-6 * scale)
        second = (later.p - 2 * now.p + before.p) / h**2
        np.testing.assert_allclose(second, now.tangential + now.centripetal, rtol=0, atol=1e-5 * scale)


def test_by_length_the_first_derivative_is_the_tangent_and_the_second_is_across_it():
    state = after(ChooseExample("frenet"))
    plain, by_length = curve_of(state), curve_of(after(Set(SpaceCurve, "by_length", True), state=state))
    for s in S[1:-1]:
        now = at(after(Set(SpaceCurve, "by_length", True), state=state), float(s))
        assert np.linalg.norm(now.d1) == pytest.approx(1.0, abs=1e-12)
        np.testing.assert_allclose(now.d2, now.frame.curvature * now.frame.normal, rtol=0, atol=1e-12)
        assert abs(now.centripetal @ now.frame.tangent) < 1e-12
        assert now.sigma == pytest.approx(s * by_length.arc.length)
    assert by_length.arc.length == pytest.approx(plain.arc.length, rel=1e-12)
    np.testing.assert_allclose(by_length.frame.curvature.max(), plain.frame.curvature.max(), rtol=1e-9)


def test_where_a_curve_is_not_regular_it_says_so():
    still = curve_of(after(ChooseExample("still")))
    np.testing.assert_allclose(still.stands, [0.5], rtol=0, atol=1e-4)
    assert not still.frame.curvature.any()
    with pytest.raises(InputError, match=r"p' = 0 at s = 0\.5"):
        after(ChooseExample("still"), Set(SpaceCurve, "by_length", True))
    assert "no direction" in at(after(ChooseExample("cusp")), 0.5).frame.remark
    straight = at(after(ChooseCurve("line")), 0.4).frame
    assert "every normal is as good" in straight.remark
    assert not straight.normal.any()


@pytest.mark.parametrize("key", [key for key in kinds() if key != FORMULA])
def test_every_kind_of_path_in_space_is_offered_and_made(key):
    state = after(ChooseCurve(key))
    part, kind = state[SpaceCurve], kinds()[key]
    assert kind.least <= len(part.points) <= (kind.most or MOST_POINTS)
    assert curve_of(state).arc.length > 0.0
    assert after(ChooseCurve(FORMULA), state=state)[SpaceCurve].formula == NOTES


@pytest.mark.parametrize("key", free_law_types())
def test_every_law_moves_along_the_whole_curve(key):
    state = after(ChooseLaw(key))
    end = moment(curve_of(state), curve_of(state).law.duration)
    np.testing.assert_allclose(end.p, [8.0, 5.0, -8.0], rtol=0, atol=1e-8)


LAID = (
    ("trapezoidal", False, ("s", "sin(7*s+2)", "s^4-s")),
    ("quintic", False, ("s", "2*sin(31*s+1)", "sqrt(s+0.01)")),
    ("cubic", True, ("s", "s^3", "sin(3*s)")),
)
"""Laws, whether the curve is by its length, and the three functions where it is typed."""


def searched(motion, order):
    """Return the largest length of a derivative by samples, closer and closer around the largest."""
    beside = np.concatenate([motion.edges[1:] - 1e-9, motion.edges[:-1] + 1e-9])
    times = np.concatenate([np.linspace(0.0, motion.duration, 4001), beside])
    best, width = 0.0, motion.duration / 2000
    for _ in range(4):
        lengths = np.linalg.norm(motion.at(times, order), axis=1)
        k = int(np.argmax(lengths))
        best = max(best, float(lengths[k]))
        times = np.clip(times[k] + np.linspace(-width, width, 401), 1e-9, motion.duration - 1e-9)
        width /= 100.0
    return best


@pytest.mark.parametrize("key", kinds())
def test_the_largest_speed_and_acceleration_miss_nothing_between_samples(key):
    rng = np.random.default_rng(len(key))
    for law, by_length, typed in LAID:
        points = tuple(map(tuple, rng.uniform(-1.0, 1.0, (5, 3)).tolist()))
        question = Question(Chosen(key), points[: kinds()[key].most], typed, by_length, Chosen(law), 2.0)
        if by_length and len(laid(question._replace(by_length=False)).stands):
            continue  # refused
        found = laid(question)
        for order, peak in enumerate(found.peaks, start=1):
            best = searched(found.motion, order)
            assert best * (1.0 - 1e-9) - 1e-9 <= peak <= best * (1.0 + 1e-6) + 1e-9


def test_at_a_corner_that_is_not_rounded_the_acceleration_is_infinite():
    values = {}
    for key in ("square", "square_flown"):
        state = after(ChooseExample(key))
        values[key] = FACTS.facts["peak_acceleration"].now(state).value
    assert values["square"] == math.inf
    assert values["square_flown"] == pytest.approx(0.8 * math.sqrt(2.0))


@pytest.mark.parametrize(
    ("texts", "derivatives"),
    [
        (("exp(s)", "sin(3s)", "1/(1+s)"), lambda s: (math.exp(s), 3 * math.cos(3 * s), -1 / (1 + s) ** 2)),
        (("s^7 - s", "cos(20s)", "atan(5s)"), lambda s: (7 * s**6 - 1, -20 * math.sin(20 * s), 5 / (1 + 25 * s * s))),
        (("abs(s-1/3)", "s", "sqrt(1+s)"), lambda s: (math.copysign(1, s - 1 / 3), 1.0, 0.5 / math.sqrt(1 + s))),
    ],
)
def test_derivatives_of_typed_functions_are_right(texts, derivatives):
    path = formula_path(texts)
    for s in np.random.default_rng(6).uniform(0, 1, 40):
        np.testing.assert_allclose(path.at(s, 1), derivatives(float(s)), rtol=0, atol=1e-8)
    exact = formula_path(NOTES)
    assert (exact.degree, exact.remarks) == (2, ())
    assert not exact.at(S, 3).any()
    assert "Chebyshev" in path.remarks[0]


# -- the scene ---------------------------------------------------------------------------------------------------------


def test_a_curve_far_larger_than_the_arm_is_drawn_as_a_model():
    large, small = (after(ChooseExample(key)) for key in ("frenet", "helix"))
    stage = stage_of(large)
    drawn = stage.at(curve_of(large).frame.position)
    reach = 2.0 * large[RobotPart].robot.arm.length_scale
    assert stage.ratio == pytest.approx(round(stage.ratio))
    assert 0.15 * reach < np.linalg.norm(np.ptp(drawn, axis=0)) <= 0.26 * reach
    assert drawn[:, 2].min() > 0.0
    assert (stage_of(small).factor, stage_of(small).shift.any()) == (1.0, False)
    assert stage_of(large) is stage_of(apply(large, Seek(1.0)))
    far = after(ChooseCurve("line"), *(SetPoint(k, 1, 40.0 + k) for k in range(2)))
    assert (stage_of(far).model, stage_of(small).model) == (True, False)
    assert np.linalg.norm(stage_of(far).at(curve_of(far).frame.position), axis=1).max() < reach
    centre, radius = sphere_of(large)
    assert centre[2] > radius


# -- orientation -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("fixed", [False, True])
def test_both_turns_lead_from_a_to_b_and_one_axis_sweeps_least(seed, fixed):
    rng = np.random.default_rng(seed)
    axes = ("zxz", "zyx", "xyz", "yzy")[seed % 4]
    start, end = (tuple(rng.uniform(-3, 3, 3).tolist()) for _ in range(2))
    state = opened()
    part = state[SpaceCurve]
    state = after(WriteIn(axes, fixed), state=state)
    for name, angles in (("A", start), ("B", end)):
        for k in range(3):
            state = apply(state, SetAngle(name, k, angles[k]))
    found = turn_of(state)
    R_A, R_B = rotation_of(axes, fixed, start), rotation_of(axes, fixed, end)
    for way in (found.straight, found.euler):
        np.testing.assert_allclose(way.rotation(0.0), R_A, rtol=0, atol=1e-12)
        np.testing.assert_allclose(way.rotation(1.0), R_B, rtol=0, atol=1e-9)
        assert is_rotation(way.rotation(0.3))
    assert found.swept[0] == pytest.approx(abs(found.straight.angle), abs=1e-9)
    assert found.swept[1] >= found.swept[0] - 1e-9
    assert found.wandering == pytest.approx(found.apart.max(), abs=1e-9)
    assert part.shown == "curve"


def test_about_the_same_axis_both_are_the_same_and_typed_angles_may_go_far_round():
    agree, far = (turn_of(after(ChooseExample(key))) for key in ("agree", "many_turns"))
    assert agree.wandering < 1e-9
    assert agree.swept == pytest.approx((math.radians(120), math.radians(120)))
    assert far.swept == pytest.approx((math.radians(10), math.radians(350)))


def test_half_a_turn_is_a_remark_and_has_another_way():
    state = after(ChooseExample("half_turn"))
    found = turn_of(state)
    assert "Chosen: r." in found.remarks[0]
    other = turn_of(after(Set(SpaceCurve, "other_way", True), state=state))
    assert "Chosen: −r." in other.remarks[0]
    assert found.straight.angle == pytest.approx(-other.straight.angle)
    with pytest.raises(InputError, match="both orientations are the same"):
        after(
            *(SetAngle("B", k, state[SpaceCurve].start[k]) for k in range(3)),
            Set(SpaceCurve, "other_way", True),
            state=state,
        )


def test_other_angles_write_the_same_orientations_and_the_tool_gives_its_own():
    state = after(ChooseExample("wander"))
    before = turn_of(state)
    for axes, fixed in (("zyx", False), ("xyx", True), ("zyz", False)):
        state = apply(state, WriteIn(axes, fixed))
        now = turn_of(state)
        for s in (0.0, 1.0):
            np.testing.assert_allclose(now.euler.rotation(s), before.euler.rotation(s), rtol=0, atol=1e-9)
    for source in ("tool", "handle"):
        taken = apply(state, TakeOrientation("A", source))
        np.testing.assert_allclose(
            turn_of(taken).straight.rotation(0.0), state[Joints].tool_pose[:3, :3], rtol=0, atol=1e-7
        )
        np.testing.assert_allclose(
            turn_of(taken).straight.rotation(1.0), before.straight.rotation(1.0), rtol=0, atol=1e-7
        )
    assert turn_place(after(OpenClip("space_curve"), Seek(2.0), state=state))[0] == pytest.approx(0.5)


def test_the_line_of_the_notes_goes_from_rest_to_rest(truth):
    case = truth["C1.3-line-rest-to-rest"]
    state = after(ChooseExample("line"))
    motion = state.derived(curve_of).motion
    for key, order in (("p", 0), ("pdot", 1), ("pddot", 2)):
        found = np.asarray(motion.at(case["inputs"]["t"], order))
        np.testing.assert_allclose(found[:2], case["expected"][key], rtol=0, atol=1e-12)
    for end in (0.0, case["inputs"]["T"]):
        np.testing.assert_allclose(motion.at(end, 1), 0.0, rtol=0, atol=1e-12)
