"""Small things that make a page feel broken when they are wrong."""

import asyncio
import re
import threading

from armlab.session.session import Session
from armlab.ui.pace import Pace
from armlab.window import lab as lab_module
from support.fake_browser import FakeBrowser, cookie_of
from support.lab import running_lab
from support.patience import WAIT
from support.student import run, settled, student


def steps(browser):
    """Return what undo and redo would do, from their titles."""
    parts = browser.html().split('class="al-over al-steps"')[1].split("</div>")[0].split('title="')[1:]
    return [part.split('"')[0] for part in parts]


def pressed(browser, cell):
    """Return whether a choice is shown as the one that holds."""
    return re.search(rf'data-cell="{cell}"[^>]*aria-pressed="true"', browser.html()) is not None


async def sends_to(browser, cell, not_to=""):
    """Return where a button sends to, once that is another place than before: panels come, and are made anew."""
    there = f'data-cell="{cell}"'
    await browser.until(lambda: there in browser.html() and browser.channel(cell) != not_to)
    return browser.channel(cell)


def test_a_choice_undone_before_anything_was_shown_is_shown_undone(url, monkeypatch):
    monkeypatch.setattr(Pace, "interval", lambda self, usual, browser="": 0.5)

    async def main():
        browser = await student(url)
        await browser.open("target")
        method = browser.control("Method")
        first = method["value"]
        other = next(title for title in method["props"]["options"] if title != first)
        await browser.set_value(method, other)
        await browser.until(lambda: 'title="Undo:' in browser.html())
        await browser.set_value(method, first)
        await asyncio.sleep(0.15)
        await browser.press("undo")
        await browser.until(lambda: browser.control("Method")["value"] == other)
        await browser.close()

    run(main())


def test_what_was_pressed_while_the_page_was_made_anew_counts(url):
    async def main():
        browser = await student(url)
        await browser.open("picture")
        before = await sends_to(browser, "m")
        await browser.press("rad")
        await sends_to(browser, "m", before)
        await browser.press_on(before, "m")
        await browser.until(lambda: pressed(browser, "m") and pressed(browser, "rad"))
        await browser.close()

    run(main())


def test_what_was_pressed_for_another_arm_does_not_count(url):
    async def main():
        browser = await student(url)
        await browser.open("picture", "joints", "robot")
        before = await sends_to(browser, "zero")
        await browser.press("ur10e")
        await sends_to(browser, "zero", before)
        await browser.press_on(before, "zero")
        await settled(browser)  # "m" is made anew for this arm, too
        await browser.press("m")
        await browser.until(lambda: pressed(browser, "m"))
        assert browser.slider(1)["value"] != 0.0
        await browser.close()

    run(main())


def test_a_click_on_the_handle_is_no_step(url):
    async def main():
        browser = await student(url)
        await browser.press("zero")
        await browser.until(lambda: steps(browser)[0].startswith("Undo: move"))
        await browser.press("undo")
        await browser.until(lambda: steps(browser)[1].startswith("Redo: move"))
        await browser.drag("start")
        await browser.drag("end")
        await asyncio.sleep(0.5)
        assert steps(browser)[1].startswith("Redo: move")
        assert steps(browser)[0] == "Nothing to undo"
        await browser.close()

    run(main())


def test_a_notice_is_told_once(url):
    async def main():
        cookie = cookie_of(url + "robot/puma56")
        browser = await student(url, cookie)
        await browser.until(lambda: any("Did you mean /robot/puma560?" in text for text in browser.notices))
        await browser.close()
        again = await student(url, cookie)
        await asyncio.sleep(0.5)
        assert again.notices == []
        await again.close()

    run(main())


def test_a_page_closed_while_it_opens_leaves_nothing_behind(tmp_path, monkeypatch):
    """The worker is slow, the link asks for another arm, and the browser goes before the page is built."""
    built, begun, gone = [], threading.Event(), threading.Event()
    apply = Session.apply

    def slowly(self, command, *more):
        begun.set()
        gone.wait(WAIT)
        apply(self, command, *more)

    class Recorded(lab_module.View):
        def __init__(self, *arguments):
            built.append(self)
            super().__init__(*arguments)

    monkeypatch.setattr(Session, "apply", slowly)
    monkeypatch.setattr(lab_module, "View", Recorded)

    async def main(url):
        browser = FakeBrowser(url, cookie_of(url + "robot/scara"))
        await browser.connect()
        await asyncio.to_thread(begun.wait, WAIT)
        await browser.close()
        await asyncio.sleep(0.5)  # until the lab has noticed
        gone.set()
        await asyncio.sleep(0.5)

    with running_lab(tmp_path) as url:
        run(main(url))
    assert built == []


def test_a_page_opens_while_the_lessons_are_still_read_and_one_of_a_lesson_waits_for_them(monkeypatch):
    read, lessons = threading.Event(), lab_module.lessons
    monkeypatch.setattr(lab_module, "lessons", lambda: (read.wait(WAIT), lessons())[1])
    with running_lab() as url:

        async def main():
            await (await student(url)).close()
            opening = asyncio.create_task(student(url, path="/lesson/first_arm"))
            await asyncio.sleep(0.5)
            assert not opening.done()
            read.set()
            await (await opening).close()

        try:
            run(main())
        finally:
            read.set()
