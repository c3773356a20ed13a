"""The page of the incremental encoder: moves, counts of all rules, the printed rule, and what is refused."""

import math
import re

import numpy as np
import pytest

from armlab.benches.sensor.incremental.clip import CLIP
from armlab.benches.sensor.incremental.commands import BeginAgain, DragTo, SetMoves, StepQuarter, TurnBy
from armlab.benches.sensor.incremental.counting import counts_of, electrical_angle, now
from armlab.benches.sensor.incremental.examples import EXAMPLES, ChooseIncrementalExample
from armlab.benches.sensor.incremental.facts import FACTS
from armlab.benches.sensor.incremental.state import CLIP_KEY, Incremental
from armlab.benches.sensor.incremental.ui.disk import FINEST, arcs, seen, strip
from armlab.benches.sensor.incremental.ui.page import read_moves
from armlab.benches.sensor.incremental.ui.scene import heads, levels
from armlab.benches.sensor.incremental.ui.signals import MOST_SEEN, large, signals, span_of
from armlab.benches.sensor.incremental.ui.words import state_markup, verdict
from armlab.content.lessons import lesson
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.sensors.absolute import TURN
from armlab.kin.sensors.quadrature import DECODERS, HONEST
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.state import State, apply
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
    return opened(ChooseIncrementalExample(key))


def counts(state):
    return dict(zip(DECODERS, fact(state, "counts"), strict=True))


def test_the_lesson_asks_what_is_counted_at_the_other_edge_of_the_window():
    asked = next(step for step in lesson("incremental_encoder").steps if step.title == "Trembling at an edge").question
    here = example("trembling")
    there = apply(here, Set(Incremental, "start", here[Incremental].start + 0.5 * TURN / here[Incremental].pulses))
    assert asked.judge(str(counts(there)["rising"])).right
    assert not asked.judge(str(counts(here)["rising"])).right


def test_the_examples_count_as_their_sentences_say():
    assert opened()[Incremental] == EXAMPLES["reversals"].part
    four = counts(example("four"))
    assert (four["x1"], four["x4"], four["alone"]) == (2, 8, 2)
    there_and_back = counts(example("reversals"))
    assert [there_and_back[key] for key in HONEST] == [0, 0, 0, 0]
    assert there_and_back["alone"] > 0
    trembling = counts(example("trembling"))
    assert [trembling[key] for key in HONEST] == [0, 0, 0, 0]
    assert (trembling["rising"], trembling["alone"]) == (10, 10)
    assert fact(example("one_way"), "count") == 32
    uneven = example("uneven")
    assert (fact(uneven, "per_period"), fact(uneven, "unevenness")) == (2, 0.5)
    thousand = counts(example("thousand"))
    assert (thousand["x1"], thousand["x4"]) == (200, 800)
    assert fact(example("thousand"), "resolution") == pytest.approx(0.36 * DEG)
    assert example("thousand")[Incremental].motion.duration == pytest.approx(0.1)


def test_the_printed_rule_leaves_a_residual_and_the_corrected_one_none():
    """ERR-2.AB: both orders of the edges taken for one direction, and for opposite ones, on the same moves."""
    state = opened(
        Set(Incremental, "pulses", 16), SetMoves((90.0 * DEG, -90.0 * DEG)), Set(Incremental, "rule", "opposite")
    )
    assert (fact(state, "count"), fact(state, "missed"), fact(state, "measured")) == (0, 0, 0.0)
    state = apply(state, Set(Incremental, "rule", "same"))
    assert (fact(state, "count"), fact(state, "missed")) == (32, 32)
    assert math.degrees(fact(state, "measured")) == pytest.approx(180.0)
    assert (fact(state, "opposite_count"), fact(state, "one_way_count")) == (0, 32)
    assert "what comes back is counted up" in verdict(state[Incremental], now(state), UNITS)
    forth, back = opened(SetMoves((2.0,))), opened(SetMoves((-2.0,)))
    assert (fact(forth, "lead"), fact(back, "lead")) == (1, -1)
    assert (fact(forth, "direction"), fact(back, "direction")) == (1, -1)


def test_z_makes_the_count_the_angle_wherever_the_disk_began():
    state = example("index")
    assert math.degrees(fact(state, "angle")) == pytest.approx(45.0)
    assert fact(state, "zero_found")
    assert math.degrees(fact(state, "measured")) == pytest.approx(45.0)
    assert fact(state, "missed") == 0
    without = apply(state, Set(Incremental, "index", False))
    assert math.degrees(fact(without, "measured")) == pytest.approx(
        -45.0
    )  # the way from 100°, in whole counts of 11.25°
    before = opened(ChooseIncrementalExample("index"), OpenClip(CLIP_KEY), Seek(0.5))
    assert not fact(before, "zero_found")
    assert fact(before, "angle") == pytest.approx(55.0 * DEG)


@pytest.mark.parametrize("seed", range(20))
def test_whatever_a_hand_drags_the_counts_are_those_of_the_place(seed):
    """Hundreds of small drags to and fro, in the moves of which each goes on in one direction."""
    rng = np.random.default_rng(seed)
    state = opened(Set(Incremental, "pulses", int(rng.integers(1, 60))), BeginAgain(), Set(Incremental, "speed", 10.0))
    angle = state[Incremental].start
    for drag in range(30):
        for _ in range(8):
            angle += float(rng.normal(0.0, 0.1))
            state = apply(state, DragTo(angle, drag))
            if len(state[Incremental].moves) > 90:
                state = apply(state, BeginAgain())
                angle = state[Incremental].start
    part = state[Incremental]
    assert part.motion.angles[-1] == pytest.approx(angle, abs=1e-9)
    assert np.all(np.array(part.moves[1:]) * part.moves[:-1] < 0.0)
    for key, counted in state.derived(now).counted.items():
        assert counted.count == counts_of(part, key)[-1]
        if key in HONEST:
            assert counted.missed == 0


def test_a_drag_is_one_step_of_undo_and_one_move():
    page = Filled("incremental_encoder")
    page.do(BeginAgain(), OpenClip(CLIP_KEY))
    page.drag("disk", 0.5, 0.45, 0.4, 0.35)
    (move,) = page.state[Incremental].moves
    # Four periods of eight take 284 of 330 pixels.
    assert move == pytest.approx(0.15 * 330 / 284 * TURN / 2)
    assert page.state[Timeline].time == pytest.approx(page.state[Incremental].motion.duration)
    page.drag("disk", 0.35, 0.5)
    assert len(page.state[Incremental].moves) == 2
    page.undo()
    page.undo()
    assert page.state[Incremental].moves == ()


def test_turning_goes_on_where_the_disk_stands():
    state = opened(BeginAgain(), TurnBy(1.0), TurnBy(0.5), TurnBy(-0.2), StepQuarter(-1))
    assert state[Incremental].moves == pytest.approx((1.5, -0.2 - TURN / 32))
    state = apply(state, BeginAgain())
    assert state[Incremental].start == pytest.approx(1.3 - TURN / 32)
    assert (state[Incremental].moves, fact(state, "count")) == ((), 0)
    film = opened(BeginAgain(), TurnBy(1.0), OpenClip(CLIP_KEY))
    half = apply(film, Seek(0.5 * film[Incremental].motion.duration))
    assert apply(half, BeginAgain())[Incremental].start == pytest.approx(0.5)
    shaken = apply(example("trembling"), TurnBy(0.1))
    assert shaken[Incremental].shakes == 0
    assert apply(state, TurnBy(0.0)) is state


def test_the_film_stops_at_every_edge_and_shows_the_count_at_its_time():
    state = opened(SetMoves((90.0 * DEG,)), OpenClip(CLIP_KEY))
    stops = CLIP.stops(state)
    assert len(stops) == 7  # the eighth edge is at the end
    shown = [fact(apply(state, Seek(time + 1e-6)), "count") for time in stops]
    assert shown == [1, 2, 3, 4, 5, 6, 7]
    assert fact(apply(state, Seek(0.0)), "count") == 0
    many = opened(Set(Incremental, "pulses", 1000), OpenClip(CLIP_KEY))
    assert CLIP.stops(many) == pytest.approx(many[Incremental].motion.times[1:-1].tolist())


@pytest.mark.parametrize("pulses", [1, 2, 8, 300])
def test_the_disk_lets_light_through_where_its_signals_are_high(pulses):
    part = opened(Set(Incremental, "pulses", pulses))[Incremental]
    found = arcs(pulses)
    z, b, a = np.unique(found[:, 2])
    for angle in (0.02, 1.0, 2.5, 4.4, 6.2):
        dark = {low for begin, end, low, _ in found.tolist() if begin <= angle < end or begin <= angle + TURN < end}
        expected = tuple(low not in dark for low in (a, b, z))
        assert seen(part, angle) == expected
        assert tuple(head.lit for head in reversed(heads(part, angle))) == expected
        lit = re.findall(r'class="ab-bit"[^>]*>([01])<', strip(part, angle))
        assert tuple(bit == "1" for bit in lit) == expected
        assert levels(part, angle) == ", ".join(f"{n} {int(on)}" for n, on in zip("ABZ", expected, strict=True))
    assert len(arcs(FINEST + 1)) == 3  # too fine to be drawn


@pytest.mark.parametrize("key", EXAMPLES)
def test_the_signals_are_drawn_of_numbers_and_mark_the_edges_that_are_counted(key):
    state = example(key)
    part, found = state[Incremental], state.derived(now)
    picture = signals(part, found)
    assert "nan" not in picture
    low, high = span_of(part, found.time)
    times = part.signals.times
    seen_edges = (times >= low) & (times <= high)
    assert seen_edges.sum() <= MOST_SEEN + 1
    steps = part.decoder_of(part.decoder).steps(part.signals.levels)[seen_edges]
    assert picture.count('class="in-up"') == int((steps > 0).sum())
    assert picture.count('class="in-down"') == int((steps < 0).sum())
    drawn = large(part).drawn
    assert [len(each.x) for each in drawn] == [2 * len(times) + 2] * 3


def test_without_moves_there_is_a_sentence_in_place_of_the_signals():
    state = opened(BeginAgain())
    assert "has not been turned yet" in signals(state[Incremental], state.derived(now))
    assert "no edge yet" in state_markup(state[Incremental], state.derived(now), UNITS)


def test_what_is_said_of_a_count():
    uneven = example("uneven")
    said = verdict(uneven[Incremental], uneven.derived(now), UNITS)
    assert "90° and 270° electrical apart" in said
    assert "1.5 times" in said
    trembling = example("trembling")
    assert "Wrong by +10 counts, 450°" in verdict(trembling[Incremental], trembling.derived(now), UNITS)
    state = opened(SetMoves((-30.0 * DEG,)))
    assert "−3 counts of 11.25° are −33.75°" in verdict(state[Incremental], state.derived(now), UNITS)
    one = opened(BeginAgain(), StepQuarter(-1))
    assert "−1 count of 11.25° is −11.25°" in verdict(one[Incremental], one.derived(now), UNITS)
    alone = opened(BeginAgain(), Set(Incremental, "decoder", "alone"), StepQuarter(1), StepQuarter(-1))
    assert "Wrong by +1 count, 45°" in verdict(alone[Incremental], alone.derived(now), UNITS)


@pytest.mark.parametrize(
    ("pulses", "moves", "speed"),
    [(100, (10.8, -3.6, 27.0), 45.0), (8, (135.0, -112.5, -67.5, 393.75), 720.0)],
)
def test_an_edge_at_the_very_end_is_counted(pulses, moves, speed):
    """The moves end on an edge, whose time must not come out behind the end by rounding."""
    state = opened(
        Set(Incremental, "pulses", pulses),
        Set(Incremental, "decoder", "x4"),
        SetMoves(tuple(map(math.radians, moves))),
        Set(Incremental, "speed", math.radians(speed)),
    )
    part = state[Incremental]
    assert part.signals.times[-1] <= part.motion.duration
    assert fact(state, "count") == fact(state, "opposite_count") == round(sum(moves) * 4 * pulses / 360.0)


def test_moves_are_read_in_the_unit_of_the_person():
    assert read_moves("90, -45 0.5", UNITS) == pytest.approx((90 * DEG, -45 * DEG, 0.5 * DEG))
    assert read_moves("pi/2; 10°", UNITS) == pytest.approx((math.pi / 2, 10 * DEG))
    assert read_moves("90 deg -45 ° 0.1 rad", UNITS) == pytest.approx((90 * DEG, -45 * DEG, 0.1))
    assert read_moves("", UNITS) == ()
    with pytest.raises(InputError, match="move 2: expected a number in degrees, got 'x'"):
        read_moves("90 x", UNITS)


def test_in_radians_the_buttons_turn_by_a_part_of_pi_and_moves_have_a_few_figures():
    page = Filled("incremental_encoder")
    assert "+90°" in page.text
    page.do(Set(Notation, "angle", "rad"))
    assert "+π/2" in page.text
    assert "90°" not in page.text
    page.do(SetMoves((1.0 / 3.0, -1.0e-4 / 3.0)))
    assert page.value("moves") == "0.3333  −0.00003333"


@pytest.mark.parametrize(
    ("cell", "text", "words"),
    [
        ("pulses", "0", "periods in a turn, PPR: expected a whole number from 1 to 100000, got '0'"),
        ("pulses", "1e9", "periods in a turn, PPR: expected a whole number from 1 to 100000, got '1e9'"),
        ("pulses", "100000", "moves: 266666 edges of A and B come by, expected at most 20000"),
        ("speed", "0.1", "moves: they last 2400 s at this speed, expected at most 600 s"),
        ("speed", "-5", "ω (speed of the moves): expected a number in °/s from"),
        ("moves", "36001", "moves: expected angles of at most 100 turns"),
        ("moves", " ".join(["1"] * 101), "moves: expected at most 100, got 101"),
        ("moves", "1 two", "move 2: expected a number in degrees, got 'two'"),
        ("shakes", "51", "times to and fro in the end: expected a whole number from 0 to 50, got '51'"),
    ],
)
def test_bad_input_is_said_at_its_field_and_all_stays_as_it_was(cell, text, words):
    page = Filled("incremental_encoder")
    before = page.state
    page.fill(cell, text)
    assert words in page.text
    assert page.state is before


def test_saved_moves_that_are_none_are_refused():
    for moves in ([math.inf], ["x"], [[1.0]], 5, "12"):
        with pytest.raises(InputError):
            Incremental.from_json({"moves": moves}, catalogue()["planar_2r"])


def test_a_disk_that_is_back_at_zero_has_no_electrical_angle_and_not_a_whole_turn_of_one():
    state = opened(SetMoves(tuple(map(math.radians, (30.0, -10.0, -20.0)))))
    assert fact(state, "electrical") == 0.0
    assert electrical_angle(state[Incremental], -1e-9) == pytest.approx(TURN, rel=1e-6)
