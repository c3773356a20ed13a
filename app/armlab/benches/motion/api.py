"""Parts of the tab Motion for other tabs: the planned motion over time."""

from armlab.benches.motion.plan.planning import making
from armlab.benches.motion.plan.question import Planned, Question
from armlab.benches.motion.plan.state import CLIP_KEY, Plan, last_planned, question
from armlab.benches.motion.space_curve.stage import sphere_of

__all__ = ["CLIP_KEY", "Plan", "Planned", "Question", "last_planned", "making", "question", "sphere_of"]
