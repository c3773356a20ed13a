"""Small pictures of arms: something is on each, no two are alike, and what is on them is the arm."""

import io
import math
import time

import numpy as np
import pytest
from PIL import Image

from armlab.content.robots import Camera, catalogue, own_robot
from armlab.kin.arm import Arm
from armlab.ui.figure import drawn, picture
from armlab.ui.figure.drawn import Gallery
from armlab.ui.figure.figure import build_figure
from armlab.ui.figure.picture import HEIGHT, MARGIN, WIDTH, picture_of

SIDE = Camera(-90.0, 0.0, 1.0)
"""Looks along y: x to the right, z upwards."""


def pixels_of(png):
    return np.asarray(Image.open(io.BytesIO(png))).astype(int)


def painted(robot, view=None):
    return pixels_of(picture_of(build_figure(robot.arm), robot.home, view or robot.camera))


@pytest.fixture(scope="module")
def pictures():
    gallery = Gallery()
    return {key: pixels_of(gallery.picture(robot)) for key, robot in catalogue().robots.items()}


def test_every_arm_fills_its_picture_and_leaves_the_margin_free(pictures):
    for key, pixels in pictures.items():
        assert pixels.shape == (HEIGHT, WIDTH, 4)
        body = pixels[..., 3] == 255
        rows, columns = np.flatnonzero(body.any(axis=1)), np.flatnonzero(body.any(axis=0))
        assert body.mean() > 0.02, key
        tall, wide = np.ptp(rows) / HEIGHT, np.ptp(columns) / WIDTH
        # With its shadow it fills one of the two; the shadow of a tall arm seen from above takes some of it.
        assert max(tall, wide) > 0.6, key
        assert rows[0] >= MARGIN * HEIGHT - 2, key
        assert columns[0] >= MARGIN * WIDTH - 2, key
        assert columns[-1] <= (1.0 - MARGIN) * WIDTH + 2, key


def test_no_two_pictures_are_alike(pictures):
    keys = list(pictures)
    twins = {frozenset(pair) for pair in (("ur10", "ur10_notes"),)}  # one arm in two tables
    for i, one in enumerate(keys):
        for other in keys[i + 1 :]:
            if frozenset((one, other)) not in twins:
                assert np.abs(pictures[one] - pictures[other]).mean() > 1.0, (one, other)


def test_the_rings_of_all_joints_have_their_colours(pictures):
    """Each joint of the PUMA is seen: some pixels have more of its colour than of any other."""
    pixels = pictures["puma560"]
    solid = pixels[pixels[..., 3] == 255][:, :3]
    strength = np.ptp(solid, axis=1)
    hues = solid[strength > 60]
    blue = (hues[:, 2] > hues[:, 0] + 40).sum()
    orange = ((hues[:, 0] > hues[:, 2] + 60) & (hues[:, 1] > hues[:, 2] + 30)).sum()
    green = ((hues[:, 1] > hues[:, 0] + 40) & (hues[:, 1] > hues[:, 2])).sum()
    assert min(blue, orange, green) > 20


def test_what_is_nearer_hides_what_is_behind_whichever_comes_first_in_the_list():
    robot = catalogue()["puma560"]
    figure = build_figure(robot.arm)
    one = pixels_of(picture_of(figure, robot.home, SIDE))
    for parts in figure.parts:
        parts.reverse()
    other = pixels_of(picture_of(figure, robot.home, SIDE))
    # Where two solids touch, their samples are equally near.
    assert (np.abs(one - other).max(axis=2) > 0).mean() < 1e-3


def test_an_arm_that_points_up_is_seen_pointing_up():
    stand = own_robot(Arm.from_dh([("R", 1.0, 0.0, 0.0, math.pi / 2)], base=_turned()), "Upright")
    body = painted(stand, SIDE)[..., 3] == 255
    rows, columns = np.flatnonzero(body.any(axis=1)), np.flatnonzero(body.any(axis=0))
    assert np.ptp(rows) > 2 * np.ptp(columns)


def _turned():
    """Frame 0 with x along x of the world and y upwards."""
    T = np.eye(4)
    T[:3, :3] = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]
    return T


def test_edges_are_smooth_and_the_shadow_is_soft_and_dark(pictures):
    opacity = pictures["puma560"][..., 3]
    assert ((opacity > 0) & (opacity < 255)).sum() > 300
    shadow = pictures["puma560"][(opacity > 10) & (opacity < 80)]
    assert np.median(shadow[:, :3]) < 60


@pytest.mark.parametrize("most", [500, 5_000_000])
def test_how_many_samples_are_looked_at_together_changes_nothing(most, monkeypatch, pictures):
    monkeypatch.setattr(picture, "MOST_AT_ONCE", most)
    robot = catalogue()["planar_2r"]
    np.testing.assert_array_equal(painted(robot), pictures["planar_2r"])


def test_an_arm_without_any_length_has_a_picture_too():
    point = own_robot(Arm.from_dh([("R", 0.0, 0.0, 0.0, 0.0)] * 3), "Point")
    assert (painted(point)[..., 3] == 255).mean() > 0.02


def test_a_picture_is_painted_once(monkeypatch):
    gallery, robot, calls = Gallery(), catalogue()["scara"], []
    monkeypatch.setattr(picture, "picture_of", lambda *given: calls.append(given) or b"png")
    assert gallery.picture(robot) == gallery.picture(robot) == b"png"
    assert len(calls) == 1


def test_who_paints_rests_while_others_use_the_lab(monkeypatch):
    others, rests = [], []
    gallery = Gallery(lambda: bool(others))
    monkeypatch.setattr(picture, "picture_of", lambda *_: time.sleep(0.05) or b"png")
    gallery.picture(catalogue()["scara"])
    monkeypatch.setattr(drawn.time, "sleep", lambda seconds, rest=time.sleep: rests.append(seconds) or rest(seconds))
    others.append("a student")
    gallery.picture(catalogue()["stanford"])
    (painted, rested) = rests
    assert rested >= painted == 0.05
