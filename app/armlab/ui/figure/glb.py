"""From solids to GLB bytes: one primitive for each material."""

from __future__ import annotations

import json
import struct
from collections import defaultdict
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.ui.colours import Rgb, joint_colour, linear
from armlab.ui.figure.mesh import Solid, joined

Part = tuple[str, Solid]
"""A material (a key of `MATERIALS`, or ``joint3``) and a solid."""

Look = tuple[Rgb, float, float]
"""Colour, roughness and metallic part of a material."""

MATERIALS: dict[str, Look] = {
    # Whites above some 225 are blown out by the tone curve of the page.
    "shell": ((222, 226, 232), 0.42, 0.0),
    "dark": ((74, 82, 95), 0.46, 0.0),
    "steel": ((186, 193, 203), 0.32, 0.25),
    "rubber": ((40, 43, 48), 0.80, 0.0),
}

FLOAT, SHORT, INT = 5126, 5123, 5125
"""Numbers of glTF for float32, uint16 and uint32."""

ATTRIBUTES, INDICES = 34962, 34963
"""Numbers of glTF for a buffer of what vertices have, and for one of triangles."""

MOST_SHORT = 65535
"""Vertices that indices of 16 bits can tell apart; their last number has another meaning."""


def joint_material(i: int) -> str:
    """Return the material of the rings of joint i (0-based)."""
    return f"joint{i}"


def body_glb(parts: Iterable[Part]) -> bytes:
    """Return one GLB file of all parts."""
    return scene_glb((solid, look_of(material)) for material, solid in merged(parts).items())


def merged(parts: Iterable[Part]) -> dict[str, Solid]:
    """Return one solid for each material."""
    by_material: dict[str, list[Solid]] = defaultdict(list)
    for material, solid in parts:
        by_material[material].append(solid)
    return {material: joined(solids) for material, solids in by_material.items()}


def scene_glb(coloured: Iterable[tuple[Solid, Look]]) -> bytes:
    """Return the GLB file of solids, each of one material.

    Written by hand after the specification of glTF 2.0, sections 3 and 4: libraries that write such files take longer
    to import than the whole lab takes to start.
    """
    data = _Data()
    primitives, materials = [], []
    for number, (solid, look) in enumerate(coloured):
        small = len(solid.vertices) <= MOST_SHORT
        indices = solid.faces.astype("<u2" if small else "<u4").reshape(-1)
        places = {
            "POSITION": data.add(solid.vertices.astype("<f4"), ATTRIBUTES, FLOAT, bounds=True),
            "NORMAL": data.add(solid.normals.astype("<f4"), ATTRIBUTES, FLOAT),
        }
        triangles = data.add(indices, INDICES, SHORT if small else INT)
        primitives.append({"attributes": places, "indices": triangles, "material": number})
        materials.append(_material(look))
    head = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": primitives}],
        "materials": materials,
        "accessors": data.accessors,
        "bufferViews": data.views,
        "buffers": [{"byteLength": len(data.bytes)}],
    }
    text = json.dumps(head, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = (
        struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data.bytes), b"BIN\0") + data.bytes
    )
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


class _Data:
    """The arrays of a file, one after the other.

    Attributes
    ----------
    bytes : bytearray
    views, accessors : list of dict
        Where each array lies, and what it is, as glTF writes it.
    """

    def __init__(self) -> None:
        self.bytes = bytearray()
        self.views: list[dict[str, int]] = []
        self.accessors: list[dict[str, Any]] = []

    def add(self, array: NDArray[Any], target: int, kind: int, bounds: bool = False) -> int:
        """Add an array, one row a vertex or one number an index; return the number of its accessor."""
        raw = array.tobytes()
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(raw), "target": target})
        found: dict[str, Any] = {"bufferView": len(self.views) - 1, "componentType": kind, "count": len(array)}
        found["type"] = "VEC3" if array.ndim == 2 else "SCALAR"
        if bounds:
            found |= {"min": array.min(axis=0).tolist(), "max": array.max(axis=0).tolist()}
        self.accessors.append(found)
        self.bytes += raw + bytes(-len(raw) % 4)  # each array begins at a multiple of 4 bytes
        return len(self.accessors) - 1


def _material(look: Look) -> dict[str, Any]:
    colour, roughness, metallic = look
    factor = [*np.asarray(linear(colour), dtype=float).tolist(), 1.0]
    return {
        "pbrMetallicRoughness": {"baseColorFactor": factor, "roughnessFactor": roughness, "metallicFactor": metallic}
    }


def look_of(material: str) -> Look:
    """Return colour, roughness and metallic part of a material."""
    if material.startswith("joint"):
        return joint_colour(int(material.removeprefix("joint"))), 0.38, 0.0
    return MATERIALS[material]
