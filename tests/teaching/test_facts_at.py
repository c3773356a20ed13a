"""Facts at many configurations are those of the states in which the arm stands there."""

import pytest

from armlab.content.robots import catalogue
from armlab.session.facts import facts_of_benches, seen_facts
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import Target
from armlab.session.state import State
from armlab.teaching import facts_at as facts_at_module
from armlab.teaching.facts_at import FactsAt

QUICK = ("velocity.statics", "velocity.speeds", "sensor.absolute", "drive.gears", "frames.chain")


def test_every_fact_is_that_of_the_state(rng):
    state = State.initial(catalogue()["puma560"])
    benches = facts_of_benches().values()
    words = tuple(f"{bench.key}.{name}" for bench in benches if bench.key in QUICK for name in bench.facts)
    facts_at, limits = FactsAt(state, words), state[Joints].arm.limits
    before, changed = seen_facts(state, words), set()
    for q in rng.uniform(limits[:, 0], limits[:, 1], (3, 6)):
        expected, found = seen_facts(state.replace(state[Joints].moved_to(q)), words), facts_at(q)
        assert repr({word: found[word] for word in words}) == repr(expected)  # also where a value is no number
        changed |= {word for word in words if repr(expected[word]) != repr(before[word])}
    assert changed
    assert changed <= set(facts_at._moving)
    assert 0 < len(facts_at._moving) < len(words)


WAYS = {
    "the joints": (lambda state: state[Joints], True),
    "all parts": (list, True),
    "a state with another part": (lambda state: state.replace(state[Target]), True),
    "the state at another time": (lambda state: state.dated(1.0), True),
    "another part": (lambda state: state[Target], False),
}


@pytest.mark.parametrize(("looked", "seen"), WAYS.values(), ids=WAYS)
def test_whoever_may_look_at_the_joints_is_noticed(looked, seen):
    watched = facts_at_module._Watched(State.initial(catalogue()["planar_2r"]))
    looked(watched)
    assert watched.joints_read is seen
