"""Curves of one joint through knots."""

from __future__ import annotations

from armlab.benches.motion.curves.examples import EXAMPLES, ChooseExample
from armlab.session.bench import Bench

BENCH = Bench("curves", 40, EXAMPLES, ChooseExample)
