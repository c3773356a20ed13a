"""Curves of one joint through knots."""

from __future__ import annotations

from armlab.session.bench import Bench
from armlab.session.curves_examples import EXAMPLES, ChooseExample

BENCH = Bench("curves", 40, EXAMPLES, ChooseExample)
