"""From solids to GLB bytes: one primitive for each material."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from functools import cache
from typing import TYPE_CHECKING

from armlab.ui.colours import Rgb, joint_colour, linear
from armlab.ui.figure.mesh import Solid, joined

if TYPE_CHECKING:
    from trimesh.visual.material import PBRMaterial

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


def joint_material(i: int) -> str:
    """Return the material of the rings of joint i (0-based)."""
    return f"joint{i}"


def body_glb(parts: Iterable[Part]) -> bytes:
    """Return one GLB file of all parts."""
    return scene_glb((solid, _look(material)) for material, solid in merged(parts).items())


def merged(parts: Iterable[Part]) -> dict[str, Solid]:
    """Return one solid for each material."""
    by_material: dict[str, list[Solid]] = defaultdict(list)
    for material, solid in parts:
        by_material[material].append(solid)
    return {material: joined(solids) for material, solids in by_material.items()}


def scene_glb(coloured: Iterable[tuple[Solid, Look]]) -> bytes:
    """Return the GLB file of solids, each of one material."""
    import trimesh  # Half a second; the page can be served meanwhile.
    from trimesh.visual import TextureVisuals

    scene = trimesh.Scene()
    for solid, look in coloured:
        # Neither checked nor cleaned: merged vertices would lose the sharp edges.
        mesh = trimesh.Trimesh(
            solid.vertices,
            solid.faces,
            vertex_normals=solid.normals,
            visual=TextureVisuals(material=_material(look)),  # type: ignore[no-untyped-call]
            process=False,
            validate=False,
        )
        scene.add_geometry(mesh)
    exported: bytes = scene.export(file_type="glb", include_normals=True)  # type: ignore[no-untyped-call]
    return exported


@cache
def _material(look: Look) -> PBRMaterial:
    from trimesh.visual.material import PBRMaterial

    colour, roughness, metallic = look
    factor = [*(round(255.0 * float(value)) for value in linear(colour)), 255]
    look_of = {"baseColorFactor": factor, "roughnessFactor": roughness, "metallicFactor": metallic}
    return PBRMaterial(**look_of)  # type: ignore[no-untyped-call]


def _look(material: str) -> Look:
    if material.startswith("joint"):
        return joint_colour(int(material.removeprefix("joint"))), 0.38, 0.0
    return MATERIALS[material]
