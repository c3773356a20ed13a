"""The page DH film of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "film",
    "DH film",
    "MOVIE",
    12,
    tab="robot",
    about=("S4.1-dh", "(4.10-4.14)", "animation of a row", "four factors", "step by step", "animation of the DH table"),
)
