"""Readings of both codes by the same sensors, and the differences between words of neighbouring sectors."""

from __future__ import annotations

from armlab.benches.sensor.absolute.state import Absolute
from armlab.kin.sensors.absolute import CODES, Disk, changes, words_of
from armlab.ui.format import capitalised, scientific, so_many, trimmed
from armlab.ui.html import Inside, Markup, classes, tag
from armlab.ui.markup import verdict_box
from armlab.ui.tables import head_line
from armlab.ui.units import Units

BESIDE = 2
"""Number of sectors before and after the present one in the table."""

SHARE = 1e-3
"""Part of a turn, in percent, below which it is written with a power of ten."""


def sectors(count: int) -> str:
    """Return a number of sectors in words.

    >>> sectors(1), sectors(-3)
    ('1 sector', '3 sectors')
    """
    return so_many(abs(count), "sector")


def off(error: int, count: int) -> str:
    """Return an error in sectors of some number of them, with its sign; half a turn is as far in either sense.

    >>> off(-3, 16), off(-8, 16), off(0, 16)
    ('−3', '±8', '0')
    """
    if 2 * abs(error) == count:
        return f"±{abs(error)}"
    return f"{error:+d}".replace("-", "−") if error else "0"


def readings_markup(part: Absolute, units: Units) -> Markup:
    """Return for each code the word that is seen, the sector and position that are read, and the error."""
    rows = []
    for code, disk in part.disks.items():
        word, read, error = (int(each(part.angle)) for each in (disk.word, disk.read, disk.error))
        cells = [
            f"{word:0{disk.tracks}b}",
            str(read),
            units.constant(read * disk.width, True),
            off(error, 2**disk.tracks),
        ]
        wrong = [classes("td", **{"ab-wrong": k == len(cells) - 1 and error != 0}) for k in range(len(cells))]
        row = [
            tag(kind, tag("b", text) if code == part.code else text) for kind, text in zip(wrong, cells, strict=True)
        ]
        rows.append(tag("tr", tag("th", capitalised(CODES[code])), row))
    return tag("table.kit-points", head_line(None, "word seen", "sector", "position", "off by"), rows)


def verdict(part: Absolute, units: Units) -> Markup:
    """Return how wrong the drawn disk is read at worst in a turn."""
    disk = part.disk
    worst, wrong = disk.pieces.worst, disk.pieces.wrong
    name = CODES[part.code]
    if not worst:
        return verdict_box("ok", "Every sector is read right", _apart(disk))
    percent = 100.0 * wrong
    share = f"{trimmed(percent, 3) if percent >= SHARE else scientific(percent)} % of the turn"
    far = units.constant(worst * disk.width, True)
    if worst == 1:
        return verdict_box(
            "warn",
            f"{capitalised(name)}: off by 1 sector at most",
            f"A neighbour is read, on {share}: {far} {_towards(disk)}.",
        )
    return verdict_box(
        "no",
        f"{capitalised(name)}: off by up to {sectors(worst)}",
        f"That is {far}; another sector than the true one is read on {share}.",
    )


def _towards(disk: Disk) -> str:
    """Return in which sense the readings of a turn are off."""
    ahead, behind = bool((disk.pieces.errors > 0).any()), bool((disk.pieces.errors < 0).any())
    if (ahead and behind) or disk.tracks == 1:  # of two sectors the other one is as far in either sense
        return "too far or too little"
    return "too far" if ahead else "too little"


def _apart(disk: Disk) -> str:
    most = int(changes(disk.code, disk.tracks).max())
    if disk.code == "gray" or most == 1:
        return "All sensors are in line, and one bit changes at each edge."
    return f"All sensors are in line to the last digit, which no real ones are: up to {most} bits change at once."


def neighbours_markup(part: Absolute) -> Markup:
    """Return the words of the sectors around the present one, and how many bits change to the next."""
    count, here = 2**part.tracks, int(part.disk.sector(part.angle))
    first = max(min(here - BESIDE, count - 2 * BESIDE - 1), 0)
    shown = range(first, min(first + 2 * BESIDE + 1, count))
    words = {code: words_of(code, part.tracks) for code in CODES}
    bits = {code: changes(code, part.tracks) for code in CODES}
    rows = []
    for k in shown:
        cells: list[Inside] = [str(k)]
        for code in ("binary", "gray"):
            cells += [f"{int(words[code][k]):0{part.tracks}b}", str(int(bits[code][k]))]
        rows.append(tag(classes("tr", now=k == here), [tag("td", cell) for cell in cells]))
    head = head_line("sector", "binary", "change", "Gray", "change")
    return tag(
        "div",
        tag("table.kit-table.ab-words", head, rows),
        tag("p.dim", "Change: how many bits are other ones in the next sector; after the last one comes 0."),
    )
