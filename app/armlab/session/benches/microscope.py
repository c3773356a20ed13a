"""The singularity microscope."""

from __future__ import annotations

from armlab.session.bench import Bench
from armlab.session.microscope_examples import EXAMPLES, ChooseMicroscopeExample

BENCH = Bench("microscope", 70, EXAMPLES, ChooseMicroscopeExample)
