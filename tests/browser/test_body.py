"""The body that is turned by its handle and typed in every form, in a browser."""

import numpy as np
import pytest

from armlab.benches.body.forms.stage import stage_of
from armlab.benches.body.forms.ui.handle import HANDLE
from armlab.content.robots import catalogue
from armlab.session.state import State

pytestmark = pytest.mark.browser


def numbers(lab, cells):
    values = [lab.page.locator(f'input[data-cell="{cell}"]').first.input_value() for cell in cells]
    return np.array([float(value.replace("−", "-")) for value in values])


def matrix(lab):
    return numbers(lab, [f"R {i}{j}" for i in range(3) for j in range(3)]).reshape(3, 3)


def test_a_dragged_ring_turns_the_body_an_undo_brings_it_back_and_every_form_follows_what_is_typed(visit):
    lab = visit(size=(1100, 800))
    lab.open_tab("body")
    lab.until(lambda: any(name.endswith("/body/handle") for name in lab.nodes()))
    lab.press("place none")
    lab.rest()
    np.testing.assert_array_equal(matrix(lab), np.eye(3))
    # Along the ring about x from y towards z, beginning where no other ring is near in the picture.
    node, (_, radius) = lab.node("/body/handle"), stage_of(State.initial(catalogue()["puma560"]))
    angles = np.radians(np.linspace(20.0, 50.0, 13))
    way = 0.65 * HANDLE * radius * np.stack([0.0 * angles, np.cos(angles), np.sin(angles)], axis=1)
    pixels = lab.on_screen_at_rest(node, way)
    lab.page.mouse.move(*pixels[0])
    lab.frames(3)
    lab.page.mouse.down()
    for pixel in pixels[1:]:
        lab.page.mouse.move(*pixel)
        lab.frames(1)
    lab.frames(3)
    lab.page.mouse.up()
    lab.rest()
    R = matrix(lab)
    assert abs(R[1, 1] - 1.0) > 0.01
    np.testing.assert_allclose(R @ R.T, np.eye(3), rtol=0, atol=2e-3)
    np.testing.assert_array_equal(R[0], [1, 0, 0])
    lab.page.keyboard.press("Control+z")
    lab.until(lambda: np.array_equal(matrix(lab), np.eye(3)))
    _follows_in_every_form_what_is_typed(lab)


def _follows_in_every_form_what_is_typed(lab):
    lab.type_into("turn", "90")
    lab.until(lambda: matrix(lab)[0, 0] == 0.0)
    np.testing.assert_array_equal(matrix(lab), [[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    np.testing.assert_allclose(numbers(lab, [f"q {k}" for k in range(4)]), [0.7071, 0, 0, 0.7071])
    lab.type_into("angle 1", "90")
    lab.waits_for("Gimbal lock: only φ − ψ = 90.0° is determined")
    lab.type_into("R 00", "2")
    lab.waits_for("Not a rotation")
    lab.type_into("q 0", "nothing")
    lab.waits_for("q w: expected a number")


def test_two_bodies_turn_about_moving_and_fixed_axes_and_end_alike(visit):
    lab = visit(size=(1100, 800))
    lab.open_tab("sequence")
    lab.waits_for("The bodies end alike")
    lab.press("made 1")
    lab.waits_for("apart at present")
    assert "after turn" not in lab.page.locator(".sq-both").inner_text()
    lab.press("play-sequence")
    lab.until(lambda: "after turn 2" in lab.page.locator(".sq-both").inner_text())
    lab.waits_for("The bodies end alike")
    lab.press("order same")
    lab.waits_for("they make another rotation")
    lab.type_into("angle 2", "x")
    lab.waits_for("ψ: expected a number in degrees")


def test_axis_and_angle_lead_to_a_matrix_in_three_steps_and_back(visit):
    lab = visit(size=(1100, 800))
    lab.open_tab("axis")
    lab.press("made 1")
    lab.waits_for("after step 1")
    lab.press("shown eigen")
    lab.type_into("turn", "90")
    lab.until(lambda: lab.page.locator(".ax-circle circle.ax-value").first.get_attribute("cx") == "105.0")
    lab.page.locator('select[data-cell="example"]').first.select_option("tiny")
    lab.waits_for("1.000000000·10⁻⁸")
    assert lab.says("15.7")
    lab.page.locator('select[data-cell="example"]').first.select_option("none")
    lab.waits_for("r is not determined")
    lab.type_into("axis 2", "0, 0, 0")
    lab.waits_for("zero has no direction")


def test_a_matrix_tells_where_axes_lie_and_turns_a_vector(visit):
    lab = visit(size=(1100, 800))
    lab.open_tab("meanings")
    lab.waits_for("Angles between the axes")
    lab.press("shown operator")
    lab.press("elementary z")
    lab.waits_for("In the plane of x and y the vector has the length")
    vector, image = (numbers(lab, [f"{name} {k}" for k in range(3)]) for name in ("p", "image"))
    assert np.linalg.norm(image) == pytest.approx(np.linalg.norm(vector), abs=1e-3)
    assert (image[2], abs(image[0] - vector[0]) > 0.01) == (vector[2], True)
    lab.type_into("image 2", "0.25")
    lab.until(lambda: numbers(lab, ["p 2"])[0] == 0.25)
    lab.type_into("p 1", "much")
    lab.waits_for("vector y: expected a number")
    assert numbers(lab, ["p 2"])[0] == 0.25


def test_a_quaternion_is_back_after_two_whole_turns(visit):
    lab = visit(size=(1100, 800))
    lab.open_tab("quaternion")
    lab.type_into("time", "4")
    lab.waits_for("The body is back, q is not")
    lab.type_into("time", "8")
    lab.waits_for("q = 1 after two whole turns")
    lab.press("shown algebra")
    lab.type_into("p 1", "none")
    lab.waits_for("p x: expected")
    lab.press("shown matrix")
    lab.press("turn half")
    lab.waits_for("Roots and signs fail here")
    lab.press("shown way")
    lab.press("ends wander")
    lab.waits_for("268.9°")
    lab.until(lambda: any(name.endswith("/way/traces/strokes") for name in lab.nodes()))


def test_rotations_in_both_orders_their_sizes_and_the_integral_of_omega(visit):
    lab = visit(size=(1100, 800))
    lab.open_tab("order")
    lab.waits_for("120.0°")
    lab.press("size down")
    lab.waits_for("1.4°")
    lab.page.locator('select[data-cell="example"]').first.select_option("half_turns")
    lab.waits_for("Both orders end alike")
    lab.press("integral")
    lab.waits_for("Equal integrals, ends 120.0° apart")
    lab.type_into("rate0 0", "45")
    lab.waits_for("The integrals differ by up to 45.0°")
    lab.type_into("seconds0 0", "soon")
    lab.waits_for("law 1, piece 1, duration: expected seconds")


def test_a_point_is_dragged_around_the_origin_and_formulas_are_compared(visit):
    lab = visit(size=(1100, 800))
    lab.open_tab("atan2")
    box = lab.page.locator("svg.at-plane").first.bounding_box()

    def go(x, y):
        lab.page.mouse.move(box["x"] + box["width"] * (x + 2.0) / 4.0, box["y"] + box["height"] * (2.0 - y) / 4.0)
        lab.frames(2)

    go(1.0, 1.0)
    lab.page.mouse.down()
    lab.waits_for("Both are 45.0°")
    for x, y in ((0.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)):
        go(x, y)
    lab.page.mouse.up()
    lab.waits_for("atan2 = −135.0°, but atan = 45.0°")
    lab.page.keyboard.press("Control+z")
    lab.waits_for("atan2 = 149.7°")
    lab.press("products")
    lab.page.locator('select[data-cell="example"]').first.select_option("zxz_21")
    lab.waits_for("It is off by up to")
    lab.type_into("typed", "sa cg + ca cb sg")
    lab.waits_for("It agrees with the entry at 50 points")
    lab.press("entry 22")
    lab.until(lambda: lab.page.locator('input[data-cell="typed"]').first.input_value() == "")
    lab.press("skew")
    lab.press("shown dyads")
    lab.press("take body")
    lab.waits_for("The sum is I")
    lab.open_tab("identities")
    lab.type_into("right", "sin(x) + sin(y)")
    lab.waits_for("Where they differ most")
    lab.type_into("right", "cos(x) sin(y) + cos y")
    lab.waits_for("right side: expected a bracket after cos")
