"""Workspaces: where a tool can be, and in which orientations (sections 4.2 and 4.3.1 of the notes).

`section` is what an arm reaches, seen from the side, and `size` its measures; `planar_workspace` the closed form of a
planar arm; `samples` draws configurations, `voxels_for` counts them; `coverage` and `approach_maps` say in how many
directions a point is reached.

>>> from armlab.kin.workspace import planar_workspace
>>> planar_workspace((1.0, 0.75, 0.5)).dexterous
((0.0, 0.25), (0.75, 1.25))
"""

from armlab.kin.workspace.approach import Approaches, Directions, directions
from armlab.kin.workspace.cloud import Samples, samples
from armlab.kin.workspace.measures import Measure, measure_named
from armlab.kin.workspace.planar import PlanarWorkspace, planar_workspace
from armlab.kin.workspace.section import Section
from armlab.kin.workspace.section_size import Reach, Size, reach, size
from armlab.kin.workspace.sections import section, sections
from armlab.kin.workspace.sheet_maps import SheetMap, approach_maps, count_maps
from armlab.kin.workspace.solution_count import Count, count_of
from armlab.kin.workspace.spherical_wrist import Coverage, coverage
from armlab.kin.workspace.surface import Surface, surface
from armlab.kin.workspace.voxels import Voxels, voxels_for

__all__ = [
    "Approaches",
    "Count",
    "Coverage",
    "Directions",
    "Measure",
    "PlanarWorkspace",
    "Reach",
    "Samples",
    "Section",
    "SheetMap",
    "Size",
    "Surface",
    "Voxels",
    "approach_maps",
    "count_maps",
    "count_of",
    "coverage",
    "directions",
    "measure_named",
    "planar_workspace",
    "reach",
    "samples",
    "section",
    "sections",
    "size",
    "surface",
    "voxels_for",
]
