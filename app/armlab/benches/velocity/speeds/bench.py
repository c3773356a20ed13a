"""Velocities."""

from __future__ import annotations

from armlab.benches.velocity.speeds.examples import EXAMPLES, ChooseVelocityExample
from armlab.session.bench import Bench

BENCH = Bench("velocity", 60, EXAMPLES, ChooseVelocityExample)
