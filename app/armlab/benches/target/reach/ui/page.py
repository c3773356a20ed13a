"""The target: its fields, its handle, and whether the arm reaches it."""

from __future__ import annotations

from armlab.kin import ik
from armlab.session.asked import ASKED, FAVOURS, MORE, asks_of, can_favour
from armlab.session.fields import Set
from armlab.session.parts.jog import Jog
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import (
    AskFor,
    GoAnotherWay,
    PlaceTarget,
    Target,
    TargetToTool,
    aimed_arm,
    target_pose,
    verdict,
)
from armlab.session.state import Post, State
from armlab.ui.form import Form
from armlab.ui.format import capitalised
from armlab.ui.html import Inside, tag
from armlab.ui.jog import show_jog
from armlab.ui.markup import row
from armlab.ui.plugin import Panel, Show
from armlab.ui.pose_fields import pose_form, product
from armlab.ui.units import Units, units_of
from armlab.ui.verdicts import verdict_card
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the fields, the choices and the verdict."""
    units, task = units_of(state), state[Joints].arm.task
    gui.heading("Target of the tool")
    form = gui.form(post)
    wish, handles = gui.form(post), None
    if task.rotation != "none" and task.position:
        handles = gui.segments(
            "Handle",
            {"move": "Move", "turn": "Turn"},
            state[Target].handle,
            lambda key: post(Set(Target, "handle", key)),
            "What dragging the handle does; only what this arm's task includes is offered",
        )
    axes = gui.segments(
        "Along axes of",
        {"world": "World", "tool": "Tool"},
        state[Target].axes,
        lambda key: post(Set(Target, "axes", key)),
        "The frame along and about whose axes the handle moves",
    )
    method = gui.dropdown(
        "Method",
        {method.key: capitalised(method.title) for method in ik.methods().values()},
        state[Target].method,
        lambda key: post(Set(Target, "method", key)),
        "How the arm follows the target. Every method keeps to the joint limits and never increases the error.",
    )
    card = gui.html()
    back = gui.button("Target to tool", lambda: post(TargetToTool()), "Move the target back to the tool.")
    gui.button(
        "Next solution",
        lambda: post(GoAnotherWay()),
        "Move the arm to the nearest other solution inside the limits. The page Solutions lists them all.",
    )

    jog = gui.form(post)

    def show(state: State) -> None:
        form.show(_fields(form, state, units))
        wish.show(_wish(wish, state))
        if handles is not None:
            handles.show(state[Target].handle)
            handles.visible(aimed_arm(state).task.rotation != "none")
        axes.show(state[Target].axes)
        method.show(state[Target].method)
        card.show(verdict_card(state.derived(verdict), units))
        away = state[Target].pose is not None and state.derived(verdict).status != "reached"
        if back.visible != away:
            back.visible = away
        show_jog(jog, state, wide=True)

    return show


def _wish(form: Form, state: State) -> Inside:
    """Return the choices of what counts of the target, as far as the arm controls more than a position."""
    arm, target = state[Joints].arm, state[Target]
    asks, aimed = asks_of(arm), aimed_arm(state)
    if len(asks) < 2:
        return None
    hint = (
        "What the arm has to reach: its whole task, the position, or position and approach direction; the rest follows"
    )
    counts = form.chips("asks", asks, target.asks, hint, lambda key: AskFor(asks=key))
    if not can_favour(aimed):
        return row("What counts", counts, wide=True)
    hint = f"The error that counts {MORE:g} times as much as the other when the target is out of reach"
    favoured = form.chips("favours", FAVOURS, target.favours, hint, lambda key: AskFor(favours=key))
    return row("What counts", counts, wide=True), row("Out of reach", favoured, wide=True)


def _fields(form: Form, state: State, units: Units) -> Inside:
    arm = aimed_arm(state)
    shown = pose_form(form, arm, target_pose(state), units, PlaceTarget)
    if arm.task.rotation == "none":
        says = "This arm controls the position only" if arm is state[Joints].arm else capitalised(ASKED["position"])
        return shown, tag("p.dim", f"{says}; its orientation follows.")
    return shown if arm.task.rotation == "phi" else (shown, product())


PANEL = Panel((Joints, Target, Jog), build)
