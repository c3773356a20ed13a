"""From solids to GLB bytes: one primitive for each material, smooth where the surface is."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable

import numpy as np
import trimesh
from trimesh.visual.material import PBRMaterial

from armlab.ui.colours import Rgb, joint_colour, linear

CREASE = np.deg2rad(35.0)
"""Edges that turn more than this stay sharp."""

Part = tuple[str, trimesh.Trimesh]
"""A material (a key of `MATERIALS`, or ``joint3``) and a solid."""

MATERIALS: dict[str, tuple[Rgb, float, float]] = {
    # Whites above some 225 are blown out by the tone curve of the page.
    "shell": ((222, 226, 232), 0.42, 0.0),
    "dark": ((74, 82, 95), 0.46, 0.0),
    "steel": ((186, 193, 203), 0.32, 0.25),
    "rubber": ((40, 43, 48), 0.80, 0.0),
}


def joint_material(i: int) -> str:
    """Return the material of the rings of joint i (0-based)."""
    return f"joint{i}"


def body_glb(parts: Iterable[Part]) -> bytes:
    """Return one GLB file of all parts."""
    scene = trimesh.Scene()
    for material, mesh in merged(parts).items():
        colour, roughness, metallic = _look(material)
        scene.add_geometry(coloured(mesh, colour, roughness, metallic), geom_name=material)
    exported: bytes = scene.export(file_type="glb", include_normals=True)
    return exported


def merged(parts: Iterable[Part]) -> dict[str, trimesh.Trimesh]:
    """Return one smooth mesh for each material."""
    by_material: dict[str, list[trimesh.Trimesh]] = defaultdict(list)
    for material, mesh in parts:
        by_material[material].append(mesh)
    return {
        material: trimesh.graph.smooth_shade(trimesh.util.concatenate(meshes), angle=CREASE)
        for material, meshes in by_material.items()
    }


def coloured(mesh: trimesh.Trimesh, colour: Rgb, roughness: float, metallic: float = 0.0) -> trimesh.Trimesh:
    """Return the mesh with a physical material."""
    factor = [*(round(255.0 * float(value)) for value in linear(colour)), 255]
    material = PBRMaterial(baseColorFactor=factor, roughnessFactor=roughness, metallicFactor=metallic)
    mesh = mesh.copy()
    mesh.visual = trimesh.visual.TextureVisuals(material=material)
    return mesh


def _look(material: str) -> tuple[Rgb, float, float]:
    if material.startswith("joint"):
        return joint_colour(int(material.removeprefix("joint"))), 0.38, 0.0
    return MATERIALS[material]
