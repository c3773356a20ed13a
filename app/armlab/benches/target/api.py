"""Parts of the tab Target for other tabs: the question of all solutions, and motions along curves of them."""

from armlab.benches.target.solutions.motion import Motion, motion_through
from armlab.benches.target.solutions.question import Question

__all__ = ["Motion", "Question", "motion_through"]
