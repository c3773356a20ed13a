"""The format of lessons, their checks and questions, and the lessons themselves."""

import math
import re
import tomllib
from pathlib import Path

import numpy as np
import pytest

from armlab import check_lesson, resources
from armlab.content.check import check_types
from armlab.content.lesson_folder import sources_of
from armlab.content.lessons import folders_of_the_lab, lessons, parse_lesson
from armlab.content.lessons import lesson as variant_of
from armlab.content.observation import Observation
from armlab.content.quantities import read_quantity
from armlab.content.questions.matrix import MatrixQuestion
from armlab.content.questions.number import NumberQuestion
from armlab.content.robots import catalogue
from armlab.errors import ContentError, InputError
from armlab.teaching.plain_text import plain

FRONT = """+++
title = "A lesson"
chapter = "1 Introduction"
teaches = ["S4.0-2R"]
robot = "planar_2r"
+++
"""
STEP = """
## Do something

Text.
"""
POINT = """
```check
kind = "tool_at"
position = [1, 1, 0]
tolerance_m = 0.02
```
"""


def lesson(body=STEP, front=FRONT):
    return parse_lesson("made_up", front + body)


def front(line):
    return FRONT.replace('robot = "planar_2r"', f'robot = "planar_2r"\n{line}')


def seen(q_deg, robot="planar_2r"):
    return Observation.of(catalogue()[robot].arm, np.radians(q_deg))


# --- The lessons that come with the lab


def test_no_lesson_is_broken():
    assert lessons().problems == ()
    assert len(lessons().lessons) >= 8


def test_the_numbers_of_the_first_lesson_are_those_of_the_arm():
    question = lessons()["first_arm"].steps[2].question
    x, y, _ = catalogue()["planar_2r"].arm.position(np.radians([90, -60]))
    assert abs(x - float(question.right_answer.split()[0])) < 1e-4
    forgot_the_sum, is_y, in_radians = (float(wrong.typed.split()[0]) for wrong in question.wrong)
    assert math.isclose(forgot_the_sum, math.cos(math.radians(90)) + math.cos(math.radians(-60)), abs_tol=1e-12)
    assert math.isclose(is_y, y, abs_tol=1e-12)
    assert math.isclose(in_radians, math.cos(90) + math.cos(90 - 60), abs_tol=1e-3)


def test_every_fenced_example_of_the_readme_is_valid():
    text = (resources.folder("lessons") / "README.md").read_text(encoding="utf-8")
    example = text.split("````markdown\n")[1].split("````")[0]
    parsed = lesson(example)
    assert parsed.steps[0].check.check.is_met(seen([0, 0]))
    assert parsed.steps[0].question.judge("2").right
    for kind in check_types():
        assert f"`{kind}`" in text


def test_the_wheel_takes_the_lessons():
    project = tomllib.loads((Path(resources.checkout()) / "pyproject.toml").read_text(encoding="utf-8"))
    assert project["tool"]["hatch"]["build"]["targets"]["wheel"]["force-include"]["lessons"] == "armlab/_data/lessons"


@pytest.mark.parametrize("key", [source.key for place in folders_of_the_lab() for source in sources_of(place)[0]])
def test_three_digits_of_the_right_answer_are_enough_where_no_number_of_them_is_asked_for(key):
    for number in range(4):
        for step in variant_of(key, number).steps:
            if isinstance(step.question, NumberQuestion | MatrixQuestion) and "decimal" not in step.html:
                rows = np.atleast_2d(step.question.answer).tolist()
                text = "; ".join(" ".join(f"{x:.0f}" if abs(x) >= 100 else f"{x:.3g}" for x in row) for row in rows)
                assert step.question.judge(text).right, f"variant {number}, {step.title}: {text}"


# --- The format


def test_what_a_lesson_holds():
    text = front('panel = "joints"\noverlays = ["frames", "names"]\nq_deg = [10, 20]\n[target]\nposition = [1, 0, 0]')
    parsed = lesson(f"Hello $q_1$.\n{STEP}{POINT}\n## Two\n\n    ## no heading\n\n```python\n## neither\n```\n", text)
    assert (parsed.key, parsed.title, parsed.chapter) == ("made_up", "A lesson", "1 Introduction")
    assert (parsed.teaches, parsed.robot) == (("S4.0-2R",), "planar_2r")
    assert (parsed.panel, parsed.overlays) == ("joints", ("frames", "names"))
    np.testing.assert_allclose(parsed.start, np.radians([10, 20]), rtol=0, atol=1e-15)
    np.testing.assert_array_equal(parsed.target[:3, 3], [1, 0, 0])
    assert parsed.intro_html.startswith("<p>Hello <span")
    assert [step.title for step in parsed.steps] == ["Do something", "Two"]
    assert parsed.steps[0].html == "<p>Text.</p>\n"
    assert parsed.steps[0].check.check.is_met(seen([0, 90]))
    assert parsed.steps[1].check is None
    assert parsed.steps[1].html.count("##") == 2


def test_the_start_is_the_first_pose_unless_it_is_given():
    np.testing.assert_array_equal(lesson().start, catalogue()["planar_2r"].home)
    np.testing.assert_allclose(lesson(front=front('pose = "right angle"')).start, [0, np.pi / 2], rtol=0, atol=1e-15)
    with pytest.raises(ValueError, match="read-only"):
        lesson(front=front("q_deg = [1, 2]")).start[0] = 0.0


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ('robott = "x"', "robott: unknown key; did you mean 'robot'"),
        ('pose = "rigth angle"', "pose: unknown value 'rigth angle'; did you mean 'right angle'"),
        ("q_deg = [10]", "q_deg: expected 2 numbers in brackets"),
        ("q_m = [10, 2]", "q_deg: missing"),
        ("q_deg = [500, 0]", "q_deg: outside the joint limits of Planar 2R"),
        ('pose = "home"\nq_deg = [1, 2]', "q_deg: expected one of pose and q_deg"),
        ("overlays = [1]", r"overlays: expected a list of texts, got \[1\]"),
        ("[target]\nplace = [1, 0, 0]", r"target\.place: unknown key"),
        ("x = = 1", "not valid TOML: .* line 6"),
    ],
)
def test_mistakes_in_the_front_matter(line, says):
    with pytest.raises(ContentError, match=rf"made_up\.md, line \d+: {says}"):
        lesson(front=front(line))


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("# No front matter", r"expected a first line \+\+\+"),
        ("+++\ntitle = 'x'\n", r"expected a second line \+\+\+"),
        (FRONT, "expected at least one step"),
        (
            f"{FRONT}\n```hint\nLook.\n```\n\n## One\n",
            r"introduction: expected a block 'hint' in a step, after its '## Title'",
        ),
        (FRONT.replace("planar_2r", "planar2r") + STEP, "robot: unknown robot 'planar2r'; did you mean 'planar_2r'"),
        (FRONT.replace("S4.0-2R", "two links") + STEP, "teaches: unknown row of the inventory"),
        (FRONT.replace('title = "A lesson"', "") + STEP, "title: missing"),
        (FRONT + STEP + "$\\foo$", r"step 1: the formula \$\\foo\$ has an unknown command"),
        (FRONT + "$\\foo$" + STEP, r"introduction: the formula \$\\foo\$ has an unknown command"),
        (FRONT + STEP + "```chek\n```", "step 1: unknown block 'chek'; did you mean 'check'"),
        (FRONT + STEP + POINT + POINT, "step 1.check: expected one in a step"),
        (FRONT + STEP + STEP + POINT.replace("tool_at", "tool_on"), "step 2.check.kind: unknown value 'tool_on'; did"),
        (FRONT + STEP + POINT.replace("tolerance_m", "tolerance"), "step 1.check.tolerance: the unit belongs into"),
        (FRONT + STEP + POINT.replace("kind", "knid"), "step 1.check.kind: missing"),
        (FRONT + STEP + POINT.replace("[1,", "[1,,"), "step 1.check: not valid TOML: .* line 14"),
        (FRONT + STEP + POINT.replace("[1,", "[3,"), r"step 1.check.position: it is 1\.162 m out of the reach of Plan"),
        (FRONT + STEP + POINT.replace("0.02", "0"), "step 1.check.tolerance_m: expected a positive number, got 0"),
    ],
)
def test_mistakes_in_a_lesson(text, says):
    with pytest.raises(ContentError, match=rf"made_up\.md, line \d+: {says}"):
        parse_lesson("made_up", text)


def test_the_line_of_a_mistake_is_that_of_the_file():
    text = FRONT + STEP + POINT.replace("[1,", "[1,,")
    line = next(i for i, line in enumerate(text.split("\n"), start=1) if "[1,," in line)
    with pytest.raises(ContentError, match=f"at line {line},"):
        parse_lesson("made_up", text)


def test_a_file_name_that_is_no_key():
    with pytest.raises(ContentError, match="expected a file name of lower-case letters"):
        parse_lesson("First Arm", FRONT + STEP)


# --- Questions in lessons

QUESTION = '\n```question\nkind = "number"\ntext = "How **far**?"\nanswer = 0.5\nunit = "m"\ntolerance = 0.01\n```\n'


def test_a_question_in_a_lesson():
    question = lesson(STEP + QUESTION).steps[0].question
    assert question.html == "<p>How <strong>far</strong>?</p>\n"
    assert question.judge("49.5 cm").right


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ('unit = "m"', 'unit = "metre"', "unit: unknown value 'metre'"),
        ("answer = 0.5", "", "answer: missing"),
        ("0.01", "-1", "tolerance: expected a positive number"),
        ('"number"', '"text"', "kind: unknown value 'text'"),
        ("0.01", '0.01\n[[wrong]]\nanswer = 0.51\nsays = "x"', r"wrong\[1\].answer: 0.51 is too close to the right"),
        ("0.01", '0.01\n[[wrong]]\nanswer = 1\nsays = "$\\\\foo$"', r"wrong\[1\].says: the formula"),
        ("0.01", '0.01\n[[wrong]]\nanswer = 1\nsay = "x"', r"wrong\[1\].says: missing"),
    ],
)
def test_mistakes_in_questions(old, new, says):
    with pytest.raises(ContentError, match=rf"made_up\.md, line \d+: step 1.question.{says}"):
        lesson(STEP + QUESTION.replace(old, new))


@pytest.mark.parametrize(
    ("kind", "right", "wrong", "mistake"),
    [("number", "2", '"= 4 - x"', "3"), ("matrix", "[[2, 1]]", '[["= 4 - x", 1]]', "3 1")],
)
def test_a_mistake_that_is_right_by_chance_in_a_variant_does_not_close_the_lesson(kind, right, wrong, mistake):
    asked = (
        f'kind = "{kind}"\ntext = "?"\nanswer = {right}\ntolerance = 0.01\n[[wrong]]\nanswer = {wrong}\nsays = "No."'
    )
    front = FRONT.removesuffix("+++\n") + "[variants]\nx = { choose = [1, 2] }\n+++\n"
    text = f"{front}{STEP}\n```question\n{asked}\n```\n"
    drawn = [parse_lesson("made_up", text, variant=number) for number in range(12)]
    assert {each.values["x"] for each in drawn} == {1, 2}
    for each in drawn:
        question = each.steps[0].question
        assert question.judge(question.right_answer).right
        assert question.judge(mistake).name == "wrong[1]" or each.values["x"] == 2
    with pytest.raises(ContentError, match="too close to the right answer"):
        parse_lesson("made_up", text.replace("[1, 2]", "[2, 1]"))
    with pytest.raises(ContentError, match="too close to the right answer"):
        parse_lesson("made_up", text.replace("choose = [1, 2]", "choose = [2]"), variant=3)


def test_a_toggle_press_is_told_as_it_is_asked():
    """The torque in the text has the sign of the answer, and both are those of the arm."""
    found = next(step for step in lessons()["statics"].steps if step.title == "Slow is strong")
    arm = lessons()["statics"].robot_used.arm
    before, after = (float(arm.jacobian(np.radians(q))[0, 1] * 100.0) for q in ([-5.0, 10.0], [-2.0, 4.0]))
    assert f"{before:.2f}".replace("-", "\u2212") in plain(found.html).replace("-", "\u2212")
    assert found.question.answer == pytest.approx(after, abs=0.005)


@pytest.mark.parametrize(("elbow", "met"), [(0.0, True), (2.0, True), (-2.0, True), (4.0, False), (180.0, False)])
def test_the_arm_that_pushes_along_itself_is_stretched(elbow, met):
    """The folded arm is singular as well, but it is not the one that is asked for."""
    number = next(i for i, step in enumerate(lessons()["statics"].steps, start=1) if step.title == "Along the arm")
    for turn in (0.0, 33.0):
        assert check_lesson("statics", np.radians([turn, elbow]), number)[0] is met


def test_the_joint_speed_near_a_singularity_is_right_to_its_last_digit():
    found = lessons()["singularities"]
    q = found.start.copy()
    q[1] = np.radians(6.0)
    smallest = np.linalg.svd(found.robot_used.arm.jacobian(q)[:2], compute_uv=False)[-1]
    assert found.steps[-1].question.answer == pytest.approx(0.1 / smallest, abs=5e-4)


METRES = re.compile(r"\\text\{m\}|(\d|\}\}|\)) m\b|unit = \"m\"|in metres")
LENGTH = re.compile(r"\{\{(p[xyz]|r)\}\}")


def test_a_length_in_a_step_about_metres_is_in_metres():
    """On a screen in millimetres, too: a number with another unit beside it would be another number."""
    sources, _ = sources_of(resources.folder("lessons"))
    steps = [
        (source.file, step) for source in sources for step in re.split("^## ", source.read()[0], flags=re.MULTILINE)
    ]
    assert len(steps) > 500
    assert [file for file, step in steps if LENGTH.search(step) and METRES.search(step)] == []


IN_A_FILE = re.compile(r"^```question\n(.*?)^```", re.MULTILINE | re.DOTALL)
NAMED = re.compile(r"(?<!lengths )\bin (metres per radian|m/s per rad/s|N m|N s/m|[^\s,;:?)]+)")
IN_WORDS = {"metres per radian": "m/rad", "metres": "m", "m/s per rad/s": "m/rad", "radians": "rad", "percent": "%"}


def units_named(text):
    """Return the units after the word in: of "$\\alpha$, in rad/s²" one."""
    for found in NAMED.finditer(re.sub(r"\$|\\text|\\,|[{}]", "", text)):
        word = found[1]
        try:
            yield read_quantity(f"1 {IN_WORDS.get(word, word)}")[1]
        except InputError:
            continue


def test_a_question_that_names_a_unit_takes_it():
    """A student who types the unit that the text names must not be told that it cannot be read."""
    sources, _ = sources_of(resources.folder("lessons"))
    whole = [(source.file, source.read()[0]) for source in sources]
    asked = [(file, tomllib.loads(found[1])) for file, text in whole for found in IN_A_FILE.finditer(text)]
    numbers = [(file, each) for file, each in asked if each["kind"] in ("number", "matrix")]
    named = [(file, each, set(units_named(each["text"]))) for file, each in numbers]
    # A matrix with entries of two kinds has no unit of its own.
    alone = [(file, each["text"], each.get("unit"), units.pop()) for file, each, units in named if len(units) == 1]
    assert len(alone) > 25
    assert [each for each in alone if each[2] != each[3]] == []


COUNTED = re.compile(r"\b[Tt]he (first|second|third|fourth|fifth|last) (candidate|condition|option|answer)s?\b")


def choices_counted_in_another_order(text):
    """Yield the steps of a lesson, from 1, whose options are counted there or later and stand in no fixed order."""
    head, _, body = text.partition("\n+++\n")
    steps = re.split("^## ", body, flags=re.MULTILINE)[1:] if "[variants]" in head else []
    counting = [number for number, step in enumerate(steps, start=1) if COUNTED.search(step)]
    for number, step in enumerate(steps[: max(counting, default=0)], start=1):
        questions = [tomllib.loads(found) for found in IN_A_FILE.findall(step)]
        if any(each["kind"] == "choice" and not each.get("fixed") for each in questions):
            yield number


def test_options_that_are_counted_stand_in_the_order_of_the_file():
    """Else the first candidate of a hint is another one on the screen of most variants."""
    sources, _ = sources_of(resources.folder("lessons"))
    found = {source.file: list(choices_counted_in_another_order(source.read()[0])) for source in sources}
    assert {file: numbers for file, numbers in found.items() if numbers} == {}
