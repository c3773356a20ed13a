"""The workspaces of an arm as it is and of the supposed arm, side by side."""

from __future__ import annotations

from collections.abc import Generator, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.workspace.cloud import Samples, samples
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.section import Section
from armlab.kin.workspace.section_size import Reach, Size, reaching, sizing
from armlab.kin.workspace.sections import sections

Mask = NDArray[np.bool_]

POINTS = 24_576
"""Number of samples of each arm that are drawn."""

PIECE = 20_480
"""Number of samples that come at a time after the first few, some milliseconds of work."""

RESOLUTION, SECTION_SAMPLES = 96, 32_768
"""Number of cells along the section, and of its first samples: enough to compare two arms, in about a second."""

WANTED = 0.05
"""Relative error of a size that is small enough to compare two arms; a thin workspace takes a little longer."""

ROUGH = 8
"""Number of pieces of work after which a section gives a first figure, about a tenth of a second."""

REMEMBERED = 4
"""Number of arms whose workspace is kept: every change asks again for the one before it."""

SEED = 0


@dataclass(frozen=True, eq=False)
class Question:
    """Two arms, compared by identity.

    Attributes
    ----------
    before, after : Arm
        The same object when nothing is changed.
    """

    before: Arm
    after: Arm


@dataclass(frozen=True)
class Figures:
    """Size and reach of one workspace, as far as they are known.

    Attributes
    ----------
    reach : Reach
        Metres; of `refined` ones from the boundary, else of samples and so a little too small.
    size : Size or None
        Volume, or area of a planar arm; of figures that are not refined its error is not known.
    refined : bool
    """

    reach: Reach
    size: Size | None
    refined: bool

    @property
    def extended(self) -> bool:
        """Whether it has a volume, or an area of a planar arm, and is no line or surface."""
        return self.size is not None and self.size.value > 0.0


@dataclass(frozen=True, eq=False)
class Compared:
    """Two workspaces, as far as they are known.

    Attributes
    ----------
    before, after : Arm
    old, new : Samples
        Those that are drawn.
    figures : (Figures, Figures)
        Before and after; both rough or both refined, because a rough size is too large by a part of its boundary cells.
    lost, gained : ndarray of bool or None
        Which points of ``old`` cannot be reached any more, and which of ``new`` could not be before; known at the end.
    sections : (Section, Section) or None
        Before and after, once both are finished.
    """

    before: Arm
    after: Arm
    old: Samples
    new: Samples
    figures: tuple[Figures, Figures]
    lost: Mask | None = None
    gained: Mask | None = None
    sections: tuple[Section, Section] | None = None

    @property
    def same(self) -> bool:
        """Whether there is only one arm."""
        return self.before is self.after

    @property
    def finished(self) -> bool:
        """Whether the work is done."""
        return self.lost is not None

    @property
    def told_apart(self) -> bool:
        """Whether it is known which points are lost and gained: of two lines or surfaces it is not."""
        return self.finished and any(each.extended for each in self.figures)


@dataclass(eq=False)
class _Known:
    """Results for the workspace of one arm, kept for the next request."""

    points: Samples | None = None
    rough: Figures | None = None
    section: Section | None = None
    refined: Figures | None = None


@lru_cache(maxsize=REMEMBERED)
def _known(arm: Arm) -> _Known:
    return _Known()


def comparing(question: Question) -> Iterator[Compared | None]:
    """Yield both workspaces, refined step by step; None if there is nothing new. Remembered ones come at once."""
    before, after = question.before, question.after
    old, new = _known(before), _known(after)
    for _ in _sampling(before, old):
        yield None
    assert old.points is not None
    for points in _sampling(after, new):
        figures = (_of_samples(before, old.points), _of_samples(after, points))
        yield Compared(before, after, old.points, points, figures)
    assert new.points is not None
    found = Compared(before, after, old.points, new.points, figures)
    work = [(known, _looking(arm, known)) for arm, known in {before: old, after: new}.items()]
    for known, pieces in work:
        for _ in pieces:
            yield None
            if known.rough is not None:
                break
    if old.rough is not None and new.rough is not None:
        found = replace(found, figures=(old.rough, new.rough))
        yield found
    for _, pieces in work:
        yield from pieces
    assert old.refined is not None
    assert new.refined is not None
    assert old.section is not None
    assert new.section is not None
    found = replace(found, figures=(old.refined, new.refined), sections=(old.section, new.section))
    yield found
    lost = yield from _only(old, new)
    yield replace(found, lost=lost, gained=(yield from _only(new, old)))


def _only(own: _Known, other: _Known) -> Generator[None, None, Mask]:
    """Return, after pieces of work, which drawn points of an arm the other arm does not reach.

    On the boundary a point may be told to be outside, of its own workspace, too: of that nothing is said.
    """
    assert own.points is not None
    assert own.section is not None
    assert other.section is not None
    points = own.points.points
    alone = np.asarray(~other.section.holds(points))
    yield
    # A line or a surface holds none of its points.
    return alone & own.section.holds(points) if own.refined is not None and own.refined.extended else alone


def _sampling(arm: Arm, known: _Known) -> Iterator[Samples]:
    """Yield the points so far, at last all of them; known ones come at once."""
    so_far: list[Samples] = []
    if known.points is None:
        for piece in samples(arm, POINTS, SEED, chunk=PIECE):
            so_far.append(piece)
            yield _joined(so_far)
        known.points = _joined(so_far)
    yield known.points


def _joined(pieces: list[Samples]) -> Samples:
    return Samples(*(np.concatenate(parts) for parts in zip(*pieces, strict=True)))


def _of_samples(arm: Arm, found: Samples) -> Figures:
    """Return the figures from samples, which fall a little short of the boundary."""
    u, v, _ = first_joint(arm).split(found.points).T
    ends = u.min(), u.max(), v.min(), v.max(), np.hypot(u, v).max()
    return Figures(Reach(*map(float, ends)), None, False)


def _looking(arm: Arm, known: _Known) -> Iterator[None]:
    """Work until there are rough figures, and then until they are refined."""
    if known.refined is not None:
        return
    # The formulas of an arm are made when they are first used.
    arm.jacobian(np.zeros((1, arm.n)))
    yield
    for k, found in enumerate(sections(arm, RESOLUTION, SECTION_SAMPLES, SEED, WANTED)):
        yield
        if k == ROUGH and not found.finished:
            seen = found if found.around is None else replace(found, arcs=found.around.arcs())
            known.rough = yield from _figures(seen, False)
    known.refined = yield from _figures(found, True)
    known.section = found


def _figures(found: Section, refined: bool) -> Generator[None, None, Figures]:
    """Return, after pieces of work, the figures of a section."""
    far = yield from reaching(found)
    return Figures(far, (yield from sizing(found)), refined)
