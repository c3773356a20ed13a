"""``armlab lesson check`` on lessons in words of benches: mistakes in commands, facts and checks of them."""

import pytest

from support.bench_lesson import BENCHES


def test_an_argument_that_counts_from_0_is_refused_in_numbers_from_0(typed, place):
    (place / "mine" / "b.md").write_text(BENCHES.replace("axis = 1\nvalue = 2", "axis = 3\nvalue = 2"), "utf-8")
    out = typed("lesson", "check", "mine/b.md", "--variants", "0")[1]
    assert "refused: component of a wrench (counted from 0): expected 0 to 2, got 3" in out


LARGEST = 'fact = "velocity.statics.largest_torque"\nat_most = "= most"'


@pytest.mark.parametrize(
    ("new", "says"),
    [
        (LARGEST.replace("torque", "tork"), "fact of velocity.statics: unknown name 'largest_tork'"),
        (LARGEST.replace("largest_torque", "torques"), "velocity.statics.torques: it is several numbers"),
        (LARGEST.replace("at_most", "at_most_deg"), "velocity.statics.largest_torque: it is no angle"),
    ],
)
def test_a_mistake_with_a_fact_is_told_once(typed, place, new, says):
    assert LARGEST in BENCHES
    (place / "mine" / "b.md").write_text(BENCHES.replace(LARGEST, new), encoding="utf-8")
    (told,) = typed("lesson", "check", "mine/b.md")[1].splitlines()
    assert f": step 1: check: {says}" in told


def test_a_check_that_chance_meets_is_to_become_harder_in_words_that_fit_it(typed, place):
    text = BENCHES.replace(LARGEST, LARGEST.replace('at_most = "= most"', "at_least = 18"))
    (place / "mine" / "b.md").write_text(text, encoding="utf-8")
    out = typed("lesson", "check", "mine/b.md", "--variants", "0")[1]
    assert "random states meet its check: make it harder, with smaller tolerances or narrower bounds" in out
