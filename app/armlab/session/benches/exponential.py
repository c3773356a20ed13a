"""The matrix exponential."""

from __future__ import annotations

from armlab.session.bench import Bench
from armlab.session.exponential_examples import EXAMPLES, ChooseExponentialExample

BENCH = Bench("exponential", 65, EXAMPLES, ChooseExponentialExample)
