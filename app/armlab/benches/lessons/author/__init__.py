"""The page For teachers of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "author",
    "For teachers",
    "PENCIL",
    6,
    tab="lessons",
    about=("write a lesson", "teacher", "save as lesson"),
    always=True,
)
