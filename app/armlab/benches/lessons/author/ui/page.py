"""The page for teachers: lessons saved, loaded, looked at and put in order, and the broken files of lessons."""

from __future__ import annotations

import re
from collections.abc import Sequence

from armlab.benches.lessons.author.begun import begun_as
from armlab.benches.lessons.author.ui.asked import Questions
from armlab.benches.lessons.author.ui.loading import Loading
from armlab.benches.lessons.author.ui.order import Order
from armlab.benches.lessons.author.ui.shell import commands_markup
from armlab.benches.lessons.author.write_lesson import NumberAsked, lesson_text
from armlab.content.course import Course
from armlab.content.lessons import lessons, lessons_read
from armlab.errors import ArmlabError, InputError
from armlab.session.pages import FIRST, pages, place_of, tab_of
from armlab.session.panel_commands import hidden_panels
from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.session.parts.panels import Panels
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.state import Post, State
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.own_lessons import OwnLessons
from armlab.teaching.parts.preview import Preview
from armlab.teaching.parts.teacher import Teacher
from armlab.ui.form import Form, Pressed, Typed
from armlab.ui.format import pairs
from armlab.ui.html import Inside, tag
from armlab.ui.markup import fold, on_paper
from armlab.ui.picks import broken_files, lessons_to_come
from armlab.ui.plugin import Panel, Show, layers
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

GUIDE_HINT = "Goals, what to show, common mistakes, homework, by chapter; opens a page of its own"

OWN, NOT_TAUGHT = "author", ("lessons", "picture")
"""Key of this page, and the tabs on which no lesson opens."""

GOAL = "Bring the arm to where the students are to bring it. The lesson begins in another pose and asks for this one."


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the parts of the page, the most used first."""
    title, present = "My lesson", state
    questions = Questions()
    made: tuple[str, str] | None = None  # the name and the text of the file that was saved last

    def named(text: str) -> None:
        nonlocal title
        title = " ".join(text.split())[:80] or title

    def save() -> None:
        nonlocal made
        if present[LessonPart].hides:
            # The file would tell what is to be predicted.
            raise InputError("Answer the question of the lesson first, or close the lesson.")
        try:
            made = f"{file_name(title)}.md", written(title, present, gui, questions.asked)
            gui.save(*made)
        except ArmlabError as refusal:
            raise InputError(str(refusal)) from None

    paper = gui.html()
    gui.heading("Save as lesson")
    form = gui.form(post)
    loading = Loading(gui, post)
    order = Order(gui, post)
    gui.html(commands_markup())
    problems = gui.html()

    def show(state: State) -> None:
        nonlocal present
        present = state
        paper.show(_paper(lessons().course(state[LessonPart].course)))
        held = None if made is None else fold(f"What {made[0]} says", tag("pre.al-file", made[1]), key="file")
        form.show(_form(form, title, state, gui.window, named, save, questions), held)
        loading.show(state)
        order.show(state)
        problems.show(broken_files("lesson", lessons().problems))

    return show


def _paper(course: Course) -> Inside:
    """Return the links to what helps to teach a course, on pages of their own."""
    sheet = on_paper("Formulas on two pages", "formulas", hint="Also in LaTeX: armlab formulas")
    return tag("div.bar", on_paper("Guide to the course", "guide", course.key, GUIDE_HINT), sheet)


def _form(
    form: Form, title: str, state: State, window: int, named: Typed, save: Pressed, questions: Questions
) -> Inside:
    line = form.field("title", title, "Title of the lesson", named, inputmode="", maxlength="80")
    hint = "A lesson file whose goal is the arm as it stands"
    button = form.button("save-lesson", "Save as lesson", save, "main", hint)
    # What is to be predicted is not told here either.
    known = None if state[LessonPart].hides else pairs(_holds(state, window))
    held = None if known is None else fold("What the file will hold", known, key="holds")
    titled = tag("div.kit-numbers.kit-typed", tag("label", tag("span", "Title"), line))
    return tag("p", GOAL), titled, questions.shown(form), tag("div.bar", button), held


def _holds(state: State, window: int) -> list[tuple[Inside, Inside]]:
    """Return what of the present state the file will hold."""
    units, robot, part = units_of(state), state[RobotPart].robot, state[Joints]
    joints = [
        (units.angle if turns else units.length)(float(value))
        for turns, value in zip(robot.arm.revolute, part.q, strict=True)
    ]
    begin = sorted({word.partition(".")[0].capitalize() for word, _ in begun_as(state)})
    return [
        ("Arm", robot.name),
        ("Goal, joint values", ", ".join(joints)),
        ("Page that opens", place_of(page_beside(state, window))),
        ("Overlays", ", ".join(_overlays(state)) or "none"),
        ("Tabs as you have set them", ", ".join(begin) or "none"),
    ]


def page_beside(state: State, window: int) -> str:
    """Return the page for students that is open beside this one in a window, or was last; Joints where there is none.

    The lesson opens on it: what is set there is what the lesson is about.
    """
    found = state[Panels].windows.get(window)
    beside = "" if found is None else found.beside(OWN, hidden_panels(state))
    return beside if beside and not pages()[beside].always and tab_of(beside) not in NOT_TAUGHT else FIRST


def _overlays(state: State) -> list[str]:
    on = state[Display].switches
    return [layer.switch.name for layer in layers().values() if layer.switch and on.get(layer.switch.name)]


def written(title: str, state: State, gui: Gui, answers: Sequence[NumberAsked]) -> str:
    """Return the lesson of a state: its arm, pose, target, overlays, benches, and view, and questions."""
    robot, q, eye = state[RobotPart].robot, state[Joints].q, gui.camera.as_view()
    begin = tuple(begun_as(state))
    return lesson_text(
        title,
        robot,
        q,
        panel=page_beside(state, gui.window),
        overlays=_overlays(state),
        target=state[Target].pose,
        camera=eye,
        answers=answers,
        begin=begin,
    )


def file_name(title: str) -> str:
    """Return the title as the name of a lesson file.

    >>> file_name("Über Winkel & Arme")
    'ber_winkel_arme'
    """
    return re.sub(r"[^a-z0-9]+", "_", title.lower()).strip("_")[:60] or "lesson"


WATCHED = (RobotPart, Joints, Target, Display, Panels, LessonPart, OwnLessons, Preview, Teacher)

PANEL = Panel(WATCHED, build, rebuilds=(), outside=lessons_read, waits=lessons_to_come)
