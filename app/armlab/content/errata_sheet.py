"""All errata on paper: printed and correct side by side, by chapter, with what came of running both."""

from __future__ import annotations

import html
import math
from collections.abc import Iterable, Iterator
from functools import lru_cache
from itertools import groupby
from typing import NamedTuple

from armlab.content.errata import FILE, SEVERITIES, Erratum, find
from armlab.content.markdown import to_html
from armlab.content.rows import chapters
from armlab.kin.errata import POINTS, Run, Trial, run, trials
from armlab.registry import known_name

SEED = 1
"""Seed of the points where none is asked for."""


class Format(NamedTuple):
    """Title and ending of a format."""

    title: str
    ending: str


FORMATS = {"html": Format("a page to print", "html"), "markdown": Format("Markdown", "md")}

ABOUT = (
    "The notes are the lecture notes of the course Robotics 1. Each formula that can be run was run as printed and as "
    f"correct, at {POINTS} seeded points (seed {{seed}}), and compared with an independent judge: SciPy, finite "
    "differences or the core of the lab. Given is the largest residual of each."
)

_POWERS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

STYLE = """
body { font: 14px/1.4 system-ui, sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; color: #1f2733; }
math { font-family: "Cambria Math", "STIX Two Math", "Latin Modern Math", "DejaVu Math TeX Gyre", serif; }
h2 { border-bottom: 1px solid #66717f; margin-top: 2em; break-after: avoid; }
section { break-inside: avoid; border-top: 1px solid #d5dbe3; padding: .5em 0; }
h3 { font-size: 14px; margin: 0 0 .2em; }
h3 small { font-weight: 400; color: #4a5461; margin-left: .6em; }
.both { display: grid; grid-template-columns: 1fr 1fr; gap: 1.5em; }
.both > div { border-left: 3px solid #b03a00; padding-left: .7em; overflow-x: auto; }
.both > div + div { border-color: #00735a; }
.both b.head { display: block; font-size: 12px; color: #4a5461; }
p { margin: .3em 0; }
.ran { color: #4a5461; font-size: 12.5px; }
@media print { body { margin: 0; max-width: none; font-size: 11px; } }
"""


@lru_cache(maxsize=4)
def sheet(format: str = "html", seed: int = SEED, keys: tuple[str, ...] = ()) -> str:
    """Return the list.

    Parameters
    ----------
    format : "html" or "markdown"
        The page is complete in itself.
    seed : int
        Of the points.
    keys : tuple of str
        Ids of some errata; all when left out.

    Raises
    ------
    UnknownName
        Another format.
    """
    known_name("format", format, FORMATS)
    chosen = [each for each in find() if not keys or each.id in keys]
    found = {each.id: run(trials()[each.id], seed) for each in chosen if each.id in trials()}
    write = _html if format == "html" else _markdown
    return "\n".join(write(chosen, found, seed)) + "\n"


def _by_chapter(chosen: Iterable[Erratum]) -> Iterator[tuple[str, str, list[Erratum]]]:
    """Yield the number of each chapter with a blank, none for the appendix, its title, and its errata."""
    for key, group in groupby(chosen, lambda each: each.chapter):
        yield "" if key == "A" else f"{key} ", chapters()[key], list(group)


def _counts(chosen: Iterable[Erratum]) -> list[str]:
    letters = [each.severity for each in chosen]
    return [f"{letters.count(key)} {key} ({says})" for key, says in SEVERITIES.items() if key in letters]


def _number(value: float) -> str:
    if math.isinf(value):
        return "no value"
    mantissa, e, power = f"{value:.2g}".partition("e")
    return f"{mantissa}·10{str(int(power)).translate(_POWERS)}" if e else mantissa


def _ran(each: Erratum, found: dict[str, Run]) -> str:
    if each.unrun:
        return f"Not run: {each.unrun[:1].lower()}{each.unrun[1:]}"
    trial: Trial = trials()[each.id]
    unit = f" {trial.unit}" if trial.unit else ""
    ran = found[each.id]
    return (
        f"Printed {_number(ran.worst_printed)}{unit if math.isfinite(ran.worst_printed) else ''}, correct "
        f"{_number(ran.worst_correct)}{unit}: {trial.measure}, against {trial.judged_by}."
    )


def _markdown(chosen: list[Erratum], found: dict[str, Run], seed: int) -> Iterator[str]:
    yield from ("# Errata of the course notes", "", ABOUT.format(seed=seed), "")
    yield f"{len(chosen)}: {', '.join(_counts(chosen))}."
    for number, title, group in _by_chapter(chosen):
        yield from ("", f"## {number}{title}")
        for each in group:
            yield from ("", f"### {each.id} {each.title}", "", f"{each.place}; {each.severity}, {each.says}", "")
            yield from (f"* **Printed:** {each.printed}", f"* **Correct:** {each.correct}", f"* **Why:** {each.why}")
            yield f"* {_ran(each, found)}"


def _html(chosen: list[Erratum], found: dict[str, Run], seed: int) -> Iterator[str]:
    yield '<!doctype html><html lang="en"><head><meta charset="utf-8">'
    yield f"<title>Errata of the course notes</title><style>{STYLE}</style></head><body>"
    yield f"<h1>Errata of the course notes</h1><p>{html.escape(ABOUT.format(seed=seed))}</p>"
    yield f"<p>{len(chosen)}: {', '.join(map(_span, _counts(chosen)))}.</p>"
    for number, title, group in _by_chapter(chosen):
        yield f"<h2>{number}{_span(title)}</h2>"
        yield from (_section(each, found) for each in group)
    yield "</body></html>"


def _span(text: str) -> str:
    """Return a text as an element of its own, which can be said in another language whatever stands around it."""
    return f"<span>{html.escape(text)}</span>"


def _section(each: Erratum, found: dict[str, Run]) -> str:
    about = f"{_span(each.place)}; {each.severity}, {_span(each.says)}"
    return "".join(
        (
            f'<section id="{each.id}"><h3>{each.id} {_span(each.title)}<small>{about}</small></h3>',
            f'<div class="both"><div><b class="head">printed</b>{to_html(each.printed, FILE)}</div>',
            f'<div><b class="head">correct</b>{to_html(each.correct, FILE)}</div></div>',
            f'{to_html(each.why, FILE)}<p class="ran">{html.escape(_ran(each, found))}</p></section>',
        )
    )
