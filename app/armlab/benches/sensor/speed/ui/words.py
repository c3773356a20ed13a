"""Both readings in numbers: what is counted, the speed, its step, its error, and its delay."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.sensor.speed.state import EncoderSpeed
from armlab.session.amounts import amount
from armlab.ui.format import mathml
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import verdict_box
from armlab.ui.tables import head_line
from armlab.ui.units import Units


def seconds(value: float) -> str:
    """Return a time in the unit that leaves it readable.

    >>> seconds(0.05), seconds(2.5), seconds(0.00025)
    ('50 ms', '2.5 s', '250 µs')
    """
    for factor, unit in ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs")):
        if value >= factor:
            return amount(value / factor, unit)
    return amount(1e9 * value, "ns")


def percent(part: float) -> str:
    """Return a part in percent."""
    return f"{amount(100.0 * part)} %" if math.isfinite(part) else "no reading"


def rate(speed: float, units: Units) -> str:
    """Return an angular speed with its unit."""
    return amount(speed / units.factor(True), f"{units.angle_unit}/s") if math.isfinite(speed) else "no tick"


def formulas(units: Units) -> Markup:
    """Return both formulas."""
    return tag(
        "div.eq.small",
        mathml(r"\omega=\frac{C}{T}\,AR"),
        "\N{EM SPACE}",
        mathml(r"\omega=\frac{f}{n}\,AR"),
        "\N{EM SPACE}",
        mathml(rf"AR=\frac{{{units.turn_in_latex}}}{{\mathrm{{PPR}}\cdot D}}"),
        title="By C counts in a window T, and by n ticks of the clock f between two counts⟦; notes 2.42, 2.45⟧",
    )


def readings_markup(part: EncoderSpeed, units: Units) -> Markup:
    """Return a column for each reading."""
    meter, times = part.meter, part.by_time
    ticks = " or ".join(dict.fromkeys(map(str, part.ticks)))
    read = " or ".join(dict.fromkeys(rate(float(each), units) for each in times))
    rows: list[tuple[str, Inside, Inside]] = [
        ("counted", f"C = {part.counts}", f"n = {ticks}"),
        ("speed that is read", tag("b", rate(part.by_counts, units)), tag("b", read)),
        ("one more or less", f"±{rate(meter.quantum, units)}", _one_tick(part, units)),
        (
            "largest error",
            percent(float(meter.error_by_counts(part.speed))),
            percent(float(meter.error_by_time(part.speed))),
        ),
        ("age of the reading", seconds(meter.delay_by_counts()), seconds(meter.delay_by_time(part.speed))),
    ]
    head = head_line(None, tag("span.sp-counts", "counts in a window"), tag("span.sp-time", "time between counts"))
    return tag(
        "table.kit-points.sp-table",
        head,
        [tag("tr", tag("th", name), tag("td", a), tag("td", b)) for name, a, b in rows],
    )


def _one_tick(part: EncoderSpeed, units: Units) -> Inside:
    """Return by how much the second reading changes with one more tick, and with one less, which is farther."""
    mean, per_tick = float(np.mean(part.ticks)), part.meter.resolution * part.clock
    if mean < 1.0:
        return "±∞"
    more = rate(per_tick * (1.0 / mean - 1.0 / (mean + 1.0)), units)
    less = rate(per_tick * (1.0 / (mean - 1.0) - 1.0 / mean), units) if mean > 1.0 else "∞"
    return f"∓{more}" if less == more else (f"−{more}", tag("br"), f"+{less}")


def verdict(part: EncoderSpeed, units: Units) -> Markup:
    """Return which reading is finer at the true speed."""
    cross = rate(part.meter.crossover, units)
    if part.meter.decoder.unevenness:
        return verdict_box(
            "warn",
            "Uneven counts",
            f"The gaps between the counts are {units.turned_by(1)} and {units.turned_by(3)} electrical: the time "
            "between two of them is half of what AR stands for, or one and a half times as long. No clock helps.",
        )
    first = part.finer == "counts"
    head = "Counting is finer here" if first else "The time between counts is finer here"
    return verdict_box(
        "ok",
        head,
        f"Both are as fine at {cross}, where about as many counts come in a window as ticks between two counts. Below "
        "it the time between counts is finer, above it the number of counts.",
    )
