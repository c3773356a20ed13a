"""What plays a film on its page: from its start, or on from where it was paused; and the field of its time."""

import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.state import State
from armlab.ui.playing import clock, play_button
from support.done import done
from support.forms import BareForm, asked

START = State.initial(catalogue()["planar_2r"])
END = 6.0


def press(state, cell, text=""):
    return asked(lambda form: clock(form, state, "loop", END), cell, text)


def test_a_film_that_is_not_on_is_put_on_and_played():
    assert press(START, "play-loop") == (OpenClip("loop", play=True),)
    assert press(done(START, OpenClip("sweep")), "play-loop") == (OpenClip("loop", play=True),)


def test_a_film_that_plays_is_paused_and_goes_on_where_it_stood():
    playing = done(START, OpenClip("loop", play=True), Seek(2.0))
    assert press(playing, "play-loop") == ()
    paused = done(playing, *press(playing, "pause-loop"))
    assert (paused[Timeline].playing, paused[Timeline].time) == (False, 2.0)
    on = done(paused, *press(paused, "play-loop"))
    assert (on[Timeline].playing, on[Timeline].time) == (True, 2.0)


def test_at_its_end_it_begins_again():
    ended = done(START, OpenClip("loop"), Seek(END))
    assert done(ended, *press(ended, "play-loop"))[Timeline].time == 0.0


def test_what_cannot_be_played_cannot_be_pressed():
    assert asked(lambda form: play_button(form, START, "loop", "it", off=True), "play-it") == ()
    assert "▶ Go" in play_button(BareForm(), START, "loop", "it", "Go")


def test_a_time_that_is_typed_is_gone_to_and_nonsense_is_said():
    assert press(START, "time", "1.5") == (OpenClip("loop"), Seek(1.5))
    assert press(done(START, OpenClip("loop")), "time", "3/2") == (Seek(1.5),)
    for text, says in (
        ("9", "t: expected 0 to 6 s, got 9"),
        ("-1", "t: expected 0 to 6 s"),
        ("x", "t: expected seconds, got 'x'"),
    ):
        with pytest.raises(InputError, match=says):
            press(START, "time", text)


def test_the_end_is_gone_to_as_the_page_writes_it():
    end = 0.8 * 5.0**0.5
    page = lambda form: clock(form, START, "loop", end)  # noqa: E731
    assert "of 1.789 s" in page(BareForm())
    assert asked(page, "time", "1.789") == (OpenClip("loop"), Seek(end))


def test_the_space_bar_presses_what_the_page_plays_and_its_hint_says_so():
    for state in (START, done(START, OpenClip("loop", play=True))):
        button = str(play_button(BareForm(), state, "loop", "it", hint="Round and round"))
        assert 'data-key="Space"' in button
        assert 'title="Round and round. Space plays and pauses"' in button
