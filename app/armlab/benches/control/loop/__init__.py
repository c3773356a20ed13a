"""The page Velocity loop of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "loop",
    "Velocity loop",
    "REFRESH",
    46,
    tab="control",
    about=(
        "S7.1.1-mass-loop",
        "S7.1.1-transfer",
        "S7.1.1-sine",
        "7.1.1",
        "velocity loop",
        "transfer function",
        "Bode plot",
        "cutoff frequency",
        "feedback loop",
    ),
)
