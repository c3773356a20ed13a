"""Playing, pausing, scrubbing and stepping, as commands."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError, UnknownName
from armlab.session.edits import RemoveJoint
from armlab.session.fields import Set
from armlab.session.mailbox import Mailbox
from armlab.session.pages import pages, tabs
from armlab.session.parts.joints import MoveJoint
from armlab.session.parts.robot import ChooseRobot
from armlab.session.parts.timeline import Advance, OpenClip, Play, Seek, Step, Timeline, clips, duration
from armlab.session.session import Session, Undo
from armlab.session.state import State, apply

ROBOT = catalogue()["planar_2r"]
END = duration(apply(State.initial(catalogue()["planar_2r"]), OpenClip("film")))


def made(*commands, state=None):
    state = state or apply(State.initial(ROBOT), OpenClip("film"))
    for command in commands:
        state = apply(state, command)
    return state


def timeline(*commands):
    return made(*commands)[Timeline]


def test_a_clip_opens_at_its_start_and_paused():
    assert timeline() == Timeline("film", 0.0, False, 1.0, False)
    assert timeline(Seek(3.0), OpenClip("film")).time == 3.0
    assert timeline(Seek(3.0), Play(True), OpenClip("")) == Timeline()


def test_a_clip_that_is_not_there_is_refused():
    with pytest.raises(UnknownName, match="film"):
        timeline(OpenClip("flim"))


@pytest.mark.parametrize("command", [Play(True), Seek(1.0), Step(True), Step(False), Advance(0.0, 1.0)])
def test_nothing_happens_when_nothing_is_on(command):
    state = State.initial(ROBOT)
    assert apply(state, command) is state
    assert duration(state) == 0.0


def test_seeking_stays_inside_the_clip():
    assert [timeline(Seek(t)).time for t in (-1.0, 0.0, 4.25, END, 99.0)] == [0.0, 0.0, 4.25, END, END]
    with pytest.raises(InputError, match="expected seconds"):
        timeline(Seek(math.nan))


def test_a_seek_of_the_hand_does_not_pause():
    assert timeline(Play(True), Seek(2.0)).playing


def test_playing_at_the_end_begins_at_the_start():
    assert timeline(Seek(END), Play(True)) == Timeline("film", 0.0, True)
    assert timeline(Seek(5.0), Play(True)).time == 5.0


def test_playing_goes_on_picture_by_picture_and_ends_at_the_end():
    state = made(Play(True), Advance(0.0, 0.4), Advance(0.4, 0.9))
    assert state[Timeline] == Timeline("film", 0.9, True)
    assert made(Advance(0.9, END, ends=True), state=state)[Timeline] == Timeline("film", END, False)


def test_a_picture_that_comes_too_late_does_nothing():
    """The hand has moved or stopped the timeline since it was sent."""
    for hand in (Seek(7.0), Play(False), OpenClip("")):
        moved = made(Play(True), Advance(0.0, 0.4), hand)
        assert apply(moved, Advance(0.4, 0.5)) is moved
        assert apply(moved, Advance(0.4, END, ends=True)) is moved


def test_the_hand_is_not_overtaken_in_the_mailbox():
    mailbox, state = Mailbox(), made(Play(True))
    for command in (Seek(5.0), Advance(0.0, 0.1)):
        mailbox.post(command)
    taken = [letter.command for letter in iter(mailbox.take, None)]
    assert made(*taken, state=state)[Timeline].time == 5.0
    for time in (1.0, 2.0, 3.0):
        mailbox.post(Seek(time))
    assert [letter.command for letter in iter(mailbox.take, None)] == [Seek(3.0)]


def test_stepping_goes_from_stop_to_stop_and_pauses():
    stops = [0.0, *clips()["film"].stops(made()), END]
    assert len(stops) == 9
    state, seen = made(Play(True)), [0.0]
    for _ in range(9):
        state = apply(state, Step(True))
        seen.append(state[Timeline].time)
    assert seen == [*stops, END]
    assert not state[Timeline].playing
    back = []
    for _ in range(9):
        back.append(state[Timeline].time)
        state = apply(state, Step(False))
    assert back == stops[::-1]
    assert timeline(Seek(0.5 * (stops[2] + stops[3])), Step(False)).time == stops[2]
    assert timeline(Seek(stops[1] + 1e-9), Step(True)).time == stops[2]


def test_speed_and_loop():
    assert timeline(Set(Timeline, "speed", 0.1), Set(Timeline, "loop", True)) == Timeline("film", 0.0, False, 0.1, True)
    state = made(Set(Timeline, "speed", 2.0))
    assert apply(state, Set(Timeline, "speed", 2.0)) is state
    for speed in (0.0, 0.05, 4.5, math.nan, -1.0):
        with pytest.raises(InputError, match="speed: expected"):
            timeline(Set(Timeline, "speed", speed))


def test_none_of_it_is_a_step_of_undo():
    session = Session.fresh("token", ROBOT)
    session.apply(MoveJoint(0, 0.3), 0.0)
    for command in (OpenClip("film"), Seek(3.0), Set(Timeline, "speed", 2.0), Play(True), Advance(3.0, 3.5)):
        session.apply(command, 10.0)
    assert len(session.history.past) == 1
    session.apply(Undo(), 20.0)
    assert session.state[Timeline] == Timeline("film", 3.5, True, 2.0)


def test_another_arm_begins_at_the_start_and_an_edit_stays():
    state = made(Seek(6.5), Set(Timeline, "speed", 0.5), Play(True))
    assert made(ChooseRobot("panda"), state=state)[Timeline] == Timeline("film", 0.0, False, 0.5)
    # One joint is left, and four moves.
    edited = made(RemoveJoint(1), state=state)
    assert 0.0 < edited[Timeline].time == duration(edited) < 6.5
    assert not edited[Timeline].playing


def test_it_is_written_down_and_read_back_paused():
    state = made(Seek(4.5), Set(Timeline, "speed", 0.25), Set(Timeline, "loop", True), Play(True))
    assert Timeline.from_json(state[Timeline].to_json(), ROBOT) == Timeline("film", 4.5, False, 0.25, True)


@pytest.mark.parametrize(
    "damage", [{"time": math.nan}, {"time": -1.0}, {"time": "x"}, {"speed": 0.0}, {"speed": math.inf}, {"speed": None}]
)
def test_a_damaged_file_is_refused(damage):
    data = Timeline("film", 1.0).to_json() | damage
    with pytest.raises((InputError, ValueError, TypeError)):
        Timeline.from_json(data, ROBOT)


def test_a_clip_no_longer_there_is_none():
    assert Timeline.from_json({**Timeline("film", 1.0).to_json(), "clip": "gone"}, ROBOT).clip == ""


def test_random_presses_never_leave_the_clip():
    rng = np.random.default_rng(5)
    state = made()
    for _ in range(400):
        time = float(rng.uniform(-2.0, 14.0))
        kinds = [Play(bool(rng.integers(2))), Seek(time), Step(bool(rng.integers(2))), Set(Timeline, "loop", True)]
        kinds += [Advance(state[Timeline].time, max(time, 0.0)), OpenClip("film")]
        state = apply(state, kinds[rng.integers(len(kinds))])
        assert 0.0 <= state[Timeline].time <= END


def test_the_bar_of_a_film_is_seen_on_its_page_alone():
    assert timeline().seen({"film"})
    assert not timeline(Play(True), Seek(3.0)).seen({"joints", "table"})
    assert not Timeline().seen({"film", "motion"})


def test_the_bar_of_a_motion_is_seen_on_its_tab_and_elsewhere_once_it_moves_the_arm():
    for key, at_home in (("motion", "motion_plots"), ("sweep", "ellipsoid"), ("iterations", "iterations")):
        still = Timeline(key)
        assert still.seen({at_home})
        assert not still.seen({"joints"})
        assert Timeline(key, 0.5).seen({"joints"})
        assert Timeline(key, playing=True).seen({"joints"})


def test_a_motion_goes_with_its_arm_and_a_film_begins_again():
    robot = catalogue()["panda"]
    assert Timeline("motion", 2.0, True, 0.5).for_robot(robot) == Timeline("", 0.0, False, 0.5)
    assert Timeline("film", 2.0, True, 0.5).for_robot(robot) == Timeline("film", 0.0, False, 0.5)


def test_every_clip_that_moves_the_arm_says_where_it_belongs():
    for clip in clips().values():
        assert clip.panel in pages() if clip.panel else clip.tab in tabs()
