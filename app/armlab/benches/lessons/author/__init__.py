"""The page For teachers of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "author",
    "For teachers",
    "PENCIL",
    8,
    tab="lessons",
    about=(
        *("write a lesson", "teacher", "save as lesson", "write an exercise", "own lesson"),
        *("guide to the course", "teacher's guide", "questions for discussion", "what students get wrong"),
    ),
    always=True,
    exports=(Export("save-lesson", "This arm as a lesson file", ("Markdown", "new lesson")),),
)
