"""The page of the five planning steps, as a browser gets it, and what it says."""

import csv
import io
import math
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.plan.commands import SetMove, SetMoveOption
from armlab.benches.motion.plan.examples import TakeExample
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.limits import SampleBy
from armlab.benches.motion.plan.points import SetWaypointPose
from armlab.benches.motion.plan.question import Feasible
from armlab.benches.motion.plan.ui.joint_marks import joint_dots
from armlab.benches.motion.steps.ui import words
from armlab.benches.motion.steps.ui.formulas import formula_of, says_of
from armlab.benches.motion.steps.ui.plots import JointPlot, StepPlot
from armlab.benches.motion.steps.worked import steps
from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.motion import path_types
from armlab.kin.rotations import rotation_about
from armlab.kin.transforms import transform
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from armlab.ui.format import mathml
from armlab.ui.units import Units, units_of
from support.arms import KINDS
from support.student import run, student

UNITS = Units(Notation())
COLOURS = ("rgb(1,2,3)", "rgb(4,5,6)")


def looked(key, *commands):
    state = State.initial(catalogue()[key])
    for command in commands:
        state = apply(state, command)
    return steps(with_planned(state))


def broken():
    arm = catalogue()["planar_2r_unequal"].arm
    ends = np.radians([[20.0, 120.0], [150.0, 120.0]])
    poses = (SetWaypointPose(k, arm.fk(q)) for k, q in enumerate(ends))
    return looked("planar_2r_unequal", *poses, SetMove(1, space="cartesian"))


def texts(markup):
    """Return what a person reads."""
    return re.sub(r"\s+", " ", re.sub(r"<[^>]*>", " ", markup)).replace("\N{NO-BREAK SPACE}", " ")


def everything(found, units=UNITS):
    return [
        words.knots(found, units),
        words.path(found, units),
        words.sampling(found, "", units),
        words.inverse(found, units),
        words.joints(found, units, COLOURS),
    ]


def test_each_kind_of_path_has_a_formula_and_a_sentence():
    for kind in path_types().values():
        for letter in "pq":
            latex = formula_of(Chosen(kind.key), letter)
            assert latex, kind.key
            assert "X" not in latex
            assert mathml(latex, True).startswith("<math")
        assert says_of(Chosen(kind.key), None).endswith((".", "length."))


@pytest.mark.parametrize(("shape", "name", "latex"), [(None, "parabola", "''"), ("quartic", "quartic", "^{(4)}")])
def test_blends_are_called_by_their_curve_and_pass_by_the_knots(shape, name, latex):
    chosen = Chosen.of(path_types(), "overfly", **({"shape": shape} if shape else {}))
    assert f"a {name} instead of each corner" in says_of(chosen, None)
    assert latex in formula_of(chosen, "p")
    found = looked("puma560", TakeExample("corner_fly"), SetMoveOption(1, "path", "shape", shape))
    said = texts(words.path(found, UNITS))
    assert "A curve past the knots with a parameter s" in said
    assert f"a {name} instead of each corner" in said


def test_poses_of_an_arm_whose_base_is_turned_stand_in_frame_0():
    """A planar arm on a wall turns about z of frame 0; in the world its yaw would be 0 throughout."""
    planar = catalogue()["planar_3r"]
    base = transform(rotation_about("x", np.pi / 2))
    wall = Arm.from_dh(planar.arm.rows, base=base, limits=planar.arm.limits, task=planar.arm.task)
    state = State.initial(replace(planar, arm=wall))
    on_wall, on_floor = (steps(with_planned(each)) for each in (state, State.initial(planar)))
    said, flat = (texts(words.knots(found, UNITS)) for found in (on_wall, on_floor))
    assert "knot in frame 0 x mm y mm z mm φ °" in said
    assert said.replace("knot in frame 0", "knot") == flat
    phi = math.degrees(np.sum(on_wall.knot_q[0]))
    assert f"{phi:.1f}".replace("-", "−") in said


def test_the_numbers_of_the_steps_are_those_of_the_plan():
    found = looked("puma560", SetMove(1, space="cartesian"), SampleBy(4))
    knots, path, sampling, inverse, joints = (texts(each) for each in everything(found))
    x, y, z = (1e3 * found.knot_poses[1, :3, 3]).tolist()
    assert f"{x:.1f} {y:.1f} {z:.1f}".replace("-", "−") in knots
    assert " ".join(f"{q:.1f}" for q in np.degrees(found.knot_q[0])).replace("-", "−") in knots
    assert "point to point" in knots
    length = np.linalg.norm(found.knot_poses[1, :3, 3] - found.knot_poses[0, :3, 3])
    assert f"length of the path {1e3 * length:.1f} mm" in path
    assert "straight between" not in path
    assert f"angle of rotation {np.degrees(found.turn):.1f}°" in path
    assert f"largest distance between neighbours {1e3 * length / 3:.1f} mm" in sampling
    assert "Δs 0.3333" in sampling
    assert "✓ The whole path is followed" in inverse
    assert "solved 4 of 4 samples" in inverse
    assert found.branch in inverse
    k = found.apart.worst
    assert f"largest distance {1e3 * found.apart.distance[k]:.1f} mm at s = {found.apart.s[k]:.2f}" in joints
    assert f"drawn {found.larger:g} times as large" in joints
    assert f"takes {found.leg.motion.duration:.2f} s" in joints


def test_what_is_drawn_larger_or_exact_is_said_so():
    exact = texts(words.joints(looked("cartesian_3p", SetMove(1, space="cartesian")), UNITS, COLOURS))
    assert "largest distance 0 mm, apart from rounding" in exact
    assert "times as large" not in exact
    dense = texts(words.joints(looked("planar_2r", SetMove(1, space="cartesian")), UNITS, COLOURS))
    assert re.search(r"largest distance \d\.\d·10⁻. mm at s", dense)
    assert "times as large" not in dense


def test_a_joint_move_says_what_it_leaves_out():
    found = looked("panda")
    _, path, sampling, inverse, joints = (texts(each) for each in everything(found))
    assert "nothing is interpolated in space" in path
    assert "nothing to sample" in sampling
    assert "solved 2 times" in inverse
    assert f"largest distance {1e3 * found.apart.distance.max():.1f} mm" in joints
    heads = [texts(words.head_of(k, found)) for k in (1, 2, 3, 4, 5)]
    assert ["left out" in head for head in heads] == [False, True, True, False, False]


def test_joints_that_go_each_by_itself_share_no_path():
    found, together = looked("scara", SetMove(1, apart=True)), looked("scara")
    knots, *_, joints = (texts(each) for each in everything(found))
    assert "joints independent: each with its own law" in knots
    assert "joints coordinated: all share" in texts(words.knots(together, UNITS))
    motion = found.leg.motion
    way = found.arm.position(motion.at(np.linspace(0.0, motion.duration, 4001)))
    length = np.linalg.norm(np.diff(way, axis=0), axis=1).sum()
    assert found.tool_length == pytest.approx(length, rel=1e-6)
    assert abs(length - together.tool_length) > 1e-3 * length
    assert f"path of the tool {1e3 * length:.1f} mm" in joints
    np.testing.assert_allclose(found.apart.q, motion.at(found.apart.s * motion.duration), rtol=0, atol=1e-12)
    assert "s = t/T is the share of the time" in joints
    assert f"With the timing law of each joint the motion takes {motion.duration:.2f} s." in joints
    assert "q(s(t))" not in joints
    assert "Each coordinate changes in proportion" not in joints


def test_the_tool_of_prismatic_joints_is_not_said_to_leave_the_straight_line():
    slides = looked("cartesian_3p")
    assert slides.apart.distance.max() < 1e-9
    said = [texts(words.joints(found, UNITS, COLOURS)) for found in (slides, looked("scara"))]
    assert ["the tool does not move along a straight line" in each for each in said] == [False, True]
    assert ["All joints are prismatic" in each for each in said] == [True, False]


def test_one_of_a_kind_is_named_in_the_singular():
    two = texts(words.joints(looked("planar_2r", SetMove(1, space="cartesian"), SampleBy(2)), UNITS, COLOURS))
    assert "A cubic from the first solution to the second is q(s). Only at" in two
    three = texts(words.joints(looked("planar_2r", SetMove(1, space="cartesian"), SampleBy(3)), UNITS, COLOURS))
    assert "through the 3 solutions is q(s): 2 pieces, equal" in three
    found = broken()
    for near, told in ((1, "1 sample, where"), (2, "2 samples, where")):
        worth = np.full(len(found.samples), Feasible.YES)
        worth[:near] = Feasible.NEAR_SINGULAR
        found.__dict__["worth"] = worth
        assert told in texts(words.inverse(found, UNITS))
    stop = found.followed.stops[0]
    for more, told in ((1, "and 1 more place."), (2, "and 2 more places.")):
        followed = replace(found.followed, stops=(stop,) * (words.STOPS + more))
        assert told in texts(words.inverse(replace(found, leg=replace(found.leg, followed=followed)), UNITS))


def test_a_knot_that_is_reached_in_another_way_than_it_was_stored_is_told():
    arms = {
        key: texts(words.inverse(looked(key, SetMove(1, space="cartesian")), UNITS)) for key in ("panda", "puma560")
    }
    assert "Waypoint 2 is reached on the branch on which the move began" in arms["panda"]
    assert "not in its stored configuration" not in arms["puma560"]


def test_a_path_that_cannot_be_followed_says_where_and_why():
    found = broken()
    *_, inverse, joints = (texts(each) for each in everything(found))
    assert f"✕ {found.followed.stops[0].sentence}" in inverse
    assert f"solved {found.followed.reached.sum()} of 201 samples" in inverse
    assert "not form one motion" in inverse
    assert "There is no motion of the joints." in joints
    assert "out of reach" in joints


@pytest.mark.parametrize("key", KINDS)
def test_every_arm_has_words_for_every_step(key):
    state = State.initial(catalogue()[key])
    for space in ("joint", "cartesian"):
        state = apply(state, SetMove(1, space=space))
        state = apply(state, Set(Notation, "length", "m"))
        found = steps(with_planned(state))
        for markup in everything(found, units_of(state)):
            assert "nan" not in markup
            assert "None" not in markup
            assert " mm" not in texts(markup)
            assert "-" not in re.sub(r"<[^>]*>", "", markup).replace("point-to", "").replace("-coast-", "").replace(
                "bang-bang", ""
            ).replace("multi-", "")


def test_the_table_of_a_plot_has_the_values_once():
    """The dots that mark samples are no columns of their own."""
    found = looked("scara", SetMove(1, space="cartesian"), SampleBy(4))

    class Bare(JointPlot):
        def __init__(self):
            self._x, self._which, self._table = "s", np.array([0, 1, 3]), ()
            self._names, self._unit, self._factor = {0: "q₁", 1: "q₂", 3: "q₄"}, "°", 1.0

        def show_over(self, s, curves):
            self._table = (s, *curves)

    plot = Bare()
    plot.show_path(found.apart.s, found.apart.q, found.followed.s)
    assert len(plot._curves) == len(plot._table) - 1 == 6
    marked = np.isfinite(plot._table[4])
    np.testing.assert_allclose(found.apart.s[marked], found.followed.s)
    np.testing.assert_allclose(plot._table[4][marked], plot._table[1][marked])
    rows = list(csv.reader(io.StringIO(plot.csv())))
    assert rows[0] == ["s", "q₁, °", "q₂, °", "q₄, °"]
    np.testing.assert_allclose(np.array(rows[1:], dtype=float)[:, 1], found.apart.q[:, 0])
    plot.show_samples(found.followed.s, found.followed.q)
    assert len(list(csv.reader(io.StringIO(plot.csv())))) == 1 + 4


def test_values_of_many_joints_stand_in_blocks():
    def blocks(key):
        found = looked(key)
        tables = re.findall(r"<table.*?</table>", words.joint_table("knot", ["1", "2"], found.knot_q, found, UNITS))
        return [texts(table).split() for table in tables]

    assert [row.count("°") for row in blocks("panda")] == [7]
    first, second = blocks("trunk9")
    assert (first.count("°"), second.count("°")) == (4, 5)
    q = [f"{each:.1f}".replace("-", "−") for each in np.degrees(looked("trunk9").knot_q[0])]
    row = first.index("1")
    assert first[row + 1 : row + 5] == q[:4]
    row = second.index("1")
    assert second[row + 1 : row + 6] == q[4:]


class Painted(StepPlot):
    """A plot without a page."""

    def __init__(self):
        self._zero, self._handle = True, SimpleNamespace(scales={})

    def show(self, s, curves):
        self.drawn = curves


def test_a_distance_of_nothing_but_rounding_is_drawn_as_zero():
    s, plot = np.linspace(0.0, 1.0, 11), Painted()
    plot.show_over(s, [1e-8 * s], 1e-3)
    assert plot._handle.scales["y"]["range"] == (0.0, 0.5)
    plot.show_over(s, [2e-3 * s], 1e-3)
    assert plot._handle.scales["y"]["range"] == pytest.approx((0.0, 2.16e-3))


def test_samples_of_joints_of_one_colour_are_dots_and_rings():
    for i, clear in ((0, False), (7, True)):
        series = joint_dots(i, "q", 6.0).series
        assert series["width"] == 0
        assert (series["points"]["fill"] == "rgba(0,0,0,0)") == clear
        assert series["points"]["size"] == 6.0


def pressed(browser):
    """Return which step is pressed."""
    return re.findall(r'data-cell="(step \d)"[^>]*aria-pressed="true"', browser.html())


async def at_steps(url, robot, cartesian):
    browser = await student(url, path=f"/robot/{robot}")
    await browser.open("motion")
    if cartesian:
        await browser.press("space-cartesian")
    await browser.open("motion_steps")
    await browser.until(lambda: f"space</span><span>{'Cartesian' if cartesian else 'joint'}" in browser.html())
    return browser


class Scene:
    """What a browser has been told of the nodes of the steps."""

    def __init__(self, browser):
        self.texts, self.seen = set(), {}
        browser.on_message = self.note

    def note(self, message, _at):
        name = message.get("name", "")
        if "/motion_steps/" not in name:
            return
        if "props" in message:
            self.seen[name.rsplit("/", 1)[1]] = True
        if message["type"] == "SetSceneNodeVisibilityMessage":
            self.seen[name.rsplit("/", 1)[1]] = message["visible"]
        told = message.get("props") or message.get("updates") or {}
        self.texts |= {told["text"]} if "text" in told else set()

    def shown(self):
        """Return the names of nodes that are there and visible."""
        return {name for name, on in self.seen.items() if on}


def test_a_student_goes_through_the_steps_and_types_samples(url):
    async def main():
        browser = await at_steps(url, "planar_2r", True)
        scene = Scene(browser)
        assert pressed(browser) == ["step 1"]
        for k, said in {2: "Interpolation in task space", 3: "evenly spaced in s", 4: "solved</span><span>201"}.items():
            await browser.press(f"step {k}")
            await browser.until(lambda said=said: said in browser.html())
            assert pressed(browser) == [f"step {k}"]
        await browser.press("step 3")
        await browser.until(lambda: 'data-cell="samples"' in browser.html())
        for wrong in ("1", "2.5", "1002", "many", ""):
            await browser.press("samples", wrong)
            await browser.until(
                lambda wrong=wrong: f'value="{wrong}"' in browser.html() and "expected a" in browser.html()
            )
        await browser.press("samples", "4")
        await browser.until(lambda: "poses</span><span>4<" in browser.html())
        await browser.press("step 5")
        found = looked("planar_2r", SetMove(1, space="cartesian"), SampleBy(4))
        assert ": less than 0.001" not in texts(browser.html())
        most = 1e3 * found.apart.distance.max()
        far = f"{most:.1f} mm at s = {found.apart.s[found.apart.worst]:.2f}"
        await browser.until(lambda: far in texts(browser.html()))
        await browser.until(lambda: scene.shown() >= {"path", "arms", "result", "gap", "yes"})
        assert f"{most:.1f} mm apart, drawn × {found.larger:g}" in scene.texts
        await browser.press("step 3")
        await browser.until(lambda: 'data-cell="samples"' in browser.html())
        await browser.press("samples", "201")
        await browser.press("step 5")
        await browser.until(lambda: "Distance from the path, mm: less than 0.001" in texts(browser.html()))
        await browser.press("step 2")
        await browser.until(lambda: scene.shown() & {"samples", "arms", "result", "gap", "yes"} == set())
        assert "path" in scene.shown()
        await browser.close()

    run(main())


def test_a_joint_move_leaves_steps_out_and_draws_straight_lines(url):
    async def main():
        browser = await at_steps(url, "scara", False)
        scene = Scene(browser)
        assert len(re.findall('class="ms-skipped"', browser.html())) == 2
        for k in (2, 3):
            await browser.press(f"step {k}")
            await browser.until(lambda k=k: pressed(browser) == [f"step {k}"] and "left out" in browser.html())
        assert scene.shown() & {"path", "samples", "arms"} == set()
        await browser.press("step 5")
        await browser.until(lambda: scene.shown() >= {"path", "arms", "result", "gap"})
        found = looked("scara")
        assert f"{1e3 * found.apart.distance.max():.1f} mm apart" in scene.texts
        assert "Revolute joints, °" in browser.html()
        assert "Prismatic joints, mm" in browser.html()
        await browser.close()

    run(main())


def test_one_waypoint_makes_no_motion(url):
    async def main():
        browser = await at_steps(url, "planar_2r", False)
        await browser.open("motion")
        await browser.press("remove-1")
        await browser.open("motion_steps")
        await browser.until(lambda: "A motion needs two waypoints" in browser.html())
        await browser.close()

    run(main())
