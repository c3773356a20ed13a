"""Speed by counts in a window and by the time between counts: the example, errors, delays, and a run."""

import math

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.sensors.quadrature import DECODERS
from armlab.kin.sensors.speed import Meter, Readings, RunUp, speed_by_counts, speed_by_time

DEG = math.radians(1.0)


def test_the_example_of_the_notes_turns_twice_a_second(truth):
    case = truth["C2.3-encoder-720"]
    inputs, expected, tol = case["inputs"], case["expected"], case["tol"]
    meter = Meter(inputs["PPR"], DECODERS[f"x{inputs['D']}"], inputs["dt"], 1e6)
    assert math.degrees(meter.resolution) == pytest.approx(expected["AR_deg"], abs=tol)
    assert inputs["C"] / meter.window == pytest.approx(expected["f"], abs=tol)
    omega = float(speed_by_counts(inputs["C"], meter.resolution, meter.window))
    assert math.degrees(omega) == pytest.approx(expected["omega_deg_s"], abs=1e3 * tol)
    assert omega / (2.0 * math.pi) == pytest.approx(expected["rev_s"], abs=tol)
    # By the time between counts: 0.36 deg in 500 ticks of a microsecond.
    assert math.degrees(float(speed_by_time(500, meter.resolution, 1e6))) == pytest.approx(720.0, abs=1e-9)
    assert math.isinf(speed_by_time(0, meter.resolution, 1e6))


def constant(meter, speed, phase):
    """Return what both ways read at one speed, by counting edges and ticks one by one."""
    start = phase * meter.resolution
    edges = meter.place(np.arange(0, int(speed * meter.window / meter.resolution) + 12))
    times = (edges - start) / speed
    times = times[times >= 0.0]
    in_window = np.count_nonzero(times < meter.window)
    ticks = np.diff(np.floor(times * meter.clock))
    return speed_by_counts(in_window, meter.resolution, meter.window), speed_by_time(
        ticks, meter.resolution, meter.clock
    )


@pytest.mark.parametrize("key", ["x1", "x2", "x2_notes", "x4"])
def test_errors_stay_within_what_is_said_of_them_and_come_near_it(key, rng):
    meter, near = Meter(50, DECODERS[key], 0.1, 5e3), []
    for speed in rng.uniform(2.0, 60.0, 25):
        found = [constant(meter, speed, phase) for phase in rng.random(40)]
        by_counts = max(abs(float(counts) / speed - 1.0) for counts, _ in found)
        by_time = max(float(np.abs(times / speed - 1.0).max()) for _, times in found)
        near.append([by_counts / meter.error_by_counts(speed), by_time / meter.error_by_time(speed)])
    assert np.max(near) <= 1.0 + 1e-9
    assert np.min(np.max(near, axis=0)) > 0.7


def test_at_the_crossover_a_count_and_a_tick_are_the_same_part():
    meter = Meter(1000, DECODERS["x4"], 0.01, 1e6)
    speed = meter.crossover
    assert meter.error_by_counts(speed) == pytest.approx(1.0 / math.sqrt(1e6 * 0.01), rel=0.01)
    assert meter.error_by_time(speed) == pytest.approx(float(meter.error_by_counts(speed)), rel=1e-9)
    assert meter.error_by_time(0.1 * speed) < 0.02 * meter.error_by_counts(0.1 * speed)
    assert meter.error_by_counts(10.0 * speed) < 0.02 * meter.error_by_time(10.0 * speed)


def test_with_the_uneven_counts_of_the_notes_the_time_between_counts_is_useless():
    """The gaps are half and one and a half of what they should be: the speed reads doubled, and two thirds."""
    meter = Meter(100, DECODERS["x2_notes"], 0.1, 1e7)
    _, found = constant(meter, 10.0, 0.1)
    np.testing.assert_allclose(sorted(set(np.round(found / 10.0, 2).tolist())), [0.67, 2.0], atol=0.005)
    assert meter.error_by_time(10.0) == pytest.approx(1.0, abs=0.001)
    assert Meter(100, DECODERS["x2"], 0.1, 1e7).error_by_time(10.0) < 1e-3


@pytest.mark.parametrize("key", list(DECODERS))
def test_places_and_numbers_of_counted_edges_fit_one_another(key, rng):
    decoder = DECODERS[key]
    meter = Meter(7, decoder, 0.1, 1e6)
    numbers = np.arange(-40, 40)
    places = meter.place(numbers)
    np.testing.assert_array_equal(meter.number(places), numbers)
    np.testing.assert_array_equal(meter.number(places - 1e-6), numbers - 1)
    gaps = np.diff(places)[: 7 * decoder.per_period] * 7
    np.testing.assert_allclose(sorted(set(np.round(gaps, 6))), sorted(set(np.round(decoder.gaps, 6))), atol=1e-6)


def test_the_times_of_a_run_are_those_of_its_angles():
    run = RunUp(3.0, 0.5, 1.2, start=-0.4, rest=0.3)
    times = np.linspace(0.0, run.moving, 200)
    np.testing.assert_allclose(run.time_of(run.angle(times)), times, rtol=0, atol=1e-6)
    steps = np.linspace(0.0, run.duration, 4001)
    middle = 0.5 * (steps[1:] + steps[:-1])
    by_differences = np.diff(run.angle(steps)) / np.diff(steps)
    np.testing.assert_allclose(by_differences, run.speed_at(middle), rtol=0, atol=2e-3)
    assert run.angle(run.duration) - run.angle(0.0) == pytest.approx(3.0 * (0.5 + 1.2), abs=1e-12)


def test_readings_of_a_run_are_those_of_its_edges():
    """Against a list of all edges of the run, made by looking at a hundred thousand times."""
    meter = Meter(20, DECODERS["x4"], 0.05, 2e3)
    run = RunUp(12.0, 0.3, 0.4, start=0.013, rest=0.2)
    readings = Readings(meter, run)
    fine = np.linspace(0.0, run.duration, 100_001)
    numbers = meter.number(run.angle(fine))
    edges = fine[1:][np.diff(numbers) > 0]
    times = np.array([0.02, 0.13, 0.2508, 0.41, 0.777, 0.93, 1.1])
    by_counts, by_time, ticks = readings.by_counts(times), readings.by_time(times), readings.ticks(times)
    assert math.isnan(by_counts[0])
    for k, time in enumerate(times[1:], 1):
        end = math.floor(time / meter.window + 1e-9) * meter.window
        counted = np.count_nonzero((edges > end - meter.window) & (edges <= end))
        assert by_counts[k] == pytest.approx(counted * meter.resolution / meter.window, abs=1e-9)
        last = edges[edges <= time][-2:]
        assert abs(ticks[k] - np.diff(last)[0] * meter.clock) <= 1.0 + 0.05  # either way, and the list is as fine
        assert by_time[k] == pytest.approx(meter.resolution * meter.clock / ticks[k], rel=1e-12)


def test_the_counts_are_late_by_half_a_window_and_the_time_by_half_a_count():
    """While the speed rises evenly, what is read is the speed of half a window, or half a count, before."""
    run = RunUp(100.0, 10.0, 1.0)
    meter = Meter(10, DECODERS["x4"], 0.1, 1e9)
    readings = Readings(meter, run)
    ends = np.arange(20, 90) * 0.1 + 1e-7
    late = ends - readings.by_counts(ends) / 10.0
    np.testing.assert_allclose(late.mean(), meter.delay_by_counts(), rtol=0, atol=5e-3)  # a count is 0.16 of a second
    at_edges = run.time_of(meter.place(np.arange(100, 3000, 30))) + 1e-12
    late = at_edges - readings.by_time(at_edges) / 10.0
    expected = [meter.delay_by_time(10.0 * time) for time in at_edges]
    np.testing.assert_allclose(late, expected, rtol=0, atol=2e-5)


def test_when_the_shaft_stops_the_counts_say_so_and_the_time_does_not():
    readings = Readings(Meter(100, DECODERS["x1"], 0.05, 1e6), RunUp(20.0, 0.2, 0.5, rest=1.0))
    assert readings.by_counts(1.5) == 0.0
    assert readings.by_time(1.5) == readings.by_time(1.9) > 0.0
    assert readings.ticks(0.001) == -1


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: Meter(0, DECODERS["x1"], 0.1, 1e6), r"PPR: expected a whole number, at least 1, got 0"),
        (lambda: Meter(100, DECODERS["x1"], -0.1, 1e6), r"window: expected a positive number, got -0.1"),
        (lambda: Meter(100, DECODERS["x1"], 0.1, 0.0), r"clock: expected a positive number, got 0"),
        (lambda: speed_by_counts("x", 1.0, 1.0), r"counts: expected numbers"),
        (lambda: speed_by_time(-1, 1.0, 1.0), r"ticks: expected no negative number"),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(make, text):
    with pytest.raises(InputError, match=text):
        make()
