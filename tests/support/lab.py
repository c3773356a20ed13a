"""A whole lab for a test: front and viser in this process, sessions in a temporary folder."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from copy import copy
from functools import cache
from pathlib import Path

from armlab.content import lessons as lessons_module
from armlab.front.start import Running, Settings, start
from support.at_rest import OPEN


@contextmanager
def running_lab(
    folder: Path | None = None, opening: str = "puma560", labs: int = 0, lessons: Path | None = None, key: str = ""
) -> Iterator[str]:
    """Open a lab on a free port, with a teacher's folder of lessons, and key, if one is given; yields its address."""
    with nullcontext() if lessons is None else library_for_itself():
        lab = open_lab(folder, opening, labs, lessons=lessons, key=key)
        try:
            yield f"http://127.0.0.1:{lab.port}/"
        finally:
            lab.stop()


@contextmanager
def library_for_itself() -> Iterator[None]:
    """Let what is done to the library of this process pass with the end of the block; nothing is read twice for it."""
    shared = lessons_module._library
    own = copy(shared())
    for name in ("_folders", "_entries", "_good", "_courses", "_assignments"):
        setattr(own, name, copy(getattr(own, name)))
    lessons_module._library = cache(lambda: own)
    lessons_module._library()
    try:
        yield
    finally:
        lessons_module._library = shared


def open_lab(
    folder: Path | None = None,
    opening: str = "puma560",
    labs: int = 0,
    port: int = 0,
    lessons: Path | None = None,
    key: str = "",
) -> Running:
    """Open a lab on a free port, or on this one."""
    own = (lessons,) if lessons is not None else ()
    lab = start(Settings("127.0.0.1", [port], opening, folder, labs, own, teacher_key=key))
    OPEN.add(lab)
    return lab
