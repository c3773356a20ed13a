"""What the pages of the workspace say of their results, which come after they are opened, in other languages."""

import re

import numpy as np
import pytest

from armlab.benches.workspace.dexterous.job import studied
from armlab.benches.workspace.dexterous.places import GoToRegion
from armlab.benches.workspace.dexterous.state import Dexterous
from armlab.benches.workspace.dexterous.ui import page as dexterous
from armlab.benches.workspace.section.job import found_section
from armlab.benches.workspace.section.state import SectionView, found_of
from armlab.benches.workspace.section.ui.page import choices_markup, view_markup
from armlab.benches.workspace.section.ui.words import facts
from armlab.benches.workspace.what_if.found import comparing
from armlab.benches.workspace.what_if.job import delivered, wanted
from armlab.benches.workspace.what_if.state import Suppose
from armlab.benches.workspace.what_if.ui.page import told_markup
from armlab.content.languages import keys, messages
from armlab.content.robots import catalogue, own_robot
from armlab.kin.arm import Arm
from armlab.kin.dh import Row
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.target import PlaceTarget
from armlab.session.state import State, apply
from armlab.ui.html import joined
from armlab.ui.units import units_of
from support.forms import BareForm
from support.saying import Listener

OTHERS = keys()[1:]
OWN = {
    "one joint": Arm.from_dh([Row("R", 1.0, 0.0)]),
    "wrist on a line": Arm.from_dh([Row("P"), Row("R", 0.0, np.pi / 2), Row("R", 0.0, -np.pi / 2), Row("R", 0.0)]),
}


def opened(key):
    return State.initial(own_robot(OWN[key], key) if key in OWN else catalogue()[key])


class Heard:
    """Keeps what is not known of what it is given."""

    def __init__(self, language):
        self.listener = Listener(messages(language))
        self.listener.at("results")

    def __call__(self, *inside):
        # Words for those who have the notes are no part of what everybody reads.
        self.listener.hear_markup([re.sub("⟦[^⟧]*⟧", "", joined(each)) for each in inside])

    @property
    def missing(self):
        return sorted(self.listener.missing)


@pytest.mark.parametrize("language", OTHERS)
@pytest.mark.parametrize(
    ("key", "changes"),
    [
        ("planar_2r", [Suppose(1, "a", 1.2)]),
        ("planar_2r", [Suppose(1, "a", 0.8), Suppose(0, "high", 1.0)]),
        ("planar_2r", [Suppose(0, "alpha", 0.5)]),
        ("planar_3r", [Suppose(0, "alpha", 0.5)]),
        ("cartesian_3p", [Suppose(1, "high", 0.3), Suppose(3, "x", 0.1)]),
        ("one joint", [Suppose(0, "a", 1.3)]),
    ],
)
def test_what_another_design_does_to_the_workspace_is_told(language, key, changes):
    heard, state = Heard(language), opened(key)
    for change in changes:
        state = apply(state, change)
    question = wanted(state, frozenset({"what_if"})).inputs
    for found in comparing(question):
        if found is not None:
            state = delivered(state, question, found)
            heard(told_markup(BareForm(), state, units_of(state)))
    assert heard.missing == []


@pytest.mark.parametrize("language", OTHERS)
@pytest.mark.parametrize("key", ["planar_2r", "cartesian_3p", "one joint"])
def test_the_section_is_told(language, key):
    heard, state = Heard(language), found_section(apply(opened(key), Set(SectionView, "colour", "sigma_min")))
    found, units = found_of(state), units_of(state)
    T = np.array(state[Joints].tool_pose)
    T[:3, 3] *= 2.0
    heard(facts(found, units), choices_markup(BareForm(), state, units))
    for each in (state, apply(state, PlaceTarget(T))):
        heard(view_markup(BareForm(), each, found, units))
    assert heard.missing == []


@pytest.mark.parametrize("language", OTHERS)
@pytest.mark.parametrize(
    ("key", "method"),
    [
        ("planar_2r", "rings"),
        ("planar_3r", "rings"),
        ("planar_3r_unequal", "rings"),
        ("planar_2r", "count"),
        ("elbow_3r", "count"),
        ("cartesian_3p", "sampled"),
        ("polar_rrp", "sampled"),
        ("wrist on a line", "sampled"),
    ],
)
def test_orientations_are_told(language, key, method):
    heard = Heard(language)
    state = apply(apply(opened(key), Set(Dexterous, "method", method)), Set(Dexterous, "count", 400_000))
    state = studied(state)
    places = [apply(state, GoToRegion(k)) for k in range(3)] if method == "rings" else [apply(state, MoveJoint(0, 0.4))]
    for each in (state, *places):
        units = units_of(each)
        heard(dexterous.choices_markup(BareForm(), each, units), dexterous._told(each, units))
        if method == "rings":
            heard(dexterous.tool_words(each, units), dexterous.regions_table(BareForm(), each, units))
    assert heard.missing == []
