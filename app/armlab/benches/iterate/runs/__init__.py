"""The page Numerical IK of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "iterations",
    "Iterate",
    "STAIRS_UP",
    33,
    page="Numerical IK",
    about=(
        "S4.4.1-newton-ik",
        "S4.4.1-newton-redundant",
        "S4.4.1-newton-singular",
        "S4.4.2-gradient",
        "S4.4.2-gradient-feedback",
        "S4.4.2-lyapunov",
        "S5.2.1-dls",
        "4.4",
        "iterations",
        "step by step",
        "numerical inverse kinematics",
        "damped least squares",
        "cyclic coordinate descent",
        "Broyden",
        "Newton method",
        "gradient descent",
        "Levenberg-Marquardt",
        "convergence",
    ),
    exports=(Export("csv", "Errors of the iterations as CSV", ("residual", "curves", "table")),),
)
