r"""The sheet of formulas as a LaTeX document of two pages A4, which needs amsmath, geometry and multicol."""

from __future__ import annotations

from collections.abc import Iterator

from armlab.content.formulas import Formula, Sheet

TITLE = "Formulas"

HEAD = r"""\documentclass[a4paper,10pt]{article}
\usepackage[utf8]{inputenc}
\usepackage[T1]{fontenc}
\usepackage[margin=8mm]{geometry}
\usepackage{amsmath,amssymb,multicol}
\pagestyle{empty}
\setlength{\parindent}{0pt}
\setlength{\parskip}{1.6pt}
\setlength{\columnsep}{10pt}
\setlength{\columnseprule}{0.2pt}
\setlength{\arraycolsep}{2pt}
\sloppy
\raggedright
\newcommand{\chapterline}[1]{\par\vspace{3pt}{\small\textbf{#1}}\par\vspace{-4pt}\rule{\linewidth}{0.4pt}\par}
\newcommand{\name}[1]{\textit{#1}\quad}
\newcommand{\formula}[1]{\mbox{$\displaystyle #1$}\hspace{0.8em plus 1em}}
\begin{document}
\footnotesize
"""

FOOT = r"""\end{document}
"""

_SIGNS = str.maketrans({"–": "--", "#": r"\#", "%": r"\%", "&": r"\&", "_": r"\_"})
"""Signs that LaTeX writes otherwise in a text."""


def latex_sheet(sheet: Sheet) -> str:
    """Return the sheet as a document."""
    return HEAD + "\n".join(_lines(sheet)) + "\n" + FOOT


def _lines(sheet: Sheet) -> Iterator[str]:
    for number, page in enumerate(sheet.pages):
        yield r"\newpage" if number else rf"{{\normalsize\textbf{{{TITLE}}}}}\quad {_text(sheet.about)}\par"
        yield r"\begin{multicols*}{2}"
        for title, formulas in page.items():
            yield rf"\chapterline{{{_text(title)}}}"
            yield from map(_formula, formulas)
        yield r"\end{multicols*}"


def _formula(formula: Formula) -> str:
    shown = " ".join(rf"\formula{{{tex}}}" for tex in formula.tex)
    return rf"\name{{{_text(formula.name)}}} {shown} {_text(formula.note)}".rstrip() + r"\par"


def _text(text: str) -> str:
    """Return a text with its formulas, which stay as they are between dollars."""
    parts = text.split("$")
    return "$".join(part if i % 2 else part.translate(_SIGNS) for i, part in enumerate(parts))
