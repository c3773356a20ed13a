"""The page FK formulas of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "formulas",
    "FK formulas",
    "MATH_FUNCTION",
    27,
    tab="pose",
    about=("S1.1-direct-kinematics", "S4.0-2R", "S4.1-dh-chain", "symbolic", "closed form of the direct kinematics"),
)
