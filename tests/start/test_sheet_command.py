"""``armlab lesson sheet``, as a teacher types it."""

import math
import re

import numpy as np
import pytest

from armlab.cli import main
from armlab.commands._found import Place
from armlab.commands._lesson_sheet import names_of, numbers_of
from armlab.commands._sheet import escaped
from armlab.commands._sheet_answers import right_answer
from armlab.commands._sheet_bench import FROM_ZERO, bench_words
from armlab.content import lessons as library_module
from armlab.content.bench_words import BenchWord
from armlab.content.question import Choices
from armlab.content.questions.matrix import MatrixQuestion
from armlab.errors import ArmlabError
from armlab.session.words import pages_with_words, words_of
from support.motion_lesson import MOTION
from support.small_lessons import VARIED


def one_line(err):
    return err.count("\n") == 1 and "Traceback" not in err


def test_a_sheet_has_a_row_a_variant(typed, work):
    status, out, err = typed("lesson", "sheet", "mine/v.md", "--variants", "0-2,7")
    assert (status, err) == (0, "")
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in out.splitlines() if line.startswith("|")]
    assert rows[0] == ["variant", "`goal`", "1 do", "2 answer", "3 answer"]
    assert [row[0] for row in rows[2:]] == ["0", "1", "2", "7"]
    for number, goal, move, half, double in rows[2:]:
        expected = library_module.lesson("v", int(number)).values["goal"]
        assert float(goal) == expected
        assert move == f"q = ({goal}°, 20°)"
        assert float(half.split(" ±")[0]) == pytest.approx(expected / 2)
        assert float(double.split(" ±")[0]) == expected * 2
    assert "- Step 3, Double, in variant 0: Twice?" in out


def test_a_sheet_for_a_list_of_names(typed, place):
    (place / "names.txt").write_text("Ada\n\n  Bob | *x*  \n", encoding="utf-8")
    status, out, _ = typed("lesson", "sheet", "mine/v.md", "--students", "names.txt")
    assert status == 0
    assert [line.split(" | ")[:2] for line in out.splitlines()[-2:]] == [["| 1", "Ada"], ["| 2", r"Bob \| \*x\*"]]


def test_a_lesson_without_variants_has_one_row(typed):
    status, out, _ = typed("lesson", "sheet", "mine/t.md")
    assert status == 0
    assert [line.split(" | ")[0] for line in out.splitlines() if line.startswith("|")] == ["| variant", "| ---", "| 0"]
    assert " ±" in out
    assert "SI units" not in out


@pytest.mark.parametrize("found", Place().all(), ids=lambda found: found.key)
def test_every_lesson_of_the_lab_has_a_sheet(capsys, found):
    assert main(["lesson", "sheet", found.key, "--variants", "0-3"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    widths = {line.replace(r"\|", "").count("|") for line in out.splitlines() if line.startswith("|")}
    assert len(widths) == 1


@pytest.mark.parametrize("found", Place().all(), ids=lambda found: found.key)
def test_an_answer_of_a_sheet_that_is_typed_is_right(found):
    first = found.lesson()
    for lesson in (library_module.lesson(found.key, number) for number in (range(4) if first.varies else [0])):
        for question in (step.question for step in lesson.steps if step.question is not None):
            if not isinstance(question.form, Choices):
                said = right_answer(question)
                assert question.judge(said.partition(" ± ")[0]).right, said
                assert not re.search(r"e-\d|\.\d{9}", said) or "±" not in said


def test_rounding_is_no_digit_of_a_sheet():
    question = MatrixQuestion("", np.array([[-0.9, -0.5], [0.4 * math.sqrt(3.0), 3e-17]]), 0.004, "m")
    assert right_answer(question) == "−0.9 −0.5; 0.69282 0 m ± 0.004 m"
    assert question.right_answer.endswith(" 0")


def test_a_variant_that_cannot_be_used_leaves_the_others(typed, place):
    (place / "mine" / "v.md").write_text(VARIED.replace("+++\n## Turn", 'root = "sqrt(31 - goal)"\n+++\n## Turn'))
    status, out, err = typed("lesson", "sheet", "mine/v.md", "--variants", "0,1")
    assert status == 1
    assert one_line(err)
    assert err.startswith("armlab: variant 1: ")
    assert out.splitlines()[-1].startswith("| 0 |")


@pytest.mark.parametrize("text", ["", "x", "3-1", "-1", "1,,2", "0-9999", "99999", "1-2-3", "٣"])
def test_numbers_that_are_none_are_refused(text):
    with pytest.raises(ArmlabError, match="--variants"):
        numbers_of(text)


@pytest.mark.parametrize("data", [b"", b"\n \n", b"\xff\xfeA\x00", b"A\n" * 1001, b"x" * 2_000_000])
def test_lists_that_are_none_are_refused(place, data):
    (place / "names.txt").write_bytes(data)
    with pytest.raises(ArmlabError, match=r"names\.txt"):
        names_of(place / "names.txt")


def test_nothing_means_anything_in_an_escaped_text():
    assert escaped("a|b\n*c* `d` <e>") == r"a\|b \*c\* \`d\` \<e\>"


ON_BENCHES = (
    ("encoder_speed", "true speed: 36 deg/s", "0.628"),
    ("encoder_speed", "window in which counts are counted: 0.01 s", "encoder_speed ("),
    ("encoder_speed", "the true speed: 720 deg/s ± 1 deg/s", "rad/s"),
    ("kernel_axis", "(joint 1, value 0.5)", "joint 0"),
    ("best_ratio", "number of teeth (wheel 1, teeth 20)", "wheel 0"),
    ("statics", "(kind force, axis x, value 3)", "axis 0"),
    ("statics", "names no unit, quantities are in SI units and angles in radians.\n\n| variant", "SI units, angles"),
    ("two_robots", "kind of robot B: 3R, pose; solution of robot B: elbow down; length of the links", "three_links"),
    ("two_robots", "the kind of robot B: 2R, position only", "two_links"),
    ("two_orders", "(law 1, piece 1, rate, value 6 deg/s)", "what 3"),
    ("same_formula", "entry of a product (row 1, column 3)", "column 4"),
)


AMOUNTS = (
    *(
        "axis",
        "by",
        "circular",
        "count",
        "counts",
        "flexspline",
        "frame",
        "link",
        "made",
        "quarters",
        "seed",
        "step",
        "teeth",
    ),
    *("terms", "turns"),
)
"""Arguments whose numbers stand on a sheet as they are in a file: amounts, what counts from 1, frames 0 to n, axes."""


def test_a_sheet_counts_from_1_as_the_screen_does():
    known = (known for page in pages_with_words() for known in words_of(page).values())
    whole = {
        (each.name, argument.name)
        for each in known
        if isinstance(each.make, type)
        for argument in each.arguments
        if argument.kind.says.startswith("a whole number") and argument.name not in each.make.places
    }
    assert sorted((word, name) for word, name in whole if (name in FROM_ZERO) == (name in AMOUNTS)) == []
    near = BenchWord("velocity.microscope.bring_near", {"place": 0}, "f.md", "step 1.solution", "do[1]")
    assert bench_words(near) == "on the page Singularities: move near a singularity (number 1)"
    curve = BenchWord("motion.curves.set", {"selected": 1}, "f.md", "step 1.solution", "do[1]")
    assert bench_words(curve) == "on the page Interpolation: curve whose equations are shown: 2"


@pytest.mark.parametrize(("lesson", "said", "unsaid"), ON_BENCHES)
def test_a_sheet_speaks_of_benches_as_the_screen_does(capsys, lesson, said, unsaid):
    assert main(["lesson", "sheet", lesson, "--variants", "0"]) == 0
    out = capsys.readouterr().out
    assert said in out
    assert unsaid not in out.replace(f"Lesson `{lesson}`", "")
    assert r"\_" not in out


MOTION_WORDS = (
    ('kind = "waypoint"\nafter = 1', "add the configuration of the arm as a waypoint behind waypoint 1"),
    ('kind = "waypoint"\nset = 2', "waypoint 2 goes to where the arm is"),
    ('kind = "waypoint"\nremove = 2', "remove waypoint 2"),
    ('kind = "move_kind"\nto = 3\nspace = "joint"\nstop = false', "move to waypoint 3: space joint, do not stop there"),
    ('kind = "duration"\nseconds = 10', "duration 10 s"),
    ('kind = "duration"', "as fast as allowed"),
    ('kind = "limits"\nvelocity_percent = 60\ntool_speed_m_s = 0.5', "limits: velocity 60 %, tool speed 0.5 m/s"),
    ('kind = "example"\nname = "motion/corner_stop"', "example motion/corner_stop"),
    ('kind = "motion"', "play the motion"),
    ('kind = "film"\nname = "laws"', "play laws"),
    ('kind = "film"', "play the film"),
)


@pytest.mark.parametrize(("action", "words"), MOTION_WORDS)
def test_a_sheet_says_what_is_done_to_a_motion(typed, place, action, words):
    text = MOTION.replace('[[do]]\nkind = "move_kind"\npath = "overfly"', f"[[do]]\n{action}", 1)
    (place / "mine" / "m.md").write_text(text, encoding="utf-8")
    assert words in typed("lesson", "sheet", "mine/m.md")[1]


PLACED = """+++
title = "Target"
chapter = "1"
teaches = ["S4.0-2R"]
robot = "elbow_3r"
q_deg = [0, 20, 30]
+++
## Place it
```check
kind = "target_at"
position = [0.6, 0, 0.3]
tolerance_m = 0.01
```
```solution
[[do]]
kind = "move"
q_deg = [0, 0, 90]
[[do]]
kind = "target"
position = [0.6, 0, 0.3]
[[do]]
kind = "robot"
key = "cartesian_3p"
[[do]]
kind = "move"
q_m = [0.5, 0.4, 0.3]
[[do]]
kind = "target"
position = [0.6, 0, 0.3]
rpy_deg = [10, -90, 0]
```
"""


def test_a_sheet_tells_joint_values_and_targets_of_the_arm_that_is_there_by_then(typed, place):
    (place / "mine" / "p.md").write_text(PLACED, encoding="utf-8")
    status, out, err = typed("lesson", "sheet", "mine/p.md")
    assert (status, err) == (0, "")
    assert "q = (0°, 0°, 90°), then target at (0.6, 0, 0.3) m, then choose cartesian" in out
    assert "q = (0.5 m, 0.4 m, 0.3 m), then target at (0.6, 0, 0.3) m with roll, pitch and yaw (10°, −90°, 0°)" in out


def test_a_sheet_tells_the_orientation_of_a_target_for_an_arm_whose_task_has_one(capsys):
    assert main(["lesson", "sheet", "ik_cases", "--variants", "0"]) == 0
    assert "target at (1, −0.15, 0.67) m with roll, pitch and yaw (0°, 0°, 0°)" in capsys.readouterr().out
