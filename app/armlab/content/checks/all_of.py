"""Several checks that have to be met at the same time."""

from __future__ import annotations

from dataclasses import dataclass

from armlab.content.check import PLAIN, Check, CheckType, Goal, Words, check_types, read_check
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot


@dataclass(frozen=True, eq=False)
class AllOf:
    """All of these checks."""

    checks: tuple[Check, ...]

    @property
    def of_table(self) -> bool:
        """Whether one of the checks is about the table."""
        return any(getattr(check, "of_table", False) for check in self.checks)

    @property
    def observes(self) -> tuple[str, ...]:
        """Keys of benches of which the checks look at what they tell."""
        return tuple(key for check in self.checks for key in getattr(check, "observes", ()))

    @property
    def facts(self) -> tuple[str, ...]:
        """Words of the facts of benches that the checks use."""
        return tuple(word for check in self.checks for word in getattr(check, "facts", ()))

    @property
    def noted(self) -> tuple[str, ...]:
        """Conditions of the checks that no file proves."""
        return tuple(name for check in self.checks for name in getattr(check, "noted", ()))

    @property
    def panels(self) -> tuple[str, ...]:
        """Keys of the panels that they ask to open."""
        return tuple(key for check in self.checks for key in getattr(check, "panels", ()))

    @property
    def switches(self) -> tuple[str, ...]:
        """Names of the switches that they look at."""
        return tuple(name for check in self.checks for name in getattr(check, "switches", ()))

    @property
    def goals(self) -> tuple[Goal, ...]:
        """Goals of the checks that are marked in the scene."""
        return tuple(goal for check in self.checks for goal in getattr(check, "goals", ()))

    def is_met(self, observation: Observation) -> bool:
        """Return whether all checks are met."""
        return all(check.is_met(observation) for check in self.checks)

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return the sentence of the first check that is not met."""
        for check in self.checks:
            if not check.is_met(observation):
                return check.says(observation, words)
        return " ".join(dict.fromkeys(check.says(observation, words) for check in self.checks))


def read(table: Table, robot: Robot) -> AllOf:
    """Read tables ``checks``, each with ``kind`` and its fields; an ``all_of`` must not be among them."""
    entries = table.tables("checks")
    if len(entries) < 2:
        raise table.fail("checks", f"expected at least two tables [[checks]], got {len(entries)}")
    kinds = check_types()
    for entry in entries:
        if entry.choice("kind", kinds) == CHECK.key:
            raise entry.fail("kind", f"{CHECK.key!r} cannot stand in itself; put all checks into one list")
    if not any(kinds[entry.choice("kind", kinds)].alone for entry in entries):
        raise table.fail("checks", "expected one that asks more than time")
    found = AllOf(tuple(read_check(entry, robot) for entry in entries))
    if found.of_table and found.facts:
        raise table.fail("checks", "a fact of a bench is judged with the arm of the lesson, not with an edited table")
    return found


CHECK = CheckType("all_of", 100, read)
