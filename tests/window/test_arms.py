"""The dialog over the scene, over the wire: all arms as pictures, narrowed down, chosen, and a new one made."""

import base64
import io
import re

import numpy as np
import pytest
from PIL import Image

from armlab.content.robots import FAMILIES, catalogue
from armlab.kin.dh import Row
from armlab.session.edits import NewArm, PasteTable
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State, apply
from armlab.ui.figure.picture import HEIGHT, WIDTH
from armlab.window.arms.choice import fits
from armlab.window.arms.draft import Draft
from support.student import run, student

PUMA = catalogue()["puma560"]


def dialog(browser):
    """Return the markup of the dialog; empty while there is none."""
    html = browser.html()
    start = html.find('class="al-dialog"')
    return html[start:] if start >= 0 else ""


def listed(browser):
    return [key for key in re.findall(r'data-cell="arm-(\w+)"', dialog(browser)) if not key.startswith("own")]


def name(browser):
    return re.search(r'class="arm-name"[^>]*><b>([^<]*)</b>', browser.html())[1]


async def opened(url, path="/"):
    browser = await student(url, path=path)
    await browser.press("arms")
    await browser.until(lambda: dialog(browser) != "")
    return browser


def test_the_arms_name_opens_all_arms_by_family_with_the_present_one_marked(url):
    async def main():
        browser = await opened(url)
        assert sorted(listed(browser)) == sorted(catalogue().robots)
        heads = re.findall(r"<section><h3>([^<]*)</h3>", dialog(browser))
        assert heads == [family[0].upper() + family[1:] for family in FAMILIES]
        current = re.findall(r'data-cell="arm-(\w+)"[^>]*aria-current="true"', dialog(browser))
        assert current == ["puma560"]
        assert dialog(browser).index('data-cell="arms-new"') < dialog(browser).index('data-cell="arm-')
        assert "6 joints · RRRRRR" in dialog(browser)
        assert PUMA.summary in dialog(browser)
        await browser.close()

    run(main())


def test_each_arm_gets_a_picture_of_its_own(url):
    async def main():
        browser = await opened(url)

        def pictures():
            return dict(re.findall(r"\.al-pic-(\w+)\{--pic:url\(data:image/png;base64,([^)]*)\)\}", browser.html()))

        await browser.until(lambda: len(pictures()) == len(catalogue().robots))
        for data in pictures().values():
            pixels = np.asarray(Image.open(io.BytesIO(base64.b64decode(data))))
            assert pixels.shape == (HEIGHT, WIDTH, 4)
            assert (pixels[..., 3] == 255).mean() > 0.02
        assert len(set(pictures().values())) >= len(pictures()) - 1  # one arm is there in two tables
        await browser.close()

    run(main())


def test_a_typed_text_narrows_the_arms_down_and_says_when_none_fits(url):
    async def main():
        browser = await opened(url)
        await browser.press("arms-find", "ur5")
        await browser.until(lambda: listed(browser) == ["ur5e"])
        assert "arms-new" not in dialog(browser)
        await browser.press("arms-find", "banana")
        await browser.until(lambda: "No arm was found" in dialog(browser))
        await browser.press("arms-find", "")
        await browser.until(lambda: len(listed(browser)) == len(catalogue().robots))
        await browser.close()

    run(main())


@pytest.mark.parametrize(
    ("asked", "found"),
    [
        ("PUMA", "puma560"),
        ("RRP", "polar_rrp"),
        ("7r", "panda"),
        ("7 joints", "gen3"),
        ("scara", "scara"),
        ("kuka", "iiwa7"),
    ],
)
def test_arms_are_found_by_name_joints_and_maker(asked, found):
    assert fits(catalogue()[found], asked)
    assert not all(fits(robot, asked) for robot in catalogue().robots.values())


def test_arms_are_found_by_the_words_of_their_files(robot):
    assert all(fits(robot, word) for word in robot.words)
    assert fits(catalogue()["ur10"], "universal robots 6R")


def test_arms_are_found_also_in_the_language_in_which_they_are_shown():
    assert fits(catalogue()["gen3"], "7 giunti", "it")
    assert fits(catalogue()["gen3"], "7 joints", "it")
    assert not fits(catalogue()["gen3"], "7 giunti")


def test_choosing_an_arm_puts_it_on_the_table_and_closes_the_dialog(url):
    async def main():
        browser = await opened(url)
        await browser.press("arm-scara")
        await browser.until(lambda: name(browser) == catalogue()["scara"].name)
        assert dialog(browser) == ""
        await browser.close()

    run(main())


def test_choosing_the_present_arm_only_closes_the_dialog(url):
    async def main():
        browser = await opened(url)
        await browser.press("arm-puma560")
        await browser.until(lambda: dialog(browser) == "")
        assert 'title="Nothing to undo"' in browser.html()
        await browser.close()

    run(main())


def test_a_lesson_that_keeps_its_arm_shows_the_name_and_says_why_it_is_no_switch(url):
    async def main():
        browser = await student(url, path="/lesson/ik_2r")
        await browser.until(lambda: "arm-name" in browser.html())
        assert 'data-cell="arms"' not in browser.html()
        assert "set by the lesson" in browser.html()
        assert "Two elbows for one point” is about this arm" in browser.html()
        await browser.close()

    run(main())


# -- a new arm -------------------------------------------------------------------------------------------------------


def test_a_new_arm_takes_over_nothing_of_the_arm_before(open_lab):
    """The Panda has a tool, limits of its own, a base and poses."""

    async def main(lab, url):
        browser = await opened(url, "/robot/panda")
        await browser.press("arms-new")
        await browser.press("new-add")
        await browser.press("new-2-kind P")
        await browser.press("new-2-d", "100")
        await browser.press("new-name", "  Mine  ")
        await browser.press("new-make")
        await browser.until(lambda: name(browser) == "Mine")
        (session,) = lab.store._live.values()
        robot = session.robot
        assert [row.kind for row in robot.arm.rows] == ["R", "R", "P"]
        assert [row.a for row in robot.arm.rows] == [0.5, 0.4, 0.0]
        assert robot.arm.rows[2].d == pytest.approx(0.1, abs=1e-15)
        np.testing.assert_array_equal(robot.arm.tool, np.eye(4))
        np.testing.assert_array_equal(robot.arm.base, np.eye(4))
        np.testing.assert_array_equal(robot.arm.limits, [[-np.pi, np.pi], [-np.pi, np.pi], [0.0, 1.0]])
        assert np.isinf(robot.arm.speed_limits).all()
        assert list(robot.poses) == ["home"]
        assert robot.arm.name == "Mine"
        assert dialog(browser) == ""
        await browser.press("undo")
        await browser.until(lambda: name(browser) == catalogue()["panda"].name)
        assert session.robot is catalogue()["panda"]
        await browser.close()

    running = open_lab()
    run(main(running.lab, f"http://127.0.0.1:{running.port}/"))


def test_without_a_name_it_is_my_arm_and_stands_among_the_arms_as_ones_own(url):
    async def main():
        browser = await opened(url)
        await browser.press("arms-new")
        await browser.press("new-make")
        await browser.until(lambda: name(browser) == "My arm")
        await browser.press("arms")
        await browser.until(lambda: "Your own" in dialog(browser))
        assert re.search(r'data-cell="arm-own\w+"[^>]*aria-current="true"', dialog(browser))
        await browser.close()

    run(main())


def test_a_row_that_cannot_be_read_says_so_where_it_stands_and_nothing_is_made(url):
    async def main():
        browser = await opened(url)
        await browser.press("arms-new")
        await browser.press("new-0-a", "long")
        await browser.press("new-1-alpha", "720")
        await browser.until(lambda: "joint 2: link twist" in dialog(browser))
        rows = dialog(browser).split("<tr>")
        first = next(i for i, row in enumerate(rows) if 'data-cell="new-0-a"' in row)
        assert "✕ joint 1: link length: expected a number in mm, got &#39;long&#39;" in rows[first + 1]
        assert (
            "✕ joint 2: link twist: expected a number in degrees from −360 to 360, got &#39;720&#39;" in rows[first + 3]
        )
        assert rows[first].count('aria-invalid="true"') == 1
        await browser.press("new-make")
        await browser.press("new-0-a", "0.3 m")
        await browser.until(lambda: "joint 1: link" not in dialog(browser))
        assert name(browser) == PUMA.name
        await browser.close()

    run(main())


def test_a_pasted_table_fills_the_rows_and_a_bad_one_is_refused_beside_it(url):
    async def main():
        browser = await opened(url)
        await browser.press("arms-new")
        await browser.press("new-paste", "a\talpha\td\ttheta\n0.3\t90\t0.2\tq1\n0\t0\tq2 + 0.1\t0\n0.1\tbanana\t0\tq3")
        await browser.until(lambda: "row 3, column alpha" in dialog(browser))
        await browser.press("new-paste", "a\talpha\td\ttheta\n0.3\t90\t0.2\tq1\n0\t0\tq2 + 0.1\t0\n0.1\t0\t0\tq3")
        await browser.until(lambda: 'data-cell="new-2-a"' in dialog(browser))
        values = dict(re.findall(r'value="([^"]*)"[^>]*data-cell="(new-\d-\w+)"', dialog(browser)))
        assert {cell: text for text, cell in values.items()}["new-0-a"] == "300"
        assert "column alpha" not in dialog(browser)
        await browser.press("new-make")
        await browser.until(lambda: name(browser) == "My arm")
        await browser.close()

    run(main())


def test_every_arm_of_the_lab_is_the_same_after_it_was_pasted_and_typed():
    """Written as CSV in degrees and metres, pasted, shown in mm and degrees, and read from there."""
    from armlab.content.write_table import write_table

    for robot in catalogue().robots.values():
        draft = Draft(Notation())
        draft.paste(write_table(robot.arm, "csv", "deg"))
        made = draft.command()
        assert made.convention == robot.arm.convention
        for row, own in zip(made.rows, robot.arm.rows, strict=True):
            assert row.kind == own.kind
            # Twelve digits are shown.
            np.testing.assert_allclose(
                [row.a, row.alpha, row.d, row.theta], [own.a, own.alpha, own.d, own.theta], rtol=1e-11, atol=1e-14
            )


def test_units_can_be_said_and_the_rows_to_begin_with_stay_the_same_arm():
    draft = Draft(Notation())
    draft.set_unit("length", "m")
    assert draft.rows[0].texts["a"] == "0.5"
    draft.write(0, "a", "2")
    draft.set_unit("angle", "rad")
    draft.write(1, "alpha", "pi/2")
    draft.write(1, "theta", "q2 + 0.5")
    draft.write(0, "alpha", "-3.1416")
    rows = draft.command().rows
    assert rows[0].alpha == -np.pi, "as a field shows it"
    assert rows[0].a == 2.0
    assert rows[1] == Row("R", a=0.4, alpha=np.pi / 2, theta=0.5)
    draft.set_unit("length", "mm")
    assert draft.command().rows[0].a == pytest.approx(0.002), "typed numbers are then in millimetres"


def test_what_is_wrong_in_a_row_is_said_anew_in_another_unit():
    draft = Draft(Notation())
    draft.set_unit("angle", "rad")
    draft.write(0, "alpha", "90")
    assert draft.rows[0].wrong == "link twist: expected a number in rad from −6.2832 to 6.2832, got '90'"
    draft.set_unit("angle", "deg")
    assert (draft.rows[0].wrong, draft.rows[0].where) == ("", "")
    draft.set_unit("angle", "rad")
    assert draft.rows[0].where == "alpha"


def test_the_row_of_a_flange_becomes_the_tool_in_the_convention_that_is_chosen():
    """A pasted table and a typed one make the same arm."""
    text = "i,a,alpha,d,theta\n1,0,0,0.3,q1\n2,0.4,90,0,q2\nFlange,0.1,90,0.2,0"
    draft = Draft(Notation())
    draft.paste(text)
    assert draft.convention == "modified"
    state = State.initial(catalogue()["puma560"])
    made, pasted = (apply(state, each)[RobotPart].robot.arm for each in (draft.command(), PasteTable(text)))
    np.testing.assert_allclose(made.tool, [[1, 0, 0, 0.1], [0, 0, -1, -0.2], [0, 1, 0, 0], [0, 0, 0, 1]], atol=1e-15)
    np.testing.assert_allclose(pasted.tool, made.tool)
    draft.convention = "standard"
    again = apply(state, draft.command())[RobotPart].robot.arm
    np.testing.assert_allclose(again.tool, [[1, 0, 0, 0.1], [0, 0, -1, 0], [0, 1, 0, 0.2], [0, 0, 0, 1]], atol=1e-15)


def test_an_empty_cell_is_zero_and_the_last_row_stays():
    draft = Draft(Notation())
    draft.remove(0)
    draft.remove(0)
    draft.write(0, "a", " ")
    assert draft.command() == NewArm((Row("R"),), "standard", "")


def test_there_are_no_more_rows_than_joints_an_arm_may_have():
    draft = Draft(Notation())
    for _ in range(30):
        draft.add()
    assert draft.command() is not None
    assert len(draft.command().rows) == 12
