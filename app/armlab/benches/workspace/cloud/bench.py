"""Sampled workspaces."""

from __future__ import annotations

from armlab.benches.workspace.cloud.examples import EXAMPLES, ChooseWorkspaceExample
from armlab.session.bench import Bench

BENCH = Bench("workspace", 80, EXAMPLES, ChooseWorkspaceExample)
