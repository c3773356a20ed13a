"""The plan for comparison: the same waypoints, with joint moves for Cartesian ones and the reverse."""

from __future__ import annotations

from dataclasses import replace

from armlab.benches.motion.plan.moves import LINE, Move, resting
from armlab.benches.motion.plan.question import Question


def other_way(question: Question) -> Question | None:
    """Return the question with straight moves in the other space, or None if there are no waypoints."""
    if question.recorded is not None or not question.moves:
        return None
    moves = tuple(_swapped(move) for move in question.moves)
    return question._replace(moves=moves, duration=None)


def _swapped(move: Move) -> Move:
    """Return a straight move in the other space, with the same law if that begins and ends at rest."""
    law = resting(move.law)
    return replace(
        move, space="joint" if move.space == "cartesian" else "cartesian", path=LINE, law=law, turning="axis"
    )
