"""The side view of a workspace as in a data sheet: the reached region, dimensions, the arm, tool and target."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.benches.workspace.section.found import Found, once_each
from armlab.benches.workspace.section.marks import Measured, silhouette, target_measured, tool_measured
from armlab.benches.workspace.section.slice import Slice, in_own_plane, section_picture
from armlab.benches.workspace.section.ui.pixels import pixels
from armlab.kin.workspace.outline import Outline
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui import svg
from armlab.ui.html import Attribute, Inside, Markup, styles, tag
from armlab.ui.png import as_address, rgba_png
from armlab.ui.scene._polyline import simplified
from armlab.ui.units import Units

Floats = NDArray[np.float64]

WIDTH, HIGHEST = 320.0, 320.0
LEFT, RIGHT, TOP, BOTTOM = 16.0, 74.0, 14.0, 40.0
"""Largest width and height of the picture, and its margins, in its own units (about one pixel)."""

SPECK = 16
"""Largest number of corners of an outline around a few cells."""

THIN = 0.25
"""Distance, in units of the picture, up to which a drawn outline may deviate from the true one."""

SHORT = 0.04
"""Length, in parts of the larger side, below which a dimension is not drawn."""

TICK, TOOL = 3.5, 3.6
"""Half length of the dash at the end of a dimension, and radius of the tool's mark."""

LINE_APART = 16.0


class Frame(NamedTuple):
    """The visible rectangle, and its scale from metres to units of the picture."""

    low: Floats
    high: Floats
    scale: float

    @property
    def height(self) -> float:
        """Height of the picture."""
        return float(TOP + BOTTOM + self.scale * (self.high[1] - self.low[1]))

    def at(self, points: ArrayLike) -> Floats:
        """Return the places in the picture of points (..., 2) in metres."""
        away = (np.asarray(points, dtype=np.float64) - self.low) * self.scale
        return np.stack([LEFT + away[..., 0], self.height - BOTTOM - away[..., 1]], axis=-1)

    def metres(self, x: float, y: float) -> tuple[float, float]:
        """Return the point in metres at parts of the rectangle from its upper left corner."""
        span = self.high - self.low
        return float(self.low[0] + x * span[0]), float(self.high[1] - y * span[1])


def frame_of(found: Found) -> Frame:
    """Return the frame for the reached region: the section, or the plane of a planar arm."""
    whole = in_own_plane(found)
    if whole is not None:
        low = _in_plane(found, whole.plane.corner)
        high = low + np.array([whole.plane.width, whole.plane.height])
    else:
        grid = found.section.grid
        low, high = grid.extremes[:, 0] - 0.5 * grid.step, grid.extremes[:, 1] + 0.5 * grid.step
        if found.section.joint.revolute:
            # From the axis on, and as high as the arm stands.
            stands = silhouette(found, np.asarray(found.arm.clip(np.zeros(found.arm.n)), dtype=np.float64))[:, 1]
            low, high = np.minimum(low, [0.0, stands.min()]), np.maximum(high, [0.0, stands.max()])
    span = np.maximum(high - low, 1e-9)
    scale = min((WIDTH - LEFT - RIGHT) / span[0], (HIGHEST - TOP - BOTTOM) / span[1])
    return Frame(low, high, float(scale))


def image_rule(found: Found, name: str) -> Markup:
    """Return the picture of the reached region as a style rule for a class, as it changes less often than the marks."""
    drawn = in_own_plane(found) or section_picture(found)
    picture = pixels(found, drawn.reached, drawn.values)
    address = as_address(rgba_png(picture))
    return styles([f".al .{name}{{background-image:url({address})}}"])


def view(state: State, found: Found, units: Units, place: Mapping[str, Attribute]) -> Markup:
    """Return the picture; ``place`` are the attributes that send a click on it."""
    whole, frame = in_own_plane(found), frame_of(found)
    box, seen = _image_box(found, whole, frame), frame.at([frame.low, frame.high])
    reach = _dimensions(found, whole, frame, units)
    said = "Side view of the workspace" if whole is None else "Workspace in its plane"
    shapes = _axes(found, whole, frame), _outlines(found), reach, _marks(state, found, frame)
    return tag(
        "div.sc-view",
        tag("div.sc-image", style=_placed(box, frame)),
        svg.drawing("", WIDTH, frame.height, said, shapes),
        tag("div.sc-pick", style=_placed(seen, frame), title="Click: the tool goes there", **place),
        style=f"aspect-ratio:{WIDTH:g}/{frame.height:.1f}",
    )


def _in_plane(found: Found, point: Floats) -> Floats:
    joint = found.section.joint
    local = (point - joint.origin) @ joint.axes
    return np.asarray(local[..., :2] if joint.revolute else local[..., [0, 2]])


def _image_box(found: Found, whole: Slice | None, frame: Frame) -> Floats:
    if whole is not None:
        return frame.at([frame.low, frame.high])
    grid = found.section.grid
    low = np.array(grid.low)
    return frame.at([low, low + grid.step * np.array(grid.shape)])


def _placed(box: Floats, frame: Frame) -> str:
    (x0, y1), (x1, y0) = box
    parts = (x0 / WIDTH, y0 / frame.height, (x1 - x0) / WIDTH, (y1 - y0) / frame.height)
    names = ("left", "top", "width", "height")
    return ";".join(f"{name}:{100.0 * part:.3f}%" for name, part in zip(names, parts, strict=True))


def _axes(found: Found, whole: Slice | None, frame: Frame) -> Inside:
    """Return the axis of a joint 1 that turns, and the height, or the line, of frame 0."""
    if not found.section.joint.revolute:
        return None
    x, y = frame.at([0.0, 0.0]).tolist()
    top, bottom = TOP - 8.0, frame.height - BOTTOM + 6.0
    right = WIDTH - RIGHT + 6.0
    names = ("z", "ρ") if whole is None else ("", "")
    return (
        svg.line("axis", x, top, x, bottom),
        svg.line("axis", LEFT - 8.0, y, right, y),
        svg.text("name", x - 10.0, top + 9.0, names[0]),
        svg.text("name", right - 8.0, y - 4.0, names[1]),
    )


@once_each
def _outlines(found: Found) -> Markup:
    whole, frame = in_own_plane(found), frame_of(found)
    if whole is None:
        # Of a section that is being found, specks are left out: there are hundreds, and others wait meanwhile.
        lines = tuple(line for line in found.section.contours if found.section.finished or len(line) > SPECK)
    else:
        reached = np.pad(whole.reached, 1).T
        columns, rows = reached.shape
        corner = _in_plane(found, whole.plane.corner)
        x = corner[0] + (np.arange(columns) - 0.5) * whole.plane.width / (columns - 2)
        y = corner[1] + (np.arange(rows) - 0.5) * whole.plane.height / (rows - 2)
        along = np.full((columns - 1, rows), 0.5), np.full((columns, rows - 1), 0.5)
        lines = Outline(x, y, reached, *along).contours
    return svg.path("outline", _paths([frame.at(line) for line in lines]))


def _paths(lines: Sequence[Floats]) -> str:
    """Return closed lines as one path, with as few points as look the same; all lines are simplified together."""
    if not lines:
        return ""
    places, after = np.concatenate(lines), np.cumsum([len(line) for line in lines])
    kept = simplified(places, THIN, [*after[:-1], *(after - 1)])
    each = np.split(places[kept], np.searchsorted(kept, after[:-1]))
    return "".join("M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in line.tolist()) + "z" for line in each)


# -- dimensions ------------------------------------------------------------------------------------------------------


def _dimensions(found: Found, whole: Slice | None, frame: Frame, units: Units) -> Inside:
    """Return the dimension lines: below along u, on the right along v."""
    reach = found.reach
    if reach is None:
        return None
    joint, flat = found.section.joint, whole is not None
    least = SHORT * float((frame.high - frame.low).max())
    shapes = []
    spans = [(0.0, reach.outer), (0.0, reach.inner)] if joint.revolute else [(reach.inner, reach.outer)]
    for k, (low, high) in enumerate(span for span in spans if span[1] - span[0] > least):
        shapes.append(_below(frame, low, high, k, units.length(high - low)))
    if flat and joint.revolute:
        return shapes
    if flat:
        tall = [(float(frame.low[1]), float(frame.high[1]))]
    elif joint.revolute and reach.low < 0.0 < reach.high:
        tall = [(0.0, reach.high), (reach.low, 0.0)]
    else:
        tall = [(reach.low, reach.high)]
    shapes += [_beside(frame, *span, units.length(span[1] - span[0])) for span in tall if span[1] - span[0] > least]
    return shapes


def _below(frame: Frame, low: float, high: float, line: int, text: str) -> Inside:
    y = frame.height - BOTTOM + 12.0 + LINE_APART * line
    (x0, _), (x1, _) = frame.at([[low, 0.0], [high, 0.0]]).tolist()
    ends = f"M{x0:.1f} {y - TICK:.1f}v{2 * TICK}M{x1:.1f} {y - TICK:.1f}v{2 * TICK}"
    return svg.path("dim", f"{ends}M{x0:.1f} {y:.1f}H{x1:.1f}"), svg.text("size", x1 + 5.0, y + 4.0, text)


def _beside(frame: Frame, low: float, high: float, text: str) -> Inside:
    x = float(frame.at([frame.high[0], 0.0])[0]) + 14.0
    (_, y0), (_, y1) = frame.at([[0.0, low], [0.0, high]]).tolist()
    ends = f"M{x - TICK:.1f} {y0:.1f}h{2 * TICK}M{x - TICK:.1f} {y1:.1f}h{2 * TICK}"
    middle = 0.5 * (y0 + y1) + 4.0
    return svg.path("dim", f"{ends}M{x:.1f} {y0:.1f}V{y1:.1f}"), svg.text("size", x + 5.0, middle, text)


# -- what moves ------------------------------------------------------------------------------------------------------


def _marks(state: State, found: Found, frame: Frame) -> list[Inside]:
    """Return the arm seen from the side, tool and target, each with a line to the boundary."""
    bones = frame.at(silhouette(found, state[Joints].q))
    corners = " ".join(f"{x:.1f},{y:.1f}" for x, y in bones.tolist())
    shapes: list[Inside] = [tag("polyline.bones", points=corners)]
    for kind, measured in (("target", state.derived(target_measured)), ("tool", state.derived(tool_measured))):
        if measured is not None:
            shapes.append(_way(found, frame, measured, kind))
    if state.derived(tool_measured) is None and len(bones):
        x, y = bones[-1].tolist()
        shapes.append(svg.circle("tool", x, y, TOOL))
    return shapes


def _way(found: Found, frame: Frame, measured: Measured, kind: str) -> Inside:
    points = np.stack([measured.point, measured.to.foot])
    flat = found.section.grid.flat
    places = frame.at(_in_plane(found, points) if flat else found.section.joint.split(points)[:, :2])
    (x, y), (x1, y1) = places.tolist()
    sign = "in" if measured.to.distance >= 0.0 else "out"
    tool = kind == "tool"
    mark = svg.circle("tool", x, y, TOOL) if tool else svg.path("target", f"M{x:.1f} {y - 5:.1f}l5 5l-5 5l-5 -5z")
    return svg.line(f"way.{sign}", x, y, x1, y1), mark
