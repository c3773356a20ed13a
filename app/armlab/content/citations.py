"""Numbers of the notes that a text cites, and the functions of `armlab.kin` that cite them or compute their topics."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from types import ModuleType
from typing import NamedTuple

from armlab import kin
from armlab.content.rows import Reference, reference, rows

_RANGE = r"\d\.\d+(?:\.\d+)?(?:[-–]\d\.\d+)?"
_CITED = re.compile(
    rf"(?P<kind>\b(?i:sections?|figures?|equations?|eqs?|formulas?|notes|notes'|of|after|before|and)\b[.,]?\s|\(|§)?"
    rf"(?P<list>(?<![\w.]){_RANGE}(?:(?:, and |, | and ){_RANGE})*)(?!\w|\.\d|\s?(?:m|mm|rad|deg|s|%|°)\b)"
)
_COUNTED = re.compile(r"\b(definition|theorem)s? (\d+)(?:(?:-| and |, )(\d+))?(?!\d|\.\d)")
_TO_THE_END = r"[^;]*?(?=;|\)|\. [A-Z]|$)"
_OTHERS = re.compile(
    r"(?:\bCraig\b|\bISO \d{4,5}\b|(?<!\w)\*(?=[A-Z])[^*]+\*"
    rf"|\b[A-Z][a-z]+(?:,? (?:and [A-Z][a-z]+|et al\.))*,? (?:19|20)\d\d\b){_TO_THE_END}"
)
"""Pattern of another source, by its author, title, year or number, together with what is cited of it."""


@dataclass(frozen=True)
class Citations:
    """Numbers of the notes in a text."""

    references: tuple[Reference, ...]
    sections: tuple[str, ...]


class Function(NamedTuple):
    """Something of `armlab.kin` that belongs to the notes: a function, class, method or module."""

    name: str
    says: str
    cites: Citations


def citations(text: str) -> Citations:
    """Return the numbers of the notes a docstring cites; those of other books and of its examples are left out.

    >>> citations("Notes 4.13-4.14 (standard); Craig, *Robotics*, 3.6. See section 4.3.2.").sections
    ('4.3.2',)
    """
    paragraphs = re.split(r"\n\s*\n", text.partition("\nExamples\n---")[0])
    said = (" ".join(each.split()) for each in paragraphs if not each.lstrip().startswith(">>>"))
    found = [number for paragraph in said for number in _numbers(paragraph)]
    cited = (reference(kind, number) for kind, number in found if kind != "section")
    known = (one for one in cited if one is not None and any(row.cites(one) for row in rows().values()))
    sections = (number for kind, number in found if kind == "section")
    return Citations(tuple(dict.fromkeys(known)), tuple(dict.fromkeys(sections)))


def _numbers(line: str) -> Iterator[tuple[str, str]]:
    """Yield kind and number of everything a paragraph cites; a decimal number alone is a quantity."""
    line = _OTHERS.sub("", line)
    of_notes = re.search(r"\b[Nn]otes\b", line) is not None
    for found in _CITED.finditer(line):
        before = (found["kind"] or "").strip("., ").lower()
        for number in re.findall(_RANGE, found["list"]):
            if before.startswith(("section", "§")) or re.fullmatch(r"\d\.\d+\.\d+", number):
                # What stands before section 6.1 is the beginning of chapter 6.
                is_before = line[: found.start()].endswith("before ") and number.endswith(".1")
                yield "section", number.removesuffix(".1") if is_before else number
            elif before or of_notes or re.search("[-–]", number):
                yield "figure" if before.startswith("figure") else "equation", number
    for kind, first, last in _COUNTED.findall(line):
        yield kind, f"{first}-{last}" if last else first


@cache
def functions() -> tuple[Function, ...]:
    """Return everything in `armlab.kin` that cites the notes, or that a row of the inventory names; found once.

    It is in the order of modules and their text.
    """
    named = {name for row in rows().values() for name in row.core}
    found = []
    for name, thing in _things():
        says = inspect.getdoc(thing) if not isinstance(thing, ModuleType) else thing.__doc__
        cites = citations(says or "")
        if says and (cites.references or cites.sections or name in named):
            found.append(Function(name, says.strip().splitlines()[0].strip(), cites))
    return tuple(found)


def _things() -> Iterator[tuple[str, object]]:
    """Yield the modules of kin and their public members, with dotted names."""
    for info in pkgutil.walk_packages(kin.__path__, f"{kin.__name__}."):
        if any(part.startswith("_") for part in info.name.split(".")):
            continue
        module = importlib.import_module(info.name)
        yield info.name, module
        for name, thing in list(vars(module).items()):  # other threads import meanwhile
            own = getattr(thing, "__module__", None) == info.name and not name.startswith("_")
            if own and (inspect.isfunction(thing) or inspect.isclass(thing)):
                yield f"{info.name}.{name}", thing
                if inspect.isclass(thing):
                    members = ((part, value) for part, value in vars(thing).items() if not part.startswith("_"))
                    yield from ((f"{info.name}.{name}.{part}", value) for part, value in members if _documented(value))


def _documented(value: object) -> bool:
    return inspect.isfunction(value) or isinstance(value, (property, classmethod, staticmethod))
