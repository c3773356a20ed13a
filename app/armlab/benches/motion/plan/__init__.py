"""The page Plan of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "motion",
    "Motion",
    "ROUTE",
    39,
    page="Plan",
    about=(
        "S6.0-planning",
        "S6.0-corner",
        "S6.0-checklist",
        "S6.3-cartesian",
        "S6.3.2-overfly",
        "S6.3.2-circle-wrist",
        "6",
        "6.3",
        "trajectory planning",
        "waypoint",
        "waypoints",
        "play a motion",
        "joint move",
        "Cartesian move",
        "pick and place",
        "MoveJ",
        "MoveL",
        "PTP",
        "linear move",
        "via points",
        "gripper",
        "cycle time",
        "duration",
    ),
)
