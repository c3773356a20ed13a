"""The matrix exponential."""

from __future__ import annotations

from armlab.benches.control.exponential.examples import EXAMPLES, ChooseExponentialExample
from armlab.session.bench import Bench

BENCH = Bench("exponential", 65, EXAMPLES, ChooseExponentialExample)
