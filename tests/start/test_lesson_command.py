"""``armlab lesson``, as an author types it."""

from pathlib import Path

import pytest

from armlab.commands._found import Place
from armlab.commands._lesson_check import problems_of
from armlab.content.new_lesson import new_lesson
from armlab.content.robots import catalogue
from support.small_lessons import TWO_STEPS, VARIED


def one_line(err):
    return err.count("\n") == 1 and "Traceback" not in err


# --- armlab lesson new


@pytest.mark.parametrize("key", list(catalogue().robots))
def test_the_template_works_for_every_robot(place, key):
    (place / "mine" / "template.md").write_text(new_lesson(catalogue()[key]), encoding="utf-8")
    (found,) = Place().some("mine/template.md")
    assert list(problems_of(found)) == []
    first, second = found.lesson().steps
    assert len(first.hints) == len(first.solution) == len(first.check.wrong) == len(second.question.wrong) == 1


def test_a_new_lesson_is_written_once(typed, place):
    status, out, err = typed("lesson", "new", "my_arm", "--robot", "scara", "--to", "mine")
    assert (status, err) == (0, "")
    assert "armlab lesson check mine/my_arm.md" in out
    path = place / "mine" / "my_arm.md"
    assert 'robot = "scara"' in path.read_text(encoding="utf-8")
    written = path.read_bytes()
    status, out, err = typed("lesson", "new", "my_arm", "--to", "mine")
    assert (status, out) == (1, "")
    assert "it stays as it is" in err
    assert path.read_bytes() == written
    assert typed("lesson", "check", path)[:2] == (0, "my_arm: 2 steps, no problems\n")


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("My Lesson",), "expected lower-case letters"),
        (("../x",), "expected lower-case letters"),
        (("x" * 65,), "at most 64"),
        (("first_arm",), "there is a lesson 'first_arm' in the lab"),
        (("readme",), "readme.md is read by people and is no lesson; choose another name"),
        (("x", "--robot", "puma650"), "puma560"),
        (("x", "--to", "gone"), "gone: there is no such folder"),
    ],
)
def test_what_cannot_be_a_new_lesson_is_one_line(typed, place, arguments, says):
    before = sorted(place.rglob("*"))
    status, out, err = typed("lesson", "new", *arguments)
    assert (status, out) == (1, "")
    assert one_line(err)
    assert says in err
    assert sorted(place.rglob("*")) == before


# --- armlab lesson check


@pytest.mark.parametrize("found", Place().all(), ids=lambda found: found.key)
def test_the_lessons_of_the_lab_have_no_problems(found):
    assert list(problems_of(found)) == []


def test_all_lessons_are_checked_when_none_is_named(typed):
    status, out, err = typed("lesson", "check", "--variants", "0")
    assert (status, err) == (0, "")
    assert out == "first_arm: 4 steps, no problems\n"
    status, out, _ = typed("lesson", "check", "--variants", "0", "--lessons", "mine")
    assert [line.split(": ")[0].rpartition("/")[2].partition(":")[0] for line in out.splitlines()] == [
        "first_arm",
        "t.md",
        "v",
    ]
    assert status == 1


@pytest.mark.parametrize("typed_as", ["mine/v.md", "./mine/../mine/v.md", "whole"])
def test_a_file_or_a_folder_is_a_lesson(typed, place, typed_as):
    (place / "whole").mkdir()
    (place / "whole" / "lesson.md").write_text(VARIED, encoding="utf-8")
    key = "whole" if typed_as == "whole" else "v"
    assert typed("lesson", "check", typed_as) == (0, f"{key}: 3 steps, no problems in 6 variants\n", "")


def test_a_folder_of_lessons_is_all_of_them(typed, place):
    path = place / "mine" / "t.md"
    text = path.read_text(encoding="utf-8")
    solved = text.replace("tolerance_deg = 1\n```", "tolerance_deg = 1\n```\n```solution\nq_deg = [90, 20]\n```")
    path.write_text(solved, encoding="utf-8")
    assert typed("lesson", "check", "mine") == (
        0,
        "t: 3 steps, no problems\nv: 3 steps, no problems in 6 variants\n",
        "",
    )


def test_a_problem_has_file_and_line(typed):
    status, out, err = typed("lesson", "check", "mine/t.md")
    line = TWO_STEPS.splitlines().index("## Same") + 1
    path = Path("mine") / "t.md"
    assert (status, out, err) == (1, f"{path}:{line}: step 2: it has a check and no block 'solution'\n", "")


def test_a_file_that_cannot_be_read_is_told_with_its_line(typed, place):
    lines = VARIED.splitlines()
    line = lines.index("joint = 1") + 1
    path = place / "mine" / "v.md"
    path.write_text(VARIED.replace("joint = 1", "joint = 7", 1), encoding="utf-8")
    status, out, _ = typed("lesson", "check", path)
    assert status == 1
    assert out.startswith(f"{Path('mine') / 'v.md'}:{line}: step 1.check.joint: expected a joint from 1 to 2")
    path.write_bytes(b"\xff\xfe")
    assert "not a text in UTF-8" in typed("lesson", "check", path)[1]


def test_what_leads_out_of_a_folder_is_told_and_the_others_are_checked(typed, place):
    (place / "mine" / "t.md").unlink()
    (place / "outside").mkdir()
    (place / "outside" / "lesson.md").write_text(VARIED, encoding="utf-8")
    (place / "mine" / "linked").symlink_to(place / "outside", target_is_directory=True)
    line = f"{Path('mine') / 'linked'}: it leads out of the folder mine; put the files themselves there\n"
    assert typed("lesson", "check", "mine") == (1, f"{line}v: 3 steps, no problems in 6 variants\n", "")
    status, out, _ = typed("lesson", "check", "--lessons", "mine", "--variants", "0")
    assert (status, out.splitlines(keepends=True)[0]) == (1, line)
    assert typed("lesson", "check", "mine/linked") == (1, "", f"armlab: {line}".replace("\\", "/"))


def test_a_picture_with_a_mistake_is_named(typed, place):
    (place / "drawn").mkdir()
    (place / "drawn" / "lesson.md").write_text(VARIED, encoding="utf-8")
    (place / "drawn" / "arm.svg").write_text("<svg onload='alert(1)'/>", encoding="utf-8")
    status, out, _ = typed("lesson", "check", "drawn")
    assert (status, out) == (1, f"{Path('drawn') / 'arm.svg'}: the drawing has a handler onload; draw it without\n")


def test_links_into_the_lab_have_to_lead_somewhere(typed, place):
    links = (
        "[a](/lesson/first_arm) [b](/lesson/firts_arm/3) [c](/robot/scara) [d](/robot/scar) [e](/) [f](https://x.org) "
        "[g](file.html) [h](#same) [i](mailto:a@x.org)"
    )
    text = TWO_STEPS.replace("Only text.\n", f"Only text.\n\n```hint\n{links}\n```\n")
    (place / "mine" / "t.md").write_text(text, encoding="utf-8")
    out = typed("lesson", "check", "mine/t.md")[1]
    line = text.splitlines().index("## Read") + 1
    assert f"t.md:{line}: step 1: link: unknown lesson 'firts_arm'; did you mean 'first_arm'?" in out
    assert f"t.md:{line}: step 1: link: unknown robot 'scar'; did you mean 'scara'?" in out
    for nowhere in ("file.html", "#same"):
        told = f"expected https://... or a place of the lab such as /lesson/first_arm, got {nowhere!r}"
        assert f"t.md:{line}: step 1: link: {told}" in out
    assert out.count(": link: ") == 4


START = "q_deg = [0, 20]"


@pytest.mark.parametrize(
    ("old", "new", "key", "says"),
    [
        ('teaches = ["S4.0-2R"]', 'teaches = ["S4.1-hd"]', "teaches", "'S4.1-dh'"),
        (
            "q_deg = [0, 20]",
            'q_deg = [0, 20]\npanel = "joint"',
            "panel",
            "unknown panel 'joint'; did you mean 'joints'?",
        ),
        (
            "q_deg = [0, 20]",
            'q_deg = [0, 20]\nhidden = ["flim"]',
            "hidden",
            "unknown panel 'flim'; did you mean 'film'?",
        ),
        (START, START + '\noverlays = ["frame"]', "overlays", "did you mean 'frames'?"),
        (START, START + '\nhidden = ["film"]\npanel = "film"', "hidden", "is to be opened"),
    ],
)
def test_names_at_the_top_have_to_exist(typed, place, old, new, key, says):
    text = VARIED.replace(old, new)
    line = next(i for i, each in enumerate(text.splitlines(), start=1) if each.startswith(f"{key} ="))
    (place / "mine" / "v.md").write_text(text, encoding="utf-8")
    status, out, _ = typed("lesson", "check", "mine/v.md")
    assert status == 1
    assert out.startswith(f"{Path('mine') / 'v.md'}:{line}: {key}: ")
    assert says in out
    assert out.count("\n") == 1


@pytest.mark.parametrize(
    ("check", "says"),
    [
        ('switch = "frame"', "unknown switch 'frame'; did you mean 'frames'?"),
        ('panel = "joint"', "unknown panel 'joint'"),
        ('film = "flim"', "unknown film 'flim'; did you mean 'film'?"),
        ('panel = "trainer"', "the panel 'trainer' is to be opened, and the lesson hides it"),
    ],
)
def test_names_in_steps_have_to_exist(typed, place, check, says):
    block = f'```check\nkind = "looked_at"\n{check}\n```\n```solution\n[[do]]\nkind = "switch"\nname = "shadow"\n```\n'
    text = TWO_STEPS.replace("overlays", 'hidden = ["trainer"]\noverlays').replace("Only text.\n", block)
    (place / "mine" / "t.md").write_text(text, encoding="utf-8")
    out = typed("lesson", "check", "mine/t.md")[1]
    line = text.splitlines().index("## Read") + 1
    assert f"t.md:{line}: step 1: check: {says}" in out
    assert f"t.md:{line}: step 1: solution: unknown switch 'shadow'; did you mean 'shadows'?" in out


ONLY_MOTIONS = """+++
title = "T"
chapter = "6"
teaches = ["S4.0-2R"]
robot = "puma560"
hidden = ["trainer"]
example = "motion/circle"
+++
## Read
```start
example = "laws/triangle"
panel = "laws"
```
```solution
[[do]]
kind = "example"
name = "motion/spline"
[[do]]
kind = "move_kind"
turning = "axis"
[[do]]
kind = "film"
name = "laws"
```
"""


@pytest.mark.parametrize(
    ("old", "new", "line", "says"),
    [
        (
            "motion/circle",
            "motion/circel",
            "example =",
            "example: example of the bench 'motion': unknown name 'circel'",
        ),
        ("motion/circle", "moton/circle", "example =", "example: bench: unknown name 'moton'; did you mean 'motion'?"),
        (
            "motion/circle",
            "motion/given_time",
            "example =",
            "example: the example 'motion/given_time' is of the arm 'ur",
        ),
        (
            "hidden",
            'pose = "zero"\nhidden',
            "example =",
            "example: the example 'motion/circle' puts the arm elsewhere",
        ),
        ("laws/triangle", "laws/triangel", "## Read", "step 1: start: example of the bench 'laws': unknown name 'tri"),
        ('panel = "laws"', 'panel = "lwas"', "## Read", "step 1: start: unknown panel 'lwas'; did you mean 'laws'?"),
        ('panel = "laws"', 'panel = "trainer"', "## Read", "step 1: start: the panel 'trainer' is to be opened"),
        ("motion/spline", "motion/splin", "## Read", "step 1: solution: example of the bench 'motion': unknown"),
        ('"axis"', '"axes"', "## Read", "step 1: solution: unknown turning 'axes'; did you mean 'axis'?"),
        ('name = "laws"', 'name = "lwas"', "## Read", "step 1: solution: unknown film 'lwas'; did you mean 'laws'?"),
    ],
)
def test_names_of_examples_have_to_exist(typed, place, old, new, line, says):
    path = place / "mine" / "m.md"
    path.write_text(ONLY_MOTIONS, encoding="utf-8")
    assert typed("lesson", "check", "mine/m.md") == (0, "m: 1 step, no problems\n", "")
    text = ONLY_MOTIONS.replace(old, new, 1)
    path.write_text(text, encoding="utf-8")
    status, out, err = typed("lesson", "check", "mine/m.md")
    assert (status, err) == (1, "")
    number = next(i for i, each in enumerate(text.splitlines(), start=1) if each.startswith(line))
    assert f"{Path('mine') / 'm.md'}:{number}: {says}" in out


def test_a_lesson_with_the_name_of_another_says_so(typed, place):
    (place / "mine" / "first_arm.md").write_text(VARIED, encoding="utf-8")
    status, out, _ = typed("lesson", "check", "mine/first_arm.md")
    assert status == 1
    assert "there is another lesson 'first_arm'" in out


def test_what_a_lesson_needs_has_to_exist_and_not_to_need_it(typed, place):
    for key, needed in (("v", '["t", "firts_arm"]'), ("t", '["v"]')):
        path = place / "mine" / f"{key}.md"
        path.write_text(path.read_text(encoding="utf-8").replace("teaches", f"after = {needed}\nteaches", 1))
    status, out, _ = typed("lesson", "check", "mine/v.md")
    file = Path("mine") / "v.md"
    assert (status, out.splitlines()) == (
        1,
        [
            f"{file}:4: after: unknown lesson 'firts_arm'; did you mean 'first_arm'? Available: first_arm, t, v",
            f"{file}:4: after: a circle: 'v' needs 't', which needs 'v'; nobody could begin, so take one of these away",
        ],
    )
    assert f"{Path('mine') / 't.md'}:4: after: a circle: 't' needs 'v'" in typed("lesson", "check", "mine")[1]


COURSE = """title = "Mine"
[[chapters]]
title = "One"
lessons = [
    "first_arm",
    {lessons},
]
"""


@pytest.mark.parametrize(
    ("lessons", "line", "says"),
    [
        ('"v"', 0, ""),
        ('"v",\n    "vv"', 7, "chapters[1].lessons[3]: unknown lesson 'vv'; did you mean 'v'?"),
        (
            '"v",\n    "v"',
            7,
            "chapters[1].lessons[3]: the lesson 'v' is in the course already, at chapters[1].lessons[2]",
        ),
        ("v", 6, "not valid TOML"),
    ],
)
def test_a_course_is_checked_with_its_folder(typed, place, lessons, line, says):
    (place / "mine" / "t.md").unlink()
    (place / "mine" / "course.toml").write_text(COURSE.format(lessons=lessons), encoding="utf-8")
    for arguments in (("mine",), ("--lessons", "mine", "--variants", "0")):
        status, out, _ = typed("lesson", "check", *arguments)
        told = [each for each in out.splitlines() if "no problems" not in each]
        assert (status, len(told)) == (1, 1) if says else (0, 0), out
        assert all(each.startswith(f"{Path('mine') / 'course.toml'}:{line}: {says}") for each in told)
    assert typed("lesson", "check", "first_arm")[0] == 0, "whoever asks for one lesson hears of no other folder"


def test_a_new_lesson_says_what_it_needs_and_how_long_it_takes(typed, place):
    typed("lesson", "new", "mine_too", "--to", "mine")
    (found,) = Place().some("mine/mine_too.md")
    assert (found.lesson().after, found.lesson().minutes, len(found.lesson().can)) == ((), 5, 1)


@pytest.mark.parametrize("count", ["-1", "9999999"])
def test_the_number_of_variants_is_bounded(typed, count):
    status, _, err = typed("lesson", "check", "first_arm", "--variants", count)
    assert status == 1
    assert one_line(err)


def test_two_steps_of_one_title_are_told(typed, place):
    (place / "mine" / "t.md").write_text(TWO_STEPS, encoding="utf-8")
    out = typed("lesson", "check", "mine/t.md")[1]
    assert "step 3: its title is that of step 2; progress is kept under titles" in out


def test_a_file_beside_a_folder_of_its_name_is_told(typed, place):
    (place / "mine" / "v").mkdir()
    (place / "mine" / "v" / "lesson.md").write_text(VARIED, encoding="utf-8")
    status, out, _ = typed("lesson", "check", "mine")
    assert status == 1
    assert "the lesson 'v' is there already, in v/lesson.md; rename one" in out


def test_braces_that_are_not_closed_are_told_with_their_line(typed, place):
    text = VARIED.replace("## Turn\n", "## Turn\nThe hand is at {{px\nnow.\n")
    (place / "mine" / "open.md").write_text(text, encoding="utf-8")
    out = typed("lesson", "check", "mine/open.md")[1]
    assert "expected }} after {{px" in out
    assert f"open.md:{text.splitlines().index('The hand is at {{px') + 1}: " in out
