"""Iterations of the inverse kinematics."""

from __future__ import annotations

from armlab.benches.iterate.runs.examples import EXAMPLES, ChooseExample
from armlab.session.bench import Bench

BENCH = Bench("iterations", 10, EXAMPLES, ChooseExample)
