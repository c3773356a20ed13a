"""Content of the lesson's dock: choice of lesson, text of the step, the check, question, hints, navigation."""

from __future__ import annotations

import re
from collections.abc import Callable
from copy import deepcopy
from functools import partial

from armlab.content.as_written import as_part
from armlab.content.lessons import Lesson, lessons_read
from armlab.content.question import Choices, Question
from armlab.content.question import Form as Answered
from armlab.errors import InputError
from armlab.session.clock import now
from armlab.session.state import Post, State
from armlab.teaching.assignment_commands import HandIn
from armlab.teaching.hand_in import MOST, hand_in, hand_in_name
from armlab.teaching.lesson_commands import (
    Answer,
    CloseLesson,
    GoToStep,
    OpenLesson,
    SignAs,
    TakeLessonArm,
    UnlockHint,
)
from armlab.teaching.parts.lesson import LessonPart, check_line, has_its_arm
from armlab.teaching.parts.shelf import ToSandbox
from armlab.teaching.shown_step import shown_step
from armlab.ui.asking import Draft, asked, said
from armlab.ui.erratum_links import with_links, without_links
from armlab.ui.form import Form, Wish
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.load_work import load_work
from armlab.ui.markup import verdict_box
from armlab.ui.right_answer import right_answer
from armlab.ui.widgets import Gui
from armlab.window.lesson import assigned
from armlab.window.lesson.assigned import Sheet
from armlab.window.lesson.end import with_end
from armlab.window.lesson.missing import still_missing
from armlab.window.lesson.text import step_text, with_values, words_of

STEP = "lesson-step-"
SOON = 5.0
"""Time within which a press has its work handed in, seconds; without a name, for one, it has not."""

Attempt = tuple[str, float, int]
"""Key of an assignment, when the work on it was begun, and the number of the attempt."""

Drafts = dict[str, tuple[str, Answered, Draft]]
"""Drafts of the steps of a lesson, each with the answer given before and the kind of the question."""

_WHOLE = re.compile(r"[0-9]{1,9}")


class LessonPage:
    """The page. Each piece is rewritten by itself, so that a moving arm does not clear the field of an answer.

    Parameters
    ----------
    gui : Gui
    post : callable
    kept : dict, optional
        What was last chosen or typed on any page of the session, by place: this one begins with it.
    saved : set, optional
        The work of which some page of the session has saved the file as it was closed.
    """

    def __init__(
        self, gui: Gui, post: Post, kept: dict[str, Drafts] | None = None, saved: set[Attempt] | None = None
    ) -> None:
        self._gui, self._post, self._kept = gui, post, {} if kept is None else kept
        self._saved: set[Attempt] = set() if saved is None else saved
        self._signed = ""  # the name sent last, which may not be in the state yet that was shown last
        self._watched = ""  # the assignment that was worked on when it was shown last
        self._drafts: Drafts = {}
        self._drafts_of = ""
        self._asked_at = ""  # step whose question was shown last
        self._clock, self._timer = gui.html(), assigned.Clock()
        self._head = gui.form(post)
        self._text, self._task, self._question, self._foot = (gui.form(post) for _ in range(4))
        self._more = gui.form(post, MOST)
        self._saves = 0.0  # time until which the file is saved as soon as the work is handed in

    @property
    def stale(self) -> bool:
        """Whether the student has typed or pressed since the page was shown, so that its fields may be outdated."""
        return any(fields.stale for fields in (self._head, self._task, self._question, self._foot, self._more))

    def show(self, state: State) -> None:
        """Show the open lesson of a state."""
        part = state[LessonPart]
        lesson, step = part.lesson, part.step
        if lesson is None or step is None:
            return
        sheet = Sheet.open(part)
        self._show_head(part, lesson, sheet)
        self._text.show(with_links(self._text, step_text(state, lesson, part.index)))
        self._task.show(_task(self._task, state, lesson))
        self._show_question(part, lesson)
        self._foot.show(_foot(self._foot, lesson, part, sheet))
        if sheet is None:
            self._more.show(_more(self._more, lesson, part, lambda: self._save(state)))
        else:
            self._show_hand_in(state, sheet)

    def _show_head(self, part: LessonPart, lesson: Lesson, sheet: Sheet | None) -> None:
        """Show the choice of lessons, or the tasks of the assignment and its clock, above the strips of the steps."""
        if sheet is None:
            self._clock.show()
            above: Inside = _choice(self._head, lesson, part.course, lambda: self._begin_again(part))
        else:
            self._clock.show(self._timer.markup(sheet))
            above = assigned.head(self._head, sheet)
        hides = sheet is not None and part.silent
        steps = assigned.strips(self._head, sheet, lesson) if sheet and hides else _strips(self._head, lesson, part)
        self._head.show(above, steps)

    def _show_hand_in(self, state: State, sheet: Sheet) -> None:
        """Show how the assignment is handed in."""
        name = _name(self._more, sheet.part, self._sign)
        save = lambda: self._save(state)  # noqa: E731
        self._more.show(assigned.hand_in_form(self._more, sheet, name, lambda: self._hand_in(sheet), save, now()))
        self._save_closed(state, sheet)

    def _save_closed(self, state: State, sheet: Sheet) -> None:
        """Save the file of work that was closed by this page's button, or by the clock while this page was open."""
        was, self._watched = self._watched, "" if sheet.part.rests else sheet.of.key
        if not sheet.part.rests:
            return
        due = now() < self._saves or (sheet.work.by_clock and was == sheet.of.key)
        attempt = sheet.of.key, sheet.work.begun, sheet.work.attempts
        self._saves = 0.0
        if due and attempt not in self._saved:
            self._saved.add(attempt)
            self._save(state)

    def _sign(self, name: str) -> SignAs:
        self._signed = name.strip()
        return SignAs(name)

    def fail(self) -> None:
        """Show that the lesson has failed, and remove the fields, which may be outdated."""
        self._text.show(verdict_box("no", "The lesson has failed", "The rest of the lab still works."))
        for fields in (self._task, self._question):
            fields.show()

    def _show_question(self, part: LessonPart, lesson: Lesson) -> None:
        question = lesson.steps[part.index].question
        if self._asked_at != shown_step(part):
            self._asked_at = shown_step(part)
            self._question.forgive()  # what was refused there answered another question
            self._take_back(part)
        if question is None:
            self._question.show()
            return
        typed, settled = part.progress.answers.get(part.name, ""), part.progress.committed(lesson, part.index)
        draft = self._draft_of(part, question, typed)
        choices = question.form if isinstance(question.form, Choices) else None
        order = choices.order(lesson.variant, part.name) if choices else ()
        word, fixed = "Keep" if part.silent else "Check", settled or part.rests
        fields = asked(self._question, question, typed, draft, fixed, order, word, shown_step(part))
        right = part.progress.right.get(part.name)
        verdict = part.verdict
        if part.silent and (verdict is None or verdict.counts):
            self._question.show(fields, assigned.noted(typed, settled))
            return
        done, told = part.index in part.progress.passed(lesson), _told(part, question) if settled else None
        self._question.show(fields, said(verdict, settled, right.typed if right else "", done, told))

    def _draft_of(self, part: LessonPart, question: Question, typed: str) -> Draft:
        """Return what is typed in the shown step, which stays while others are looked at; new where its answer is.

        Where no verdict follows it is kept without a button, except for a prediction, of which the first one counts.
        """
        kind = question.form
        if self._drafts_of != part.where:
            self._drafts_of, self._drafts = part.where, deepcopy(self._kept.get(part.where, {}))
        before, of, draft = self._drafts.get(part.name, ("", None, None))
        # When its own answer has come back the fields stay as they were typed.
        if draft is None or of != kind or (before != typed and draft.whole != typed):
            draft = Draft(kind, typed, partial(Answer, of=shown_step(part)), part.silent and not question.hide)
        self._drafts[part.name] = typed, kind, draft
        if self._question.stale:  # a copy: two pages that are open at once do not fill in each other's fields
            self._kept.clear()
            self._kept[part.where] = deepcopy(self._drafts)
        return draft

    def _take_back(self, part: LessonPart) -> None:
        """Take what was sent from steps that are shown no more, and not taken, for not sent."""
        if self._drafts_of == part.where:
            for name, (before, _, draft) in self._drafts.items():
                if part.progress.answers.get(name, "") == before:
                    draft.whole = before

    def _begin_again(self, part: LessonPart) -> Wish:
        key, _, variant = part.open.partition("/")
        again = OpenLesson(key, anew=True, variant=int(variant) if variant else None)

        def begin() -> None:
            self._drafts.clear()
            self._question.forgive()
            self._kept.clear()
            self._post(again)

        self._gui.confirm(
            "Begin again?",
            "Your answers in this lesson will be deleted, and the arm will return to its start.",
            "Begin again",
            begin,
        )
        return ()

    def _hand_in(self, sheet: Sheet) -> Wish:
        def hand_in_now() -> None:
            self._saves = now() + SOON
            self._post(HandIn())

        says = (
            "Your work can then not be changed any more in this attempt, and a file is saved: give it to your teacher."
        )
        # An answer that was sent just now may not be in the state yet that was shown last.
        sent = {name: draft.whole for name, (_, _, draft) in self._drafts.items() if draft.whole}
        named = sheet.part.student or self._signed
        unsigned = None if named else tag("p", "Your name is missing: write it at “Name” first.")
        more = unsigned, still_missing(sheet, self._drafts_of, sent)
        self._gui.confirm("Hand in?", says, "Hand in", hand_in_now, more)
        return ()

    def _save(self, state: State) -> Wish:
        self._gui.save(hand_in_name(state), hand_in(state))
        return ()


def _told(part: LessonPart, question: Question) -> Markup | None:
    """Return the right answer, unless it is one to an exam: who sits it may do so again, in another browser too."""
    return None if part.assigned is not None and part.assigned.exam else right_answer(question)


def _variant(part: LessonPart, text: str) -> OpenLesson:
    if not _WHOLE.fullmatch(text.strip()):
        raise InputError(f"variant: expected a whole number, got {text[:40]!r}")
    return OpenLesson(part.open.partition("/")[0], variant=int(text))


def _choice(form: Form, lesson: Lesson, course: str, anew: Callable[[], Wish]) -> Markup:
    """Return the list of lessons by chapter of the course that is shown, with the buttons beside it.

    Until all lessons have been read it has the open one alone.
    """
    found = lessons_read()
    chapters = () if found is None else found.chapters(course)
    titles = {} if found is None else {key: each.title for key, each in found.lessons.items()}
    groups: dict[str, dict[str, str]] = {}
    if lesson.key not in {key for chapter in chapters for key in chapter.lessons}:
        groups[""] = {lesson.key: lesson.title}  # it is of another course, or its file was taken away
    for chapter in chapters:
        groups.setdefault(chapter.title, {}).update({key: titles[key] for key in chapter.lessons})
    again, close = "Begin this lesson again", "Close the lesson"
    return tag(
        "div.lesson-head",
        form.select_in_groups("lesson-key", "Lesson", groups, lesson.key, OpenLesson),
        form.button("lesson-anew", "↺", anew, "chip", again, again),
        form.button("lesson-close", "✕", CloseLesson(), "chip", close, close),
    )


def _strips(form: Form, lesson: Lesson, part: LessonPart) -> Markup:
    """Return one strip for each step: done, shown, or to come."""
    passed = part.progress.passed(lesson)
    strips = []
    for i, step in enumerate(lesson.steps):
        done = ", done" if i in passed else ""
        kind = " ".join(["strip"] + ["done"] * (i in passed))
        shown = "step" if i == part.index else ""
        title = f"Step {i + 1}{done}: {as_part(step.title)}"
        strips.append(form.button(f"{STEP}{i}", "", GoToStep(i), kind, title, title, aria_current=shown))
    return tag("div.strips", strips)


def _task(form: Form, state: State, lesson: Lesson) -> Markup | None:
    """Return the state of the check, or a button that brings back the lesson's arm."""
    if not has_its_arm(state):
        name = lesson.robot_used.name
        back = form.chip("lesson-arm", f"Bring back the {name}", TakeLessonArm())
        return verdict_box("warn", "Another arm has been chosen", f"This lesson is about the {name}. ", back)
    step = state[LessonPart].step
    if step is None or step.check is None:
        return None
    if state[LessonPart].hides:
        return None
    if state[LessonPart].silent:
        return assigned.check_box(state[LessonPart])
    met, says = check_line(state, words_of(state))
    if met:
        return verdict_box("ok", "Done", role="status")
    # Before anybody has moved or answered anything nothing is wrong yet.
    if not (state[LessonPart].progress.tried or state[LessonPart].name in state[LessonPart].progress.answers):
        if state[LessonPart].rests:
            return verdict_box("todo", "Not done", "This step was not begun.")
        return verdict_box("todo", "To do", "As soon as you begin, this card says what is still missing.")
    return verdict_box("todo", "Not there yet", with_values(state, without_links(says)))


def _foot(form: Form, lesson: Lesson, part: LessonPart, sheet: Sheet | None = None) -> Markup:
    """Return the buttons back and on, with the next hint between them; at the last step also the next lesson."""
    i, last, progress = part.index, len(lesson.steps) - 1, part.progress
    if sheet is not None:
        hint = _hint(form, lesson, part, i) if sheet.of.hints and not part.rests else None
        return assigned.foot(form, sheet, lesson, hint or tag("span"))
    passed = progress.passed(lesson)
    back = form.button("lesson-back", "‹ Back", GoToStep(i - 1), "way") if i else tag("span")
    hint = _hint(form, lesson, part, i)
    if i < last:
        word, kind = ("Next ›", "way on") if i in passed else ("Skip ›", "way")
        return tag("div.lesson-foot", back, hint, form.button("lesson-next", word, GoToStep(i + 1), kind))
    return with_end(form, lesson, part, tag("div.lesson-foot", back, hint, _end(form, last, passed)))


def _hint(form: Form, lesson: Lesson, part: LessonPart, i: int) -> Markup | None:
    count, shown = len(lesson.steps[i].hints), part.progress.hints.get(part.name, 0)
    if shown >= count or i in part.progress.passed(lesson):
        return None
    percent = 0.0 if part.assigned is None else part.assigned.last_hint_percent
    last = f"The last hint; it costs {percent:g} % of the points of this step" if percent else ""
    name = f"Hint {shown + 1} of {count}" if count > 1 else "Hint"
    costs = f" (−{percent:g} %)" if last and shown + 1 == count else ""
    of, title = shown_step(part), last if costs else ""
    return form.button("lesson-hint", f"{name}{costs}", UnlockHint(of), "way", title, data_of=of)


def _end(form: Form, last: int, passed: frozenset[int]) -> Inside:
    missing = [str(k + 1) for k in range(last + 1) if k not in passed]
    if missing:
        return tag(
            "span.dim",
            f"{len(missing)} to do",
            title=f"Not done yet: step{'s' if len(missing) > 1 else ''} {', '.join(missing)}",
        )
    return tag("b.ok", "✓ Lesson done"), form.button("lesson-close", "Close", CloseLesson(), "way")


def _more(form: Form, lesson: Lesson, part: LessonPart, save: Callable[[], Wish]) -> Markup:
    """Return the parts that are needed seldom: the own sandbox, the variant, and the work to hand in."""
    variant = None
    if lesson.varies:
        number = form.field(
            "lesson-variant",
            str(lesson.variant),
            "Number of your variant",
            lambda text: _variant(part, text),
            inputmode="numeric",
        )
        variant = tag("div.row", tag("span", "Variant"), tag("div.answer", number))
    again = "Restore the arm and the example of this step; your answers are kept"
    own = "Try things with an arm of your own; the lesson waits"
    chips = tag(
        "div.chips",
        form.chip("lesson-save", "Save my work", save, "Save a file to hand in, or to continue from later"),
        load_work(form),
        form.chip("lesson-setup", "Set up again", TakeLessonArm(), again),
        form.chip("lesson-sandbox", "My sandbox", ToSandbox(), own),
    )
    summary = tag("summary", "Sandbox, save my work")
    return tag(
        "details.lesson-more",
        summary,
        variant,
        tag("div.row", tag("span", "Name"), tag("div.answer", _name(form, part, SignAs))),
        chips,
    )


def _name(form: Form, part: LessonPart, sign: Callable[[str], SignAs]) -> Markup:
    """Return the field of the name with which the work is signed."""
    return form.field(
        "lesson-name", part.student, "Your name", sign, inputmode="", placeholder="your name", maxlength="80"
    )
