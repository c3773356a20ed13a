"""The job that finds the boundary of a sampled workspace, if it or the points near it are drawn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from armlab.benches.workspace.cloud.state import Workspace, asks_for_boundary
from armlab.kin.arm import Arm
from armlab.kin.workspace.section import Section
from armlab.kin.workspace.sections import sections
from armlab.kin.workspace.surface import near_boundary
from armlab.session.job import Job, Wanted
from armlab.session.parts.joints import Joints
from armlab.session.state import State


def wanted(state: State, panels: frozenset[str]) -> Wanted | None:
    """Return the arm whose boundary is missing."""
    arm = state[Joints].arm
    return Wanted(arm, arm) if asks_for_boundary(state[Workspace], arm) else None


def run(arm: Arm) -> Iterator[Section | None]:
    """Yield the section when it is finished."""
    for section in sections(arm):
        if not section.finished:
            yield None
            continue
        # What shows it must neither compute this in the time of everybody nor load the library that finds neighbours.
        yield from section.boundary.preparing()
        near_boundary(section, np.zeros((1, 3)), 0.0)
        yield section


def delivered(state: State, arm: Arm, found: Section) -> State:
    """Return the state with the section; a section of another arm is dropped."""
    part = state[Workspace]
    if state[Joints].arm is not arm or not asks_for_boundary(part, arm):
        return state
    return state.replace(replace(part, section=found))


def with_boundary(state: State) -> State:
    """Return the state with the boundary it asks for, for tests and for callers that can wait."""
    arm = state[Joints].arm
    for found in run(arm) if asks_for_boundary(state[Workspace], arm) else ():
        state = state if found is None else delivered(state, arm, found)
    return state


JOB = Job("workspace_boundary", "The boundary of the workspace", wanted, run, delivered)
