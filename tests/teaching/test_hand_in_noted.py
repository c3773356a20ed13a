"""What a hand-in is judged by, and what can only be noted."""

import pytest

from armlab.content.robots import catalogue
from armlab.session.edits import SetLimits
from armlab.session.state import State
from armlab.teaching.hand_in import hand_in, judge
from armlab.teaching.hand_in_reports import Judged, table
from armlab.teaching.lesson_commands import Answer, GoToStep, OpenLesson
from armlab.teaching.parts.lesson import has_its_arm
from support.done import done
from support.small_lessons import TWO_STEPS, library_fixture

own = pytest.fixture(library_fixture, name="own")


@pytest.fixture
def fresh():
    return State.initial(catalogue()["puma560"])


def test_wider_limits_make_another_arm_on_screen_too(fresh, own):
    state = done(fresh, OpenLesson("v", variant=3))
    assert has_its_arm(state)
    assert not has_its_arm(done(state, SetLimits(1, -10.0, 10.0)))


def test_what_no_file_proves_is_called_noted(fresh, own):
    own(
        t=TWO_STEPS.replace(
            'kind = "joint_at"\njoint = 1\nvalue_deg = 90\ntolerance_deg = 1', 'kind = "looked_at"\nswitch = "frames"'
        )
    )
    state = done(fresh, OpenLesson("t"), GoToStep(1), Answer("2"))
    one = Judged("a", judge(hand_in(state)))
    assert one.report.steps[1].says == "Recorded only, not judged: that a switch was on. '2': Right."
    assert table([one]).splitlines()[1].split() == ["a", "0", "-", "noted", "no", "1", "of", "2"]
