"""What is said of a drag."""

import math

import numpy as np
import pytest

from armlab.benches.target.solutions.state import GoToSolution
from armlab.content.languages import keys, messages
from armlab.content.robots import catalogue
from armlab.kin.conditioning import NEAR
from armlab.session.asked import ASKED, asks_of
from armlab.session.branch_words import STILL_NEAR, near_singularity
from armlab.session.edits import SetLimits
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.notation import Notation
from armlab.session.parts.target import AskFor, DragTarget, Target, _placed, target_pose, verdict
from armlab.session.state import apply
from armlab.ui.units import Units
from armlab.ui.verdicts import verdict_card
from support.bare_gui import BarePage, words
from support.saying import Listener
from support.searched import moved, opened, rows, searched

# -- words on a drag ---------------------------------------------------------------------------------------------


def test_a_drag_over_a_border_says_which_branch_it_has_left():
    state = apply(opened("planar_2r"), MoveJoint(1, math.radians(20.0)))
    q = state[Joints].q
    wanted = state[Joints].arm.fk([q[0] + math.radians(30.0), math.radians(-20.0)])
    state = apply(state, DragTarget(target_pose(state), 1), at=0.0)
    # Along the outer circle the elbow stretches and bends to the other side; `_placed` is the drag's own last step.
    there = _placed(state, np.array(wanted), np.array([q[0] + math.radians(30.0), math.radians(-20.0)]), False)
    there = there.dated(1.0)
    there = there.replace(there[Target].after(state, there))
    assert there.derived(verdict).notes[0] == "the elbow has changed from down to up"


def drag_through(state, goals, start=0.0, step=0.05):
    """Return all states of a drag through joint values, one each 50 ms."""
    arm, states = state[Joints].arm, []
    for k, q in enumerate(goals):
        state = apply(state, DragTarget(arm.fk(q), 1), at=start + k * step)
        states.append(state)
    return states


def test_a_singularity_stays_near_until_the_arm_is_well_away_from_it():
    state = opened("puma560")
    home = state[Joints].q
    arm = state[Joints].arm

    def at(degrees):
        return np.r_[home[:4], math.radians(degrees), home[5]]

    angles = np.linspace(-20.0, -0.5, 400)
    near = [bool(near_singularity(arm, at(angle), NEAR)) for angle in angles]
    still = [bool(near_singularity(arm, at(angle), STILL_NEAR)) for angle in angles]
    between = float(angles[[is_still and not is_near for is_still, is_near in zip(still, near, strict=True)]].mean())

    def said(states):
        return any("wrist singularity" in text for text in states[-1].derived(verdict).notes)

    coming = drag_through(state, [at(angle) for angle in np.linspace(math.degrees(home[4]), between, 40)])
    assert not said(coming)
    there = drag_through(coming[-1], [at(angle) for angle in np.linspace(between, -1.0, 20)], start=3.0)
    assert said(there)
    back = drag_through(there[-1], [at(angle) for angle in np.linspace(-1.0, between, 20)], start=5.0)
    # Held there for longer than a message that is no longer true would linger.
    held = drag_through(back[-1], [at(between + 0.01 * (k % 2)) for k in range(80)], start=6.0)
    assert said(held)


def test_nearing_a_singularity_is_said_by_name_and_not_for_ever():
    state = opened("puma560")
    home = state[Joints].q
    ways = np.linspace(home[4], 0.0, 60)
    goals = [np.r_[home[:4], angle, home[5]] for angle in ways]
    states = drag_through(state, goals)
    notes = [s.derived(verdict).notes for s in states]
    assert notes[0] == ()
    assert any("near a wrist singularity: axes 4 and 6 are nearly in line" in note for note in notes[-1])
    said = [any("wrist singularity" in text for text in note) for note in notes]
    assert said == sorted(said)  # no flicker
    back = drag_through(states[-1], goals[::-1], start=3.0)
    said = [any("wrist singularity" in text for text in s.derived(verdict).notes) for s in back]
    assert said[0]
    later = apply(back[-1], DragTarget(moved(back[-1], 0.0, 0.0, 0.001), 1), at=60.0)
    assert later.derived(verdict).notes == ()


def test_a_jump_that_was_wished_is_no_news():
    state = searched(opened("ur10_notes", "eight"))
    state = apply(state, DragTarget(moved(state, 0.01, 0.0, 0.0), 1))
    there = apply(searched(state), GoToSolution(rows(state)[5].slot))
    assert there.derived(verdict).notes == ()
    on = apply(there, DragTarget(moved(there, 0.005, 0.0, 0.0), 2))
    assert not any("changed" in note for note in on.derived(verdict).notes)
    assert apply(on, MoveJoint(0, 0.2)).derived(verdict).notes == ()


# -- where less than the pose counts -------------------------------------------------------------------------------


@pytest.mark.parametrize("language", keys()[1:])
@pytest.mark.parametrize("key", ["planar_3r", "puma560"])
def test_a_list_for_the_whole_pose_says_so_where_only_a_part_of_the_target_counts(key, language):
    page, listener = BarePage("solutions", catalogue()[key], language), Listener(messages(language))
    listener.at("page/solutions")
    assert "The list is for the whole pose" not in words(page)
    for asks, said in ASKED.items():
        page.session.apply(AskFor(asks=asks), 0.0)
        page.show()
        counts = asks in asks_of(catalogue()[key].arm)
        assert (f"with the orientation that the tool has now, although {said}." in words(page)) is counts
        listener.hear(page)
        listener.hear_markup([str(verdict_card(page.session.state.derived(verdict), Units(Notation())))])
    assert sorted(listener.missing) == []


@pytest.mark.parametrize(("turns", "said"), [(1.5, " 27 ways inside"), (9.5, "at least 4096 ways inside")])
def test_ways_by_whole_turns_are_counted_as_far_as_they_are_listed(turns, said):
    page = BarePage("solutions", catalogue()["planar_3r"])
    for joint in range(3):
        page.session.apply(SetLimits(joint, -turns * math.tau, turns * math.tau), 0.0)
    page.session.state = searched(page.session.state)
    page.show()
    assert said in words(page)
    assert ("at least" in said) is ("at least" in words(page))
