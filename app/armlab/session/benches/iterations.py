"""Iterations of the inverse kinematics."""

from __future__ import annotations

from armlab.session.bench import Bench
from armlab.session.iteration_examples import EXAMPLES, ChooseExample

BENCH = Bench("iterations", 10, EXAMPLES, ChooseExample)
