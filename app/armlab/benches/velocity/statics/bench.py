"""Forces and torques of an arm at rest."""

from __future__ import annotations

from armlab.benches.velocity.statics.examples import EXAMPLES, ChooseExample
from armlab.session.bench import Bench

BENCH = Bench("statics", 70, EXAMPLES, ChooseExample)
"""Bench whose examples lessons name as ``statics/along`` and so on."""
