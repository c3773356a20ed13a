"""Files of a made-up bench with words of its own in lessons: a check, an action, a live value."""

COUNTED = '''
"""A made-up check of a bench: it was counted to a number."""
from armlab.content.check import PLAIN, CheckType

class Counted:
    observes = ("counting",)

    def __init__(self, to):
        self.to = to

    def is_met(self, observation):
        told = observation.benches.get("counting")
        return told is not None and told.value == self.to

    def says(self, observation, words=PLAIN):
        return f"Count to {self.to}."

CHECK = CheckType("counted", 201, lambda table, robot: Counted(table.number("to")))
'''

VOCABULARY = '''
"""Made-up words of lesson files: an action that counts, and a live value."""
from dataclasses import dataclass
from armlab.content.live_value import LiveValue, always
from armlab.content.vocabulary import Vocabulary

@dataclass(frozen=True)
class Count:
    to: int

    def says(self):
        return f"count to {self.to}"

def counted(observation, words):
    return str(observation.benches["counting"].value)

VOCABULARY = Vocabulary(
    "counting",
    actions={"count": lambda entry, robot: Count(entry.whole("to", 0, 99))},
    live={"counted": LiveValue(always, counted)},
)
'''

TAUGHT = '''
"""What lessons see of the made-up bench."""
from dataclasses import dataclass
from armlab.benches.made_up.made_up.job import JOB
from armlab.benches.made_up.made_up.state import CountTo, MadeUp
from armlab.benches.made_up.made_up.vocabulary import Count
from armlab.teaching.taught import Taught

@dataclass(frozen=True)
class Told:
    value: int

    def to_json(self):
        return {"value": self.value}

TAUGHT = Taught(
    "counting", MadeUp, "made_up", JOB,
    changed=lambda before, now: before[MadeUp] != now[MadeUp],
    ended=lambda before, now: True,
    seen=lambda state, played: Told(state[MadeUp].value),
    read=lambda data, where: Told(int(data["value"])),
    again=lambda data, told, robot: Told(MadeUp.from_json(data, robot).value),
    commands=lambda action, state: [CountTo(action.to)] if isinstance(action, Count) else [],
    mistakes=lambda action: [],
)
'''
