"""Constants of motors as data sheets write them: read in their units, and written in those."""

from __future__ import annotations

import math
import re

from armlab.content.arithmetic import evaluate
from armlab.errors import InputError

KRPM = 1000.0 * 2.0 * math.pi / 60.0
"""Angular speed of a thousand turns per minute, rad/s."""

UNITS: dict[str, dict[str, float]] = {
    "R": {"Ω": 1.0, "ohm": 1.0, "mΩ": 1e-3, "kΩ": 1e3},
    "L": {"H": 1.0, "mH": 1e-3, "µH": 1e-6},
    "k": {"N m/A": 1.0, "mN m/A": 1e-3, "V s/rad": 1.0, "V/krpm": 1.0 / KRPM, "V/rpm": 1000.0 / KRPM, "rpm/V": 0.0},
    "J": {"kg m²": 1.0, "kg cm²": 1e-4, "g cm²": 1e-7},
    "F": {"N m s/rad": 1.0, "mN m s/rad": 1e-3},
}
"""Units of each constant, and their sizes in SI; ``rpm/V`` is the inverse of one."""

INVERSE = "rpm/V"


def read(name: str, title: str, text: str) -> float:
    """Return a typed constant in SI units, which may have any unit of `UNITS`.

    Parameters
    ----------
    name : str
        Key of `UNITS`.
    title : str
        For the sentence of the error.
    text : str

    Raises
    ------
    InputError
        No number, or another unit; the text lists the units.

    Examples
    --------
    >>> read("L", "inductance", "0.082 mH"), read("J", "inertia", "142 gcm²")
    (8.2e-05, 1.42e-05)
    """
    number, unit = _split(name, text)
    try:
        value = evaluate(number.replace("−", "-").replace(",", "."))
    except InputError:
        value = math.nan
    if unit == INVERSE:
        value = 60.0 / (2.0 * math.pi * value) if value > 0.0 else math.nan
    else:
        value *= UNITS[name].get(unit, 1.0)
    if not math.isfinite(value):
        raise InputError(f"{title}: expected a number in {', '.join(UNITS[name])}, got {text.strip()[:40]!r}")
    return value


def _split(name: str, text: str) -> tuple[str, str]:
    """Return a text as a number and one of the units of a constant, with any blanks; no unit where it ends in none."""
    plain = _plain(text)
    for unit in sorted(UNITS[name], key=len, reverse=True):
        ending = _plain(unit)
        if plain.endswith(ending) and len(plain) > len(ending):
            return plain[: -len(ending)], unit
    return text.strip(), ""


def _plain(text: str) -> str:
    replaced = text.replace("μ", "µ").replace("uH", "µH").replace("\u2126", "Ω").replace("·", "").replace("^2", "²")
    return re.sub(r"(?<=[a-zA-Z])2$", "²", "".join(replaced.split()))


def in_units(k: float) -> dict[str, float]:
    """Return the constant k, N m/A, in the units in which data sheets give it."""
    return {"V/krpm": k * KRPM, "V/rpm": k * KRPM / 1000.0, "rpm/V": 1000.0 / (k * KRPM)}
