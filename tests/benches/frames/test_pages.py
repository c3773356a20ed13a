"""The fields of the pages of frames, filled without a browser, what they say, and a drag beside a second page."""

import math

import numpy as np
import pytest

from armlab.benches.frames.chain.commands import AddFrame, SetFrameEntry, SetFrameMatrix, SetFramePosition, SetParent
from armlab.benches.frames.chain.examples import ChooseChainExample
from armlab.benches.frames.chain.point import LookAtFrames, SelectFrame, SetPointCoordinate
from armlab.benches.frames.chain.state import WORLD, Chain
from armlab.benches.frames.chain.tree import point_of, points_of, poses_of
from armlab.benches.frames.chain.ui.frames import frames_markup
from armlab.benches.frames.chain.ui.globe import circles
from armlab.benches.frames.chain.ui.point import counts_markup, point_markup
from armlab.benches.frames.chain.ui.product import inverse_markup, pair_markup
from armlab.benches.frames.chain.ui.scene import arrows_of, steps
from armlab.benches.frames.screw.examples import ChooseScrewExample
from armlab.benches.frames.screw.state import MakeScrew, Screw
from armlab.benches.frames.screw.ui.numbers import screw_form, ways_markup
from armlab.benches.frames.table.state import TableTask
from armlab.benches.frames.two.examples import ChooseTwoExample
from armlab.benches.frames.two.state import TwoRobots
from armlab.benches.frames.two.ui.solutions import solutions_markup
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.session import Asked
from armlab.session.state import State, apply
from armlab.ui.html import joined
from support.done import done
from support.filled import Filled
from support.forms import BareForm
from support.student import run, settled, student

ROBOT = catalogue()["puma560"]
MATRIX = Set(Chain, "written", "matrix")


def opened(*commands):
    return done(State.initial(ROBOT), *commands)


def filled(markup, cell, text, *commands):
    """Return the state after a field of a markup was filled, or a button pressed."""
    state, form = opened(*commands), BareForm()
    form.show(markup(form, state))
    form.press(cell, text)
    (asked,) = form.posted
    for command in asked.commands if isinstance(asked, Asked) else (asked,):
        state = apply(state, command)
    return state


def said(markup, *commands):
    return str(joined(markup(BareForm(), opened(*commands))))


@pytest.mark.parametrize(
    ("markup", "cell", "text", "commands", "expected"),
    [
        (frames_markup, "add", "", (), [AddFrame("B")]),
        (frames_markup, "frame C", "", (), [SelectFrame("C")]),
        (frames_markup, "position 2", "0.4 m", (), [SetFramePosition("B", 2, 0.4)]),
        (frames_markup, "parent", WORLD, (), [SetParent("B", WORLD)]),
        (frames_markup, "R 01", "-0.5", (MATRIX,), [SetFrameEntry("B", 0, 1, -0.5)]),
        (
            frames_markup,
            "R 00",
            "0 -1 0; 1 0 0; 0 0 1",
            (MATRIX,),
            [SetFrameMatrix("B", (0.0, -1, 0, 1, 0, 0, 0, 0, 1))],
        ),
        (pair_markup, "exchange", "", (), [LookAtFrames("C", WORLD)]),
        (pair_markup, "reference", "A", (), [LookAtFrames(reference="A")]),
        (point_markup, "point 1", "-250", (), [SetPointCoordinate(1, -0.25)]),
        (counts_markup, "count", "12", (), [Set(Chain, "count", 12)]),
    ],
)
def test_a_filled_field_of_the_chain_is_a_command(markup, cell, text, commands, expected):
    assert filled(markup, cell, text, *commands)[Chain] == opened(*commands, *expected)[Chain]


@pytest.mark.parametrize(
    ("markup", "cell", "text", "commands", "told"),
    [
        (frames_markup, "position 0", "near", (), "x: expected a number in mm, got 'near'"),
        (frames_markup, "angle 1", "steep", (), "pitch: expected a number in degrees"),
        (frames_markup, "R 12", "1 2 3 4", (MATRIX,), "row 2, column 3: expected a number, or all 9 of the matrix"),
        (frames_markup, "R 00", "0 0 0 0 0 0 0 0 0", (MATRIX,), "expected one with a single nearest rotation"),
        (frames_markup, "name", "two words", (), "name: expected a letter"),
        (frames_markup, "remove", "", (), "B: C is given in it"),
        (counts_markup, "count", "some", (), "points: expected a whole number of points"),
        (counts_markup, "count", "1.5", (), "whole number"),
    ],
)
def test_what_is_refused_says_where_and_why(markup, cell, text, commands, told):
    with pytest.raises(InputError, match=told):
        filled(markup, cell, text, *commands)


@pytest.mark.parametrize(
    ("page", "cell", "text", "told"),
    [
        ("frame_chain", "position 1", "1e9", "y: expected a number in mm from −100000 to 100000, got '1e9'"),
        ("table_task", "table 0", "1e9", "x: expected a number in mm from −10000000 to 10000000, got '1e9'"),
        ("table_task", "object 0", "1e9", "p x: expected a number in mm from −10000000 to 10000000, got '1e9'"),
        ("table_task", "height", "1e9", "h: expected a number in mm from 0 to 1000000, got '1e9'"),
        ("two_robots", "base A 0", "60000", "x: expected a number in mm from −50000 to 50000, got '60000'"),
        ("two_robots", "base A turn", "1e9", "angle: expected a number in degrees from −3600 to 3600, got '1e9'"),
        ("two_robots", "joint 0", "1e9", "q₁: expected a number in degrees from −3600 to 3600, got '1e9'"),
    ],
)
def test_a_range_is_told_of_the_field_and_in_its_unit(page, cell, text, told):
    bench = Filled(page)
    bench.fill(cell, text)
    assert told in bench.text


@pytest.mark.parametrize(
    ("page", "cell", "angle"),
    [
        ("frame_chain", "angle 2", lambda state: state[Chain].named("B").angles[2]),
        ("table_task", "turn", lambda state: state[TableTask].turn),
        ("table_task", "spin", lambda state: state[TableTask].spin),
        ("two_robots", "base B turn", lambda state: state[TwoRobots].turn_b),
        ("two_robots", "between", lambda state: state[TwoRobots].between),
        ("two_robots", "joint 1", lambda state: state[TwoRobots].q_a[1]),
    ],
)
def test_quarter_turns_typed_in_radians_are_exact(page, cell, angle):
    bench = Filled(page)
    bench.do(Set(Notation, "angle", "rad"))
    bench.fill(cell, "-1.5708")
    assert angle(bench.state) == -math.pi / 2
    bench.fill(cell, "1.5")
    assert angle(bench.state) == 1.5


def test_names_that_cancel_are_struck_out_and_inverses_are_named():
    text = said(pair_markup)
    assert text.count("<s>") == 4
    assert "Inverses of what is given" not in text
    text = said(pair_markup, ChooseChainExample("camera"))
    assert "Inverses of what is given" in text
    assert " = I" in said(pair_markup, LookAtFrames("A", "A"))


def test_the_change_of_coordinates_adds_up_as_it_is_printed():
    state = opened(ChooseChainExample("sphere"))
    text = said(point_markup, ChooseChainExample("sphere"))
    for number in ("4000.0", "3000.0", "1000.0"):
        assert number in text
    assert "They differ by" in str(inverse_markup(state))


def test_operations_are_printed_for_the_present_chain():
    text = said(counts_markup, ChooseChainExample("rotations"))
    for count in ("63\u2002/\u200242", "27\u2002/\u200218"):
        assert count in text
    assert "from 4 points on for rotations, and from 5 on for transforms" in text
    assert "nothing to multiply first" in said(counts_markup, LookAtFrames("A", "B"))
    assert "nothing to calculate" in said(counts_markup, LookAtFrames("A", "A"))


def test_a_typed_matrix_that_is_no_rotation_says_how_far_it_is_and_offers_the_nearest():
    typed = (SetFrameMatrix("B", (1.0, 0, 0, 0, 1.2, 0, 0, 0, 1)), MATRIX)
    assert "the nearest one is 0.2000 away" in said(frames_markup, *typed)
    taken = filled(frames_markup, "rounded", "", *typed)
    assert "Not a rotation" not in str(joined(frames_markup(BareForm(), taken)))
    half = 0.707107
    rounded = (SetFrameMatrix("B", (half, -half, 0, half, half, 0, 0, 0, 1)), MATRIX)
    assert "A rotation with rounded entries: the exact one is 4.4·10⁻⁷ away" in said(frames_markup, *rounded)


def test_the_arrows_are_a_triangle_or_one_where_it_has_no_sides():
    state = opened()
    part, found, p = state[Chain], state.derived(poses_of), state.derived(point_of)
    whole, shift, rest = arrows_of(part, found, p, (0, 0, 0))
    np.testing.assert_allclose(whole[1] - whole[0], shift[1] - shift[0] + rest[1] - rest[0], rtol=0, atol=1e-12)
    assert [each[3] for each in (whole, shift, rest)] == ["w → p", "w → C", "C → p"]
    same = opened(LookAtFrames("B", "B"))
    assert len(arrows_of(same[Chain], found, p, (0, 0, 0))) == 1
    end = steps(state.derived(points_of)["C"], found["C"])[-1][1]
    np.testing.assert_allclose(end, p, rtol=0, atol=1e-12)


def test_the_circles_of_the_globe_lie_on_it():
    np.testing.assert_allclose(np.linalg.norm(circles(), axis=2), 1.0, rtol=0, atol=1e-6)


@pytest.mark.parametrize(
    ("cell", "text", "expected"),
    [
        ("screw angle", "45", MakeScrew((0.0, 0.0, 1.0), (0.0, 0.0, 0.2), math.radians(45.0), 0.0)),
        ("screw distance", "0.3 m", MakeScrew((0.0, 0.0, 1.0), (0.0, 0.0, 0.2), math.pi / 2, 0.3)),
        ("screw point 0", "200", MakeScrew((0.0, 0.0, 1.0), (0.2, 0.0, 0.2), math.pi / 2, 0.0)),
        ("screw direction 0", "1 2 2", MakeScrew((1.0, 2.0, 2.0), (0.0, 0.0, 0.2), math.pi / 2, 0.0)),
    ],
)
def test_a_typed_number_of_the_screw_moves_pose_2(cell, text, expected):
    start = ChooseScrewExample("door")
    found, wanted = filled(screw_form, cell, text, start)[Screw], opened(start, expected)[Screw]
    np.testing.assert_allclose(found.pose("second"), wanted.pose("second"), rtol=0, atol=1e-9)


def test_a_direction_that_is_zero_is_refused_at_its_field():
    with pytest.raises(InputError, match="zero has no direction"):
        filled(screw_form, "screw direction 2", "0 0 0")


def test_the_pitch_is_told_for_a_whole_turn_and_is_infinite_for_a_shift():
    assert "480.0 mm a turn" in said(screw_form, ChooseScrewExample("bolt"))
    assert "∞" in said(screw_form, ChooseScrewExample("slide"))
    assert "both paths are the same" in said(ways_markup, ChooseScrewExample("slide"))
    assert "the same orientation on both paths" in said(ways_markup)


def test_a_solution_is_chosen_by_its_name_and_misses_its_angle_in_degrees():
    state = filled(solutions_markup, "elbow down", "")
    assert state[TwoRobots].elbow == "down"
    assert "160.077" in said(solutions_markup)
    text = said(solutions_markup, ChooseTwoExample("position"))
    assert "144.604" in text
    assert "–" not in text


@pytest.mark.parametrize(
    ("key", "choice", "handle", "held", "other"),
    [
        ("frame_chain", "frame A", "chain/handle", "chain/frame2", "chain/frame1"),
        ("two_robots", "handle A", "two/handle", "two/B", "two/A"),
        ("screw", "select first", "screw/handle", "screw/posesecond", "screw/posefirst"),
        ("table_task", "handle table", "table/handle", "table/object", "table/T"),
    ],
)
def test_a_drag_moves_what_the_hand_holds_whatever_another_page_selects(url, key, choice, handle, held, other):
    async def main():
        first = await student(url)
        second = await student(url, first.cookie)
        await first.open(key)
        await second.open(key)
        await settled(first)

        def named(part):
            return next(name for name in first.nodes if f"/{part}" in name)

        node, moving, resting = map(named, (handle, held, other))
        hand, *before = (np.array(first.nodes[name]["position"]) for name in (node, moving, resting))
        await first.drag("start", node=node)
        await first.drag("update", np.add(hand, [0.05, 0.0, 0.0]), node=node)
        await second.press(choice)
        await settled(first)
        await first.drag("update", np.add(hand, [0.1, 0.0, 0.0]), node=node)
        await first.drag("end", node=node)
        await settled(first)
        moved = [np.array(first.nodes[name]["position"]) for name in (moving, resting)]
        np.testing.assert_allclose(np.subtract(moved, before), [[0.1, 0.0, 0.0], [0.0, 0.0, 0.0]], rtol=0, atol=1e-6)
        # When the hand has let go, the handle goes to what is selected by now.
        np.testing.assert_allclose(first.nodes[named(handle)]["position"][:2], moved[1][:2], rtol=0, atol=1e-6)

    run(main())
