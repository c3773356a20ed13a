"""The page Target of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "target",
    "Target",
    "TARGET_ARROW",
    30,
    about=(
        "S1.1-inverse-kinematics",
        "inverse kinematics",
        "reach a point",
        "drag",
        "ik",
        "goal",
        "damping",
        "weights",
        "position only",
        "out of reach",
        "unreachable",
    ),
)
