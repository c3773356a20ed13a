"""The tracks around the sensors, unrolled: what each sensor sees, and where one is out of line."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from armlab.benches.sensor.absolute.state import Absolute
from armlab.kin.sensors.absolute import Disk
from armlab.ui import svg
from armlab.ui.html import Inside, Markup

WIDTH, LEFT, RIGHT = 330.0, 22.0, 24.0
"""Width of the picture, and room at the left for numbers of tracks and at the right for bits, pixels."""

HEIGHT, ROW, FOOT = 150.0, 24.0, 18.0
"""Largest height of all rows, of one row, and height of the numbers below, pixels."""

SECTORS = 16
"""Largest number of sectors that are seen at once."""

TEXT = 12.0
"""Height of a row in pixels below which its bit has a smaller letter."""


@dataclass(frozen=True)
class Track:
    """One row of the picture.

    Attributes
    ----------
    name : str
    dark : iterable of (float, float)
        Pieces that let no light through: begin and end as angles ahead of the line of sensors, radians.
    ahead : float
        How far the sensor is ahead of that line, radians.
    lit : bool
        Whether the sensor sees light.
    """

    name: str
    dark: Iterable[tuple[float, float]]
    ahead: float
    lit: bool


@dataclass(frozen=True)
class Window:
    """The part of a turn that is seen.

    Parameters
    ----------
    span : float
        Radians.
    """

    span: float

    @property
    def half(self) -> float:
        """How far it reaches to either side of the sensors, radians."""
        return 0.5 * self.span

    def x(self, ahead: float) -> float:
        """Return the pixel of an angle ahead of the sensors, at most at an edge."""
        across = WIDTH - LEFT - RIGHT
        return LEFT + across * (0.5 + min(max(ahead, -self.half), self.half) / self.span)

    def part(self) -> float:
        """Return the part of the picture's width that the tracks take."""
        return (WIDTH - LEFT - RIGHT) / WIDTH


def window_of(disk: Disk) -> Window:
    """Return what is seen of a coded disk: at most a turn, so that no sector is seen twice."""
    return Window(float(min(2**disk.tracks, SECTORS) * disk.width))


def tracks_markup(tracks: list[Track], window: Window, label: str, below: Inside = None) -> Markup:
    """Return the picture of tracks, the first on top; the line of the sensors is in the middle."""
    tall = min(ROW, HEIGHT / len(tracks))
    rows = [_row(track, tall * k, tall, window) for k, track in enumerate(tracks)]
    bottom, middle = tall * len(tracks), window.x(0.0)
    return svg.drawing(
        "ab-strip",
        WIDTH,
        bottom + FOOT,
        label,
        [shapes for shapes, _ in rows],
        svg.line("ab-line", middle, 0.0, middle, bottom),
        [sensor for _, sensor in rows],
        below,
    )


def _row(track: Track, y: float, tall: float, window: Window) -> tuple[list[Inside], Markup]:
    """Return one track, with its dark pieces, its name and the bit that is seen, and its sensor."""
    shapes: list[Inside] = [svg.shape("rect.ab-window", x=LEFT, y=y, width=WIDTH - LEFT - RIGHT, height=tall)]
    for begin, end in track.dark:
        low, high = window.x(begin), window.x(end)
        if high > low:
            shapes.append(svg.shape("rect.ab-dark", x=low, y=y, width=high - low, height=tall))
    level, small = y + 0.5 * tall, "ab-small" if tall < TEXT else ""
    shapes += [
        svg.line("ab-between", LEFT, y, WIDTH - RIGHT, y),
        svg.text(small, LEFT - 5.0, level + 4.0, track.name, "end"),
        svg.text(f"ab-bit.{small}" if small else "ab-bit", WIDTH - RIGHT + 8.0, level + 4.0, "1" if track.lit else "0"),
    ]
    radius = min(6.0, 0.36 * tall)
    return shapes, svg.circle("ab-sensor.lit" if track.lit else "ab-sensor", window.x(track.ahead), level, radius)


def below_tracks(count: int) -> float:
    """Return the pixel of what stands below so many tracks."""
    return min(ROW, HEIGHT / count) * count + 13.0


def strip(part: Absolute) -> Markup:
    """Return the picture of a coded disk: the coarsest track is on top, and sectors have their numbers."""
    disk, angle = part.disk, part.angle
    window, word = window_of(disk), int(disk.word(angle))
    tracks = [
        Track(
            str(track),
            _dark(disk, angle, track, window),
            disk.offset if track == disk.track else 0.0,
            bool(word >> (disk.tracks - track) & 1),
        )
        for track in range(1, disk.tracks + 1)
    ]
    label = (
        f"Tracks around the sensors, which see the word {word:0{disk.tracks}b} over sector {int(disk.sector(angle))}"
    )
    return tracks_markup(tracks, window, label, _sectors(disk, angle, window))


def _seen(disk: Disk, angle: float, window: Window) -> range:
    """Return the numbers of the sectors in the picture, which go on over whole turns."""
    first = math.floor((angle - window.half) / disk.width)
    return range(first, first + round(window.span / disk.width) + 2)


def _dark(disk: Disk, angle: float, track: int, window: Window) -> list[tuple[float, float]]:
    sectors = np.array(_seen(disk, angle, window))
    bits = disk.words[sectors % 2**disk.tracks] >> (disk.tracks - track) & 1
    begins = np.flatnonzero(np.diff(np.concatenate([[-1], bits])))
    ends = np.concatenate([begins[1:], [len(bits)]])
    edges = (sectors[0] + np.arange(len(bits) + 1)) * disk.width - angle
    dark = bits[begins] == 0
    return list(zip(edges[begins[dark]].tolist(), edges[ends[dark]].tolist(), strict=True))


def _sectors(disk: Disk, angle: float, window: Window) -> list[Markup]:
    """Return the numbers of the sectors below the tracks."""
    step = 2 if 2**disk.tracks > 8 else 1
    y, found = below_tracks(disk.tracks), []
    for k in _seen(disk, angle, window):
        at, number = (k + 0.5) * disk.width - angle, k % 2**disk.tracks
        if number % step == 0 and abs(at) < window.half - 0.4 * disk.width:
            found.append(svg.text("ab-number", window.x(at), y, str(number), "middle"))
    return found
