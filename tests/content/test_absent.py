"""Topics that the lab does not have: whoever looks for one is told."""

import pytest

from armlab.content.absent import absent
from armlab.content.lessons import lessons
from armlab.content.rows import rows


@pytest.mark.parametrize(
    ("query", "says"),
    [
        ("collision", "The lab has no obstacles"),
        ("how do I avoid obstacles?", "The lab has no obstacles"),
        ("PID", "The lab has no PID controller"),
        ("Newton-Euler", "The lab has no dynamics of arms"),
        ("Mobile robots", "The lab has no mobile robots"),
        ("error dynamics", ""),
        ("rapid", ""),
        ("forward kinematics", ""),
        ("", ""),
    ],
)
def test_what_robotics_has_and_the_lab_has_not_is_said(query, says):
    assert absent(query).startswith(says)
    assert bool(absent(query)) == bool(says)


def test_whoever_asks_in_another_language_is_told_as_well():
    assert absent("gli ostacoli", "it") == absent("obstacles") != ""
    assert absent("dinamica dell'errore", "it") == absent("gli ostacoli") == ""


def test_nothing_that_the_lab_has_is_said_to_be_absent():
    titles = [row.title for row in rows().values()] + [lesson.title for lesson in lessons().lessons.values()]
    assert [title for title in titles if absent(title)] == []
