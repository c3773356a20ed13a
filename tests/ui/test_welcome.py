"""The card of the first visit and the tour name things that exist, by their names, and come over the wire as asked."""

from armlab.content.lessons import lessons
from armlab.session.pages import pages
from armlab.session.parts import welcome as part
from armlab.ui.welcome import LESSONS, STOPS, tour_from
from support.student import run, student


def test_the_lessons_of_the_card_have_the_titles_of_their_files():
    there = lessons().lessons
    assert {key: title for key, (title, _) in LESSONS.items()} == {key: there[key].title for key in LESSONS}


def test_the_tour_has_as_many_stops_as_can_be_gone_to_and_opens_pages_that_exist():
    assert len(STOPS) == part.STOPS
    assert {name for stop in STOPS for name in (stop.opens, stop.tab) if name} <= pages().keys()
    assert [commands[-1].stop for commands in map(tour_from, range(len(STOPS)))] == list(range(len(STOPS)))


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
