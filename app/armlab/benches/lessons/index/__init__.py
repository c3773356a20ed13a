"""The page Lessons of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "lessons",
    "Lessons",
    "BOOK",
    5,
    about=("exercises", "course", "chapters", "index of the notes"),
    always=True,
)
