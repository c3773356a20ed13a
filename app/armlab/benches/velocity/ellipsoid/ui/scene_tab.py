"""The velocity ellipsoid while its tab is open, unless the switch shows it already."""

from __future__ import annotations

from armlab.benches.velocity.ellipsoid.state import Manipulability
from armlab.benches.velocity.ellipsoid.ui.scene import SWITCH, drawn_when
from armlab.session.parts.display import Display
from armlab.ui.plugin import Layer

LAYER = Layer(
    "ellipsoid_tab",
    order=66,
    watches=(Manipulability, Display),
    build=drawn_when(lambda state: not SWITCH.on(state), "ellipsoid_tab"),
    panel="ellipsoid",
)
