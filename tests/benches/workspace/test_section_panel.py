"""The page of the section as a browser gets it."""

import itertools
import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from armlab.benches.workspace.cloud.ui.measured import with_error
from armlab.benches.workspace.section.found import Question, finding
from armlab.benches.workspace.section.job import found_section
from armlab.benches.workspace.section.slice import hull, plane_drawn, slice_at, slice_range
from armlab.benches.workspace.section.state import GoInSection, GoToPoint, PlaceSlice, SectionView, found_of
from armlab.benches.workspace.section.ui.page import PANEL, choices_markup, place_markup, view_markup
from armlab.benches.workspace.section.ui.picture import SPECK, _outlines, frame_of, image_rule
from armlab.benches.workspace.section.ui.words import distances, facts, scale
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.dh import Row
from armlab.kin.workspace.section_size import Size
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from armlab.ui.html import joined
from armlab.ui.units import units_of
from support.forms import BareForm, asked
from support.looking import degrees_off
from support.student import run, student

ARMS = ("planar_2r_unequal", "elbow_3r", "cartesian_3p", "scara")


@cache
def whole(key, *given):
    """Return a state with the section found; one more setting goes on from what is found without it."""
    if not given:
        return found_section(State.initial(catalogue()[key]))
    return found_section(apply(whole(key, *given[:-1]), given[-1]))


@cache
def found_of_arm(*rows):
    """Return the section of an elbow with other rows."""
    arm = replace(catalogue()["elbow_3r"].arm, convention="modified", rows=rows, tool=np.eye(4))
    return [each for each in finding(Question(arm, "reach", None)) if each is not None][-1]


def test_an_error_has_one_figure_rounded_up():
    assert with_error(Size(6.283233, 0.000096, "m²")) == "6.2832 ± 0.0001 m²"
    assert with_error(Size(6.2208, 0.0024, "m³")) == "6.221 ± 0.003 m³"
    assert with_error(Size(118.2, 9.7, "m³")) == "118 ± 10 m³"
    assert with_error(Size(0.0, 0.0, "m³")) == "0 m³"


def test_specks_are_left_out_until_a_section_is_finished():
    arm = catalogue()["puma560"].arm
    early = next(each for each in finding(Question(arm, "reach", None)) if each is not None)
    lines = early.section.contours
    large = [line for line in lines if len(line) > SPECK]
    assert 0 < len(large) < len(lines) / 4
    assert _outlines(early).count("M") == len(large)
    finished = replace(early, section=replace(early.section, finished=True))
    assert _outlines(finished).count("M") == len(lines)


def commands(state, cell, text):
    units, found = units_of(state), found_of(state)
    return asked(
        lambda form: (
            choices_markup(form, state, units),
            place_markup(form, state, found, units),
            view_markup(form, state, found, units),
        ),
        cell,
        text,
    )


@pytest.mark.parametrize("key", ARMS)
def test_no_page_holds_a_number_that_is_none(key):
    state = whole(key, Set(SectionView, "colour", "sigma_min"))
    found, units = found_of(state), units_of(state)
    page = joined(view_markup(BareForm(), state, found, units)) + joined(facts(found, units))
    assert not re.search(r"\bnan\b|\binf\b|∞", page)
    assert "data:image/png;base64," in image_rule(found, "x")
    assert ("Area" in page) == (key == "planar_2r_unequal")


@pytest.mark.parametrize("key", ["scara", "cylindrical_rpp"])
def test_the_tool_is_never_told_to_be_outside_the_workspace(key):
    state = whole(key)
    arm, units = state[Joints].arm, units_of(state)
    for ends in itertools.product((0, 1), repeat=arm.n):
        there = state.replace(state[Joints].moved_to(arm.limits[range(arm.n), ends]))
        page = joined(distances(BareForm(), there, units))
        assert "outside" not in page
        assert "on the boundary" in page


@pytest.mark.parametrize("key", ARMS)
def test_a_click_on_the_tool_goes_where_the_tool_is(key):
    state = whole(key)
    found, joints = found_of(state), state[Joints]
    frame = frame_of(found)
    joint = found.section.joint
    point = joints.tool_pose[:3, 3]
    place = ((point - joint.origin) @ joint.axes)[:2] if found.section.grid.flat else joint.split(point)[:2]
    x, y = (place - frame.low) / (frame.high - frame.low)
    (command,) = commands(state, "go", f"{x:.9f},{1.0 - y:.9f}")
    if isinstance(command, GoInSection):
        np.testing.assert_allclose([command.u, command.v], place, atol=1e-6)
    else:
        assert isinstance(command, GoToPoint)
        np.testing.assert_allclose(command.point, point, atol=1e-6)


@pytest.mark.parametrize(("apart", "label"), [(0.0, "frame 0"), (0.4, "ρ = z = 0")])
def test_the_reach_is_told_from_where_it_is_measured(apart, label):
    found = found_of_arm(Row("R", a=apart), Row("R", a=0.0, alpha=np.pi / 2), Row("R", a=1.0))
    arm = found.arm
    joint = found.section.joint
    np.testing.assert_allclose(np.linalg.norm(joint.origin - arm.base[:3, 3]), apart, atol=1e-12)
    points = arm.position(np.random.default_rng(3).uniform(*arm.limits.T, (20_000, arm.n)))
    far = np.linalg.norm(points - joint.origin, axis=1).max()
    assert far <= found.reach.farthest + 1e-9 < far + 0.02
    words = re.sub(r"<[^>]+>", " ", joined(facts(found, units_of(State.initial(catalogue()["elbow_3r"])))))
    assert re.search(rf"Farthest from\s+{label}\s", words)


@pytest.mark.parametrize(("alpha", "label"), [(0.0, "Height over frame 0"), (np.pi / 2, "Along axis 1")])
def test_only_what_is_along_z0_is_called_a_height(alpha, label):
    found = found_of_arm(Row("R", alpha=alpha), Row("R", a=0.2, alpha=np.pi / 2), Row("R", a=1.0))
    page = joined(facts(found, units_of(State.initial(catalogue()["elbow_3r"]))))
    assert f"<span>{label}</span>" in page


UPRIGHT = {"alpha": 0.5 * np.pi}
NO_SIZE = (
    ((Row("R"), Row("R", **UPRIGHT), Row("R", **UPRIGHT)), "in one point"),
    ((Row("R"), Row("P"), Row("R", **UPRIGHT)), "on a line"),
    ((Row("R"), Row("R", a=0.5, **UPRIGHT), Row("R", **UPRIGHT)), "on a line"),
    ((Row("R"), Row("R", a=0.5, **UPRIGHT), Row("R", a=1.0, alpha=0.3)), "on a surface"),
)


@pytest.mark.parametrize(("rows", "where"), NO_SIZE)
def test_a_tool_that_covers_no_volume_stays_where_it_is_said(rows, where):
    page = joined(facts(found_of_arm(*rows), units_of(State.initial(catalogue()["elbow_3r"]))))
    assert f"none: the tool stays {where}<" in page


def test_the_directions_across_a_sliding_joint_1_have_names():
    state = whole("cartesian_3p")
    page = joined(facts(found_of(state), units_of(state)))
    assert "<span>Along x₀</span>" in page
    assert "<span>Along y₀</span>" in page


@pytest.mark.parametrize(("unit", "shown"), [("deg", "−29.8"), ("rad", "−0.520")])
def test_the_place_of_the_slice_has_the_usual_decimals(unit, shown):
    state = apply(apply(whole("elbow_3r"), PlaceSlice(-0.52)), Set(Notation, "angle", unit))
    assert f'value="{shown}"' in joined(place_markup(BareForm(), state, found_of(state), units_of(state)))


def test_what_is_still_averaged_is_said_in_a_sentence():
    found = replace(found_of(whole("elbow_3r", Set(SectionView, "colour", "manipulability"))), coloured=False)
    assert "each cell. Being averaged …</p>" in joined(scale(found))


def test_a_measure_that_is_the_same_everywhere_has_no_scale():
    found = found_of(whole("cartesian_3p", Set(SectionView, "colour", "sigma_min")))
    assert "the same everywhere: 1</div>" in joined(scale(found))


def test_what_is_pressed_and_typed_becomes_commands():
    state = whole("elbow_3r")
    assert commands(state, "slice z", "") == (Set(SectionView, "slice", "z"),)
    assert commands(state, "colour", "sigma_min") == (Set(SectionView, "colour", "sigma_min"),)
    assert commands(state, "follow", "") == (PlaceSlice(None),)
    (turned,) = commands(state, "at", "90")
    np.testing.assert_allclose(turned.at, np.pi / 2)
    (moved,) = commands(apply(state, Set(SectionView, "slice", "x")), "at", "250")
    np.testing.assert_allclose(moved.at, 0.25)
    with pytest.raises(InputError, match="place of the slice"):
        commands(state, "at", "there")
    with pytest.raises(InputError, match="expected a place"):
        commands(state, "go", "somewhere")


def test_the_page_is_filled_clicked_and_sliced(url):
    async def scenario():
        browser = await student(url, path="/robot/planar_2r_unequal")
        try:
            await browser.open("section")
            await browser.until(lambda: "To the boundary" in browser.html())
            assert re.search(r"6\.283[12]\d* ± 0\.000\d+ m²", browser.html())
            await browser.until(lambda: any(name.endswith("section/slice") for name in browser.nodes))
            before = browser.nodes["/target"]["position"]
            await browser.press("go", "0.5,0.1")
            await browser.until(lambda: browser.nodes["/target"]["position"] != before)
            await browser.press("boundary")
            await browser.until(lambda: "<span>on the boundary</span>" in browser.html())
            await browser.press("colour", "manipulability")
            await browser.until(lambda: "kit-scale" in browser.html())
        finally:
            await browser.close()

    run(scenario())


@pytest.mark.parametrize("key", ["elbow_3r", "scara", "cartesian_3p"])
def test_the_slider_of_a_slice_is_as_long_as_the_workspace(key):
    found = found_of(whole(key))
    points, base = hull(found.section), found.arm.base
    for axis, kind in enumerate("xyz"):
        along = (points - base[:3, 3]) @ base[:3, axis]
        np.testing.assert_allclose(slice_range(found, kind), [along.min(), along.max()])
    low, high = slice_range(found, "axis")
    if found.section.joint.revolute:
        assert (low, high) == (-np.pi, np.pi)
    else:
        assert low < slice_at(whole(key), found) < high


def test_a_slice_is_moved_by_its_slider(url):
    async def main():
        browser = await student(url, path="/robot/elbow_3r")
        await browser.open("section")
        await browser.press("slice z")
        await browser.until(lambda: any(c["props"].get("label") == "z mm" for c in browser.controls.values()))
        slider = browser.control("z mm")
        assert slider["props"]["min"] < 0.0 < 1000.0 < slider["props"]["max"]
        await browser.set_value(slider, 312.5)
        await browser.until(lambda: 'value="312.5"' in browser.html())
        await browser.close()

    run(main())


@pytest.mark.parametrize("key", ARMS)
@pytest.mark.parametrize("kind", ["axis", "x", "y", "z"])
def test_a_section_is_looked_at_square_from_the_side_of_its_picture(key, kind):
    state = apply(whole(key), Set(SectionView, "slice", kind))
    facing, corners = PANEL.faces(state), plane_drawn(state).corners
    back, up = facing.direction()
    middle = corners.mean(axis=0)
    assert np.abs((corners - middle) @ back).max() < 2e-3 * np.linalg.norm(corners - middle, axis=1).max()
    assert degrees_off(back, facing.normal) < 0.1
    np.testing.assert_array_equal(up, [0.0, 0.0, 1.0])
