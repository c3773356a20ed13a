"""The page Taught goals of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "taught_goal",
    "Taught goals",
    "VIEWFINDER",
    17,
    tab="robot",
    about=(
        "S1.7-accuracy-repeatability",
        "teaching",
        "taught point",
        "teach-in",
        "computed goal",
        "compliance",
        "peg in hole",
        "error of the table",
    ),
)
