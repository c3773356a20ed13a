"""The page "Compare designs" through the protocol and as markup."""

import math
import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from armlab.benches.workspace.section.ui.words import across
from armlab.benches.workspace.what_if.job import compared
from armlab.benches.workspace.what_if.state import (
    ChooseQuantity,
    ForgetChanges,
    Suppose,
    TakeOver,
    WhatIf,
)
from armlab.benches.workspace.what_if.ui.page import PANEL, choices_markup, exact_markup, slid_to, told_markup
from armlab.benches.workspace.what_if.ui.picture import picture
from armlab.benches.workspace.what_if.ui.words import (
    changes_markup,
    figures_markup,
    legend_markup,
    name_of,
    verdict_markup,
)
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.dh import Row
from armlab.kin.workspace.first_joint import first_joint
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from armlab.ui.html import joined
from armlab.ui.units import units_of
from support.forms import BareForm, asked
from support.student import run, student


def opened(key, *wished):
    state = State.initial(catalogue()[key])
    for command in wished:
        state = apply(state, command)
    return state


@cache
def known(key, *wished):
    """Return the state with both workspaces known."""
    return compared(opened(key, *wished))


def commands(state, cell, text=""):
    part, units = state[WhatIf], units_of(state)
    return asked(
        lambda form: (
            choices_markup(form, part, units),
            exact_markup(form, part, units),
            told_markup(form, state, units),
        ),
        cell,
        text,
    )


def plain(markup):
    return " ".join(re.sub(r"<[^>]+>", " ", markup).split())


@pytest.mark.parametrize("unit", ["rad", "deg"])
def test_the_slider_stands_for_what_looks_the_same(unit):
    state = apply(
        opened("planar_2r", Suppose(0, "alpha", 1.0), ChooseQuantity(0, "alpha")), Set(Notation, "angle", unit)
    )
    part, units = state[WhatIf], units_of(state)
    for exact in (math.pi, -math.pi, math.pi / 2, 0.0):
        assert slid_to(part, units.value(exact, True), units) == Suppose(0, "alpha", exact)
    between = units.value(1.3, True)
    assert slid_to(part, between, units).value == pytest.approx(between * units.factor(True), abs=1e-15)
    turned = apply(state, slid_to(part, units.value(math.pi, True), units))
    assert first_joint(turned[WhatIf].other).planar, "axes are parallel"
    puma = opened("puma560", ChooseQuantity(2, "d"))
    real = puma[WhatIf].arm.rows[2].d
    assert units.value(real, False) * units.factor(False) != real
    moved = apply(puma, slid_to(puma[WhatIf], 200.0, units))
    assert not apply(moved, slid_to(moved[WhatIf], units.value(real, False), units))[WhatIf].changes


def test_cells_become_commands():
    state = opened("planar_2r", Suppose(0, "a", 1.2))
    assert commands(state, "take") == (TakeOver(),)
    assert commands(state, "forget") == (ForgetChanges(),)
    assert commands(state, "joint 1") == (ChooseQuantity(1),)
    assert commands(state, "field low") == (ChooseQuantity(0, "low"),)
    assert commands(state, "value", "750") == (Suppose(0, "a", 0.75),)
    assert commands(state, "value", "80 cm") == (Suppose(0, "a", 0.8),)
    assert commands(state, "back 0 a") == (Suppose(0, "a", 1.0),)
    with pytest.raises(InputError, match="a₁: expected a number in mm, got 'long'"):
        commands(state, "value", "long")
    turned = apply(state, ChooseQuantity(1, "high"))
    (command,) = commands(turned, "value", "90")
    assert (command.row, command.field) == (1, "high")
    assert command.value == pytest.approx(1.5707963, abs=1e-6)
    in_radians = apply(apply(state, ChooseQuantity(1, "alpha")), Set(Notation, "angle", "rad"))
    assert commands(in_radians, "value", "-1.5708")[0].value == -math.pi / 2


def test_quantities_have_the_names_of_the_table():
    panda = opened("panda")
    arm, units = panda[WhatIf].arm, units_of(panda)
    # Craig's table has the length before the joint in its row.
    assert [name_of(arm, 3, field, units) for field in ("a", "alpha", "d", "low", "high")] == [
        "a₃",
        "α₃",
        "d₄",
        "q₄ from",
        "q₄ to",
    ]
    assert name_of(arm, 7, "z", units) == "tool z"
    puma = opened("puma560", Set(Notation, "variable", "theta"))
    assert name_of(puma[WhatIf].arm, 1, "a", units_of(puma)) == "a₂"
    assert name_of(puma[WhatIf].arm, 1, "low", units_of(puma)) == "θ₂ from"


def test_changes_are_listed_in_the_units_on_screen():
    state = opened("puma560", Suppose(1, "a", 0.5), Suppose(1, "high", 1.0))
    words = plain(joined(changes_markup(BareForm(), state[WhatIf], units_of(state))))
    assert words == "Proposed changes a₂ 431.8 mm → 500.0 mm × q₂ to 225.0° → 57.3° ×"
    state = apply(apply(state, Set(Notation, "length", "m")), Set(Notation, "angle", "rad"))
    words = plain(joined(changes_markup(BareForm(), state[WhatIf], units_of(state))))
    assert words == "Proposed changes a₂ 0.4318 m → 0.5000 m × q₂ to 3.927 rad → 1.000 rad ×"


def test_the_verdict_says_how_much_larger_or_that_it_cannot_be_told():
    larger = known("planar_2r", Suppose(1, "a", 1.2))
    exact = 3.141592653589793 * 4 * 1.2
    words = plain(joined(verdict_markup(larger)))
    assert words.startswith("▲ The area is larger, +20.0 % +2.51")
    size = larger[WhatIf].found.figures[1].size
    assert abs(size.value - exact) <= size.error
    smaller = known("planar_2r", Suppose(1, "a", 0.8))
    assert plain(joined(verdict_markup(smaller))).startswith("▼ The area is smaller, −20.0 %")
    same = known("planar_2r", Suppose(0, "a", 1.000001))
    assert plain(joined(verdict_markup(same))).startswith(
        "≈ The same area The difference is within the uncertainty, ±0.00"
    )
    assert joined(verdict_markup(known("planar_2r"))) == ""
    bent = known("planar_3r", Suppose(0, "alpha", 0.5))
    assert plain(joined(verdict_markup(bent))) == "The area becomes a volume m² and m³ cannot be compared."
    figures = plain(joined(figures_markup(bent[WhatIf].found, units_of(bent))))
    assert re.search(r"Size 28\.27\d+ ± 0\.0\d+ m² \d+\.\d+ ± 0\.\d+ m³", figures)
    # Until the numbers are those of the present change, none is told.
    ahead = apply(larger, Suppose(1, "a", 1.3))
    assert plain(joined(verdict_markup(ahead))) == "… The boundary is being followed."


def test_no_surface_is_called_a_volume():
    surface = "he tool point moves on a line or a surface; compare how far it comes."
    bent = known("planar_2r", Suppose(0, "alpha", 0.5))
    assert plain(joined(verdict_markup(bent))) == f"No volume T{surface}"
    part = bent[WhatIf]
    straightened = replace(part.found, figures=part.found.figures[::-1])
    there = bent.replace(replace(part, found=straightened))
    assert plain(joined(verdict_markup(there))) == f"No volume before As it is, t{surface}"


def test_before_the_boundary_is_known_a_large_difference_is_told_roughly():
    state = known("planar_2r", Suppose(1, "a", 1.2))
    part = state[WhatIf]

    def said(found):
        return plain(joined(verdict_markup(state.replace(replace(part, found=found)))))

    rough = replace(part.found, figures=tuple(replace(each, refined=False) for each in part.found.figures))
    assert said(rough) == "▲ Larger, about +20 % The boundary is being followed."
    close = replace(rough, figures=(rough.figures[1], rough.figures[1]))
    assert said(close) == "≈ … The boundary is being followed."
    line = known("planar_2r", Suppose(1, "a", 0.0))
    nothing = replace(line[WhatIf].found, figures=(line[WhatIf].found.figures[1],) * 2)
    assert nothing.figures[0].size.value == 0.0
    assert plain(joined(verdict_markup(line.replace(replace(line[WhatIf], found=nothing))))).startswith(
        "No area The tool point"
    )


def test_figures_stand_side_by_side_with_their_errors():
    state = known("planar_2r", Suppose(1, "a", 0.5))
    found, units = state[WhatIf].found, units_of(state)
    words = plain(joined(figures_markup(found, units)))
    assert "as it is proposed" in words
    assert re.search(r"Area, m² 12\.56\d+ ± 0\.0\d+ 6\.28\d+ ± 0\.0\d+", words)
    assert re.search(r"From axis 1 0\.\d … (2000\.\d|1999\.\d) (500|499)\.\d … (1500|1499)\.\d", words)
    assert "Along axis 1" not in words
    rough = replace(found, figures=tuple(replace(each, refined=False) for each in found.figures))
    assert "≈ 12.6 ≈ 6.3" in plain(joined(figures_markup(rough, units)))
    unknown = replace(found, figures=tuple(replace(each, size=None, refined=False) for each in found.figures))
    assert "Area, m² … …" in plain(joined(figures_markup(unknown, units)))
    assert "of samples so far" in plain(joined(figures_markup(unknown, units)))


@pytest.mark.parametrize(
    ("alpha", "names"), [(0.0, ("x₀", "y₀")), (math.pi / 2, ("x₀", "z₀")), (0.5, ("x₀", "(0.00, 0.88, 0.48)"))]
)
def test_the_directions_across_a_sliding_joint_1_are_named(alpha, names):
    turn = math.pi / 2
    rows = (Row("P", alpha=alpha), Row("P", alpha=turn, theta=turn), Row("P", alpha=turn))
    arm = replace(catalogue()["cartesian_3p"].arm, convention="modified", rows=rows)
    assert across(first_joint(arm)) == names


def test_the_figures_of_a_box_have_a_row_for_each_direction_across_joint_1():
    state = known("cartesian_3p")
    words = plain(joined(figures_markup(state[WhatIf].found, units_of(state))))
    assert re.search(r"Along x₀ \S+ … \S+ Along y₀ \S+ … \S+$", words)
    assert "Reach" not in words
    turning = known("elbow_3r")
    assert re.search(r"Reach 1900\.0$", plain(joined(figures_markup(turning[WhatIf].found, units_of(turning)))))


def test_the_legend_names_the_colours_that_are_there():
    state = known("planar_2r", Suppose(1, "a", 0.5))
    found = state[WhatIf].found
    assert "lost" in joined(legend_markup(found))
    assert "the arm as proposed" in joined(legend_markup(found))
    early = joined(legend_markup(replace(found, lost=None, gained=None)))
    assert "as proposed" in early
    assert "lost" not in early
    line = joined(legend_markup(known("planar_2r", Suppose(0, "a", 0.0), Suppose(1, "a", 0.0))[WhatIf].found))
    assert "lost" in line, "an area that shrinks to a point is lost"
    alone = joined(legend_markup(known("planar_2r")[WhatIf].found))
    assert plain(alone) == "as it is"


def test_sections_are_drawn_one_over_the_other_of_arms_in_space():
    state = known("elbow_3r", Suppose(1, "a", 0.5))
    found, units = state[WhatIf].found, units_of(state)
    drawn = joined(picture(found, units))
    assert re.findall(r'class="(was|then)"', drawn) == ["was", "then"]
    (was,) = re.findall(r'd="([^"]+)" fill="none" class="was"', drawn)
    points = np.array(re.findall(r"[ML]([\d.]+) ([\d.]+)", was), dtype=float)
    # As wide and as high as the numbers of both axes say, which have one scale: the elbow reaches 1.3 m from (0, 0.6).
    zero, one = (float(re.search(rf'x="([\d.]+)" y="[\d.]+" text-anchor="middle">{x}<', drawn)[1]) for x in (0, 1000))
    assert points.min(axis=0)[0] == pytest.approx(zero, abs=0.5)
    assert np.ptp(points, axis=0) == pytest.approx([1.3 * (one - zero), 2.6 * (one - zero)], abs=1.0)
    assert [name in drawn for name in (">ρ, mm<", ">z, mm<")] == [True, True]
    assert points.max() <= 320.0
    assert re.findall(r'class="(was|then)"', joined(picture(known("elbow_3r")[WhatIf].found, units))) == ["was"]
    assert joined(picture(replace(found, sections=None), units)) == ""
    assert joined(picture(known("planar_2r")[WhatIf].found, units)) == ""


def test_what_is_drawn_belongs_in_the_picture():
    assert len(PANEL.around(opened("planar_2r"))) == 0
    points = PANEL.around(known("planar_2r", Suppose(1, "a", 2.0)))
    assert points[:, 0].max() == pytest.approx(3.0, abs=0.05)
    assert points[:, 0].min() == pytest.approx(-3.0, abs=0.05)


def test_a_student_changes_a_number_sees_what_it_does_and_takes_it_over(url):
    async def story():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("what_if")
        await browser.until(lambda: "Area, m²" in browser.html())
        assert "now 1000.0 mm" in browser.html()
        await browser.press("value", "1200")
        await browser.until(lambda: "The area is larger, +20.0 %" in plain(browser.html()))
        clouds = [name for name in browser.nodes if "/what_if/" in name]
        assert any(name.endswith("/gained") for name in clouds) or browser.counts["PointCloudMessage"] > 0
        await browser.press("value", "far")
        await browser.until(lambda: "expected a number in mm, got &#39;far&#39;" in browser.html())
        # Directly below the field, and no longer than what was typed is about the number at hand.
        assert re.search(r"now 1000\.0 mm</span></div></div><p class=\"no\" role=\"alert\">✕ a₁", browser.html())
        await browser.press("field alpha")
        await browser.until(lambda: "α₁, link twist" in browser.html())
        assert "expected a number" not in browser.html()
        await browser.press("field a")
        await browser.press("take")
        await browser.until(lambda: "now 1200.0 mm" in browser.html())
        assert "Proposed changes" not in browser.html()
        await browser.close()

    run(story())
