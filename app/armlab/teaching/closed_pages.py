"""The pages that an assignment closes."""

from __future__ import annotations

from armlab.content.assignment import Assignment
from armlab.content.lesson import Lesson
from armlab.session.facts import benches_of
from armlab.session.pages import pages


def closed_pages(found: Lesson, assigned: Assignment) -> frozenset[str]:
    """Return the keys of the pages that an assignment closes while a lesson of it is open.

    The pages that the lesson opens, or needs for its checks, stay open.
    """
    if assigned.pages is None:
        return frozenset()
    checks = [step.check for step in found.steps if step.check is not None]
    of_facts = (bench.panel for check in checks for bench in benches_of(check.facts))
    of_checks = (panel for check in checks for panel in check.panels)
    needed = {found.panel, *(step.panel for step in found.steps), *of_checks, *of_facts}
    return frozenset(pages().keys() - assigned.pages - needed)
