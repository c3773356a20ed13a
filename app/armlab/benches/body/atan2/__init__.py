"""The page atan2 of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "atan2",
    "atan2",
    "ANGLE",
    30,
    tab="body",
    about=(
        "S3.1-atan2",
        "SA-atan2",
        "3.1",
        "(3.15)",
        "arctangent",
        "atan and atan2",
        "quadrants",
        "argument of a complex number",
        "angle of a point in the plane",
    ),
)
