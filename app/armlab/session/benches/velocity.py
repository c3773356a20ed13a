"""Velocities."""

from __future__ import annotations

from armlab.session.bench import Bench
from armlab.session.velocity_examples import EXAMPLES, ChooseVelocityExample

BENCH = Bench("velocity", 60, EXAMPLES, ChooseVelocityExample)
