"""The velocity ellipsoid while its tab is open, when the switch does not show it anyway."""

from __future__ import annotations

from armlab.session.parts.display import Display
from armlab.session.parts.ellipsoid import Manipulability
from armlab.ui.layers.ellipsoid import SWITCH, drawn_when
from armlab.ui.plugin import Layer

LAYER = Layer(
    "ellipsoid_tab",
    order=66,
    watches=(Manipulability, Display),
    build=drawn_when(lambda state: not SWITCH.on(state), "ellipsoid_tab"),
    panel="ellipsoid",
)
