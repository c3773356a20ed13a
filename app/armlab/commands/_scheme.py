"""The marking scheme of an assignment as Markdown: its conditions, and the points of each step."""

from __future__ import annotations

from collections.abc import Iterator

from armlab.commands._sheet import escaped
from armlab.content.assignment import Assignment, said_date
from armlab.content.lesson_head import time_said
from armlab.content.lessons import lessons


def scheme(found: Assignment) -> str:
    """Return the scheme, the head of the solutions of an assignment."""
    lines = [f"# {escaped(found.title)}: marking scheme and solutions", ""]
    lines += [escaped(found.about), ""] if found.about else []
    own = f"`/assignment/{found.key}/7` opens it in variant 7." if found.by_student else ""
    lines += [" ".join(filter(None, (f"Assignment `{found.key}`, version {found.version}.", *conditions(found), own)))]
    lines += ["", "| step | what is asked | points | hints | the last one costs |", "| --- | --- | --- | --- | --- |"]
    most = 0.0
    for i, task in enumerate(found.tasks, start=1):
        lesson = lessons()[task.lesson]
        for k, (step, points) in enumerate(zip(lesson.steps, task.points_of(lesson), strict=True), start=1):
            most += points
            if step.check is not None or step.question is not None:
                count = len(step.hints) if found.hints else 0
                costs = f"{round(found.lost(points, step, count), 2):g}" if count else ""
                asked = f"{escaped(lesson.title)}: {escaped(step.title)}"
                lines.append(f"| {i}.{k} | {asked} | {round(points, 2):g} | {count or ''} | {costs} |")
    lines.append(f"| | all | {round(most, 2):g} | | |")
    return "".join(f"{line}\n" for line in lines)


def conditions(found: Assignment) -> Iterator[str]:
    """Yield a sentence for each condition of an assignment."""
    if found.exam:
        yield "An exam: no hints, no verdicts until it is handed in, and of each step what stands last counts."
    elif not found.hints:
        yield "No hints."
    else:
        costs = f"costs {found.last_hint_percent:g} % of its points" if found.last_hint_percent else "costs no points"
        yield f"The last hint of a step {costs}; the table of `armlab check` marks where it was shown."
    if found.opens is not None:
        yield f"It opens on {said_date(found.opens)}."
    if found.due is not None:
        yield f"It is due on {said_date(found.due)}."
    if found.closes is not None and found.closes != found.due:
        closes = "It closes on" if found.due is None else "Late work is accepted until"
        yield f"{closes} {said_date(found.closes)}."
    if found.late_percent:
        yield f"Late work loses {found.late_percent:g} % of its points."
    if found.minutes:
        yield f"{time_said(found.minutes)} from its beginning."
    if found.attempts:
        yield f"It can be handed in {'once' if found.attempts == 1 else f'{found.attempts} times'}."
