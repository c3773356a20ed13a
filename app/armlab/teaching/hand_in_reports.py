"""Reports on the work of a class: a table to read, rows for a spreadsheet, results for Gradescope."""

from __future__ import annotations

import csv
import datetime
import io
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from armlab.session.state import Json
from armlab.teaching.hand_in import Report, StepReport

DONE, NOTED, NOT_DONE, NOTHING = "ok", "noted", "no", "-"
"""Marks of a step in the table; a noted step is done according to the file, which does not prove it."""

LAST_HINT = "+hint"
"""Addition to the mark of a step that is done, but of which the last hint was shown."""

FORMULA = tuple("=+-@\t\r＝＋－＠")
"""First characters that make a spreadsheet take a text for a formula."""

COLUMNS = ("file", "student", "lesson", "variant", "changed", "passed", "count", "score", "same as")
OF_ASSIGNMENT = ("points", "of", "version", "attempt", "begun", "handed in", "late min", "left")
OF_STEP = ("passed", "hints", "says")


@dataclass(frozen=True)
class Judged:
    """A file and the verdict on it.

    Attributes
    ----------
    file : str
        Its name in reports.
    report : Report or None
        None when it cannot be judged.
    problem : str
        Why it cannot be judged, or does not count: nothing of it is done then.
    same_as : tuple of str
        Files with which it agrees to the last digit.
    student : str
        The student of a list of whom there is no file.
    """

    file: str
    report: Report | None
    problem: str = ""
    same_as: tuple[str, ...] = ()
    student: str = ""

    @property
    def name(self) -> str:
        """The student's name, or the file name of unsigned work."""
        return (self.report.student if self.report else self.student) or self.file

    @property
    def passed(self) -> int:
        """Number of steps with a task that are done."""
        return 0 if self.report is None or self.problem else self.report.passed

    @property
    def points(self) -> float:
        """Points of the steps that are done; in a lesson one for each."""
        return 0.0 if self.report is None or self.problem else self.report.points

    @property
    def remark(self) -> str:
        """Remark for the teacher besides the verdicts."""
        same = f"Agrees to the last digit with {', '.join(self.same_as)}." if self.same_as else ""
        handed = self.report.handed if self.report is not None else None
        what = "lesson" if handed is None else "assignment"
        changed = f"The {what} has changed since." if self.report is not None and self.report.changed else ""
        return " ".join(filter(None, (self.problem, handed.remark if handed else "", same, changed)))


def table(judged: Sequence[Judged], details: bool = False) -> str:
    """Return one line for each student with a mark for each step, and what is missing if ``details``; plain text.

    The table of an assignment holds the attempt, the hints that were shown, and the score in points, too. Who has
    handed in nothing has a line; a file that cannot be judged has none.
    """
    found = [(one, one.report) for one in judged if one.report is not None]
    if not any(one.report is not None or one.student for one in judged):
        return ""
    labels = max(([step.label for step in report.steps] for _, report in found), key=len, default=[])
    whole = any(report.handed is not None for _, report in found)
    lines = [["student", "variant", *labels, *(("attempt", "hints") if whole else ()), "score", ""]]
    for one in judged:
        if one.report is not None:
            lines.append([one.name, *_line(one, one.report, len(labels), whole), one.remark])
        elif one.student:
            lines.append([one.student, *[""] * (len(lines[0]) - 2), one.remark])
    text = _aligned(lines) + _on_hints([report for _, report in found])
    if details:
        text += "".join(f"\n{''.join(_details(one.name, report))}" for one, report in found)
    return text


def _line(one: Judged, report: Report, most: int, whole: bool) -> list[str]:
    """Return what stands in the table between the name and the remark."""
    marks = [_mark(step) for step in report.steps] + [""] * (most - len(report.steps))
    noted = [str(report.handed.attempt), str(report.hints)] if report.handed else [""] * 2 * whole
    return [str(report.variant), *marks, *noted, _score(one, report)]


def rows(judged: Sequence[Judged]) -> str:
    """Return comma-separated values that are safe to open in a spreadsheet, one row a file or student without one.

    Columns: `COLUMNS` with the score in whole percent, of an assignment `OF_ASSIGNMENT` with times in UTC, then for
    each step `OF_STEP` (``passed`` is empty where there is nothing to do), of an assignment with its points, then
    ``problem``, why a file cannot be judged or does not count.
    """
    reports = [one.report for one in judged if one.report]
    labels = max(([step.label for step in report.steps] for report in reports), key=len, default=[])
    whole = any(report.handed is not None for report in reports)
    columns, of_step = (*COLUMNS, *OF_ASSIGNMENT * whole), (*OF_STEP, *("points",) * whole)
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([*columns, *(f"{label} {name}" for label in labels for name in of_step), "problem"])
    for one in judged:
        cells = [one.file, *(_cells(one, one.report) if one.report else [one.student])]
        cells += [""] * (len(columns) + len(of_step) * len(labels) - len(cells))
        writer.writerow([_safe(cell) for cell in (*cells, one.problem)])
    return out.getvalue()


def gradescope(judged: Judged) -> Json:
    """Return the content of ``results.json`` for Gradescope: the points of the steps, in a lesson one for each."""
    report = judged.report
    if report is None:
        return {"score": 0.0, "output": judged.problem, "output_format": "text", "tests": []}
    unit = "steps" if report.handed is None else "points"
    words = [f"{report.title}, variant {report.variant}: {_score(judged, report)} {unit}.", judged.remark]
    return {
        "score": judged.points,
        "output": " ".join(filter(None, words)),
        "output_format": "text",
        "tests": [
            {
                "name": f"{step.label} {step.title}",
                "score": step.earned * (not judged.problem),
                "max_score": step.points,
                "output": step.says,
                "output_format": "text",
                "status": "passed" if step.passed and not judged.problem else "failed",
            }
            for step in report.steps
            if step.counts
        ],
    }


def _mark(step: StepReport) -> str:
    if not step.counts:
        return NOTHING
    if not step.passed:
        return NOT_DONE
    return f"{NOTED if step.noted else DONE}{LAST_HINT if step.last_hint else ''}"


def _on_hints(reports: Sequence[Report]) -> str:
    """Return a line on what the last hint costs; empty where nobody has seen one."""
    if not any(step.last_hint and step.passed for report in reports for step in report.steps):
        return ""
    handed = reports[0].handed
    percent = 0.0 if handed is None else handed.of.last_hint_percent
    cost = f"costs {percent:g} % of the points of the step" if percent else "costs no points"
    return f"{LAST_HINT}: the last hint of the step was shown, which {cost}.\n"


def _score(one: Judged, report: Report) -> str:
    return f"{round(one.points, 2):g} of {round(report.most, 2):g}"


def _details(name: str, report: Report) -> Iterator[str]:
    """Yield lines on what is not done, and on all answers."""
    yield f"{name}\n"
    for step in report.steps:
        if not step.counts:
            continue
        hints = f", {step.hints} hint{'s' if step.hints > 1 else ''}" if step.hints else ""
        yield f"  Step {step.label}, {step.title}: {'done' if step.passed else 'not done'}{hints}\n"
        if step.says:
            yield f"    {step.says}\n"


def _aligned(lines: Sequence[Sequence[str]]) -> str:
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    padded = ("  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)) for line in lines)
    return "".join(f"{line.rstrip()}\n" for line in padded)


def _cells(one: Judged, report: Report) -> list[str | int | float]:
    score: str | int = round(100 * one.points / report.most) if report.most else ""
    changed = "yes" if report.changed else "no"
    cells: list[str | int | float] = [report.student, report.lesson, report.variant, changed]
    cells += [one.passed, report.count, score, " ".join(one.same_as)]
    handed = report.handed
    if handed is not None:
        cells += [round(one.points, 2), round(report.most, 2), handed.of.version, handed.attempt]
        cells += [_utc(handed.begun), _utc(handed.handed), math.ceil(handed.late / 60.0), handed.left]
    for step in report.steps:
        cells += [("yes" if step.passed else "no") if step.counts else "", step.hints, step.says]
        cells += [] if handed is None else [round(step.earned, 2) if step.counts else ""]
    return cells


def _utc(moment: float) -> str:
    return f"{datetime.datetime.fromtimestamp(moment, datetime.UTC):%Y-%m-%d %H:%M:%S}"


def _safe(cell: str | int | float) -> str | int | float:
    """Return a cell that no spreadsheet takes for a formula: one that looks like it gets an apostrophe in front."""
    return f"'{cell}" if isinstance(cell, str) and cell.startswith(FORMULA) else cell
