"""The page Common normal of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "normal",
    "Common normal",
    "VECTOR",
    13,
    tab="robot",
    about=(
        "S4.1-common-normal",
        "(4.8-4.9)",
        "common normal",
        "skew lines",
        "twist angle",
        "skew axes",
        "distance of two lines",
    ),
)
