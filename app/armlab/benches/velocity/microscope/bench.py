"""The singularity microscope."""

from __future__ import annotations

from armlab.benches.velocity.microscope.examples import EXAMPLES, ChooseMicroscopeExample
from armlab.session.bench import Bench

BENCH = Bench("microscope", 70, EXAMPLES, ChooseMicroscopeExample)
