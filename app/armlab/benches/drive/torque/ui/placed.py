"""Marks that are made in the model, put into the world."""

from __future__ import annotations

from armlab.benches.drive.stage import Floats, placed_at
from armlab.ui.scene._marks import Marks, Segment


def in_world(marks: Marks, pose: Floats, unit: float) -> Marks:
    """Return the marks of a model in the world; see `armlab.benches.drive.stage.stage_of`."""

    def moved(segments: list[Segment]) -> list[Segment]:
        return [(placed_at(pose, unit, a), placed_at(pose, unit, b), colour) for a, b, colour in segments]

    return Marks(moved(marks.arrows), moved(marks.strokes), marks.label, placed_at(pose, unit, marks.at))
