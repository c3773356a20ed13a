"""Units and names as the student has chosen them."""

import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.pose.orientation.ui.page import _three_turns
from armlab.benches.pose.tool.state import PoseView
from armlab.benches.pose.tool.ui.notation import link_symbols
from armlab.benches.robot.table.ui.ends import _texts
from armlab.benches.robot.table.ui.facts import axes_section, facts_of
from armlab.benches.robot.table.ui.page import step_formula
from armlab.content.robots import catalogue, own_robot
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.dh import Row
from armlab.kin.ik import Verdict
from armlab.kin.rotations import rotation_from_sequence
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import OPTIONS, Notation
from armlab.session.session import Session, Undo
from armlab.session.state import State, apply
from armlab.ui import verdicts
from armlab.ui.figure.anatomy import anatomy_of
from armlab.ui.format import MINUS
from armlab.ui.html import joined
from armlab.ui.remarks import remarks
from armlab.ui.scene._dimensions import dimensions_of
from armlab.ui.scene.angles import name_of
from armlab.ui.tables import cell_text
from armlab.ui.units import BOOKS, Units, units_of
from support.forms import BareForm

DEGREES, RADIANS = Units(Notation()), Units(Notation(angle="rad", length="m", variable="theta", book="corke"))


def test_quantities_bear_the_chosen_unit():
    assert DEGREES.angle(math.pi / 6) == "30.0°"
    assert RADIANS.angle(math.pi / 6) == "0.524 rad"
    assert DEGREES.length(-0.4318) == "−431.8 mm"
    assert RADIANS.length(-0.4318) == "−0.4318 m"


def test_turned_angles_are_in_one_turn_in_both_units():
    for units, half, quarter in ((DEGREES, "180.0", "−90.0"), (RADIANS, "3.142", "−1.571")):
        assert units.turned(math.pi) == units.turned(-math.pi) == units.turned(-math.pi + 1e-5) == half
        assert units.turned(3.0 * math.pi + 1e-12) == half
        assert units.turned(1.5 * math.pi) == units.turned(-0.5 * math.pi) == quarter
        assert units.turned(-1e-9) in ("0.0", "0.000")


def test_orientations_never_read_minus_half_a_turn():
    for value in (-math.pi, -math.pi + 1e-6, math.pi, 3.0 * math.pi):
        assert DEGREES.orientation(value) == "180.0°"
        assert RADIANS.orientation(value) == "3.142 rad"
    assert DEGREES.orientation(-0.5 * math.pi) == "−90.0°"
    assert DEGREES.angle(-math.pi) == "−180.0°"  # where a joint may stand


@pytest.mark.parametrize("axes", ["zyx", "zyz", "xyz"])
def test_the_page_of_orientations_and_the_fields_of_the_ends_have_no_minus_half_turn(axes):
    for turns in ((-math.pi, 0.3, -math.pi), (math.pi - 1e-9, 0.3, -math.pi + 1e-9), (0.2, 0.0, -math.pi)):
        R = rotation_from_sequence(axes, turns)
        assert f"{MINUS}180.0°" not in _three_turns(R, PoseView(n=2, axes=axes), DEGREES)
        tool = np.eye(4)
        tool[:3, :3] = R
        robot = catalogue()["planar_2r"]
        state = State.initial(own_robot(replace(robot.arm, tool=tool), robot.name, robot))
        assert f"{MINUS}180" not in _texts(state, "tool", DEGREES).values()


def test_a_constant_reads_the_same_in_the_table_and_in_the_scene():
    row = Row("R", a=0.15005, alpha=-math.pi / 2, theta=math.pi / 2)
    for units, a, alpha in ((DEGREES, "150.05 mm", "−90°"), (RADIANS, "0.15005 m", "−1.5708 rad")):
        assert units.constant(row.a, False) == a
        assert units.constant(row.alpha, True) == alpha
        assert cell_text(row.a, "a", units) == a.split()[0]
        texts = {one.text(units) for one in dimensions_of(anatomy_of(Arm.from_dh([row])))}
        assert {f"a₁ {a}", f"α₁ {alpha}"} <= texts
        assert alpha.removeprefix(MINUS) in name_of(units, 0, row, 0.1)


def test_letters_are_those_of_the_book():
    units = Units(Notation(book="siciliano"))
    arm = catalogue()["planar_2r"].arm
    assert units.symbol("theta", 1) == "ϑ₁"
    moves = r"R_z(\vartheta_{i})\,T_z(d_{i})\,T_x(a_{i})\,R_x(\alpha_{i})"
    assert step_formula("standard", units) == r"{}^{i-1}T_{i}=" + moves
    assert r"R_x(\alpha_{j-1})\,T_x(a_{j-1})\,R_z(\theta_{j})" in step_formula("modified", RADIANS)
    assert link_symbols(arm, 1, units) != link_symbols(arm, 1, DEGREES)
    shown = joined(axes_section(BareForm(), facts_of(catalogue()["puma560"].arm), 1, units, lambda _: None))
    assert "ϑ₁" in shown
    assert "θ" not in shown


def test_variables_bear_the_chosen_name():
    assert [DEGREES.variable(2, revolute) for revolute in (True, False)] == ["q₃", "q₃"]
    assert [RADIANS.variable(2, revolute) for revolute in (True, False)] == ["θ₃", "d₃"]


def test_columns_are_those_of_the_book():
    assert set(BOOKS) == set(OPTIONS["book"])
    assert all(sorted(book.order) == ["a", "alpha", "d", "theta"] for book in BOOKS.values())
    assert RADIANS.column("alpha", "modified") == "α<sub>j−1</sub>, rad"
    assert DEGREES.column("d", "modified") == "d<sub>i</sub>, mm"


@pytest.mark.parametrize("units", [DEGREES, RADIANS])
@pytest.mark.parametrize("revolute", [True, False])
@pytest.mark.parametrize("value", [0.0, 0.123456, -2.5, 3.14159])
def test_what_is_shown_is_read_back(units, revolute, value):
    step = 0.51 * 10.0 ** -units.decimals(revolute) * units.factor(revolute)
    assert units.read(units.text(value, revolute), revolute, "q") == pytest.approx(value, abs=step)


@pytest.mark.parametrize(
    ("text", "revolute", "value"),
    [
        ("90", True, math.pi / 2),
        ("pi/2", True, math.pi / 2),
        ("−π/4", True, -math.pi / 4),
        ("1.5 rad", True, 1.5),
        ("45°", True, math.pi / 4),
        ("12,5", False, 0.0125),
        ("0.3 m", False, 0.3),
        ("4 cm", False, 0.04),
    ],
)
def test_units_may_be_typed(text, revolute, value):
    assert DEGREES.read(text, revolute, "x") == pytest.approx(value)


@pytest.mark.parametrize(
    ("units", "text", "revolute", "per", "said"),
    [
        (RADIANS, "90", True, "", ["Read as 90 rad. For degrees type 90° or 90 deg."]),
        (RADIANS, "-22.5*2", True, "", ["Read as −45 rad. For degrees type −45° or −45 deg."]),
        (RADIANS, "12.5", True, "", []),
        (RADIANS, "90°", True, "", []),
        (RADIANS, "90 deg", True, "", []),
        (RADIANS, "90 rad", True, "", []),
        (RADIANS, "6 pi", True, "", []),
        (RADIANS, "90", True, "/s", []),
        (RADIANS, "90", False, "", []),
        (DEGREES, "1000", True, "", []),
    ],
)
def test_a_plain_angle_of_many_turns_in_radians_is_remarked_on(units, text, revolute, per, said):
    """Whether it is in range or not; nobody hears it outside a form."""
    value = units.read(text, revolute, "x", per)
    with remarks() as heard:
        assert units.read(text, revolute, "x", per) == value
    assert heard == said
    with remarks() as heard, pytest.raises(InputError):
        units.read(text, revolute, "x", per, (1.0e5, 2.0e5))
    assert heard == said


def test_an_angle_at_its_bound_up_to_the_rounding_of_its_field_is_the_bound():
    radians, degrees = Units(Notation(angle="rad")), Units(Notation())
    assert radians.read("-6.2832", True, "θ", within=(-2.0 * math.pi, 2.0 * math.pi)) == -2.0 * math.pi
    assert degrees.read("114.592", True, "θ", within=(0.0, 2.0)) == 2.0
    for units, text, bounds in ((radians, "3.1417", (0.0, math.pi)), (radians, "-0.00002", (0.0, 1.0))):
        with pytest.raises(InputError, match=r"θ: expected a number in rad from 0"):
            units.read(text, True, "θ", within=bounds)


@pytest.mark.parametrize("angle", ["rad", "deg"])
@pytest.mark.parametrize(("text", "quarters"), [("1.5708", 1), ("−3.14159", -2), ("4,7124", 3), ("1.570796 rad", 1)])
def test_an_angle_whose_field_shows_quarter_turns_is_these(angle, text, quarters):
    units = Units(Notation(angle=angle))
    typed = text if angle == "rad" or "rad" in text else f"{text} rad"
    assert units.read(typed, True, "α") == quarters * math.pi / 2
    assert units.read(f"{typed}/s", True, "ω", per="/s") != quarters * math.pi / 2, "a speed is as it is typed"
    for other in ("1.57 rad", "1.571 rad", "1.57084 rad", "1.5709 rad", "0.00004 rad"):
        assert units.read(other, True, "α") == float(other.removesuffix(" rad"))
    assert units.read("0.3 m", False, "a") == 0.3


def test_what_is_no_number_is_refused_with_the_unit_expected():
    with pytest.raises(InputError, match="x: expected a number in mm, got 'six'"):
        DEGREES.read("six", False, "x")
    with pytest.raises(InputError, match="yaw: expected a number in degrees, got ''"):
        DEGREES.read(" ", True, "yaw")


def test_labels_change_nothing_but_labels_and_are_no_step():
    session = Session.fresh("token", catalogue()["puma560"])
    before = session.state
    session.apply(Set(Notation, "angle", "rad"), 0.0)
    assert units_of(session.state).angle_unit == "rad"
    assert session.state[Joints] is before[Joints]
    session.apply(Undo(), 1.0)
    assert units_of(session.state).angle_unit == "rad"
    for wrong in (Set(Notation, "colour", "red"), Set(Notation, "angle", "grad")):
        with pytest.raises(UnknownName, match="Available"):
            apply(session.state, wrong)


def test_a_damaged_choice_is_left_out_when_read_back():
    robot = catalogue()["puma560"]
    assert Notation.from_json({"angle": "rad", "length": "feet"}, robot) == Notation(angle="rad")
    assert State.initial(robot)[Notation].to_json() == Notation().to_json()


@pytest.mark.parametrize(
    ("verdict", "kind", "line"),
    [
        (Verdict("reached", 1e-9, 0.0, ()), "ok", "✓ reached</b> 0.0 mm 0.0°"),
        (Verdict("limit", 0.043, 0.0, (2,)), "no", "✕ limit on joint 3</b> 43.0 mm short"),
        (Verdict("limit", 0.0, 0.1, (0, 4)), "no", "✕ limit on joints 1 and 5</b> orientation error 5.7°"),
        (
            Verdict("closest", 0.143, 0.02, ()),
            "no",
            "✕ closest possible from here</b> 143.0 mm short, orientation error 1.1°",
        ),
        (
            Verdict("beyond", 1.2, 0.0, ()),
            "no",
            "✕ out of reach</b> 1200.0 mm short; farther than the fully stretched arm",
        ),
        (Verdict("moving", 0.01, 0.0, ()), "warn", "◐ not there yet</b> 10.0 mm short"),
        (Verdict("closest", 1e-5, 0.0, ()), "no", "✕ closest possible from here</b> within 0.1 mm and 0.1°"),
    ],
)
def test_verdicts_have_a_sign_a_word_and_numbers(verdict, kind, line):
    units = Units(Notation())
    assert verdicts.verdict_kind(verdict) == kind
    assert line in verdicts.verdict_line(verdict, units)
    assert f'class="verdict {kind}"' in verdicts.verdict_card(verdict, units)
