"""The pages of accuracy and of calibration: what throws tell, what calibration leaves, and what is refused."""

import re

import numpy as np
import pytest

from armlab.benches.sensor.calibration.examples import EXAMPLES as SENSORS
from armlab.benches.sensor.calibration.examples import ChooseCalibrationExample
from armlab.benches.sensor.calibration.facts import FACTS as CALIBRATED
from armlab.benches.sensor.calibration.state import Curve
from armlab.benches.sensor.measure.commands import AimAsBefore, CorrectAim, ThrowAgain
from armlab.benches.sensor.measure.examples import EXAMPLES, ChooseThrowsExample
from armlab.benches.sensor.measure.facts import FACTS
from armlab.benches.sensor.measure.state import Throws
from armlab.benches.sensor.measure.ui.board import MOST_DRAWN, board, place
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.sensors.characteristic import Sensor
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from armlab.ui.units import Units
from support.done import done
from support.filled import Filled

UNITS = Units(Notation())


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def fact(state, name, facts=FACTS):
    return facts.facts[name].now(state).value


def left(state, name):
    return fact(state, name, CALIBRATED)


def test_the_examples_of_throws_are_what_they_are_called():
    found = {key: opened(ChooseThrowsExample(key)) for key in EXAMPLES}
    assert found["biased"][Throws] == opened()[Throws]
    assert fact(found["biased"], "bias_share") > 0.9
    assert fact(found["spread"], "bias_share") < 0.3
    assert not fact(found["spread"], "settled")
    assert 0.2 < fact(found["both"], "bias_share") < 0.8
    assert fact(found["good"], "hits") > 15
    assert "four of twenty" in EXAMPLES["spread"].says
    assert (fact(found["spread"], "hits"), found["spread"][Throws].count) == (4, 20)
    assert not fact(found["good"], "settled")
    few = found["few"][Throws].found
    assert few.high / few.low > 3.0


def test_a_correction_takes_the_bias_away_up_to_chance_and_leaves_the_spread():
    before = opened()
    after = apply(before, CorrectAim())
    assert fact(before, "true_bias") > 0.058
    assert fact(after, "true_bias") < fact(before, "radius")
    assert fact(after, "true_spread") == fact(before, "true_spread")
    assert fact(after, "spread") == pytest.approx(fact(before, "spread"), rel=0.5)
    assert fact(after, "hits") > fact(before, "hits")
    assert fact(after, "corrected")
    again = apply(after, AimAsBefore())
    assert not fact(again, "corrected")
    assert fact(again, "true_bias") == pytest.approx(fact(before, "true_bias"))


@pytest.mark.parametrize("count", [3, 7, 20, 30])
def test_without_spread_one_correction_leaves_nothing(count):
    wide, exact = opened(Set(Throws, "count", count), CorrectAim()), Set(Throws, "spread", 0.0)
    for right, up in ((0.05, 0.03), (0.0371, 0.07), (37.1 * 1e-3, 0.1)):
        state = done(wide, exact, Set(Throws, "right", right), Set(Throws, "up", up))
        assert fact(state, "settled")
        state = apply(state, CorrectAim())
        assert not fact(state, "settled")
        assert (fact(state, "rms"), fact(state, "hits")) == (0.0, count)


def test_throwing_again_changes_the_throws_alone():
    before = opened()
    after = apply(before, ThrowAgain())
    assert fact(after, "true_bias") == fact(before, "true_bias")
    assert not np.allclose(after[Throws].points, before[Throws].points, rtol=0, atol=1e-6)
    last = apply(opened(Set(Throws, "seed", 1_000_000)), ThrowAgain())
    assert last[Throws].seed == 0


def test_the_mean_square_miss_is_that_of_bias_and_spread_together():
    for key in EXAMPLES:
        part = opened(ChooseThrowsExample(key))[Throws]
        assert part.rms**2 == pytest.approx(part.found.distance**2 + part.about**2, rel=1e-12)
    exact = opened(Set(Throws, "right", 0.0), Set(Throws, "up", 0.0), Set(Throws, "spread", 0.0))
    assert (fact(exact, "bias_share"), fact(exact, "hits"), fact(exact, "rms")) == (0.0, 20, 0.0)


def test_the_board_shows_the_throws_where_they_are():
    part = opened(Set(Throws, "count", 3))[Throws]
    picture = board(part, UNITS)
    dots = re.findall(r"M([\d.-]+) ([\d.-]+)h0", picture)
    assert [(float(x), float(y)) for x, y in dots] == [
        pytest.approx(place(x, y), abs=0.06) for x, y in part.points.tolist()
    ]
    assert place(0.0, 0.1)[1] < place(0.0, 0.0)[1]  # up is up
    many = opened(Set(Throws, "count", 10_000))[Throws]
    assert board(many, UNITS).count("h0") <= MOST_DRAWN
    assert "th-true" in picture
    assert "th-true" not in board(part.with_values({"told": False}), UNITS)


def test_the_truth_can_be_hidden():
    page = Filled("accuracy")
    assert "(50.0, 30.0)" in page.text
    page.fill("told")
    assert "(50.0, 30.0)" not in page.text


def test_the_verdict_names_the_cause_of_the_misses():
    page = Filled("accuracy")
    assert "Mostly bias: not accurate" in page.text
    page.fill("correct")
    assert "No bias that chance would not explain" in page.text
    page.fill("example", "both")
    assert "Both bias and spread" in page.text
    page.do(Set(Throws, "count", 400), Set(Throws, "right", 0.01), Set(Throws, "up", 0.0))
    assert "Mostly spread: not repeatable" in page.text


def test_calibration_leaves_what_the_sentences_say():
    usual = opened()
    assert usual[Curve] == SENSORS["usual"].part
    assert left(usual, "after") < 0.5 * left(usual, "before")
    third = apply(usual, Set(Curve, "degree", 3))
    assert left(third, "linearity") > 3 * left(third, "linearity_after")
    assert left(third, "after") == pytest.approx(0.5 * (0.4 + 0.2), abs=0.25)  # half of hysteresis and step, and noise
    assert left(opened(ChooseCalibrationExample("straight")), "between") < 1e-9
    bent = opened(ChooseCalibrationExample("bent"))
    assert left(bent, "linearity") > 2.0
    assert left(bent, "after") == pytest.approx(0.1 * left(bent, "linearity"), rel=0.1)
    assert left(apply(bent, Set(Curve, "degree", 5)), "after") < 4.0 * bent[Curve].noise
    play = opened(ChooseCalibrationExample("play"))
    assert left(play, "hysteresis") == pytest.approx(3.0, abs=1e-6)
    assert left(play, "after") > 1.4
    too_high = opened(ChooseCalibrationExample("too_high"))
    assert left(too_high, "between") > 1.5 * left(too_high, "after")
    drift = opened(ChooseCalibrationExample("drift"))
    assert left(drift, "after") < 0.4
    assert 1.6 < left(drift, "between") < 2.3


def test_injected_errors_are_found_again():
    alone = dict.fromkeys(("offset", "gain", "bend", "hysteresis", "resolution", "noise"), 0.0)
    for name, fact_name, value in (
        ("offset", "offset", 3.0),
        ("gain", "gain", -4.0),
        ("hysteresis", "hysteresis", 1.5),
        ("resolution", "resolution", 2.0),
    ):
        state = opened()
        for each, zero in alone.items():
            state = apply(state, Set(Curve, each, value if each == name else zero))
        assert left(state, fact_name) == pytest.approx(value, abs=0.05)


def test_the_page_of_calibration_says_what_is_left():
    page = Filled("calibration")
    assert "raise the degree" in page.text
    page.fill("degree", "3")
    assert "no function of the output takes them away" in page.text
    page.fill("example", "bent")
    assert "degree 5 leaves little more than noise" in page.text
    assert "A polynomial of degree 3 does not follow the curve closely enough: raise the degree" in page.text
    page.fill("degree", "5")
    assert "raise the degree" not in page.text
    page.fill("example", "straight")
    assert "The polynomial is the curve" in page.text
    assert re.search(r"u = −0\.03125 \+ 1\.042 y", page.text)  # (y - 0.03) / 0.96
    page.fill("example", "too_high")
    assert "too high a degree" in page.text
    assert "so much noise" in page.text
    page.fill("example", "drift")
    assert "Mostly drift: 1.800 %" in page.text


def test_what_cannot_be_or_cannot_help_is_not_advised():
    exact = dict.fromkeys(("offset", "gain", "hysteresis", "resolution", "noise"), 0.0)
    page = Filled("calibration")
    page.do(Set(Curve, "shape", "wave"), *(Set(Curve, name, value) for name, value in exact.items()))
    for bend, degree in ((-20.0, 9), (-20.0, 3), (20.0, 3)):
        page.do(Set(Curve, "bend", bend), Set(Curve, "degree", degree))
        assert "The curve turns back: one output belongs to two inputs" in page.text
        assert "raise the degree" not in page.text
    page.do(Set(Curve, "bend", 15.0))
    assert "raise the degree" in page.text
    page.do(Set(Curve, "points", 100), Set(Curve, "degree", 9))
    assert "degree 9 does not follow the curve closely enough, and no higher one can be chosen" in page.text


@pytest.mark.parametrize("shape", ["arch", "wave"])
def test_a_curve_turns_back_where_its_outputs_fall_and_rise(shape):
    u = np.linspace(0.0, 1.0, 2001)
    for bend in np.linspace(-0.3, 0.3, 38):
        sensor = Sensor(gain=-0.05, bend=bend, shape=shape)
        steps = np.diff(sensor.output(u))
        assert sensor.turns_back == bool(steps.min() < 0.0 < steps.max())


def test_only_errors_that_the_sensor_has_are_said_to_be_left():
    page = Filled("calibration")
    page.fill("example", "play")
    assert "Hysteresis is left" in page.text
    page.fill("noise", "0.1")
    assert "Hysteresis and noise are left" in page.text


def test_too_high_a_degree_is_neither_resolution_nor_noise_that_is_not_there():
    page = Filled("calibration")
    for resolution in ("1", "5"):  # 21 points, 5 % apart, lie on steps of both
        page.fill("example", "straight")
        page.fill("resolution", resolution)
        assert f"{float(resolution) / 2.0:.3f} % left of" in page.text
        assert "The resolution is left: no function of the output takes it away" in page.text
    page.fill("example", "bent")
    for name, text in (("noise", "0"), ("points", "4")):
        page.fill(name, text)
    assert "too few points for this degree" in page.text
    assert "so much noise" not in page.text


def test_a_line_through_three_points_of_a_wave_is_not_the_curve():
    page = Filled("calibration")
    page.fill("example", "straight")
    page.do(
        *(Set(Curve, name, value) for name, value in {"shape": "wave", "bend": 3.0, "degree": 1, "points": 3}.items())
    )
    assert "too few points for this degree" in page.text


@pytest.mark.parametrize(
    ("key", "cell", "text", "words"),
    [
        ("accuracy", "count", "1e9", "number of throws: expected a whole number from 2 to 10000, got '1e9'"),
        ("accuracy", "count", "1", "number of throws: expected a whole number from 2 to 10000, got '1'"),
        ("accuracy", "spread", "-1", "σ (spread, the standard deviation along a direction): expected a number in mm"),
        (
            "accuracy",
            "hit",
            "0",
            "r (radius of a hit): expected a number in mm greater than 0 and at most 120, got '0'",
        ),
        ("accuracy", "seed", "-1", "seed of the throws: expected a whole number from 0 to 1000000, got '-1'"),
        ("calibration", "points", "2", "points on each way: expected a whole number from 3 to 200, got '2'"),
        ("calibration", "degree", "30", "degree of the polynomial: expected a whole number from 1 to 9, got '30'"),
        ("calibration", "hysteresis", "-1", "hysteresis: expected a number in % from 0 to 20, got '-1'"),
        ("calibration", "age", "-1", "months since the calibration: expected a number from 0 to 120, got '-1'"),
    ],
)
def test_bad_input_is_said_at_its_field_and_all_stays_as_it_was(key, cell, text, words):
    page = Filled(key)
    before = page.state
    page.fill(cell, text)
    assert words in page.text
    assert page.state is before


def test_a_degree_that_the_points_do_not_determine_is_refused():
    with pytest.raises(InputError, match="degree: expected 1 to 4, with 5 points, got 7"):
        opened(Set(Curve, "points", 5), Set(Curve, "degree", 7))
    with pytest.raises(InputError, match="degree: expected 1 to 2, with 3 points, got 3"):
        opened(Set(Curve, "degree", 3), Set(Curve, "points", 3))
