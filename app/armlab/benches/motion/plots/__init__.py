"""The page Plots of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "motion_plots",
    "Plots of the motion",
    "CHART_LINE",
    41,
    tab="motion",
    page="Plots",
    about=(
        "S6.3.2-optimality",
        "S6.3-cartesian",
        "plots of the motion",
        "velocity",
        "acceleration",
        "jerk",
        "tool speed",
        "curvature",
        "joint limits over time",
        "joint move against Cartesian move",
        "travel time",
        "graphs",
        "curves over time",
    ),
    exports=(Export("csv", "Plots of the motion as CSV", ("graph", "curves", "table")),),
)
