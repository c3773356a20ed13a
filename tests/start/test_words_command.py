"""``armlab lesson words``, and the list of words in the guide for authors."""

import pytest

from armlab import resources
from armlab.commands._words import words_listed
from armlab.content.bench_words import is_word
from armlab.session.bench import benches
from armlab.session.facts import facts_of_benches
from armlab.session.words import pages_with_words, words_of
from support.bench_lesson import BENCHES

BEGIN, END = "<!-- armlab lesson words -->\n", "<!-- end of armlab lesson words -->"


def test_the_guide_lists_what_there_is():
    text = (resources.folder("lessons") / "README.md").read_text(encoding="utf-8")
    listed = text.partition(BEGIN)[2].partition(END)[0]
    assert listed == words_listed(), "print it with 'python3 -m armlab lesson words' and put it between the marks"


def test_every_word_fact_and_example_is_listed():
    text = words_listed()
    facts = [f"{page}.{name}" for page, found in facts_of_benches().items() for name in found.facts]
    for name in (*(word for page in pages_with_words() for word in words_of(page)), *facts):
        assert is_word(name)
        assert f"| `{name}` |" in text
    for bench in benches().values():
        assert all(f"`{name}`" in text for name in bench.examples)


def test_a_page_is_listed_alone(typed):
    status, out, err = typed("lesson", "words", "velocity.statics")
    assert (status, err) == (0, "")
    assert out.startswith('### `velocity.statics`\n\nThe page *Statics*, `panel = "statics"`.\n')
    title = "the largest torque of a joint (arms of turning joints only)"
    assert f"| `velocity.statics.largest_torque` | {title} | a number, N m |" in out
    assert "motion.plan" not in out


def test_a_page_that_is_not_there_is_one_line(typed):
    status, out, err = typed("lesson", "words", "velocity.static")
    assert (status, out) == (1, "")
    assert "did you mean 'velocity.statics'" in err


# --- In a lesson


def write(place, text):
    (place / "mine" / "benches.md").write_text(text, encoding="utf-8")


def test_a_lesson_in_words_of_benches_has_no_problems(typed, place):
    write(place, BENCHES)
    assert typed("lesson", "check", "mine/benches.md") == (0, "benches: 3 steps, no problems in 5 variants\n", "")


@pytest.mark.parametrize(
    ("old", "new", "line", "says"),
    [
        ('set_speed"\njoint = 0\nvalue_deg = 60', 'set_sped"\njoint = 0\n', "step 2.solution.do[1].command", "_speed"),
        ("axis = 1\nvalue = 2", "axis = 1\nvalue = true", "step 1.solution.do[1].value", "a finite number, got True"),
        ("axis = 0\nvalue = 0", "axis = 0", "do[1].value", "missing; expected kind (a text)"),
        ('fact = "iterate.runs.status"', 'fact = "iterate.runs.statu"', "step 3: check", "did you mean 'status'"),
        ('value = "most"', "at_least = 3", "step 3: check", "iterate.runs.status: expected a text"),
        ("{{velocity.speeds.turning_speed}}", "{{velocity.speeds.turn}}", "step 2: live value", "turning_speed"),
    ],
)
def test_mistakes_are_told_with_file_and_line_and_what_there_is(typed, place, old, new, line, says):
    text = BENCHES.replace(old, new, 1)
    assert text != BENCHES
    write(place, text)
    status, out, _ = typed("lesson", "check", "mine/benches.md")
    assert status == 1
    told = next(each for each in out.splitlines() if line in each)
    assert told.startswith("mine/benches.md:")
    assert says in told


def test_the_line_is_that_of_the_mistake(typed, place):
    write(place, BENCHES.replace("value_deg = 60", "valu_deg = 60"))
    _, out, _ = typed("lesson", "check", "mine/benches.md")
    number = next(i for i, line in enumerate(BENCHES.splitlines(), start=1) if line == "value_deg = 60")
    assert out.startswith(
        f"mine/benches.md:{number}: step 2.solution.do[1].valu_deg: velocity.speeds.set_speed: unknown"
    )


def test_the_sheet_says_what_to_do_and_what_is_asked(typed, place):
    write(place, BENCHES)
    status, out, _ = typed("lesson", "sheet", "mine/benches.md", "--variants", "0-1")
    assert status == 0
    lines = out.splitlines()
    assert "- Step 1, Less torque, in variant 0, is to have the largest torque of a joint: at most 5 N m" in lines
    turned = "the angular velocity of the tool, in world axes: (0, 0, 90) deg/s ± 1 deg/s"
    assert f"- Step 2, Turn, in variant 0, is to have {turned}" in lines
    row = lines[-1]
    assert "on the page Statics: wrench (kind force, axis y, value 2)" in row
    assert "on the page Jacobian: set the speed of one joint (joint 1, value 60 deg/s)" in row
