"""Files that are loaded or pasted; what is loaded is seen as a student sees it, or given to everybody."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from armlab.benches.lessons.own_commands import ForgetFile, LoadFile
from armlab.content.assignment import parse_assignment
from armlab.content.desk import desk
from armlab.content.held import HeldLesson
from armlab.content.lessons import lessons
from armlab.content.upload import ASSIGNMENT, LESSON_KIND, MOST_SENT, MOST_ZIP, Upload, read_upload
from armlab.errors import ArmlabError, InputError
from armlab.session.state import Command, Post, State
from armlab.teaching.assignment_commands import refuse_unknown_pages
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.own_lessons import Held, OwnLessons, key_of
from armlab.teaching.parts.teacher import LetIn, Teacher
from armlab.teaching.preview_commands import PreviewAssignment, PreviewLesson
from armlab.ui.form import Wish
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import fold, row
from armlab.ui.widgets import Gui

PAGE = "author"

LOAD = (
    "A lesson (.md, or its folder with pictures as .zip), an assignment, a course or an arm (.toml). "
    "Only you see what you load."
)
KINDS = ".md,.toml,.zip"
EXAMPLE = '+++\ntitle = "My lesson"\n…'


class Loading:
    """The part of the page that loads files, and looks at lessons as a student sees them.

    Parameters
    ----------
    gui : Gui
    post : callable
    """

    def __init__(self, gui: Gui, post: Post) -> None:
        gui.heading("Load, and see it as a student")
        self._gui = gui
        self._form, self._more = gui.form(post, MOST_SENT), gui.form(post, MOST_SENT)
        self._pasted = ""
        self._given: Inside = None  # what is said of the file put there last

    def show(self, state: State) -> None:
        """Show what is loaded in a state."""
        form = self._form
        chosen = tag(
            "input",
            type="file",
            accept=KINDS,
            data_most=MOST_ZIP,
            data_named=True,
            **form.bound("load-file", _load),
        )
        hint = "It is read here, and kept with your work; nobody else sees it"
        form.show(
            tag("p", LOAD),
            tag("div.bar", tag("label.chip.al-load", "Load a file", chosen, title=hint)),
            [self._entry(upload, state) for upload in state[OwnLessons].files],
            self._given,
        )
        self._more.show(self._paste(), self._preview(state), self._key(state))

    def _entry(self, upload: Upload, state: State) -> Markup:
        """Return the line of a file: its title, and what can be done with it."""
        own, file = state[OwnLessons], upload.file
        held = own.held.get(file)
        why = own.problems.get(file)
        inside: list[Inside] = [tag("b", file if held is None else _title(held)), tag("span", file)]
        look = None
        if held is not None:
            command = _look(key_of(held), isinstance(held, HeldLesson))
            look = self._form.chip(f"preview {file}", "See it", command, "As a student sees it; your work waits")
        give = None
        if state[Teacher].let_in and desk() is not None:
            say = "Put it into the folder of the class"
            give = self._form.chip(f"give {file}", "For everybody", partial(self._give, upload, own), say)
        away = f"Remove {file}"
        remove = self._form.button(f"forget {file}", "✕", ForgetFile(file), "chip", away, away)
        problem = tag("p.no", f"✕ {why}") if why is not None else None
        return tag("div.al-own", tag("div", inside), tag("div.chips", look, give, remove), problem)

    def _give(self, upload: Upload, own: OwnLessons) -> None:
        """Put a file into the folder for everybody."""
        found = desk()
        if found is None:
            raise InputError("This lab has no folder for what is loaded.")
        try:
            if upload.kind == ASSIGNMENT:
                refuse_unknown_pages(parse_assignment(upload.name, upload.text, upload.file))
            name = found.put(upload, {key: lesson.file for key, lesson in own.lessons.items()})
        except ArmlabError as refusal:
            raise InputError(str(refusal)) from None
        there = tag("p", f"✓ {name} is there for everybody.", role="status")
        self._given = there, self._address(upload, own)

    def _address(self, upload: Upload, own: OwnLessons) -> Inside:
        """Return the address under which students find a file, with the button that copies it; None for none."""
        lesson = own.lessons.get(upload.name) if upload.kind == LESSON_KIND else None
        if upload.kind != ASSIGNMENT and (lesson is None or not lesson.listed):
            return None
        address = f"{self._gui.origin}/{upload.kind}/{upload.name}"
        copy = tag("button.chip", "Copy link", data_copy=address)
        return tag("p", "Give your students this address:"), tag("div.bar", tag("code", address), copy)

    def _paste(self) -> Markup:
        """Return the field for a text, with its button."""
        form = self._more
        looks: dict[str, str] = {"rows": "5", "spellcheck": "false", "aria_label": "Text of a file"}
        area = tag("textarea.paste", self._pasted, placeholder=EXAMPLE, **looks, **form.bound("paste-file", self._keep))
        return fold("Paste a text", area, tag("div.bar", form.chip("load-text", "Load it", self._load_pasted)))

    def _keep(self, text: str) -> tuple[Command, ...]:
        self._pasted = text
        return ()

    def _load_pasted(self) -> Wish:
        return _load(f"\n{self._pasted}")

    def _preview(self, state: State) -> Markup:
        """Return the choice of a lesson of the course, or with the key of an assignment, to see as a student."""
        found, form = lessons(), self._more
        course = found.chapters(state[LessonPart].course)
        groups: dict[str, Mapping[str, str]] = {"": {"": "Choose a lesson"}}
        for chapter in course:
            groups[chapter.title] = {key: found.lessons[key].title for key in chapter.lessons}
        choice = form.select_in_groups("preview", "Lesson", groups, "", lambda key: _look(key, True))
        second = None
        if state[Teacher].let_in and found.assignments:
            texts = {"": "Choose an assignment", **{key: each.title for key, each in found.assignments.items()}}
            select = form.select("preview-set", "Assignment", texts, "", lambda key: _look(key, False))
            second = row("Assignment", select)
        return fold("A lesson of the course as a student sees it", row("Lesson", choice), second, key="preview")

    def _key(self, state: State) -> Markup | None:
        """Return the field of the key, where files can be put into the folder of a class."""
        if desk() is None or state[Teacher].let_in:
            return None
        field = self._more.field(
            "teacher-key", "", "Key of the teacher", self._let_in, inputmode="", type="password", maxlength="100"
        )
        says = "With the key that the lab was started with, what you load can be put there for everybody."
        return fold("Load for everybody", tag("p", says), row("Key", field), key="key")

    def _let_in(self, text: str) -> Wish:
        found = desk()
        if found is None or not text:
            return ()
        found.let_in(text, *self._gui.reader)
        return LetIn()


def _load(said: str) -> Wish:
    try:
        return LoadFile(read_upload(said))
    except ArmlabError as refusal:
        raise InputError(str(refusal)) from None


def _look(key: str, lesson: bool) -> Command:
    return PreviewLesson(key, PAGE) if lesson else PreviewAssignment(key, PAGE)


def _title(held: Held) -> str:
    return held.lesson.title if isinstance(held, HeldLesson) else held.assignment.title
