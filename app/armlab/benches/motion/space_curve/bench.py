"""Curves in space, and turns."""

from __future__ import annotations

from armlab.benches.motion.space_curve.examples import EXAMPLES, ChooseExample
from armlab.session.bench import Bench

BENCH = Bench("space_curve", 50, EXAMPLES, ChooseExample)
