"""The buttons of a jog as a page gets them, and what they ask for."""

import html
import math
import re
import time

import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.parts.jog import Ended, Jog, JogBy
from armlab.session.parts.joints import Joints, LockJoint, TakePose
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from armlab.ui.jog import ended_words, jog_markup
from armlab.ui.units import units_of
from support.forms import BareForm, asked
from support.student import run, settled, student


def opened(mode="", robot="puma560", *commands):
    state = State.initial(catalogue()[robot])
    for command in (Set(Jog, "mode", mode), *commands):
        state = apply(state, command)
    return state


def does(state, cell, text=""):
    return asked(lambda form: jog_markup(form, state), cell, text)


def text_of(state):
    form = BareForm()
    form.show(jog_markup(form, state))
    return html.unescape(re.sub(r"<[^>]*>", " ", str(form.fields.content)))


def test_a_mode_is_chosen_and_put_away_by_the_same_button():
    assert does(opened(), "jog-base") == (Set(Jog, "mode", "base"),)
    assert does(opened("base"), "jog-base") == (Set(Jog, "mode", ""),)
    assert does(opened("base"), "jog-tool") == (Set(Jog, "mode", "tool"),)
    assert does(opened(), "jog", "1:0,0,0,0,0,1") == ()


def test_what_the_page_sends_is_a_step_and_nonsense_is_refused():
    state = opened("joints")
    assert does(state, "jog", "17:0,0.5,0,0,0,-1") == (JogBy((0.0, 0.5, 0.0, 0.0, 0.0, -1.0), 17),)
    for text in ("", "17", "17:", "x:0,1", "17:0,a", "1.5:0"):
        with pytest.raises(InputError, match="jog: expected a number and parts of steps"):
            does(state, "jog", text)


def test_steps_are_chosen_in_the_units_on_screen_and_only_where_there_is_a_use_for_them():
    joints, tool = opened("joints"), opened("tool")
    assert does(joints, "jog-turn 0.1") == (Set(Jog, "turn", "0.1"),)
    assert does(joints, "jog-length 50") == ()
    assert does(tool, "jog-length 50") == (Set(Jog, "length", "50"),)
    assert does(opened("base", "cartesian_3p"), "jog-turn 5") == ()
    for unit in ("0.1°", "1°", "5°", "1 mm", "10 mm", "50 mm"):
        assert f" {unit} " in text_of(tool)
    other = opened("tool", "puma560", Set(Notation, "angle", "rad"), Set(Notation, "length", "m"))
    for unit in ("0.0017 rad", "0.0175 rad", "0.0873 rad", "0.001 m", "0.01 m", "0.05 m"):
        assert f" {unit} " in text_of(other)


def test_what_cannot_be_jogged_is_off():
    form = BareForm()
    form.show(jog_markup(form, opened("base", "planar_2r")))
    off = re.findall(r'data-cell="jog (\d) plus"[^>]* disabled', str(form.fields.content))
    assert off == ["2", "3", "4", "5"]
    form.show(jog_markup(form, opened("joints", "planar_2r", LockJoint(1, True))))
    assert re.findall(r'data-cell="jog (\d) minus"[^>]* disabled', str(form.fields.content)) == ["1"]
    assert "Joint 2 is held" in str(form.fields.content)


@pytest.mark.parametrize(
    ("mode", "ended", "says"),
    [
        ("joints", Ended(1, "limit", (0,)), "Joint 1 is at its limit of 160.0°."),
        ("joints", Ended(1, "held", (1, 2)), "Joint 2 and joint 3 are held."),
        ("tool", Ended(1, "limit", (0,)), "Joint 1 is at its limit of 160.0°: the tool cannot take this step."),
        ("base", Ended(1, "reach"), "Out of reach: the tool cannot take this step."),
        (
            "base",
            Ended(1, "singular", (3, 5)),
            "joint 4 and joint 6 would have to move by more than 20.0° in this step; choose smaller steps.",
        ),
    ],
)
def test_why_a_jog_ended_is_said_in_a_sentence(mode, ended, says):
    state = opened(mode)
    joints = state[Joints]
    q = joints.q.copy()
    q[0] = 2.7
    state = state.replace(joints.moved_to(q))
    assert says in ended_words(ended, state, units_of(state))


def test_beside_a_singularity_it_is_named():
    state = opened("tool", "planar_2r", TakePose("zero"))
    assert "Near an elbow singularity" in text_of(state)
    assert "singularity" not in text_of(opened("joints", "planar_2r", TakePose("zero")))
    words = ended_words(Ended(1, "singular", (1,)), state, units_of(state))
    assert words.startswith("Near an elbow singularity")


def test_a_page_jogs_a_joint_is_told_of_its_limit_and_takes_the_jog_back(url):
    async def main():
        browser = await student(url)
        await browser.press("jog-joints")
        await browser.press("jog-turn 5")
        await browser.until(lambda: 'data-jogs="6"' in browser.html())
        before, jog = browser.slider(1)["value"], time.time_ns() // 10**6
        for _ in range(3):
            await browser.press("jog", f"{jog}:1,0,0,0,0,0")
            await settled(browser)
        await browser.until(lambda: browser.slider(1)["value"] == pytest.approx(before + 15.0))
        await browser.press("undo")
        await browser.until(lambda: browser.slider(1)["value"] == pytest.approx(before))
        await browser.set_value(browser.slider(1), 158.0)
        await settled(browser)
        await browser.press("jog", f"{jog + 1}:1,0,0,0,0,0")
        await browser.until(lambda: "Joint 1 is at its limit of 160.0°." in browser.html())
        assert f'data-ended="{jog + 1}"' in browser.html()
        await browser.close()

    run(main())


def test_the_tool_is_jogged_on_the_page_of_the_target(url):
    async def main():
        browser = await student(url)
        await browser.open("target")
        await browser.press("jog-base")
        await browser.until(lambda: 'data-jogs="6"' in browser.html())
        before = browser.nodes["/target"]["position"]
        await browser.press("jog", "1:0,0,1,0,0,0")
        await browser.until(lambda: abs(browser.nodes["/target"]["position"][2] - before[2] - 0.01) < 1e-5)
        assert math.dist(browser.nodes["/target"]["position"][:2], before[:2]) < 1e-5
        await browser.close()

    run(main())
