"""The page Joints of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "joints",
    "Joints",
    "ADJUSTMENTS_HORIZONTAL",
    20,
    about=(
        "S1.1-joint-types",
        "S4.0-2R",
        "sliders",
        "joint limits",
        "move the arm",
        "forward kinematics",
        "jog",
        "jog a joint",
        "fk",
        "held joints",
        "lock a joint",
        "named poses",
        "degrees of freedom",
    ),
)
