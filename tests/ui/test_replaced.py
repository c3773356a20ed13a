"""An example that puts its own arm on the table says so, and undo brings the other back."""

import pytest

from armlab.benches.motion.plan.examples import TakeExample
from armlab.benches.target.solutions.state import TakePreset
from armlab.benches.velocity.statics.examples import EXAMPLES as STATICS
from armlab.benches.velocity.statics.examples import ChooseExample
from armlab.content.robots import catalogue
from armlab.session.edits import SetCell
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.session import Redo, Session, Undo
from armlab.session.state import State
from support.student import run, settled, student

WITH_ARM = next(key for key, example in STATICS.items() if example.robot != "puma560")


@pytest.mark.parametrize("command", [TakeExample("joint_or_line"), TakePreset("UR10"), ChooseExample(WITH_ARM)])
def test_the_arm_that_goes_is_noted_and_undo_brings_it_back(command):
    session = Session.fresh("token", catalogue()["puma560"])
    session.apply(SetCell(1, "a", 0.5), 0.0)
    own = session.state[RobotPart]
    session.apply(command, 1.0)
    assert session.state[RobotPart].replaced == own.robot.name
    session.apply(Undo(), 2.0)
    assert session.state[RobotPart] is own
    assert own.replaced == ""
    session.apply(Redo(), 3.0)
    assert session.state[RobotPart].replaced == own.robot.name
    session.apply(ChooseRobot("scara"), 4.0)
    assert session.state[RobotPart].replaced == ""


def test_an_example_about_the_arm_on_the_table_replaces_nothing_and_files_do_not_tell_of_it():
    state = State.initial(catalogue()["ur10e"])
    assert TakeExample("joint_or_line").apply(state)[RobotPart] is state[RobotPart]
    replaced = TakeExample("joint_or_line").apply(State.initial(catalogue()["scara"]))
    assert State.from_json(replaced.to_json(), replaced[RobotPart].robot)[RobotPart].replaced == ""


def test_the_page_says_it_once(url):
    async def main():
        browser = await student(url)
        await browser.open("motion")
        await browser.press("example", "joint_or_line")
        said = f"This example uses the {catalogue()['ur10e'].name}. Undo (Ctrl+Z) brings back the PUMA 560."
        await browser.until(lambda: said in browser.notices)
        await browser.press("undo")
        await browser.until(lambda: "/robot/puma560" in browser.html())
        await settled(browser)
        assert browser.notices.count(said) == 1
        await browser.close()

    run(main())
