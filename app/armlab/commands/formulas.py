"""``armlab formulas``: the formulas of the course on two pages A4."""

from __future__ import annotations

import argparse
from pathlib import Path

from armlab.commands import CommandType


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("--format", choices=("latex", "html"), default="latex", help="a document or a page to print")
    parser.add_argument("--out", type=Path, metavar="FILE", help="write it there, in place of printing it")


def run(options: argparse.Namespace) -> int:
    """Print or write the sheet; return 0."""
    from armlab.content.formulas import sheet

    if options.format == "latex":
        from armlab.content.formulas_latex import latex_sheet

        text = latex_sheet(sheet())
    else:
        from armlab.window.formulas_page import formulas_page

        text = formulas_page(sheet()) or ""
    if options.out is None:
        print(text, end="")
    else:
        options.out.write_text(text, encoding="utf-8")
    return 0


COMMAND = CommandType(
    "formulas", 50, "Print the formulas of the course on two pages: LaTeX, or a page to print.", add_arguments, run
)
