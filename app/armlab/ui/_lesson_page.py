"""What the lesson's dock holds: choice of lesson, text of the step, what is missing, question, way on."""

from __future__ import annotations

import logging
from itertools import groupby

from armlab.content.check import Words
from armlab.content.lessons import Lesson, lessons
from armlab.content.questions import Question
from armlab.content.robots import catalogue
from armlab.session.parts.lesson import (
    Answer,
    CloseLesson,
    GoToStep,
    LessonPart,
    OpenLesson,
    Progress,
    TakeLessonArm,
    check_line,
    has_its_arm,
)
from armlab.session.state import Command, State
from armlab.ui.format import escaped
from armlab.ui.plugin import Post
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

log = logging.getLogger(__name__)

UNIT_SIGNS = {"deg": "°", "m^2": "m²", "cm^2": "cm²", "mm^2": "mm²", "Nm": "N m"}
"""How units are written where they are not so in lesson files."""

STEP = "lesson-step-"


class LessonPage:
    """The page. Each piece is rewritten by itself, so that a moving arm takes no text out of the field of an answer.

    Parameters
    ----------
    gui : Gui
    post : callable
    """

    def __init__(self, gui: Gui, post: Post) -> None:
        self._gui, self._post = gui, post
        self._state: State | None = None
        self._head = gui.fields(self._pressed)
        self._text = gui.html()
        self._task = gui.fields(self._pressed)
        self._question = gui.fields(self._pressed)
        self._foot = gui.fields(self._pressed)

    def show(self, state: State) -> None:
        """Show the open lesson of a state."""
        part = state[LessonPart]
        lesson, step, progress = part.lesson, part.step, part.progress
        if lesson is None or step is None:
            return
        self._state = state
        channel = self._head.channel_id
        self._head.show(_choice(lesson, channel) + _strips(lesson, progress, channel))
        self._text.show(_text(lesson, progress.step))
        self._task.show(_task(state, lesson, self._task.channel_id))
        self._question.show("" if step.question is None else self._asked(step.question, part))
        self._foot.show(_foot(lesson, progress, self._foot.channel_id))

    def _asked(self, question: Question, part: LessonPart) -> str:
        typed = part.progress.answers.get(part.progress.step, "")
        return _question(question, typed, self._question.channel_id) + _verdict(part)

    def _pressed(self, cell: str, text: str) -> None:
        if self._state is None:
            return
        if cell == "lesson-anew":
            key = self._state[LessonPart].open
            self._gui.confirm(
                "Begin again?",
                "Your answers in this lesson are forgotten, and the arm goes to its start.",
                "Begin again",
                lambda: self._post(OpenLesson(key, anew=True)),
            )
        elif cell != "lesson-check":  # the field beside it has told already
            command = _command(self._state[LessonPart].progress.step, cell, text)
            if command is None:
                log.warning("a page that is not ours pressed the lesson")
            else:
                self._post(command)


def _command(step: int, cell: str, text: str) -> Command | None:
    if cell.startswith(STEP) and cell.removeprefix(STEP).isdecimal():
        return GoToStep(int(cell.removeprefix(STEP)))
    commands: dict[str, Command] = {
        "lesson-key": OpenLesson(text),
        "lesson-close": CloseLesson(),
        "lesson-back": GoToStep(step - 1),
        "lesson-next": GoToStep(step + 1),
        "lesson-arm": TakeLessonArm(),
        "lesson-answer": Answer(text),
    }
    return commands.get(cell)


def _button(channel: str, cell: str, content: str, title: str = "", kind: str = "chip") -> str:
    hint = f' title="{title}" aria-label="{title}"' if title else ""
    return f'<button class="{kind}" data-chan="{channel}" data-cell="{cell}"{hint}>{content}</button>'


def _choice(lesson: Lesson, channel: str) -> str:
    """Return the list of lessons by chapter, with the buttons beside it."""
    groups = []
    for chapter, found in groupby(lessons().lessons.values(), lambda each: each.chapter):
        options = "".join(
            f'<option value="{each.key}"{" selected" if each is lesson else ""}>{escaped(each.title)}</option>'
            for each in found
        )
        groups.append(f'<optgroup label="{escaped(chapter)}">{options}</optgroup>')
    return (
        f'<div class="lesson-head"><select data-chan="{channel}" data-cell="lesson-key" aria-label="Lesson">'
        f"{''.join(groups)}</select>"
        + _button(channel, "lesson-anew", "↺", "Begin this lesson again")
        + _button(channel, "lesson-close", "✕", "Close the lesson")
        + "</div>"
    )


def _strips(lesson: Lesson, progress: Progress, channel: str) -> str:
    """Return one strip for each step: done, shown, or to come."""
    passed = progress.passed(lesson)
    strips = []
    for i, step in enumerate(lesson.steps):
        done = ", done" if i in passed else ""
        kind = " ".join(["strip"] + ["done"] * (i in passed))
        shown = ' aria-current="step"' if i == progress.step else ""
        title = escaped(f"Step {i + 1}{done}: {step.title}")
        strips.append(
            f'<button class="{kind}" data-chan="{channel}" data-cell="{STEP}{i}" title="{title}"'
            f' aria-label="{title}"{shown}></button>'
        )
    return f'<div class="strips">{"".join(strips)}</div>'


def _text(lesson: Lesson, i: int) -> str:
    step = lesson.steps[i]
    intro = lesson.intro_html
    if intro:
        intro = f"<details><summary>About this lesson</summary>{intro}</details>"
    count = f'<div class="dim">Step {i + 1} of {len(lesson.steps)}</div>'
    title = "" if i else f"<h2>{escaped(lesson.title)}</h2>"
    return f'<div class="lesson-text">{title}{intro}{count}<h2>{escaped(step.title)}</h2>{step.html}</div>'


def _task(state: State, lesson: Lesson, channel: str) -> str:
    """Return how the check stands, or the way back to the lesson's arm."""
    if not has_its_arm(state):
        name = catalogue()[lesson.robot].name
        return (
            f'<div class="verdict warn"><b>◐ Another arm is on the table</b>This lesson is about the {escaped(name)}. '
            f"{_button(channel, 'lesson-arm', f'Bring back the {escaped(name)}')}</div>"
        )
    step = state[LessonPart].step
    if step is None or step.check is None:
        return ""
    units = units_of(state)
    met, says = check_line(state, Words(units.length, units.angle))
    if met:
        return '<div class="verdict ok" role="status"><b>✓ Done</b></div>'
    return f'<div class="verdict todo"><b>◐ Not there yet</b>{escaped(says)}</div>'


def _question(question: Question, typed: str, channel: str) -> str:
    unit = escaped(UNIT_SIGNS.get(question.unit, question.unit))
    label = f"Your answer in {unit}" if unit else "Your answer"
    return (
        f'<div class="ask">{question.html}<div class="answer">'
        f'<input class="field" autocomplete="off" spellcheck="false" placeholder="your answer" aria-label="{label}"'
        f' value="{escaped(typed)}" data-chan="{channel}" data-cell="lesson-answer"><i>{unit}</i>'
        f"{_button(channel, 'lesson-check', 'Check')}</div></div>"
    )


def _verdict(part: LessonPart) -> str:
    verdict = part.verdict
    if verdict is None:
        return ""
    if verdict.right:
        return f'<div class="verdict ok" role="status"><b>✓ {verdict.says}</b></div>'
    return f'<div class="verdict no" role="status"><b>✕ Not yet</b>{verdict.says}</div>'


def _foot(lesson: Lesson, progress: Progress, channel: str) -> str:
    i, last = progress.step, len(lesson.steps) - 1
    passed = progress.passed(lesson)
    back = _button(channel, "lesson-back", "‹ Back", kind="way") if i else "<span></span>"
    if i < last:
        word, kind = ("Next ›", "way on") if i in passed else ("Skip ›", "way")
        return f'<div class="lesson-foot">{back}{_button(channel, "lesson-next", word, kind=kind)}</div>'
    missing = [str(k + 1) for k in range(last + 1) if k not in passed]
    if missing:
        note = f"Not done yet: step {', '.join(missing)}"
        return f'<div class="lesson-foot">{back}<span class="dim">{note}</span></div>'
    close = _button(channel, "lesson-close", "Close", kind="way on")
    return f'<div class="lesson-foot">{back}<b class="ok">✓ Lesson done</b>{close}</div>'
