"""Broken lessons: every message has the file and the line, and nothing else than a message comes out."""

import numpy as np
import pytest

from armlab.content.lesson_file import parse_lesson
from armlab.content.lesson_lines import LessonError, key_lines, line_of
from armlab.errors import ContentError
from support.lesson_texts import RICH
from support.small_lessons import TWO_STEPS

BROKEN = [
    # old, new, a line of the broken file that the message must name, what it says
    ("+++\ntitle", "title", "title", r"expected a first line \+\+\+"),
    ("+++\nThe hand", "The hand", "last", r"expected a second line \+\+\+"),
    ("title =", "titel =", "", "title: missing; the file has titel, chapter"),
    ('panel = "joints"', 'panle = "joints"', "panle", "panle: unknown key; did you mean 'panel'"),
    ("[variants]\n", "[varaints]\n", "[varaints]", "varaints: unknown key; did you mean 'variants'"),
    ("[variants]\n", "[variant]\n", "[variant]", "variant: unknown key; did you mean 'variants'"),
    (
        'teaches = ["S4.0-2R", "S4.1-dh"]\n',
        "panle = 1\n",
        "panle",
        "panle: unknown key; did you mean 'panel'.*, variants",
    ),
    ("teaches = [", "teaches = 3 #", "teaches", "teaches: expected a list of texts, got 3"),
    ('"S4.0-2R"', '"two links"', "teaches", "teaches: unknown row of the inventory"),
    ('chapter = "2', "chapter = = 2", "chapter", "not valid TOML"),
    ('locked = ["robot"', 'locked = ["robbot"', "locked", r"locked\[1\]: unknown value 'robbot'; did you mean 'robot'"),
    (
        "locked_joints = [2]",
        "locked_joints = [3]",
        "locked_joints",
        r"locked_joints\[1\]: expected a whole number from 1",
    ),
    ("locked_joints = [2]", "locked_joints = [1.5]", "locked_joints", r"locked_joints\[1\]: expected a whole number"),
    ('hidden = ["ellipsoid"', "hidden = [1", "hidden", "hidden: expected a list of texts"),
    ('panel = "joints"', 'panel = "joints"\npose = "home"', "q_deg", "q_deg: expected one of pose and q_deg"),
    ('"= start", 20]', '"= start", 200]', "q_deg", "q_deg: outside the joint limits of A left arm"),
    ('"= start", 20]', '"= strat", 20]', "q_deg", r"q_deg\[1\]: unknown name 'strat'; did you mean 'start'"),
    ("rpy_deg = [0, 0, 90]\n\n[camera]", "rpy = [0, 0, 9]\n\n[camera]", "rpy = ", "target.rpy: the unit belongs"),
    ("distance = 1.2", "distance = 0", "distance", "camera.distance: expected a positive number"),
    ("elevation_deg = 60\n", "", "[camera]", "camera.elevation_deg: missing"),
    ("step = 0.1", "step = -0.1", "l1 = {", "variants.l1.step: expected a positive number"),
    ('reach = "l1 + l2"', 'reach = "l1 + l3"', "reach = ", "variants.reach: unknown name 'l3'"),
    (
        'reach = "l1 + l2"',
        'reach = "l1 / (l2 - l2)"',
        "reach = ",
        "variants.reach: it has no value in variant 0: .*division by zero",
    ),
    ('title = "Two', 'robot = "planar_2r"\ntitle = "Two', "robot = ", "robot: expected either a robot of the lab or"),
    ('convention = "standard"', 'convention = "craig"', "convention", "arm.convention: unknown value 'craig'"),
    ('a = "= l2"', 'aa = "= l2"', "aa = ", r"arm.joints\[2\].aa: unknown key"),
    ('task = "xy"', 'task = "xyw"', "task", "arm.task: unknown value 'xyw'"),
    ('a = "= l1"\nlimits_deg', 'a = "= l1"\nlimits', "limits = ", r"arm.joints\[1\].limits: the unit belongs"),
    ("{{px}}", "{{p_x}}", "The hand is at", r"introduction: unknown live value 'p_x'; did you mean 'px'\? Available: "),
    (
        "{{px}}",
        "{{q3}}",
        "The hand is at",
        "introduction: the live value 'q3' is not there for this arm: the arm has 2",
    ),
    ("{{px}}", "{{px", "The hand is at", r"introduction: expected \}\} after \{\{px, the determinant"),
    ("{{=reach : .2f}}", "{{=reech : .2f}}", "The hand is at", "unknown name 'reech'; did you mean 'reach'"),
    ("{{=reach : .2f}}", "{{=reach : 2q}}", "The hand is at", "expected a form such as .2f"),
    ("{{=reach : .2f}}", "{{=side : .2f}}", "The hand is at", "'left' is a text and takes no form"),
    ("$p_x = ", "$p_x = {{q1}} ", "Turn joint 2", r"step 1: \{\{q1\}\} is a live value and cannot stand in a formula"),
    ("Now $q_2$", "Now $\\foo$", "Now ", r"step 1: the formula \$\\foo\$ has an unknown command"),
    ("Now $q_2$", "![x](y.png) $q_2$", "![x]", "step 1: the picture 'y.png' cannot be shown"),
    ("## Stretch it", "## Stretch {{q1}}", "## Stretch", "step 1: expected a title without live values"),
    ("## Stretch it", "##", "##", "step 1: expected a title after ##"),
    ("```reveal", "```check", "```check", "step 1.check: expected one in a step"),
    ("```hint\nSet", "```hnit\nSet", "```hnit", "step 1: unknown block 'hnit'; did you mean 'hint'"),
    ("Joint 1 is at {{q1}}", "Joint 1 is at\n{{z1}}", "{{z1}}", "step 1.hint: unknown live value 'z1'"),
    ("It reaches {{=reach}} m.", "It\nreaches $\\x$.", "reaches $", r"step 1.reveal: the formula \$\\x\$"),
    ('kind = "tool_at"\nposition = ["= r', 'kind = "tol_at"\nposition = ["= r', "tol_at", "step 1.check.kind: unknown"),
    ('position = ["= reach", 0', 'position = ["= 9 reach", 0', "9 reach", "step 1.check.position: it is 7.200 m out"),
    ("This is {{=l1 - l2}} m away", "This is {{=l9}} m away", "l9", r"step 1.check.wrong\[1\].says: unknown name 'l9'"),
    ("This is {{=l1 - l2}} m away", "This is {{foo}}", "{{foo}}", r"step 1.check.wrong\[1\].says: unknown live value"),
    ("q_deg = [0, 180]", "q_deg = [0, 999]", "999", r"step 1.check.wrong\[1\].q_deg: outside the joint limits"),
    ('answer = "= reach"', 'answer = "far"', "far", "step 2.question.answer: expected a number"),
    ('unit = "m"', 'unit = "furlong"', "furlong", "step 2.question.unit: unknown value 'furlong'"),
    ("It is {{r}} away", "It is {{rr}} away", "{{rr}}", "step 2.question.text: unknown live value 'rr'"),
    ('answer = "= l1"', 'answer = "= reach"', 'answer = "= reach"', r"step 2.question.wrong\[1\].answer: .* too close"),
    ("q_deg = [0, 0]", "q_deg = [0, 0", "```solution", "step 1.solution: not valid TOML"),
    ("q_deg = [0, 0]", "q_deg = [0]", "q_deg = [0]", "step 1.solution.q_deg: expected 2 numbers"),
    ("q_deg = [0, 0]", "", "```solution", "step 1.solution.do: expected q_deg, q_m or q_deg_m, or 1 to 100"),
    ("q_deg = [10, 20]", "q_deg = [10, 200]", "200", r"step 2.solution.do\[1\].q_deg: outside the joint limits"),
    ("position = [0.5, 0.2, 0]\n", "", "[[do]]", r"step 2.solution.do\[2\].position: missing"),
    ("row = 2", "row = 0", "row = 0", r"step 2.solution.do\[3\].row: expected a whole number from 1 to 2, got 0"),
    (
        'field = "theta_deg"',
        'field = "theta"',
        "field",
        r"step 2.solution.do\[3\].field: unknown value 'theta'; did you",
    ),
    ("on = false", 'on = "no"', "on = ", r"step 2.solution.do\[4\].on: expected true or false, got 'no'"),
    ('kind = "film"', 'kind = "film"\nkey = "x"', 'key = "x"', r"step 2.solution.do\[5\].key: unknown key"),
    ("seconds = 1.5", "seconds = -1", "seconds", r"step 2.solution.do\[6\].seconds: expected more than 0"),
    ('text = "= reach"', "text = true", "text = true", r"step 2.solution.do\[7\].text: expected the answer as typed"),
    ("## ", "# ", "last", "expected at least one step"),
]


def expected_lines(text, marker):
    lines = text.split("\n")
    if marker == "last":
        return {len(lines), len(lines) - 1}
    return {i for i, line in enumerate(lines, start=1) if marker in line} if marker else {1}


@pytest.mark.parametrize(("old", "new", "marker", "says"), BROKEN)
def test_the_line_and_the_problem_are_named(old, new, marker, says):
    assert old in RICH
    text = RICH.replace(old, new)
    with pytest.raises(LessonError, match=rf"^rich\.md, line \d+: {says}") as raised:
        parse_lesson("rich", text)
    assert raised.value.line in expected_lines(text, marker), str(raised.value)
    assert raised.value.file == "rich.md"


def test_there_are_enough_of_them():
    assert len(BROKEN) > 50


def test_a_reveal_needs_something_to_do():
    text = RICH[: RICH.index("```check")] + "```reveal\nSeen.\n```\n"
    with pytest.raises(LessonError, match=r"step 1\.reveal: expected a check or a question") as raised:
        parse_lesson("rich", text)
    assert text.split("\n")[raised.value.line - 1] == "```reveal"


UNCLOSED = [
    # what stands before the end of the block that is not closed, its first line, the block swallowed, where
    ("Set $q_1 = 0$.\n", "```hint\nSet", "reveal", "step 1.hint"),
    ("It reaches {{=reach}} m.\n", "```reveal", "solution", "step 1.reveal"),
    ("q_deg = [0, 180]\n", "```check", "hint", "step 1.check"),
    ("reach = {{=-l1}}\n", "```python", "question", "step 2"),
]


@pytest.mark.parametrize(("last", "first", "inner", "where"), UNCLOSED)
def test_a_block_that_swallows_the_next_one_is_told_at_its_own_first_line(last, first, inner, where):
    text = RICH.replace(f"{last}```\n", last)
    assert text != RICH
    says = rf"{where}: a block '{inner}' begins inside this one; is its closing ``` missing\?$"
    with pytest.raises(LessonError, match=says) as raised:
        parse_lesson("rich", text)
    assert raised.value.line == text[: text.index(first)].count("\n") + 1


def test_a_block_of_the_introduction_that_swallows_the_first_step_is_told():
    text = RICH.replace("## Stretch it", "```text\n\n## Stretch it")
    with pytest.raises(LessonError, match="introduction: a block 'check' begins inside"):
        parse_lesson("rich", text)


STEPS = RICH[: RICH.index("```", RICH.index("## "))] + "BLOCK\n\n## Two\n\nWords.\n\n"
"""The first step ends with a block."""


@pytest.mark.parametrize(
    ("block", "between", "end", "says"),
    [
        ("```hint\nLook.", "", "", "step 1.hint: the block goes on to the end of the file"),
        ("```hint\nLook.", "", "\n\n", "step 1.hint: the block goes on to the end of the file"),
        ("```hint", "```\nx\n```\n\n", "", "step 1.hint: the step 'Two' begins inside this one"),
        ("```python\nx = 1", "", "", "step 1: the block goes on to the end of the file"),
        ("~~~~reveal\nx", "", "\n```", "step 1.reveal: the block goes on to the end of the file"),
    ],
)
def test_a_block_without_its_end_swallows_no_steps(block, between, end, says):
    with pytest.raises(LessonError, match=rf"{says}; is its closing (```|~~~~) missing\?$"):
        parse_lesson("rich", f"{STEPS.replace('BLOCK', block)}{between}## Three\n\nMore.{end}")


@pytest.mark.parametrize(
    "block",
    ["```text\n## Title\n```", "````hint\n```python\n## A remark\n```\n````", "```hint\n```", "- ```\n  x\n  ```"],
)
def test_a_heading_in_a_block_of_code_begins_no_step(block):
    assert len(parse_lesson("rich", STEPS.replace("BLOCK", block)).steps) == 2


def test_a_block_is_shown_on_purpose_between_longer_fences():
    shown = "````text\n```hint\nLook.\n```\n````\n\n```python"
    assert "```hint" in parse_lesson("rich", RICH.replace("```python", shown)).steps[1].html


# --- Lines of keys

TOML = '''a = 1
"b" = """
c = 3
"""
[d]
e.f = 1
[[g]]
h = 1
[[g.i]]
j = 1
[[g.i]]
j = 2
[[g]] # x
[g.k]
l = [1,
  2]
'''


@pytest.mark.parametrize(
    ("path", "line"),
    [
        ("a", 1),
        ("b", 2),
        ("c", 0),
        ("d", 5),
        ("d.e.f", 6),
        ("d.x", 5),
        ("g", 7),
        ("g[1].h", 8),
        ("g[1].i[2].j", 12),
        ("g[2].k.l[2]", 15),
        ("g[2].k.x.y", 14),
        ("g[2].h", 13),
        ("g[3]", 7),
        ("", 0),
    ],
)
def test_lines_of_keys(path, line):
    assert line_of(TOML, path) == line


def test_every_key_of_a_lesson_has_its_line():
    front = RICH.split("+++")[1]
    lines = front.split("\n")
    for path, line in key_lines(front).items():
        assert path.split(".")[-1].split("[")[0] in lines[line - 1]


# --- Noise

PIECES = [
    *(
        "+++",
        "##",
        "```",
        "```check",
        "```hint",
        "$",
        "$$",
        "{{",
        "}}",
        "{{=",
        "{{q1}}",
        "[[wrong]]",
        "[[do]]",
        "[",
        "]",
    ),
    *('"', "'", '"""', "=", "= l1", "\\", "\n", "-", "1e308", "1e-308", "nan", "inf", "9" * 30, "true", "{", "}", "#"),
    *(
        "\0",
        "\u2028",
        "\ud7ff",
        "½",
        "|",
        "<script>",
        "![x](y.png)",
        "1979-05-27",
        "kind",
        "position",
        "q_deg",
        "all_of",
    ),
]


def mutated(rng):
    text = RICH
    for _ in range(int(rng.integers(1, 3))):
        i, j = sorted(int(k) for k in rng.integers(0, len(text), 2))
        j = min(j, i + int(rng.integers(0, 40)))
        way = int(rng.integers(4))
        if way == 0:
            text = text[:i] + text[j:]
        elif way == 1:
            text = text[:i] + str(rng.choice(PIECES)) + text[j if rng.random() < 0.5 else i :]
        elif way == 2:
            text = text[:i] + text[i:j] * 2 + text[j:]
        else:
            k = int(rng.integers(0, len(text)))
            text = text[:i] + text[k : k + 30] + text[j:]
    return text


def test_mutations_give_a_lesson_or_a_named_mistake():
    rng = np.random.default_rng(4)
    good, mistakes = 0, []
    for _ in range(400):
        text = mutated(rng)
        try:
            lesson = parse_lesson("rich", text, variant=int(rng.integers(3)))
        except ContentError as error:
            mistakes.append((error, len(text.splitlines())))
        else:
            assert lesson.steps
            good += 1
    assert all(str(error).startswith("rich.md, line ") for error, _ in mistakes)
    assert all(1 <= error.line <= lines + 1 for error, lines in mistakes)
    assert len(mistakes) > 100
    assert good > 40


def test_too_many_steps_are_told_at_once():
    text = TWO_STEPS + "".join(f"## Step {i}\nText.\n" for i in range(20_001))
    with pytest.raises(ContentError, match="expected at most 200 steps, got 20004") as found:
        parse_lesson("many", text)
    assert found.value.line == text.splitlines().index("## Step 197") + 1
