"""The ellipsoids of velocity and force in numbers, the circle that is mapped to them, and their curves."""

from __future__ import annotations

from armlab.benches.motion.api import Plan
from armlab.benches.velocity.ellipsoid.state import (
    KINDS,
    LookAtBlock,
    Manipulability,
    PlacedEllipsoid,
    VelocityBlock,
    blocks_of,
    present,
)
from armlab.benches.velocity.ellipsoid.state_circle import UnitCircle, mapped
from armlab.benches.velocity.ellipsoid.state_sweep import Sweep
from armlab.benches.velocity.ellipsoid.ui.force import force_axes, force_numbers, force_verdict
from armlab.benches.velocity.ellipsoid.ui.map import Pictures
from armlab.benches.velocity.ellipsoid.ui.plots import Along, Sweeping, over_distances
from armlab.benches.velocity.ellipsoid.ui.scene import SWITCH, digits, speed
from armlab.benches.velocity.ellipsoid.ui.words import (
    half_axis,
    name_of_w,
    scaling_words,
    vector,
    verdict_of,
    volume,
    volume_unit,
)
from armlab.session.fields import Set
from armlab.session.parts.display import Display
from armlab.session.parts.display import Show as SetSwitch
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.format import mathml, number, pairs, subscript, trimmed
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import verdict_box
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

SMALLEST = r"\sigma_{min}"
TITLES = {"translation": "Translation", "rotation": "Rotation"}
SHOWN: dict[str, str] = dict(zip(KINDS, ("Velocity", "Force", "Both"), strict=True))


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the numbers of the ellipsoids, the circle, and the curves."""
    arm, units, part = state[Joints].arm, units_of(state), state[Manipulability]
    choice = None
    if len(blocks_of(arm)) > 1:
        choice = gui.segments(
            "Rows of J",
            {key: TITLES[key] for key in blocks_of(arm)},
            part.block.key,
            lambda key: post(LookAtBlock(key)),
            "Metres per second and radians per second are never in one ellipsoid, nor newtons and newton metres",
        )
    shown = gui.segments(
        "Ellipsoid of",
        SHOWN,
        part.shown,
        lambda key: post(Set(Manipulability, "shown", key)),
        "Both have the same axes; the half axes of one are the inverses of those of the other⟦ (5.4.1)⟧",
    )
    axes, card, numbers = gui.html(), gui.html(), gui.html()
    keep = gui.checkbox(
        "Always shown",
        SWITCH.on(state),
        lambda on: post(SetSwitch(SWITCH.name, on)),
        "Leave the ellipsoid in the scene while other tabs are open (key M).",
    )
    pictures = Pictures(gui, state, post) if state.derived(mapped) is not None else None
    shows = [Sweeping(gui, state, post, units).show]
    if (distances := over_distances(gui, state, units)) is not None:
        shows.append(distances.show)
    shows.append(Along(gui).show)

    def show(state: State) -> None:
        part, found = state[Manipulability], state.derived(present)
        if choice is not None:
            choice.show(part.block.key)
        shown.show(part.shown)
        axes.show(_axes(part, found))
        card.show(_cards(part, found))
        numbers.show(_numbers(part, found, units))
        keep.show(SWITCH.on(state))
        if pictures is not None:
            pictures.show(state)
        for each in shows:
            each(state)

    return show


def _axes(part: Manipulability, found: PlacedEllipsoid) -> Inside:
    """Return the half axes of the ellipsoids that are shown."""
    velocities = _speeds(part.block, found) if part.velocity else None
    return velocities, force_axes(part.block, found) if part.force else None


def _speeds(block: VelocityBlock, found: PlacedEllipsoid) -> Markup:
    """Return the half axes with bars relative to the largest, and their directions."""
    largest = float(found.sigma[0]) if found.ellipsoid.rank else 1.0
    rows = []
    for i in range(block.m):
        value = float(found.sigma[i])
        share = 100.0 * value / largest
        rows.append(half_axis(subscript("σ", i + 1), vector(found.axes[:, i]), speed(block, value), share))
    title = tag("h3", "Half axes ", tag("small", "and their directions in the world, ", mathml("u_i")))
    return joined(title, tag("div.half", rows, title="Singular values of J⟦, notes 5.152⟧"))


def _cards(part: Manipulability, found: PlacedEllipsoid) -> Inside:
    """Return the verdicts on the ellipsoids that are shown."""
    verdicts = [verdict_of(part.block, found)] if part.velocity else []
    if part.force:
        verdicts.append(force_verdict(part.block, found))
    return [verdict_box(*each) for each in verdicts]


def _numbers(part: Manipulability, found: PlacedEllipsoid, units: Units) -> Inside:
    """Return the measures of the ellipsoids that are shown."""
    velocities = _measures(part.block, found, units) if part.velocity else None
    return velocities, force_numbers(part.block, found) if part.force else None


def _measures(block: VelocityBlock, found: PlacedEllipsoid, units: Units) -> Markup:
    shape = found.ellipsoid
    k = shape.joint_directions.shape[1]
    unit = volume_unit(block, k)
    rows: list[tuple[Inside, str]] = [
        (name_of_w(block), f"{number(shape.w, digits(block.typical**k) + 1)} {unit}"),
        (("smallest ", mathml(SMALLEST)), speed(block, shape.sigma_min)),
        ("inverse condition", number(shape.inverse_condition, 3)),
        ("condition", number(shape.condition, 2) if shape.condition < 1e4 else "∞" if found.lost else "over 10⁴"),
    ]
    told = f"{scaling_words(block, units)} Drawn: 1 {block.unit} is {trimmed(block.drawn, 6)} m."
    hint = "The ellipsoid of joint speeds of length 1⟦; notes 5.142-5.144⟧"
    return joined(pairs(rows), tag("div.eq.small", mathml(volume(block)), title=hint), tag("p.dim", told))


PANEL = Panel(
    (Joints, Manipulability, Sweep, Timeline, Display, UnitCircle, Plan),
    build,
    rebuilds=(RobotPart, Notation, Manipulability),
)
