"""The page Harmonic drive of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "harmonic",
    "Harmonic drive",
    "ADJUSTMENTS",
    54,
    tab="drive",
    about=(
        "S2.2.1-harmonic",
        "2.2.1",
        "(2.29)",
        "strain wave gear",
        "strain wave gearing",
        "wave generator",
        "flexspline",
        "circular spline",
        "reduction ratio of a harmonic drive",
        "count teeth",
    ),
)
