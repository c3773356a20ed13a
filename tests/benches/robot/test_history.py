"""The page of history: years and models of the timeline, what is a robot by a definition, what the laws decide."""

import itertools

import pytest

from armlab.benches.robot.history.examples import EXAMPLES, ChooseHistoryExample
from armlab.benches.robot.history.facts import FACTS
from armlab.benches.robot.history.laws import SIGNS, decide
from armlab.benches.robot.history.state import History, Judge, JudgeAnew, LookAt, Suppose
from armlab.benches.robot.history.things import DEFINITIONS, FEATURES, THINGS, fulfils
from armlab.benches.robot.history.timeline import DRIVES, EVENTS, LANES, of_lane
from armlab.benches.robot.history.ui.laws import laws_markup
from armlab.benches.robot.history.ui.things import things_markup
from armlab.benches.robot.history.ui.timeline import WIDE, nearest, spots, timeline_markup
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.session import Session, Undo
from armlab.session.state import State, apply
from armlab.ui.html import joined
from support.done import done
from support.forms import asked


def opened(*commands):
    return done(State.initial(catalogue()["puma560"]), *commands)


def shown(markup, state):
    """Return the text of a view without pressing anything."""
    found = []

    def kept(form):
        found.append(joined(markup(form, state)))
        return found[0]

    asked(lambda form: kept(form) + form.chip("nothing", "", ()), "nothing")
    return str(found[0])


# -- the timeline -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("key", "year"),
    [
        ("rur", 1920),
        ("unimate", 1961),
        ("stanford", 1969),
        ("irb6", 1973),
        ("t3", 1974),
        ("scara", 1978),
        ("puma", 1978),
        ("puma560", 1979),
        ("wabot2", 1984),
        ("h4", 1995),
        ("spirit", 2003),
        ("iso2012", 2012),
    ],
)
def test_the_years_are_those_of_the_notes_corrected_where_they_are_wrong(key, year):
    """The PUMA is not of 1970, and Spirit was launched in 2003: ERR-1.H1, ERR-1.H2."""
    assert EVENTS[key].year == year


def test_the_first_year_is_told_to_those_who_hear_the_page():
    assert f"Timeline of {len(EVENTS)} entries from 1920 on" in shown(timeline_markup, opened())


def test_the_events_are_in_order_and_every_group_has_some():
    years = [event.year for event in EVENTS.values()]
    assert years == sorted(years)
    assert all(of_lane(lane) for lane in LANES)
    assert {event.lane for event in EVENTS.values()} == set(LANES)
    assert all(event.drive in DRIVES and event.source for event in EVENTS.values())


def test_the_errata_of_the_history_are_named_to_those_who_have_the_notes():
    """WAM-8 is the arm of WABOT-2 (ERR-1.H3); the PUMA is not of 1970 (ERR-1.H1)."""
    assert "WAM-8" in EVENTS["wabot2"].says.partition("⟦")[2]
    assert "1970" in EVENTS["puma"].says.partition("⟦")[2]
    assert "2002" in EVENTS["spirit"].says.partition("⟦")[2]
    assert "not Robotic" in DEFINITIONS["ria"].says.partition("⟦")[2]


@pytest.mark.parametrize("key", [key for key, event in EVENTS.items() if event.models])
def test_a_model_has_the_joints_of_its_robot_or_says_that_it_has_others(key):
    event = EVENTS[key]
    for model in event.models:
        kinds = "".join(row.kind for row in catalogue()[model.robot].arm.rows)
        successor = any(word in model.says for word in ("uccessor", "escendant"))
        assert kinds == event.joints or successor, (key, model.robot)


def test_the_joints_are_counted():
    assert EVENTS["unimate"].structure == "5R 1P"
    assert EVENTS["scara"].structure == "3R 1P"
    assert EVENTS["rur"].structure == ""


def test_a_press_on_a_point_of_the_picture_looks_at_that_entry():
    places, _, height = spots()
    for spot in places:
        assert nearest(spot.x / WIDE, spot.y / (height + 11.0)) == spot.event.key
    apart = [abs(a.x - b.x) + abs(a.y - b.y) for a, b in itertools.combinations(places, 2)]
    assert min(apart) > 8.0


def test_an_entry_brings_its_group_and_its_model_stands_on_the_table_and_is_undone_at_once():
    state = opened(LookAt("canadarm"))
    assert (state[History].lane, state[History].event) == ("space", "canadarm")
    text = shown(timeline_markup, state)
    assert "successor on the space station" in text
    assert asked(lambda form: joined(timeline_markup(form, state)), "model canadarm2") == (ChooseRobot("canadarm2"),)
    session = Session.fresh("someone", catalogue()["puma560"])
    session.apply(LookAt("unimate"), 1.0)
    session.apply(ChooseRobot("unimate"), 2.0)
    assert session.state[History].event == "unimate"
    session.apply(Undo(), 3.0)
    assert session.state[RobotPart].robot.key == "puma560"


def test_an_entry_without_a_model_says_so():
    assert "no model of it" in shown(timeline_markup, opened(LookAt("t3")))
    assert "no model of it" not in shown(timeline_markup, opened(LookAt("rur")))


# -- what is a robot ----------------------------------------------------------------------------------------------

ROBOTS = {
    "iso": {"welder", "picker"},
    "ria": {"welder", "picker", "gantry", "rover"},
    "loop": {"picker", "rover", "drone", "car", "washer"},
}


@pytest.mark.parametrize("definition", DEFINITIONS)
def test_the_definitions_divide_the_things(definition):
    assert {key for key in THINGS if fulfils(key, definition)} == ROBOTS[definition]
    assert set(DEFINITIONS[definition].needs) <= set(FEATURES)


def test_what_the_notes_exclude_is_no_industrial_robot():
    """Software, voice assistants, cash machines, washing machines, drones, cars (section 1.5)."""
    for key in ("bot", "voice", "cash", "washer", "drone", "car"):
        assert THINGS[key].lacks(DEFINITIONS["iso"])


def test_answers_are_counted_for_each_definition_and_taken_back_for_one():
    state = opened(Judge("welder", True), Judge("mill", True), Set(History, "definition", "ria"), Judge("mill", False))
    facts = FACTS.facts
    assert (facts["judged"].now(state).value, facts["right"].now(state).value) == (1.0, 1.0)
    state = apply(state, Set(History, "definition", "iso"))
    assert (facts["judged"].now(state).value, facts["right"].now(state).value) == (2.0, 1.0)
    text = shown(things_markup, state)
    assert "✓ right: has all of it" in text
    assert "✕ wrong: lacks links and joints that move objects and more than one kind of task" in text
    state = apply(state, JudgeAnew())
    assert state[History].judged == {}
    assert apply(state, Set(History, "definition", "ria"))[History].judged == {"mill": False}
    assert not facts["all_right"].now(state).value
    for key in THINGS:
        state = apply(state, Judge(key, fulfils(key, "iso")))
    assert facts["all_right"].now(state).value


def test_an_answer_is_a_step_of_undo_and_nonsense_is_refused():
    state = opened()
    assert asked(lambda form: joined(things_markup(form, state)), "no gantry") == (Judge("gantry", False),)
    with pytest.raises(InputError, match="toaster"):
        Judge("toaster", True).apply(state)
    for junk in ({"iso/toaster": True}, {"iso/mill": "yes"}, {"mill": True}, 3):
        with pytest.raises(InputError):
            History.from_json({"answers": junk}, catalogue()["puma560"])


# -- the three laws -----------------------------------------------------------------------------------------------


def by_hand(holds):
    """Decide as a reader of the three sentences would, law by law."""
    for number, (against, behind) in enumerate(
        (("harms", "saves"), ("forbidden", "ordered"), ("risks", "protects")), start=1
    ):
        if against in holds and behind in holds:
            return "conflict", number
        if against in holds:
            return "refrain", number
        if behind in holds:
            return "act", number
    return "free", 0


def test_the_first_law_that_speaks_decides_in_every_situation():
    for size in range(len(SIGNS) + 1):
        for some in itertools.combinations(SIGNS, size):
            assert decide(frozenset(some)) == by_hand(some)


def test_a_situation_is_put_together_and_the_card_tells():
    state = opened(Suppose("harms", True), Suppose("ordered", True))
    assert "It must not do it" in shown(laws_markup, state)
    assert FACTS.facts["law"].now(state).value == 1.0
    state = apply(state, Suppose("harms", False))
    assert FACTS.facts["decision"].now(state).value == "act"
    assert "Law 2 decides." in shown(laws_markup, state)
    state = apply(state, Suppose("forbidden", True))
    assert "The laws give no answer" in shown(laws_markup, state)
    assert asked(lambda form: joined(laws_markup(form, state)), "flag risks") == (Suppose("risks", True),)
    with pytest.raises(InputError, match="hums"):
        Suppose("hums", True).apply(state)


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_is_in_place_until_an_answer_is_given(key):
    state = opened(ChooseHistoryExample(key))
    assert state[History].example == key
    assert apply(state, Suppose("risks", True))[History].example == ""
