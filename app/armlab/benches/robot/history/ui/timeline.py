"""The timeline: all entries as points over the years, the list of a group, and a card of one entry."""

from __future__ import annotations

import math
from functools import cache
from typing import NamedTuple

from armlab.benches.robot.history.state import History, LookAt
from armlab.benches.robot.history.timeline import DRIVES, EVENTS, LANES, Event, Model, of_lane
from armlab.content.robots import catalogue
from armlab.session.fields import Set
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.state import State
from armlab.ui import svg
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, classes, tag

WIDE, LEFT = 330.0, 88.0
"""Width of the picture, and of the names in it, pixels."""

FIRST, LAST = 1915, 2025
"""Years at the ends of the picture."""

DOT, LINE, GAP = 4.0, 11.0, 5.0
"""Radius of a point, height of one line of points, and the space between two groups, pixels."""

DECADES = (1920, 1940, 1960, 1980, 2000, 2020)


class Spot(NamedTuple):
    """Place of an entry in the picture, pixels."""

    event: Event
    x: float
    y: float


@cache
def spots() -> tuple[tuple[Spot, ...], dict[str, float], float]:
    """Return the places of all entries, the height of the name of each group, and the height of the picture.

    In a group points that would cover each other stand in further lines.
    """
    found, names, top = list[Spot](), dict[str, float](), GAP
    for lane in LANES:
        ends = list[float]()
        for event in of_lane(lane):
            x = _x(event.year)
            line = next((k for k, end in enumerate(ends) if x - end > 2.0 * DOT + 1.0), len(ends))
            ends[line : line + 1] = [x]
            found.append(Spot(event, x, top + (line + 0.5) * LINE))
        names[lane] = top + 0.5 * len(ends) * LINE
        top += len(ends) * LINE + GAP
    return tuple(found), names, top


def _x(year: float) -> float:
    return LEFT + (WIDE - LEFT - 2.0 * DOT) * (year - FIRST) / (LAST - FIRST)


def nearest(x: float, y: float) -> str:
    """Return the key of the entry nearest to a place, given in parts of the picture from its upper left."""
    places, _, height = spots()
    whole = height + LINE
    near = min(places, key=lambda spot: math.hypot(spot.x - x * WIDE, spot.y - y * whole))
    return near.event.key


def timeline_markup(form: Form, state: State) -> Inside:
    """Return the picture, the list of the chosen group, and the card of the chosen entry."""
    part = state[History]
    chips = form.chips("lane", LANES, part.lane, "Group of the timeline", lambda key: Set(History, "lane", key))
    return (
        _picture(form, part),
        tag("p.dim.hi-key", "● electric  ○ hydraulic  ▪ other; press a point"),
        tag("div.bar.hi-lanes", chips),
        tag("div.hi-list", [_line(form, event, event.key == part.event) for event in of_lane(part.lane)]),
        card(form, EVENTS[part.event], state[RobotPart].robot.key),
    )


def _picture(form: Form, part: History) -> Markup:
    places, names, height = spots()
    shapes: list[Inside] = []
    for year in DECADES:
        shapes.append(svg.line("hi-decade", _x(year), 0.0, _x(year), height))
        shapes.append(svg.text("tick", _x(year), height + LINE - 1.0, str(year), "middle"))
    shapes += [svg.text("hi-name", 0.0, y + 4.0, LANES[lane]) for lane, y in names.items()]
    shapes += [_point(spot, spot.event.key == part.event) for spot in places]
    first = min(spot.event.year for spot in places)
    said = f"Timeline of {len(places)} entries from {first} on; the list below has the same."
    where = form.place("spot", lambda x, y, _: LookAt(nearest(x, y)))
    return svg.drawing("chart.hi-time", WIDE, height + LINE, said, *shapes, **where)


def _point(spot: Spot, here: bool) -> Markup:
    title = tag("title", f"{spot.event.year} {spot.event.title}")
    kind = classes("circle.hi-dot", hollow=spot.event.drive == "hydraulic", here=here)
    if spot.event.drive in ("electric", "hydraulic"):
        return svg.shape(kind, title, cx=spot.x, cy=spot.y, r=DOT)
    side = 1.6 * DOT
    kind = classes("rect.hi-dot", here=here)
    return svg.shape(kind, title, x=spot.x - 0.5 * side, y=spot.y - 0.5 * side, width=side, height=side)


def _line(form: Form, event: Event, here: bool) -> Markup:
    inside = tag("b", str(event.year)), tag("span", event.title), tag("i", event.structure)
    return form.button(f"event {event.key}", inside, LookAt(event.key), "hi-line", aria_current="true" if here else "")


def card(form: Form, event: Event, present: str) -> Markup:
    """Return what is said of an entry, with a button for each model of it; the arm on the table is ``present``."""
    built = [
        f"{event.structure}: {event.joints}" if event.joints else "",
        f"driven by {DRIVES[event.drive]}" if event.drive == "hand" else DRIVES[event.drive],
    ]
    return tag(
        "div.verdict.hi-card",
        tag("b", f"{event.year}: {event.title}"),
        tag("p", event.says),
        tag("p.dim", ", ".join(filter(None, built))) if any(built) else None,
        [_model(form, model, model.robot == present) for model in event.models] or _no_model(event),
        tag("p.dim.hi-source", "Source: ", event.source),
    )


def _model(form: Form, model: Model, here: bool) -> Markup:
    name = catalogue()[model.robot].name
    hint = "Put this arm on the table; undo brings the present one back"
    button = form.chip(f"model {model.robot}", name, ChooseRobot(model.robot), hint, here)
    return tag("div.bar.hi-model", button, tag("span.dim", model.says))


def _no_model(event: Event) -> Markup | None:
    if not event.joints:
        return None
    return tag("p.dim", "The lab has no model of it: its lengths are not published where we could read them.")
