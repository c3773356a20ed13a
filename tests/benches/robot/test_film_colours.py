"""The colours of the film's moves: apart from those of joints and axes, and with dark letters on them readable."""

from itertools import combinations

import numpy as np
import pytest

from armlab.benches.robot.film.ui.scene import COLOURS
from armlab.ui.colours import AXES, JOINTS, linear

XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
WHITE = np.array([0.9505, 1.0, 1.089])
INK = (31, 39, 51)


def lab(rgb):
    """Return CIELAB coordinates, whose distances are how different colours look."""
    x = XYZ @ linear(rgb) / WHITE
    f = np.where(x > 0.008856, np.cbrt(x), 7.787 * x + 16 / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def apart(one, other):
    return float(np.linalg.norm(lab(one) - lab(other)))


@pytest.mark.parametrize("name", COLOURS)
def test_no_move_has_the_colour_of_a_joint_or_an_axis(name):
    assert min(apart(COLOURS[name], taken) for taken in (*JOINTS, *AXES.values())) > 30.0


def test_the_moves_differ_from_each_other():
    assert min(apart(one, other) for one, other in combinations(COLOURS.values(), 2)) > 30.0


@pytest.mark.parametrize("name", COLOURS)
def test_letters_on_a_move_can_be_read(name):
    light, dark = (float(XYZ[1] @ linear(rgb)) for rgb in (COLOURS[name], INK))
    assert (light + 0.05) / (dark + 0.05) > 4.0
