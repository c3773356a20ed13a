"""Chapter 6 and section 1.3 of the notes: their numbers, and the errata with what each printed formula misses."""

import math
from pathlib import Path

import numpy as np
import pytest

from armlab.kin.motion.bounds import law_bounds
from armlab.kin.motion.coordinated import coordinated
from armlab.kin.motion.geometry import ArcLength, curvature, frenet
from armlab.kin.motion.law_types import law_type
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.path_types import path_type
from armlab.kin.motion.peaks import peaks
from armlab.kin.motion.scaling import as_fast_as_allowed, optimal_scaling, scaled
from armlab.kin.motion.sequence import Slowed
from armlab.kin.motion.trajectory import Motion, Trajectory
from armlab.kin.paths.polynomial import check_rules, doubly_normalised, rest_coefficients
from armlab.kin.timing.table import PLUS_MINUS_ONE, acceleration_law

HERE = Path(__file__).parent
ELSEWHERE = ("C1.3-error-decay", "C1.3-expm")
"""Cases of section 1.3 that are about control."""

WORDS_ONLY = ("ERR-6.12", "ERR-6.60", "ERR-6.71", "ERR-6.74t", "ERR-6.97", "ERR-6.98", "ERR-6.121", "ERR-6.135")
"""Errata without a formula of ours to check; 6.12 and 6.60 are tested under other names."""


def test_every_number_of_chapter_6_is_used(truth):
    text = "".join(path.read_text(encoding="utf-8") for path in HERE.glob("test_*.py"))
    for name in truth:
        mine = name.startswith(("C6.", "C1.3", "ERR-6.")) and not name.startswith((*ELSEWHERE, *WORDS_ONLY))
        assert not mine or f'"{name}"' in text, name


def close(actual, case, key):
    expected = case["expected"][key]
    np.testing.assert_allclose(np.squeeze(actual), np.squeeze(expected), rtol=0, atol=case["tol"] or 0.0)


def example_6_34():
    """q = (2 s^2 + 1, 3 s^2 - 2 s)."""
    return path_type("polynomial").path([[1, 0], [3, 1]], start=[[0, -2]])


def example_6_142():
    """p = (6 s + 2, 5 s^2, -8 s)."""
    return path_type("polynomial").path([[2, 0, 0], [8, 5, -8]], start=[[6, 0, -8]])


def test_a_line_from_rest_to_rest(truth):
    case = truth["C1.3-line-rest-to-rest"]
    given = case["inputs"]
    line = path_type("line").path([given["pa"], given["pb"]])
    trajectory = Trajectory(line, law_type("quintic").law(given["T"]))
    close(trajectory.law.at(given["t"]), case, "s")
    for order, key in enumerate(("p", "pdot", "pddot")):
        close(trajectory.at(given["t"], order), case, key)


def test_the_acceleration_profile_of_1_41_comes_back_to_rest_at_0():
    law = acceleration_law(PLUS_MINUS_ONE)
    assert float(law.at(8.0)) == pytest.approx(0.0, abs=1e-14)
    assert float(law.at(8.0, 1)) == pytest.approx(0.0, abs=1e-14)
    np.testing.assert_allclose(law.at([2.0, 4.0, 6.0], 1), 0.0, rtol=0, atol=1e-14)
    np.testing.assert_allclose(law.at([2.0, 4.0, 6.0]), [1.0, 0.0, -1.0], rtol=0, atol=1e-14)
    assert not law.monotone


def test_the_cubic_path_with_a_quintic_law(truth):
    case, timed = truth["C6.0-cubic-path"], truth["C6.0-deg15"]
    path = path_type("cubic").path([case["inputs"]["q_i"], case["inputs"]["q_f"]])
    close(path.at(case["inputs"]["s"]), case, "q")
    close(path.at(case["inputs"]["s"], 1), case, "dq")
    trajectory = Trajectory(path, law_type("quintic").law(timed["inputs"]["T"]))
    close(trajectory.law.at(timed["inputs"]["t"]), timed, "s")
    close(trajectory.at(timed["inputs"]["t"]), timed, "q")
    close(trajectory.at(timed["inputs"]["t"], 1), timed, "qdot")
    assert trajectory.degree == timed["expected"]["degree"]


def test_arc_length(truth):
    case = truth["C6.1-arclength"]
    arc = ArcLength(example_6_142())
    close(arc.sigma(case["inputs"]["s"]), case, "sigma")
    np.testing.assert_allclose(arc.s(case["expected"]["sigma"]), case["inputs"]["s"], rtol=0, atol=1e-12)


def test_curvature_in_any_dimension(truth):
    case = truth["C6.1-curvature-nD"]
    close(curvature(case["inputs"]["dq"], case["inputs"]["ddq"]), case, "kappa")


def test_path_derivatives_in_time(truth):
    """A law with s = 0.5, s' = 0.4, s'' = -0.2 at one moment."""
    case = truth["C6.1-path-derivs"]
    given = case["inputs"]
    law = law_type("table").law(2.0, rows=[[0, 2, given["sddot"]]], sdot_first=0.7)
    scale = float(acceleration_law([[0, 2, given["sddot"]]], 0.7).at(2.0))
    t = np.interp(given["s"], law.at(np.linspace(0, 2, 200001)), np.linspace(0, 2, 200001))
    s = [float(law.at(t, k)) for k in range(3)]
    trajectory = Trajectory(example_6_34(), law)
    path = trajectory.path
    np.testing.assert_allclose(trajectory.at(t, 1), path.at(s[0], 1) * s[1], rtol=0, atol=1e-12)
    expected = path.at(s[0], 1) * s[2] + path.at(s[0], 2) * s[1] ** 2
    np.testing.assert_allclose(trajectory.at(t, 2), expected, rtol=0, atol=1e-12)
    assert s[2] == pytest.approx(given["sddot"] / scale)
    # The numbers of the case itself.
    close(path.at(given["s"], 1) * given["sdot"], case, "qdot")
    close(path.at(given["s"], 1) * given["sddot"] + path.at(given["s"], 2) * given["sdot"] ** 2, case, "qddot")


def test_the_velocity_bound_of_the_example_is_one_half():
    """The maxima are at s = 1, an end, where no second derivative vanishes (6.24)."""
    bounds = law_bounds(example_6_34(), Limits([3, 2]))
    np.testing.assert_allclose(bounds.M_v, [4, 4], rtol=0, atol=1e-12)
    np.testing.assert_allclose(bounds.M_v_at, [1, 1], rtol=0, atol=1e-12)
    assert pytest.approx(0.5, abs=1e-12) == bounds.V
    assert bounds.V_joint == 2


def test_the_acceleration_bound_that_is_negative(truth):
    case = truth["C6.1.1-accel-bound-infeasible"]
    given, expected = case["inputs"], case["expected"]
    bounds = law_bounds(example_6_34(), Limits([3, 2], given["a_max"]))
    each = (np.array(given["a_max"]) - given["V"] ** 2 * bounds.M_a) / bounds.M_v
    np.testing.assert_allclose(each, expected["bounds"], rtol=0, atol=case["tol"])
    assert pytest.approx(min(expected["bounds"]), abs=case["tol"]) == bounds.A
    assert bounds.V_bend == pytest.approx(expected["V_feasible_max"], abs=case["tol"])
    assert not bounds.possible
    assert "Lower |ṡ| below 0.4082 1/s first" in bounds.explanation
    lowered = bounds.lowered()
    assert lowered.possible
    assert bounds.V_bend > lowered.V


def test_cubic_with_end_velocities(truth):
    case = truth["C6.2.1-cubic-hermite"]
    given, expected = case["inputs"], case["expected"]
    found = doubly_normalised(given["q_i"], given["q_f"], [given["v_i"]], [given["v_f"]], given["T"])
    np.testing.assert_allclose(found, [expected[k] for k in "abcd"], rtol=0, atol=case["tol"])
    path = path_type("cubic").path(
        [given["q_i"], given["q_f"]], v_start=[given["v_i"]], v_end=[given["v_f"]], duration=given["T"]
    )
    close(path.at(0.5), case, "q_mid")
    assert path.in_time.at(np.array(given["T"]), (1,))[0][0] == pytest.approx(given["v_f"], abs=1e-12)


def test_the_example_of_6_3_5(truth):
    case = truth["C6.3.5-cubic-example"]
    given = case["inputs"]
    trajectory = coordinated([given["q_i"]], [given["q_f"]], "cubic", duration=given["T"])
    for order, key in enumerate(("q", "qdot", "qddot")):
        close(trajectory.at(given["t"], order), case, key)
    assert trajectory.continuity_from_rest == 1


@pytest.mark.parametrize(("case", "law"), [("C6.2.1-rest-cubic", "cubic"), ("C6.2.1-rest-quintic", "quintic")])
def test_rest_to_rest_polynomials(truth, case, law):
    names = {"C6.2.1-rest-cubic": truth["C6.2.1-rest-cubic"], "C6.2.1-rest-quintic": truth["C6.2.1-rest-quintic"]}
    found = names[case]
    expected = found["expected"]
    coefficients = expected.get("coeffs") or expected["coeffs_high_to_low"]
    assert list(rest_coefficients(len(coefficients) - 1)) == coefficients
    made = law_type(law).law()
    assert made.peak_speed == pytest.approx(expected["v_max"], abs=found["tol"])
    assert made.peak_acceleration == pytest.approx(expected["a_max"], abs=found["tol"])
    if "tau" in found["inputs"]:
        close(made.at(found["inputs"]["tau"]), found, "q")


def test_rest_to_rest_of_degree_7_and_the_rules(truth):
    case = truth["C6.2.1-rest-7th"]
    assert list(rest_coefficients(7)) == case["expected"]["coeffs_high_to_low"]
    for degree in range(1, 26, 2):
        coefficients = rest_coefficients(degree)
        assert check_rules(coefficients).kept
        assert sum(coefficients) == 1
        k = degree // 2
        for order in range(1, k + 1):
            at_one = sum(c * math.perm(degree - i, order) for i, c in enumerate(coefficients))
            assert at_one == 0


def test_cosine(truth):
    case = truth["C6.2.1-cosine"]
    given = case["inputs"]
    for path, law in (("line", "cosine"), ("harmonic", "constant")):
        motion = Trajectory(
            path_type(path).path([given["q_i"], given["q_i"] + given["dq"]]), law_type(law).law(given["T"])
        )
        for order, key in enumerate(("q", "qdot", "qddot")):
            close(motion.at(given["t"], order), case, key)


def test_quintic_with_six_conditions(truth):
    case = truth["C6.2.1-quintic-6bc"]
    given = case["inputs"]
    options = {key.replace("_i", "_start").replace("_f", "_end"): [given[key]] for key in ("v_i", "v_f", "a_i", "a_f")}
    path = path_type("quintic").path([given["q_i"], given["q_f"]], duration=given["T"], **options)
    close(path.at(given["tau"]), case, "q")
    close(path.curve.coefficients[0], case, "coeffs_low_to_high")


def test_lift_off_travel_set_down(truth):
    case = truth["C6.2.1-LTS-434"]
    path = path_type("lts_434").path(case["inputs"]["q"], times=case["inputs"]["t"])
    close(path.in_time.coefficients[0], case, "qL")
    close(path.in_time.coefficients[1, :4], case, "qT")
    close(path.in_time.coefficients[2], case, "qS")
    assert path.matrix.shape == (14, 14)
    assert len(path.names) == 14


def test_linear_segments_with_parabolic_blends(truth):
    case = truth["C6.2.1-lin-parab-blend"]
    given, expected = case["inputs"], case["expected"]
    path = path_type("blends").path(given["q"], times=given["t"], blend=given["blend"], ends="moving")
    curve = path.in_time
    close(curve.at(np.array([1.0, 3.0]), (1,))[0], case, "v")
    close(curve.at(np.array(2.0), (2,))[0], case, "acc")
    close(curve.at(np.array(2.0), (0,))[0], case, "q_blend_mid")
    at = [float(curve.at(np.array(t), (0,))[0][0]) for t in (1.8, 2.0, 2.2)]
    np.testing.assert_allclose(at, list(expected["q_at"].values()), rtol=0, atol=case["tol"])


def test_virtual_knots(truth):
    case = truth["C6.2.2-spline-virtual-knots"]
    given, expected = case["inputs"], case["expected"]
    path = path_type("spline").path(
        given["q"], times=given["t"], ends="both", virtual=[given["t_a"], given["t_b"]], v_start=[given["v_ends"]]
    )
    close(path.times, case, "knots_t")
    close(path.in_time.coefficients, case, "coeffs")
    assert path.positions[path.virtual[0] - 1, 0] == pytest.approx(expected["q_ta"], abs=case["tol"])
    assert path.positions[path.virtual[1] - 1, 0] == pytest.approx(expected["q_tb"], abs=case["tol"])
    assert path.equations == expected["n_equations"] == expected["n_params"]


@pytest.mark.parametrize("name", ["C6.3.1-trapezoid-a", "C6.3.1-trapezoid-c", "C6.3.1-trapezoid-tri"])
def test_trapezoid(truth, name):
    case = {
        "C6.3.1-trapezoid-a": truth["C6.3.1-trapezoid-a"],
        "C6.3.1-trapezoid-c": truth["C6.3.1-trapezoid-c"],
        "C6.3.1-trapezoid-tri": truth["C6.3.1-trapezoid-tri"],
    }[name]
    given, expected = case["inputs"], case["expected"]
    law = law_type("trapezoidal").within(Limits(given["v_max"], given["a_max"]), distance=given["L"])
    assert law.duration == pytest.approx(expected["T"], abs=case["tol"])
    assert law.pieces[0] == pytest.approx(expected["T_s"], abs=case["tol"])
    assert law.peak_speed == pytest.approx(expected["v_peak"], abs=case["tol"])
    assert len(law.pieces) == (2 if expected["coast"] > 0 else 1)
    close(law.at(expected["t"]), case, "sigma")
    assert law.distance == pytest.approx(expected["sigma_T"], abs=case["tol"])


def test_over_fly(truth):
    case = truth["C6.3.2-overfly"]
    given, expected = case["inputs"], case["expected"]
    path = path_type("overfly").path(
        [given["A"], given["B"], given["C"]], speed=[given["v1"], given["v2"]], by="d1", amount=given["d1"]
    )
    close(path.blend_times, case, "dT")
    close(path.d2, case, "d2")
    close(path.accelerations, case, "acc")
    start, end = path.breaks
    close(path.at(start), case, "A1")
    close(path.at(end), case, "C1")
    close(path.at(0.5 * (start + end)), case, "p_mid")
    s = np.linspace(start, end, 200001)
    nearest = np.linalg.norm(path.at(s) - given["B"], axis=1).min()
    assert nearest == pytest.approx(expected["min_dist_to_B"], abs=case["tol"])


@pytest.mark.parametrize("by", ["d1", "d2", "time"])
def test_d1_d2_and_time_of_an_over_fly_follow_from_each_other(by):
    amounts = {"d1": 0.2, "d2": 0.4, "time": 0.8}
    path = path_type("overfly").path([[0, 0], [1, 0], [1, 2]], speed=[0.5, 1.0], by=by, amount=amounts[by])
    found = {"d1": path.d1[0], "d2": path.d2[0], "time": path.blend_times[0]}
    assert found == pytest.approx(amounts, abs=1e-14)


def test_the_frenet_frame_of_the_example(truth):
    case = truth["C6.3.2-frenet"]
    s = case["inputs"]["s"]
    path = example_6_142()
    found = frenet(path, s)
    close(path.at(s, 1), case, "dp")
    close(np.linalg.norm(path.at(s, 1), axis=1), case, "norm")
    for key, values in (("t", found.tangent), ("n", found.normal), ("b", found.binormal)):
        close(values, case, key)
    close(found.curvature, case, "kappa")
    close(found.torsion, case, "tau")


def test_the_circle_through_three_points(truth):
    case = truth["C6.3.2-circle-3pts"]
    path = path_type("circle").path(case["inputs"]["p"])
    close(path.centre, case, "center")
    close(path.radius, case, "radius")


class Sine(Motion):
    """q = sin(1.3 t) on [0, 4]."""

    m, duration, pieces = 1, 4.0, np.zeros(0)

    def derivatives(self, t, orders=(0, 1, 2, 3)):
        return [1.3**k * np.sin(1.3 * np.asarray(t) + k * np.pi / 2)[..., None] for k in orders]

    def limits_at(self, t, before):
        return self.derivatives(t)


def test_uniform_time_scaling(truth):
    case = truth["C6.3.4-time-scale"]
    slow = Slowed(Sine(), case["inputs"]["k"])
    for order, key in enumerate(("q", "qd", "qdd")):
        close(slow.at(case["inputs"]["r"], order), case, key)


@pytest.mark.parametrize("name", ["C6.3.4-k", "C6.3.4-k-speedup"])
def test_the_optimal_scaling(truth, name):
    case = {"C6.3.4-k": truth["C6.3.4-k"], "C6.3.4-k-speedup": truth["C6.3.4-k-speedup"]}[name]
    given, expected = case["inputs"], case["expected"]
    motion = coordinated([0.0, 0.0], given["dq"], "quintic", duration=given["T"])
    close(peaks(motion, 1).peak, case, "v_peak")
    close(peaks(motion, 2).peak, case, "a_peak")
    found, scaling = as_fast_as_allowed(motion, Limits(given["v_max"], given["a_max"]))
    assert scaling.k == pytest.approx(expected["k"], abs=case["tol"])
    assert found.duration == pytest.approx(expected["T_s"], abs=case["tol"])
    assert (scaling.joint, scaling.quantity) == (1, "velocity")
    assert optimal_scaling(
        Limits(given["v_max"], given["a_max"]), expected["v_peak"], expected["a_peak"]
    ).k == pytest.approx(scaling.k)
    assert peaks(found, 1).peak[0] == pytest.approx(given["v_max"][0], abs=1e-12)
    assert scaled(found, 2.0).duration == pytest.approx(2.0 * found.duration)
