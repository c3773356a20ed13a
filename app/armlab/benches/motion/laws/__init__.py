"""The page Timing laws of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "laws",
    "Timing laws",
    "WAVE_SINE",
    45,
    tab="motion",
    about=(
        "S1.3-accel-profile",
        "S1.3-rest-to-rest",
        "S6.1.1-velocity-bound",
        "S6.1.1-accel-bound",
        "S6.2.1-cosine",
        "S6.3.1-trapezoid",
        "S6.3.1-triangle",
        "S6.3.4-time-scaling",
        "6.1.1",
        "6.3.1",
        "6.3.4",
        "timing law",
        "trapezoid of speed",
        "bang-coast-bang",
        "bang-bang",
        "double S",
        "jerk",
        "time scaling",
        "velocity bound",
        "acceleration bound",
        "trapezoidal profile",
        "S-curve",
        "velocity profile",
        "minimum jerk",
    ),
    exports=(Export("csv", "Timing law as CSV", ("profile", "curves", "table")),),
)
