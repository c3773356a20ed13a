"""The page of accuracy: systematic errors make AP, scatter makes RP, and a taught goal leaves RP alone."""

import math

import numpy as np
import pytest

from armlab.benches.robot.taught.examples import EXAMPLES, ChooseGoalExample
from armlab.benches.robot.taught.facts import FACTS
from armlab.benches.robot.taught.state import TaughtGoal, VisitAgain
from armlab.benches.robot.taught.ui.board import RINGS, board, ring_of
from armlab.benches.robot.taught.ui.page import PANEL, errors_markup, peg_markup, said_of
from armlab.benches.robot.taught.ui.scene import BESIDE, LABEL, drawn_points, factor_of, label_place
from armlab.benches.robot.taught.visits import visits_of
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.state import State, apply
from armlab.ui.figure.anatomy import anatomy_of
from armlab.ui.html import joined
from armlab.ui.units import units_of
from support.done import done
from support.forms import asked


def opened(*commands, robot="puma560"):
    return done(State.initial(catalogue()[robot]), *commands)


def fact(name, state):
    return FACTS.facts[name].now(state).value


PERFECT = (
    Set(TaughtGoal, "longer", 0.0),
    Set(TaughtGoal, "offset", 0.0),
    Set(TaughtGoal, "slide_offset", 0.0),
    Set(TaughtGoal, "scatter", 0.0),
    Set(TaughtGoal, "slide_scatter", 0.0),
)


def test_an_arm_without_errors_misses_nothing(robot):
    state = opened(*PERFECT, robot=robot.key)
    visits = visits_of(state)
    assert (fact("accuracy", state), fact("repeatability", state)) == (0.0, 0.0)
    assert factor_of(visits, state[Joints].arm.reach) == 1.0
    assert visits.entered(0.0, 0.0) == 30


@pytest.mark.parametrize("taught", [False, True])
def test_without_scatter_every_visit_ends_at_the_same_point(robot, taught):
    still = (Set(TaughtGoal, "scatter", 0.0), Set(TaughtGoal, "slide_scatter", 0.0), Set(TaughtGoal, "taught", taught))
    state = opened(*still, robot=robot.key)
    assert (fact("repeatability", state), fact("ratio", state)) == (0.0, None)
    assert said_of(visits_of(state)) == "Every visit ends at the same point: no scatter at all."
    assert (fact("accuracy", state) == 0.0) == taught


def test_the_label_of_the_deviations_is_beyond_them_on_the_side_away_from_the_wrist():
    goal = np.array([1.0, 0.0, 1.0])
    points = goal + np.array([[0.1, 0.0, 0.2], [0.1, 0.0, 0.1]])
    hanging = label_place(points, goal, goal + np.array([0.0, 0.0, 0.3]), 1.0)
    np.testing.assert_allclose(hanging, [1.1, 0.0, 1.0 - LABEL])
    pointing_up = label_place(points, goal, goal - np.array([0.2, 0.0, 0.1]), 1.0)
    np.testing.assert_allclose(pointing_up, [1.1, 0.0, 1.2 + LABEL])


def test_the_drawn_positions_and_the_label_in_all_its_width_belong_in_the_picture():
    state = opened(robot="openmanipulator_x")
    size, visits = anatomy_of(state[Joints].arm).size, visits_of(state)
    points, around = drawn_points(visits, size), PANEL.around(state)
    label = label_place(points, visits.goal, state[Joints].frames[-2, :3, 3], size)
    along_x, along_y = BESIDE * size * np.eye(3)[:2]
    inside = np.vstack([points, label + along_x, label - along_y])
    assert np.all(inside >= around.min(axis=0) - 1e-12)
    assert np.all(inside <= around.max(axis=0) + 1e-12)
    assert np.ptp(around, axis=0).max() < size


def test_longer_links_alone_make_an_error_that_is_known_by_hand():
    """A planar 2R stretched along x with links of 1 m, one part in a thousand longer: 2 mm, every time."""
    state = opened(*PERFECT, Set(TaughtGoal, "longer", 1e-3), robot="planar_2r")
    visits = visits_of(state)
    distance = np.linalg.norm(visits.goal[:2])
    assert visits.scatter.accuracy == pytest.approx(1e-3 * distance, rel=1e-9)
    assert visits.scatter.repeatability == pytest.approx(0.0, abs=1e-12)


def test_scatter_of_a_single_joint_has_the_spread_of_its_radius():
    """All joints of a 2R scatter; near the goal the deviations are J times the errors of the joints."""
    spread = 1e-4
    state = opened(*PERFECT, Set(TaughtGoal, "scatter", spread), Set(TaughtGoal, "visits", 200), robot="planar_2r")
    visits = visits_of(state)
    J = state[Joints].arm.jacobian(state[Joints].q)[:2]
    expected = spread**2 * (J @ J.T)
    away = (visits.points - visits.goal)[:, :2]
    np.testing.assert_allclose(np.cov(away.T), expected, rtol=0, atol=0.4 * np.abs(expected).max())
    # AP of a pure scatter goes down as the square root of the number of visits.
    assert visits.scatter.accuracy < 4.0 * spread * np.sqrt(np.trace(J @ J.T) / 200)


def test_a_taught_goal_takes_the_systematic_errors_away_and_leaves_the_scatter():
    computed, taught = opened(ChooseGoalExample("repeats")), opened(ChooseGoalExample("taught"))
    assert fact("ratio", computed) > 10.0
    assert fact("accuracy", taught) < 3.0 * fact("repeatability", taught)
    assert fact("repeatability", taught) == pytest.approx(fact("repeatability", computed), rel=1e-12)


def test_the_examples_are_what_their_titles_say():
    ap, rp = (
        {key: fact(name, opened(ChooseGoalExample(key))) for key in EXAMPLES} for name in ("accuracy", "repeatability")
    )
    assert ap["repeats"] > 10.0 * rp["repeats"]
    assert ap["scatters"] < 0.5 * rp["scatters"]
    assert max(ap["both"], rp["both"]) < 3e-4
    assert min(ap["neither"], rp["neither"]) > 2e-3
    assert "comes back, but to another place" in said_of(visits_of(opened(ChooseGoalExample("repeats"))))
    assert "on the average it is right" in said_of(visits_of(opened(ChooseGoalExample("scatters"))))


def test_a_hand_that_yields_gets_pegs_in_that_a_stiff_one_does_not():
    soft = opened(ChooseGoalExample("peg"))
    stiff = apply(soft, Set(TaughtGoal, "yields", 0.0))
    assert fact("entered", soft) == fact("visits", soft) == 30
    assert fact("entered", stiff) < 20
    wide = apply(stiff, Set(TaughtGoal, "clearance", 0.05))
    assert fact("entered", wide) == 30


def test_more_visits_are_others_and_the_same_seed_gives_the_same():
    state = opened()
    again = apply(state, VisitAgain())
    assert not np.array_equal(visits_of(state).points, visits_of(again).points)
    np.testing.assert_array_equal(visits_of(opened(VisitAgain())).points, visits_of(again).points)
    assert again[TaughtGoal].example == "repeats"


@pytest.mark.parametrize("about", ["goal", "middle"])
@pytest.mark.parametrize("plane", ["xy", "xz", "yz"])
def test_the_board_holds_all_that_is_to_be_seen(about, plane):
    for key in EXAMPLES:
        state = opened(ChooseGoalExample(key), Set(TaughtGoal, "about", about), Set(TaughtGoal, "plane", plane))
        part, visits = state[TaughtGoal], visits_of(state)
        ring = ring_of(part, visits)
        centre = visits.goal if about == "goal" else visits.scatter.middle
        assert RINGS * ring >= np.linalg.norm(visits.points - centre, axis=1).max()
        text = str(board(part, visits, units_of(state)))
        assert text.count('class="ac-point"') == 30
        assert "nan" not in text


def test_a_still_arm_has_a_board_and_a_cloud():
    state = opened(*PERFECT)
    assert "nan" not in str(board(state[TaughtGoal], visits_of(state), units_of(state)))
    assert factor_of(visits_of(state), 1.0) >= 1.0
    far = opened(ChooseGoalExample("repeats"))
    assert factor_of(visits_of(far), 1.7) in (20.0, 50.0, 100.0)


def test_fields_are_in_the_units_on_screen_and_only_those_of_joints_that_are_there():
    state = opened()
    units = units_of(state)

    def typed(cell, text, state=state):
        return asked(
            lambda form: joined(
                errors_markup(form, state, units), peg_markup(form, state[TaughtGoal], visits_of(state), units)
            ),
            cell,
            text,
        )

    (command,) = typed("offset", "0.2")
    assert command.value == pytest.approx(math.radians(0.2))
    (command,) = typed("longer", "2 ‰")
    assert command.value == pytest.approx(2e-3)
    (command,) = typed("clearance", "0.5")
    assert command.value == pytest.approx(5e-4)
    assert typed("visits", "50") == (Set(TaughtGoal, "visits", 50),)
    assert typed("slide_scatter", "1") == ()
    assert typed("slide_scatter", "1", opened(robot="scara"))
    for cell, text, told in (
        ("visits", "2.5", "number of visits: expected a whole number from 2 to 200, got '2.5'"),
        ("clearance", "200", "clearance of the hole: expected a number in mm from 0 to 100, got '200'"),
        ("yields", "1e9", "compliance of the hand: expected a number in mm from 0 to 100, got '1e9'"),
        ("longer", "1e9", "lengths longer by: expected a number in ‰ from −50 to 50, got '1e9'"),
    ):
        with pytest.raises(InputError) as refusal:
            typed(cell, text)
        assert str(refusal.value) == told
    with pytest.raises(InputError, match="zero of turning joints: expected a number in degrees"):
        typed("offset", "much")


@pytest.mark.parametrize(("name", "value"), [("visits", 1), ("scatter", -0.1), ("offset", 1.0), ("plane", "zz")])
def test_what_is_out_of_range_is_refused(name, value):
    with pytest.raises(InputError):
        apply(opened(), Set(TaughtGoal, name, value))
