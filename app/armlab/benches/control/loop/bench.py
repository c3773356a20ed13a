"""The velocity loop."""

from __future__ import annotations

from armlab.benches.control.loop.examples import EXAMPLES, ChooseLoopExample
from armlab.session.bench import Bench

BENCH = Bench("loop", 60, EXAMPLES, ChooseLoopExample)
