"""What a lesson file can hold, read into a lesson."""

import numpy as np
import pytest

from armlab.content.actions import Move, MoveTarget, PlayFilm, SetCell, SetSwitch, TakeRobot, TypeAnswer, Wait
from armlab.content.lesson_file import parse_lesson
from armlab.content.observation import Observation
from armlab.content.robots import OWN
from armlab.errors import ContentError, InputError
from support.lesson_texts import RICH

PLAIN = """+++
title = "T"
chapter = "1"
teaches = []
robot = "planar_2r"
+++
## Step
"""


@pytest.fixture(scope="module")
def rich():
    return parse_lesson("rich", RICH)


def variants():
    return [parse_lesson("rich", RICH, variant=number) for number in range(1, 12)]


def test_the_front_matter(rich):
    assert (rich.key, rich.file, rich.title) == ("rich", "rich.md", "Two links of 0.4 m and 0.5 m")
    assert (rich.panel, rich.overlays, rich.hidden) == ("joints", ("frames",), ("ellipsoid", "trainer"))
    assert (rich.locked, rich.locked_joints) == (frozenset({"robot", "table"}), (2,))
    assert (rich.camera.azimuth_deg, rich.camera.elevation_deg, rich.camera.distance) == (-90, 60, 1.2)
    np.testing.assert_allclose(rich.target[:3, 3], [0.9, 0, 0], rtol=0, atol=1e-15)
    np.testing.assert_allclose(rich.start, np.radians([-30, 20]), rtol=0, atol=1e-15)
    assert rich.values == {"l1": 0.4, "l2": 0.5, "side": "left", "start": -30.0, "reach": 0.9}
    assert (rich.variant, rich.varies) == (0, True)


def test_an_arm_of_its_own(rich):
    assert rich.robot == OWN == rich.robot_used.key
    assert (rich.robot_used.name, rich.robot_used.family) == ("A left arm", "planar")
    assert [row.a for row in rich.robot_used.arm.rows] == [0.4, 0.5]
    assert rich.robot_used.arm.task.key == "xy"


def test_a_robot_of_the_lab():
    lesson = parse_lesson("plain", PLAIN)
    assert (lesson.robot, lesson.robot_used.name) == ("planar_2r", "Planar 2R")
    assert (lesson.camera, lesson.target, lesson.values, lesson.varies) == (None, None, {}, False)
    assert (lesson.locked, lesson.locked_joints, lesson.hidden) == (frozenset(), (), ())


def test_the_texts(rich):
    first, second = rich.steps
    assert '<output class="live" data-live="px">…</output>' in rich.intro_html
    assert '<output class="live" data-live="det J">…</output>' in rich.intro_html
    assert "it reaches 0.90 m to the left." in rich.intro_html
    assert "<mn>0.4</mn><mo>+</mo><mn>0.5</mn>" in first.html
    assert first.html.count("<math") == 3
    assert "<mn>60</mn>" in first.html
    assert "<output" not in first.html.split("Now")[0]
    assert second.html == '<pre><code class="language-python">reach = -0.4\n</code></pre>\n'
    assert [hint.count("<p>") for hint in first.hints] == [1, 1]
    assert first.reveal_html == "<p>It reaches 0.9 m.</p>\n"
    assert second.question.html.startswith("<p>How far does it reach to the left?")
    assert first.check.wrong[0].says == "<p>This is −0.1 m away: the arm is folded.</p>\n"
    assert second.question.wrong[0].says == "<p>This is the first link alone, 0.4 m.</p>\n"


def test_the_live_values_of_each_text_are_known(rich):
    assert rich.live == ("det J", "px")
    assert [step.live for step in rich.steps] == [("q1", "q2"), ("r",)]


def test_the_lines_of_the_steps(rich):
    lines = RICH.split("\n")
    assert [lines[step.line - 1] for step in rich.steps] == ["## Stretch it", "## Compute"]


def test_the_solutions(rich):
    first, second = rich.steps
    (move,) = first.solution
    assert first.check.judge(Observation.of(rich.robot_used.arm, move.q))[0]
    move, target, cell, switch, film, wait, answer = second.solution
    np.testing.assert_allclose(move.q, np.radians([10, 20]), rtol=0, atol=1e-15)
    assert isinstance(target, MoveTarget)
    np.testing.assert_allclose(target.T[:3, :2], [[0, -1], [1, 0], [0, 0]], rtol=0, atol=1e-15)
    assert cell == SetCell(1, "theta", float(np.radians(90)))
    assert (switch, film, wait) == (SetSwitch("frames", False), PlayFilm(), Wait(1.5))
    assert answer == TypeAnswer("0.9")
    assert second.question.judge(answer.text).right


def test_wrong_states_are_told(rich):
    step = rich.steps[0]
    met, says = step.check.judge(Observation.of(rich.robot_used.arm, step.check.wrong[0].q))
    assert not met
    assert "the arm is folded" in says


def test_every_variant_is_solved_by_its_own_solution_and_not_by_its_start():
    for lesson in variants():
        arm, (first, second) = lesson.robot_used.arm, lesson.steps
        assert first.check.judge(Observation.of(arm, first.solution[0].q))[0]
        assert not first.check.judge(Observation.of(arm, lesson.start))[0]
        assert second.question.judge(second.question.right_answer).right
        assert [row.a for row in arm.rows] == [lesson.values["l1"], lesson.values["l2"]]
    assert len({tuple(lesson.values.items()) for lesson in variants()}) > 6


def test_the_variant_is_kept_and_the_digest_is_that_of_the_file(rich):
    assert [lesson.variant for lesson in variants()] == list(range(1, 12))
    assert {lesson.digest for lesson in variants()} == {rich.digest}
    assert len(rich.digest) == 16
    assert parse_lesson("rich", RICH + "\n").digest != rich.digest
    assert parse_lesson("plain", PLAIN, variant=7).variant == 0
    with pytest.raises(InputError, match="variant"):
        parse_lesson("rich", RICH, variant=-1)


def test_live_values_in_code_are_text():
    html = parse_lesson("plain", PLAIN + "`{{q1}}` and\n\n    {{q9}}\n").steps[0].html
    assert "<output" not in html
    assert "{{q9}}" in html


def test_two_braces_that_are_no_name_are_text():
    assert "{{ 1, 2 }}" in parse_lesson("plain", PLAIN + "A set {{ 1, 2 }}").steps[0].html


PICTURES = {"arm.png": "data:image/png;base64,AAAA"}


def test_pictures_are_written_into_the_page():
    lesson = parse_lesson("plain", PLAIN + '![An *arm*](arm.png "title")', pictures=PICTURES)
    assert lesson.steps[0].html == '<p><img src="data:image/png;base64,AAAA" alt="An arm" title="title" /></p>\n'
    assert (
        lesson.digest
        != parse_lesson(
            "plain", PLAIN + '![An *arm*](arm.png "title")', pictures={"arm.png": "data:image/png;base64,BBBB"}
        ).digest
    )


@pytest.mark.parametrize(
    ("name", "pictures", "says"),
    [
        ("arm.png", None, "a lesson with pictures is a folder NAME with lesson.md and the pictures beside it"),
        ("amr.png", PICTURES, "unknown picture 'amr.png'; did you mean 'arm.png'"),
        ("../arm.png", PICTURES, r"unknown picture '\.\./arm.png'"),
        ("https://a.example/arm.png", PICTURES, "unknown picture 'https://a.example/arm.png'"),
        ("/etc/passwd", PICTURES, "unknown picture '/etc/passwd'"),
        ("arm.png", {}, "unknown picture 'arm.png'. Available: nothing"),
    ],
)
def test_pictures_that_are_not_there(name, pictures, says):
    with pytest.raises(ContentError, match=rf"plain\.md, line 9: step 1: .*{says}"):
        parse_lesson("plain", f"{PLAIN}Text\n![x]({name})", pictures=pictures)


def test_a_picture_of_the_page_itself_is_no_picture():
    html = parse_lesson("plain", PLAIN + "![x](data:image/png;base64,AAAA)", pictures=PICTURES).steps[0].html
    assert "<img" not in html


def test_a_solution_can_take_another_arm():
    block = (
        '```solution\n[[do]]\nkind = "robot"\nkey = "scara"\n[[do]]\nkind = "move"\nq_deg_m = [10, 20, 0.1, 30]\n```'
    )
    take, move = parse_lesson("plain", PLAIN + block).steps[0].solution
    assert take == TakeRobot("scara")
    assert isinstance(move, Move)
    np.testing.assert_allclose(move.q[[0, 1, 3]], np.radians([10, 20, 30]), rtol=0, atol=1e-15)
    with pytest.raises(
        ContentError, match=r"line 11: step 1\.solution\.do\[1\]\.key: unknown robot 'scar'; did you mean"
    ):
        parse_lesson("plain", PLAIN + block.replace('"scara"', '"scar"'))
