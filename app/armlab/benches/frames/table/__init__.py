"""The page Table task of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "table_task",
    "Table task",
    "TABLE_ALIAS",
    30,
    tab="frame_chain",
    about=(
        "S3.4.1-table-task",
        "3.4",
        "table task",
        "object on a table",
        "table frame",
        "tool pointing down",
        "pose above an object",
        "pick from a table",
    ),
)
