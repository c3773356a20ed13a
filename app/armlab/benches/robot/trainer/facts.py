"""Facts of the exercise of frames and table that lessons can check: the number of right answers."""

from __future__ import annotations

from armlab.benches.robot.trainer.state import Trainer
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _frames(state: State) -> int:
    return sum(mark is not None and mark.ok for mark in state[Trainer].frame_marks)


def _cells(state: State) -> int:
    return sum(mark.ok for row in state[Trainer].cell_marks for mark in row.values())


FACTS = Facts(
    __name__,
    (Trainer,),
    {
        "started": Fact("the exercise has begun", lambda s: s[Trainer].started, kind="truth"),
        "right_frames": Fact("the number of frames that were checked and are right", _frames, kind="count"),
        "placed": Fact("all axes are right and the table is open", lambda s: s[Trainer].answers.placed, kind="truth"),
        "right_cells": Fact("the number of cells that were checked and are right", _cells, kind="count"),
        "done": Fact("every cell is right", lambda s: s[Trainer].done, kind="truth"),
    },
)
