"""The page of the absolute encoder: turning the disk, examples that show what they say, and what is refused."""

import math
import re

import numpy as np
import pytest

from armlab.benches.sensor.absolute.clip import CLIP
from armlab.benches.sensor.absolute.examples import EXAMPLES, ChooseAbsoluteExample
from armlab.benches.sensor.absolute.facts import FACTS
from armlab.benches.sensor.absolute.state import CLIP_KEY, Absolute
from armlab.benches.sensor.absolute.turning import DURATION, DragTo, StepSectors, TurnTo
from armlab.benches.sensor.absolute.ui.scene import heads, label
from armlab.benches.sensor.absolute.ui.strip import strip
from armlab.benches.sensor.absolute.ui.wheel import absolute_arcs, plates
from armlab.benches.sensor.absolute.ui.words import neighbours_markup, readings_markup, verdict
from armlab.benches.sensor.stage import around, stage_of
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.sensors.absolute import TURN
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Advance, OpenClip, Play, Seek, Timeline
from armlab.session.state import State, apply
from armlab.ui.units import Units
from support.done import done
from support.filled import Filled

UNITS = Units(Notation())


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def fact(state, name):
    return FACTS.facts[name].now(state).value


def example(key):
    return opened(ChooseAbsoluteExample(key))


def test_a_page_opens_with_an_example_that_is_in_place_until_something_is_changed():
    state = opened()
    assert state[Absolute] == EXAMPLES["four"].part
    assert apply(state, TurnTo(1.0))[Absolute].example == "four"
    assert apply(state, Set(Absolute, "offset", 0.2))[Absolute].example == ""


def test_the_examples_read_as_their_sentences_say():
    assert (fact(example("binary"), "sector"), fact(example("binary"), "next_bits")) == (7, 4)
    glitch = example("glitch")
    assert [fact(glitch, name) for name in ("word", "sector", "read")] == ["1111", 7, 15]
    assert fact(glitch, "worst") == 8
    safe = example("safe")
    assert [fact(safe, name) for name in ("sector", "read", "error", "worst")] == [7, 8, 1, 1]
    joint = example("joint")
    assert math.degrees(fact(joint, "resolution")) == pytest.approx(0.088, abs=2e-4)
    assert fact(joint, "binary_error") == -2048
    assert 100 * fact(apply(joint, Set(Absolute, "code", "binary")), "wrong") == pytest.approx(0.015, abs=5e-4)
    assert [fact(example("far"), name) for name in ("gray_error", "worst")] == [3, 3]


def test_the_film_turns_the_disk_once_and_a_hand_stops_it_where_it_is():
    state = opened(OpenClip(CLIP_KEY), Seek(DURATION / 4))
    assert fact(state, "angle") == pytest.approx(TURN / 4)
    assert apply(state, Seek(DURATION))[Absolute].angle == pytest.approx(TURN)
    playing = apply(opened(OpenClip(CLIP_KEY)), Play(True))
    turned = apply(playing, TurnTo(-0.25 * TURN))
    assert turned[Absolute].angle == pytest.approx(0.75 * TURN)
    assert turned[Timeline].time == pytest.approx(0.75 * DURATION)
    assert not turned[Timeline].playing
    assert apply(turned, Advance(0.0, 1.0))[Absolute].angle == pytest.approx(0.75 * TURN)  # a picture on its way
    assert len(CLIP.stops(state)) == 15
    assert len(CLIP.stops(apply(state, Set(Absolute, "tracks", 12)))) == 63


def test_a_drag_is_one_step_of_undo_and_follows_the_hand():
    page = Filled("absolute_encoder")
    before = page.state[Absolute].angle
    page.drag("disk", 0.6, 0.5, 0.4)
    # To the left by a fifth of the picture, of which the turn of 16 sectors takes 284 of 330 pixels.
    assert page.state[Absolute].angle - before == pytest.approx(0.2 * 330 / 284 * TURN)
    page.drag("disk", 0.4, 0.5)
    assert page.state[Absolute].angle - before == pytest.approx(0.1 * 330 / 284 * TURN)
    page.undo()
    page.undo()
    assert page.state[Absolute].angle == before


def test_steps_go_to_the_middles_of_sectors():
    state = opened(TurnTo(15.9 * TURN / 16), StepSectors(1))
    assert fact(state, "sector") == 0
    assert state[Absolute].angle == pytest.approx(0.5 * TURN / 16)
    assert fact(apply(state, StepSectors(-2)), "sector") == 14


def test_fewer_tracks_keep_a_sensor_that_is_out_of_line():
    state = opened(Set(Absolute, "tracks", 8), Set(Absolute, "track", 7), Set(Absolute, "tracks", 3))
    assert state[Absolute].off_track == 3
    assert apply(state, Set(Absolute, "tracks", 8))[Absolute].off_track == 7


@pytest.mark.parametrize("tracks", [1, 2, 5, 12])
@pytest.mark.parametrize("code", ["gray", "binary"])
def test_the_disk_lets_light_through_where_its_word_has_a_one(tracks, code):
    """At any angle, the dark pieces over the line of sensors are those of the bits that are zero."""
    part = opened(Set(Absolute, "tracks", tracks), Set(Absolute, "code", code))[Absolute]
    arcs = absolute_arcs(code, tracks)
    radii = np.unique(arcs[:, 2])[::1]
    for angle in (0.3, 2.0, 3.5, 6.1):
        word = int(part.disk.word(angle))
        over = arcs[(arcs[:, 0] <= angle) & (angle < arcs[:, 1]), 2]
        dark = {int(np.argmin(abs(radii - low))) for low in over}
        assert dark == {k for k in range(tracks) if not word >> (tracks - 1 - k) & 1}
        lit = re.findall(r'class="ab-bit[^"]*"[^>]*>([01])<', strip(part.with_values({"angle": angle})))
        assert "".join(lit) == f"{word:0{tracks}b}"
        assert [head.lit for head in heads(part.with_values({"angle": angle}))] == [bit == "1" for bit in lit]


def test_a_plate_lies_under_the_sensors_when_its_angle_has_come_there():
    """The disk turns counterclockwise; what lies at a later angle comes under the sensors, which are at y, later."""
    plate = plates(np.array([[0.5, 0.6, 0.4, 0.5]]))
    middle = plate.vertices[:, :2].mean(axis=0)
    turned = math.atan2(middle[1], middle[0]) + 0.55
    assert turned == pytest.approx(0.25 * TURN, abs=1e-3)
    # Both sides face outwards.
    first = plate.vertices[plate.faces[:, 0]]
    across = np.cross(plate.vertices[plate.faces[:, 1]] - first, plate.vertices[plate.faces[:, 2]] - first)
    np.testing.assert_array_equal(np.sign(across[:, 2]), np.sign(first[:, 2]))


@pytest.mark.parametrize("robot", ["planar_2r", "puma560", "scara"])
def test_the_encoder_stands_over_the_base_and_faces_the_home_view(robot):
    state = State.initial(catalogue()[robot])
    pose, radius = stage_of(state)
    np.testing.assert_allclose(pose[:3, :3].T @ pose[:3, :3], np.eye(3), rtol=0, atol=1e-12)
    azimuth = math.radians(catalogue()[robot].camera.azimuth_deg)
    assert pose[:3, 2] @ [math.cos(azimuth), math.sin(azimuth), 0.0] > 0.3
    low, high = around(state).min(axis=0), around(state).max(axis=0)
    assert ((low < pose[:3, 3]) & (pose[:3, 3] < high)).all()
    assert radius > 0.0


def test_what_is_said_of_the_readings():
    part = example("glitch")[Absolute]
    assert "off by up to 8 sectors" in verdict(part, UNITS)
    assert "180°" in verdict(part, UNITS)
    table = readings_markup(part, UNITS)
    assert re.findall(r"[01]{4}", table) == ["1100", "1111"]
    assert "±8" in table
    assert "+1" in table
    assert "off by 1 sector at most" in verdict(example("safe")[Absolute], UNITS)
    for offset, sense in ((0.3, "22.5° too far."), (-0.3, "22.5° too little.")):
        assert sense in verdict(opened(Set(Absolute, "offset", offset))[Absolute], UNITS)
    # In plain binary the last bit alone, seen too early, makes 1 of 0 and 0 of 1.
    last = opened(Set(Absolute, "code", "binary"), Set(Absolute, "track", 4), Set(Absolute, "offset", 0.3))[Absolute]
    assert "22.5° too far or too little." in verdict(last, UNITS)
    straight = opened(Set(Absolute, "code", "binary"))[Absolute]
    assert "up to 4 bits change at once" in verdict(straight, UNITS)
    assert label(part) == "1111 = sector 15"
    rows = re.findall(
        r"<td>(\d+)</td><td>([01]+)</td><td>(\d)</td><td>([01]+)</td><td>(\d)</td>", neighbours_markup(part)
    )
    assert rows[2] == ("7", "0111", "4", "0100", "1")


@pytest.mark.parametrize(
    ("cell", "text", "words"),
    [
        ("tracks", "30", "number of tracks: expected a whole number from 1 to 12, got '30'"),
        ("tracks", "0", "number of tracks: expected a whole number from 1 to 12, got '0'"),
        ("tracks", "4.5", "number of tracks: expected a whole number from 1 to 12, got '4.5'"),
        ("offset", "3", "how far this sensor is ahead, in sectors: expected a number from −2 to 2, got '3'"),
        ("angle", "x", "θ: expected a number in degrees, got 'x'"),
    ],
)
def test_bad_input_is_said_at_its_field_and_all_stays_as_it_was(cell, text, words):
    page = Filled("absolute_encoder")
    before = page.state
    page.fill(cell, text)
    assert words in page.text
    assert page.state is before


def test_an_angle_that_is_none_is_refused():
    with pytest.raises(InputError, match="angle of the disk: expected a finite number, got inf"):
        opened(DragTo(math.inf, 1))
