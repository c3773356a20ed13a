"""All solutions as ghosts while their page is open, unless the switch shows them already."""

from __future__ import annotations

from armlab.benches.target.solutions.state import Solutions
from armlab.benches.target.solutions.ui.ghosts import drawn_when
from armlab.benches.target.solutions.ui.scene import SWITCH
from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.ui.plugin import Layer

LAYER = Layer(
    "solutions_page",
    73,
    (Solutions, Joints, Display),
    drawn_when(lambda state: not SWITCH.on(state), "solutions_page"),
    panel="solutions",
)
