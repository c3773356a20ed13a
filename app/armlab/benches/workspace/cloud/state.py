"""The sampled workspace: the request, the samples so far, and how they are shown."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from armlab.benches.workspace.cloud.samples import Question, Sampled
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.workspace.measures import MEASURES
from armlab.kin.workspace.section import Section
from armlab.session.counted import refuse_beyond
from armlab.session.fields import FieldPart, choice, flag, number, whole
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import PlaceTarget, brought_to
from armlab.session.state import Command, PartType, State

COUNTS = (26_000, 100_000, 1_000_000, 10_000_000)
"""Numbers of samples that can be chosen."""

DRAWINGS = {"cloud": "Points", "voxels": "Voxels", "surface": "Surface"}

CUTS = {"none": "Whole", "front": "Half", "x": "x", "y": "y", "z": "z"}
"""Parts that are left out: nothing, the half in front of the arm, or all but a slice across an axis of frame 0."""

AUTO = "auto"
"""The cut that nobody has chosen: it shows most of what there is; see `armlab.benches.workspace.cloud.cuts`."""

FARTHEST = 1e4
"""Largest distance of a slice from the origin, metres: no table makes an arm that reaches so far."""

LARGEST_SEED = 2**31


@dataclass(frozen=True, eq=False)
class Workspace(FieldPart):
    """The requested workspace, and its picture.

    Attributes
    ----------
    measure : str
        Key of the measure that colours it.
    count, seed : int
        Samples, and the seed of their random numbers.
    draw : str
        Key of `DRAWINGS`.
    cut : str
        Key of `CUTS`, or `AUTO`.
    offset : float or None
        Of a slice from the origin of frame 0, metres; None for where most points are.
    edge : bool
        Whether only what is near the boundary is drawn.
    clicks : bool
        Whether a click in the scene chooses a point.
    asked : Question or None
        What is being sampled.
    found : Sampled or None
        What there is; not saved.
    section : Section or None
        Where it ends, once it is drawn; not saved.
    chosen : int or None
        The sample the arm went to last.
    example : str
        Key of the example that was loaded last.
    """

    key: ClassVar[str] = "workspace"
    kept_by_undo: ClassVar[bool] = True

    measure: str = choice("measure", "manipulability", {key: each.title for key, each in MEASURES.items()})
    count: int = whole("samples", COUNTS[1], 1)
    seed: int = whole("seed", 0, 0, LARGEST_SEED - 1)
    draw: str = choice("drawing", "cloud", DRAWINGS)
    cut: str = choice("cut", AUTO, {AUTO: "as the points lie", **CUTS})
    offset: float | None = number("", "place of the slice", None, unit="m", kept="")
    edge: bool = flag("only near the boundary", False)
    clicks: bool = flag("a click chooses a point", True)
    asked: Question | None = None
    found: Sampled | None = None
    section: Section | None = None
    chosen: int | None = None
    example: str = ""

    def check(self) -> None:
        """Refuse a number of samples that is not offered, and a slice too far away."""
        if self.count not in COUNTS:
            raise UnknownName("samples", self.count, [str(count) for count in COUNTS])
        if self.offset is not None and not abs(self.offset) <= FARTHEST:
            raise InputError(f"place of the slice: expected at most {FARTHEST:g} m either way, got {self.offset:g} m")


PART = PartType(Workspace, order=120)


def question_of(state: State) -> Question:
    """Return the request for the workspace with the present settings."""
    part = state[Workspace]
    return Question(state[Joints].arm, part.measure, part.count, part.seed)


def asks_for_boundary(part: Workspace, arm: Arm) -> bool:
    """Return whether the boundary, or its distance, is to be drawn and is not known yet."""
    drawn = part.edge or part.draw == "surface"
    return drawn and part.found is not None and (part.section is None or part.section.joint.arm is not arm)


@dataclass(frozen=True)
class SampleWorkspace(Command):
    """Sample the workspace with the present settings; a running job is given up."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state in which the workspace is being sampled."""
        return state.replace(replace(state[Workspace], asked=question_of(state)))


@dataclass(frozen=True)
class CancelWorkspace(Command):
    """Stop sampling; the samples so far stay."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state in which nothing is being sampled."""
        part = state[Workspace]
        return state if part.asked is None else state.replace(replace(part, asked=None))


@dataclass(frozen=True)
class ClearWorkspace(Command):
    """Forget the workspace."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state without a workspace."""
        return state.replace(replace(state[Workspace], asked=None, found=None, chosen=None, example=""))


@dataclass(frozen=True)
class LookAtWorkspace(Command):
    """Change settings; None leaves one unchanged. Another measure is computed at once if there are samples.

    A slice across another axis begins where most points are.
    """

    measure: str | None = None
    count: int | None = None
    seed: int | None = None
    draw: str | None = None
    cut: str | None = None
    offset: float | None = None
    edge: bool | None = None
    clicks: bool | None = None
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the settings; `InputError` for an invalid one."""
        before = state[Workspace]
        given = {name: value for name, value in vars(self).items() if value is not None}
        if self.cut is not None and self.cut != before.cut:
            given.setdefault("offset", None)
        part = before.with_values(given)
        if any(getattr(part, name) != getattr(before, name) for name in ("measure", "draw", "cut")):
            part = replace(part, example="")
        changed = state.replace(part)
        other = part.measure != before.measure
        if other and (before.found is not None or before.asked is not None):
            return changed.replace(replace(part, asked=question_of(changed)))
        return changed


@dataclass(frozen=True)
class GoToSample(Command):
    """Move the arm to the configuration of a sample of the workspace; the target goes along.

    Parameters
    ----------
    index : int
        Of those that are drawn.
    """

    index: int
    label: ClassVar[str] = "jump into the workspace"

    def apply(self, state: State) -> State:
        """Return the state with the arm there; `InputError` if there is no such sample."""
        q = _configuration(state, self.index)
        return brought_to(state.replace(replace(state[Workspace], chosen=self.index)), q)


@dataclass(frozen=True)
class AimAtSample(Command):
    """Place the target at the tool pose of a sample, to see all solutions there."""

    index: int
    label: ClassVar[str] = "target in the workspace"

    def apply(self, state: State) -> State:
        """Return the state with the target there; `InputError` if there is no such sample."""
        pose = state[Joints].arm.fk(_configuration(state, self.index))
        return PlaceTarget(np.array(pose, dtype=np.float64)).apply(GoToSample(self.index).apply(state))


def _configuration(state: State, index: int) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    found, arm = state[Workspace].found, state[Joints].arm
    if found is None or found.question.arm is not arm:
        raise InputError("there is no workspace of this arm yet: sample it first")
    refuse_beyond(index, len(found.shown.q), "sample")
    return np.asarray(arm.clip(found.shown.q[index].astype(np.float64)))
