"""The pages of frames in a browser: handles dragged, numbers typed, a film played, an arm sent to a table."""

import numpy as np
import pytest

from armlab.benches.frames.chain.stage import places_of, unit_of
from armlab.benches.frames.chain.ui.scene import HANDLE
from armlab.benches.frames.two.ui.scene import HANDLE as BASE_HANDLE
from armlab.content.robots import catalogue
from armlab.session.state import State
from support.page import HANDLE as OF_THE_ARM

pytestmark = pytest.mark.browser

POLE = ["w", "4000.0", "3000.0", "0.0", "S"]
"""The end of the table of coordinates: the pole in the world, and the frame in which it is typed."""


def numbers(lab, *cells):
    values = [lab.page.locator(f'input[data-cell="{cell}"]').first.input_value() for cell in cells]
    return np.array([float(value.replace("−", "-")) for value in values])


def choose(lab, cell, key):
    lab.page.locator(f'select[data-cell="{cell}"]').first.select_option(key)


def test_a_chain_of_frames_is_dragged_and_typed_and_a_screw_is_played(visit):
    lab = visit(size=(1100, 800))
    lab.open_tab("frame_chain")
    a_frame_is_dragged_along_its_parent_and_an_undo_brings_it_back(lab)
    frames_are_added_named_hung_elsewhere_and_removed(lab)
    the_pole_of_the_sphere_is_where_the_notes_have_it(lab)
    a_point_is_typed_in_any_coordinates(lab)
    a_screw_is_typed_and_played(lab)


def a_frame_is_dragged_along_its_parent_and_an_undo_brings_it_back(lab):
    lab.until(lambda: any("/chain/handle" in name for name in lab.nodes()))
    unit = unit_of(places_of(State.initial(catalogue()["puma560"])))
    node = next(name for name in lab.nodes() if name.endswith("/chain/handle1"))
    before = numbers(lab, "position 0", "position 1", "position 2")
    lab.drag_handle(2, HANDLE * unit / OF_THE_ARM, (0.0, -50.0), node=node)
    lab.until(lambda: numbers(lab, "position 2")[0] > before[2] + 5.0)
    np.testing.assert_array_equal(numbers(lab, "position 0", "position 1"), before[:2])
    lab.page.keyboard.press("Control+z")
    lab.until(lambda: np.array_equal(numbers(lab, "position 0", "position 1", "position 2"), before))


def frames_are_added_named_hung_elsewhere_and_removed(lab):
    lab.press("remove")
    lab.waits_for("B: C is given in it")
    lab.press("add")
    lab.until(lambda: lab.page.locator('button[data-cell="frame D"]').count() == 1)
    lab.type_into("name", "tool")
    lab.until(lambda: lab.page.locator('button[data-cell="frame tool"]').count() == 1)
    choose(lab, "parent", "C")
    choose(lab, "frame", "tool")
    lab.until(lambda: lab.page.locator(".fr-product s").count() == 6)
    lab.press("written matrix")
    lab.type_into("R 00", "2")
    lab.waits_for("Not a rotation: the nearest one is")
    lab.press("remove")
    lab.until(lambda: lab.page.locator('button[data-cell="frame tool"]').count() == 0)


def the_pole_of_the_sphere_is_where_the_notes_have_it(lab):
    choose(lab, "example", "sphere")
    lab.until(lambda: lab.page.locator(".fr-points").inner_text().split()[-5:] == POLE)
    lab.until(lambda: any(name.endswith("/chain/globe") for name in lab.nodes()))


def a_point_is_typed_in_any_coordinates(lab):
    lab.open_tab("coordinates")
    lab.type_into("cylindrical r", "500")
    lab.type_into("cylindrical theta", "90")
    lab.until(lambda: np.array_equal(numbers(lab, "cartesian x", "cartesian y"), [0.0, 500.0]))
    lab.type_into("spherical phi", "200")
    lab.waits_for("φ: expected a number in degrees from 0 to 180")
    lab.type_into("cylindrical r", "0")
    lab.waits_for("On the z axis θ is not defined")


def a_screw_is_typed_and_played(lab):
    lab.open_tab("screw")
    lab.waits_for("It turns about one line and slides along it")
    choose(lab, "example", "door")
    lab.waits_for("nothing slides along the axis")
    lab.type_into("screw distance", "200")
    lab.until(lambda: numbers(lab, "position second 2")[0] == 400.0)
    lab.type_into("time", "1")
    lab.waits_for("at 1.00 s")
    lab.press("play-screw")
    lab.waits_for("at 4.00 s")
    lab.type_into("screw direction 0", "0 0 0")
    lab.waits_for("zero has no direction")


def test_an_arm_is_sent_above_a_table_and_two_robots_meet(visit):
    lab = visit("robot/puma560", size=(1100, 800))
    lab.open_tab("table_task")
    lab.waits_for("The tool is elsewhere")
    lab.press("go")
    lab.waits_for("The tool is above the object")
    assert "reached" in lab.hint()
    lab.press("follow")
    node = next(name for name in lab.nodes() if name.endswith("/table/handle"))
    before = numbers(lab, "object 0")[0]
    lab.drag_handle(0, 1.27, (40.0, 0.0), node=node)
    lab.until(lambda: abs(numbers(lab, "object 0")[0] - before) > 5.0)
    lab.waits_for("The tool is above the object")
    lab.open_tab("two_robots")
    both_robots_meet_in_two_ways_until_the_second_is_too_far_away(lab)


def both_robots_meet_in_two_ways_until_the_second_is_too_far_away(lab):
    lab.waits_for("Two solutions")
    lab.press("elbow down")
    lab.until(lambda: lab.page.locator('button[data-cell="elbow down"]').get_attribute("aria-pressed") == "true")
    node = next(name for name in lab.nodes() if name.endswith("/two/handle"))
    before = numbers(lab, "base B 0")[0]
    lab.drag_handle(0, BASE_HANDLE / OF_THE_ARM, (30.0, 0.0), node=node)
    lab.until(lambda: numbers(lab, "base B 0")[0] > before + 20.0)
    choose(lab, "example", "two")
    lab.waits_for("226.2 mm too far")
