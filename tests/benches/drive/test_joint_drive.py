"""The page of joint drives: resolutions, the errors they leave at the tool, and the motors behind them."""

import math
import re

import numpy as np
import pytest

from armlab.benches.drive.joint.errors import DRAWN, INSIDE, box, cloud_at, compared, errors_at, levers, magnified
from armlab.benches.drive.joint.examples import EXAMPLES, ChooseDriveExample
from armlab.benches.drive.joint.facts import FACTS
from armlab.benches.drive.joint.state import (
    Drives,
    PlaceAllEncoders,
    PlaceEncoder,
    SetAllDrives,
    SetDrive,
)
from armlab.benches.drive.joint.ui.page import PANEL
from armlab.benches.drive.joint.ui.scene import MOST, thinned
from armlab.benches.drive.joint.ui.table import small, table_markup
from armlab.benches.drive.joint.ui.words import (
    _most,
    _where,
    compared_markup,
    motors_markup,
    shares_markup,
    worst_markup,
)
from armlab.benches.velocity.api import balance, speeds_of
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.drive.tool_error import corners
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import ChooseRobot
from armlab.session.session import Asked
from armlab.session.state import State, apply
from armlab.ui.html import joined
from armlab.ui.units import Units, units_of
from support.arms import random_q
from support.done import done
from support.forms import BareForm

KINDS = ["planar_3r", "scara", "puma560", "ur5e", "iiwa7", "stanford", "panda", "trunk9", "cartesian_3p"]


def opened(*commands, arm="puma560"):
    return done(State.initial(catalogue()[arm]), *commands)


def value(name, state):
    return FACTS.facts[name].now(state).value


def table_of(form, state):
    return table_markup(form, state[Drives], units_of(state))


def filled(cell, text, state):
    form = BareForm()
    form.show(table_of(form, state))
    form.press(cell, text)
    (asked,) = form.posted
    for command in asked.commands if isinstance(asked, Asked) else (asked,):
        state = apply(state, command)
    return state


@pytest.mark.parametrize("key", EXAMPLES)
@pytest.mark.parametrize("arm", ["puma560", "stanford", "cartesian_3p"])
def test_an_example_fits_every_arm_and_is_in_place_until_something_is_changed(key, arm):
    state = opened(ChooseDriveExample(key), arm=arm)
    assert state[Drives].example == key
    assert len(state[Drives].ratio) == state[Joints].arm.n
    assert apply(state, SetDrive(0, "counts", 1234.0))[Drives].example == ""
    # The arm is not part of it.
    assert apply(state, MoveJoint(0, state[Joints].q[0] + 0.01))[Drives].example == key


def test_the_first_drives_are_the_first_example():
    state = opened()
    assert state[Drives].example == "servo"
    given = EXAMPLES["servo"].part(state[Joints].arm)
    assert given.to_json() == state[Drives].to_json()


def test_sentences_of_examples_are_true():
    servo, play = opened(), opened(ChooseDriveExample("play"))
    assert math.degrees(value("counts", servo)[0]) == pytest.approx(0.0009)
    assert 1e-5 < value("worst_position", servo) < 1e-4
    assert pytest.approx(55.0, abs=1.0) == 0.05 / 0.0009
    assert value("worst_position", play) / value("worst_position", servo) == pytest.approx(28.8, abs=0.1)
    joint = opened(ChooseDriveExample("at_joint"))
    assert math.degrees(value("half_widths", joint)[0]) == pytest.approx(0.09)
    assert math.degrees(value("counts", opened(ChooseDriveExample("coarse")))[0]) == pytest.approx(4.0)
    # Those numbers are of joints that turn; where all slide, J is enough even with the coarse drive.
    for key in ("servo", "play", "at_joint", "coarse"):
        assert re.search(r"joint that turns|[wW]here (a joint turns|joints turn)", EXAMPLES[key].says)
    sliding = opened(ChooseDriveExample("coarse"), arm="cartesian_3p")
    assert sliding.derived(compared).position_apart == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("arm", KINDS)
def test_the_drawn_cloud_is_sampled_forward_kinematics_and_lies_in_the_worst_case_of_j(arm, rng):
    state = opened(ChooseDriveExample("play"), arm=arm)
    part, n = state[Drives], state[Joints].arm.n
    for q in random_q(part.arm, rng, 2):
        found, cloud = errors_at(part, q), cloud_at(part, q)
        assert len(cloud) == 2**n + INSIDE == len(box(part.arm))
        here = part.arm.position(q)
        for k in (0, 1, 2**n - 1, 2**n + 7):
            there = part.arm.position(q + box(part.arm)[k] * found.half)
            np.testing.assert_allclose(cloud[k], there - here, rtol=0, atol=1e-12)
        # To second order all of it is within the worst case, which a corner comes up to.
        second = part.arm.reach * float(found.half[part.arm.revolute].sum()) ** 2 + 1e-12
        sizes = np.linalg.norm(cloud, axis=1)
        assert sizes.max() <= found.position.size + second
        assert sizes.max() >= found.position.size - second
        assert np.argmax(sizes) < 2**n or sizes.max() == 0.0


def test_facts_agree_with_each_other():
    state = opened(ChooseDriveExample("coarse"))
    assert np.linalg.norm(value("direction", state)) == pytest.approx(value("worst_position", state))
    assert value("largest_joint", state) == 1 + int(np.argmax(value("shares", state)))
    apart = abs(value("sampled_position", state) - value("worst_position", state))
    assert 0.0 < apart <= value("position_apart", state)
    finer = apply(state, SetAllDrives("counts", 180.0))
    assert value("position_apart", finer) == pytest.approx(value("position_apart", state) / 4.0, rel=0.1)


def test_motors_turn_and_push_for_the_present_speeds_and_wrench():
    state = opened(arm="stanford")
    speeds, torques = np.array(value("motor_speeds", state)), np.array(value("motor_torques", state))
    np.testing.assert_allclose(speeds * torques, speeds_of(state) * balance(state).torques, rtol=1e-12)
    assert speeds[0] == pytest.approx(100.0 * speeds_of(state)[0])
    text = str(motors_markup(state, units_of(state)))
    assert "motor 6" in text
    assert "rpm" in text


@pytest.mark.parametrize("arm", KINDS)
def test_an_error_is_never_drawn_larger_than_meant(arm, rng):
    state = opened(arm=arm)
    part = state[Drives]
    times, reach = magnified(part), 2.0 * part.arm.length_scale
    largest = max(errors_at(part, q).position.size for q in random_q(part.arm, rng, 20))
    assert times * largest <= DRAWN * reach
    assert float(levers(part.arm) @ part.drives.half_width) * times > 0.3 * DRAWN * reach
    around = PANEL.around(state)
    assert around.shape == (2, 3)
    assert np.isfinite(around).all()


def test_the_page_says_the_worst_case_its_direction_and_who_contributes_most():
    state = opened()
    units = units_of(state)
    text = str(worst_markup(state, units))
    assert "The tool is known within 0.0279 mm and 0.0035°" in text
    assert "off most along (0.54, 0.39, 0.75) or the opposite" in text
    assert "Joint 1 contributes most to the position, 0.0116 mm" in text
    assert "6 joints contribute most to the orientation, 0.0009° each" in text
    assert "0.00374 mm" in str(joined(shares_markup(state, units)))
    both = str(compared_markup(state, units))
    assert "within 360°/(n N) with the encoder at the motor, within 360°/N" in both
    assert "slides is within p/(n N) with the encoder at the motor, within p/N" in both
    assert "2⁶ = 64 corners" in both
    assert "by J: exactly" in both
    assert "at least" in both


def test_positions_and_orientations_keep_their_units():
    state = opened(arm="cartesian_3p")
    units = units_of(state)
    assert "0°" in str(worst_markup(state, units))
    assert value("worst_orientation", state) == 0.0
    # Three screws of 10 mm, 400 000 counts a turn: sqrt(3) of 25 nm.
    assert value("worst_position", state) == pytest.approx(math.sqrt(3.0) * 2.5e-8)
    assert small(units, 2.5e-8, False) == "2.5·10⁻⁵ mm"
    assert small(units, 1e-19, True) == "0°"
    assert "within 2π/(n N)" in str(compared_markup(state, Units(Notation(angle="rad"))))


def test_a_tool_on_the_axis_of_the_only_joint_is_known_exactly():
    arm = Arm.from_dh([("R", 0.0, 0.0, 0.5, 0.0)])
    drives = Drives(arm, (100.0,), (4000.0,), ("motor",), (0.0,), (0.01,))
    found = errors_at(drives, np.zeros(1))
    assert found.position.size == 0.0
    assert found.orientation.size == pytest.approx(2.0 * math.pi / 4e5)
    assert _where(found, arm).startswith("No joint moves the tool point")
    assert _most(found, arm, units_of(opened())) is None


def test_one_joint_errs_and_several_err():
    arm = Arm.from_dh([("R", 0.3, 0.0, 0.5, 0.0)])
    found = errors_at(Drives(arm, (100.0,), (4000.0,), ("motor",), (0.0,), (0.01,)), np.zeros(1))
    assert _where(found, arm).endswith("when joint 1 errs in one sense.")
    folded = opened(MoveJoint(0, 0.3), MoveJoint(1, math.pi), arm="planar_2r")
    assert "when joint 2 errs in one sense" in str(worst_markup(folded, units_of(folded)))
    assert "when all joints err in one sense" in str(worst_markup(opened(arm="planar_2r"), units_of(folded)))


def test_very_many_corners_are_thinned_out():
    points = np.arange(3.0 * (4096 + 10)).reshape(-1, 3)
    drawn, inside = thinned(points, 4096)
    assert len(drawn) <= MOST
    assert len(inside) == 10
    drawn, _ = thinned(points[: 64 + 10], 64)
    assert len(drawn) == 64 == len(corners(6))


def test_fields_are_read_in_the_units_on_screen():
    state = opened(arm="stanford")
    assert filled("backlash 0", "0.05", state)[Drives].backlash[0] == pytest.approx(math.radians(0.05))
    assert filled("backlash 2", "0.2", state)[Drives].backlash[2] == pytest.approx(2e-4)
    assert filled("lead 2", "5", state)[Drives].lead[2] == pytest.approx(0.005)
    assert filled("counts 1", "1024", state)[Drives].counts[1] == 1024.0
    assert filled("all ratio", "50", state)[Drives].ratio == (50.0,) * 6
    metres = apply(state, Set(Notation, "length", "m"))
    assert filled("lead 2", "0.005", metres)[Drives].lead[2] == pytest.approx(0.005)


def test_encoders_are_moved_one_by_one_and_together():
    state = filled("side 2", "", opened())
    assert state[Drives].side == ("motor", "motor", "joint", "motor", "motor", "motor")
    assert "both" in str(table_of(BareForm(), state))
    assert filled("all side", "", state)[Drives].side == ("motor",) * 6
    assert apply(state, PlaceAllEncoders("joint"))[Drives].side == ("joint",) * 6


@pytest.mark.parametrize(
    ("cell", "text", "told"),
    [
        (
            "ratio 1",
            "0",
            r"n \(ratio of the gear of joint 2\): expected a number greater than 0 and at most",
        ),
        ("counts 0", "0", r"N \(counts of the encoder in a turn of joint 1\): expected a whole number from 1 to"),
        ("counts 0", "10.5", "expected a whole number"),
        ("backlash 3", "-1", "backlash of joint 4: expected a number in ° from 0 to 30, got '-1'"),
        ("all counts", "0", r"N \(counts of the encoder in a turn\): expected a whole number from 1 to"),
        ("all ratio", "", "got nothing"),
    ],
)
def test_a_field_says_what_it_expects(cell, text, told):
    with pytest.raises(InputError, match=told):
        filled(cell, text, opened())


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (
            SetDrive(1, "ratio", 0.0),
            "ratio of the gear of joint 2: expected a number greater than 0 and at most",
        ),
        (SetDrive(0, "counts", 0.0), "counts of the encoder in a turn of joint 1: expected a whole number from 1"),
        (SetDrive(0, "counts", 10.5), "expected a whole number"),
        (SetDrive(0, "backlash", -1.0), "backlash of joint 1: expected a number from 0 to 0.523599 rad or m, got -1"),
        (SetDrive(0, "backlash", math.nan), "backlash"),
        (SetDrive(9, "ratio", 1.0), "joint: expected 1 to 6, got 10"),
        (SetDrive(0, "colour", 1.0), "colour"),
        (SetAllDrives("lead", 1.0), "lead"),
        (PlaceEncoder(0, "moon"), "moon"),
        (ChooseDriveExample("best"), "best"),
    ],
)
def test_what_cannot_be_is_refused_and_the_old_state_stays(command, told):
    state = opened()
    before = state[Drives].to_json()
    with pytest.raises(InputError, match=told):
        apply(state, command)
    assert state[Drives].to_json() == before


def test_another_arm_has_drives_of_its_own_and_an_edited_one_keeps_them():
    state = opened(SetDrive(1, "ratio", 33.0), SetDrive(1, "backlash", 0.01))
    assert apply(state, ChooseRobot("scara"))[Drives].ratio == (100.0,) * 4
    robot = catalogue()["scara"]
    part = opened(SetDrive(2, "backlash", 1e-3), SetDrive(0, "ratio", 33.0), arm="scara")[Drives]
    # Joint 3, which slides, is now where joint 1 turned; what was backlash in metres is none in radians.
    edited = part.for_edited(robot, (2, 1, 0, None))
    assert edited.ratio == (100.0, 100.0, 33.0, 100.0)
    assert edited.backlash == (0.0, 0.0, 0.0, 0.0)
    assert edited.example == ""
    assert opened(arm="scara")[Drives].for_edited(robot, (0, 1, 2, 3)).example == "servo"


def test_drives_are_saved_and_read_again():
    state = opened(ChooseDriveExample("play"), SetDrive(2, "counts", 1000.0), PlaceEncoder(0, "joint"))
    robot = catalogue()["puma560"]
    again = State.from_json(state.to_json(), robot)
    assert again[Drives].to_json() == state[Drives].to_json()
    broken = dict(state[Drives].to_json(), side=["motor"])
    with pytest.raises(InputError, match="side: expected 6 sides, got 1"):
        Drives.from_json(broken, robot)
