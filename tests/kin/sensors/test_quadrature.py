"""Incremental encoders: the order of the edges, counts after any sequence of reversals, and even or uneven counts."""

import math

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.sensors.quadrature import (
    DECODERS,
    HONEST,
    LEVELS,
    Motion,
    angular_resolution,
    electrical,
    index_of,
    lead,
    levels_of,
    lost,
    quarter_of,
    turned_on,
)

DEG = math.radians(1.0)


def test_the_sequence_of_the_notes_counts_up_and_reversed_down(truth):
    case = truth["C2.3-quadrature-decode"]
    levels, expected = case["inputs"]["seq_AB"], case["expected"]
    assert DECODERS["x4"].steps(levels).tolist() == expected["x4_steps"]
    assert DECODERS["x4"].steps(levels[::-1]).tolist() == expected["reversed_steps"]
    assert expected["direction"] == "A leads B (=+1)"
    assert lead(levels) == 1


def test_the_two_orders_of_the_edges_are_opposite_directions():
    """The notes call both clockwise; lead(+) - lead(-) would then be 0, and it is 2, while their sum is 0."""
    there = levels_of(np.arange(40))
    back = there[::-1]
    assert lead(there) - lead(back) == 2
    assert lead(there) + lead(back) == 0
    assert lead(levels_of([1, 2, 3])) == 0  # no rising edge of A
    # A quarter of a turn and back of 16 periods: the rule of the notes ends 2 x 16 counts up.
    x4 = DECODERS["x4"]
    levels = Motion(0.0, (90 * DEG, -90 * DEG), 1.0).signals(16).levels
    assert x4.count(levels)[-1] == 0
    assert x4.one_way().count(levels)[-1] == 32


def test_an_electrical_degree_is_a_mechanical_one_over_the_periods():
    """C2.3-electrical-degree, notes 2.41 with N_e = 1000: 360 electrical degrees are 0.36 mechanical ones."""
    assert np.degrees(electrical(DEG / 1000, 1000)) == pytest.approx(1.0, abs=1e-12)
    assert np.degrees(electrical(0.36 * DEG, 1000)) == pytest.approx(360.0, abs=1e-9)


def test_the_angular_resolution_is_degrees_for_a_count():
    """C2.3-quadrature-D, notes 2.44-2.45, for PPR = 1000; the text of the notes would say 1000 in place of 0.36."""
    found = [math.degrees(angular_resolution(1000, DECODERS[key].per_period)) for key in ("x1", "x2", "x4")]
    np.testing.assert_allclose(found, [0.36, 0.18, 0.09], rtol=0, atol=1e-12)
    assert found[0] != pytest.approx(1000.0)


def test_two_periods_are_two_counts_or_four_or_eight():
    """C2.3-quadrature-counts: the picture of the notes, where 2 pulses become 8."""
    levels = Motion(0.0, (math.pi,), 1.0).signals(4).levels
    assert len(levels) - 1 == 8
    counted = {key: int(DECODERS[key].count(levels)[-1]) for key in DECODERS}
    assert counted == {"x1": 2, "x2": 4, "x2_notes": 4, "x4": 8, "rising": 2, "alone": 2}


@pytest.mark.parametrize(
    ("key", "gaps", "unevenness"),
    [
        ("x1", [360], 0.0),
        ("x2", [180, 180], 0.0),
        ("x2_notes", [90, 270], 0.5),
        ("x4", [90, 90, 90, 90], 0.0),
    ],
)
def test_the_gaps_between_counts(key, gaps, unevenness):
    """The rising edges of A and of B, which the notes count for D = 2, are not evenly spread."""
    decoder = DECODERS[key]
    np.testing.assert_allclose(np.degrees(decoder.gaps), gaps, rtol=0, atol=1e-12)
    assert decoder.unevenness == pytest.approx(unevenness, abs=1e-12)
    # The same, from the signals of one period and a half.
    counted = np.flatnonzero(decoder.steps(levels_of(np.arange(9)))) * 90.0
    np.testing.assert_allclose(np.diff(counted)[: len(gaps)], gaps, rtol=0, atol=1e-12)


def random_motion(rng):
    """Any number of reversals, from far less than a quarter to several turns; some end exactly on an edge."""
    pulses = int(rng.integers(1, 40))
    quarter = 2.0 * np.pi / (4 * pulses)
    moves = rng.normal(size=rng.integers(1, 30)) * quarter * 10.0 ** rng.uniform(-1.5, 1.5)
    on_edges = rng.random(len(moves)) < 0.3
    start = float(rng.choice([0.0, quarter * rng.integers(-9, 9), rng.uniform(-9.0, 9.0)]))
    moves = np.where(on_edges, np.round(moves / quarter) * quarter, moves)
    return Motion(start, tuple(moves.tolist()), float(rng.uniform(0.1, 10.0))), pulses


@pytest.mark.parametrize("key", HONEST)
def test_counts_are_right_after_any_sequence_of_reversals(key, rng):
    """The count made of levels alone is the number of counted edges between start and end, wherever the disk was."""
    decoder = DECODERS[key]
    for _ in range(150):
        motion, pulses = random_motion(rng)
        signals = motion.signals(pulses)
        expected = decoder.true_count(signals.quarters) - decoder.true_count(signals.quarters[0])
        np.testing.assert_array_equal(decoder.count(signals.levels), expected)
        assert lost(signals.levels) == 0
        # By its angle: the count is that of the way, to within a count at either end.
        way = (motion.angles[-1] - motion.angles[0]) / angular_resolution(pulses, decoder.per_period)
        assert abs(decoder.count(signals.levels)[-1] - way) <= 1.0 + decoder.unevenness + 1e-6


def test_what_goes_and_comes_back_counts_what_is_left(rng):
    """Moves are whole parts of a quarter, so that many reversals lie on an edge; the edges passed are known exactly."""
    for _ in range(600):
        pulses, finer, start = int(rng.integers(1, 65)), int(rng.choice([1, 4, 7])), int(rng.integers(-200, 201))
        most = int(rng.choice([1, 3, 20, 500]))
        moves = rng.integers(-most, most + 1, size=rng.integers(0, 41)).tolist()
        part = 2.0 * math.pi / (4 * pulses * finer)
        motion = Motion((start + 0.5) * part, tuple(move * part for move in moves), 1.0)
        first, last = (math.floor((each + 0.5) / finer) for each in (start, start + sum(moves)))
        levels = motion.signals(pulses).levels
        made = f"{pulses} pulses, parts of 1/{finer}, from {start} by {moves}"
        assert DECODERS["x4"].count(levels)[-1] == last - first, made
        assert lost(levels) == 0, made


def test_edges_come_in_time_and_where_the_disk_is(rng):
    """The quarters of the signals are those of the angle at any time that is not that of an edge."""
    for _ in range(60):
        motion, pulses = random_motion(rng)
        signals = motion.signals(pulses)
        assert len(signals.times) == motion.edges(pulses) == len(signals.quarters) - 1
        assert np.all(np.diff(signals.times) >= 0.0)
        assert set(np.abs(np.diff(signals.quarters)).tolist()) <= {1}
        times = np.sort(rng.uniform(0.0, motion.duration, 200))
        near = np.abs(times[:, None] - np.concatenate([signals.times, motion.times])).min(axis=1)
        times = times[near > 1e-6 * motion.duration]
        seen = signals.quarters[np.searchsorted(signals.times, times)]
        np.testing.assert_array_equal(seen, quarter_of(motion.at(times), pulses))


def test_a_hand_that_trembles_at_an_edge_drives_the_beginners_rules_away():
    """Ten times over the edge at which A rises and back: nothing has moved."""
    levels = Motion(-0.1 * DEG, (0.2 * DEG, -0.2 * DEG) * 10, 1.0).signals(8).levels
    # The edge at angle zero is between quarters -1 and 0, where B falls; that of A is a quarter later.
    assert DECODERS["alone"].count(levels)[-1] == 0
    at_a = 2.0 * math.pi / 32
    levels = Motion(at_a - 0.1 * DEG, (0.2 * DEG, -0.2 * DEG) * 10, 1.0).signals(8).levels
    counted = {key: int(decoder.count(levels)[-1]) for key, decoder in DECODERS.items()}
    assert counted == {"x1": 0, "x2": 0, "x2_notes": 0, "x4": 0, "rising": 10, "alone": 10}


def test_z_makes_the_count_that_of_the_place_once_it_has_come(rng):
    for _ in range(60):
        motion, pulses = random_motion(rng)
        signals = motion.signals(pulses)
        index = index_of(signals.quarters, pulses)
        rises = np.flatnonzero(index[1:] & ~index[:-1]) + 1
        for key in HONEST:
            decoder = DECODERS[key]
            counted = decoder.count(signals.levels, index)
            if not len(rises):
                np.testing.assert_array_equal(counted, decoder.count(signals.levels))
                continue
            turn = pulses * decoder.per_period
            place = decoder.true_count(signals.quarters)
            after = slice(rises[0], None)
            np.testing.assert_array_equal((counted[after] - place[after]) % turn, 0)
            assert np.all(counted[rises] == 0)


def test_two_edges_at_once_are_lost_and_add_nothing():
    levels = LEVELS[[0, 2, 3]]
    assert DECODERS["x4"].steps(levels).tolist() == [0, 1]
    assert lost(levels) == 1


def test_a_hand_that_goes_on_makes_its_last_move_longer():
    moves = ()
    for by in (0.2, 0.3, 0.0, -0.4, -0.1, 0.6):
        moves = turned_on(moves, by)
    np.testing.assert_allclose(moves, [0.5, -0.5, 0.6], rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: angular_resolution(0), r"PPR: expected a whole number, at least 1, got 0"),
        (lambda: angular_resolution(10**9), r"PPR: expected at most 1000000, got 1000000000"),
        (lambda: angular_resolution(100, 0), r"D: expected a whole number, at least 1, got 0"),
        (lambda: Motion(0.0, (1.0,), 0.0), r"speed: expected a positive number, got 0"),
        (lambda: Motion(0.0, (math.inf,), 1.0), r"moves: expected finite angles"),
        (lambda: DECODERS["x1"].steps([[0, 2]]), r"levels: expected rows of A and B, each 0 or 1"),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(make, text):
    with pytest.raises(InputError, match=text):
        make()
