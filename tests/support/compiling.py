"""Test modules are compiled once, not once by each worker: pytest writes its assertions into each, which takes long."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

import pytest
from _pytest.assertion.rewrite import AssertionRewritingHook


def compile_in_turns(files: Sequence[Path], worker: int, workers: int) -> None:
    """Compile modules into the cache, but for those that are there: each worker begins where its part of them does.

    So it finds those of the others compiled when it comes to them. Without a cache nothing is gained, nor done.
    """
    hooks = [finder for finder in sys.meta_path if isinstance(finder, AssertionRewritingHook)]
    if not hooks or sys.dont_write_bytecode:
        return
    first = len(files) * worker // workers
    for file in [*files[first:], *files[:first]]:
        try:
            hooks[0].exec_module(Unrun(file))
        except Compiled:
            continue
        except SyntaxError:
            continue  # pytest says where when it comes to the file


def turns(config: pytest.Config) -> tuple[list[Path], int, int]:
    """Return the modules of the folders to be tested, and which of how many workers this is; none where it is none."""
    told = getattr(config, "workerinput", None)
    if told is None:
        return [], 0, 1
    folders = [Path(config.invocation_params.dir, argument) for argument in config.args]
    files = [file for folder in folders if folder.is_dir() for file in sorted(folder.rglob("test_*.py"))]
    return files, int(told["workerid"].removeprefix("gw")), told["workercount"]


class Compiled(Exception):
    """A module has been compiled; raised where it would be run."""


class Unrun:
    """A module to an importer, until it would be run."""

    def __init__(self, file: Path) -> None:
        self.__spec__ = importlib.util.spec_from_file_location(f"unrun.{file.stem}", file)
        self.__name__ = f"unrun.{file.stem}"

    @property
    def __dict__(self) -> NoReturn:  # type: ignore[override]
        raise Compiled
