"""The field of a joint's value beside its slider."""

from __future__ import annotations

from armlab.session.parts.joints import Joints, TypeJoint
from armlab.session.state import Post
from armlab.ui.html import tag
from armlab.ui.units import Units
from armlab.ui.widgets import Gui

THERE = 1e-9
"""Difference from a limit, rad or m, within which a joint is at it."""


class TypedValue:
    """The field of one joint, in place of the slider's own box.

    That box sends every digit while it is typed, and cuts a value at the limit without a word.

    Parameters
    ----------
    gui : Gui
    i : int
        The joint, from 0.
    units : Units
    post : callable
    """

    def __init__(self, gui: Gui, i: int, units: Units, post: Post) -> None:
        self._form, self._i, self._units = gui.form(post), i, units
        # Where the last value was cut, what is said of it, and whether the joint has come there.
        self._cut: tuple[float, str] | None = None
        self._came = False

    def show(self, joints: Joints) -> None:
        """Show the value of the joint, and what was cut of a typed one as long as the joint stays there."""
        value, revolute = float(joints.q[self._i]), bool(joints.arm.revolute[self._i])
        text, note = self._units.text(value, revolute), self._note(value)
        if self._form.shows(text, note, joints.locked[self._i]):
            return
        label = f"{self._units.variable(self._i, revolute)} in {self._units.unit(revolute)}"
        cell = f"value {self._i + 1}"
        field = self._form.field(
            cell, text, label, lambda typed: self._typed(joints, typed), off=joints.locked[self._i]
        )
        self._form.show(tag("div.over-slider", field), tag("p.warn", f"◐ {note}", role="status") if note else None)

    def _note(self, value: float) -> str:
        if self._cut is None:
            return ""
        stop, text = self._cut
        there = abs(value - stop) <= THERE
        if self._came and not there:
            self._cut = None
        self._came = there
        return text if there else ""

    def _typed(self, joints: Joints, text: str) -> TypeJoint:
        i, revolute = self._i, bool(joints.arm.revolute[self._i])
        value = self._units.read(text, revolute, f"joint {i + 1}")
        stop = min(max(value, float(joints.arm.limits[i, 0])), float(joints.arm.limits[i, 1]))
        shown = self._units.angle if revolute else self._units.length
        said = f"{shown(value)} exceeds the limit of joint {i + 1}: set to {shown(stop)}"
        # A limit that was typed as it is shown is not beyond itself.
        self._cut, self._came = (None if shown(value) == shown(stop) else (stop, said)), False
        return TypeJoint(i, value)
