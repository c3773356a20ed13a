"""Which panels are open: of every window by itself, kept in one part of the state that nothing saves or takes back."""

import json

import pytest

from armlab.content.robots import catalogue
from armlab.errors import UnknownName
from armlab.session.example_links import LookAt
from armlab.session.pages import FIRST, pages, tab_of, tabs
from armlab.session.panel_commands import (
    CloseWindow,
    OpenPanel,
    OpenWindow,
    SeeTabs,
    first_window,
    hidden_panels,
    hidden_tabs,
)
from armlab.session.parts.joints import MoveJoint, TakePose
from armlab.session.parts.panels import Panels, Window
from armlab.session.parts.robot import ChooseRobot
from armlab.session.session import Redo, Session, StartFresh, Undo
from armlab.session.share import from_short, short
from armlab.session.state import State, apply
from armlab.session.store import Store
from armlab.teaching.errata_links import LookUp
from armlab.teaching.lesson_commands import CloseLesson, GoToStep, OpenLesson
from armlab.teaching.parts.lesson import LessonPart, observed
from armlab.teaching.parts.shelf import BackFromShared, BackToLesson, OpenShared, ToSandbox
from support.done import done
from support.own_lessons import lesson
from support.small_lessons import library_fixture

PUMA = catalogue()["puma560"]
NO_PANEL = 'robot = "planar_2r"\nq_deg = [30, 60]\n'
STEPS = """
## The film

```start
panel = "film"
```

Text.

## Goes on

Text.

## Another bench

```start
panel = "share"
```

Text.
"""

LOOK = """
## Look

Text.

```check
kind = "looked_at"
panel = "film"
```
"""

own = pytest.fixture(library_fixture, name="own")


def windows(*panels):
    """Return a state with windows 1, 2, ... that show these panels, and in which the last of them was opened."""
    opened = (OpenWindow(number, Window.on(panel)) for number, panel in enumerate(panels, start=1))
    return done(State.initial(PUMA), *opened)


def shown(state, number):
    return state[Panels].windows[number].panels(hidden_panels(state))


def told(state, number, *panels):
    """Return the state after a browser has told that it shows the tabs of some panels."""
    return apply(state, SeeTabs(number, frozenset(map(tab_of, panels))))


# -- windows -----------------------------------------------------------------------------------------------------


def test_the_first_window_begins_where_the_lab_does_and_the_next_where_the_student_was_last():
    state = State.initial(PUMA)
    assert first_window(state) == Window.on(FIRST)
    state = apply(state, OpenPanel("film"))
    assert first_window(state) == Window.on("film")
    state = done(windows("share"), CloseWindow(1))
    assert first_window(state) == Window.on("share")


def test_a_window_turns_by_itself_and_the_others_stay():
    state = apply(windows("joints", "film"), OpenPanel("table", 2))
    assert shown(state, 1) == ("joints",)
    assert shown(state, 2) == ("table",)
    assert state[Panels].last == "table"
    state = apply(state, OpenPanel("joints", 1))
    assert state[Panels].open() == ("joints", "table")


def test_the_panel_beside_one_is_seen_with_it_or_was_in_front_before_it():
    def beside(state):
        return state[Panels].windows[1].beside("author", hidden_panels(state))

    state = windows("joints")
    assert beside(state) == "joints"
    state = told(apply(state, OpenPanel("incremental_encoder", 1)), 1, "incremental_encoder")
    state = told(apply(state, OpenPanel("author", 1)), 1, "author")
    assert beside(state) == "incremental_encoder"
    assert beside(apply(state, OpenPanel("lessons", 1))) == "incremental_encoder"
    assert beside(told(state, 1, "author", "newton_1d")) == "iterations"


def test_without_a_window_a_panel_opens_in_all_of_them():
    state = apply(windows("joints", "film"), OpenPanel("table"))
    assert [each.page_of("robot") for each in state[Panels].windows.values()] == ["table", "table"]
    assert [each.wanted for each in state[Panels].windows.values()] == ["robot", "robot"]


def test_what_is_asked_for_in_a_window_opens_in_it_alone():
    session = Session.fresh("token", PUMA)
    for number in (1, 2):
        session.apply(OpenWindow(number, Window.on("joints")), 0.0)
    for command, panel in ((OpenPanel("film"), "film"), (LookAt("laws/triangle"), "laws"), (LookUp("5.58"), "errata")):
        session.apply(command, 0.0, 2)
        assert session.state[Panels].windows[2].wanted == tab_of(panel)
        assert shown(session.state, 1) == ("joints",)
        assert session.state[Panels].windows[1].wanted == "joints"


def test_which_tabs_are_seen_is_what_the_browser_tells():
    state = apply(windows("joints"), OpenPanel("table", 1))
    assert shown(state, 1) == ("joints",)  # until the browser has brought it to the front
    assert shown(told(state, 1, "table"), 1) == ("table",)
    split = told(told(state, 1, "table"), 1, "table", "joints")
    assert shown(split, 1) == ("joints", "table")
    assert shown(apply(split, OpenPanel("table", 1)), 1) == ("table", "joints")
    assert shown(told(split, 1), 1) == ()


def test_a_tab_stands_where_it_was_left():
    state = told(apply(windows("joints"), OpenPanel("table", 1)), 1, "table")
    state = told(told(state, 1, "joints"), 1, "film")
    assert shown(state, 1) == ("table",)


def test_a_window_that_comes_tells_and_goes_leaves_alone_what_is_typed_in_another():
    session = Session.fresh("token", PUMA)
    for command in (
        OpenWindow(1, Window.on("joints")),
        OpenWindow(2, Window.on("joints")),
        SeeTabs(2, frozenset({"joints"})),
        OpenPanel("film", 2),
        SeeTabs(2, frozenset({"robot"})),
        CloseWindow(2),
    ):
        session.apply(command, 0.0)
        assert session.untaken == 0, command
    assert list(session.state[Panels].windows) == [1]


def test_the_browser_is_asked_again_for_a_panel_that_is_opened_again():
    state = windows("joints")
    asked = state[Panels].windows[1].asked
    again = apply(state, OpenPanel("joints", 1))
    assert again[Panels].windows[1].asked == asked + 1


def test_what_is_told_of_a_window_that_has_gone_changes_nothing():
    state = apply(windows("joints"), CloseWindow(1))
    assert told(state, 1, "film") is state
    assert apply(state, CloseWindow(1)) is state
    assert apply(state, OpenPanel("film", 1))[Panels].windows == {}


def test_an_unknown_panel_is_refused_with_a_proposal():
    with pytest.raises(UnknownName, match=r"panel: unknown name 'flim'.*did you mean 'film'"):
        apply(State.initial(PUMA), OpenPanel("flim"))


def test_every_panel_can_be_opened_and_its_tab_told():
    for key in pages():
        state = told(apply(windows(FIRST), OpenPanel(key, 1)), 1, key)
        assert shown(state, 1) == (key,)
        assert tab_of(key) in tabs()


# -- what it outlives --------------------------------------------------------------------------------------------


def test_undo_redo_another_arm_and_a_fresh_start_leave_the_windows_alone():
    session = Session.fresh("token", PUMA)
    session.apply(OpenWindow(1, Window.on("film")), 0.0)
    session.apply(TakePose("zero"), 1.0)
    session.apply(OpenPanel("film", 1), 2.0)
    for command in (Undo(), Redo(), ChooseRobot("scara"), Undo(), StartFresh()):
        before = session.state[Panels]
        session.apply(command, 3.0)
        assert session.state[Panels] is before, command
    assert session.history.undo_label is None


def test_a_turned_panel_is_no_step_of_undo():
    session = Session.fresh("token", PUMA)
    session.apply(TakePose("zero"), 0.0)
    session.apply(OpenPanel("film"), 1.0)
    session.apply(Undo(), 2.0)
    assert session.state[Panels].last == "film"
    assert session.history.undo_label is None


def test_the_sandbox_and_a_shared_state_keep_the_windows_and_the_lesson_brings_its_bench_back(own):
    own(t=lesson(STEPS, NO_PANEL))
    state = done(windows("joints"), OpenLesson("t"))
    away = apply(told(apply(state, ToSandbox()), 1, "share"), OpenPanel("share", 1))
    assert shown(away, 1) == ("share",)
    back = told(apply(away, BackToLesson()), 1, "film")
    assert shown(back, 1) == ("film",)
    text = short(apply(State.initial(PUMA), MoveJoint(0, 0.25)))
    shared = apply(told(back, 1, "share"), OpenShared(text))
    assert shown(shared, 1) == ("share",)
    assert shown(told(apply(shared, BackFromShared()), 1, "film"), 1) == ("film",)


def test_no_file_and_no_link_holds_or_opens_windows():
    state = windows("film", "share")
    assert "panels" not in state.to_json()
    assert state.to_json() == State.initial(PUMA).to_json()
    assert short(state) == short(State.initial(PUMA))
    assert from_short(short(state))[Panels] == Panels()
    forged = State.from_json({**state.to_json(), "panels": {"last": "film"}}, PUMA)
    assert forged[Panels] == Panels()


def test_a_student_who_only_looks_round_leaves_no_file(tmp_path):
    store = Store(tmp_path, PUMA)
    session = store.get("visitor")
    session.apply(OpenWindow(1, Window.on("joints")), 0.0)
    session.apply(OpenPanel("film", 1), 1.0)
    session.apply(SeeTabs(1, frozenset({"robot"})), 2.0)
    assert store.save() == 0
    assert list(tmp_path.iterdir()) == []
    session.apply(TakePose("zero"), 3.0)
    assert store.save() == 1
    session.apply(CloseWindow(1), 4.0)
    assert store.save() == 0
    (file,) = tmp_path.iterdir()
    assert "panels" not in json.loads(file.read_text(encoding="utf-8"))["parts"]


# -- lessons -----------------------------------------------------------------------------------------------------


def test_a_lesson_opens_its_bench_in_every_window_and_a_step_that_names_one_too(own):
    own(t=lesson(STEPS, NO_PANEL))
    state = apply(windows("joints", "share"), OpenLesson("t"))
    assert [each.wanted for each in state[Panels].windows.values()] == ["robot", "robot"]
    state = told(told(state, 1, "film"), 2, "film")
    assert (shown(state, 1), shown(state, 2)) == (("film",), ("film",))
    before = state[Panels]
    assert apply(state, GoToStep(1))[Panels] is before  # it goes on with the bench of the step before
    assert apply(state, GoToStep(2))[Panels].last == "share"
    turned = apply(apply(state, GoToStep(1)), OpenPanel("joints", 1))
    assert apply(turned, GoToStep(0))[Panels].last == "film"
    assert apply(state, CloseLesson())[Panels] is before


def test_a_new_window_in_a_lesson_begins_at_its_bench(own):
    own(t=lesson(STEPS, NO_PANEL))
    state = done(State.initial(PUMA), OpenLesson("t"), OpenPanel("share"))
    assert first_window(state) == Window.on("film")


def test_a_lesson_hides_panels_and_what_stood_there_makes_room(own):
    own(t=lesson(front=NO_PANEL + 'hidden = ["table", "joints"]\n'), s=lesson(front=NO_PANEL))
    there = next(key for key in pages() if key not in ("table", "joints"))
    for panel in ("table", "joints"):
        state = apply(windows(panel), OpenLesson("t"))
        assert hidden_tabs(state) == (pages()["joints"].title,)
        assert shown(told(state, 1, there), 1) == (there,)
        assert first_window(state) == Window.on(there)
        assert apply(state, OpenPanel(panel)) is state
    elsewhere = windows("film")
    assert apply(elsewhere, OpenLesson("t"))[Panels] is elsewhere[Panels]
    assert apply(windows("table"), OpenLesson("s"))[Panels] == windows("table")[Panels]


def test_a_tab_whose_page_is_hidden_in_the_meantime_shows_another():
    window = Window.on("table")
    assert window.panels({"table"}) == (next(page.key for page in tabs()["robot"] if page.key != "table"),)
    assert window.panels() == ("table",)


def test_a_panel_that_is_open_already_is_seen_by_the_check_that_asks_for_it(own):
    own(t=lesson(LOOK, NO_PANEL))
    state = apply(windows("film"), OpenLesson("t"))
    assert state[LessonPart].progress.met == {"Look"}


def test_a_panel_that_was_left_before_the_lesson_is_not_seen(own):
    own(s=lesson(front=NO_PANEL), t=lesson(LOOK, NO_PANEL))
    state = done(windows("joints"), OpenLesson("s"), OpenPanel("film", 1))
    state = told(told(state, 1, "film"), 1, "joints")
    state = done(state, CloseLesson(), OpenPanel("joints", 1), OpenLesson("t"))
    assert observed(state).panel == "joints"
    assert state[LessonPart].progress.met == frozenset()


def test_of_panels_side_by_side_and_in_two_windows_a_check_sees_the_one_it_asks_for(own):
    own(t=lesson(LOOK, NO_PANEL))
    beside = told(windows("film"), 1, "film", "joints")
    assert observed(apply(beside, OpenLesson("t"))).panel == "film"
    assert observed(apply(windows("film", "joints"), OpenLesson("t"))).panel == "film"
    assert observed(apply(windows("table", "joints"), OpenLesson("t"))).panel == "joints"
