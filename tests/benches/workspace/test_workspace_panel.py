"""The page of the sampled workspace as a browser gets it, and its points in the scene."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from armlab.benches.workspace.cloud.cuts import FRONT
from armlab.benches.workspace.cloud.job import sampled
from armlab.benches.workspace.cloud.state import LookAtWorkspace, SampleWorkspace, Workspace
from armlab.benches.workspace.cloud.ui.measured import DECADES
from armlab.benches.workspace.cloud.ui.page import choices_markup
from armlab.benches.workspace.cloud.ui.scene import outside, parts_of
from armlab.benches.workspace.cloud.ui.voxels import CORNERS, SIDES
from armlab.benches.workspace.cloud.ui.words import counted, facts, scale
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.workspace.measures import MEASURES
from armlab.kin.workspace.sections import section
from armlab.session.state import State, apply
from armlab.ui.colours import viridis
from armlab.ui.html import joined
from armlab.ui.units import units_of
from support.forms import asked
from support.student import run, student


def test_sampling_shows_points_and_a_click_moves_the_arm(url):
    async def main():
        browser = await student(url, path="/robot/elbow_3r")
        await browser.open("workspace")
        await browser.until(lambda: "reachable workspace" in browser.html())
        await browser.press("count", "26000")
        await browser.press("sample")
        await browser.until(lambda: "Manipulability" in browser.html() and "26\u202f000</span>" in browser.html())
        await browser.until(lambda: any(name.endswith("workspace/points") for name in browser.nodes))
        await browser.press("cut z")
        await browser.until(lambda: 'data-cell="offset"' in browser.html())
        await browser.press("offset", "wide")
        await browser.until(lambda: "place of the slice, z: expected" in browser.html())
        await browser.press("offset", "500")
        await browser.press("draw voxels")
        await browser.until(lambda: any(name.endswith("workspace/voxels") for name in browser.nodes))
        await browser.press("clear")
        await browser.until(lambda: "reachable workspace" in browser.html())
        await browser.close()

    run(main())


def test_where_nothing_is_left_to_draw_it_is_said(url):
    async def main():
        browser = await student(url, path="/robot/cartesian_3p")
        await browser.open("workspace")
        await browser.press("sample")
        await browser.until(lambda: "the same everywhere: 1" in browser.html())
        await browser.press("cut x")
        await browser.until(lambda: 'data-cell="offset"' in browser.html())
        await browser.press("offset", "50000")
        await browser.until(lambda: "No sample lies here" in browser.html())
        await browser.press("offset", "9e9")
        await browser.until(lambda: "expected at most 10000 m" in browser.html())
        # A surface has no slices; while it is being found the points stay.
        await browser.press("draw surface")
        await browser.until(lambda: any(name.endswith("workspace/surface") for name in browser.nodes))
        await browser.until(lambda: "being found" not in browser.html())
        await browser.until(lambda: 'data-cell="cut x"' not in browser.html())
        await browser.close()

    run(main())


@pytest.mark.parametrize(
    ("look", "says"),
    [
        ({"cut": "z", "offset": 50.0}, "No sample lies here: move the slice."),
        ({"cut": "front"}, "The cut hides all samples: choose another."),
    ],
)
def test_what_hides_all_samples_is_named(look, says):
    state = sampled(apply(apply(State.initial(catalogue()["elbow_3r"]), LookAtWorkspace(**look)), SampleWorkspace()))
    found = state[Workspace].found
    before = found.shown.points[:, :2] @ [np.cos(FRONT), np.sin(FRONT)] > 0.0
    shown = found.shown._replace(points=found.shown.points[before])
    state = state.replace(replace(state[Workspace], found=replace(found, shown=shown)))
    assert says in joined(facts(state, state[Workspace].found, units_of(state)))
    surface = replace(state[Workspace], draw="surface", section=section(catalogue()["elbow_3r"].arm))
    assert "dim" not in joined(facts(state.replace(surface), surface.found, units_of(state)))


def test_an_example_brings_its_arm_and_says_what_to_look_at(url):
    async def main():
        browser = await student(url, path="/robot/puma560")
        await browser.open("workspace")
        await browser.press("example", "annulus")
        await browser.until(lambda: "The hole has the radius" in browser.html() and "Points drawn" in browser.html())
        await browser.press("measure", "sigma_min")
        await browser.until(lambda: "logarithmic" in browser.html())
        await browser.close()

    run(main())


@pytest.mark.parametrize("measure", list(MEASURES))
def test_the_scale_of_colours_is_that_of_the_points(measure):
    state = apply(State.initial(catalogue()["puma560"]), LookAtWorkspace(measure=measure, count=26_000))
    found = sampled(apply(state, SampleWorkspace()))[Workspace].found
    ends = [found.high * 10.0 ** (-DECADES), found.high] if MEASURES[measure].logarithmic else [found.low, found.high]
    np.testing.assert_allclose(parts_of(found, np.array(ends)), [0.0, 1.0], atol=1e-9)
    text = joined(scale(found))
    assert MEASURES[measure].title.capitalize()[1:] in text
    assert "≥" in text


def test_colours_go_from_dark_to_bright():
    colours = viridis(np.linspace(-0.5, 1.5, 50)).astype(float)
    light = colours @ [0.2126, 0.7152, 0.0722]
    assert np.all(np.diff(light) >= 0.0)
    assert light[-1] > 4.0 * light[0]
    np.testing.assert_array_equal(viridis(0.0), (68, 1, 84))
    np.testing.assert_array_equal(viridis(np.inf), (253, 231, 37))


def test_only_voxels_that_can_be_seen_are_drawn(rng):
    filled = np.zeros((7, 7, 7), dtype=bool)
    filled[1:6, 1:6, 1:6] = True
    seen = outside(filled)
    assert seen.sum() == 5**3 - 3**3
    assert not seen[2:5, 2:5, 2:5].any()
    everything = np.ones((4, 4, 4), dtype=bool)
    assert outside(everything).sum() == 4**3 - 2**3


def test_the_box_of_a_voxel_is_closed_and_turned_outwards():
    box = trimesh.Trimesh(CORNERS, SIDES, process=False)
    assert box.is_watertight
    assert box.volume == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize(("cell", "text"), [("seed", "-1"), ("seed", "1.5"), ("offset", "much")])
def test_wrong_input_is_said(cell, text):
    state = apply(State.initial(catalogue()["elbow_3r"]), LookAtWorkspace(cut="x"))
    with pytest.raises(InputError, match="expected"):
        asked(lambda form: joined(choices_markup(form, state, units_of(state))), cell, text)


def test_numbers_of_samples_are_readable():
    assert counted(10_000_000) == "10\u202f000\u202f000"
