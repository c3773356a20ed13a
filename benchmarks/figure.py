"""What it takes to draw an arm whose table was just edited, and how much is sent to the page."""

import io
from collections.abc import Iterator
from dataclasses import replace

import trimesh

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.ui.figure.drawn import Drawn, Gallery
from rounds import medians

TITLE = "Figure of an arm: solids, GLB files and joint symbols, one core"
ARMS = ("planar_2r", "scara", "stanford", "puma560", "panda")


def measure() -> Iterator[str]:
    yield "| arm | joints | ms | triangles | kB |"
    yield "| --- | --- | --- | --- | --- |"
    arms = {key: catalogue()[key].arm for key in ARMS}
    seconds = medians({key: Editing(arm).next for key, arm in arms.items()}, rounds=7)
    for key, arm in arms.items():
        drawn = Gallery().make(arm)
        files = [glb for glb in [*drawn.glbs, *drawn.symbols] if glb]
        size = sum(map(len, files)) / 1e3
        yield f"| {key} | {arm.n} | {seconds[key] * 1e3:.1f} | {sum(map(triangles, files))} | {size:.0f} |"


class Editing:
    """A student who makes a link a little longer again and again, so that no figure is ready."""

    def __init__(self, arm: Arm) -> None:
        self._arm, self._edits, self._gallery = arm, 0, Gallery()

    def next(self) -> Drawn:
        """Draw the arm after one more edit."""
        self._edits += 1
        first, *others = self._arm.rows
        longer = replace(first, d=first.d + 1e-4 * self._edits)
        return self._gallery.make(replace(self._arm, rows=(longer, *others)))


def triangles(glb: bytes) -> int:
    """Count the triangles of a GLB file."""
    scene = trimesh.load(io.BytesIO(glb), file_type="glb")
    return sum(len(mesh.faces) for mesh in scene.geometry.values())
