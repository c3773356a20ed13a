"""docs/figures.md, which the benchmarks write: a section for each, with the command that measures it again."""

import os
import platform
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from types import ModuleType

import numpy as np

HERE = Path(__file__).resolve().parent
FILE = HERE.parent / "docs" / "figures.md"
HEAD = """# Figures

Written by `python3 benchmarks`, never by hand; `python3 benchmarks NAME --write` replaces one section. Medians of
interleaved rounds, peers in the same run. Absolute times are those of the machine that each section names; compare the
ratios.
"""
COMMAND = re.compile(r"^`python3 benchmarks (\w+)`", re.MULTILINE)


def known() -> list[str]:
    """Return the names of all benchmarks: files here with ``TITLE`` and ``measure() -> lines``."""
    return sorted(path.stem for path in HERE.glob("*.py") if "\nTITLE = " in path.read_text(encoding="utf-8"))


def section(name: str, module: ModuleType) -> Iterator[str]:
    """Yield the lines of a section while they are measured."""
    machine = (
        f"Python {platform.python_version()}, NumPy {np.__version__}, {os.cpu_count()} cores, {platform.machine()}"
    )
    yield from (f"## {module.TITLE}", "", f"`python3 benchmarks {name}`, {machine}", "")
    yield from module.measure()


def sections(text: str) -> dict[str, str]:
    """Return the sections of the file by the names of their benchmarks."""
    _, *parts = re.split(r"^(?=## )", text, flags=re.MULTILINE)
    commands = ((COMMAND.search(part), part) for part in parts)
    return {found[1]: part.strip() + "\n" for found, part in commands if found}


def written(old: Iterable[str], names: Iterable[str]) -> str:
    """Return the whole file with these sections, in the order of the names; others are left out."""
    there = sections("\n".join(old))
    return "\n".join([HEAD, *(there[name] for name in names if name in there)])


def keep(lines: Iterable[str]) -> None:
    """Put a section into the file, in place of the one that was there."""
    old = FILE.read_text(encoding="utf-8") if FILE.exists() else ""
    FILE.write_text(written([old, *lines], known()), encoding="utf-8")
