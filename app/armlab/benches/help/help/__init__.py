"""The page Help of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "help",
    "Help",
    "HELP_CIRCLE",
    90,
    about=("mouse", "keys", "shortcuts", "keyboard", "manual", "hotkeys", "what is"),
    always=True,
)
