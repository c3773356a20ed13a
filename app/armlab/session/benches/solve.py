"""Joint speeds for a wanted velocity."""

from __future__ import annotations

from armlab.session.bench import Bench
from armlab.session.solve_examples import EXAMPLES, ChooseSolveExample

BENCH = Bench("solve", 62, EXAMPLES, ChooseSolveExample)
