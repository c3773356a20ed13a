"""The live table through the protocol: what a person types and presses, and what comes back."""

import asyncio
import json
import math
import re
from html import unescape

import numpy as np
import pytest
from markupsafe import escape

from armlab.benches.robot.table.ui.editor import DhEditor
from armlab.benches.robot.table.ui.ends import ends_markup
from armlab.benches.robot.table.ui.facts import axes_section, closed_form_card, facts_of
from armlab.benches.robot.table.ui.files import PRESENT, saved_robot
from armlab.benches.robot.table.ui.page import moved_lines
from armlab.content.robots import catalogue, own_robot, parse_robot
from armlab.content.write_robot import robot_toml
from armlab.content.write_table import write_table
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.session.edits import AddJoint, Convert, PasteTable, SetCell, SetKind
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State, apply
from armlab.ui.file_names import file_name
from armlab.ui.html import joined
from armlab.ui.units import Units, units_of
from support.fake_browser import cookie_of
from support.forms import BareForm, asked
from support.student import run, student

PUMA = catalogue()["puma560"]

TILTED = Arm.from_dh(
    [("R", 0.1, 0.3, 0, 0), ("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0)], "modified", name="Tilted", task="xy"
)
"""A planar arm on a slope: its task means nothing in the frame 0 of the standard table."""


@pytest.fixture
def editor():
    return editor_of(Notation())


def editor_of(notation):
    return DhEditor(BareForm(), Units(notation))


def typed(editor, arm, cell, text):
    """Return what a control of the table asks for."""
    editor._form.posted.clear()
    editor.show(arm)
    editor._form.fields.send(cell, text)
    return [each for posted in editor._form.posted for each in posted.commands]


def value_of(browser, cell):
    """Return what a field shows."""
    field = re.search(rf'<input[^>]*data-cell="{re.escape(cell)}"[^>]*>', browser.html())
    return re.search(r'value="([^"]*)"', field[0])[1]


async def at_the_table(url, cookie=None, path="/"):
    browser = await student(url, cookie, path)
    await browser.open("table")
    await browser.until(lambda: 'class="dh edit"' in browser.html())
    return browser


# -- reading -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("cell", "text", "command"),
    [
        ("dh-2-a", "500", SetCell(1, "a", 0.5)),
        ("dh-2-a", "0.5 m", SetCell(1, "a", 0.5)),
        ("dh-2-alpha", "pi/2", SetCell(1, "alpha", np.pi / 2)),
        ("dh-2-alpha", "−90°", SetCell(1, "alpha", -np.pi / 2)),
        ("dh-1-theta", "q1 + 90", SetCell(0, "theta", np.pi / 2)),
        ("dh-1-theta", "θ₁ − 90", SetCell(0, "theta", -np.pi / 2)),
        ("dh-1-theta", "+90", SetCell(0, "theta", np.pi / 2)),
        ("dh-1-theta", "90", SetCell(0, "theta", np.pi / 2)),
        ("dh-1-theta", "q1", SetCell(0, "theta", 0.0)),
        ("dh-1-theta", "", SetCell(0, "theta", 0.0)),
        ("dh-2-alpha", "3.1416 rad", SetCell(1, "alpha", np.pi)),
        ("dh-1-theta", "q1 - 1.5708 rad", SetCell(0, "theta", -np.pi / 2)),
        ("dh-6-add", "", AddJoint(5)),
    ],
)
def test_what_is_typed_becomes_a_command(editor, cell, text, command):
    assert typed(editor, PUMA.arm, cell, text) == [command]


def test_the_text_on_screen_typed_again_changes_nothing(editor):
    """What is rounded on screen is not put into the table by leaving a cell."""
    arm = Arm.from_dh([("R", 1 / 3, 1.0, 0.123456789, 0.0), ("R", 0.1, 0.0, 0.0, 2.0)])
    editor.show(arm)
    content = editor._form.fields.content
    found = re.findall(r'value="([^"]*)"[^>]* data-cell="(dh-\d-(?:a|alpha|d|theta))"', content)
    assert len(found) == 8
    for text, cell in found:
        assert typed(editor, arm, cell, text) == []


def test_columns_and_names_follow_the_book():
    orders = {}
    for book in ("notes", "craig", "corke"):
        editor = editor_of(Notation(book=book))
        editor.show(PUMA.arm)
        orders[book] = re.findall(r'<th class="[a-z]*" title="([^"]*)">', editor._form.fields.content)
    assert orders["notes"] == ["link length", "link twist", "link offset", "joint angle"]
    assert orders["craig"] == ["link twist", "link length", "link offset", "joint angle"]
    assert orders["corke"] == ["joint angle", "link offset", "link length", "link twist"]


def test_a_field_of_base_tool_or_point_changes_one_number():
    state = State.initial(catalogue()["panda"])
    units = units_of(state)
    tool = state[RobotPart].robot.arm.tool

    def typed(cell, text):
        return asked(lambda form: ends_markup(form, state, units), cell, text)

    (command,) = typed("tool-x", "12.5")
    expected = np.array(tool)
    expected[0, 3] = 0.0125
    np.testing.assert_array_equal(command.pose, expected)
    turned = apply(state, *typed("base-yaw", "90"))
    np.testing.assert_array_equal(turned[RobotPart].robot.arm.base[:3, 0], [0.0, 1.0, 0.0])
    assert typed("point-z", "0") == ()
    assert typed("point-z", "10")[0].xyz == (0.0, 0.0, 0.01)


# -- what the table says -----------------------------------------------------------------------------------------


def free(facts, chosen):
    return joined(axes_section(BareForm(), facts, chosen, Units(Notation()), lambda chosen: None))


def test_each_pair_of_axes_is_flagged_with_its_freedom():
    facts = facts_of(PUMA.arm)
    shown = free(facts, 2)
    assert "1 × 2" in shown
    assert "2 ∥ 3" in shown
    assert "z₁ and z₂ are parallel: they have infinitely many common normals" in shown
    assert "direction of x₀ around it" in free(facts, 0)
    assert "Frame 6" in free(facts, 99)
    in_line = Arm.from_dh([("R", 0.0, 0.0, 0.2, 0.0), ("R", 0.3, 0.0, 0.0, 0.0)])
    assert "1 ≡ 2" in free(facts_of(in_line), 1)
    skew = Arm.from_dh([("R", 0.2, 1.0, 0.2, 0.0), ("R", 0.3, 0.0, 0.0, 0.0)])
    assert "exactly one common normal" in free(facts_of(skew), 1)


def test_the_closed_form_is_told_with_its_reason():
    card = closed_form_card(facts_of(PUMA.arm).structure)
    assert "✓ Spherical wrist: closed form" in card
    assert "4, 5 and 6 meet in one point" in card
    assert "At most 8 solutions" in card
    none = closed_form_card(facts_of(catalogue()["manseur_doty"].arm).structure)
    assert "◐ General 6R: no closed form is known" in none


def test_remainders_of_a_conversion_are_told_both_ways():
    state = State.initial(catalogue()["planar_2r"])
    a = state[RobotPart].robot.arm.rows[1].a
    units = units_of(state)
    assert joined(moved_lines(state[RobotPart], units)) == ""
    modified = apply(state, Convert("modified"))
    assert f"tool: T<sub>x</sub>({units.constant(a, False)}) moved here from row 2" in joined(
        moved_lines(modified[RobotPart], units)
    )
    back = apply(modified, Convert("standard"))
    assert f"row 2: T<sub>x</sub>({units.constant(a, False)}) moved here from the tool" in joined(
        moved_lines(back[RobotPart], units)
    )
    panda = apply(State.initial(catalogue()["panda"]), SetCell(0, "alpha", -np.pi / 2))
    turned = apply(panda, Convert("standard"))
    assert "base: R<sub>x</sub>(−90°) moved here from row 1" in joined(moved_lines(turned[RobotPart], units))


def test_a_conversion_that_cannot_keep_the_task_says_so():
    tilted = State.initial(own_robot(TILTED, "tilted", None))
    units = units_of(tilted)
    there = apply(tilted, Convert("standard"))[RobotPart]
    assert there.robot.arm.task.key == "xy phi"
    assert "in the axes of the new frame 0; it is now position (x, y) and" in joined(moved_lines(there, units))
    read = RobotPart.from_json(json.loads(json.dumps(there.to_json())), there.robot)
    assert joined(moved_lines(read, units)) == joined(moved_lines(there, units))
    with pytest.raises(InputError, match="moved"):
        RobotPart.from_json({**there.to_json(), "task_kept": "no"}, there.robot)
    kept = apply(State.initial(catalogue()["planar_2r"]), Convert("modified"))[RobotPart]
    assert "it is now" not in joined(moved_lines(kept, units))
    assert "task_kept" not in kept.to_json()


def test_a_saved_file_has_a_name_it_can_be_loaded_under():
    for robot in catalogue().robots.values():
        assert re.fullmatch(r"[a-z0-9][a-z0-9_]*", file_name(robot.name))
    assert file_name("../../etc/<b>") == "etc_b"


# -- a student at the table --------------------------------------------------------------------------------------


def test_a_cell_is_edited_undone_and_kept(url):
    async def main():
        cookie = cookie_of(url)
        browser = await at_the_table(url, cookie)
        assert value_of(browser, "dh-2-a") == "431.8"
        await browser.press("dh-2-a", "500")
        await browser.until(lambda: value_of(browser, "dh-2-a") == "500")
        assert "PUMA 560" in browser.html()
        assert "edited" in browser.html()
        assert joined("Restore the table of the file") in browser.html()
        again = await at_the_table(url, cookie)
        assert value_of(again, "dh-2-a") == "500"
        await browser.press("undo")
        await browser.until(lambda: value_of(browser, "dh-2-a") == "431.8")
        assert "Restore the table of the file" not in browser.html()
        await browser.press("redo")
        await browser.until(lambda: value_of(browser, "dh-2-a") == "500")
        await browser.press("restore")
        await browser.until(lambda: value_of(browser, "dh-2-a") == "431.8")
        await again.close()
        await browser.close()

    run(main())


@pytest.mark.parametrize(
    ("cell", "text", "words"),
    [
        ("dh-2-a", "abc", "row 2, a: expected a number in mm, got 'abc'"),
        ("dh-2-a", "1e9", "row 2, a: expected a number in mm from −100000 to 100000, got '1e9'"),
        ("dh-2-alpha", "400", "row 2, α: expected a number in degrees from −360 to 360, got '400'"),
        ("base-x", "<b>", "base, x: expected a number in mm"),
        ("point-y", "1e9", "tool point, y: expected a number in mm from −100000 to 100000, got '1e9'"),
    ],
)
def test_wrong_input_stays_marked_with_the_reason_below_until_the_next(url, cell, text, words):
    async def main():
        browser = await at_the_table(url)
        marker = f'data-cell="{cell}"'
        field = next(c for c in browser.controls.values() if marker in c["props"].get("content", ""))
        old, before = value_of(browser, cell), field["props"]["content"]
        await browser.press(cell, text)
        # Written anew with another revision, so that the page drops what was typed.
        await browser.until(lambda: field["props"]["content"] != before)
        assert value_of(browser, cell) == escape(text)
        assert re.search(rf'<input[^>]*aria-invalid="true"[^>]*{re.escape(marker)}', browser.html())
        told = field["props"]["content"].rsplit('role="alert">', 1)[1]
        assert escape(words) in told
        await browser.press(cell, old)  # as it was: nothing is wrong
        await browser.until(lambda: "aria-invalid" not in browser.html())
        assert value_of(browser, cell) == old
        assert 'role="alert"' not in field["props"]["content"]
        await browser.press("undo")
        await asyncio.sleep(0.3)
        assert "edited" not in browser.html()
        await browser.close()

    run(main())


def test_the_same_length_in_other_words_is_shown_as_before(url):
    async def main():
        browser = await at_the_table(url)
        field = next(c for c in browser.controls.values() if 'class="dh edit"' in c["props"].get("content", ""))
        before = field["props"]["content"]
        await browser.press("dh-2-a", "0.4318 m")
        await browser.until(lambda: field["props"]["content"] != before)
        assert value_of(browser, "dh-2-a") == "431.8"
        assert "edited" not in browser.html()
        await browser.close()

    run(main())


def test_joints_are_added_turned_into_slides_moved_and_removed(url):
    async def main():
        browser = await at_the_table(url, path="/robot/planar_2r")
        await browser.press("dh-2-add")
        await browser.until(lambda: 'data-cell="dh-3-a"' in browser.html())
        await browser.press("dh-3-kind")
        await browser.until(lambda: "Joint 3 is prismatic" in browser.html())
        await browser.press("dh-3-row")
        await browser.until(lambda: 'data-cell="dh-3-low"' in browser.html())
        assert (value_of(browser, "dh-3-low"), value_of(browser, "dh-3-high")) == ("0", "1000")
        await browser.press("dh-3-high", "250")
        await browser.until(lambda: value_of(browser, "dh-3-high") == "250")
        await browser.press("dh-3-up")
        await browser.until(lambda: "Joint 2 is prismatic" in browser.html())
        assert value_of(browser, "dh-2-high") == "250"
        await browser.press("dh-2-remove")
        await browser.until(lambda: 'data-cell="dh-3-a"' not in browser.html())
        assert "is prismatic" not in browser.html()
        await browser.close()

    run(main())


def test_an_edited_arm_is_saved_with_a_name_that_says_so_and_its_present_pose():
    state = State.initial(catalogue()["planar_3r"])
    moves = (MoveJoint(0, math.radians(55.0)), MoveJoint(2, math.radians(-45.0)))
    for command in (SetKind(1, "P"), *moves):
        state = apply(state, command)
    part, q = state[RobotPart], state[Joints].q
    saved = parse_robot("x", robot_toml(saved_robot(part, q)), proven=False)
    assert saved.name == part.title == "Planar 3R, edited"
    assert file_name(saved.name) == "planar_3r_edited"
    np.testing.assert_allclose(saved.home, q, rtol=0, atol=1e-12)
    assert list(saved.poses) == ["home"]
    edited = apply(apply(State.initial(PUMA), SetCell(1, "a", 0.5)), MoveJoint(0, 0.3))
    kept = saved_robot(edited[RobotPart], edited[Joints].q).poses
    assert list(kept) == [*PUMA.poses, PRESENT]
    assert kept[PRESENT][0] == pytest.approx(0.3)
    assert saved_robot(state.initial(PUMA)[RobotPart], q) is PUMA


def test_tables_are_pasted_and_files_loaded(url):
    async def main():
        browser = await at_the_table(url)
        await browser.press("paste", write_table(catalogue()["scara"].arm, "markdown"))
        await browser.press("apply")
        await browser.until(lambda: "Pasted arm" in browser.html())
        assert "SCARA: closed form" in browser.html()
        await browser.press("load", robot_toml(catalogue()["panda"]))
        await browser.until(lambda: 'data-cell="dh-7-a"' in browser.html())
        assert 'data-cell="modified" title="Write the same arm in the other convention" aria-pressed="true"' in (
            browser.html()
        )
        await browser.press("load", "[[joints]]\ntype = 3")
        await browser.until(lambda: re.search('role="alert">[^<]*pasted file', browser.html()) is not None)
        assert 'data-cell="dh-7-a"' in browser.html()
        await browser.close()

    run(main())


def test_the_cells_stay_in_place_while_the_table_is_edited(url):
    """The page keeps the cursor by the name of the cell and its channel, so neither may change with an edit."""

    async def main():
        browser = await at_the_table(url)

        def channel():
            return re.search(r'data-chan="([^"]*)" data-cell="dh-3-d"', browser.html())[1]

        before = channel()
        await browser.press("dh-3-d", "200")
        await browser.until(lambda: value_of(browser, "dh-3-d") == "200")
        await browser.press("dh-6-add")
        await browser.until(lambda: 'data-cell="dh-7-a"' in browser.html())
        assert channel() == before
        await browser.close()

    run(main())


def test_a_pasted_table_is_read_anew_in_the_other_convention(url):
    text = "a, alpha, d, theta\n0.3, 90, 0.2, q1\n0.25, 0, 0, q2"

    def heading(browser):
        return unescape(re.search(r'<p class="dim">(Read as .*?)</p>', browser.html())[1])

    async def main():
        browser = await at_the_table(url)
        await browser.press("paste", text)
        await browser.press("apply")
        await browser.until(lambda: "Read as standard (Siciliano)" in browser.html())
        assert "if your book is Craig's" in heading(browser)
        await browser.press("read-as modified")
        await browser.press("apply")
        await browser.until(lambda: "Read as modified (Craig)" in browser.html())
        assert "if your book is Siciliano's" in heading(browser)
        assert value_of(browser, "dh-2-a") == "250"
        assert text in unescape(browser.html())  # the text stays for another try
        rows = write_table(catalogue()["scara"].arm, "csv").splitlines()[1:]
        await browser.press("load", "\n".join(row.rsplit(",", 2)[0] for row in rows))  # without head and limits
        await browser.until(lambda: 'data-cell="dh-4-a"' in browser.html())
        assert "Read as modified (Craig)" in browser.html(), "a table in a file is read as is chosen, too"
        await browser.close()

    run(main())


def test_a_pasted_table_opens_in_the_other_units(url):
    state = apply(State.initial(PUMA), PasteTable("a, alpha, d, theta\n0.5, pi/2, 0, q1 + 0.5"))
    editor = editor_of(Notation(angle="rad", length="m", variable="theta"))
    editor.show(state[RobotPart].robot.arm)
    assert 'value="1.5708"' in editor._form.fields.content
    assert 'value="0.5"' in editor._form.fields.content
    assert "θ₁" in editor._form.fields.content
