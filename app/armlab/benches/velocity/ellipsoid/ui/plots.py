"""Plots of the page of the ellipsoids: over the range of a joint, over the distance of a 2R arm, along a motion."""

from __future__ import annotations

import asyncio

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.api import CLIP_KEY as MOTION
from armlab.benches.velocity.ellipsoid.curves import (
    AlongMotion,
    OverDistance,
    along_motion,
    over_distance,
    present_distance,
)
from armlab.benches.velocity.ellipsoid.state import Manipulability
from armlab.benches.velocity.ellipsoid.state_sweep import (
    CLIP_KEY,
    Course,
    Sweep,
    SweepJoint,
    course,
    curves,
    singularities,
)
from armlab.benches.velocity.ellipsoid.ui.words import name_of_w, volume_unit
from armlab.kin.ellipsoid import SingularPlaces
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui import adapter
from armlab.ui.colours import BLUE, GREEN, PURPLE, Rgb
from armlab.ui.format import mathml, number
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.playing import play_button
from armlab.ui.plot import TIME, Curve, Plot
from armlab.ui.units import Units
from armlab.ui.widgets import Gui

Array = NDArray[np.float64]

REST = 0.3
"""Time without a motion of the other joints after which the curves are drawn again, seconds."""

HEIGHT = 104
HINT = "Move this joint through its range and back, stopping at limits, middle and singularities"
SMALLEST, INVERSE = r"\sigma_{min}", r"\sigma_{min}/\sigma_1"


class Sweeping:
    """The choice of a joint, the button, and the plots over the range of the joint."""

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

        self._play = gui.form(post)
        self._note = gui.html()
        block = state[Manipulability].block
        unit = volume_unit(block, block.ellipsoid(state[Joints].q).joint_directions.shape[1])
        curves_of: tuple[tuple[Inside, str, str, Rgb], ...] = (
            (name_of_w(block), unit, "w", BLUE),
            (("Smallest half axis ", mathml(SMALLEST)), block.unit, "sigma_min", GREEN),
            (("Inverse condition ", mathml(INVERSE)), "", "inverse_condition", PURPLE),
        )

        def plot(title: Inside, unit: str, file: str, colour: Rgb) -> Plot:
            curves = [Curve(_with(file, unit), colour)]
            return Plot(gui, _title(title, unit), "", curves, file, height=HEIGHT, from_zero=True)

        self._plots = [plot(*curves_of[0])]
        with gui.fold("Smallest half axis and inverse condition"):
            self._plots += [plot(*each) for each in curves_of[1:]]
        self._shown: Course | None = None
        self._wanted: Course | None = None
        self._later: asyncio.TimerHandle | None = None

    def show(self, state: State) -> None:
        """Show the value of the joint, and the curves as soon as the other joints rest."""
        joints, joint = state[Joints], state[Sweep].joint
        revolute = bool(joints.arm.revolute[joint])
        factor = self._units.factor(revolute)
        self._joint.show(str(joint))
        self._play.show(tag("div.bar", play_button(self._play, state, CLIP_KEY, "sweep", "Sweep", hint=HINT)))
        wanted = state.derived(course)
        if self._shown is None or self._shown[:2] != wanted[:2]:
            self._draw(state)
        elif wanted != self._wanted:
            self._wait()
            self._note.show(tag("p.dim", "The curves are updated when the arm is at rest."))
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
        if adapter.is_removed(self._note.handle):
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


def _title(name: Inside, unit: str) -> Markup:
    return joined(name, _with("", unit))


def _singular(found: SingularPlaces, limits: Array, units: Units, joint: int, revolute: bool) -> Markup:
    """Return in words the joint values at singularities."""
    name, text = units.variable(joint, revolute), units.angle if revolute else units.length
    low, high = (text(float(value)) for value in limits)
    if found.everywhere:
        said = "singular everywhere while the other joints stay as they are"
    elif found.places:
        said = f"singular at {', '.join(text(value) for value in found.places)}"
    else:
        said = f"no singularity found in {found.samples} samples"
    return tag("p.dim", f"{name} from {low} to {high}: {said}.")


class OverDistances:
    """Plots of w and both half axes of a planar 2R arm over the distance of its tool from the first axis."""

    def __init__(self, gui: Gui, found: OverDistance, units: Units) -> None:
        self._units, self._link = units, found.link
        gui.heading("Over the distance ", mathml("r"), " from joint 1 ", tag("small", "⟦section 5.3⟧"))
        r = "r, m"
        self._w = Plot(gui, "w, m²", r, [Curve("w, m²", BLUE)], "w over r", height=HEIGHT, from_zero=True)
        named = [Curve("σ₁, m/s", BLUE), Curve("σ₂, m/s", GREEN)]
        self._sigma = Plot(gui, "Half axes, m/s", r, named, "half axes over r", height=HEIGHT, from_zero=True)
        self._note = gui.html()
        self._w.show(found.r, [found.w])
        self._sigma.show(found.r, [found.sigma[:, 0], found.sigma[:, 1]])
        self._said = self._says(found)

    def _says(self, found: OverDistance) -> str:
        link, units = found.link, self._units
        longest, shortest = link.sigma(found.roundest).tolist()
        most = number(link.l1 * link.l2, 3)
        return (
            f"Largest w = l₁l₂ = {most} m² at r = √(l₁² + l₂²) = {units.length(link.best)}, the elbow at a right "
            f"angle; roundest at r = {units.length(found.roundest)}, where σ₁/σ₂ = {number(longest / shortest, 3)}."
        )

    def show(self, state: State) -> None:
        """Show the present distance of the tool."""
        r = present_distance(state)
        w = float(np.prod(self._link.sigma(r)))
        at = f"Here r = {self._units.length(r)}, w = {number(w, 3)} m². "
        self._note.show(tag("p.dim", f"{at}{self._said}"))
        for plot in (self._w, self._sigma):
            plot.cursor(r)


class Along:
    """Plots of w along the planned motion, made when there is one, with a cursor while it plays."""

    def __init__(self, gui: Gui) -> None:
        self._gui = gui
        self._plots: tuple[Plot, ...] = ()
        self._shown: AlongMotion | None = None

    def show(self, state: State) -> None:
        """Draw the motion if it has changed."""
        found = along_motion(state)
        if found is not None and not self._plots:
            self._plots = self._made(state)
        for plot in self._plots:
            plot.visible(found is not None)
            plot.cursor(TIME if found is not None and state[Timeline].clip == MOTION else None)
        if found is not None and found is not self._shown:
            for plot, curve in zip(self._plots, (found.w, found.sigma_min), strict=True):
                plot.show(found.t, [curve])
        self._shown = found

    def _made(self, state: State) -> tuple[Plot, Plot]:
        block, gui = state[Manipulability].block, self._gui
        unit = volume_unit(block, min(block.m, block.arm.n))
        title, least = _title(name_of_w(block), unit), ("Smallest half axis ", mathml(SMALLEST), f", {block.unit}")
        w, sigma = Curve(_with("w", unit), BLUE), Curve(_with("sigma_min", block.unit), GREEN)
        with gui.fold("Along the planned motion"):
            return (
                Plot(gui, title, "t, s", [w], "w over t", height=HEIGHT, from_zero=True, clip=MOTION),
                Plot(gui, least, "t, s", [sigma], "sigma_min over t", height=HEIGHT, from_zero=True, clip=MOTION),
            )


def over_distances(gui: Gui, state: State, units: Units) -> OverDistances | None:
    """Return the plots of a planar 2R arm, or None for other arms."""
    found = over_distance(state[Joints].arm)
    wanted = found is not None and state[Manipulability].block.key == "translation"
    return OverDistances(gui, found, units) if wanted and found is not None else None
