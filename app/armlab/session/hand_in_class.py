"""Comparison of the hand-ins of a class: copied work, and variants that were not assigned."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import replace

from armlab.content.lessons import lessons
from armlab.session.hand_in import Report
from armlab.session.hand_in_reports import Judged


def looked_at_together(judged: Sequence[Judged], students: Mapping[int, str] | None = None) -> list[Judged]:
    """Return the verdicts with marks: work that agrees with another's to the last digit, and another's variant.

    Parameters
    ----------
    judged : sequence of Judged
    students : mapping of int to str, optional
        Names by the variant that each was given. Work in another variant, or of somebody else, does not count.
    """
    prints: list[frozenset[str]] = [frozenset() if one.report is None else one.report.prints for one in judged]
    having: dict[str, list[int]] = defaultdict(list)
    for i, each in enumerate(prints):
        for found in each:
            having[found].append(i)
    marked = []
    for i, (one, each) in enumerate(zip(judged, prints, strict=True)):
        others = sorted({k for found in each for k in having[found]} - {i})
        problem = one.problem
        if one.report is not None and students is not None:
            problem = _not_assigned(one.report, students)
        marked.append(replace(one, problem=problem, same_as=tuple(judged[k].file for k in others)))
    return marked


def _not_assigned(report: Report, students: Mapping[int, str]) -> str:
    """Return the reason why the work is not the one assigned to the student; empty when it is."""
    name = _plain(report.student)
    given = [number for number, student in students.items() if _plain(student) == name]
    if not given:
        return "There is nobody of this name in the list." if name else "The work is not signed."
    if not lessons()[report.lesson].varies or report.variant in given:
        return ""
    return f"This is variant {report.variant}; the one given was {' or '.join(map(str, given))}."


def _plain(name: str) -> str:
    return " ".join(name.split()).casefold()
