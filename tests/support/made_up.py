"""Made-up files, one of each kind the lab grows by, and a program that looks whether all are there."""

from support.made_up_words import COUNTED, TAUGHT, VOCABULARY

PANEL = '''
"""A made-up panel."""
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.state import part_types
from armlab.ui.plugin import Panel

def build(gui, state, post):
    form = gui.form(post)
    def show(state):
        part = next((part for part in state if part.key == "made_up"), None)
        more = form.chip("made-more", "More", lambda: Set(type(part), "value", part.value + 1))
        form.show(f"made-up: {state[Joints].arm.n} joints, counted {part and part.value}", more)

    return show

PANEL = Panel(tuple(part_types()), build)
'''

ROBOT = """
name = "Made-up 1R"
family = "planar"
summary = "One joint."
convention = "standard"
source = "Made up for a test of the growing house."
[[joints]]
type = "R"
a = 1.0
limits_deg = [-90, 90]
[[poses]]
name = "home"
q_deg = [10]
[[expected]]
q_deg = [0]
position = [1, 0, 0]
source = "by hand"
[[expected]]
q_deg = [90]
position = [0, 1, 0]
source = "by hand"
"""

METHOD = '''
"""A made-up method: a tenth of the gradient."""
from armlab.kin.graph import vector as vec
from armlab.kin.ik.method import Method

def step(J, e, gain):
    return [gain * vec.dot(column, e) for column in vec.transpose(J)]

METHOD = Method("made_up", "made-up method", 9, step, gain=0.1)
'''

LAYER = '''
"""A made-up layer."""
from armlab.session.parts.joints import Joints
from armlab.ui.plugin import Layer

def build(canvas, state):
    canvas.scene.add_label(canvas.path("made_up"), "hello")
    return lambda state: None

LAYER = Layer("made_up", 99, (Joints,), build)
'''

PART = '''
"""A made-up part."""
from dataclasses import dataclass
from armlab.session.fields import FieldPart, whole
from armlab.session.state import Command, PartType

@dataclass(frozen=True)
class MadeUp(FieldPart):
    key = "made_up"
    value: int = whole("count", 3, 0, 99)

PART = PartType(MadeUp, order=50)

@dataclass(frozen=True)
class CountTo(Command):
    """Count to a number."""
    number: int

    def apply(self, state):
        return state.replace(MadeUp(self.number))
'''

FACT = '''
"""A made-up fact: how far was counted."""
from armlab.benches.made_up.made_up.state import MadeUp
from armlab.session.facts import Fact, Facts

FACTS = Facts(__name__, (MadeUp,), {"value": Fact("the number", lambda state: state[MadeUp].value, kind="count")})
'''

CHECK = '''
"""A made-up check: joint 1 is at its end."""
from armlab.content.check import PLAIN, CheckType

class MadeUp:
    def is_met(self, observation):
        return observation.q[0] > 3.0

    def says(self, observation, words=PLAIN):
        return f"Joint 1 is at {words.angle(observation.q[0])}."

CHECK = CheckType("made_up", 200, lambda table, robot: MadeUp())
'''

QUESTION = '''
"""A made-up question: say yes."""
from armlab.content.question import RIGHT, Field, QuestionType, Verdict

class MadeUp:
    def __init__(self, asked):
        self.html, self.hide = asked.html, asked.hide
        self.form, self.right_answer, self.wrong = Field(), "yes", ()

    def judge(self, text):
        return RIGHT if text == "yes" else Verdict(False, "Say yes.")

QUESTION = QuestionType("made_up", 200, lambda table, asked, to_html: MadeUp(asked))
'''

BENCH = '''
"""A made-up bench: one example, which moves joint 1."""
from types import SimpleNamespace
from armlab.session.bench import Bench
from armlab.session.parts.joints import MoveJoint

BENCH = Bench("made_up", 99, {"end": SimpleNamespace(title="The end")}, lambda key: MoveJoint(0, 1.0))
'''

COMMAND = '''
"""A made-up command."""
from armlab.commands import CommandType

def run(options):
    print("made-up", options.word)
    return 0

COMMAND = CommandType("made_up", 99, "say a word", lambda parser: parser.add_argument("word"), run)
'''

LESSON = """+++
title = "Made up"
chapter = "9"
teaches = ["S4.0-2R"]
robot = "planar_2r"
example = "made_up/end"
[[do]]
command = "made_up.made_up.count_to"
number = 5
+++
## One step
Turn.
```check
kind = "made_up"
```
```question
kind = "made_up"
text = "Well?"
```
```solution
q_deg = [178, 0]
```
## Count
It is {{made_up.made_up.value}}.
```check
kind = "fact"
fact = "made_up.made_up.value"
value = 7
```
```solution
[[do]]
command = "made_up.made_up.count_to"
number = 7
```
## Count in words of the bench
It is {{counted}}.
```check
kind = "counted"
to = 8
```
```solution
[[do]]
kind = "count"
to = 8
```
"""

CLIP = '''
"""A made-up film: two seconds of nothing."""
from armlab.session.parts.timeline import Clip

CLIP = Clip("made_up", "Made-up film", lambda state: 2.0, lambda state: (), lambda state, time: state)
'''

JOB = '''
"""A made-up long work: it counts to three while its panel is open."""
from dataclasses import replace
from armlab.session.job import Job, Wanted
from armlab.benches.made_up.made_up.state import MadeUp

def delivered(state, inputs, found):
    return state.replace(replace(state[MadeUp], value=found))

JOB = Job("made_up", "The counting", lambda state, panels: Wanted(0, 0) if "made_up" in panels else None,
          lambda inputs: iter([1, 2, 33]), delivered)
'''

ITERATION = '''
"""A made-up way to iterate: a tenth of the gradient."""
from armlab.kin.ik.iterate.method import IterationMethod, Move

def step(problem, point, parameters, memory):
    return Move(0.1 * point.slope)

ITERATION = IterationMethod("made_up", "made-up steps", 99, step)
'''

CLOSED = '''
"""A made-up closed form: for the arm of one joint that was made up."""
import numpy as np
from armlab.kin.ik.closed_form import ClosedForm, Found

def solve(arm, T):
    return Found([np.array([np.arctan2(T[1, 3], T[0, 3])])])

def fits(arm):
    return "It was made up." if arm.name == "Made-up 1R" else None

CLOSED = ClosedForm("made_up", "Made-up form", 1, fits, solve)
'''

LOOK = """
import asyncio
from support.fake_browser import FakeBrowser, cookie_of
from support.lab import running_lab
import armlab
from armlab.cli import main as main_of
from armlab.session.parts.timeline import clips
from armlab.content.lessons import lesson
from armlab.session.facts import fact_of
from armlab.session.parts.joints import Joints
from armlab.teaching.play import Player, problems
from armlab.teaching.seen_again import seen_again
from armlab.session.state import part_types

async def main(url):
    browser = FakeBrowser(url, cookie_of(url))
    await browser.connect()
    await browser.until(lambda: "al-notes" in browser.html())
    await browser.open("made_up", "target", "robot")
    await browser.until(lambda: "made-up: 6 joints, counted 33<" in browser.html())
    await browser.until(lambda: any(c["props"].get("label") == "Family" for c in browser.controls.values()))
    method = next(c for c in browser.controls.values() if c["props"].get("label") == "Method")
    assert "Made-up method" in method["props"]["options"], method
    family = next(c for c in browser.controls.values() if c["props"].get("label") == "Family")
    await browser.set_value(family, "Planar")
    await browser.until(lambda: 'data-cell="made_up"' in browser.html())
    await browser.press("made-more")
    await browser.until(lambda: "counted 34" in browser.html())
    await browser.press("made_up")
    await browser.until(lambda: "made-up: 1 joints" in browser.html())
    await browser.close()

with running_lab() as url:
    asyncio.run(main(url))
assert "made_up" in armlab.robots()
arm = armlab.load("planar_2r")
result = armlab.ik.solve(arm, arm.fk([0.4, 0.9]), q0=[0.4, 0.8], method="made_up")
assert result.position_error < 0.2
assert armlab.ik.iterate(arm, arm.fk([0.4, 0.9]), [0.4, 0.8], "made_up").position_error[-1] < 0.01
made_up = armlab.load("made_up")
assert armlab.ik.solve_all(made_up, made_up.fk([0.4])).method == "made_up"
assert "made_up" in [kind.key for kind in part_types()]
assert "made_up" in clips()
assert problems("made_up") == [], problems("made_up")
begun = Player(lesson("made_up")).session.state
assert begun[Joints].q[0] == 1.0
assert fact_of("made_up.made_up.value")[1].now(begun).value == 5.0
player = Player(lesson("made_up"))
player.go_to(2)
assert [player.act(action) for action in player.lesson.steps[2].solution] == [""]
(evidence,) = player.part.progress.evidence.values()
assert seen_again({**evidence, "counting": {"value": 3}}, player.lesson.robot_used).benches["counting"].value == 8
assert main_of(["lesson", "sheet", "lessons/made_up.md"]) == 0
assert main_of(["made_up", "word"]) == 0
from armlab.front.page import make_page
assert b".b-made_up {" in make_page().html
print("grown")
"""

PACKAGES = ("made_up", "made_up/made_up", "made_up/made_up/ui")
BENCH_FOLDER = "app/armlab/benches/made_up/made_up"

STYLE = ".made-up { color: rgb(1, 2, 3); }\n"

PAGE = """
from armlab.page import Page

PAGE = Page(__name__, "made_up", "Made up", "STAR", 50)
"""

FILES = {
    **{f"app/armlab/benches/{folder}/__init__.py": '"""Made up."""' for folder in PACKAGES},
    f"{BENCH_FOLDER}/__init__.py": PAGE,
    f"{BENCH_FOLDER}/style.css": STYLE,
    f"{BENCH_FOLDER}/ui/page.py": PANEL,
    f"{BENCH_FOLDER}/ui/scene.py": LAYER,
    "app/armlab/kin/ik/methods/made_up.py": METHOD,
    "app/armlab/kin/ik/iterate/methods/made_up.py": ITERATION,
    "app/armlab/kin/ik/closed/made_up.py": CLOSED,
    f"{BENCH_FOLDER}/state.py": PART,
    f"{BENCH_FOLDER}/facts.py": FACT,
    f"{BENCH_FOLDER}/job.py": JOB,
    f"{BENCH_FOLDER}/clip.py": CLIP,
    f"{BENCH_FOLDER}/check_counted.py": COUNTED,
    f"{BENCH_FOLDER}/vocabulary.py": VOCABULARY,
    f"{BENCH_FOLDER}/lesson.py": TAUGHT,
    f"{BENCH_FOLDER}/examples.py": BENCH,
    "app/armlab/content/checks/made_up.py": CHECK,
    "app/armlab/content/questions/made_up.py": QUESTION,
    "app/armlab/commands/made_up.py": COMMAND,
    "robots/made_up.toml": ROBOT,
    "lessons/made_up.md": LESSON,
}
