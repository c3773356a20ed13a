"""The slice of the workspace in the scene, as a picture in its plane, with a handle that moves it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.workspace.cloud.cuts import AXES
from armlab.benches.workspace.section.found import Found
from armlab.benches.workspace.section.slice import Plane, Slice, looks, plane_at, plane_of, slice_at, slice_of
from armlab.benches.workspace.section.state import PlaceSlice, SectionView, found_of
from armlab.benches.workspace.section.ui.pixels import pixels
from armlab.kin.rotations import rotation_from_quaternion
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui import adapter
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import move, seen, turn

OPACITY = 0.62
"""Opacity of the reached region, through which the arm is seen."""

HANDLE, RING = 0.16, 0.3
"""Length of the arrow of the handle, and radius of its ring, in sizes of the arm."""

Floats = NDArray[np.float64]


class SlicePicture:
    """The picture of the slice and its handle."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        self._image: viser.ImageHandle | None = None
        self._handle: viser.TransformControlsHandle | None = None
        self._held = False
        self._kind = ""
        self._found: Found | None = None
        self._drawn: tuple[object, ...] = ()
        self._stands: tuple[object, ...] = ()

    def show(self, state: State) -> None:
        """Show a state; the picture is rebuilt only if another slice is shown."""
        part, found = state[SectionView], found_of(state)
        self._found = found
        flat = found is not None and found.section.grid.flat
        at = 0.0 if found is None or flat else slice_at(state, found) if part.slice == "axis" else part.offset
        # A slice that follows the tool is carried along; it is drawn anew only where it looks otherwise.
        turns = part.slice == "axis" and found is not None
        drawn = (found, part.slice, looks(found, at) if found is not None and turns else at)
        if drawn != self._drawn:
            self._drawn = drawn
            self._draw(state.derived(slice_of), found)
        elif turns and found is not None and not flat:
            self._carry(found, at)
        offered = found is not None and found.section.filled.any() and not flat and part.slice != "none"
        self._offer(state, part.slice if offered else "", at)

    def _carry(self, found: Found, at: float) -> None:
        if self._image is not None:
            self._place(plane_at(found, at))

    def _place(self, plane: Plane) -> None:
        assert self._image is not None
        # The page draws a picture with its first axis to the right and its second down.
        turn(self._image, np.column_stack([plane.right, -plane.up, np.cross(plane.right, -plane.up)]))
        move(self._image, plane.middle)

    def _draw(self, drawn: Slice | None, found: Found | None) -> None:
        if self._image is not None:
            seen(self._image, drawn is not None)
        if drawn is None or found is None:
            return
        plane, picture = drawn.plane, pixels(found, drawn.reached, drawn.values, OPACITY)
        if self._image is None:
            self._image = self._canvas.scene.add_image(
                self._canvas.path("section/slice"),
                picture,
                plane.width,
                plane.height,
                format="png",
                cast_shadow=False,
                receive_shadow=False,
            )
        else:
            self._image.image = picture
            if (self._image.render_width, self._image.render_height) != (plane.width, plane.height):
                self._image.render_width, self._image.render_height = plane.width, plane.height
        self._place(plane)

    def _offer(self, state: State, kind: str, at: float) -> None:
        """Offer a handle for a kind of slice at the place of the slice; it never moves while it is dragged."""
        if kind != self._kind and not self._held:
            if self._handle is not None:
                self._handle.remove()
                self._handle = None
            self._kind = kind
            if kind:
                self._handle = self._made(kind)
        put = (self._handle, self._found, at)
        if self._handle is not None and not self._held and put != self._stands:
            self._stands = put
            self._put(state, at)

    def _made(self, kind: str) -> viser.TransformControlsHandle:
        assert self._found is not None
        ring = kind == "axis" and self._found.section.joint.revolute
        options: dict[str, Any] = (
            {"active_axes": (True, True, False), "disable_axes": True, "disable_sliders": True}
            if ring
            else {"active_axes": (False, False, True), "disable_rotations": True, "disable_sliders": True}
        )
        handle = self._canvas.scene.add_transform_controls(
            self._canvas.path(f"section/handle/{kind}"),
            scale=(RING if ring else HANDLE) * self._canvas.size,
            line_width=3.0,
            depth_test=False,
            **options,
        )
        adapter.on_event(handle, "on_update", lambda event: self._moved(handle, event.phase))
        return handle

    def _frame(self) -> tuple[Floats, Floats]:
        """Return the axes of the handle, which moves along or about the third one, and a point at 0."""
        assert self._found is not None
        if self._kind == "axis":
            joint = self._found.section.joint
            if not joint.revolute:
                return joint.axes, joint.origin
            # Above what is reached, where the arm does not cover it.
            return joint.axes, joint.origin + joint.axes[:, 2] * self._found.section.grid.extremes[1, 1]
        base = self._found.arm.base
        k = AXES.index(self._kind)
        axes = np.column_stack([base[:3, (k + 1) % 3], base[:3, (k + 2) % 3], base[:3, k]])
        return axes, np.asarray(base[:3, 3])

    def _put(self, state: State, at: float) -> None:
        assert self._handle is not None
        assert self._found is not None
        axes, place = self._frame()
        if self._kind == "axis" and self._found.section.joint.revolute:
            c, s = math.cos(at), math.sin(at)
            axes = axes @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        else:
            # At the edge of the slice, where nothing covers it.
            plane = plane_at(self._found, at) if self._kind == "axis" else plane_of(state, self._found)
            place = plane.middle + 0.5 * plane.width * plane.right
        turn(self._handle, axes)
        move(self._handle, place)

    def _moved(self, handle: viser.TransformControlsHandle, phase: str) -> None:
        if handle is not self._handle or self._found is None:
            return
        self._held = phase != "end"
        if phase == "start":
            return
        axes, origin = self._frame()
        if self._kind == "axis" and self._found.section.joint.revolute:
            R = axes.T @ rotation_from_quaternion(handle.wxyz)
            at = math.atan2(float(R[1, 0]), float(R[0, 0]))
        else:
            at = float((np.asarray(handle.position) - origin) @ axes[:, 2])
        self._canvas.post(PlaceSlice(at))


def build(canvas: LayerCanvas, state: State) -> Show:
    """Build the picture and its handle."""
    return SlicePicture(canvas).show


LAYER = Layer("section", order=81, watches=(SectionView, Joints), build=build, panel="section")
