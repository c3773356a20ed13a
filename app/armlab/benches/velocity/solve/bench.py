"""Joint speeds for a wanted velocity."""

from __future__ import annotations

from armlab.benches.velocity.solve.examples import EXAMPLES, ChooseSolveExample
from armlab.session.bench import Bench

BENCH = Bench("solve", 62, EXAMPLES, ChooseSolveExample)
