"""Facts of the table that lessons can check: the kind of arm, its determinant, and the place of its tool point."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from armlab.benches.robot.table.state import Point, world_point
from armlab.kin.relations import axis_relations
from armlab.kin.structure import structure_of
from armlab.kin.velocity.subspaces import task_matrix
from armlab.session.facts import Fact, Facts
from armlab.session.parts.joints import Joints
from armlab.session.state import State


def _determinant(state: State) -> float | None:
    """Return the determinant of the task's Jacobian in metres and radians, or None if that is not square."""
    J = task_matrix(state[Joints].arm, state[Joints].q)
    return float(np.linalg.det(J)) if J.shape[0] == J.shape[1] else None


def _relations(kind: str) -> Callable[[State], int]:
    return lambda state: sum(relation.kind == kind for relation in axis_relations(state[Joints].arm))


FACTS = Facts(
    __name__,
    (Point,),
    {
        "joints": Fact("the number of joints", lambda s: s[Joints].arm.n, kind="count"),
        "kinds": Fact(
            "the joints, R or P each", lambda s: "".join(row.kind for row in s[Joints].arm.rows), kind="text"
        ),
        "determinant": Fact("the determinant of the Jacobian of the task, in metres and radians", _determinant),
        "structure": Fact(
            "the kind of arm, for closed forms", lambda s: structure_of(s[Joints].arm).title, kind="text"
        ),
        "closed_form": Fact("a closed form is known", lambda s: structure_of(s[Joints].arm).closed_form, kind="truth"),
        "most_solutions": Fact(
            "how many solutions there are at most", lambda s: structure_of(s[Joints].arm).most_solutions, kind="count"
        ),
        "parallel_axes": Fact("how many neighbouring axes are parallel", _relations("parallel"), kind="count"),
        "intersecting_axes": Fact("how many neighbouring axes intersect", _relations("intersecting"), kind="count"),
        "tool_point": Fact("the tool point in the world", world_point, "m", "numbers"),
    },
)
