"""Runs of kinematic control."""

from __future__ import annotations

from armlab.benches.control.follow.examples import EXAMPLES, ChooseControlExample
from armlab.session.bench import Bench

BENCH = Bench("control", 60, EXAMPLES, ChooseControlExample)
