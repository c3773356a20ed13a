"""The card of the first visit and the tour name things that exist, by their names, and come over the wire as asked."""

from armlab.content.lessons import lessons
from armlab.session.pages import pages
from armlab.session.parts import welcome as part
from armlab.ui.welcome import LESSONS, STOPS, tour_from
from support.fake_browser import cookie_of
from support.student import run, student


def test_the_lessons_of_the_card_have_the_titles_of_their_files():
    there = lessons().lessons
    assert {key: title for key, (title, _) in LESSONS.items()} == {key: there[key].title for key in LESSONS}


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
