"""The page Spaces of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "spaces",
    "Spaces",
    "STACK_2",
    28,
    tab="pose",
    about=(
        "S4.0-spaces",
        "S4.0-minimal",
        "S4.0-ambiguous",
        "task space",
        "actuation space",
        "configuration space",
        "number of task variables",
        "minimal representation",
        "ambiguous representation",
        "redundant",
        "constraint",
        "pendulum",
    ),
)
