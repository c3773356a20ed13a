"""What the pages of ellipsoids and statics say of arms in any configuration, in other languages."""

import re

import numpy as np
import pytest

from armlab.benches.velocity.ellipsoid.state import LookAtBlock, Manipulability, blocks_of, present
from armlab.benches.velocity.ellipsoid.state_sweep import SweepJoint, singularities
from armlab.benches.velocity.ellipsoid.ui.page import _axes, _cards, _numbers
from armlab.benches.velocity.ellipsoid.ui.plots import _singular
from armlab.benches.velocity.statics.state import ReleaseWrench, SetComponent, WriteAlong
from armlab.benches.velocity.statics.ui.words import duality_markup, free_markup, torques_markup, verdict_markup
from armlab.content.languages import keys, messages
from armlab.content.robots import catalogue
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.state import State, apply
from armlab.ui.html import joined
from armlab.ui.units import units_of
from support.saying import Listener

WRENCHES = (
    (),
    (ReleaseWrench(),),
    (ReleaseWrench(), SetComponent("moment", 2, 3.0)),
    (SetComponent("force", 0, 3.0), WriteAlong("tool")),
)


@pytest.mark.parametrize("language", keys()[1:])
def test_velocities_and_forces_are_told_of_every_arm_at_its_zeros_and_at_its_limits(language):
    listener = Listener(messages(language))
    listener.at("results")

    def heard(*inside):
        # Words for those who have the notes are no part of what everybody reads.
        listener.hear_markup([re.sub("⟦[^⟧]*⟧", "", joined(each)) for each in inside])

    for robot in catalogue().robots.values():
        arm, state = robot.arm, State.initial(robot)
        units = units_of(state)
        for q in (arm.clip(np.zeros(arm.n)), arm.limits[:, 0]):
            there = state.replace(state[Joints].moved_to(np.array(q)))
            for key in blocks_of(arm):
                seen = apply(apply(there, LookAtBlock(key)), Set(Manipulability, "shown", "both"))
                part, found = seen[Manipulability], seen.derived(present)
                heard(_axes(part, found), _cards(part, found), _numbers(part, found, units))
                for joint in range(arm.n):
                    places = singularities(apply(seen, SweepJoint(joint)))
                    heard(_singular(places, arm.limits[joint], units, joint, bool(arm.revolute[joint])))
            for wrench in WRENCHES:
                pressed = there
                for command in wrench:
                    pressed = apply(pressed, command)
                heard(*(of(pressed) for of in (torques_markup, verdict_markup, free_markup, duality_markup)))
    assert sorted(listener.missing) == []
