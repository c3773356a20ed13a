"""The commands of ``armlab`` besides opening the lab: one file a command, each with a constant ``COMMAND``.

The modules import what they need only when they run: the lab starts without it.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import TextIO

from armlab.errors import ArmlabError, suggestion
from armlab.plugins import discover

STOPPED = 130
"""Exit status after Ctrl-C, as shells have it."""


@dataclass(frozen=True)
class CommandType:
    """One command, the constant ``COMMAND`` of a module in `armlab.commands`.

    Parameters
    ----------
    key : str
        As typed.
    order : int
        Place in the help.
    help : str
        What it does, in one line.
    add_arguments : callable
        Adds its arguments to a parser.
    run : callable
        ``run(options) -> int``: does it and returns the exit status. It may raise `ArmlabError` and `OSError`, of which
        a person sees one line.
    parts : tuple of CommandType
        What stands behind it where one word is not enough, as ``armlab lesson check``; it then does nothing itself.
    """

    key: str
    order: int
    help: str
    add_arguments: Callable[[argparse.ArgumentParser], None] = lambda parser: None
    run: Callable[[argparse.Namespace], int] = lambda options: 0
    parts: tuple[CommandType, ...] = ()


@cache
def command_types() -> dict[str, CommandType]:
    """Return all commands in order."""
    return discover(sys.modules[__name__], "COMMAND", CommandType)


def run_command(
    arguments: Sequence[str], types: Mapping[str, CommandType] | None = None, before: str = "armlab"
) -> int:
    """Run the command that the first argument names; return the exit status.

    Parameters
    ----------
    arguments : sequence of str
        At least one.
    types : mapping of str to CommandType, optional
        Those to choose from; all when left out.
    before : str
        What was typed before.
    """
    types, (name, *rest) = command_types() if types is None else types, arguments
    if name not in types:
        print(f"{before}: unknown command {name!r}{suggestion(name, types)}", file=sys.stderr)
        return 2
    command, typed = types[name], f"{before} {name}"
    if not command.parts:
        parser = argparse.ArgumentParser(prog=typed, description=command.help)
        command.add_arguments(parser)
        return _run(command, parser.parse_args(rest))
    parts = {part.key: part for part in command.parts}
    if rest and rest[0] not in ("-h", "--help"):
        return run_command(rest, parts, typed)
    print(f"{command.help}\n\n{listing(parts, typed)}", end="", file=sys.stdout if rest else sys.stderr)
    return 0 if rest else 2


def listing(types: Mapping[str, CommandType], before: str = "armlab") -> str:
    """Return the lines of the help that list commands."""
    shown = {
        f"{before} {' '.join(filter(None, (command.key, part)))}": text
        for command in types.values()
        for part, text in ([(each.key, each.help) for each in command.parts] or [("", command.help)])
    }
    width = max(map(len, shown), default=0)
    lines = [f"  {typed.ljust(width)}  {text}\n" for typed, text in shown.items()]
    return f"commands (each has --help):\n{''.join(lines)}"


def _prepare(stream: TextIO) -> None:
    """Let a stream take all letters: into a file they go as they are, and no terminal without them stops a command."""
    reconfigure = getattr(stream, "reconfigure", None)
    if reconfigure is None:
        return
    if stream.isatty() or "PYTHONIOENCODING" in os.environ:
        reconfigure(errors="replace")
    else:
        # Windows has neither minus signs nor Greek letters in files, unless it is told.
        reconfigure(encoding="utf-8", errors="replace")


def _run(command: CommandType, options: argparse.Namespace) -> int:
    """Run a command; of what a person can do wrong one line is said."""
    for stream in (sys.stdout, sys.stderr):
        _prepare(stream)
    try:
        status = command.run(options)
        sys.stdout.flush()
    except KeyboardInterrupt:
        print("armlab: stopped", file=sys.stderr)
        return STOPPED
    except BrokenPipeError:
        # The reader, such as `head`, has had enough; what is still in the buffer must not fail at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except OSError as error:
        where = f"{error.filename}: " if error.filename is not None else ""
        print(f"armlab: {where}{error.strerror or error}", file=sys.stderr)
        return 1
    except ArmlabError as error:
        print(f"armlab: {error}", file=sys.stderr)
        return 1
    return status
