"""Sampled workspaces."""

from __future__ import annotations

from armlab.session.bench import Bench
from armlab.session.workspace_examples import EXAMPLES, ChooseWorkspaceExample

BENCH = Bench("workspace", 80, EXAMPLES, ChooseWorkspaceExample)
