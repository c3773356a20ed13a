"""The page Quaternions of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "quaternion",
    "Quaternions",
    "INFINITY",
    36,
    tab="body",
    about=(
        "S3.2.3-quaternion",
        "3.2",
        "quaternion product",
        "double cover",
        "two whole turns",
        "half angle",
        "hamilton",
        "order of rotations",
    ),
)
