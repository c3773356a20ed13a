"""The block diagram of the motor with its values at the present time."""

from __future__ import annotations

from armlab.benches.drive.quantities import prefixed
from armlab.kin.drive.motor import DcMotor
from armlab.kin.drive.motor_run import Moment
from armlab.ui import svg
from armlab.ui.colours import BLUE, GREEN, ORANGE, PURPLE, VERMILLION, Rgb, css
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.units import Units

WIDTH, TALL = 324, 146
LINE, BACK = 66, 110
"""Size of the picture, and heights of the forward line and of the back-EMF, pixels."""

BOX = 13
"""Half height of a box, pixels."""


def diagram(motor: DcMotor, now: Moment, units: Units) -> Markup:
    """Return the diagram, with the loop of the back-EMF inside the motor.

    The electrical part is 1/(s L + R), the mechanical one 1/(s I + F), and k ω comes back from the speed to the
    voltage.
    """
    signals: tuple[tuple[int, int, str, Inside, str, Rgb], ...] = (
        (0, LINE - 20, "start", ("v", _sub("a")), prefixed(now.v, "V"), BLUE),
        (125, LINE - 28, "middle", "i", prefixed(now.i, "A"), VERMILLION),
        (166, LINE + 22, "middle", ("τ", _sub("m")), prefixed(motor.k * now.i, "N m"), PURPLE),
        (256, LINE - 28, "middle", "ω", prefixed(now.omega, "rad/s"), GREEN),
        (WIDTH, LINE + 26, "end", "θ", units.angle(now.theta), GREEN),
        (78, BACK + 13, "middle", "k ω", prefixed(motor.k * now.omega, "V"), ORANGE),
        (200, 10, "middle", ("τ", _sub("load")), prefixed(now.load, "N m"), VERMILLION),
    )
    named = [
        (
            tag("text.mo-name", name, x=x, y=y, text_anchor=anchor, fill=css(colour)),
            svg.text("", *_beside(x, y), value, anchor),
        )
        for x, y, anchor, name, value, colour in signals
    ]
    electrical = "1/R" if motor.reduced else "1/(s L+R)"
    boxes = ((66, 48, electrical), (136, 18, "k"), (198, 48, "1/(s I+F)"), (284, 20, "1/s"), (112, 18, "k"))
    heights = (LINE, LINE, LINE, LINE, BACK)
    arrows = ((0, 44), (60, 66), (114, 136), (154, 176), (192, 198), (246, 284), (304, WIDTH))
    return svg.drawing(
        "chart.mo-diagram",
        WIDTH,
        TALL,
        "Block diagram: the voltage less the back-EMF makes the current, k i the torque, which less the load makes the "
        "speed; k ω goes back to the voltage, inside of the motor",
        svg.shape("rect.mo-inside", x=36.0, y=20.0, width=232.0, height=122.0, rx=5),
        svg.text("tick", 262, 137, "the motor", "end"),
        [_arrow(a, b) for a, b in arrows],
        _loop(),
        [_box(x, wide, text, y) for (x, wide, text), y in zip(boxes, heights, strict=True)],
        named,
    )


def _loop() -> Inside:
    """Return the sums, the wire of the back-EMF, and that of the load."""
    return (
        svg.circle("mo-sum", 52, LINE, 8),
        svg.circle("mo-sum", 184, LINE, 8),
        svg.path("mo-wire", f"M256 {LINE}V{BACK}H134"),
        svg.path("mo-tip", f"M130 {BACK}l7-3.5v7z"),
        svg.path("mo-wire", f"M112 {BACK}H52V{LINE + 12}"),
        svg.path("mo-tip", f"M52 {LINE + 8}l-3.5 7h7z"),
        svg.path("mo-wire", f"M184 2V{LINE - 12}"),
        svg.path("mo-tip", f"M184 {LINE - 8}l-3.5-7h7z"),
        svg.circle("mo-tip", 256, LINE, 2.2),
        svg.text("", 41, LINE - 5, "+", "middle"),
        svg.text("", 62, LINE + 17, "−", "middle"),
        svg.text("", 172, LINE - 6, "+", "middle"),
        svg.text("", 193, LINE - 11, "−", "middle"),
    )


def _beside(x: int, y: int) -> tuple[int, int]:
    """Return where the value of a signal stands: below its name, or beside it at the upper edge."""
    return (x + 42, y) if y == 10 else (x, y + 13)


def _box(x: float, wide: float, text: str, y: float) -> Inside:
    return (
        svg.shape("rect.mo-box", x=x, y=y - BOX, width=wide, height=2 * BOX, rx=3),
        svg.text("mo-in", x + wide / 2, y + 4, text, "middle"),
    )


def _arrow(start: float, end: float) -> Inside:
    return (
        svg.path("mo-wire", f"M{start} {LINE}H{end - 4}"),
        svg.path("mo-tip", f"M{end} {LINE}l-7-3.5v7z"),
    )


def _sub(text: str) -> Markup:
    return tag("tspan.mo-sub", text, dy=3)
