"""The page Accuracy of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "accuracy",
    "Accuracy",
    "VIEWFINDER",
    17,
    tab="robot",
    about=(
        "S1.7-accuracy-repeatability",
        "accuracy and repeatability",
        "repeatability",
        "accuracy",
        "precision",
        "compliance",
        "ISO 9283",
        "calibration",
        "peg in hole",
        "dart board",
    ),
)
