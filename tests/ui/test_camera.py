"""The eye follows a jump of the arm only when something has left the picture."""

from types import SimpleNamespace

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.ui.camera import Camera
from armlab.ui.figure.figure import build_figure

PUMA = catalogue()["puma560"]


class Eye:
    """Stands for the camera of a page."""

    def __init__(self):
        self.position, self.look_at, self.fov, self.aspect = np.array([3.0, 3.0, 3.0]), np.zeros(3), 0.5, 1.5

    def on_update(self, _listener):
        pass


@pytest.fixture
def seen():
    pose = SimpleNamespace(q=PUMA.home)
    eye = Eye()
    camera = Camera(SimpleNamespace(camera=eye), lambda: pose.q)
    camera.follow(PUMA, build_figure(PUMA.arm))
    return camera, eye, pose


def direction(eye):
    back = np.asarray(eye.position) - np.asarray(eye.look_at)
    return back / np.linalg.norm(back)


def test_what_is_in_the_picture_moves_no_eye(seen):
    camera, eye, _ = seen
    before = np.array(eye.position)
    camera.keep_in_view()
    np.testing.assert_array_equal(eye.position, before)


def test_an_arm_that_has_jumped_out_is_followed_from_the_same_side(seen):
    camera, eye, pose = seen
    eye.look_at = PUMA.arm.position(PUMA.home)
    eye.position = eye.look_at + 0.4 * direction(eye)  # close to the hand
    side = direction(eye)
    pose.q = np.zeros(6)
    camera.keep_in_view()
    np.testing.assert_allclose(direction(eye), side, atol=1e-9)
    points = np.vstack([PUMA.arm.frames(pose.q)[:, :3, 3], PUMA.arm.position(pose.q)])
    away = points - np.asarray(eye.position)
    depth = -(away @ side)
    across = np.linalg.norm(away + depth[:, None] * side, axis=1)
    assert np.all(across < depth * np.tan(eye.fov / 2.0)), "all joints are in the picture"


def test_the_pose_of_another_arm_moves_no_eye(seen):
    camera, eye, pose = seen
    before = np.array(eye.position)
    pose.q = np.zeros(3)
    camera.keep_in_view()
    np.testing.assert_array_equal(eye.position, before)
