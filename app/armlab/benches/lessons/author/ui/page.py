"""The page for teachers: the present state saved as the goal of a lesson, and the broken files of lessons."""

from __future__ import annotations

import re

from armlab.content.lessons import lessons
from armlab.content.write_lesson import lesson_text
from armlab.errors import ArmlabError, InputError
from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.session.parts.lesson import LessonPart
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.put_words import begun_as
from armlab.session.state import Post, State
from armlab.ui.form import Form, Pressed, Typed
from armlab.ui.html import Inside, tag
from armlab.ui.markup import row
from armlab.ui.picks import broken_files
from armlab.ui.plugin import Panel, Show, layers
from armlab.ui.widgets import Gui

HOW = (
    tag(
        "p",
        "Bring the arm to where the students are to bring it, give the lesson a title, and save. The file has one step "
        "with a check, a hint and a solution, and begins with the benches as you have set them; write the text in any "
        "editor.",
    ),
    tag(
        "p",
        "Put it into a folder and start the lab with ",
        tag("code", "armlab --lessons FOLDER"),
        ": it appears under Lessons, and every time you save the file the open lesson changes. ",
        tag("code", "armlab lesson check FILE"),
        " plays it by its solution; ",
        tag("code", "armlab check NAME --state FOLDER"),
        " judges what students hand in.",
    ),
)


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the field of the title and the button."""
    title, present = "My lesson", state

    def named(text: str) -> None:
        nonlocal title
        title = " ".join(text.split())[:80] or title

    def save() -> None:
        if present[LessonPart].hides:
            # The file would tell what is to be predicted.
            raise InputError("Answer the question of the lesson first, or close the lesson.")
        try:
            gui.save(f"{file_name(title)}.md", written(title, present, gui))
        except ArmlabError as refusal:
            raise InputError(str(refusal)) from None

    gui.heading("Save as lesson")
    form = gui.form(post)
    gui.html(HOW)
    problems = gui.html()

    def show(state: State) -> None:
        nonlocal present
        present = state
        form.show(_form(form, title, named, save))
        problems.show(broken_files("lesson", lessons().problems))

    return show


def _form(form: Form, title: str, named: Typed, save: Pressed) -> Inside:
    line = form.field("title", title, "Title of the lesson", named, inputmode="", maxlength="80")
    button = form.chip("save-lesson", "Save as lesson", save, "A lesson file whose goal is the arm as it stands")
    return row("Title", line), tag("div.bar", button)


def written(title: str, state: State, gui: Gui) -> str:
    """Return the lesson of a state: its arm, pose, target, overlays, benches, and view."""
    on = state[Display].switches
    overlays = [layer.switch.name for layer in layers().values() if layer.switch and on.get(layer.switch.name)]
    robot, q, eye = state[RobotPart].robot, state[Joints].q, gui.camera.as_view()
    begin = tuple(begun_as(state))
    return lesson_text(
        title, robot, q, panel="joints", overlays=overlays, target=state[Target].pose, camera=eye, begin=begin
    )


def file_name(title: str) -> str:
    """Return the title as the name of a lesson file.

    >>> file_name("Über Winkel & Arme")
    'ber_winkel_arme'
    """
    return re.sub(r"[^a-z0-9]+", "_", title.lower()).strip("_")[:60] or "lesson"


PANEL = Panel((RobotPart, Joints, Target, Display, LessonPart), build, rebuilds=())
