"""The DC motor: the course's numbers, the matrix exponential, an ODE solver, poles, powers, and what its state is."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp, trapezoid
from scipy.linalg import expm

from armlab.errors import InputError
from armlab.kin.drive import DcMotor, Piece, run, transition

COURSE = {"R": 1.2, "L": 0.002, "k": 0.05, "J": 1e-4, "F": 2e-5}

MOTORS = {
    "course": DcMotor(**COURSE),
    "maxon": DcMotor(R=0.299, L=8.2e-5, k=0.0302, J=1.42e-5, F=5.2e-6),
    "swinging": DcMotor(R=0.2, L=0.02, k=0.05, J=5e-5, F=1e-5),
    "heavy": DcMotor(R=1.2, L=0.002, k=0.05, J=0.01, F=2e-5),
    "frictionless": DcMotor(R=1.2, L=0.002, k=0.05, J=1e-4, F=0.0),
    "no_L": DcMotor(R=1.2, L=0.0, k=0.05, J=1e-4, F=2e-5),
}


def motor_of(case):
    return DcMotor(*(case["inputs"][name] for name in ("R", "L", "k", "I", "F")))


@pytest.fixture(params=list(MOTORS))
def motor(request):
    """Each of some motors."""
    return MOTORS[request.param]


def test_the_steady_state_of_the_course(truth):
    case = truth["C2.1-motor-steady"]
    current, speed = motor_of(case).steady(case["inputs"]["v"], case["inputs"]["tau_load"])
    assert current == pytest.approx(case["expected"]["i_ss"], abs=case["tol"])
    assert speed == pytest.approx(case["expected"]["omega_ss"], abs=case["tol"])


def test_the_transient_of_the_course(truth):
    case = truth["C2.1-motor-transient"]
    given, expected = case["inputs"], case["expected"]
    found = run(motor_of(case), [Piece(given["t"][-1], given["v"], given["tau_load"])], given["x0"])
    moments = [found.at(t) for t in given["t"]]
    np.testing.assert_allclose([m.i for m in moments], expected["i"], rtol=0, atol=case["tol"])
    np.testing.assert_allclose([m.omega for m in moments], expected["omega"], rtol=0, atol=case["tol"])
    np.testing.assert_allclose([m.theta for m in moments], expected["theta"], rtol=0, atol=case["tol"])


def test_the_poles_of_the_course(truth):
    case = truth["C2.1-motor-poles"]
    motor = motor_of(case)
    np.testing.assert_allclose(motor.poles.real, case["expected"]["poles_real"], rtol=0, atol=case["tol"])
    np.testing.assert_allclose(motor.poles.imag, case["expected"]["poles_imag"], rtol=0, atol=case["tol"])
    np.testing.assert_allclose(motor.denominator, case["expected"]["den"], rtol=1e-12)


@pytest.mark.parametrize("h", [1e-5, 3e-3, 0.2])
def test_a_step_is_the_exponential_of_the_augmented_matrix(motor, h):
    n = len(motor.A)
    augmented = np.zeros((n + 2, n + 2))
    augmented[:n, :n], augmented[:n, n:] = motor.A, motor.B
    found = expm(augmented * h)
    phi, gamma = transition(motor, h)
    np.testing.assert_allclose(phi, found[:n, :n], rtol=0, atol=1e-9 * np.abs(found).max())
    np.testing.assert_allclose(gamma, found[:n, n:], rtol=0, atol=1e-9 * np.abs(found).max())


def test_a_run_is_what_a_solver_of_differential_equations_finds(motor):
    pieces = [Piece(0.03, 12.0, 0.0), Piece(0.02, -5.0, 0.08), Piece(0.05, 0.0, -0.02)]
    found = run(motor, pieces, (0.0, 3.0, 0.5))
    x, begun = np.array([0.0, 3.0, 0.5])[3 - len(motor.A) :], 0.0
    for piece in pieces:
        u = np.array([piece.voltage, piece.load])
        solved = solve_ivp(
            lambda _, y, u=u: motor.A @ y + motor.B @ u,
            (0.0, piece.duration),
            x,
            "DOP853",
            [0.5 * piece.duration, piece.duration],
            rtol=1e-10,
            atol=1e-12,
        )
        half = found.at(begun + 0.5 * piece.duration)
        seen = np.array([half.i, half.omega, half.theta])[3 - len(motor.A) :]
        np.testing.assert_allclose(seen, solved.y[:, 0], rtol=1e-7, atol=1e-8)
        x, begun = solved.y[:, 1], begun + piece.duration
    np.testing.assert_allclose(found.states[-1, 3 - len(motor.A) :], x, rtol=1e-7, atol=1e-8)


def test_samples_do_not_depend_on_their_distance(motor):
    pieces = [Piece(0.01 * (k + 1), 2.0 * k, 0.01 * k) for k in range(5)]
    found = run(motor, pieces)
    fine = run(motor, [Piece(piece.duration / 7.0, piece.voltage, piece.load) for piece in pieces for _ in range(7)])
    np.testing.assert_allclose(found.states[-1], fine.states[-1], rtol=1e-11, atol=1e-12)
    assert (np.diff(found.t) >= 0.0).all()
    # A jump of the voltage is there twice, and everything but the voltage (and a current without inductance) goes on.
    k = int(np.flatnonzero(np.diff(found.t) == 0.0)[0])
    assert found.v[k] != found.v[k + 1]
    assert found.omega[k] == found.omega[k + 1]
    assert (found.i[k] == found.i[k + 1]) == (not motor.reduced)


def test_a_run_ends_in_the_steady_state(motor):
    slowest = float(np.abs(motor.poles.real).min())
    found = run(motor, [Piece(40.0 / slowest, 12.0, 0.05)])
    current, speed = motor.steady(12.0, 0.05)
    assert found.i[-1] == pytest.approx(float(current), rel=1e-9)
    assert found.omega[-1] == pytest.approx(float(speed), rel=1e-9)


def test_poles_are_the_eigenvalues_and_the_transfer_function_is_that_of_the_matrices(motor, rng):
    expected, found = np.linalg.eigvals(motor.A).tolist(), [*motor.poles.tolist(), 0.0]
    assert len(found) == len(expected)
    for pole in found:
        assert min(abs(pole - value) for value in expected) < 1e-9 * max(1.0, abs(pole))
    for _ in range(5):
        s = complex(*rng.uniform(-300.0, 300.0, 2))
        inverse = np.linalg.solve(s * np.eye(len(motor.A)) - motor.A, motor.B)[-2]
        np.testing.assert_allclose(motor.transfer(s), inverse, rtol=1e-9)
    by_voltage, by_load = motor.transfer(0.0)
    assert by_voltage == pytest.approx(motor.voltage_gain)
    assert by_load == pytest.approx(motor.load_gain)


def test_motors_of_positive_constants_are_stable(rng):
    for _ in range(300):
        R, L, k, J, F = 10.0 ** rng.uniform(-4.0, 3.0, 5)
        motor = DcMotor(R, L, k, J, F)
        assert (motor.poles.real < 0.0).all()
        assert motor.damping > 0.0
        a, b, c = motor.denominator
        assert np.poly(motor.poles).tolist() == pytest.approx([1.0, b / a, c / a], rel=1e-9)


def test_a_slow_pole_beside_a_fast_one_keeps_its_digits():
    motor = DcMotor(R=1.0, L=1e-9, k=0.1, J=1.0, F=0.0)
    assert motor.poles[1].real == pytest.approx(-1.0 / motor.mechanical_constant, rel=1e-9)


def test_back_emf_is_a_loop_inside_and_the_chain_without_it_would_turn_too_fast(truth):
    motor = DcMotor(**COURSE)
    end = run(motor, [Piece(2.0, 1.0, 0.0)]).omega[-1]
    assert end == pytest.approx(motor.voltage_gain, rel=1e-9)
    assert motor.voltage_gain == pytest.approx(0.05 / (1.2 * 2e-5 + 0.05**2))
    # The residual of ERR-2.20: k/(R F) for each volt in place of k/(R F + k²), 105 times as much.
    assert motor.open_gain / end - 1.0 == pytest.approx(104.2, abs=0.1)
    assert math.isinf(MOTORS["frictionless"].open_gain)


def test_the_time_constants_are_the_poles_where_they_lie_far_apart():
    far, near = MOTORS["heavy"], MOTORS["course"]
    for motor, most in ((far, 1e-3), (near, 0.05)):
        guesses = [-1.0 / motor.electrical_constant, -1.0 / motor.mechanical_constant]
        np.testing.assert_allclose(guesses, motor.poles.real, rtol=most)
    assert abs(-1.0 / near.electrical_constant / near.poles[0].real - 1.0) > 0.03
    assert MOTORS["maxon"].mechanical_constant == pytest.approx(4.67e-3, rel=6e-3)  # 4.67 ms by the data sheet


def test_all_power_goes_somewhere(motor):
    pieces = [Piece(0.01, 12.0, 0.05), Piece(0.02, -3.0, -0.02)]
    found = run(motor, pieces)
    for time in np.linspace(0.0, found.end, 37):
        now = found.at(float(time))
        powers = motor.powers(now.i, now.omega, now.v, now.load)
        largest = max(abs(powers.supplied), abs(powers.converted), 1.0)
        assert abs(powers.electrical_rest) < 1e-12 * largest
        assert abs(powers.mechanical_rest) < 1e-12 * largest
        assert powers.converted == pytest.approx(motor.k * now.omega * now.i)


def test_the_energy_of_a_run_is_what_was_stored_and_lost():
    """The powers of a moment, summed by another rule than the one that made the run."""
    motor = DcMotor(**COURSE)
    found = run(motor, [Piece(0.15, 12.0, 0.1)])
    inputs = zip(found.i, found.omega, found.v, found.load, strict=True)
    balances = [motor.powers(*map(float, each)) for each in inputs]
    spent = trapezoid([b.supplied - b.copper - b.friction - b.load for b in balances], found.t)
    last = found.at(0.15)
    stored = 0.5 * motor.L * last.i**2 + 0.5 * motor.J * last.omega**2
    assert spent == pytest.approx(stored, rel=1e-3)


def test_the_printed_state_does_not_see_the_position():
    """ERR-2.12: two motors at other angles have one vector of derivatives for ever; (i, omega, theta) differs by 1."""
    motor = DcMotor(**COURSE)
    one, other = (run(motor, [Piece(0.2, 12.0, 0.1)], (0.0, 0.0, theta)) for theta in (0.0, 1.0))
    assert np.abs(other.rates - one.rates).max() == 0.0
    assert np.abs(other.states - one.states).max() == pytest.approx(1.0, abs=1e-12)
    # It is dx/dt: as x it leaves B u over.
    rates = motor.rates(one.i, one.omega, one.v, one.load)
    np.testing.assert_allclose(rates, one.states @ motor.A.T + [6000.0, -1000.0, 0.0], rtol=0, atol=1e-8)


def test_a_small_inductance_tends_to_none():
    reduced = run(MOTORS["no_L"], [Piece(0.1, 12.0, 0.1)])
    for inductance in (1e-6, 1e-8):
        full = run(DcMotor(R=1.2, L=inductance, k=0.05, J=1e-4, F=2e-5), [Piece(0.1, 12.0, 0.1)])
        assert full.omega[-1] == pytest.approx(reduced.omega[-1], rel=20.0 * inductance + 1e-8)
    assert reduced.i[0] == pytest.approx(10.0)
    assert len(MOTORS["no_L"].poles) == 1


def test_a_stalled_motor_and_a_generator():
    motor = DcMotor(**COURSE)
    current, torque = motor.stalled(12.0)
    assert (current, torque) == pytest.approx((10.0, 0.5))
    assert float(motor.steady(12.0, torque)[1]) == pytest.approx(0.0, abs=1e-12)
    i, omega = motor.steady(12.0, -0.3)
    assert i < 0.0 < omega
    assert motor.k * omega > 12.0


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ({"R": -1.0}, r"R \(resistance\): expected a positive number"),
        ({"R": 0.0}, "resistance"),
        ({"J": 0.0}, "moment of inertia"),
        ({"k": 0.0}, "constant"),
        ({"L": -1e-3}, r"L \(inductance\): expected no negative number"),
        ({"F": math.nan}, "friction"),
        ({"J": math.inf}, "moment of inertia"),
        ({"R": "much"}, "resistance"),
    ],
)
def test_what_is_no_motor_is_refused_in_words(changed, told):
    with pytest.raises(InputError, match=told):
        DcMotor(**(COURSE | changed))


@pytest.mark.parametrize(
    ("pieces", "told"),
    [
        ([], "pieces: expected 1 to"),
        ([Piece(0.0, 1.0, 0.0)], "piece 1: expected a positive duration"),
        ([Piece(1.0, 1.0, 0.0), Piece(1.0, math.inf, 0.0)], "piece 2"),
        ([Piece(1e6, 1.0, 0.0)], "take L = 0, the model without inductance, or a shorter time"),
    ],
)
def test_runs_that_cannot_be_are_refused_in_words(pieces, told):
    with pytest.raises(InputError, match=told):
        run(DcMotor(**COURSE), pieces)


def test_a_start_is_three_numbers():
    with pytest.raises(InputError, match="start: expected current"):
        run(DcMotor(**COURSE), [Piece(1.0, 1.0, 0.0)], (0.0, 0.0))


def test_no_transfer_at_a_pole():
    motor = MOTORS["no_L"]
    with pytest.raises(InputError, match="expected no pole"):
        DcMotor(R=1.0, L=0.0, k=1.0, J=1.0).transfer(-1.0)
    assert abs(motor.transfer(1j)[0]) < motor.voltage_gain
