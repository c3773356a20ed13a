"""What the lesson's dock holds: choice of lesson, text of the step, what is missing, question, hints, way on."""

from __future__ import annotations

import logging
import re
from itertools import groupby

from armlab.content.lessons import Lesson, lessons
from armlab.content.question import Choices, Form
from armlab.session.hand_in import hand_in, hand_in_name
from armlab.session.hand_in_open import OpenWork
from armlab.session.lesson_commands import (
    Answer,
    CloseLesson,
    GoToStep,
    OpenLesson,
    SignAs,
    TakeLessonArm,
    UnlockHint,
)
from armlab.session.parts.lesson import LessonPart, check_line, has_its_arm
from armlab.session.parts.shelf import ToSandbox
from armlab.session.session import Refuse
from armlab.session.state import Command, Post, State
from armlab.ui.format import escaped
from armlab.ui.lesson.asking import Draft, asked, said
from armlab.ui.lesson.load import load_work
from armlab.ui.lesson.text import step_text, words_of
from armlab.ui.markup import button, chip, field, options, select
from armlab.ui.widgets import Gui

log = logging.getLogger(__name__)

STEP = "lesson-step-"
_WHOLE = re.compile(r"[0-9]{1,9}")


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
        self._draft: tuple[tuple[str, str, str, Form], Draft] | None = None
        self._head = gui.fields(self._pressed)
        self._text = gui.html()
        self._task = gui.fields(self._pressed)
        self._question = gui.fields(self._answered)
        self._foot = gui.fields(self._pressed)
        self._more = gui.fields(self._pressed)

    @property
    def stale(self) -> bool:
        """Whether a person has typed or pressed since it was shown: what stands in its fields may not hold."""
        return any(fields.stale for fields in (self._head, self._task, self._question, self._foot, self._more))

    def show(self, state: State) -> None:
        """Show the open lesson of a state."""
        part = state[LessonPart]
        lesson, step = part.lesson, part.step
        if lesson is None or step is None:
            return
        self._state = state
        channel = self._head.channel_id
        self._head.show(_choice(lesson, channel) + _strips(lesson, part, channel))
        self._text.show(step_text(state, lesson, part.index))
        self._task.show(_task(state, lesson, self._task.channel_id))
        self._show_question(part, lesson)
        self._foot.show(_foot(lesson, part, self._foot.channel_id))
        self._more.show(_more(lesson, part, self._more.channel_id))

    def fail(self) -> None:
        """Say that the lesson cannot be shown; what was there before may not hold."""
        self._text.show('<div class="verdict no"><b>✕ The lesson has failed</b>The rest works on.</div>')
        for fields in (self._task, self._question):
            fields.show("")

    def _show_question(self, part: LessonPart, lesson: Lesson) -> None:
        question = lesson.steps[part.index].question
        if question is None:
            self._question.show("")
            return
        typed, settled = part.progress.answers.get(part.name, ""), part.progress.committed(lesson, part.index)
        key = (part.open, part.name, typed, question.form)
        place, name, _, form = self._draft[0] if self._draft is not None else ("", "", "", None)
        if self._draft is not None and self._draft[1].whole == typed and (place, name, form) == (*key[:2], key[3]):
            self._draft = key, self._draft[1]  # its own answer has come back: the fields stay as they were typed
        if self._draft is None or self._draft[0] != key:
            self._draft = key, Draft(question.form, typed)
        choices = question.form if isinstance(question.form, Choices) else None
        order = choices.order(lesson.variant, part.name) if choices else ()
        fields = asked(question, typed, self._draft[1], settled, self._question.channel_id, order)
        right = part.progress.right.get(part.name)
        self._question.show(fields + said(part.verdict, settled, right.typed if right else ""))

    def _answered(self, cell: str, text: str) -> None:
        if self._state is None or self._draft is None:
            return
        try:
            whole = self._draft[1].take(cell, text)
        except ValueError:
            log.warning("a page that is not ours answered a question")
            return
        if whole is not None:
            self._post(Answer(whole))
        else:
            self.show(self._state)

    def _pressed(self, cell: str, text: str) -> None:
        if self._state is None:
            return
        part = self._state[LessonPart]
        if cell == "lesson-anew":
            key, _, variant = part.open.partition("/")
            again = OpenLesson(key, anew=True, variant=int(variant) if variant else None)
            self._gui.confirm(
                "Begin again?",
                "Your answers in this lesson are forgotten, and the arm goes to its start.",
                "Begin again",
                lambda: self._post(again),
            )
        elif cell == "lesson-save":
            self._gui.save(hand_in_name(self._state), hand_in(self._state))
        else:
            command = _command(part, cell, text)
            if command is None:
                log.warning("a page that is not ours pressed the lesson")
            else:
                self._post(command)


def _command(part: LessonPart, cell: str, text: str) -> Command | None:
    if cell.startswith(STEP) and _WHOLE.fullmatch(cell.removeprefix(STEP)):
        return GoToStep(int(cell.removeprefix(STEP)))
    if cell == "lesson-variant":
        if not _WHOLE.fullmatch(text.strip()):
            return Refuse(f"variant: expected a whole number, got {text[:40]!r}")
        return OpenLesson(part.open.partition("/")[0], variant=int(text))
    commands: dict[str, Command] = {
        "lesson-key": OpenLesson(text),
        "lesson-close": CloseLesson(),
        "lesson-back": GoToStep(part.index - 1),
        "lesson-next": GoToStep(part.index + 1),
        "lesson-arm": TakeLessonArm(),
        "lesson-setup": TakeLessonArm(),
        "lesson-hint": UnlockHint(),
        "lesson-name": SignAs(text),
        "lesson-sandbox": ToSandbox(),
        "lesson-load": OpenWork(text),
    }
    return commands.get(cell)


def _choice(lesson: Lesson, channel: str) -> str:
    """Return the list of lessons by chapter, with the buttons beside it."""
    groups = []
    there = lessons().lessons
    if lesson.key not in there:  # its file was taken away
        groups.append(options({lesson.key: lesson.title}, lesson.key))
    for chapter, found in groupby(there.values(), lambda each: each.chapter):
        titles = options({each.key: each.title for each in found}, lesson.key)
        groups.append(f'<optgroup label="{escaped(chapter)}">{titles}</optgroup>')
    anew, close = "Begin this lesson again", "Close the lesson"
    return (
        f'<div class="lesson-head">{select(channel, "lesson-key", "Lesson", "".join(groups))}'
        + button(channel, "lesson-anew", "↺", "chip", anew, anew)
        + button(channel, "lesson-close", "✕", "chip", close, close)
        + "</div>"
    )


def _strips(lesson: Lesson, part: LessonPart, channel: str) -> str:
    """Return one strip for each step: done, shown, or to come."""
    passed = part.progress.passed(lesson)
    strips = []
    for i, step in enumerate(lesson.steps):
        done = ", done" if i in passed else ""
        kind = " ".join(["strip"] + ["done"] * (i in passed))
        shown = "step" if i == part.index else ""
        title = f"Step {i + 1}{done}: {step.title}"
        strips.append(button(channel, f"{STEP}{i}", "", kind, title, title, aria_current=shown))
    return f'<div class="strips">{"".join(strips)}</div>'


def _task(state: State, lesson: Lesson, channel: str) -> str:
    """Return how the check stands, or the way back to the lesson's arm."""
    if not has_its_arm(state):
        name = lesson.robot_used.name
        return (
            f'<div class="verdict warn"><b>◐ Another arm is on the table</b>This lesson is about the {escaped(name)}. '
            f"{chip(channel, 'lesson-arm', f'Bring back the {name}')}</div>"
        )
    step = state[LessonPart].step
    if step is None or step.check is None:
        return ""
    if state[LessonPart].hides:
        return ""
    met, says = check_line(state, words_of(state))
    if met:
        return '<div class="verdict ok" role="status"><b>✓ Done</b></div>'
    if not state[LessonPart].progress.tried:  # nobody has moved anything, so nothing is wrong yet
        return '<div class="verdict todo"><b>◐ To do</b>What is still missing is said here as soon as you begin.</div>'
    return f'<div class="verdict todo"><b>◐ Not there yet</b>{says}</div>'


def _foot(lesson: Lesson, part: LessonPart, channel: str) -> str:
    """Return the way back and on, with the next hint between."""
    i, last, progress = part.index, len(lesson.steps) - 1, part.progress
    passed = progress.passed(lesson)
    back = button(channel, "lesson-back", "‹ Back", "way") if i else "<span></span>"
    hint = _hint(lesson, part, i, channel)
    if i < last:
        word, kind = ("Next ›", "way on") if i in passed else ("Skip ›", "way")
        return f'<div class="lesson-foot">{back}{hint}{button(channel, "lesson-next", word, kind)}</div>'
    return f'<div class="lesson-foot">{back}{hint}{_end(last, passed, channel)}</div>'


def _hint(lesson: Lesson, part: LessonPart, i: int, channel: str) -> str:
    count, shown = len(lesson.steps[i].hints), part.progress.hints.get(part.name, 0)
    if shown >= count or i in part.progress.passed(lesson):
        return ""
    return button(channel, "lesson-hint", f"Hint {shown + 1} of {count}" if count > 1 else "Hint", "way")


def _end(last: int, passed: frozenset[int], channel: str) -> str:
    missing = [str(k + 1) for k in range(last + 1) if k not in passed]
    if missing:
        return f'<span class="dim" title="Not done yet: step {", ".join(missing)}">{len(missing)} to do</span>'
    return f'<b class="ok">✓ Lesson done</b>{button(channel, "lesson-close", "Close", "way on")}'


def _more(lesson: Lesson, part: LessonPart, channel: str) -> str:
    """Return what is needed now and then: the own sandbox, the variant, and the work to hand in."""
    variant = ""
    if lesson.varies:
        number = field(channel, "lesson-variant", str(lesson.variant), "Number of your variant", inputmode="numeric")
        variant = f'<div class="row"><span>Variant</span><div class="answer">{number}</div></div>'
    name = field(channel, "lesson-name", part.student, "Your name", placeholder="your name", maxlength="80")
    return (
        f'<details class="lesson-more"><summary>Sandbox, save my work</summary>{variant}'
        f'<div class="row"><span>Name</span><div class="answer">{name}</div></div>'
        f'<div class="chips">{chip(channel, "lesson-save", "Save my work", "A file to hand in or to go on with")}'
        f"{load_work(channel, 'lesson-load')}"
        f"{chip(channel, 'lesson-setup', 'Set up again', 'Arm and example as this step finds them; your answers stay')}"
        f"{chip(channel, 'lesson-sandbox', 'My sandbox', 'An arm of your own; the lesson waits')}</div></details>"
    )
