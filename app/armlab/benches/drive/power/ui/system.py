"""The robot as a system: its four functional units, and what passes between them (notes, figure 2.1)."""

from __future__ import annotations

from armlab.ui import svg
from armlab.ui.html import Inside, Markup, tag

WIDTH = 320.0
"""Width of the picture, pixels."""


def robot_system() -> Markup:
    """Return the four functional units of a robot and what passes between them."""
    units = (
        (8.0, 6.0, 304.0, ("Supervision", "task planning, reasoning, control")),
        (8.0, 84.0, 126.0, ("Actuation", "amplifiers, motors,", "transmissions")),
        (186.0, 84.0, 126.0, ("Mechanics", "links, joints,", "end effector")),
        (8.0, 182.0, 126.0, ("Inner sensors", "proprioceptive:", "position, speed of joints")),
        (186.0, 182.0, 126.0, ("Outer sensors", "exteroceptive:", "vision, force, distance")),
    )
    ground = svg.shape("rect.pw-world", x=8.0, y=274.0, width=304.0, height=28.0, rx=4)
    wires = (
        # Down from supervision, across to the mechanics, and down to the environment.
        _wire("M71 46V84", 71.0, 84.0, "down"),
        _wire("M134 104H186", 186.0, 104.0, "right"),
        _wire("M306 136V158H318V288H312", 312.0, 288.0, "left"),
        # Up from the environment, and from both kinds of sensors.
        _wire("M249 274V234", 249.0, 234.0, "up"),
        _wire("M200 136V160H71V182", 71.0, 182.0, "down"),
        svg.path("pw-wire", "M134 208H160M186 208H160V172"),
        _wire("M160 172V46", 160.0, 46.0, "up"),
    )
    names = (
        svg.text("tick", 77, 68, "commands"),
        svg.text("tick", 166, 68, "measurements"),
        svg.text("tick", 138, 98, "τ, ω"),
        svg.text("tick", 77, 174, "positions"),
        svg.text("tick", 300, 152, "motion, forces", "end"),
        svg.text("tick", 255, 258, "light, touch"),
        svg.text("pw-unit", 160, 292, "Working environment", "middle"),
    )
    label = (
        "The robot as a system: supervision commands actuation, actuation moves the mechanics, the mechanics act on "
        "the environment, and sensors of the robot and of the environment report to supervision"
    )
    boxes = [_unit(x, y, wide, lines) for x, y, wide, lines in units]
    return svg.drawing("chart.pw-system", WIDTH, 308, label, ground, boxes, wires, names)


def _unit(x: float, y: float, wide: float, lines: tuple[str, ...]) -> Inside:
    title, *says = lines
    tall = 22.0 + 12.0 * len(says) + 6.0
    return (
        svg.shape("rect.pw-box", x=x, y=y, width=wide, height=tall, rx=4),
        svg.text("pw-unit", x + 0.5 * wide, y + 16.0, title, "middle"),
        [svg.text("tick", x + 0.5 * wide, y + 30.0 + 12.0 * k, text, "middle") for k, text in enumerate(says)],
    )


TIPS = {"down": "l-3.5-7h7z", "up": "l-3.5 7h7z", "right": "l-7-3.5v7z", "left": "l7-3.5v7z"}
"""Outlines of the tips of arrows, by where they point."""


def _wire(d: str, x: float, y: float, towards: str) -> Inside:
    """Return a line with a tip at its end."""
    return svg.path("pw-wire", d), svg.path("pw-tip", f"M{x:g} {y:g}{TIPS[towards]}")


def system_words() -> Markup:
    """Return what the units are in a robot arm, and where the lab has them."""
    rows = (
        ("Supervision", "decides what is done: tasks, paths, targets. In the lab: Target, Motion."),
        ("Actuation", "turns commands into torque and motion: the pages of this tab, and Control."),
        ("Mechanics", "links and joints with the end effector: Robot, Joints, Velocity."),
        ("Sensors", "of the robot itself (proprioceptive) or of what surrounds it (exteroceptive)."),
    )
    return tag("table.pw-units", [tag("tr", tag("th", name), tag("td", says)) for name, says in rows])
