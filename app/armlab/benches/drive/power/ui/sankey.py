"""Power as bands and bars whose widths are to scale."""

from __future__ import annotations

from itertools import pairwise

from armlab.benches.drive.power.chains import Chain, Passed
from armlab.benches.drive.quantities import prefixed
from armlab.ui import svg
from armlab.ui.colours import BLUE, GREEN, GREY, PURPLE, SKY, VERMILLION, Rgb, css
from armlab.ui.html import Inside, Markup, tag

WIDTH = 320.0
"""Width of the pictures, pixels."""

FULL, TOP, TURN = 66.0, 42.0, 5.0
"""Width of the band of the whole power, height of its upper edge, and inner radius of the turn of a loss, pixels."""

EDGES = (0.0, 62.0, 146.0, 230.0, WIDTH)
"""Abscissas where the bands begin and end: the ends, and the three converters."""

FLOOR = TOP + FULL + 16.0
"""Height at which the bands of heat end, pixels."""

TALL = FLOOR + 36.0

COLOURS: dict[str, Rgb] = {"electrical": BLUE, "hydraulic": SKY, "linear": PURPLE, "rotational": GREEN}
"""Colours of the forms of power, by their keys; each band also has its product written over it."""


def sankey(chain: Chain) -> Markup:
    """Return the bands of power from left to right, from each of which a band of heat leaves downwards."""
    scale = FULL / chain.supplied
    thick = [each.power * scale for each in chain.passed]
    bands = [_band(each, k, wide) for k, (each, wide) in enumerate(zip(chain.passed, thick, strict=True))]
    heat = [
        _heat(title, EDGES[k + 1], before, after, loss)
        for k, ((title, _), (before, after), loss) in enumerate(
            zip(chain.kind.converters, pairwise(thick), chain.losses, strict=True)
        )
    ]
    lost = prefixed(chain.supplied - chain.useful, "W")
    label = (
        f"Bands to scale: {prefixed(chain.supplied, 'W')} from the supply, {prefixed(chain.useful, 'W')} at the load, "
        f"{lost} of heat on the way"
    )
    return svg.drawing("chart.pw-sankey", WIDTH, TALL, label, heat, bands)


def _band(passed: Passed, k: int, wide: float) -> Inside:
    left, right = EDGES[k], EDGES[k + 1]
    middle, domain = 0.5 * (left + right), passed.domain
    colour = css(COLOURS[domain.key])
    tip = f"M{right - 8:.1f} {TOP:.1f}l8 {0.5 * wide:.1f}l-8 {0.5 * wide:.1f}z" if right == WIDTH else ""
    end = right - 8.0 if tip else right
    return (
        svg.shape("rect", x=left + 0.5, y=TOP, width=end - left - 0.5, height=max(wide, 0.5), fill=colour),
        tag("path", d=tip, fill=colour) if tip else None,
        svg.text("pw-product", middle, 17, f"{domain.effort} {domain.flow}", "middle"),
        svg.text("", middle, 33, prefixed(passed.power, "W"), "middle"),
    )


def _heat(title: str, x: float, before: float, after: float, loss: float) -> Inside:
    """Return the part of a band that turns downwards at a converter, with its name and its watts."""
    wide, top = before - after, TOP + after
    outer = TURN + wide
    right = x + outer
    d = (
        f"M{x:.1f} {top:.1f}A{outer:.1f} {outer:.1f} 0 0 1 {right:.1f} {top + outer:.1f}V{FLOOR:.1f}"
        f"L{x + TURN + 0.5 * wide:.1f} {FLOOR + 6:.1f}L{x + TURN:.1f} {FLOOR:.1f}V{TOP + before + TURN:.1f}"
        f"A{TURN:g} {TURN:g} 0 0 0 {x:.1f} {TOP + before:.1f}z"
    )
    middle = x + TURN + 0.5 * wide
    shape = tag("path.pw-heat", d=d, fill=css(VERMILLION)) if wide > 0.0 else None
    return (
        shape,
        svg.text("", middle, FLOOR + 19, title, "middle"),
        svg.text("tick", middle, FLOOR + 32, f"{prefixed(loss, 'W')} heat", "middle"),
    )


def bars(rows: list[tuple[str, float, str]]) -> Markup:
    """Return bars of power to scale: name, watts, and what is said at the bar."""
    most = max(watts for _, watts, _ in rows) or 1.0
    drawn = []
    for k, (name, watts, says) in enumerate(rows):
        y, wide = 6.0 + 34.0 * k, 150.0 * watts / most
        drawn.append(
            (
                svg.text("", 0, y + 11, name),
                svg.shape(
                    "rect", x=0.0, y=y + 15, width=max(wide, 1.5), height=11.0, fill=css(VERMILLION if watts else GREY)
                ),
                svg.text("tick", wide + 6.0, y + 24, says),
            )
        )
    label = "; ".join(f"{name}: {prefixed(watts, 'W')}" for name, watts, _ in rows)
    return svg.drawing("chart.pw-bars", WIDTH, 10.0 + 34.0 * len(rows), f"Power to hold the load: {label}", drawn)
