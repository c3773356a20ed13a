"""The page of the speed from an encoder: the example of the notes, what the others say, and what is refused."""

import math
import re
from html import unescape

import numpy as np
import pytest

from armlab.benches.sensor.speed.commands import SetCounts
from armlab.benches.sensor.speed.examples import EXAMPLES, ChooseSpeedExample
from armlab.benches.sensor.speed.facts import FACTS
from armlab.benches.sensor.speed.state import EncoderSpeed
from armlab.benches.sensor.speed.ui.errors import errors, large, percents, speeds
from armlab.benches.sensor.speed.ui.words import formulas, readings_markup, seconds, verdict
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.state import State
from armlab.ui.units import Units
from support.done import done
from support.filled import Filled

DEG = math.radians(1.0)
UNITS = Units(Notation())


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def fact(state, name):
    return FACTS.facts[name].now(state).value


def example(key):
    return opened(ChooseSpeedExample(key))


def test_the_page_opens_with_the_example_of_the_notes(truth):
    state, case = opened(), truth["C2.3-encoder-720"]
    assert state[EncoderSpeed] == EXAMPLES["notes"].part
    assert fact(state, "counts") == case["inputs"]["C"]
    assert math.degrees(fact(state, "resolution")) == pytest.approx(case["expected"]["AR_deg"])
    assert math.degrees(fact(state, "by_counts")) == pytest.approx(case["expected"]["omega_deg_s"])
    assert fact(state, "ticks") == 500
    assert math.degrees(fact(state, "by_time")) == pytest.approx(720.0)
    assert math.degrees(fact(state, "quantum")) == pytest.approx(3.6)
    assert fact(state, "error_by_counts") == pytest.approx(0.005)
    assert fact(state, "delay_by_counts") == pytest.approx(0.05)


def test_one_tick_more_and_one_less_change_the_reading_by_different_amounts():
    """One less is the farther of both, as far as the largest error is."""
    part = opened()[EncoderSpeed]
    table = str(readings_markup(part, UNITS))
    assert "−1.437 °/s<br>+1.443 °/s" in table
    assert "0.2004 %" in table
    assert "−360 °/s<br>+∞" in str(readings_markup(opened(Set(EncoderSpeed, "clock", 2000.0))[EncoderSpeed], UNITS))
    fine = opened(Set(EncoderSpeed, "clock", 1e9))[EncoderSpeed]
    assert "∓0.00144 °/s" in str(readings_markup(fine, UNITS))


def test_a_whole_turn_is_written_in_the_unit_of_the_person():
    degrees, radians = (str(formulas(Units(Notation(angle=unit)))) for unit in ("deg", "rad"))
    assert "360" in degrees
    assert "360" not in radians
    assert "π" in unescape(radians)


def test_the_other_examples_read_as_their_sentences_say():
    slow = example("slow")
    assert fact(slow, "counts") in (2, 3)
    assert fact(slow, "ticks") == 40_000
    assert fact(slow, "error_by_time") == pytest.approx(2.5e-5, rel=0.01)
    assert fact(slow, "finer") == "time"
    servo = example("servo")
    assert fact(servo, "counts") == 8
    assert fact(servo, "error_by_counts") == pytest.approx(0.125)
    assert fact(servo, "error_by_time") < 1e-3
    coarse = example("coarse_clock")
    assert sorted(coarse[EncoderSpeed].ticks[:2]) == [2, 3]
    assert sorted({round(math.degrees(each)) for each in coarse[EncoderSpeed].by_time}) == [3000, 4500]
    assert fact(coarse, "finer") == "counts"
    uneven = example("uneven")[EncoderSpeed]
    np.testing.assert_allclose(sorted(uneven.by_time / uneven.speed), [2 / 3, 2], rtol=1e-2)
    assert uneven.by_counts == pytest.approx(uneven.speed, rel=0.01)


def test_typed_counts_set_the_speed_at_which_they_come():
    state = opened(SetCounts(50))
    assert math.degrees(fact(state, "speed")) == pytest.approx(180.0)
    assert fact(state, "counts") == 50
    with pytest.raises(InputError, match=r"counts: expected 1 to 1.59155e\+06 in a window of 0.1 s, got 10000000"):
        opened(SetCounts(10_000_000))


def test_without_a_tick_between_counts_there_is_no_reading():
    state = opened(Set(EncoderSpeed, "clock", 100.0))
    assert fact(state, "by_time") is None
    assert fact(state, "error_by_time") is None
    assert "no tick" in readings_markup(state[EncoderSpeed], UNITS)


@pytest.mark.parametrize(("window", "clock"), [(1e-3, 1e3), (1e-2, 1e3), (0.1, 1e6)])
def test_the_finer_reading_changes_where_both_are_said_to_be_as_fine(window, clock):
    state = opened(Set(EncoderSpeed, "window", window), Set(EncoderSpeed, "clock", clock))
    meter = state[EncoderSpeed].meter
    assert float(meter.error_by_time(meter.crossover)) == pytest.approx(float(meter.error_by_counts(meter.crossover)))
    for part, finer in ((0.999, "time"), (1.001, "counts")):
        assert done(state, Set(EncoderSpeed, "speed", part * meter.crossover))[EncoderSpeed].finer == finer


def test_the_picture_crosses_where_both_are_as_fine_and_marks_the_speed():
    part = opened()[EncoderSpeed]
    picture = errors(part, UNITS)
    assert "nan" not in picture
    assert "as fine: 1137 °/s" in picture
    assert len(re.findall(r"<circle ", picture)) == 2
    counts, time = percents(part, np.array([0.99, 1.01]) * part.meter.crossover)
    assert (counts / time)[0] > 1.0 > (counts / time)[1]
    assert len(large(part, UNITS).drawn) == 2
    for key in EXAMPLES:
        assert "nan" not in errors(example(key)[EncoderSpeed], UNITS)
    at = speeds(part)
    assert at[0] < part.speed < at[-1]


def test_the_error_by_time_of_a_huge_clock_is_small_and_not_zero():
    """With one period in a turn, D = 4, 10 GHz and 0.01°/s there are 9·10¹³ ticks between counts, and 10¹⁶ below."""
    page = Filled("encoder_speed")
    for cell, text in (("pulses", "1"), ("clock", "1e10"), ("speed", "0.01")):
        page.fill(cell, text)
    part = page.state[EncoderSpeed]
    assert (part.pulses, part.clock, part.speed) == (1, 1e10, pytest.approx(0.01 * DEG))
    _, time = percents(part, speeds(part))
    assert (time > 0.0).all()
    assert (np.diff(time) > 0.0).all()
    ticks = part.meter.resolution * part.clock / part.speed
    assert float(part.meter.error_by_time(part.speed)) == pytest.approx(1.0 / (ticks - 1.0), rel=1e-12)
    assert np.isfinite(large(part, UNITS).drawn[1].y).all()


def test_what_is_said_of_both():
    assert "The time between counts is finer here" in verdict(opened()[EncoderSpeed], UNITS)
    assert "Counting is finer here" in verdict(example("coarse_clock")[EncoderSpeed], UNITS)
    assert "No clock helps" in verdict(example("uneven")[EncoderSpeed], UNITS)
    assert [seconds(value) for value in (2.0, 0.05, 2.5e-4, 3e-9)] == ["2 s", "50 ms", "250 µs", "3 ns"]


@pytest.mark.parametrize(
    ("cell", "text", "words"),
    [
        ("pulses", "0", "periods in a turn, PPR: expected a whole number from 1 to 1000000, got '0'"),
        (
            "window",
            "-1",
            "T (window in which counts are counted): expected a number in s from 0.00001 to 100, got '-1'",
        ),
        ("clock", "0", "f (clock that times counts): expected a number in Hz from 1 to"),
        ("counts", "0", "counts: expected a whole number of at least 1, got '0'"),
        ("counts", "1e9", "counts: expected 1 to 1.59155e+06 in a window of 0.1 s, got 1000000000"),
        ("speed", "-3", "ω (true speed): expected a number in °/s from"),
    ],
)
def test_bad_input_is_said_at_its_field_and_all_stays_as_it_was(cell, text, words):
    page = Filled("encoder_speed")
    before = page.state
    page.fill(cell, text)
    assert words in page.text
    assert page.state is before
