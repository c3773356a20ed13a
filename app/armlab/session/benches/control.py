"""Runs of kinematic control."""

from __future__ import annotations

from armlab.session.bench import Bench
from armlab.session.control_examples import EXAMPLES, ChooseControlExample

BENCH = Bench("control", 60, EXAMPLES, ChooseControlExample)
