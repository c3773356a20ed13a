"""The plan of a motion."""

from __future__ import annotations

from armlab.session.bench import Bench
from armlab.session.plan_examples import EXAMPLES, TakeExample

BENCH = Bench("motion", 20, EXAMPLES, TakeExample)
