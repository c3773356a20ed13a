"""Absolute encoders: a disk with N tracks whose words number its 2^N sectors, in plain binary or in Gray code.

Track 1 is the coarsest and gives the highest bit; track N, the outermost, has the finest sectors. Angles are those of
the disk under its sensors, in radians, and count positive from sector 0 to sector 1.

References
----------
Notes, section 2.3.1. The resolution 2.40 is right. The bits are on or off, not intensities, and in plain binary several
of them change at once, so that the sensors of a real encoder need a code that changes in one bit: Gray code.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import finite_floats, whole_number, wrong
from armlab.registry import known_name

Floats = NDArray[np.float64]
Words = NDArray[np.int64]

CODES = {"gray": "Gray code", "binary": "plain binary"}

MOST_TRACKS = 24
"""Largest number of tracks: 16 million sectors, more than any encoder of a joint has."""

ON_THE_EDGE = 1e-9
"""Part of a sector by which an angle may lie below an edge and still belong to the sector above: rounding."""

TURN = 2.0 * math.pi


def checked_tracks(tracks: object) -> int:
    """Return the number of tracks; `InputError` when it is not 1 to `MOST_TRACKS`."""
    if whole_number(tracks, "tracks", 1) > MOST_TRACKS:
        raise wrong("tracks", f"at most {MOST_TRACKS}", tracks)
    return int(tracks)  # type: ignore[call-overload, no-any-return]


def resolution(tracks: int) -> float:
    """Return the width of a sector in radians: ``2 pi / 2^N``.

    Parameters
    ----------
    tracks : int
        N, 1 to `MOST_TRACKS`.

    Raises
    ------
    InputError
        The number of tracks is not one.

    References
    ----------
    Notes 2.40, there in degrees.

    Examples
    --------
    >>> math.degrees(resolution(8))
    1.40625
    """
    return math.ldexp(TURN, -checked_tracks(tracks))


def gray_of(numbers: ArrayLike) -> Words:
    """Return the words of the Gray code for numbers of any shape: each bit compared with the one above it.

    >>> gray_of(range(8)).tolist()
    [0, 1, 3, 2, 6, 7, 5, 4]
    """
    values = _whole(numbers)
    return np.asarray(values ^ (values >> 1))


def number_of(words: ArrayLike) -> Words:
    """Return the numbers of words of the Gray code: each bit is the parity of all those from the highest down to it.

    >>> number_of([6, 4]).tolist()
    [4, 7]
    """
    values = _whole(words)
    for shift in (1, 2, 4, 8, 16, 32):
        values = values ^ (values >> shift)
    return np.asarray(values)


def words_of(code: str, tracks: int) -> Words:
    """Return the words of all sectors in order, (2^N,); bit N-1 belongs to track 1."""
    known_name("code", code, CODES)
    numbers = np.arange(2 ** checked_tracks(tracks), dtype=np.int64)
    return gray_of(numbers) if code == "gray" else numbers


def changes(code: str, tracks: int) -> Words:
    """Return how many bits change from each sector to the next one, (2^N,); the last is that from the end to sector 0.

    >>> changes("binary", 3).tolist(), changes("gray", 3).tolist()
    ([1, 2, 1, 3, 1, 2, 1, 3], [1, 1, 1, 1, 1, 1, 1, 1])
    """
    words = words_of(code, tracks)
    changed = words ^ np.roll(words, -1)
    return np.asarray(sum((changed >> bit) & 1 for bit in range(tracks)), dtype=np.int64)


class Pieces(NamedTuple):
    """A reading over one turn, which is constant on pieces.

    Attributes
    ----------
    edges : ndarray, shape (M + 1,)
        Angles from 0 to 2 pi, rising.
    read, errors : ndarray, shape (M,)
        Sector that is read on each piece, and how many sectors it is ahead of the true one, the short way round.
    """

    edges: Floats
    read: Words
    errors: Words

    @property
    def wrong(self) -> float:
        """Part of the turn on which another sector is read than the true one."""
        return float(np.diff(self.edges)[self.errors != 0].sum() / TURN)

    @property
    def worst(self) -> int:
        """Largest error, in sectors."""
        return int(np.abs(self.errors).max())


@dataclass(frozen=True)
class Disk:
    """A coded disk and its sensors, one of which may be out of line.

    Parameters
    ----------
    tracks : int
        1 to `MOST_TRACKS`.
    code : "gray" or "binary"
    track : int
        Track whose sensor is out of line, from 1, the coarsest.
    offset : float
        How far that sensor is ahead of the others, radians; the disk shows it what the others see an offset later.

    Raises
    ------
    InputError
        The numbers are not as above; `UnknownName` for another code.

    Examples
    --------
    At the edge between sectors 3 and 4 the sensor of the highest bit sees it too early, and 011 reads as 111:

    >>> late = Disk(3, "binary", 1, 0.1 * resolution(3))
    >>> int(late.sector(3.95 * resolution(3))), int(late.read(3.95 * resolution(3)))
    (3, 7)
    """

    tracks: int
    code: str = "gray"
    track: int = 1
    offset: float = 0.0

    def __post_init__(self) -> None:
        checked_tracks(self.tracks)
        known_name("code", self.code, CODES)
        if whole_number(self.track, "track", 1) > self.tracks:
            raise wrong("track", f"1 to {self.tracks}", self.track)
        finite_floats(self.offset, "offset", (), "a finite number in radians")

    @property
    def width(self) -> float:
        """Width of a sector, radians."""
        return resolution(self.tracks)

    @cached_property
    def words(self) -> Words:
        """Words of all sectors, (2^N,)."""
        return words_of(self.code, self.tracks)

    def sector(self, angle: ArrayLike) -> Words:
        """Return the sector under the line of the sensors at angles in radians, any shape."""
        return np.asarray(np.floor(_angles(angle) / self.width + ON_THE_EDGE).astype(np.int64) % 2**self.tracks)

    def word(self, angle: ArrayLike) -> Words:
        """Return the word that the sensors see, the one that is out of line included."""
        bit = 1 << (self.tracks - self.track)
        seen = self.words[self.sector(angle)]
        shifted = self.words[self.sector(_angles(angle) + self.offset)]
        return np.asarray((seen & ~bit) | (shifted & bit))

    def read(self, angle: ArrayLike) -> Words:
        """Return the sector that the word stands for."""
        word = self.word(angle)
        return number_of(word) if self.code == "gray" else word

    def error(self, angle: ArrayLike) -> Words:
        """Return how many sectors the reading is ahead of the true one, the short way round."""
        half = 2**self.tracks // 2
        return np.asarray((self.read(angle) - self.sector(angle) + half) % 2**self.tracks - half)

    @cached_property
    def pieces(self) -> Pieces:
        """The reading over one turn, exactly: it changes only at edges of sectors, seen by either kind of sensor."""
        own = np.arange(2**self.tracks) * self.width
        edges = np.unique(np.concatenate([own, np.mod(own - self.offset, TURN), [0.0, TURN]]))
        edges = edges[np.concatenate([[True], np.diff(edges) > ON_THE_EDGE * self.width])]
        edges[-1] = TURN
        middles = 0.5 * (edges[1:] + edges[:-1])
        return Pieces(edges, self.read(middles), self.error(middles))


def _whole(values: ArrayLike) -> Words:
    array = np.asarray(values)
    if array.dtype.kind not in "iu" or np.any(array < 0):
        raise InputError("words: expected whole numbers, not below 0")
    return array.astype(np.int64)


def _angles(angle: ArrayLike) -> Floats:
    return np.asarray(angle, dtype=np.float64)
