"""The page Lessons of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "lessons",
    "Lessons",
    "BOOK",
    5,
    about=(
        *("exercises", "course", "chapters", "index of the notes", "assignments", "homework", "tutorial"),
        *("map", "next lesson", "syllabus", "curriculum", "print the course"),
        *("formula sheet", "formulary", "cheat sheet"),
    ),
    always=True,
    exports=(
        Export("lesson-load", "Open saved work", ("import", "load", "continue", "progress")),
        Export("lesson-save", "Save my work", ("hand in", "submit", "progress"), "a lesson is open"),
    ),
)
