"""The page Two robots of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "two_robots",
    "Two robots",
    "ARROWS_LEFT_RIGHT",
    31,
    tab="frame_chain",
    about=(
        "S3.4.2-two-robots",
        "3.4",
        "two robots",
        "two arms",
        "robots facing each other",
        "handover",
        "cooperating robots",
        "tool to tool",
    ),
)
