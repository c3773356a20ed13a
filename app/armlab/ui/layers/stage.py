"""Light and ground."""

from __future__ import annotations

import math

from armlab.session.parts.display import Display
from armlab.session.state import State
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.switches import DARK, SHADOWS

DAY = {"cell": (203, 210, 219), "section": (176, 186, 198), "key": 1.75, "shadow": 0.16}
NIGHT = {"cell": (58, 67, 80), "section": (78, 90, 106), "key": 1.7, "shadow": 0.55}


def cell_size(size: float) -> float:
    """Return 1, 2 or 5 times a power of ten, near a seventh of the arm.

    >>> cell_size(2.0)
    0.2
    """
    wanted = size / 7.0
    powers = range(math.floor(math.log10(wanted)) - 1, math.ceil(math.log10(wanted)) + 2)
    steps = [round(m * 10.0**k, 12) for k in powers for m in (1, 2, 5)]
    return min(steps, key=lambda step: abs(math.log(step / wanted)))


def build(canvas: LayerCanvas, state: State) -> Show:
    """Set up three lights and an endless grid that fades into the background."""
    scene, S = canvas.scene, canvas.size
    at = {"key": (-1.35, -1.86, 3.0), "fill": (2.0, 1.5, 1.0), "rim": (-1.0, 2.5, 1.2)}
    position = {name: (x * S, y * S, z * S) for name, (x, y, z) in at.items()}
    scene.add_light_directional(
        canvas.path("stage/fill"), intensity=0.7, color=(214, 228, 255), cast_shadow=False, position=position["fill"]
    )
    scene.add_light_hemisphere(
        canvas.path("stage/sky"), sky_color=(244, 248, 255), ground_color=(168, 172, 180), intensity=2.7
    )
    scene.add_light_directional(canvas.path("stage/rim"), intensity=0.5, cast_shadow=False, position=position["rim"])
    foot = float(canvas.drawn.figure.anatomy.root[2, 3]) + canvas.drawn.figure.foot

    def show(state: State) -> None:
        look = NIGHT if DARK.on(state) else DAY
        scene.add_light_directional(
            canvas.path("stage/key"),
            intensity=look["key"],
            color=(255, 250, 244),
            cast_shadow=SHADOWS.on(state),
            position=position["key"],
        )
        scene.add_grid(
            canvas.path("stage/ground"),
            infinite_grid=True,
            cell_size=cell_size(S),
            section_size=5.0 * cell_size(S),
            cell_color=look["cell"],
            section_color=look["section"],
            cell_thickness=0.8,
            section_thickness=0.9,
            fade_distance=7.0 * S,
            fade_strength=1.6,
            fade_from="origin",
            shadow_opacity=look["shadow"] if SHADOWS.on(state) else 0.0,
            # A little below the plate, or the two would fight for the same pixels.
            position=(0.0, 0.0, foot - 0.002 * S),
        )

    return show


LAYER = Layer("stage", order=0, watches=(Display,), build=build)
