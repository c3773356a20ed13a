"""The page of formulas: its legend is true, and no arm makes it too long."""

import math
import re
from contextlib import contextmanager

import numpy as np
import pytest

from armlab.benches.pose.formulas.ui import page as formulas_page
from armlab.benches.pose.tool.ui.formulas import offset_lines, short_forms, written
from armlab.content.robots import catalogue, own_robot
from armlab.kin.arm import Arm
from armlab.kin.symbolic import constants, pose_formulas
from armlab.kin.transforms import inverse
from armlab.session.parts.notation import Notation
from armlab.session.state import State
from armlab.ui.html import joined
from armlab.ui.units import Units

START = State.initial(catalogue()["puma560"])


class FakePage:
    """What a page writes into."""

    def __init__(self):
        self.shown = []

    def html(self, *inside):
        self.show(*inside)
        return self

    def show(self, *inside):
        self.shown.append(joined(inside))

    def heading(self, *inside):
        self.show(*inside)

    @contextmanager
    def fold(self, title):
        self.show(title)
        yield


SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉−ϑ", "0123456789-θ")


def meaning(arm, units, q):
    """Return the angles of the joints as the legend says, each under the letters it has."""
    names = {f"{letter}{i + 1}": q[i] for i in range(arm.n) for letter in "qθ"}
    for line in offset_lines(arm, units):
        words = line.translate(SUBSCRIPTS).replace("°", " °").split()
        left, _, first, sign, number, unit = words
        offset = float(number) * units.factor(True)
        names[left] = names[first] + (offset if sign == "+" else -offset)
        assert unit == units.angle_unit
    return names


@pytest.mark.parametrize("notation", [Notation(), Notation(variable="theta", angle="rad"), Notation(book="siciliano")])
@pytest.mark.parametrize(
    "arm",
    [
        catalogue()["openmanipulator_x"].arm,
        Arm.from_dh([("R", 1, 0, 0, 0.3), ("R", 1, 0, 0, 0.4)]),
        Arm.from_dh([("R", 1, 0, 0, -math.pi / 2), ("R", 1, 0, 0, -0.4), ("R", 0.5, 0, 0, 0)]),
    ],
)
def test_the_legend_is_true_where_angles_have_offsets(arm, notation, rng):
    """What the page says c_12 is gives, put into the formula, the position."""
    units = Units(notation)
    q = rng.uniform(-1.0, 1.0, arm.n)
    names = meaning(arm, units, q)
    latex = pose_formulas(arm, "latex")
    formulas = {name: written(arm, units, text).latex for name, text in latex.items()}
    short = {form for text in formulas.values() for form in re.findall(r"\b[cs]_(?:\d|\{\d+\})", text)}
    values = {}
    for form in short:
        (line,) = short_forms(arm, units, [form])
        function, angles = re.fullmatch(r"[cs]\d+ = (cos|sin)[ (](.*?)\)?", line.translate(SUBSCRIPTS)).groups()
        values[form] = getattr(math, function)(sum(names[angle] for angle in angles.split(" + ")))
    known = {f"{name[0]}_{name[1:]}": value for name, value in constants(arm).items() if name[0] in "ad"}
    T = inverse(arm.base) @ arm.fk(q)
    for k, axis in enumerate("xyz"):
        text = formulas[f"p{axis}"]
        for form, value in sorted((values | known).items(), key=lambda item: -len(item[0])):
            text = text.replace(form, f"({value!r})")
        assert eval(text.replace(" (", "*(").replace("+*", "+ ").replace("-*", "- ")) == pytest.approx(
            T[k, 3], abs=1e-5
        )


def test_a_formula_nobody_can_read_is_counted_and_not_written():
    """Twelve general twists: 19 million characters; and the texts to copy are bounded."""
    for n in range(2, 13):
        arm = Arm.from_dh([("R", 0.1, 0.6, 0.1, 0.0)] * n)
        page = FakePage()
        formulas_page.PANEL.build(page, START.with_robot(own_robot(arm, "general", None)), lambda command: None)
        assert len("".join(page.shown)) < 150_000
        assert all(len(text) < 30_000 for text in re.findall(r'data-copy="([^"]*)"', "".join(page.shown)))
    text = "".join(page.shown)
    assert text.count("too long to read: about ") == 12
    assert "data-copy" not in text
    assert "12 of 12 formulas have over 100 terms and are not written." in text


@pytest.mark.parametrize("length", ["mm", "m"])
def test_the_unit_of_numbers_in_formulas_is_said_before_them(length):
    def page_of(key):
        page, state = FakePage(), State.initial(catalogue()[key])
        state = state.replace(Notation(length=length))
        formulas_page.PANEL.build(page, state, lambda command: None)
        return page.shown

    told = "Numbers in the formulas of p are lengths in m"
    assert told in page_of("puma560")[0]
    assert not any(told in text for text in page_of("planar_2r"))


@pytest.mark.parametrize(
    ("length", "says"),
    [
        (2.0, "whatever units are chosen under View.</p>"),
        (1.0, "whatever units are chosen under View. A length of 1 m is not written as a factor.</p>"),
    ],
)
def test_whole_numbers_of_metres_are_told_to_be_lengths(length, says):
    tool = np.eye(4)
    tool[0, 3] = length
    arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 2, tool=tool)
    page = FakePage()
    formulas_page.PANEL.build(page, START.with_robot(own_robot(arm, "whole")), lambda command: None)
    assert f"Numbers in the formulas of p are lengths in m, {says}" in page.shown[0]
