"""Turns by need: whoever has taken least lately is next, and of those who have taken little whoever came first."""

from armlab.session import served
from armlab.session.served import ALIKE, MEMORY, Served


def test_who_has_taken_least_is_next_and_what_was_taken_is_forgotten():
    now = 0.0
    turns = Served(lambda: now)
    turns.add("greedy", 20.0 * ALIKE)
    turns.add("busy", 5.0 * ALIKE)
    turns.add("modest", 0.5 * ALIKE)
    assert turns.least(["greedy", "busy", "new", "modest"]) == "new"
    assert turns.least(["greedy", "busy", "modest"]) == "modest"
    assert turns.least(["greedy", "busy"]) == "busy"
    assert [turns.is_modest(each) for each in ("greedy", "busy", "modest", "new")] == [False, False, True, True]
    now += 10.0 * MEMORY
    assert turns.least(["greedy", "busy", "new", "modest"]) == "greedy", "the first of those who have taken little"
    assert turns.is_modest("greedy")


def test_only_those_who_have_taken_most_are_remembered(monkeypatch):
    monkeypatch.setattr(served, "MOST", 10)
    turns = Served(lambda: 0.0)
    turns.add("greedy", 20.0 * ALIKE)
    for k in range(100):
        turns.add(k, 1e-6)
    assert len(turns._taken) <= 10
    assert not turns.is_modest("greedy")
