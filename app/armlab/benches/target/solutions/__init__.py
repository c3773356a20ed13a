"""The page Solutions of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "solutions",
    "Solutions",
    "TARGET_ARROW",
    31,
    tab="target",
    about=(
        "S4.3-multiplicity",
        "S4.3-ur10",
        "S4.3-ik16",
        "S4.3.1-ik-cases",
        "S4.3.2-methods",
        "all solutions",
        "ghosts",
        "elbow up",
        "elbow down",
        "shoulder left",
        "wrist flip",
        "self-motion",
        "redundant arm",
        "multistart",
        "multiple solutions",
        "branches",
        "configurations",
        "postures",
        "eight solutions",
        "flip",
    ),
)
