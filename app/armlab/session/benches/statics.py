"""Forces and torques of an arm at rest."""

from __future__ import annotations

from armlab.session.bench import Bench
from armlab.session.statics_examples import EXAMPLES, ChooseExample

BENCH = Bench("statics", 70, EXAMPLES, ChooseExample)
"""For lessons: ``statics/along`` and so on."""
