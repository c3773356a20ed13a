"""The velocity loop."""

from __future__ import annotations

from armlab.session.bench import Bench
from armlab.session.loop_examples import EXAMPLES, ChooseLoopExample

BENCH = Bench("loop", 60, EXAMPLES, ChooseLoopExample)
