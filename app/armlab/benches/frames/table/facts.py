"""Facts of the table task that lessons can check."""

from __future__ import annotations

from armlab.benches.frames.table.reach import asked_of
from armlab.benches.frames.table.state import TableTask, corner_of, task_of
from armlab.session.facts import Fact, Facts

FACTS = Facts(
    __name__,
    (TableTask,),
    {
        "corner": Fact("the origin of the frame of the table in the world", corner_of, "m", "numbers"),
        "turn": Fact("the angle of the table", lambda s: s[TableTask].turn, "rad"),
        "object": Fact("the object in the frame of the table", lambda s: task_of(s).p_t, "m", "numbers"),
        "height": Fact("the height of the tool above the object", lambda s: s[TableTask].height, "m"),
        "position": Fact("the tool in the frame of the table", lambda s: task_of(s).p_te, "m", "numbers"),
        "orientation": Fact(
            "the orientation of the tool on the table, row by row", lambda s: task_of(s).R_te.ravel(), kind="numbers"
        ),
        "in_world": Fact("the tool in the world, row by row, m", lambda s: task_of(s).T_we.ravel(), kind="numbers"),
        "asked": Fact(
            "the tool in the base of the arm, row by row, m", lambda s: asked_of(s).T_be.ravel(), kind="numbers"
        ),
        "away": Fact("the distance of the tool from where it is wanted", lambda s: asked_of(s).away, "m"),
        "turned": Fact("the angle between the tool and how it is wanted", lambda s: asked_of(s).turned, "rad"),
    },
)
