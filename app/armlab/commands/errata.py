"""``armlab errata``: the errata of the course notes, with both forms run, to print or to read."""

from __future__ import annotations

import argparse
from pathlib import Path

from armlab.commands import CommandType


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("erratum", nargs="*", metavar="ID", help="such as 5.58; all when left out")
    parser.add_argument("--format", choices=("markdown", "html"), default="markdown", help="a list or a page to print")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of the 20 points (1)")
    parser.add_argument("--out", type=Path, metavar="FILE", help="write it there, in place of printing it")


def run(options: argparse.Namespace) -> int:
    """Print or write the list; return 0."""
    from armlab.content.errata import erratum
    from armlab.content.errata_sheet import sheet
    from armlab.kin.checks import whole_number

    keys = tuple(erratum(key).id for key in options.erratum)
    text = sheet(options.format, whole_number(options.seed, "--seed", 0), keys)
    if options.out is None:
        print(text, end="")
    else:
        options.out.write_text(text, encoding="utf-8")
    return 0


COMMAND = CommandType(
    "errata", 40, "Print the errata of the course notes: printed and correct, with both forms run.", add_arguments, run
)
