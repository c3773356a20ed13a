"""Three angles of a rotation: the cases of the notes, all 12 sequences both ways, SciPy as judge."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from armlab.errors import InputError, UnknownName
from armlab.kin.euler import (
    NAMES,
    PROPER,
    SEQUENCES,
    SINGULAR_SINE,
    angle_symbols,
    euler_angles,
    product_latex,
)
from armlab.kin.rotations import euler_zyx, rotation_about, rotation_from_sequence

BOTH = [(axes, fixed) for axes in SEQUENCES for fixed in (False, True)]
SINGULAR = {True: (0.0, np.pi), False: (np.pi / 2, -np.pi / 2)}  # middle angles, by proper or not


def angle_distance(a, b):
    return np.abs(np.angle(np.exp(1j * (np.asarray(a) - np.asarray(b)))))


def random_rotations(rng, count):
    return Rotation.random(count, random_state=np.random.RandomState(rng.integers(2**31))).as_matrix()


def test_there_are_twelve_sequences_without_equal_neighbours():
    assert len(set(SEQUENCES)) == 12
    assert all(a != b != c for a, b, c in SEQUENCES)
    assert {axes for axes, _ in NAMES} <= set(SEQUENCES)


def test_both_triples_of_zxz_in_the_notes(truth):
    case = truth["C3.3-euler-zxz-inverse"]
    found = euler_angles(case["inputs"]["R"], "zxz")
    assert not found.singular
    assert found.combination == 0
    np.testing.assert_allclose(found.solutions, case["expected"]["solutions"], rtol=0, atol=case["tol"])


def test_zxz_at_a_middle_angle_of_pi_keeps_the_difference(truth):
    """Not the sum, as the text after 3.94 has it."""
    case = truth["C3.3-euler-zxz-singpi"]
    found = euler_angles(case["inputs"]["R"], "zxz")
    phi, theta, psi = found.solutions[0]
    assert found.singular
    assert found.combination == -1
    assert psi == 0.0
    assert theta == pytest.approx(case["expected"]["theta"], abs=case["tol"])
    assert phi - psi == pytest.approx(case["expected"]["phi_minus_psi"], abs=case["tol"])
    R = rotation_from_sequence("zxz", found.solutions)
    np.testing.assert_allclose(R, [case["expected"]["R"]] * 2, rtol=0, atol=case["tol"])


def test_roll_pitch_yaw_of_the_notes_there_and_back(truth):
    case, back = truth["C3.3-rpy-xyz"], truth["C3.3-rpy-xyz-inverse"]
    angles = [case["inputs"][name] for name in ("psi", "theta", "phi")]
    R = rotation_from_sequence("xyz", angles, fixed=True)
    np.testing.assert_allclose(R, case["expected"]["R"], rtol=0, atol=case["tol"])
    found = euler_angles(back["inputs"]["R"], "xyz", fixed=True)
    np.testing.assert_allclose(found.solutions, back["expected"]["solutions"], rtol=0, atol=back["tol"])


def test_roll_pitch_yaw_pointing_up_keep_the_sum(truth):
    case = truth["C3.3-rpy-sing-neg"]
    found = euler_angles(case["inputs"]["R"], "xyz", fixed=True)
    psi, theta, phi = found.solutions[0]
    assert found.singular
    assert found.combination == 1
    assert phi == 0.0
    assert theta == pytest.approx(case["expected"]["theta"], abs=case["tol"])
    assert psi + phi == pytest.approx(case["expected"]["phi_plus_psi"], abs=case["tol"])


def test_fixed_and_moving_axes_of_the_notes(truth):
    case = truth["C3.3-fixed-vs-moving"]
    axes, angles = case["inputs"]["axes"], case["inputs"]["angles"]
    for fixed, key in ((True, "R_fixed"), (False, "R_moving")):
        R = rotation_from_sequence(axes, angles, fixed=fixed)
        np.testing.assert_allclose(R, case["expected"][key], rtol=0, atol=case["tol"])
        found = euler_angles(case["expected"][key], axes, fixed=fixed)
        np.testing.assert_allclose(found.solutions[0], angles, rtol=0, atol=1e-12)


@pytest.mark.parametrize(("axes", "fixed"), BOTH)
def test_both_triples_give_the_rotation_back(axes, fixed, rng):
    R = random_rotations(rng, 300).reshape(30, 10, 3, 3)
    found = euler_angles(R, axes, fixed=fixed)
    assert found.solutions.shape == (30, 10, 2, 3)
    assert not found.singular.any()
    again = rotation_from_sequence(axes, found.solutions, fixed=fixed)
    np.testing.assert_allclose(again, np.broadcast_to(R[:, :, None], again.shape), rtol=0, atol=3e-15)
    assert np.all(found.solutions > -np.pi)
    assert np.all(found.solutions <= np.pi)
    middle = found.solutions[..., 0, 1]
    low, high = (0.0, np.pi) if axes in PROPER else (-np.pi / 2, np.pi / 2)
    assert np.all((low <= middle) & (middle <= high))
    turned = angle_distance(found.solutions[..., 0, ::2], found.solutions[..., 1, ::2])
    np.testing.assert_allclose(turned, np.pi, rtol=0, atol=1e-14)


@pytest.mark.parametrize(("axes", "fixed"), BOTH)
def test_the_principal_triple_is_that_of_scipy(axes, fixed, rng):
    R = random_rotations(rng, 200)
    expected = Rotation.from_matrix(R).as_euler(axes if fixed else axes.upper())
    found = euler_angles(R, axes, fixed=fixed).solutions[:, 0]
    assert angle_distance(found, expected).max() < 1e-9


@pytest.mark.parametrize("distance", [1e-3, 1e-4, 1e-5, 1e-6, 2e-7])
@pytest.mark.parametrize(("axes", "fixed"), BOTH)
def test_near_a_singularity_no_digit_of_the_rotation_is_lost(axes, fixed, distance, rng):
    for centre in SINGULAR[axes in PROPER]:
        for side in (-distance, distance):
            angles = rng.uniform(-np.pi, np.pi, (20, 3))
            angles[:, 1] = centre + side
            R = rotation_from_sequence(axes, angles, fixed=fixed)
            found = euler_angles(R, axes, fixed=fixed)
            assert not found.singular.any()
            again = rotation_from_sequence(axes, found.solutions, fixed=fixed)
            np.testing.assert_allclose(again, np.broadcast_to(R[:, None], again.shape), rtol=0, atol=3e-15)
            errors = angle_distance(found.solutions, angles[:, None]).max(axis=-1).min(axis=-1)
            assert errors.max() < 1e-15 / distance


@pytest.mark.parametrize("distance", [0.0, 1e-16, 1e-9, 5e-8])
@pytest.mark.parametrize(("axes", "fixed"), BOTH)
def test_at_a_singularity_the_defined_combination_is_carried_by_the_first_angle(axes, fixed, distance, rng):
    for centre in SINGULAR[axes in PROPER]:
        angles = rng.uniform(-np.pi, np.pi, (20, 3))
        angles[:, 1] = centre + distance
        R = rotation_from_sequence(axes, angles, fixed=fixed)
        found = euler_angles(R, axes, fixed=fixed)
        assert found.singular.all()
        assert np.all(found.solutions[..., 2] == 0.0)
        assert len(set(found.combination.tolist())) == 1
        assert abs(found.combination[0]) == 1
        defined = angles[:, 0] + found.combination * angles[:, 2]
        # With the third angle 0 the first one is off by at most the distance.
        assert angle_distance(found.solutions[:, 0, 0], defined).max() < 1e-14 + 2 * distance
        again = rotation_from_sequence(axes, found.solutions, fixed=fixed)
        np.testing.assert_allclose(again, np.broadcast_to(R[:, None], again.shape), rtol=0, atol=2 * distance + 3e-15)


@pytest.mark.parametrize(("axes", "fixed"), BOTH)
def test_what_is_said_to_be_defined_is_all_that_matters(axes, fixed, rng):
    """Turning first and third against the combination leaves the rotation alone; turning with it does not."""
    for centre in SINGULAR[axes in PROPER]:
        R = rotation_from_sequence(axes, [0.4, centre, 0.3], fixed=fixed)
        sign = int(euler_angles(R, axes, fixed=fixed).combination)
        same = rotation_from_sequence(axes, [0.4 + 0.2, centre, 0.3 - sign * 0.2], fixed=fixed)
        other = rotation_from_sequence(axes, [0.4 + 0.2, centre, 0.3 + sign * 0.2], fixed=fixed)
        np.testing.assert_allclose(same, R, rtol=0, atol=1e-15)
        assert np.abs(other - R).max() > 0.1


def test_a_batch_may_mix_regular_and_singular_rotations():
    R = rotation_from_sequence("zyx", [[0.1, 0.2, 0.3], [0.1, np.pi / 2, 0.3], [0.1, -np.pi / 2, 0.3]])
    found = euler_angles(R, "zyx")
    assert found.singular.tolist() == [False, True, True]
    assert found.combination.tolist() == [0, -1, 1]
    np.testing.assert_allclose(found.solutions[1:, :, 0], [[-0.2, -0.2], [0.4, 0.4]], rtol=0, atol=1e-15)


def test_yaw_pitch_roll_are_those_of_the_other_function(rng):
    R = np.concatenate([random_rotations(rng, 100), rotation_from_sequence("zyx", [[0.7, np.pi / 2, 0.2]] * 2)])
    angles, singular = euler_zyx(R)
    found = euler_angles(R, "zyx")
    np.testing.assert_array_equal(found.singular, singular)
    assert angle_distance(found.solutions[:, 0], angles).max() < 1e-12


def test_half_turns_are_plus_pi_and_zeros_are_not_negative():
    for R in (np.eye(3), rotation_about("z", np.pi), np.diag([1.0, -1.0, -1.0]), np.diag([-1.0, 1.0, -1.0])):
        for axes, fixed in BOTH:
            solutions = euler_angles(R, axes, fixed=fixed).solutions
            assert solutions.min() > -np.pi
            assert not np.signbit(solutions[solutions == 0.0]).any()


def test_the_threshold_is_the_sine_of_the_middle_angle():
    below, above = (rotation_from_sequence("zxz", [0.3, f * SINGULAR_SINE, 0.5]) for f in (0.99, 1.01))
    assert euler_angles(below, "zxz").singular
    assert not euler_angles(above, "zxz").singular


@pytest.mark.parametrize(
    ("axes", "fixed", "texts", "expected"),
    [
        ("zxz", False, None, r"R_z(\varphi)\,R_x(\theta)\,R_z(\psi)"),
        ("zxz", True, None, r"R_z(\psi)\,R_x(\theta)\,R_z(\varphi)"),
        ("xyz", True, None, r"R_z(\varphi)\,R_y(\theta)\,R_x(\psi)"),
        ("ZYX", False, None, r"R_z(\varphi)\,R_y(\theta)\,R_x(\psi)"),
        ("yxz", False, ["10.0", "−5", "90°"], r"R_y(10.0^\circ)\,R_x(-5^\circ)\,R_z(90^\circ)"),
        ("yxz", True, ["10.0", "−5", "90°"], r"R_z(90^\circ)\,R_x(-5^\circ)\,R_y(10.0^\circ)"),
    ],
)
def test_the_product_is_written_as_it_is_multiplied(axes, fixed, texts, expected):
    assert product_latex(axes, fixed, texts) == expected


@pytest.mark.parametrize(("axes", "fixed"), BOTH)
def test_the_written_product_is_the_matrix(axes, fixed):
    values = {r"\varphi": 0.3, r"\theta": 0.8, r"\psi": -0.5}
    R = np.eye(3)
    for factor in product_latex(axes, fixed).split(r"\,"):
        R = R @ rotation_about(factor[2], values[factor[4:-1]])
    angles = [values[symbol] for symbol in angle_symbols(axes, fixed)]
    np.testing.assert_allclose(R, rotation_from_sequence(axes, angles, fixed=fixed), rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    ("call", "kind", "text"),
    [
        (lambda: euler_angles(np.eye(3), "zzx"), UnknownName, "axes: unknown name 'zzx'.* Available: xyx, xyz"),
        (lambda: euler_angles(np.eye(4), "zyx"), InputError, r"R: expected shape \(\.\.\., 3, 3\), got \(4, 4\)"),
        (lambda: euler_angles("R", "zyx"), InputError, "R: expected 3 x 3 matrices of numbers, got 'R'"),
        (lambda: product_latex("zyx", False, ["1", "2"]), InputError, "angles_text: expected three texts, got 2"),
        (lambda: angle_symbols("xx", True), UnknownName, "axes: unknown name 'xx'"),
    ],
)
def test_wrong_input_is_named(call, kind, text):
    with pytest.raises(kind, match=text):
        call()
