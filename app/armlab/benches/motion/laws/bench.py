"""Timing laws."""

from __future__ import annotations

from armlab.benches.motion.laws.examples import EXAMPLES, ChooseLawExample
from armlab.session.bench import Bench

BENCH = Bench("laws", 30, EXAMPLES, ChooseLawExample)
