"""The page Angular velocity of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "turning",
    "Angular velocity",
    "ROTATE_3D",
    35,
    tab="velocity",
    about=(
        "S5.1-ee-velocity",
        "S5.1-commute",
        "S5.1-omega-integral",
        "S5.1-infinitesimal",
        "S5.1-rdot",
        "S5.1-T-matrix",
        "S5.1.1-analytic",
        "5.1",
        "angular velocity",
        "rates of angles",
        "roll pitch yaw",
        "Euler angles",
        "infinitesimal rotations",
        "gimbal lock",
        "representation singularity",
        "analytic Jacobian",
        "angle rates",
    ),
    exports=(Export("csv", "det T over the angle as CSV", ("representation singularity", "curves", "table")),),
)
