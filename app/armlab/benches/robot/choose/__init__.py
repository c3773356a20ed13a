"""The page Arms of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "robot",
    "Robot",
    "ROBOT",
    10,
    page="Arms",
    about=(
        "R",
        "S1.1-joint-types",
        "S1.1-r4-robot",
        "S1.7-history",
        "catalogue of arms",
        "choose an arm",
        "all arms",
        "gallery",
        "switch the arm",
        "another robot",
    ),
)
