"""All solutions for the target: their number, the list, and buttons that bring the arm there."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from armlab.benches.target.solutions.found import Found, Row
from armlab.benches.target.solutions.motion import Motion
from armlab.benches.target.solutions.proof import STARTS, Proof
from armlab.benches.target.solutions.state import (
    PRESETS,
    MoveAlong,
    Prove,
    Solutions,
    TakePreset,
    TurnTo,
    fresh,
    motion_of,
    present_row,
    shown_proof,
    whole_turns,
)
from armlab.benches.target.solutions.ui.table import Table
from armlab.kin.arm import Arm
from armlab.kin.ik.solutions import MOST_EQUIVALENTS
from armlab.session.asked import ASKED
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import Target, aimed_arm
from armlab.session.state import Post, State
from armlab.ui.format import subscripts
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import SIGNS, progress_bar, row
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Control, Gui, Html

MOST_TURNS = 64
"""Largest number of whole turns that are offered."""

STEPS = 200
"""Number of steps of the slider along a self-motion."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the sentence, the list, the slider along the self-motion, the proof and the examples."""
    arm, units = state[Joints].arm, units_of(state)
    head = gui.html()
    listing = _Listing(gui, arm, units, post)
    motion = _MotionSlider(gui, post)
    proof = _Proof(gui, units, post)
    examples = gui.form(post)

    def show(state: State) -> None:
        found = state[Solutions].found
        head.show(_head(found), _less(state))
        listing.show(state)
        motion.show(state)
        proof.show(state)
        chips = [examples.chip(name, name, TakePreset(name), hint) for name, (_, _, hint) in PRESETS.items()]
        examples.show(tag("h3", "Examples"), tag("div.bar", chips))

    return show


def _head(found: Found | None) -> Inside:
    """Return the number of solutions, and how it is known."""
    if found is None:
        return tag("h3", "All solutions"), tag("p.dim", "Looking for all solutions …")
    solutions = found.solutions
    count, _, rest = solutions.sentence.partition(".")
    kind = "no" if solutions.completeness == "none" else "warn" if solutions.completeness == "at least" else "ok"
    said = tag("p.count", tag(f"b.{kind}", f"{SIGNS[kind]} {count}."), rest)
    return tag("h3", "All solutions"), said, tag("p.dim.why", subscripts(solutions.why))


def _less(state: State) -> Markup | None:
    """Return that the list is of more than is asked for, where only a part of the target counts."""
    if aimed_arm(state) is state[Joints].arm:
        return None
    wish = ASKED[state[Target].asks]
    said = f"The list is for the whole pose, with the orientation that the tool has now, although {wish}."
    return tag("p.warn", said)


class _Listing:
    """The list, and the whole turns of the present solution."""

    def __init__(self, gui: Gui, arm: Arm, units: Units, post: Post) -> None:
        self._arm, self._units = arm, units
        self._form = gui.form(post)
        self._table = Table(arm, units, self._form)
        self._family, self._followed = 0, -1

    def _turn_to(self, family: int) -> None:
        self._family = family

    def show(self, state: State) -> None:
        """Show the newest list."""
        found = state[Solutions].found
        if found is None or not found.rows:
            self._form.show()
            return
        present = state.derived(present_row)
        families = len(found.solutions.families)
        if families:
            self._follow(found, present, state)
        rows = [row for row in found.rows if not families or row.family in (-1, self._family)]
        q = state[Joints].q if state.derived(fresh) is not None else None
        table = self._table.markup(found, rows, present, state[Solutions].chosen, q)
        self._form.show(self._choice(families), table, self._turns(state))

    def _follow(self, found: Found, present: Row | None, state: State) -> None:
        """Show the family of the present configuration."""
        motion = state.derived(motion_of)
        here = present.family if present is not None else -1
        if here < 0 and motion is not None:
            here = found.nearest(state[Joints].q)[0].family  # type: ignore[union-attr]
        if here >= 0 and here != self._followed:
            self._followed = self._family = here
        self._family = min(self._family, len(found.solutions.families) - 1)

    def _choice(self, families: int) -> Markup | None:
        if families < 2:
            return None
        hint = "Representatives of family {}"
        chips = [
            self._form.chip(f"family{k}", str(k + 1), partial(self._turn_to, k), hint.format(k + 1), k == self._family)
            for k in range(families)
        ]
        return row("Family", chips)

    def _turns(self, state: State) -> Markup | None:
        turns = state.derived(whole_turns)
        if len(turns) < 2:
            return None
        q = state[Joints].q
        here = int(np.argmin(np.abs(turns - q).max(axis=1)))
        order = np.argsort(np.abs(turns - turns[here]).sum(axis=1), kind="stable")[:MOST_TURNS]
        texts = {str(k): self._turn_words(turns[k] - turns[here]) for k in sorted(order)}
        menu = self._form.select("turns", "Whole turns", texts, str(here), lambda k: TurnTo(int(k)))
        least = "at least " if len(turns) >= MOST_EQUIVALENTS else ""
        count = tag("small", f" {least}{len(turns)} ways inside the limits")
        return tag("div.turns", tag("span", "Whole turns", count), menu)

    def _turn_words(self, away: np.ndarray) -> str:
        said = []
        for i, amount in enumerate(away):
            if count := round(float(amount) / math.tau):
                sign = "+" if count > 0 else "−"
                said.append(f"{self._units.variable(i, True)} {sign} {self._units.angle(abs(count) * math.tau)}")
        return ", ".join(said) or "as the arm is now"


class _MotionSlider:
    """The slider along the motion that leaves the tool still."""

    def __init__(self, gui: Gui, post: Post) -> None:
        self._words: Html = gui.html()
        self._slider: Control = gui.slider(
            "along %", 0.0, 100.0, 100.0 / STEPS, 0.0, lambda value: post(MoveAlong(value / 100.0)), None
        )
        self._slider.handle.visible = False

    def show(self, state: State) -> None:
        """Show the place of the arm along its self-motion, if there is one."""
        motion = state.derived(motion_of)
        if self._slider.handle.visible != (motion is not None):
            self._slider.handle.visible = motion is not None
        self._words.visible(motion is not None)
        if motion is None:
            return
        joints = state[Joints]
        self._slider.show(round(100.0 * motion.part(joints.arm, joints.q) * STEPS / 100.0) * 100.0 / STEPS)
        self._words.show(tag("h3", "Self-motion ", tag("small", "the tool stands still")), tag("p", _ends(motion)))


def _ends(motion: Motion) -> str:
    """Return in words where a self-motion ends."""
    if motion.closed:
        return "It is a closed curve."
    ends = [f"the limit of joint {joint + 1}" if joint >= 0 else "a singular configuration" for joint in motion.stops]
    return f"From {ends[0]} to {ends[1]}." if ends[0] != ends[1] else f"It ends at {ends[0]} on both sides."


class _Proof:
    """The search from thousands of starts."""

    def __init__(self, gui: Gui, units: Units, post: Post) -> None:
        self._form = gui.form(post)
        self._units = units

    def show(self, state: State) -> None:
        """Show the button, the progress of the search, or its result."""
        found, proof = state[Solutions].found, state.derived(shown_proof)
        if found is None or len(found.question.held) == found.question.arm.n:
            self._form.show()
            return
        if proof is None or proof.done:
            name = f"Cross-check: {STARTS} random starts"
            hint = "Search for a solution that is not in the list; finding none is evidence, not a proof"
            begin = self._form.chip("prove", name, Prove(True), hint)
        else:
            begin = self._form.chip("cancel", "Cancel", Prove(False))
        self._form.show(tag("div.bar.prove", begin), self._outcome(proof, state))

    def _outcome(self, proof: Proof | None, state: State) -> Inside:
        if proof is None:
            return None
        if not proof.done:
            return progress_bar(proof.starts / STARTS), tag("p.dim", proof.sentence)
        agrees = not proof.others or (proof.solutions.completeness == "infinite" and not proof.of_families)
        kind, arm = "ok" if agrees else "warn", state[Joints].arm
        others = [(tag("br"), self._values(arm, q)) for q in ([] if agrees else proof.others[:3])]
        return tag("p", tag(f"b.{kind}", SIGNS[kind]), f" {proof.sentence}", others)

    def _values(self, arm: Arm, q: np.ndarray) -> str:
        shown = (
            self._units.angle(float(value)) if joint.revolute else self._units.length(float(value))
            for value, joint in zip(q, arm.rows, strict=True)
        )
        return "  ".join(shown)


PANEL = Panel((Joints, Target, Solutions), build)
