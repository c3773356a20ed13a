"""The page Pictures of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "pictures",
    "Pictures",
    "CHART_GRID_DOTS",
    37,
    tab="velocity",
    about=(
        "S1.2.1-two-lines",
        "S1.2.1-min-norm",
        "S1.2.1-inverse-2x2",
        "S5.1.1-manifolds",
        "S5.1.4-2R",
        "joint space",
        "torus",
        "two lines",
        "configuration space",
    ),
)
