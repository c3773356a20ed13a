"""The page of orientations as a browser gets it, its words and units, and its pictures."""

import math
import re
from itertools import combinations

import numpy as np
import pytest

from armlab.benches.workspace.cloud.ui.measured import with_error
from armlab.benches.workspace.dexterous.job import studied
from armlab.benches.workspace.dexterous.places import GoToRegion, StandStretched
from armlab.benches.workspace.dexterous.state import COUNTS, Dexterous, study_of
from armlab.benches.workspace.dexterous.ui.page import PANEL, choices_markup
from armlab.benches.workspace.dexterous.ui.rings import ALPHA, picture
from armlab.benches.workspace.dexterous.ui.scene import SIDE, image
from armlab.benches.workspace.dexterous.ui.words import (
    count_colour,
    planar_words,
    proven,
    regions_table,
    scale,
    tool_line,
    tool_words,
)
from armlab.content.robots import catalogue, own_robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.workspace.planar_regions import regions
from armlab.kin.workspace.section_size import Size
from armlab.session.field_words import SetFields
from armlab.session.fields import Set
from armlab.session.parts.joints import MoveJoint
from armlab.session.parts.notation import Notation
from armlab.session.parts.target import PlaceTarget
from armlab.session.state import State, apply
from armlab.ui.colours import GREEN, ORANGE, VERMILLION, viridis
from armlab.ui.format import number
from armlab.ui.html import joined
from armlab.ui.units import units_of
from support.forms import BareForm, asked
from support.student import run, student


def state_of(key, **settings):
    """Return the state with an arm, few samples, and these settings."""
    return apply(State.initial(catalogue()[key]), SetFields.of(Dexterous, **{"count": COUNTS[0], **settings}))


def words(state):
    """Return all that is said of a planar arm."""
    units = units_of(state)
    return joined(tool_words(state, units), regions_table(BareForm(), state, units), planar_words(state, units))


# -- over the wire ---------------------------------------------------------------------------------------------------


def test_a_planar_arm_shows_its_regions_and_goes_where_it_is_sent(url):
    async def main():
        browser = await student(url, path="/robot/planar_3r")
        await browser.open("dexterous")
        await browser.until(lambda: "dexterous WS₂" in browser.html())
        await browser.until(lambda: any(name.endswith("dexterous/rings/areas") for name in browser.nodes))
        await browser.press("region 1")
        await browser.until(lambda: "three of them singular" in browser.html())
        await browser.press("way 1 1")
        await browser.until(lambda: "r = 1000.0 mm" in browser.html())
        await browser.press("method count")
        await browser.until(lambda: "Each number is all there are" in browser.html())
        await browser.until(lambda: any(name.endswith("dexterous/slice/picture") for name in browser.nodes))
        await browser.close()

    run(main())


def test_an_arm_with_a_spherical_wrist_is_computed_shown_and_stopped(url):
    async def main():
        browser = await student(url, path="/robot/irb140")
        await browser.open("dexterous")
        await browser.until(lambda: "96³" in browser.html() and "wrist too" in browser.html())
        await browser.press("draw body")
        await browser.until(lambda: "No point has all directions" in browser.html())
        await browser.press("share 0.5")
        await browser.until(lambda: any(name.endswith("dexterous/body") for name in browser.nodes))
        await browser.press("method sampled")
        await browser.until(lambda: 'data-cell="count 10000000"' in browser.html())
        await browser.press("count 10000000")
        await browser.until(lambda: "Computing:" in browser.html())
        await browser.press("stop")
        await browser.until(lambda: "Stopped." in browser.html())
        await browser.press("slice", "wide")
        await browser.until(lambda: "slice: expected a number" in browser.html())
        await browser.press("slice", "90")
        await browser.until(lambda: "Computing:" in browser.html())
        await browser.close()

    run(main())


# -- words -----------------------------------------------------------------------------------------------------------


def test_each_region_has_a_row_and_that_of_the_tool_is_explained():
    state = state_of("planar_3r_unequal")
    found = regions((1.0, 0.6, 0.4))
    for index, region in enumerate(found):
        now = apply(state, GoToRegion(index))
        said = words(now)
        assert said.count('class="dx-region"') == len(found)
        assert said.count('aria-pressed="true"') == 1
        assert region.solutions in said
    assert "600.0 – 1400.0 mm" in words(state)
    assert "where the notes differ" in words(state).lower()


def test_the_numbers_at_the_tool_are_those_of_the_closed_form():
    state = apply(state_of("planar_3r"), GoToRegion(2))
    # Half way from l to 3 l: the circle of joint 3 is cut where r² + l² - 2 r l cos psi = (2 l)².
    half = math.acos((4.0 + 1.0 - 4.0) / (2 * 2.0 * 1.0))
    assert f"{math.degrees(2 * half):.1f}° of 360.0°" in words(state)
    assert "r = 2000.0 mm" in words(state)
    radians = apply(apply(state, Set(Notation, "angle", "rad")), Set(Notation, "length", "m"))
    assert f"{2 * half:.3f} rad of 6.283 rad" in words(radians)
    assert "r = 2.0000 m" in words(radians)
    assert "0.00 – 6.28 rad" in words(radians)


def test_a_singular_circle_offers_its_configurations():
    state = apply(state_of("planar_3r"), StandStretched(1, 1))
    said = words(state)
    assert [f'data-cell="way 1 {k}"' in said for k in range(4)] == [True, True, True, False]
    assert "→ ← →" in said


def test_the_target_has_its_own_region():
    state = state_of("planar_2r")
    T = np.eye(4)
    T[0, 3] = 2.5
    assert "outside WS₁" in words(apply(state, PlaceTarget(T)))
    assert "the origin" in words(state)


def test_limits_are_not_passed_over_in_silence():
    arm = catalogue()["planar_3r"].arm
    tight = Arm.from_dh(arm.rows, limits=[[-2.5, 2.5], [-2.0, 2.0], [-1.5, 1.5]], task=arm.task)
    state = studied(apply(State.initial(own_robot(tight, "tight")), Set(Dexterous, "count", COUNTS[0])))
    assert "without joint limits" in words(state)
    assert "without joint limits" not in words(state_of("planar_3r"))
    found = study_of(state)
    assert "others may have been missed" in joined(proven(state, found, units_of(state)))
    assert "in its cell" in joined(tool_line(state, found))


def test_what_is_known_of_a_wrist_counts_its_limits_and_samples_say_at_least():
    state = studied(state_of("puma560"))
    found = study_of(state)
    said = joined(proven(state, found, units_of(state)))
    assert "those of the wrist too" in said
    assert "upper bound" not in said
    assert "closed form" in said
    assert "none" in said
    assert "at most" not in joined(tool_line(state, found))
    # The limits of joint 5 alone leave (1 + sin 10°) / 2 of the sphere, and not all of that.
    assert "Largest share" in said
    assert 0.5 < found.wrist.fraction.max() < 0.5 * (1.0 + math.sin(math.radians(10.0))) + 0.1
    state = studied(apply(state, Set(Dexterous, "method", "sampled")))
    found = study_of(state)
    assert "at least" in joined(proven(state, found, units_of(state)))
    assert "at least" in joined(tool_line(state, found))
    aside = apply(state, MoveJoint(0, 2.0))
    assert "beside this slice" in joined(tool_line(aside, study_of(aside)))


def test_the_scale_of_solutions_names_each_number_that_is_there():
    state = studied(state_of("scara", method="count"))
    found = study_of(state)
    said = joined(scale(state, found))
    numbers = np.unique(found.map.values[np.isfinite(found.map.values)])
    assert all(f"</i>{number:.0f}</span>" in said for number in numbers)
    assert len({count_colour(number) for number in (1.0, 2.0, 3.0, 4.0, 8.0, math.inf)}) == 6


def chosen(state):
    """Return the choices of the page as a browser gets them."""
    return joined(choices_markup(BareForm(), state, units_of(state)))


def test_where_no_point_has_the_share_of_a_body_another_is_named():
    state = studied(state_of("puma560", draw="body"))
    assert "No point has all directions; try 50 %." in chosen(state)
    assert "No point" not in chosen(apply(state, Set(Dexterous, "share", 0.5)))
    assert "No point" not in chosen(apply(state, Set(Dexterous, "draw", "slice")))


def test_a_volume_without_the_limits_of_the_wrist_is_called_so_and_no_bound():
    """Joint 1 slides: then the limits of the wrist are left out."""
    rows = [("P", 0, 0, 0.1, 0), ("R", 0.6, 0, 0, 0), ("R", 0.4, np.pi / 2, 0, 0), ("R", 0, -np.pi / 2, 0, 0)]
    rows += [("R", 0, np.pi / 2, 0, 0), ("R", 0, 0, 0.1, 0)]
    arm = Arm.from_dh(rows, limits=[[0, 1.5], *[[-3, 3]] * 2, *[[-2, 2]] * 3])
    state = studied(apply(State.initial(own_robot(arm, "sliding")), Set(Dexterous, "count", COUNTS[0])))
    found = study_of(state)
    assert found.wrist.volume > 0.0
    said = joined(proven(state, found, units_of(state)))
    assert "WS₂ without wrist limits" in said
    assert "upper bound" in said
    assert with_error(Size(found.wrist.volume, found.wrist.volume_error, "m³")) in said
    assert "at most" in joined(tool_line(state, found))


def test_a_tool_that_never_turns_has_one_orientation_and_no_share():
    state = studied(state_of("cartesian_3p", method="sampled"))
    found = study_of(state)
    said = joined(proven(state, found, units_of(state))) + joined(tool_line(state, found)) + joined(scale(state, found))
    assert "The tool never turns: one orientation" in said
    assert "64" not in said
    assert "none found" not in said
    assert "Approach directions" not in said


@pytest.mark.parametrize(
    ("key", "known"), [("polar_rrp", "fixes the orientation"), ("r4", "of one angle"), ("scorbot", "two angles")]
)
def test_what_a_short_arm_cannot_have_is_said_as_known_and_not_as_sampled(key, known):
    state = studied(state_of(key, method="sampled"))
    said = joined(proven(state, study_of(state), units_of(state)))
    assert known in said
    assert "none found" not in said
    full = studied(state_of("scara", method="sampled"))
    assert "singular points" not in joined(proven(full, study_of(full), units_of(full)))


def test_the_slice_is_named_within_one_turn_and_in_the_units_chosen():
    state = state_of("ur5e")

    def typed(text):
        return asked(lambda form: joined(choices_markup(form, state, units_of(state))), "slice", text)

    (command,) = typed("3590")
    assert f'value="{number(-10.0, 1)}"' in chosen(apply(state, command))
    with pytest.raises(InputError, match=r"^slice: expected a number in degrees from −3600 to 3600, got '1e9'$"):
        typed("1e9")
    radians = apply(apply(state, Set(Dexterous, "s", 2.0)), Set(Notation, "angle", "rad"))
    assert re.search(r'value="2\.000"[^>]*data-cell="slice"', chosen(radians))


def test_a_lone_method_says_why_there_is_no_other():
    for key in ("panda", "trunk9"):
        said = chosen(state_of(key))
        assert 'data-cell="method sampled"' in said
        assert "Not by Wrist: the last three axes do not meet" in said
        assert "not by Solutions" in said
    assert "Not by" not in chosen(state_of("puma560"))


def test_numbers_of_solutions_are_told_apart():
    colours = [np.array(count_colour(number), dtype=float) for number in (*range(1, 9), 16, math.inf)]
    apart = [np.linalg.norm(a - b) for a, b in combinations(colours, 2)]
    assert min(apart) > 60.0


# -- pictures --------------------------------------------------------------------------------------------------------


def test_rings_have_the_colours_of_their_regions():
    seen = picture(regions((1.0, 1.0, 1.0)), 300)
    assert tuple(seen[150, 160]) == (*GREEN, ALPHA)
    assert tuple(seen[150, 250]) == (*ORANGE, ALPHA)
    assert seen[0, 0, 3] == 0
    hole = picture(regions((1.0, 0.4)), 300)
    assert hole[150, 150, 3] == 0


def test_a_slice_has_a_colour_where_there_is_a_value():
    values = np.full((3, 5), np.nan)
    values[2, 0], values[0, 4] = 1.0, 0.25
    seen = image(values, counts=False)
    assert max(seen.shape) >= SIDE
    assert seen.shape[0] / seen.shape[1] == 5 / 3
    times = seen.shape[0] // 5
    assert tuple(seen[0, -1, :3]) == tuple(viridis(1.0))
    assert tuple(seen[-1, 0, :3]) == tuple(viridis(0.25))
    assert seen[times * 2, times, 3] == 0
    infinite = image(np.array([[np.inf, 2.0]]), counts=True)
    assert tuple(infinite[0, 0, :3]) == VERMILLION


def test_what_is_drawn_belongs_into_the_picture():
    around = PANEL.around(state_of("planar_3r"))
    np.testing.assert_allclose(np.linalg.norm(around[:, :2], axis=1), 3.0)
    assert len(PANEL.around(state_of("ur5e"))) == 0
    corners = PANEL.around(studied(state_of("ur5e")))
    assert corners.shape == (4, 3)
    assert np.ptp(corners[:, 2]) > 1.5
