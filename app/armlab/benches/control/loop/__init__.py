"""The page Velocity loop of the lab."""

from armlab.page import Export, Page

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
        "frequency response",
        "step response",
    ),
    exports=(Export("csv", "Velocity of the loop as CSV", ("step response", "curves", "table")),),
)
