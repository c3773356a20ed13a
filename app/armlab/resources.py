"""Where robots and lessons lie: in the checkout's own folders, or inside the installed wheel.

An editable install leaves a stale copy of the data in site-packages, so a checkout is always read from its real
folders. All are `Traversable`, so a zipped installation works too.
"""

from __future__ import annotations

from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent


def checkout() -> Path | None:
    """Return the top of the source checkout this package runs from, or None for an installed one."""
    source_root = PACKAGE.parent
    top = source_root.parent
    return top if source_root.name == "app" and (top / "pyproject.toml").is_file() else None


def folder(name: str) -> Traversable:
    """Return the folder ``robots`` or ``lessons``, or one in it."""
    top = checkout()
    return top / name if top is not None else resources.files("armlab") / "_data" / name


def files(name: str, suffix: str) -> list[Traversable]:
    """Return the files of a data folder with this suffix, sorted by name."""
    place = folder(name)
    if not place.is_dir():
        return []
    found = (entry for entry in place.iterdir() if entry.name.endswith(suffix) and entry.is_file())
    return sorted(found, key=lambda entry: entry.name)
