"""The handle by which a hand turns the body."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.commands import TurnBody
from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.stage import pose_at, stage_of
from armlab.benches.body.forms.state import Body
from armlab.kin.rotations import quaternion_from_rotation
from armlab.session.state import State
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Show
from armlab.ui.scene._handle import Handle

HANDLE = 0.9
"""Scale of the handle in radii of the outermost gimbal ring; its own rings have 0.65 of it, between block and rings."""


def body_handle(canvas: LayerCanvas, name: str, radius: float) -> Show:
    """Return the ``show`` of rings about the axes of the body, or of the base for turns about fixed axes."""

    def dragged(pose: NDArray[np.floating], drag: object, ends: bool) -> None:
        canvas.post(TurnBody(quaternion_from_rotation(pose[:3, :3]), drag))

    handle = Handle(canvas, canvas.path(name), dragged, scale=HANDLE * radius / canvas.size)

    def show(state: State) -> None:
        (centre, _), R = stage_of(state), state.derived(forms_of).R
        handle.show_rings(pose_at(R, centre), np.eye(3) if state[Body].fixed else R)

    return show
