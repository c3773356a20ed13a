"""All solutions for the target, as ghosts beside the arm."""

from __future__ import annotations

from armlab.benches.target.solutions.job import SWITCH as NAME
from armlab.benches.target.solutions.state import Solutions
from armlab.benches.target.solutions.ui.ghosts import drawn_when
from armlab.session.parts.joints import Joints
from armlab.ui.plugin import Layer
from armlab.ui.switches import Switch

SWITCH = Switch(
    NAME,
    "All solutions",
    "Every configuration that reaches the target, as ghosts; click one to move the arm there.",
    "Y",
)
LAYER = Layer("solutions", 72, (Solutions, Joints), drawn_when(lambda state: True, "solutions"), switch=SWITCH)
