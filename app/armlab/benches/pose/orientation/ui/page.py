"""A rotation written as matrix, axis and angle, quaternion, and in three angles of any sequence."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.benches.pose.tool.state import PoseView, pair_of
from armlab.benches.pose.tool.ui.chooser import Chooser
from armlab.benches.pose.tool.ui.notation import AXES, in_words
from armlab.benches.pose.tool.ui.words import vector
from armlab.kin.euler import NAMES, SEQUENCES, EulerSolutions, angle_symbols, euler_angles, product_latex
from armlab.kin.rotations import axis_angle, quaternion_from_rotation, rotation_from_sequence
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.state import Post, State
from armlab.ui.factors import turns
from armlab.ui.format import MINUS, capitalised, mathml, pairs
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import verdict_box
from armlab.ui.matrices import MatrixView
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

LETTERS = {r"\varphi": "φ", r"\theta": "θ", r"\psi": "ψ"}

NEAR = 1e-6
"""Angle, radians, up to which a rotation is called no turn, or half a turn."""

CHECKED = 1e-9
"""Residual of a product of rotations above which it is shown; rounding is a million times smaller."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choices of a transform and of a sequence, and the read-outs."""
    units, view = units_of(state), state[PoseView]
    chooser = Chooser(gui, post)
    matrix = MatrixView(gui, post)
    turn = gui.html()
    gui.heading("Three angles")
    sequence = gui.dropdown(
        "Sequence",
        {axes: axes for axes in SEQUENCES},
        view.axes,
        lambda axes: post(Set(PoseView, "axes", axes)),
        "The axes of the three rotations, in order. The first six are Tait–Bryan angles, the others proper Euler "
        "angles.",
    )
    about = gui.segments(
        "Rotations about",
        {"moving": "Current axes", "fixed": "Fixed axes"},
        "fixed" if view.fixed else "moving",
        lambda key: post(Set(PoseView, "fixed", key == "fixed")),
        "Current axes have been rotated by the rotations before; fixed axes are those of the reference frame",
    )
    angles = gui.html()

    def show(state: State) -> None:
        view, R = state[PoseView], state.derived(pair_of).transform[:3, :3]
        chooser.show(state)
        title = "Rotation R ", tag("small", in_words(view.reference, view.frame))
        matrix.show(state, title, R, 3, None, AXES)
        turn.show(_one_turn(R, units))
        sequence.show(view.axes)
        about.show("fixed" if view.fixed else "moving")
        angles.show(_three_turns(R, view, units))

    return show


def _one_turn(R: NDArray[np.floating], units: Units) -> Inside:
    axis, angle = axis_angle(R)
    theta = float(angle)
    if theta < NEAR:
        turn: Inside = tag("p.said", "No rotation: θ = 0, and r may be any unit vector.")
    else:
        half = math.pi - theta < NEAR
        both = [
            ("r, θ", f"{vector(axis.tolist())}\u2002{units.angle(theta)}"),
            (f"{MINUS}r, {'' if half else MINUS}θ", _opposite(axis, theta if half else -theta, units)),
        ]
        turn = pairs(both), tag("p.dim", "Half a turn: r and −r give the same rotation.") if half else None
    q = quaternion_from_rotation(R)
    quaternions = pairs([("q = (w, x, y, z)", vector(q.tolist())), (f"{MINUS}q", vector((-q).tolist()))])
    return tag("h3", "Axis r, angle θ"), turn, tag("h3", "Quaternion, scalar first"), quaternions


def _opposite(axis: NDArray[np.floating], angle: float, units: Units) -> str:
    return f"{vector((-axis).tolist())}\u2002{units.orientation(angle)}"


def _three_turns(R: NDArray[np.floating], view: PoseView, units: Units) -> Inside:
    found = euler_angles(R, view.axes, fixed=view.fixed)
    letters = [LETTERS[letter] for letter in angle_symbols(view.axes, view.fixed)]
    name = NAMES.get((view.axes, view.fixed), "")
    kind = tag("p.dim.said", f"{capitalised(name)}.") if name else None
    product = mathml("R=" + product_latex(view.axes, view.fixed))
    if bool(found.singular):
        return kind, tag("div.eq.small", product), _singular(found, letters, view, units)
    heads = [
        tag("th", f"{letter} ", tag("small", "about ", tag(f"b.axis-{axis}", axis)))
        for letter, axis in zip(letters, view.axes, strict=True)
    ]
    texts = [[units.orientation(float(value)) for value in triple] for triple in found.solutions]
    rows = [tag("tr", tag("th", str(k + 1)), [tag("td", text) for text in triple]) for k, triple in enumerate(texts)]
    numbers = [tag("div", "= ", turns(view.axes, view.fixed, triple)) for triple in texts]
    table = tag("table.angles", tag("tr", tag("th"), heads), rows)
    return kind, table, tag("div.eq.small", product, numbers), _residual(R, found, view)


def _singular(found: EulerSolutions, letters: list[str], view: PoseView, units: Units) -> Inside:
    first, middle, third = (float(value) for value in found.solutions[0])
    plus = int(found.combination) > 0
    defined = f"{letters[0]} {'+' if plus else MINUS} {letters[2]}"
    value = first + third if plus else first - third
    written = turns(view.axes, view.fixed, [units.orientation(angle) for angle in (first, middle, third)])
    said = (
        f"{letters[1]} = {units.orientation(middle)} makes the first and the third axis coincide. "
        f"{defined} = {units.orientation(value)}; here {letters[2]} is set to 0."
    )
    head = f"Singular: only {defined} is defined"
    return verdict_box("warn", head, said), tag("div.eq.small", "R = ", written)


def _residual(R: NDArray[np.floating], found: EulerSolutions, view: PoseView) -> Markup:
    products = rotation_from_sequence(view.axes, found.solutions, fixed=view.fixed)
    residual = float(np.abs(products - R).max())
    if residual <= CHECKED:
        return tag("p.dim", "Both triples of angles give R.")
    return tag("p.dim", f"The products differ from R by {residual:.0e}.")


PANEL = Panel((Joints, PoseView), build, see_through=True)
