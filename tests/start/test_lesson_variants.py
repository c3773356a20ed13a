"""``armlab lesson check`` on lessons that vary: which variants are tried, and what is told of several."""

import re

from support.small_lessons import VARIED


def test_a_problem_of_some_variants_names_the_first(typed, place):
    text = VARIED.replace('q_deg = ["= goal", 20]\n```\n## Predict', "q_deg = [30, 20]\n```\n## Predict")
    (place / "mine" / "v.md").write_text(text, encoding="utf-8")
    status, out, _ = typed("lesson", "check", "mine/v.md", "--variants", "2")
    assert status == 1
    assert [line.split(": ")[1] for line in out.splitlines()] == ["step 1 (variant 1)", "step 1 (variant 2)"]
    assert typed("lesson", "check", "mine/v.md", "--variants", "0")[0] == 0


def test_a_value_is_tried_that_the_first_variants_do_not_have(typed, place):
    text = VARIED.replace("{ from = 30, to = 120, step = 1 }", "{ choose = [30, 40, 60, 80, 90, 100, 110, 0] }")
    (place / "mine" / "g.md").write_text(text, encoding="utf-8")
    status, out, _ = typed("lesson", "check", "mine/g.md")
    assert status == 1
    assert "step 1 (variant 13): its check is met already when the step begins" in out
    assert typed("lesson", "check", "mine/g.md", "--variants", "5")[:2] == (
        0,
        "g: 3 steps, no problems in 6 variants\n",
    )


def test_a_problem_of_all_variants_is_told_once(typed, place):
    text = VARIED.replace('```solution\nq_deg = ["= goal", 20]\n```\n', "")
    (place / "mine" / "v.md").write_text(text, encoding="utf-8")
    assert typed("lesson", "check", "mine/v.md")[1].count("\n") == 1


def test_all_broken_variants_are_told_at_once(typed, place):
    text = VARIED.replace(
        "goal = { from = 30", 'bad = { choose = [1, 0, 1, 0, 0] }\nworse = "3/bad"\ngoal = { from = 30'
    )
    (place / "mine" / "b.md").write_text(text, encoding="utf-8")
    out = typed("lesson", "check", "mine/b.md", "--variants", "40")[1]
    told = [line for line in out.splitlines() if "worse" in line]
    numbers = {int(n) for line in told for n in re.findall(r"\d+", re.search(r"variants? ([\d, ]+):", line)[1])}
    assert len(numbers) > 5
