"""``armlab lesson words``: what lessons can use of the benches, as the guide lists it."""

from __future__ import annotations

import argparse

from armlab.commands import CommandType


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("page", nargs="*", metavar="PAGE", help="such as velocity.statics; all when left out")


def run(options: argparse.Namespace) -> int:
    """Print commands, facts and examples as Markdown."""
    from armlab.commands._words import words_listed

    print(words_listed(options.page), end="")
    return 0


PART = CommandType("words", 40, "List commands, facts and examples of the benches for lessons.", add_arguments, run)
