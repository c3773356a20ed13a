"""Comparison of the hand-ins of a class: copied work, variants that were not assigned, and the attempt that counts."""

from __future__ import annotations

import unicodedata
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence, Set
from dataclasses import replace

from armlab.teaching.hand_in import Report
from armlab.teaching.hand_in_reports import Judged

NOTHING_HANDED_IN = "Nothing handed in."
"""The reason why there is no work of a student of the list."""


def looked_at_together(judged: Sequence[Judged], students: Mapping[int, str] | None = None) -> list[Judged]:
    """Return the verdicts with marks: work that agrees with another's to the last digit, and another's variant.

    Parameters
    ----------
    judged : sequence of Judged
    students : mapping of int to str, optional
        Names by the variant that each was given. Work in another variant, or of somebody else, does not count.
        Students of the same name are told apart by their variants.
    """
    shared = _shared(students or {})
    prints: list[frozenset[str]] = [frozenset() if one.report is None else one.report.prints for one in judged]
    having: dict[str, list[int]] = defaultdict(list)
    for i, each in enumerate(prints):
        for found in each:
            having[found].append(i)
    marked = []
    for i, (one, each) in enumerate(zip(judged, prints, strict=True)):
        others = sorted({k for found in each for k in having[found]} - {i})
        others = [k for k in others if not _attempts_of_one(one.report, judged[k].report, shared)]
        problem = one.problem
        if one.report is not None:
            problem = one.report.handed.problem if one.report.handed is not None else ""
            problem = problem or (_not_assigned(one.report, students) if students is not None else "")
        marked.append(replace(one, problem=problem, same_as=tuple(judged[k].file for k in others)))
    return _last_attempts(marked, shared)


def by_list(judged: Sequence[Judged], students: Mapping[int, str]) -> list[Judged]:
    """Return one verdict for each student of a list, in its order, and behind them all others in theirs.

    A student who has handed in nothing has a verdict, too. The place in the list belongs to the file that counts; where
    none of a student does, to the last attempt.

    Parameters
    ----------
    judged : sequence of Judged
        As `looked_at_together` returns them.
    students : mapping of int to str
        Names by the variant that each was given.
    """
    shared = _shared(students)
    best: dict[tuple[str, int | None, str], Judged] = {}
    for one in judged:
        if one.report is not None and one.report.student:
            who = _who(one.report, shared)
            # Of two of one name each has a file where no variant and no attempt tells whose it is.
            of_either = who[1] is not None and not one.report.varies and one.report.handed is None
            key = (*who, one.file if of_either else "")
            best[key] = max(best.get(key, one), one, key=lambda each: (not each.problem, _attempt(each)))
    listed = []
    for number, student in students.items():
        own = sorted(_keys_of(best, _plain(student), number), key=lambda key: key[1] != number)
        listed.append(best.pop(own[0]) if own else Judged("", None, NOTHING_HANDED_IN, student=student))
    taken = {id(one) for one in listed}
    return [*listed, *(one for one in judged if id(one) not in taken)]


def _keys_of(
    best: Mapping[tuple[str, int | None, str], Judged], name: str, number: int
) -> list[tuple[str, int | None, str]]:
    """Return the keys of all that may be of a student: of one name with others, what has the variant or has none."""
    return [
        key
        for key, one in best.items()
        if key[0] == name and (key[1] in (None, number) or (one.report is not None and not one.report.varies))
    ]


def _attempts_of_one(one: Report | None, other: Report | None, shared: Set[str]) -> bool:
    """Return whether both are attempts of one student at an assignment, of which one goes on from the other."""
    if one is None or other is None or one.handed is None or other.handed is None:
        return False
    return bool(one.student) and _who(one, shared) == _who(other, shared)


def _shared(students: Mapping[int, str]) -> frozenset[str]:
    """Return the names that several students have."""
    counts = Counter(map(_plain, students.values()))
    return frozenset(name for name, count in counts.items() if count > 1)


def _who(report: Report, shared: Set[str]) -> tuple[str, int | None]:
    """Return what tells a student from the others: the name, with the variant where several have it."""
    name = _plain(report.student)
    return name, report.variant if name in shared else None


def _last_attempts(judged: Sequence[Judged], shared: Set[str]) -> list[Judged]:
    """Return the verdicts with all but the last attempt of each student marked as not counting."""
    last: dict[tuple[str, int | None], Judged] = {}
    for one in judged:
        if one.report is not None and not one.problem and one.report.handed is not None and one.report.student:
            who = _who(one.report, shared)
            last[who] = max(last.get(who, one), one, key=_attempt)
    return [replace(one, problem=_earlier(one, last, shared)) for one in judged]


def _attempt(one: Judged) -> tuple[int, float]:
    handed = one.report.handed if one.report is not None else None
    return (0, 0.0) if handed is None else (handed.attempt, handed.handed)


def _earlier(one: Judged, last: Mapping[tuple[str, int | None], Judged], shared: Set[str]) -> str:
    """Return the reason why the work does not count; that it is an earlier attempt where there was none."""
    if one.problem or one.report is None or one.report.handed is None:
        return one.problem
    counts = last.get(_who(one.report, shared), one)
    return "" if counts is one else f"Another attempt counts: {counts.file}."


def _not_assigned(report: Report, students: Mapping[int, str]) -> str:
    """Return the reason why the work is not the one assigned to the student; empty when it is."""
    name = _plain(report.student)
    given = [number for number, student in students.items() if _plain(student) == name]
    if not given:
        return "There is nobody of this name in the list." if name else "The work is not signed."
    if not report.varies or report.variant in given:
        return ""
    return f"This is variant {report.variant}; the one given was {' or '.join(map(str, given))}."


def _plain(name: str) -> str:
    # An accent is a letter with its mark on one computer, and two signs in a row on another.
    return unicodedata.normalize("NFC", " ".join(name.split()).casefold())
