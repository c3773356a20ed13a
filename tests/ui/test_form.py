"""Controls that carry what they do: only what is on the page can be pressed; a refusal stands where it came from."""

import asyncio
import threading
from functools import partial

import pytest

from armlab.benches.control.loop.state import Loop
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.parts.joints import MoveJoint
from armlab.session.parts.notation import Notation
from armlab.session.session import LONGEST_NOTICE, Asked, Session, Undo
from armlab.ui.fields import SEEN
from armlab.ui.units import Units
from support.fake_browser import cookie_of
from support.filled import Filled
from support.forms import BareForm, asked
from support.lab import open_lab, running_lab
from support.patience import Patience
from support.student import run, student

MASS, GAIN = Set(Loop, "mass", 0.5), Set(Loop, "gain", 0.5)
BY_INDEX = (partial(Set, Loop, "mass"), partial(Set, Loop, "gain"), None, partial(Set, Loop, "end"))


def number(text):
    try:
        return Set(Loop, "mass", float(text))
    except ValueError:
        raise InputError(f"q: expected a number, got {text!r}") from None


def page(form):
    return (
        form.button("go", "Go", MASS)
        + form.button("both", "Both", (MASS, GAIN))
        + form.button("off", "Off", MASS, off=True)
        + form.field("q", "0", "q", number)
        + form.field("shut", "0", "shut", number, off=True)
        + form.chips("joint", {"0": "first", "1": "second"}, "0", "", lambda key: BY_INDEX[int(key)](0.5))
        + form.select("one", "One", {"": "Choose", "1": "second"}, "", lambda key: BY_INDEX[int(key)](0.5))
        + form.select_in_groups(
            "of", "Of", {"": {"0": "a"}, "more": {"1": "b"}}, "0", lambda key: BY_INDEX[int(key)](1)
        )
        + f"<div {form.place('at', lambda x, y, drag: (BY_INDEX[drag](x), BY_INDEX[drag](y)))}></div>"
    )


@pytest.mark.parametrize(
    ("cell", "text", "commands"),
    [
        ("go", "", (MASS,)),
        ("both", "", (MASS, GAIN)),
        ("q", "0.5", (MASS,)),
        ("joint 1", "", (GAIN,)),
        ("one", "1", (GAIN,)),
        ("of", "1", (Set(Loop, "gain", 1),)),
        ("at", "0.25,0.5", (Set(Loop, "mass", 0.25), Set(Loop, "mass", 0.5))),
        ("at", "0.25,0.5,3", (Set(Loop, "end", 0.25), Set(Loop, "end", 0.5))),
    ],
)
def test_a_control_asks_for_what_it_carries(cell, text, commands):
    assert asked(page, cell, text) == commands


@pytest.mark.parametrize(
    ("cell", "text"),
    [("nothing", ""), ("off", ""), ("shut", "1"), ("one", ""), ("one", "2"), ("of", "b"), ("joint 2", "")],
)
def test_what_is_not_offered_does_nothing(cell, text):
    assert asked(page, cell, text) == ()


@pytest.mark.parametrize("text", ["", "1", "1,2,3,4", "a,b", "nan,0", "1e999,0", "0,0,1e999"])
def test_what_is_no_place_is_refused(text):
    with pytest.raises(InputError, match="expected a place"):
        asked(page, "at", text)


def test_what_is_no_longer_shown_cannot_be_pressed():
    form = BareForm()
    form.show(page(form))
    form.show(form.button("go", "Go", GAIN))
    form.press("both")
    form.press("go")
    assert form.commands == (GAIN,)


def test_a_text_that_is_refused_stays_and_its_page_is_shown_again():
    form, again = BareForm(), []
    form._again = lambda: again.append(1)
    form.show(page(form))
    with pytest.raises(InputError, match="expected a number, got 'x'"):
        form.press("q", "x")
    assert again == [1]
    assert form.posted == []


def test_a_remark_on_what_was_typed_is_shown_and_nothing_is_refused():
    form, units = BareForm(), Units(Notation(angle="rad"))
    form.show(form.field("q", "0", "q", lambda text: MoveJoint(0, units.read(text, True, "q"))))
    form.press("q", "90")
    assert form.commands == (MoveJoint(0, 90.0),)
    assert form.fields.remarks == ["Read as 90 rad. For degrees type 90° or 90 deg."]
    form.press("q", "90°")
    assert len(form.fields.remarks) == 1


@pytest.mark.parametrize(
    ("key", "cell"), [("table", "dh-1-alpha"), ("joints", "value 1"), ("absolute_encoder", "angle")]
)
def test_a_remark_stands_below_the_field_until_the_next_input(key, cell):
    page = Filled(key)
    page.do(Set(Notation, "angle", "rad"))
    page.fill(cell, "20")
    assert "Read as 20 rad. For degrees type 20° or 20 deg." in page.text
    assert ("expected a number in rad" in page.text) == (key == "table")  # an angle of the table is in one turn
    page.do(MoveJoint(1, 0.1))
    assert "For degrees" in page.text
    page.fill(cell, "20°")
    assert "For degrees" not in page.text


def test_what_changes_only_the_page_has_it_shown_again():
    form, again = BareForm(), []
    form._again = lambda: again.append(1)
    form.show(form.button("fold", "Fold", lambda: None))
    form.press("fold")
    assert (again, form.posted) == ([1], [])


def test_a_drag_goes_by_itself_so_that_a_newer_one_may_replace_it():
    drag = MoveJoint(0, 0.5)
    form = BareForm()
    form.show(f"<i {form.place('at', lambda x, y, number: drag, drag=True)}></i>" + form.button("go", "", drag))
    form.press("at", "0,0,1")
    form.press("go")
    assert form.posted[0] is drag
    assert form.posted[1].commands == (drag,)


def test_what_is_made_of_the_same_need_not_be_made_again_until_something_is_typed_or_pressed():
    form = BareForm()
    asked = [form.shows("a", 1), form.shows("a", 1), form.shows("a", 2), form.shows("a", 2)]
    form.fields.stale = True
    asked.append(form.shows("a", 2))
    form.fields.stale = False
    asked.append(form.shows("a", 2))
    assert asked == [False, True, False, True, False, True]
    assert [BareForm().shows(), form.shows(), form.shows()] == [False, False, True]


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    with running_lab(tmp_path_factory.mktemp("state"), "planar_2r") as address:
        yield address


def test_what_the_worker_refuses_is_told_at_the_field_it_came_from_and_at_no_other_page(url):
    async def main():
        cookie = cookie_of(url)
        here, there = await student(url, cookie), await student(url, cookie)
        await here.open("loop")
        await there.open("loop")
        await here.press("l-end", "500")
        await here.until(lambda: "at most 40 can be shown" in here.html())
        assert 'value="500"' in here.html()
        assert "at most 40 can be shown" not in there.html()
        assert not here.notices
        await here.press("l-end", "5")
        await here.until(lambda: "at most 40 can be shown" not in here.html())
        await there.until(lambda: "5 s</i>" in there.html())

    run(main())


def test_of_commands_asked_for_together_none_is_done_when_one_is_refused():
    session, told = Session.fresh("s", catalogue()["planar_2r"]), []
    before = session.state
    session.apply(Asked((MASS, Set(Loop, "mass", -1.0)), lambda why: told.append(why) is None), 0.0)
    assert session.state is before
    assert session.history.undo_label is None
    assert len(told) == 1
    assert session.notice is None
    session.apply(Asked((MASS, GAIN), lambda why: told.append(why) is None), 1.0)
    assert (session.state[Loop].mass, session.state[Loop].gain) == (0.5, 0.5)
    session.apply(Undo(), 2.0)
    assert (session.state[Loop].mass, session.state[Loop].gain) == (0.5, 10.0)
    assert len(told) == 1


def test_a_refusal_that_has_no_place_any_more_is_a_notice_and_a_long_one_is_cut():
    session, told = Session.fresh("s", catalogue()["planar_2r"]), []
    session.apply(Asked((Set(Loop, "mass", -1.0),), lambda why: bool(told.append(why))), 0.0)
    assert session.notice.text == told[0]
    session.apply(Asked((Set(Loop, "kind", "x" * 10**6),), lambda why: told.append(why) is None), 0.0)
    assert len(told[-1]) <= LONGEST_NOTICE


def test_what_was_refused_while_something_else_was_pressed_is_a_notice(tmp_path, monkeypatch):
    apply, waiting = Session.apply, threading.Event()

    def later(self, command, *more):
        waiting.wait(60.0)
        apply(self, command, *more)

    async def main(url, counts):
        browser = await student(url)
        await browser.open("loop")
        await browser.until(lambda: 'data-cell="l-end"' in browser.html())
        monkeypatch.setattr(Session, "apply", later)
        before, patience = counts.posted, Patience()
        await browser.press("l-end", "500")
        await browser.press("kind step")
        while counts.posted < before + 2 and patience.left():
            await asyncio.sleep(0.01)
        waiting.set()
        await browser.until(lambda: any("at most 40 can be shown" in one for one in browser.notices))
        await browser.until(lambda: "The error dies out" in browser.html())
        await browser.close()

    lab = open_lab(tmp_path, "planar_2r")
    try:
        run(main(f"http://127.0.0.1:{lab.port}/", lab.lab.worker.counts))
    finally:
        waiting.set()
        lab.stop()


def test_what_was_refused_goes_when_the_field_is_to_show_something_else(url):
    async def main():
        browser = await student(url)
        await browser.open("loop")
        await browser.press("l-gain", "-5")
        await browser.until(lambda: "✕ K (gain of the controller): expected" in browser.html())
        await browser.press("example", "larger_gain")
        await browser.until(lambda: 'value="100"' in browser.html())
        assert "✕ K (gain of the controller): expected" not in browser.html()
        await browser.press("l-gain", "-6")
        await browser.until(lambda: "✕ K (gain of the controller): expected" in browser.html())
        await browser.press("l-mass", "3")  # as a person does who has typed and goes on: it was not seen yet
        await browser.until(lambda: 'value="3"' in browser.html())
        assert "✕ K (gain of the controller): expected" in browser.html()
        assert 'value="-6"' in browser.html()
        await asyncio.sleep(SEEN)
        await browser.press("l-mass", "4")
        await browser.until(lambda: "✕ K (gain of the controller): expected" not in browser.html())
        assert 'value="100"' in browser.html()
        await browser.close()

    run(main())


def test_what_was_refused_goes_after_an_input_in_another_form_of_the_page_and_with_its_field(url):
    async def main():
        browser = await student(url)
        await browser.open("laws")
        await browser.press("t-duration", "abc")
        await browser.until(lambda: 'value="abc"' in browser.html())
        await asyncio.sleep(SEEN)
        await browser.press("example", "same_time")  # in which T is what it was
        await browser.until(lambda: 'value="abc"' not in browser.html())
        assert 'class="no" role="alert"' not in browser.html()
        await browser.press("t-duration", "xyz")
        await browser.until(lambda: 'value="xyz"' in browser.html())
        await browser.press("example", "triangle")  # at once; it has no field for T
        await browser.until(lambda: 'data-cell="t-duration"' not in browser.html())
        assert 'class="no" role="alert"' not in browser.html()
        await browser.close()

    run(main())
