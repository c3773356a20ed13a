"""The velocity ellipsoid in numbers, and the manipulability over the range of one joint."""

from __future__ import annotations

import asyncio

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ellipsoid import SingularPlaces
from armlab.session.parts.display import Display
from armlab.session.parts.display import Show as SetSwitch
from armlab.session.parts.ellipsoid import (
    DEFAULT_SPEED,
    LookAtBlock,
    Manipulability,
    PlacedEllipsoid,
    VelocityBlock,
    blocks_of,
    present,
)
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.sweep import CLIP_KEY, Course, Sweep, SweepJoint, course, curves, singularities
from armlab.session.parts.timeline import OpenClip, Timeline
from armlab.session.state import State
from armlab.ui import adapter
from armlab.ui.colours import BLUE, GREEN, PURPLE
from armlab.ui.format import mathml, number, pairs, subscript, trimmed
from armlab.ui.layers.ellipsoid import SWITCH, digits, speed
from armlab.ui.plot import Curve, Plot
from armlab.ui.plugin import Panel, Post, Show
from armlab.ui.units import Units, units_of
from armlab.ui.verdicts import SIGNS
from armlab.ui.widgets import Gui

Array = NDArray[np.float64]

NEAR = 0.1
"""Inverse condition below which the ellipsoid is called poorly conditioned."""

REST = 0.3
"""Seconds without a motion of the other joints after which the curves are drawn again."""

ALONG = 0.9995
"""Component of a unit vector above which it is called an axis of the world."""

TITLES = {"translation": "Translation", "rotation": "Rotation"}
HEIGHT = 104
SMALLEST, INVERSE = r"\sigma_{min}", r"\sigma_{min}/\sigma_1"
LETTERS = {"translation": "v", "rotation": r"\omega"}
POWERS = {1: "", 2: "²", 3: "³"}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the numbers of the ellipsoid and the sweep of a joint."""
    arm, units = state[Joints].arm, units_of(state)
    choice = None
    if len(blocks_of(arm)) > 1:
        choice = gui.segments(
            "Velocities of",
            {key: TITLES[key] for key in blocks_of(arm)},
            state[Manipulability].block.key,
            lambda key: post(LookAtBlock(key)),
            "Metres per second and radians per second are never in one ellipsoid",
        )
    axes, card, numbers = gui.html(), gui.html(), gui.html()
    keep = gui.checkbox(
        "Always shown",
        SWITCH.on(state),
        lambda on: post(SetSwitch(SWITCH.name, on)),
        "Leave the ellipsoid in the scene while other tabs are open (key M).",
    )
    sweep = _Sweeping(gui, state, post, units)

    def show(state: State) -> None:
        block, found = state[Manipulability].block, state.derived(present)
        if choice is not None:
            choice.show(block.key)
        axes.show(_axes(block, found))
        card.show(_card(block, found))
        numbers.show(_numbers(block, found, units))
        keep.show(SWITCH.on(state))
        sweep.show(state)

    return show


def _axes(block: VelocityBlock, found: PlacedEllipsoid) -> str:
    """Return the half axes with bars relative to the largest, and their directions."""
    largest = float(found.sigma[0]) or 1.0
    rows = []
    for i in range(block.m):
        value = float(found.sigma[i])
        rows.append(
            f"<span>{subscript('σ', i + 1)}</span><i>{_vector(found.axes[:, i])}</i><b>{speed(block, value)}</b>"
            f'<u style="--part:{100.0 * value / largest:.1f}%"></u>'
        )
    title = f"Half axes <small>and their directions in the world, {mathml('u_i')}</small>"
    return f'<h3>{title}</h3><div class="half" title="Singular values of J, notes 5.152">{"".join(rows)}</div>'


def _vector(u: Array) -> str:
    """Return a direction without a sense: its largest component is positive."""
    sense = 1.0 if u[int(np.argmax(np.abs(u)))] > 0.0 else -1.0
    return f"({', '.join(number(sense * float(value), 2) for value in u)})"


def _card(block: VelocityBlock, found: PlacedEllipsoid) -> str:
    kind, head, body = verdict_of(block, found)
    return f'<div class="verdict {kind}"><b>{SIGNS[kind]} {head}</b>{body}</div>'


def verdict_of(block: VelocityBlock, found: PlacedEllipsoid) -> tuple[str, str, str]:
    """Return ``ok``, ``warn`` or ``no``, what the ellipsoid says in a few words, and in a sentence."""
    along = "along" if block.key == "translation" else "about"
    shape = found.ellipsoid
    measured = shape.joint_directions.shape[1]
    least = found.axes[:, measured - 1]
    if found.lost and found.lost[0] >= measured:
        lost = " and ".join(_direction(found.axes[:, i]) for i in found.lost)
        return "warn", "Fewer joints than directions", f"In every configuration some are missing; here {along} {lost}."
    if found.lost:
        lost = " and ".join(_direction(found.axes[:, i]) for i in found.lost)
        nothing = "No joint speed moves the tool" if block.key == "translation" else "No joint speed turns the tool"
        return "no", "Singular", f"{nothing} {along} {lost}."
    slowest, ratio = (
        speed(block, shape.sigma_min),
        f"shortest : longest half axis = {number(shape.inverse_condition, 3)}",
    )
    if shape.inverse_condition < NEAR:
        return "warn", "Poorly conditioned", f"{ratio}. {along.capitalize()} {_direction(least)} only {slowest}."
    if block.m == 1:
        return "ok", "One direction", f"{along.capitalize()} {_direction(least)}: {slowest}."
    return "ok", "Well conditioned", f"{ratio}. {_every(block)}: at least {slowest}."


def _every(block: VelocityBlock) -> str:
    """Return what the shortest half axis is of: the directions that the task controls."""
    task = block.arm.task
    if block.m == 3:
        return "In every direction" if block.key == "translation" else "About every axis"
    if block.key == "rotation":
        return "About every axis across the tool's z"
    return f"In every direction the task controls ({', '.join(task.position)})"


def _direction(u: Array) -> str:
    """Return a direction in words; its sense does not matter."""
    k = int(np.argmax(np.abs(u)))
    return f"{'xyz'[k]} of the world" if abs(float(u[k])) > ALONG else _vector(u)


def _numbers(block: VelocityBlock, found: PlacedEllipsoid, units: Units) -> str:
    shape = found.ellipsoid
    k = shape.joint_directions.shape[1]
    unit = volume_unit(block, k)
    rows = [
        (name_of_w(block), f"{number(shape.w, digits(block.typical**k) + 1)} {unit}"),
        (f"smallest {mathml(SMALLEST)}", speed(block, shape.sigma_min)),
        ("inverse condition", number(shape.inverse_condition, 3)),
        ("condition", number(shape.condition, 2) if shape.condition < 1e4 else "∞" if found.lost else "over 10⁴"),
    ]
    return (
        pairs(rows)
        + '<div class="eq small" title="Notes 5.142-5.144: the ellipsoid of joint speeds of length 1">'
        + f"{mathml(volume(block))}</div>"
        + f'<p class="dim">{scaling_words(block, units)} Drawn: 1 {block.unit} is {trimmed(block.drawn, 6)} m.</p>'
    )


def name_of_w(block: VelocityBlock) -> str:
    """Return what w is of."""
    scaled = "" if block.speeds is None else ", scaled by limits"
    return f"{mathml('w')} of {block.key}{scaled}"


def volume(block: VelocityBlock) -> str:
    """Return the formula by which w is computed, in LaTeX: scaled and transposed as it is."""
    J = rf"J_{{{LETTERS[block.key]}}}"
    n, joints = block.arm.n, ""
    if block.speeds is not None:
        J, joints = r"\bar{J}", rf",\;\bar{{J}}={J}\,\mathrm{{diag}}(\dot{{q}}_{{max}})"
    product = rf"{J}\,{J}^T" if block.m <= n else rf"{J}^T{J}"
    axes = r"\,".join(rf"\sigma_{i + 1}" for i in range(min(block.m, n)))
    return rf"w=\sqrt{{\det({product})}}={axes}{joints}"


def volume_unit(block: VelocityBlock, k: int) -> str:
    """Return the unit of the product of k half axes; of unscaled joints they are m/s for each rad/s or m/s."""
    if block.speeds is None:
        return f"m{POWERS[k]}" if block.key == "translation" and block.arm.revolute.all() else ""
    length = "m" if block.key == "translation" else "rad"
    return f"{length}{POWERS[k]}/s{POWERS[k]}"


def scaling_words(block: VelocityBlock, units: Units) -> str:
    """Return which joint speeds count as 1."""
    arm = block.arm
    if block.speeds is None:
        return f"For joint speeds with √(Σ q̇ᵢ²) ≤ 1 {'rad/s' if arm.revolute.all() else 'm/s'}."
    speeds = [
        f"{units.variable(i, bool(arm.revolute[i]))} {_limit(arm, i, float(speed), units)}"
        for i, speed in enumerate(block.speeds)
    ]
    said = f"Joints slide and turn: each speed is in parts of its limit, √(Σ …²) ≤ 1: {', '.join(speeds)}."
    known = bool(np.isfinite(arm.speed_limits).all())
    return said if known else f"{said} * No limit is known, {DEFAULT_SPEED:g} is taken."


def _limit(arm: Arm, i: int, value: float, units: Units) -> str:
    mark = "" if np.isfinite(arm.speed_limits[i]) else " *"
    if not arm.revolute[i]:
        return f"{trimmed(value, 3)} m/s{mark}"
    return f"{trimmed(value / units.factor(True), 2)} {units.angle_unit}/s{mark}"


class _Sweeping:
    """The choice of a joint, the button, and the plots over its range."""

    def __init__(self, gui: Gui, state: State, post: Post, units: Units) -> None:
        arm = state[Joints].arm
        self._units = units
        gui.heading("Over the range of one joint")
        self._joint = gui.dropdown(
            "Joint",
            {str(i): f"{units.variable(i, bool(arm.revolute[i]))}, joint {i + 1}" for i in range(arm.n)},
            str(state[Sweep].joint),
            lambda key: post(SweepJoint(int(key))),
            "The joint that moves while the others stay.",
        )

        self._button = gui.button(
            "Sweep",
            lambda: post(OpenClip(CLIP_KEY, play=True)),
            "Move this joint through its range and back; stops at limits, middle and singularities.",
        )
        self._note = gui.html()
        block = state[Manipulability].block
        unit = volume_unit(block, block.ellipsoid(state[Joints].q).joint_directions.shape[1])
        curves_of = (
            (name_of_w(block), unit, "w", BLUE),
            (f"Smallest half axis {mathml(SMALLEST)}", block.unit, "sigma_min", GREEN),
            (f"Inverse condition {mathml(INVERSE)}", "", "inverse_condition", PURPLE),
        )
        self._plots = [
            Plot(gui, _with(title, unit), "", [Curve(_with(file, unit), colour)], file, height=HEIGHT, from_zero=True)
            for title, unit, file, colour in curves_of
        ]
        self._shown: Course | None = None
        self._wanted: Course | None = None
        self._later: asyncio.TimerHandle | None = None

    def show(self, state: State) -> None:
        """Show where the joint stands, and the curves as soon as the other joints rest."""
        joints, joint = state[Joints], state[Sweep].joint
        revolute = bool(joints.arm.revolute[joint])
        factor = self._units.factor(revolute)
        self._joint.show(str(joint))
        if self._button.disabled != state[Timeline].playing:
            self._button.disabled = state[Timeline].playing
        wanted = state.derived(course)
        if self._shown is None or self._shown[:2] != wanted[:2]:
            self._draw(state)
        elif wanted != self._wanted:
            self._wait()
            self._note.show('<p class="dim">The curves are drawn again when the arm rests.</p>')
            self._later = asyncio.get_running_loop().call_later(REST, self._draw, state)
        self._wanted = wanted
        for plot in self._plots:
            plot.cursor(float(joints.q[joint]) / factor)

    def _wait(self) -> None:
        if self._later is not None:
            self._later.cancel()
            self._later = None

    def _draw(self, state: State) -> None:
        """Draw the curves of a state."""
        self._wait()
        if adapter.is_removed(self._button):
            return
        self._shown = self._wanted = state.derived(course)
        joint, found = state[Sweep].joint, state.derived(curves)
        revolute = bool(state[Joints].arm.revolute[joint])
        name = f"{self._units.variable(joint, revolute)}, {self._units.unit(revolute)}"
        for plot, curve in zip(self._plots, (found.w, found.sigma_min, found.inverse_condition), strict=True):
            plot.name_x(name)
            plot.show(found.values / self._units.factor(revolute), [curve])
        limits = state[Joints].arm.limits[joint]
        self._note.show(_singular(state.derived(singularities), limits, self._units, joint, revolute))


def _with(name: str, unit: str) -> str:
    return f"{name}, {unit}" if unit else name


def _singular(found: SingularPlaces, limits: Array, units: Units, joint: int, revolute: bool) -> str:
    """Return where the joint's motion passes a singularity."""
    name, text = units.variable(joint, revolute), units.angle if revolute else units.length
    low, high = (text(float(value)) for value in limits)
    if found.everywhere:
        said = "singular everywhere while the other joints stay as they are"
    elif found.places:
        said = f"singular at {', '.join(text(value) for value in found.places)}"
    else:
        said = f"no singularity found in {found.samples} samples"
    return f'<p class="dim">{name} from {low} to {high}: {said}.</p>'


PANEL = Panel(
    "ellipsoid",
    "Ellipsoid",
    "SPHERE",
    35,
    (Joints, Manipulability, Sweep, Timeline, Display),
    build,
    rebuilds=(RobotPart, Notation, Manipulability),
    about=(
        "5.3",
        "S5.1.4-singularity",
        "S5.1.4-2R",
        "S5.2.3-svd",
        "velocity ellipsoid",
        "condition number",
        "singular places",
    ),
)
