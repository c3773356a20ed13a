"""Timing laws."""

from __future__ import annotations

from armlab.session.bench import Bench
from armlab.session.laws_examples import EXAMPLES, ChooseLawExample

BENCH = Bench("laws", 30, EXAMPLES, ChooseLawExample)
