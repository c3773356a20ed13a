"""The drawn arm: it is where the kinematics says, at any size, for any table."""

import io
from types import SimpleNamespace

import numpy as np
import pytest
import trimesh

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_about, rotation_from_quaternion
from armlab.kin.transforms import transform
from armlab.ui.figure.anatomy import anatomy_of
from armlab.ui.figure.figure import build_figure
from armlab.ui.figure.glb import MOST_SHORT, merged, scene_glb
from armlab.ui.figure.marks import SYMBOL_STEP, symbol_height, symbols_of
from armlab.ui.figure.mesh import Solid, placed
from armlab.ui.figure.solids import CREASE, SIDES, along, band, block, drum, lathe, lid, torus
from armlab.ui.figure.tubes import tube
from armlab.ui.scene.skeleton import _segments
from armlab.ui.scene.stage import ground_height
from support.arms import random_arm, random_q

H = np.pi / 2


def node_poses(anatomy, q):
    """Return the world poses of all nodes, as the page composes them from what it is sent."""
    T = anatomy.root
    poses = [T]
    for body, value in zip(anatomy.bodies, q, strict=True):
        R = rotation_from_quaternion(body.node_wxyz(float(value)))
        T = T @ transform(R, body.node_position(float(value)))
        poses.append(T)
    return poses


def assert_nodes_agree(arm, q):
    anatomy = anatomy_of(arm)
    poses = node_poses(anatomy, q)
    np.testing.assert_allclose(poses[-1] @ anatomy.tool_on_last(), arm.fk(q), rtol=0, atol=1e-12)
    for i, frame in enumerate(arm.frames(q)):
        body, pose = anatomy.frame_on_body(i)
        np.testing.assert_allclose(poses[body] @ pose, frame, rtol=0, atol=1e-12)


def test_the_nodes_are_where_the_kinematics_says(robot, rng):
    for q in random_q(robot.arm, rng, 5):
        assert_nodes_agree(robot.arm, q)


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_the_nodes_of_random_arms_too(convention, rng):
    for n in (1, 3, 6, 12):
        arm = random_arm(rng, n, convention=convention, special=bool(n % 2))
        assert_nodes_agree(arm, random_q(arm, rng))


def tip_of(figure, q):
    """Return the distance from the tool point to the nearest vertex of the last body."""
    anatomy = figure.anatomy
    pose = node_poses(anatomy, q)[-1]
    vertices = np.vstack([mesh.vertices for _, mesh in figure.parts[-1]])
    world = vertices @ pose[:3, :3].T + pose[:3, 3]
    p = anatomy.arm.position(q)
    direction = np.array(anatomy.arm.fk(q)[:3, 2])
    return p, world, direction


def test_the_tips_of_the_hand_are_the_tool_point(robot):
    """The fingers end at the tool point: it lies between them, and nothing of the hand reaches beyond."""
    figure = build_figure(robot.arm)
    p, vertices, _ = tip_of(figure, robot.home)
    r = float(figure.anatomy.radius[-1])
    near = vertices[np.linalg.norm(vertices - p, axis=1) < 1.6 * r]
    assert len(near) >= 4
    farthest = np.linalg.norm(vertices.mean(axis=0) - p)
    approach = (p - vertices.mean(axis=0)) / farthest
    assert np.max((vertices - p) @ approach) < 0.25 * r


@pytest.mark.parametrize("size", [0.1, 1.0, 3.0])
def test_arms_look_the_same_at_every_size(size):
    puma = catalogue()["puma560"].arm
    rows = [(row.kind, size * row.a, row.alpha, size * row.d, row.theta) for row in puma.rows]
    tool = np.array(puma.tool)
    tool[:3, 3] *= size
    arm = Arm.from_dh(rows, tool=tool, limits=puma.limits)
    q = catalogue()["puma560"].home
    scaled = build_figure(arm).bounds(q)
    np.testing.assert_allclose(scaled, size * build_figure(puma).bounds(q), rtol=0, atol=0.002 * size)


@pytest.mark.parametrize("seed", range(6))
def test_any_table_can_be_drawn(seed):
    rng = np.random.default_rng(seed)
    arm = random_arm(rng, int(rng.integers(1, 9)), special=bool(seed % 2))
    figure = build_figure(arm)
    assert len(figure.parts) == arm.n + 1
    for parts in figure.parts:
        for _, mesh in parts:
            assert np.all(np.isfinite(mesh.vertices))


def test_an_arm_without_any_length_can_be_drawn():
    build_figure(Arm.from_dh([("R", 0, 0, 0, 0)]))


def test_every_body_is_a_readable_glb(robot):
    figure = build_figure(robot.arm)
    for glb in filter(None, figure.glbs()):
        scene = trimesh.load(io.BytesIO(glb), file_type="glb")
        assert scene.geometry
        assert len(glb) < 400_000


def test_rods_stay_in_their_sleeves_and_reach_the_end():
    """At both ends of the stroke the rod of a ram still overlaps its sleeve."""
    arm = catalogue()["polar_rrp"].arm
    figure = build_figure(arm)
    body = figure.anatomy.bodies[2]
    rod = np.vstack([mesh.vertices for material, mesh in figure.parts[3] if material == "steel"])
    for q in arm.limits[2]:
        low = rod[:, 2].min() + body.offset + q
        assert low < 0.0


@pytest.mark.parametrize("limits", [(0.1, 0.6), (-0.3, 0.3), (-0.4, 0.0), (-1.0, -0.5), (-0.001, 0.6)], ids=str)
def test_a_rod_is_in_its_sleeve_and_at_its_node_wherever_its_stroke_lies(limits):
    rows = [("R", 0, -H, 0.5, 0), ("R", 0, H, 0.2, 0), ("P", 0, 0, 0.1, 0), ("R", 0, 0, 0.1, 0)]
    arm = Arm.from_dh(rows, limits=[(-3, 3), (-3, 3), np.subtract(limits, 0.1), (-3, 3)])
    figure = build_figure(arm)
    (rod,) = (mesh for material, mesh in figure.parts[3] if material == "steel")
    shell = np.vstack([mesh.vertices for material, mesh in figure.parts[2] if material == "shell"][-1:])
    into_mount = np.linalg.inv(figure.anatomy.bodies[2].mount)
    sleeve = (shell @ into_mount[:3, :3].T + into_mount[:3, 3])[:, 2]
    assert closed(rod).volume > 0.0
    for stroke in limits:
        low, high = rod.vertices[:, 2].min() + stroke, rod.vertices[:, 2].max() + stroke
        assert min(high, sleeve.max()) - max(low, sleeve.min()) > 0.2 * np.ptp(sleeve)
        assert low <= stroke + 1e-9
        assert high >= stroke - 4.0 * figure.anatomy.radius[-1]
    canvas = SimpleNamespace(drawn=SimpleNamespace(figure=figure), size=figure.anatomy.size)
    strokes = _segments(canvas, 2)[:, :, 2]
    # The line of the skeleton reaches from the node, at 0, to the box, at -stroke.
    assert strokes.min() <= min(0.0, -limits[1]) + 1e-6
    assert strokes.max() >= max(0.0, -limits[0]) - 1e-6


BASES = {
    "upright": transform(position=(0.0, 0.0, 0.3)),
    "wall": transform(rotation_about("x", H), (0.0, 0.0, 1.0)),
    "other wall": transform(rotation_about("y", -H), (0.0, 0.0, 1.0)),
    "ceiling": transform(rotation_about("x", np.pi), (0.0, 0.0, 2.0)),
}


@pytest.mark.parametrize("base", BASES.values(), ids=BASES.keys())
@pytest.mark.parametrize("key", ["puma560", "planar_2r", "cartesian_3p"])
def test_the_ground_is_below_the_base_and_below_an_arm_that_hangs_from_it(key, base):
    robot = catalogue()[key]
    figure = build_figure(Arm.from_dh(robot.arm.rows, base=base, limits=robot.arm.limits))
    ground, root = ground_height(figure, robot.home), figure.anatomy.root
    lowest = min((mesh.vertices @ root[:3, :3].T + root[:3, 3])[:, 2].min() for _, mesh in figure.parts[0])
    assert ground <= lowest + 1e-9
    if base[2, 2] > 0.5:
        assert ground == pytest.approx(root[2, 3] + figure.foot)
    elif base[2, 2] < -0.5:
        assert ground <= figure.bounds(robot.home)[0, 2] + 1e-9
    else:
        assert ground == pytest.approx(lowest)


def closed(solid):
    """Return the solid with the two sides of its sharp edges joined again."""
    return trimesh.Trimesh(solid.vertices, solid.faces, process=True)


SOLIDS = {
    "drum": drum(1.0, 2.0, 0.1),
    "soft drum": drum(1.0, 2.0, 0.1, soft=True),
    "block": block((1.0, 2.0, 3.0), 0.1, (0.3, 0.0, -1.0)),
    "cone": lathe([(0.0, 0.0), (0.7, 0.0), (0.55, 0.4), (0.0, 1.6)]),
    "ring": torus(1.0, 0.1),
    "straight tube": tube([(0, 0, 0), (1, 2, 3)], 0.2, 0.1, 0.3),
    "bent tube": tube([(0, 0, 0), (0, 0, 1), (1, 0, 1)], 0.2, 0.1, 0.3),
}


@pytest.mark.parametrize("solid", SOLIDS.values(), ids=SOLIDS.keys())
def test_solids_are_closed_and_face_outwards(solid):
    mesh = closed(solid)
    assert mesh.is_watertight
    assert mesh.volume > 0
    np.testing.assert_allclose(solid.bounds, mesh.bounds, rtol=0, atol=1e-12)


OPEN = {
    "band": (band(1.0, 0.5, 0.1, z=0.2), [-0.3, 0.7]),
    "lid that stands": (lid(1.0, 0.5, 0.1, z=0.3), [0.3]),
    "lid that hangs": (lid(1.0, 0.5, 0.1, z=0.3, up=False), [0.3]),
}
"""Each with the heights at which it is open."""


@pytest.mark.parametrize(("solid", "heights"), OPEN.values(), ids=OPEN.keys())
def test_open_solids_are_open_where_they_touch_another_and_nowhere_else(solid, heights):
    mesh = closed(solid)
    edges, counts = np.unique(mesh.edges_sorted, axis=0, return_counts=True)
    rims = mesh.vertices[edges[counts == 1]]
    assert np.sum(counts == 1) == SIDES * len(heights)
    assert np.all(counts <= 2)
    np.testing.assert_allclose(np.unique(np.round(rims[:, :, 2], 9)), heights, rtol=0, atol=1e-9)
    assert np.array_equal(np.unique(solid.faces), np.arange(len(solid.vertices)))


BOTH = SOLIDS | {name: solid for name, (solid, _) in OPEN.items()}


@pytest.mark.parametrize("solid", BOTH.values(), ids=BOTH.keys())
def test_normals_are_of_unit_length_and_near_those_of_their_faces(solid):
    np.testing.assert_allclose(np.linalg.norm(solid.normals, axis=1), 1.0, rtol=0, atol=1e-12)
    a, b, c = (solid.vertices[solid.faces[:, k]] for k in range(3))
    of_faces = np.cross(b - a, c - a)
    of_faces /= np.linalg.norm(of_faces, axis=1)[:, None]
    dots = np.einsum("fkx,fx->fk", solid.normals[solid.faces], of_faces)
    # The tip of a cone is the one place where no normal can be near those of all faces.
    assert np.mean(dots > np.cos(CREASE)) > 0.8
    assert np.all(dots > 0.25)


def test_volumes_of_simple_solids():
    """Box 1 x 2 x 3 without bevel; cylinder of n sides: area n/2 sin(2 pi/n) r^2."""
    assert closed(block((1.0, 2.0, 3.0), 1e-9)).volume == pytest.approx(6.0, abs=1e-6)
    area = 0.5 * SIDES * np.sin(2.0 * np.pi / SIDES)
    assert closed(drum(1.0, 2.0, 1e-6)).volume == pytest.approx(4.0 * area, abs=1e-4)


def test_facets_of_a_block_are_flat_and_its_bevels_are_seen():
    solid = SOLIDS["block"]
    assert len(solid.faces) == 6 * 2 + 12 * 2 + 8
    assert len(np.unique(np.round(solid.normals, 9), axis=0)) == 6 + 12 + 8


def test_placing_a_solid_turns_its_normals_too():
    pose = transform(rotation_from_quaternion((0.5, 0.5, 0.5, 0.5)), (1.0, 2.0, 3.0))
    before, after = SOLIDS["drum"], placed(SOLIDS["drum"], pose)
    ahead = before.vertices + before.normals
    np.testing.assert_allclose(after.vertices + after.normals, ahead @ pose[:3, :3].T + pose[:3, 3], rtol=0, atol=1e-12)


def test_glb_files_keep_normals_and_sharp_edges(robot):
    figure = build_figure(robot.arm)
    for parts, glb in zip(figure.parts, figure.glbs(), strict=True):
        if glb is None:
            continue
        scene = trimesh.load(io.BytesIO(glb), file_type="glb", process=False)
        meshes = list(scene.geometry.values())
        solids = list(merged(parts).values())
        assert len(meshes) == len(solids)
        for mesh, solid in zip(meshes, solids, strict=True):
            np.testing.assert_allclose(mesh.vertices, solid.vertices, rtol=0, atol=1e-6)
            np.testing.assert_allclose(mesh.vertex_normals, solid.normals, rtol=0, atol=1e-6)


@pytest.mark.parametrize("count", [3, MOST_SHORT, MOST_SHORT + 1])
def test_a_glb_file_tells_all_its_vertices_apart_and_keeps_its_material(count):
    vertices = np.column_stack([np.arange(count), np.zeros(count), np.ones(count)])
    last = np.array([[0, 1, count - 1]])
    solid = Solid(vertices, np.tile((0.0, 1.0, 0.0), (count, 1)), last)
    scene = trimesh.load(io.BytesIO(scene_glb([(solid, ((255, 0, 188), 0.4, 0.25))])), file_type="glb", process=False)
    (mesh,) = scene.geometry.values()
    assert mesh.faces.tolist() == last.tolist()
    assert mesh.vertices.tolist() == vertices.tolist()
    material = mesh.visual.material
    # A half of full light is 188 of 255 on a screen; the reader keeps colours as whole numbers.
    np.testing.assert_allclose(material.baseColorFactor, (255, 0, 128, 255), rtol=0, atol=1)
    assert (material.roughnessFactor, material.metallicFactor) == (0.4, 0.25)


def test_symbols_have_the_height_the_skeleton_counts_on(robot):
    anatomy = anatomy_of(robot.arm)
    for i, glb in enumerate(symbols_of(anatomy)):
        low, high = trimesh.load(io.BytesIO(glb), file_type="glb").bounds
        height = symbol_height(anatomy, i)
        # Half a step of sizes: a symbol may be one made for an arm of nearly this size.
        assert high[2] - low[2] == pytest.approx(height, rel=0.51 * SYMBOL_STEP)
        np.testing.assert_allclose(low + high, 0.0, rtol=0, atol=1e-6)


def test_what_a_rail_carries_sideways_is_drawn():
    """A slide with a link across it: the next joint must not float in the air."""
    arm = Arm.from_dh([("P", 1.0, 0, 0, 0), ("R", 0.5, 0, 0, 0)])
    parts = build_figure(arm).parts[1]
    low, high = np.min([mesh.bounds[0] for _, mesh in parts], axis=0), np.max([m.bounds[1] for _, m in parts], axis=0)
    assert high[0] >= 1.0
    assert low[0] < 0.1


@pytest.mark.parametrize("length", [0.0, 1e-12, 1e-7])
def test_an_arm_without_length_still_has_a_size(length):
    arm = Arm.from_dh([("R", 0.0, 0.0, length, 0.0)])
    assert anatomy_of(arm).size == 1.0


def test_a_pose_along_any_direction_is_one(rng):
    directions = [*rng.normal(size=(50, 3)), *np.eye(3), *-np.eye(3), np.array([0.95, 0.2, 0.0])]
    for direction in directions:
        pose = along(direction, (1.0, 2.0, 3.0))
        np.testing.assert_allclose(pose[:3, :3].T @ pose[:3, :3], np.eye(3), atol=1e-14)
        assert np.linalg.det(pose[:3, :3]) == pytest.approx(1.0, abs=1e-14)
        np.testing.assert_allclose(pose[:3, 2], direction / np.linalg.norm(direction), atol=1e-15)
        np.testing.assert_array_equal(pose[:, 3], (1.0, 2.0, 3.0, 1.0))
