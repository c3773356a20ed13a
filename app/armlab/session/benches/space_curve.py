"""Curves in space, and turns."""

from __future__ import annotations

from armlab.session.bench import Bench
from armlab.session.space_curve_examples import EXAMPLES, ChooseExample

BENCH = Bench("space_curve", 50, EXAMPLES, ChooseExample)
