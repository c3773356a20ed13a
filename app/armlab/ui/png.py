"""Pictures as PNG files (W3C, *PNG*, 3rd edition, section 11).

Written by hand: no library of the lab writes pixels, and these lines are enough.
"""

from __future__ import annotations

import base64
import struct
import zlib

import numpy as np
from numpy.typing import NDArray

QUICK = 1
"""Level of compression for pictures that are made again and again while they grow."""

INDEXED, COLOURS = 3, 6
"""Kinds of pictures: entries of a palette, and red, green, blue and opacity."""


def indexed_png(entries: NDArray[np.uint8], palette: NDArray[np.uint8], level: int = QUICK) -> bytes:
    """Return a picture (rows, columns) of entries of a palette (k, 3); the first entry is transparent."""
    return _file(entries[..., None], INDEXED, [(b"PLTE", palette.tobytes()), (b"tRNS", b"\0")], level)


def rgba_png(pixels: NDArray[np.uint8], level: int = QUICK) -> bytes:
    """Return a picture (rows, columns, 4) of red, green, blue and opacity."""
    return _file(pixels, COLOURS, [], level)


def as_address(picture: bytes) -> str:
    """Return a PNG file as a data URL."""
    return f"data:image/png;base64,{base64.b64encode(picture).decode()}"


def _file(pixels: NDArray[np.uint8], kind: int, more: list[tuple[bytes, bytes]], level: int) -> bytes:
    rows, columns, depth = pixels.shape
    lines = np.zeros((rows, 1 + columns * depth), dtype=np.uint8)  # each line begins with its filter, 0 for none
    lines[:, 1:] = pixels.reshape(rows, -1)
    head = struct.pack(">IIBBBBB", columns, rows, 8, kind, 0, 0, 0)
    pieces = [(b"IHDR", head), *more, (b"IDAT", zlib.compress(lines.tobytes(), level)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(name, data) for name, data in pieces)


def _chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
