"""The plan of a motion."""

from __future__ import annotations

from armlab.benches.motion.plan.examples import EXAMPLES, TakeExample
from armlab.session.bench import Bench

BENCH = Bench("motion", 20, EXAMPLES, TakeExample)
