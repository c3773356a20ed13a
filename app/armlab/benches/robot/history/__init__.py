"""The page History of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "history",
    "History",
    "HISTORY",
    15,
    tab="robot",
    about=(
        "S1.4-definitions",
        "S1.5-robots",
        "S1.5-not-robots",
        "S1.5-robota",
        "S1.6-asimov",
        "S1.7-history",
        "SR-others",
        "1.4",
        "1.5",
        "1.6",
        "1.7",
        "history of robots",
        "timeline",
        "what is a robot",
        "definition of a robot",
        "ISO 8373",
        "laws of robotics",
        "Unimation",
        "first industrial robot",
    ),
)
