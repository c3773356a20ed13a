"""A rotation written as matrix, axis and angle, quaternion, and in three angles of any sequence."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.benches.pose.tool.state import PoseView, pair_of
from armlab.benches.pose.tool.ui.chooser import Chooser
from armlab.benches.pose.tool.ui.notation import in_words
from armlab.benches.pose.tool.ui.words import vector
from armlab.kin.euler import NAMES, SEQUENCES, EulerSolutions, angle_symbols, euler_angles, product_latex
from armlab.kin.rotations import axis_angle, quaternion_from_rotation, rotation_from_sequence
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.state import Post, State
from armlab.ui.factors import turns
from armlab.ui.format import MINUS, mathml, pairs
from armlab.ui.matrices import MatrixView
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

LETTERS = {r"\varphi": "φ", r"\theta": "θ", r"\psi": "ψ"}
COLUMNS = tuple(f'<b class="axis-{axis}">{axis}</b>' for axis in "xyz")

NEAR = 1e-6
"""Radians from no turn, or from half a turn, within which a rotation is called so."""

CHECKED = 1e-9
"""Residual of a product of turns above which it is shown: rounding stays a million times below."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the choice of a transform and of a sequence, and the read-outs."""
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
        "The axes of the three turns, in order. The first six are Tait–Bryan, the others proper Euler angles.",
    )
    about = gui.segments(
        "About axes that",
        {"moving": "Move", "fixed": "Stay"},
        "fixed" if view.fixed else "moving",
        lambda key: post(Set(PoseView, "fixed", key == "fixed")),
        "Axes that move are turned along by the turns before; axes that stay are those of the reference frame",
    )
    angles = gui.html()

    def show(state: State) -> None:
        view, R = state[PoseView], state.derived(pair_of).transform[:3, :3]
        chooser.show(state)
        matrix.show(state, f"Rotation R <small>{in_words(view.reference, view.frame)}</small>", R, 3, None, COLUMNS)
        turn.show(_one_turn(R, units))
        sequence.show(view.axes)
        about.show("fixed" if view.fixed else "moving")
        angles.show(_three_turns(R, view, units))

    return show


def _one_turn(R: NDArray[np.floating], units: Units) -> str:
    axis, angle = axis_angle(R)
    theta = float(angle)
    if theta < NEAR:
        turn = '<p class="said">No turn: θ = 0, and every axis is right.</p>'
    else:
        half = math.pi - theta < NEAR
        turn = pairs(
            [
                ("r, θ", f"{vector(axis.tolist())}&ensp;{units.angle(theta)}"),
                (f"{MINUS}r, {'' if half else MINUS}θ", _opposite(axis, theta if half else -theta, units)),
            ]
        )
        turn += '<p class="dim">Half a turn: both axes are right.</p>' if half else ""
    q = quaternion_from_rotation(R)
    quaternions = pairs([("q = (w, x, y, z)", vector(q.tolist())), (f"{MINUS}q", vector((-q).tolist()))])
    return f"<h3>Axis r, angle θ</h3>{turn}<h3>Quaternion, scalar first</h3>{quaternions}"


def _opposite(axis: NDArray[np.floating], angle: float, units: Units) -> str:
    return f"{vector((-axis).tolist())}&ensp;{units.orientation(angle)}"


def _three_turns(R: NDArray[np.floating], view: PoseView, units: Units) -> str:
    found = euler_angles(R, view.axes, fixed=view.fixed)
    letters = [LETTERS[letter] for letter in angle_symbols(view.axes, view.fixed)]
    name = NAMES.get((view.axes, view.fixed), "")
    kind = f'<p class="dim said">{name[:1].upper()}{name[1:]}.</p>' if name else ""
    product = f'<div class="eq small">{mathml("R=" + product_latex(view.axes, view.fixed))}'
    if bool(found.singular):
        return kind + product + "</div>" + _singular(found, letters, view, units)
    heads = "".join(
        f'<th>{letter} <small>about <b class="axis-{axis}">{axis}</b></small></th>'
        for letter, axis in zip(letters, view.axes, strict=True)
    )
    texts = [[units.orientation(float(value)) for value in triple] for triple in found.solutions]
    rows = "".join(
        f"<tr><th>{k + 1}</th>{''.join(f'<td>{text}</td>' for text in triple)}</tr>" for k, triple in enumerate(texts)
    )
    numbers = "".join(f"<div>= {turns(view.axes, view.fixed, triple)}</div>" for triple in texts)
    table = f'<table class="angles"><tr><th></th>{heads}</tr>{rows}</table>'
    return f"{kind}{table}{product}{numbers}</div>{_residual(R, found, view)}"


def _singular(found: EulerSolutions, letters: list[str], view: PoseView, units: Units) -> str:
    first, middle, third = (float(value) for value in found.solutions[0])
    plus = int(found.combination) > 0
    defined = f"{letters[0]} {'+' if plus else MINUS} {letters[2]}"
    value = first + third if plus else first - third
    written = turns(view.axes, view.fixed, [units.orientation(angle) for angle in (first, middle, third)])
    return (
        f'<div class="verdict warn"><b>◐ Singular: only {defined} is defined</b>'
        f"{letters[1]} = {units.orientation(middle)} lays the first and the third turn on one line. "
        f"{defined} = {units.orientation(value)}; here {letters[2]} is 0.</div>"
        f'<div class="eq small">R = {written}</div>'
    )


def _residual(R: NDArray[np.floating], found: EulerSolutions, view: PoseView) -> str:
    products = rotation_from_sequence(view.axes, found.solutions, fixed=view.fixed)
    residual = float(np.abs(products - R).max())
    if residual <= CHECKED:
        return '<p class="dim">Both triples give R.</p>'
    return f'<p class="dim">The products differ from R by {residual:.0e}.</p>'


PANEL = Panel((Joints, PoseView), build, see_through=True)
