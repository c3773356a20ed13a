"""The card of the first visit and the tour name things that exist, by their names, and come over the wire as asked."""

from dataclasses import replace
from functools import cache

from armlab.content import lessons as library_module
from armlab.content.lessons import lessons
from armlab.content.robots import catalogue
from armlab.session.pages import pages
from armlab.session.panel_commands import OpenPanel
from armlab.session.state import State
from armlab.teaching.lesson_commands import OpenLesson
from armlab.teaching.lesson_progress import Progress
from armlab.teaching.parts import welcome as part
from armlab.teaching.parts.lesson import LessonPart
from armlab.ui.welcome import OFFERED, STOPS, offered, tour_from, welcome_markup
from support.fake_browser import cookie_of
from support.forms import BareForm
from support.student import run, student


def welcomed(*done):
    """Return the state of somebody who sees the card and has done these lessons."""
    all_met = {key: Progress(met=frozenset(step.title for step in lessons()[key].steps)) for key in done}
    answered = {key: replace(each, right=dict.fromkeys(each.met)) for key, each in all_met.items()}
    state = State.initial(catalogue()["puma560"])
    return state.replace(part.Welcome(part.CARD), replace(state[LessonPart], progress_of=answered))


def test_the_card_offers_the_first_lessons_of_the_course_also_while_none_has_been_read(monkeypatch):
    first = lessons().course().lessons[:OFFERED]
    found = offered(welcomed())
    assert tuple(lesson.key for lesson in found) == first
    form = BareForm()
    form.show(welcome_markup(form, part.Welcome(part.CARD), found))
    assert "<b>Your first arm</b><i>12 min</i>" in form.fields.content
    form.press(f"start-{first[0]}")
    form.press("start-course")
    assert form.commands == (OpenLesson(first[0]), OpenPanel("lessons"))
    monkeypatch.setattr(library_module, "_library", cache(lambda: 1 / 0))  # nobody has needed any yet
    heads = offered(welcomed())
    assert [(head.title, head.minutes, head.can) for head in heads] == [
        (lesson.title, lesson.minutes, lesson.can) for lesson in found
    ]


def test_who_asks_for_the_card_again_gets_the_lessons_that_come_next():
    order = lessons().course().lessons
    assert tuple(lesson.key for lesson in offered(welcomed(*order[:2]))) == order[2 : 2 + OFFERED]
    assert offered(welcomed(*order)) == ()
    assert offered(State.initial(catalogue()["puma560"])) == ()
    form = BareForm()
    assert "Show me around" in welcome_markup(form, part.Welcome(part.CARD), ())


def test_the_tour_has_as_many_stops_as_can_be_gone_to_and_opens_pages_that_exist():
    assert len(STOPS) == part.STOPS
    assert {name for stop in STOPS for name in (stop.opens, stop.tab) if name} <= pages().keys()
    assert [commands[-1].stop for commands in map(tour_from, range(len(STOPS)))] == list(range(len(STOPS)))


def greeted(browser):
    """Return whether a page shows card or tour."""
    return "al-card" in browser.html() or "al-tour" in browser.html()


def test_a_stop_about_a_page_opens_it_first(url):
    async def main():
        browser = await student(url)
        await browser.open("help")
        await browser.press("help-tour")
        await browser.until(lambda: 'data-at="handle"' in browser.html())
        assert "al-card" not in browser.html()
        await browser.press("tour-on")
        await browser.until(lambda: 'data-at="sliders"' in browser.html())
        tab = pages()["joints"].title
        await browser.until(lambda: f"&#34;tab&#34;: &#34;{tab}&#34;" in browser.html())
        await browser.press("welcome-leave")
        await browser.until(lambda: "al-tour" not in browser.html())
        await browser.close()

    run(main())


def test_card_and_tour_can_be_left_at_every_stop_and_pages_opened_later_show_neither(url):
    async def main():
        cookie = cookie_of(url)
        browser = await student(url, cookie)
        assert greeted(browser)
        for way in (STOPS[:count] for count in range(len(STOPS) + 1)):
            for stop in way:
                await browser.press("start-tour" if stop is STOPS[0] else "tour-on")
                await browser.until(lambda stop=stop: f'data-at="{stop.at}"' in browser.html())
            await browser.press("welcome-leave")
            await browser.until(lambda: not greeted(browser))
            later = await student(url, cookie)
            assert not greeted(later)
            await later.close()
            await browser.open("help")
            await browser.press("help-start")
            await browser.until(lambda: "al-card" in browser.html())
        await browser.close()

    run(main())


def test_the_card_is_gone_once_somebody_works_and_from_pages_opened_later(url):
    async def main():
        cookie = cookie_of(url)
        browser = await student(url, cookie)
        assert greeted(browser)
        await browser.set_value(browser.slider(1), 40.0)
        await browser.until(lambda: not greeted(browser))
        later = await student(url, cookie)
        assert not greeted(later)
        await later.close()
        await browser.close()

    run(main())
