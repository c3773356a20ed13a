"""A small picture of an arm, painted by NumPy from its own figure: for lists of arms, where no browser draws a scene.

Each triangle is laid over the samples of a picture and the nearest one stays (a z-buffer). Then each sample is lit,
with a normal between those of the corners, so that a tube looks round; edges are smooth because a pixel is the mean of
several samples. Nothing of it is kept in files: an arm that a teacher adds, or a student types, has its picture, too.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from armlab.content.robots import Camera
from armlab.ui.colours import linear
from armlab.ui.figure.figure import Figure
from armlab.ui.figure.glb import look_of
from armlab.ui.figure.mesh import Solid, placed
from armlab.ui.png import rgba_png

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

WIDTH, HEIGHT = 240, 200
"""Size of a picture in pixels."""

FINE = 2
"""Samples in a pixel, each way."""

MARGIN = 0.07
"""Part of the picture that stays free on each side."""

HALF_ANGLE = math.radians(16.0)
"""Half of the angle under which the eye sees the ball around the arm: that of the scene."""

TURNS, STEEP = (0.0, -15.0, 15.0, -30.0, 30.0), 45.0
"""Degrees by which the eye may stand beside the usual view, and the elevation above which it does not."""

MOST_AT_ONCE = 200_000
"""Number of samples that are looked at together, which bounds the memory."""

KEY, FILL = np.array([-0.45, 0.65, 0.62]), np.array([0.80, 0.30, 0.30])
"""Directions of the lamps in the axes of the picture, to the right, upwards and towards the eye: all arms are lit
alike."""

SKY, GROUND = 0.46, 0.20
"""Light from above and from below, besides the lamps."""

SHADOW = 0.34
"""Opacity of the shadow below the arm."""

SOFT = 5
"""Half the width, in pixels, of the means that make the shadow soft."""


@dataclass(frozen=True, eq=False)
class _Scene:
    """The triangles of an arm in the world: corners, normals there, and the linear colour of each corner."""

    vertices: Floats
    normals: Floats
    colours: Floats
    faces: NDArray[np.int64]


def picture_of(figure: Figure, q: Floats, view: Camera) -> bytes:
    """Return the picture of an arm at a configuration as a PNG file, transparent where nothing is.

    Parameters
    ----------
    figure : Figure
    q : ndarray, shape (n,)
        In rad and m.
    view : Camera
        From where; its distance does not count, as the arm fills the picture.

    Examples
    --------
    >>> from armlab.content.robots import catalogue
    >>> from armlab.ui.figure.figure import build_figure
    >>> robot = catalogue()["planar_2r"]
    >>> picture_of(build_figure(robot.arm), robot.home, robot.camera)[1:4]
    b'PNG'
    """
    scene = _scene(figure, q)
    axes = _axes(_from_the_side(view, scene.vertices))
    foot = scene.vertices[:, 2].min()
    on_ground = scene.vertices * [1.0, 1.0, 0.0] + [0.0, 0.0, foot]
    bodies, ground = _fitted(axes, scene.vertices, on_ground)
    pixels = _painted(scene, bodies, axes)
    return rgba_png(_over_shadow(pixels, _shade_below(ground, scene.faces)), level=9)


def _scene(figure: Figure, q: Floats) -> _Scene:
    solids: list[Solid] = []
    colours: list[Floats] = []
    for pose, parts in zip(figure.poses(q), figure.parts, strict=True):
        for material, solid in parts:
            solids.append(placed(solid, pose))
            colours.append(np.tile(linear(look_of(material)[0]), (len(solid.vertices), 1)))
    first = np.cumsum([0, *(len(solid.vertices) for solid in solids)])
    return _Scene(
        np.concatenate([solid.vertices for solid in solids]),
        np.concatenate([solid.normals for solid in solids]),
        np.concatenate(colours),
        np.concatenate([solid.faces + start for solid, start in zip(solids, first, strict=False)]),
    )


def _from_the_side(view: Camera, points: Floats) -> Camera:
    """Return a view near to the given one in which the points look widest; a view from above stays as it is.

    An arm that points at the eye shows little of itself; in the scene one can walk round it, in a picture not.
    """
    if view.elevation_deg > STEEP:
        return view
    turned = [replace(view, azimuth_deg=view.azimuth_deg + by) for by in TURNS]
    return max(turned, key=lambda each: float(np.ptp(points @ _axes(each)[0])))


def _axes(view: Camera) -> Floats:
    """Return the axes of the picture in the world as rows: to the right, upwards, towards the eye."""
    azimuth, elevation = math.radians(view.azimuth_deg), math.radians(view.elevation_deg)
    back = np.array(
        [math.cos(azimuth) * math.cos(elevation), math.sin(azimuth) * math.cos(elevation), math.sin(elevation)]
    )
    right = np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])
    return np.array([right, np.cross(back, right), back])


def _fitted(axes: Floats, *clouds: Floats) -> list[Floats]:
    """Return points as the eye sees them, (k, 3) each: sample to the right, sample downwards, 1 / distance.

    All of them together fill the picture, up to its margin.
    """
    everything = np.concatenate(clouds)
    middle = (everything.min(axis=0) + everything.max(axis=0)) / 2.0
    radius = float(np.linalg.norm(everything - middle, axis=1).max())
    far = radius / math.sin(HALF_ANGLE)
    seen = []
    for cloud in clouds:
        x, y, towards = ((cloud - middle) @ axes.T).T
        near = 1.0 / (far - towards)
        seen.append(np.column_stack([x * near, -y * near, near]))
    flat = np.concatenate(seen)[:, :2]
    low, high = flat.min(axis=0), flat.max(axis=0)
    size = FINE * np.array([WIDTH, HEIGHT])
    scale = float(np.min((1.0 - 2.0 * MARGIN) * size / (high - low)))
    for points in seen:
        points[:, :2] = (points[:, :2] - (low + high) / 2.0) * scale + size / 2.0
    return seen


def _painted(scene: _Scene, seen: Floats, axes: Floats) -> Floats:
    """Return the samples of the bodies, (rows, columns, 4): colour of the screen times opacity, and opacity."""
    columns, rows = FINE * WIDTH, FINE * HEIGHT
    nearest = np.zeros(rows * columns)
    normals, colours = np.zeros((2, rows * columns, 3))
    for face, place, weights in _samples(seen, scene.faces):
        corners = scene.faces[face]
        depth = np.einsum("ij,ij->i", weights, seen[corners, 2])
        order = np.argsort(depth)  # of several at one place the last one written stays
        order = order[depth[order] > nearest[place[order]]]
        corners, place = corners[order], place[order]
        nearest[place] = depth[order]
        normals[place] = np.einsum("ij,ijk->ik", weights[order], scene.normals[corners])
        colours[place] = scene.colours[corners[:, 0]]
    there = nearest > 0.0
    picture = np.zeros((rows * columns, 4))
    picture[there, :3] = _of_screen(_lit(normals[there] @ axes.T, normals[there, 2], colours[there]))
    picture[there, 3] = 1.0
    return picture.reshape(rows, columns, 4)


def _samples(seen: Floats, faces: NDArray[np.int64]) -> Iterator[tuple[Integers, Integers, Floats]]:
    """Yield the samples inside some triangles at a time: triangle, place in the picture, weights of its corners."""
    columns, rows = FINE * WIDTH, FINE * HEIGHT
    p = seen[faces, :2]
    u, v = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    twice = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    low = np.clip(np.ceil(p.min(axis=1) - 0.5), 0, None).astype(np.int64)
    high = np.clip(np.floor(p.max(axis=1) - 0.5), None, [columns - 1, rows - 1]).astype(np.int64)
    wide, tall = np.maximum(high - low + 1, 0).T
    boxed = wide * tall
    # In samples y points down, so that what is counterclockwise for the eye is negative here; the rest faces away.
    kept = np.flatnonzero((boxed > 0) & (twice < 0.0))
    ends = np.cumsum(boxed[kept])
    cuts = np.arange(MOST_AT_ONCE, boxed[kept].sum(), MOST_AT_ONCE)
    for chunk in np.split(kept, np.searchsorted(ends, cuts)):
        count = boxed[chunk]
        face = np.repeat(chunk, count)
        k = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
        row = k // wide[face]
        x, y = low[face, 0] + k - row * wide[face], low[face, 1] + row
        across, down = x + 0.5 - p[face, 0, 0], y + 0.5 - p[face, 0, 1]
        second = (across * v[face, 1] - down * v[face, 0]) / twice[face]
        third = (u[face, 0] * down - u[face, 1] * across) / twice[face]
        first = 1.0 - second - third
        inside = (first >= 0.0) & (second >= 0.0) & (third >= 0.0)
        weights = np.column_stack([first[inside], second[inside], third[inside]])
        yield face[inside], (y * columns + x)[inside], weights


def _lit(normals: Floats, upwards: Floats, colours: Floats) -> Floats:
    """Return the linear light of samples with normals in the axes of the picture; ``upwards`` is their part along z."""
    length = np.linalg.norm(normals, axis=1)
    length[length == 0.0] = 1.0
    normals, upwards = normals / length[:, None], upwards / length
    key, fill = (lamp / np.linalg.norm(lamp) for lamp in (KEY, FILL))
    half = (key + np.array([0.0, 0.0, 1.0])) / np.linalg.norm(key + np.array([0.0, 0.0, 1.0]))
    sky = GROUND + (SKY - GROUND) * (0.5 + 0.5 * upwards)
    light = sky + 0.72 * np.clip(normals @ key, 0.0, None) + 0.16 * np.clip(normals @ fill, 0.0, None)
    # A surface seen from the side is darker: bright links stand out from bright paper.
    light *= 0.62 + 0.38 * np.clip(normals[:, 2], 0.0, 1.0)
    shine = 0.16 * np.clip(normals @ half, 0.0, None) ** 24
    found: Floats = np.clip(colours * light[:, None] + shine[:, None], 0.0, 1.0)
    return found


def _shade_below(ground: Floats, faces: NDArray[np.int64]) -> Floats:
    """Return the opacity of the shadow in each pixel, from the arm pressed flat on the ground."""
    columns, rows = FINE * WIDTH, FINE * HEIGHT
    covered = np.zeros(rows * columns)
    for both in (faces, faces[:, ::-1]):  # what lies flat faces the eye with either side
        for _, place, _ in _samples(ground, both):
            covered[place] = 1.0
    shade = _pooled(covered.reshape(rows, columns, 1))[..., 0]
    for _ in range(2):
        for axis in (0, 1):
            shade = _mean_along(shade, axis)
    return SHADOW * shade


def _mean_along(values: Floats, axis: int) -> Floats:
    """Return running means over 2 SOFT + 1 values, with zeros beyond the ends."""
    padding = [(0, 0), (0, 0)]
    padding[axis] = (SOFT + 1, SOFT)
    sums = np.cumsum(np.pad(values, padding), axis=axis)
    wide, count = 2 * SOFT + 1, values.shape[axis]
    return (np.take(sums, range(wide, wide + count), axis) - np.take(sums, range(count), axis)) / wide


def _pooled(samples: Floats) -> Floats:
    """Return the means over the samples of each pixel."""
    means = sum(samples[i::FINE, j::FINE] for i in range(FINE) for j in range(FINE)) / FINE**2
    return np.asarray(means)


def _over_shadow(samples: Floats, shade: Floats) -> NDArray[np.uint8]:
    """Return the pixels (rows, columns, 4) of bodies over their shadow: colour of the screen, and opacity."""
    pixels = _pooled(samples)
    opacity = pixels[..., 3] + shade * (1.0 - pixels[..., 3])
    colour = pixels[..., :3] / np.where(opacity > 0.0, opacity, 1.0)[..., None]
    whole: NDArray[np.uint8] = np.round(255.0 * np.dstack([colour, opacity])).astype(np.uint8)
    return whole


def _of_screen(light: Floats) -> Floats:
    """Return sRGB values, 0 to 1, of linear light."""
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 0.0031308) ** (1.0 / 2.4) - 0.055)
