"""All solutions for the target, as ghosts beside the arm."""

from __future__ import annotations

from armlab.benches.target.solutions.job import SWITCH as NAME
from armlab.benches.target.solutions.state import Solutions
from armlab.benches.target.solutions.ui.ghosts import drawn_when
from armlab.session.parts.joints import Joints
from armlab.ui.plugin import Layer
from armlab.ui.switches import Switch

SWITCH = Switch(
    NAME, "All solutions", "Every way the arm can reach its target, as ghosts; click one and the arm goes there.", "Y"
)
LAYER = Layer("solutions", 72, (Solutions, Joints), drawn_when(lambda state: True, "solutions"), switch=SWITCH)
