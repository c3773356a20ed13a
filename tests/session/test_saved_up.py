"""Time that is saved up at a share of what passes, spent, and waited for."""

import pytest

from armlab.session.saved_up import SavedUp, SavedUpEach


def test_what_is_saved_up_is_spent_and_then_waited_for():
    now = 100.0
    saved = SavedUp(rate=0.1, most=2.0, clock=lambda: now)
    saved.spend(2.0)
    assert saved.wait == 0.0
    saved.spend(0.5)
    assert saved.wait == pytest.approx(5.0)
    now += 5.0
    assert saved.wait == pytest.approx(0.0)
    now += 1000.0
    saved.spend(2.5)
    assert saved.wait == pytest.approx(5.0), "no more is saved up than the most"


def test_a_debt_that_takes_too_long_is_forgiven():
    now = 0.0
    saved = SavedUp(rate=0.1, most=0.0, longest=3.0, clock=lambda: now)
    saved.spend(50.0)
    assert saved.wait == pytest.approx(3.0)
    now += 3.0
    assert saved.wait == pytest.approx(0.0)


def test_each_has_a_bucket_of_its_own_and_so_many_are_counted_and_no_more():
    now = 0.0
    found = SavedUpEach(1.0, 2.0, longest=4.0, clock=lambda: now)
    for _ in range(3):
        found.note("one")
    found.note("another", 100.0)
    assert (found.wait("one"), found.wait("another"), found.wait("a third")) == pytest.approx((1.0, 4.0, 0.0))
    now += 1.0
    assert (found.wait("one"), found.wait("another")) == pytest.approx((0.0, 3.0))
    for k in range(SavedUpEach.MOST + 50):
        found.note(f"key {k}")
    assert len(found._left) == SavedUpEach.MOST
    assert found.wait("another") == 0.0
