"""The one search: what comes first, what a lesson hides, what a pick does, and what a stranger cannot do with it."""

import json
import re
import tomllib
from html import unescape
from pathlib import Path
from types import SimpleNamespace

import pytest

from armlab.content.languages import ENGLISH, words_in
from armlab.content.lessons import lessons
from armlab.content.robots import catalogue
from armlab.page import Export
from armlab.session.pages import pages, tabs
from armlab.session.state import State
from armlab.teaching.parts.lesson import LessonPart
from armlab.ui.commands import shortcuts
from armlab.ui.plugin import layers, switches
from armlab.window.search import finds
from armlab.window.search.dialog import SHOWN
from armlab.window.search.finds import find
from armlab.window.search.markup import EXAMPLES
from armlab.window.search.offers import hidden, offers
from support.lab import running_lab
from support.own_lessons import ARM, in_lesson, lesson, notes, piece, to_step, write
from support.sources import PACKAGE
from support.student import run, settled, student

TESTS = Path(__file__).resolve().parents[1]
SEARCHES, IN_ITALIAN = map(
    tomllib.loads((TESTS / "data/searches.toml").read_text(encoding="utf-8")).get, ("searches", "in_italian")
)

HIDING = 'robot = "planar_2r"\nhidden = ["joints", "ellipsoid", "motion_files", "robot"]\n'

PREDICTING = """
## One

Text.

## Predict

```question
kind = "number"
text = "How large is $p_x$ for $q = 0$?"
answer = 2
unit = "m"
tolerance = 0.01
hide = ["arm", "values"]
```
"""


@pytest.fixture(scope="module")
def start():
    lessons()
    return State.initial(catalogue()["puma560"])


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    folder = write(
        tmp_path_factory.mktemp("lessons"),
        hiding=lesson(front=HIDING),
        predicting=lesson(PREDICTING, ARM),
    )
    with running_lab(lessons=folder) as address:
        yield address


def places(query, state, language=ENGLISH):
    return [f"{entry.kind}:{entry.key}" for entry in find(query, state, language)]


# -- what comes first --------------------------------------------------------------------------------------------


def test_there_are_a_hundred_searches_and_none_comes_twice():
    queries = [query for query, *_ in SEARCHES]
    assert len(queries) >= 100
    assert len(set(queries)) == len(queries)


@pytest.mark.parametrize(("query", "first"), [each[:2] for each in SEARCHES], ids=[each[0] for each in SEARCHES])
def test_the_right_thing_comes_first(query, first, start):
    assert next(iter(places(query, start)), "") == first


def test_the_right_thing_comes_first_in_another_language_and_not_for_who_reads_english(start):
    assert {query: next(iter(places(query, start, "it")), "") for query, *_ in IN_ITALIAN} == {
        query: first for query, first, *_ in IN_ITALIAN
    }
    assert places("annulla", start) == places("scuro", start) == []
    words = words_in("it")
    for key, page in pages().items():
        thing = offers()["bench", key].thing
        assert f"bench:{key}" in places(f"{words(thing.within)} {words(thing.title)}", start, "it")[:3], page.title
    for query in EXAMPLES:
        assert places(words(query), start, "it"), query


def test_every_page_arm_command_setting_file_and_lesson_is_found_by_its_own_title(start):
    for (kind, key), offer in offers().items():
        title = f"{offer.thing.within} {offer.thing.title}"
        assert f"{kind}:{key}" in places(title, start)[:SHOWN], title
    for found in lessons().listed:
        assert f"lesson:{found.key}" in places(found.title, start)[:3], found.title


def test_every_page_is_first_for_the_names_of_its_tab_and_its_own(start):
    for of_tab in tabs().values():
        for page in of_tab:
            name = page.page or page.title
            assert places(f"{of_tab[0].title} {name}", start)[0] == f"bench:{page.key}"


def test_nothing_is_offered_that_is_not_there_and_all_that_is_there_is_offered():
    found = offers()
    of_kind = {kind: {key for each, key in found if each == kind} for kind, _ in found}
    assert of_kind["bench"] == set(pages())
    assert of_kind["arm"] == set(catalogue().robots)
    assert of_kind["command"] == {shortcut.name for shortcut in shortcuts() if shortcut.name}
    assert of_kind["setting"] >= {switch.name for switch in switches()}
    assert len(of_kind["export"]) == sum(len(page.exports) for page in pages().values())


def test_what_the_dialog_proposes_is_found(start):
    for query in EXAMPLES:
        assert places(query, start)


def test_lessons_are_not_read_for_a_search(start, monkeypatch):
    monkeypatch.setattr(finds, "lessons_read", lambda: None)
    assert places("where is the hand", start)
    assert not [place for place in places("jacobian", start) if place.startswith("lesson:")]


# -- what a lesson hides -----------------------------------------------------------------------------------------


class InLesson:
    """A state in a lesson that hides pages, or asks for a prediction.

    Of the part of the lesson the search asks these two alone.
    """

    def __init__(self, state, hidden=(), hides=()):
        self._state, self._lesson = state, SimpleNamespace(hidden=frozenset(hidden), hides=frozenset(hides))

    def __getitem__(self, kind):
        return self._lesson if kind is LessonPart else self._state[kind]

    def with_own(self, name):
        return [self._lesson]


def test_what_a_lesson_hides_is_not_found_nor_what_belongs_to_it(start):
    state = InLesson(start, hidden=("ellipsoid", "motion_files", "robot", "picture", "lessons"))
    assert "bench:ellipsoid" not in places("ellipsoid", state)
    assert not [place for place in places("csv", state) if place.startswith("export:motion_files")]
    assert not [place for place in places("ur5", state) if place.startswith("arm:")]
    assert "setting:dark" not in places("dark", state)
    assert "lesson:first_arm" not in places("where is the hand", state)
    assert "command:undo" in places("undo", state)


def test_a_prediction_hides_all_pages_and_overlays_that_would_tell(start):
    state = InLesson(start, hides=("arm", "values"))
    gone = hidden(state)
    assert {key for kind, key in gone if kind == "bench"} == {key for key, page in pages().items() if not page.always}
    telling = {layer.switch.name for layer in layers().values() if layer.switch and not layer.silent}
    assert {key for kind, key in gone if kind == "setting"} == telling
    assert places("help", state)[0] == "bench:help"
    assert "setting:dark" not in gone


# -- the files of pages ------------------------------------------------------------------------------------------


def shows(export: Export) -> str:
    name, _, copied = export.at.partition(" ")
    return f'title="Copy as {copied}"' if copied else f'data-cell="{name}"'


@pytest.mark.parametrize("key", [key for key, page in pages().items() if page.exports])
def test_the_control_of_every_file_is_on_its_page(url, key):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open(key)
        for export in pages()[key].exports:
            if not export.after:
                await browser.until(lambda export=export: shows(export) in browser.html())
        await browser.close()

    run(main())


def test_every_page_that_saves_says_so():
    for page in pages().values():
        folder = PACKAGE / Path(*page.package.split(".")[1:])
        code = "".join(path.read_text(encoding="utf-8") for path in folder.rglob("*.py"))
        if re.search(r"gui\.save|save_picture|download=|Plot\(", code):
            assert page.exports, page.key


# -- the dialog --------------------------------------------------------------------------------------------------


def part(browser):
    """Return the markup of the dialog."""
    found = browser._markup_with('id="al-search"')
    assert found is not None
    return found["props"]["content"]


async def ask(browser, query):
    """Open the dialog as the page does, and type a query; return what is found."""
    await browser.press("search", query)
    await browser.until(lambda: told(browser) and unescape(attribute(browser, "query")) == query)
    return part(browser)


def told(browser):
    """Return the line below the list; a closed dialog has none."""
    return re.search('role="status">([^<]*)', part(browser))[1]


def attribute(browser, name):
    """Return what a data attribute of the dialog holds."""
    return re.search(f'data-{name}="([^"]*)"', part(browser))[1]


def test_a_closed_dialog_holds_nothing_but_its_field_and_looks_for_nothing(url, monkeypatch):
    async def main():
        browser = await student(url)
        assert 'role="combobox"' in part(browser)
        assert 'role="option"' not in part(browser)
        before = part(browser)
        await browser.press("random")
        await browser.press("zero")
        await browser.until(lambda: browser.slider(1)["value"] == 0.0)
        assert part(browser) == before
        assert asked == []
        await ask(browser, "undo")
        assert asked == ["undo"]
        await browser.press_on(browser.channel("search"), "search-closed")
        await browser.until(lambda: 'role="option"' not in part(browser))
        await browser.close()

    asked = []
    monkeypatch.setattr(
        "armlab.window.search.dialog.find", lambda query, *of: (asked.append(query), find(query, *of))[1]
    )
    run(main())


def test_a_page_with_its_parent_an_arm_and_a_lesson_are_opened(url):
    async def main():
        browser = await student(url)
        found = await ask(browser, "ellipsoid")
        assert "Velocity › </span>" in found
        before = notes(browser)["asked"]
        await browser.press("hit bench:ellipsoid")
        await browser.until(lambda: notes(browser)["asked"] != before)
        assert notes(browser)["tab"] == "Velocity"
        await browser.until(lambda: 'role="option"' not in part(browser))
        await ask(browser, "scara")
        await browser.press("hit arm:scara")
        await browser.until(lambda: notes(browser)["path"] == "/robot/scara")
        await ask(browser, "where is the hand")
        await browser.press("hit lesson:first_arm")
        await browser.until(lambda: "<small>1 of 4</small>" in browser.html())
        found = await ask(browser, "")
        order = re.findall(r'data-cell="hit ([^"]*)"', found)
        assert order == ["lesson:first_arm", "arm:scara", "bench:ellipsoid"]
        await browser.close()

    run(main())


def test_a_command_is_done_and_a_setting_is_switched_and_tells_how_it_stands(url):
    async def main():
        browser = await student(url)
        await ask(browser, "zero pose")
        await browser.press("hit command:zero")
        await browser.until(lambda: browser.slider(2)["value"] == 0.0)
        assert "setting · off" in await ask(browser, "dark theme")
        await browser.press("hit setting:dark")
        await browser.until(lambda: 'role="option"' not in part(browser))
        await ask(browser, "dark theme")
        await browser.until(lambda: "setting · on" in part(browser))
        await ask(browser, "radians")
        await browser.press("hit setting:angle.rad")
        await browser.until(lambda: abs(browser.slider(1)["props"]["max"]) < 7.0)
        await browser.close()

    run(main())


def test_a_file_leads_to_its_control_once_its_page_is_open(url):
    async def main():
        browser = await student(url)
        await ask(browser, "csv")
        assert "al-bring" not in part(browser)
        await browser.press("hit export:motion_files.csv")
        await browser.until(lambda: notes(browser)["tab"] == "Motion")
        assert "al-bring" not in part(browser)  # its page is not seen yet
        await browser.press_on(notes(browser)["chan"], "tabs", '["motion"]')
        await browser.until(lambda: "al-bring" in part(browser))
        note = json.loads(unescape(attribute(browser, "bring")))
        assert (note["tab"], note["at"]) == ("motion", '[data-cell="csv"]')
        assert 'data-cell="csv"' in browser.html()
        await browser.close()

    run(main())


def test_a_topic_leads_to_what_belongs_to_it_and_a_function_to_its_import(url):
    async def main():
        browser = await student(url)
        found = await ask(browser, "3.66")
        assert 'data-ask="S3.2.2-inverse"' in found
        line = re.search(r'data-copy="(from armlab\.kin[\w.]* import \w+)"', found)
        exec(line[1], {})
        found = await ask(browser, "S3.2.2-inverse")
        assert "Axis and angle from a rotation matrix" in found
        assert 'data-ask="S3.2.2-inverse"' not in found
        assert 'data-cell="hit lesson:axis_angle_quaternion"' in found
        assert 'data-cell="hit bench:orientation"' in found
        assert 'data-ask="chapter 4"' in await ask(browser, "4")
        found = await ask(browser, "chapter 4")
        assert 'data-ask="chapter 4"' not in found
        assert 'data-ask="S4.0-spaces"' in found
        await browser.close()

    run(main())


@pytest.mark.parametrize("query", ["qqzzx", "<script>1</script>", "\ud800", "(" * 5000, "9" * 5000, '"></dialog><b>'])
def test_what_is_not_there_is_said_and_no_query_is_markup(url, query):
    async def main():
        browser = await student(url)
        await browser.press("search", query)
        await browser.until(lambda: told(browser) != "")
        assert "<script" not in part(browser)
        assert part(browser).count("</dialog>") == 1
        await browser.close()

    run(main())


# -- strangers ---------------------------------------------------------------------------------------------------


def test_a_forged_pick_of_what_is_hidden_or_not_listed_does_nothing(url):
    async def main():
        browser = await in_lesson(url, "hiding")
        channel = browser.channel("search")
        assert "hit bench:ellipsoid" not in await ask(browser, "ellipsoid")
        await settled(browser)
        before = notes(browser)
        for cell in ("hit bench:ellipsoid", "hit bench:help", "hit arm:scara", "hit export:motion_files.csv", "hit "):
            await browser.press_on(channel, cell)
        await browser.press_on(channel, "search", "zero pose")
        undo = piece(browser, 'data-cell="undo"')
        await browser.press("hit command:zero")  # comes after all of these
        await browser.until(lambda: piece(browser, 'data-cell="undo"') != undo)
        assert notes(browser) == before
        await browser.close()

    run(main())


def test_a_find_that_is_hidden_meanwhile_is_gone_from_the_list_and_from_the_recent_ones(url):
    async def main():
        browser = await student(url)
        await ask(browser, "ellipsoid")
        await browser.press("hit bench:ellipsoid")
        await browser.until(lambda: notes(browser)["tab"] == "Velocity")
        assert "hit bench:ellipsoid" in await ask(browser, "ellipsoid")
        other = await in_lesson(url, "hiding", browser.cookie)
        await browser.until(lambda: "hit bench:ellipsoid" not in part(browser))
        assert "hit bench:ellipsoid" not in await ask(browser, "")
        await other.close()
        await browser.close()

    run(main())


def test_while_a_prediction_is_asked_for_no_page_that_tells_is_found(url):
    async def main():
        browser = await in_lesson(url, "predicting")
        await to_step(browser, 2)
        found = await ask(browser, "pose")
        assert "hit bench:" not in found
        await browser.close()

    run(main())
