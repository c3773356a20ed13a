"""The page Planning steps of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "motion_steps",
    "Planning steps",
    "STAIRS",
    42,
    tab="motion",
    about=(
        "S6.0-planning",
        "S6.0-line",
        "S6.0-pipeline",
        "S6.0-checklist",
        "S6.3-cartesian",
        "6",
        "five planning steps",
        "trajectory planning",
        "motion planning",
        "sampling",
        "knots",
        "inverse kinematics along a path",
        "planning steps",
        "pipeline",
    ),
    exports=(Export("csv", "Plots of the steps as CSV", ("planning", "curves", "table")),),
)
