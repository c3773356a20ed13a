"""The lessons on workspaces: every row of section 4.2 is taught, and their numbers are those of closed forms."""

import math

import pytest

from armlab.content.lessons import lesson, lessons
from armlab.content.rows import rows


def answer_of(key, step, variant=0):
    return lesson(key, variant).steps[step - 1].question.answer


def test_every_row_on_workspaces_is_taught():
    asked = {key for key, row in rows().items() if row.section.startswith("4.2")} | {"S4.3.1-ws-3R"}
    taught = {row for each in lessons().lessons.values() for row in each.teaches}
    assert len(asked) == 5
    assert asked <= taught


def test_where_the_hand_is_brought_on_the_ring_differs_with_the_variant():
    for step in (1, 4):
        solved = (lesson("workspace_2r", variant).steps[step - 1].solution[0].q for variant in range(8))
        assert len({tuple(q.tolist()) for q in solved}) > 2


def numbers(key, variant=0):
    """Return the right answers of the numeric questions of a lesson."""
    found = (step.question for step in lesson(key, variant).steps)
    return [each.answer for each in found if each is not None and isinstance(getattr(each, "answer", None), float)]


def test_areas_of_ring_and_disc():
    arm = lesson("workspace_2r").robot_used.arm
    l1, l2 = (row.a for row in arm.rows)
    ring = math.pi * ((l1 + l2) ** 2 - (l1 - l2) ** 2)
    assert any(each == pytest.approx(ring, rel=1e-3) for each in numbers("workspace_2r"))
