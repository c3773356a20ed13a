"""The page Quaternions of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "quaternion",
    "Quaternions",
    "INFINITY",
    36,
    tab="body",
    about=(
        "S3.2.3-quaternion",
        "S3.2.3-quat-from-R",
        "3.2",
        "quaternion product",
        "double cover",
        "two whole turns",
        "half angle",
        "hamilton",
        "slerp",
        "spherical interpolation",
        "quaternion algebra",
        "logarithm of a quaternion",
        "quaternion of a matrix",
        "shepperd",
    ),
    exports=(
        Export("csv", "Speed between two orientations as CSV", ("slerp", "curves", "table"), "Choose the view Slerp"),
    ),
)
