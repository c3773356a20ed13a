"""The page Jacobian of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "velocity",
    "Velocity",
    "GAUGE",
    34,
    page="Jacobian",
    about=(
        "S1.2-superposition",
        "S1.2-rigid-velocity",
        "S1.2-basic-jacobian",
        "S1.2.1-kernel-3R",
        "S5.0-rigid",
        "S5.1-ee-velocity",
        "S5.1.1-geometric",
        "S5.1.1-prismatic",
        "S5.1.1-revolute",
        "S5.1.2-higher-order",
        "1.2",
        "5.1.1",
        "5.1.2",
        "Jacobian",
        "joint speeds",
        "linear velocity",
        "angular velocity",
        "acceleration",
        "jerk",
    ),
)
