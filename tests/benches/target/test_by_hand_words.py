"""The words of derivations in other languages: steps, branches and endings, also singular ones and out of reach."""

import math

import numpy as np
import pytest

from armlab.benches.target.by_hand.state import ByHand, sheet
from armlab.benches.target.by_hand.ui.page import sheet_markup
from armlab.content.languages import keys, messages, words_in
from armlab.content.robots import catalogue
from armlab.kin.ik.by_hand import method_of
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import Target
from armlab.session.state import State, apply
from armlab.ui.units import units_of
from support.forms import BareForm
from support.saying import Listener
from support.searched import searched

BY_HAND = frozenset({"by_hand"})
COVERED = [key for key, robot in catalogue().robots.items() if method_of(robot.arm) is not None]


def targets_of(arm, rng):
    """Yield joint values and targets: as they come, at quarter turns, on axis 1, too near and too far."""
    for k in range(6):
        q = rng.uniform(*arm.limits.T)
        q = np.where(rng.random(arm.n) < 0.6, np.round(q / (math.pi / 2)) * (math.pi / 2), q) if k else q
        q = np.asarray(arm.clip(0.0 * q if k == 5 else q))
        for size in (1.0, 0.3, 0.0, 3.0):
            T = np.array(arm.fk(q))
            T[:3, 3] *= size
            T.setflags(write=False)
            yield q, T


def shown(state):
    form = BareForm()
    return str(sheet_markup(form, state, state.derived(sheet), units_of(state)))


@pytest.mark.parametrize("language", keys()[1:])
@pytest.mark.parametrize("key", COVERED)
def test_all_that_a_derivation_says_is_translated(language, key):
    listener = Listener(messages(language))
    listener.at("page/by_hand")
    state = apply(State.initial(catalogue()[key]), Set(ByHand, "unfolded", True))
    for q, T in targets_of(state[Joints].arm, np.random.default_rng([7, *key.encode()])):
        there = state.replace(state[Joints].freed_at(q))
        there = there.replace(there[Target].with_values({"pose": T}))
        listener.hear_markup([shown(there)])
    assert sorted(listener.missing) == []


@pytest.mark.parametrize("language", keys()[1:])
@pytest.mark.parametrize(
    ("key", "q"), [("elbow_3r", (0.4, 0.5, 0.0)), ("polar_rrp", (0.0, 0.0, 0.0)), ("irb140", None)]
)
def test_the_place_in_the_list_of_all_solutions_is_translated(language, key, q):
    listener = Listener(messages(language))
    listener.at("page/by_hand")
    state = State.initial(catalogue()[key])
    state = searched(state.replace(state[Joints].freed_at(np.zeros(6) if q is None else q)), BY_HAND)
    listener.hear_markup([shown(state)])
    assert "page Solutions" in shown(state) or "infinitely many" in shown(state)
    assert sorted(listener.missing) == []


@pytest.mark.parametrize("language", keys()[1:])
def test_the_names_of_singular_branches_are_translated(language):
    words = words_in(language)
    for name in (
        "shoulder above, elbow beside, wrist straight (2)",
        "shoulder front, elbow straight",
        "elbow folded (1)",
        "slide beside the axis",
    ):
        said = words(name)
        assert not any(part in said for part in name.rstrip("() 12").split(", "))
