"""What tabs and pages are called: short, told apart, the same wherever they are spoken of; their keys stay."""

import re
from pathlib import Path

import pytest

from armlab.session.pages import pages, place_of, tab_of, tabs
from armlab.window.lesson.text import _titles

TOP = Path(__file__).resolve().parents[2]

LONGEST = 18
"""Letters of a name, so that three stand in a row of the dock."""

LONGEST_TAB = 11
"""Letters of the name of a tab for which the rail has room, such as Orientation."""

KEYS = set(
    re.findall(
        r"\w+",
        """lessons author robot table film normal trainer joints pose orientation formulas target solutions by_hand
        iterations newton_1d basins velocity turning solve pictures ellipsoid statics microscope workspace section
        dexterous what_if motion motion_plots curves laws motion_steps space_curve motion_files control loop exponential
        picture share help""",
    )
)
"""Keys that stand in lessons, links and saved work."""

VAGUE = set(
    re.findall(
        r"[^,\s][^,\n]+",
        """Solve, Turning, Pictures, Runs, Loop, Steps, Five steps, Curves, Geometry, By hand, What if, Film, Trainer,
        Speeds, Laws, Files, e^At, One variable, Microscope, Table""",
    )
)
"""Names that told only those who knew it what was inside."""

SAID = re.compile(r"\b([Pp]age|[Tt]ab) \*([^*]+)\*")
"""How lessons and documents speak of a page or a tab."""

IN_CODE = re.compile(r"\bthe page ([A-Z][^“”\n]*)")


def test_names_are_short_and_told_apart():
    for tab in tabs().values():
        assert len(tab[0].title) <= LONGEST_TAB, tab[0].title
        names = [page.name for page in tab]
        assert len(set(names)) == len(names)
        assert max(map(len, names)) <= LONGEST, names
    titles = [page.title for page in pages().values()]
    assert len(set(titles)) == len(titles)


def test_no_name_leaves_open_what_is_inside():
    assert [page.name for page in pages().values() if page.name in VAGUE] == []


def test_the_keys_in_lessons_links_and_saved_work_are_still_there():
    assert KEYS - pages().keys() == set()


@pytest.mark.parametrize("file", ["lessons", "docs", "README.md"])
def test_texts_call_pages_and_tabs_what_they_are_called_on_screen(file):
    files = [TOP / file] if file.endswith(".md") else sorted((TOP / file).rglob("*.md"))
    names = {"page": {page.name for page in pages().values()}, "tab": {tab[0].title for tab in tabs().values()}}
    names["tab"] |= {"Lesson"}
    wrong = [
        f"{path.name}: {kind} {name}"
        for path in files
        for kind, name in SAID.findall(path.read_text(encoding="utf-8"))
        if " ".join(name.split()) not in names[kind.lower()]
    ]
    assert wrong == []


def test_the_code_speaks_of_pages_by_their_names_too():
    names = tuple(page.name for page in pages().values())
    wrong = [
        f"{path.relative_to(TOP)}: {said}"
        for path in sorted((TOP / "app").rglob("*.py"))
        for said in IN_CODE.findall(path.read_text(encoding="utf-8"))
        if not said.startswith(names)
    ]
    assert wrong == []


def test_a_place_has_the_tab_before_the_page_where_there_are_several():
    assert place_of("velocity") == "Velocity › Jacobian"
    assert place_of("solve") == "Velocity › Inverse velocity"
    assert place_of("joints") == "Joints"
    for key in pages():
        assert place_of(key).split(" › ")[0] == pages()[tab_of(key)].title
    assert len({place_of(key) for key in pages()}) == len(pages())


def test_a_lesson_says_where_the_panel_is_that_it_asks_for():
    assert _titles()["microscope"] == "Velocity › Singularities"
