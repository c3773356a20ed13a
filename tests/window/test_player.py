"""Playback by a clock of the test's own: on time, never queued, and the hand is right."""

import heapq
from types import SimpleNamespace

import pytest

from armlab.benches.robot.film.clip import ends_of
from armlab.content.robots import catalogue
from armlab.session.fields import Set
from armlab.session.pages import pages
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Advance, OpenClip, Play, Seek, Timeline
from armlab.session.session import Refuse, Session
from armlab.window.player import INTERVAL, PATIENCE, Player
from armlab.window.timeline_bar import SPEEDS, TimelineBar
from support.forms import BareFields
from support.student import run, student

PUMA = catalogue()["puma560"]
*STOPS, END = ends_of(PUMA.arm)


class Clock:
    """A loop whose time passes when the test says so."""

    def __init__(self):
        self.now, self._count, self._timers = 100.0, 0, []
        self.lag = 0.0  # seconds by which every timer is late

    def time(self):
        return self.now

    def call_later(self, delay, callback):
        timer = Timer()
        self._count += 1
        heapq.heappush(self._timers, (self.now + delay + self.lag, self._count, timer, callback))
        return timer

    def pass_by(self, seconds):
        until = self.now + seconds
        while self._timers and self._timers[0][0] <= until:
            self.now, _, timer, callback = heapq.heappop(self._timers)
            if not timer.cancelled:
                callback()
        self.now = until


class Timer:
    cancelled = False

    def cancel(self):
        self.cancelled = True


class Stage:
    """A session, its player, and a worker that answers when the test says so."""

    def __init__(self, *commands):
        self.session = Session.fresh("token", PUMA)
        self.clock, self.waiting, self.posted, self.prompt, self.watched = Clock(), [], [], True, True
        self.player = Player(self.session, self._post, lambda: self.watched, self.clock)
        self.do(OpenClip("film"), *commands)

    def _post(self, command):
        self.posted.append(command)
        self.waiting.append(command)
        if self.prompt:
            self.answer()

    def answer(self):
        commands, self.waiting = self.waiting, []
        self.do(*commands)

    def do(self, *commands):
        for command in commands:
            self.session.apply(command, 0.0)
        self.player.follow()

    @property
    def timeline(self):
        return self.session.state[Timeline]


@pytest.mark.parametrize("speed", SPEEDS)
def test_time_follows_the_clock_at_the_chosen_speed(speed):
    stage = Stage(Set(Timeline, "speed", speed), Play(True))
    stage.clock.pass_by(2.0)
    assert stage.timeline.time == pytest.approx(2.0 * speed, abs=2 * INTERVAL * speed)
    assert stage.timeline.playing


def test_it_ends_exactly_at_the_end_and_stops():
    stage = Stage(Play(True))
    stage.clock.pass_by(END + 1.0)
    assert stage.timeline == Timeline("film", END, False)
    count = len(stage.posted)
    stage.clock.pass_by(5.0)
    assert len(stage.posted) == count


def test_in_a_loop_it_begins_again_on_time():
    stage = Stage(Set(Timeline, "speed", 4.0), Set(Timeline, "loop", True), Play(True))
    stage.clock.pass_by((END + 4.0) / 4.0)
    assert stage.timeline.playing
    assert stage.timeline.time == pytest.approx(4.0, abs=0.4)


def test_never_more_than_one_picture_is_on_its_way():
    stage = Stage(Play(True))
    stage.prompt = False
    for _ in range(20):
        stage.clock.pass_by(0.3)
        assert len(stage.waiting) == 1
        stage.answer()
    # Slow answers cost pictures, not time.
    assert len(stage.posted) <= 21
    assert stage.timeline.time == pytest.approx(6.0, abs=0.4)


def test_pictures_are_sent_at_their_rate_and_delays_do_not_add_up():
    stage = Stage(Play(True))
    stage.clock.lag = 0.003
    stage.clock.pass_by(4.0)
    assert sum(isinstance(each, Advance) for each in stage.posted) == pytest.approx(4.0 / INTERVAL, abs=2)


def test_a_picture_that_had_to_wait_goes_as_soon_as_the_one_before_is_shown():
    stage = Stage(Play(True))
    stage.clock.pass_by(0.5)
    stage.prompt = False
    stage.clock.pass_by(2.5 * INTERVAL)
    assert len(stage.waiting) == 1
    stage.answer()
    (picture,) = stage.waiting
    assert picture.time == pytest.approx(0.5 + 2.5 * INTERVAL, abs=1e-9)


def test_it_is_never_sent_twice_for_one_that_had_to_wait():
    stage = Stage(Play(True))
    stage.prompt = False
    for _ in range(60):
        stage.clock.pass_by(1.5 * INTERVAL)
        assert len(stage.waiting) == 1
        stage.answer()
        stage.do(Set(Notation, "angle", "rad"))
    assert sum(isinstance(each, Advance) for each in stage.posted) <= 1.5 * 60 + 1


def test_a_hand_on_the_bar_is_followed_from_where_it_lets_go():
    stage = Stage(Play(True))
    stage.clock.pass_by(1.0)
    stage.prompt = False
    stage.clock.pass_by(0.1)
    assert isinstance(stage.waiting[0], Advance)
    # The seek is applied before the picture that was on its way.
    stage.waiting.insert(0, Seek(8.0))
    stage.prompt = True
    stage.answer()
    assert stage.timeline.time == 8.0
    stage.clock.pass_by(1.0)
    assert stage.timeline.time == pytest.approx(9.0, abs=0.05)


def test_another_speed_counts_from_the_present_time():
    stage = Stage(Play(True))
    stage.clock.pass_by(2.0)
    stage.do(Set(Timeline, "speed", 0.1))
    stage.clock.pass_by(2.0)
    assert stage.timeline.time == pytest.approx(2.2, abs=0.05)


def test_a_pause_holds_and_playing_goes_on_from_there():
    stage = Stage(Play(True))
    stage.clock.pass_by(2.0)
    stage.do(Play(False))
    held = stage.timeline.time
    stage.clock.pass_by(3.0)
    assert stage.timeline.time == held
    stage.do(Play(True))
    stage.clock.pass_by(1.0)
    assert stage.timeline.time == pytest.approx(held + 1.0, abs=0.05)


def test_other_commands_do_not_disturb_it():
    stage = Stage(Play(True))
    for k in range(60):
        stage.clock.pass_by(0.05)
        stage.do(Set(Notation, "angle", ("deg", "rad")[k % 2]))
    assert stage.timeline.time == pytest.approx(3.0, abs=0.05)


def test_pictures_that_never_come_end_in_a_pause():
    stage = Stage(Play(True))
    stage.prompt = False
    stage.clock.pass_by(PATIENCE + 0.5)
    assert stage.posted.count(Play(False)) == 1
    stage.waiting = [Play(False)]
    stage.answer()
    assert not stage.timeline.playing


def test_nobody_watching_nothing_is_played():
    stage = Stage(Play(True))
    stage.watched = False
    count = len(stage.posted)
    stage.clock.pass_by(3.0)
    assert len(stage.posted) == count


@pytest.mark.parametrize(("cell", "text"), [("seek", "x"), ("seek", "nan"), ("speed", "fast"), ("dance", ""), ("", "")])
def test_what_no_page_of_ours_sends_does_nothing_to_the_film(monkeypatch, cell, text):
    posted, made = [], []

    def fields(_gui, on_input):
        made.append(BareFields(on_input))
        return made[-1]

    monkeypatch.setattr("armlab.window.timeline_bar.Fields", fields)
    TimelineBar(SimpleNamespace(gui=None), posted.append).show(Stage().session.state, frozenset(pages()))
    made[0].send(cell, text)
    assert posted == ([] if cell in ("dance", "", "speed") else [Refuse(f"timeline: expected a number, got {text!r}")])
    assert not made[0].refused
    made[0].send("seek", "0.5")
    assert posted[-1] == Seek(0.5 * END)


def test_the_bar_of_a_page(url):
    """Open the film, play to the end, step, loop, another speed, close."""

    async def main():
        browser = await student(url)

        def shown(words):
            return lambda: words in browser.html()

        assert "al-time" not in browser.html()
        await browser.open("film")
        await browser.until(shown("DH film"))
        await browser.press("play")
        await browser.until(shown("Pause (space)"))
        await browser.press("speed", "4")
        await browser.until(shown('<option value="4" selected>'))
        await browser.press("seek", "0.97")
        await browser.until(shown("Play (space)"))
        await browser.until(shown(f"&#34;time&#34;: {END}, &#34;end&#34;: {END}, &#34;rate&#34;: 0.0"))
        await browser.press("back")
        await browser.until(shown(f"&#34;time&#34;: {STOPS[-1]},"))
        await browser.press("forward")
        await browser.until(shown(f"&#34;time&#34;: {END},"))
        await browser.press("loop")
        await browser.until(shown('aria-pressed="true">⟳'))
        await browser.press("speed", "100")  # is not offered
        await browser.press("close")
        await browser.until(lambda: "al-time" not in browser.html())
        assert not browser.notices
        await browser.close()

    run(main())


def test_the_film_goes_with_its_page_and_comes_back_where_it_was(url):
    async def main():
        browser = await student(url)
        await browser.open("film")
        await browser.until(lambda: "DH film" in browser.html())
        await browser.press("0,2")
        await browser.until(lambda: f"&#34;time&#34;: {STOPS[2]}," in browser.html())
        await browser.open("joints")
        await browser.until(lambda: "al-time" not in browser.html())
        await browser.open("film")
        await browser.until(lambda: f"&#34;time&#34;: {STOPS[2]}," in browser.html())
        await browser.press("close")
        await browser.until(lambda: "Show the film" in browser.html())
        await browser.press("show")
        await browser.until(lambda: "&#34;time&#34;: 0.0," in browser.html())
        await browser.close()

    run(main())
