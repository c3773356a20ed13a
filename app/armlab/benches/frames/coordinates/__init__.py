"""The page Coordinates of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "coordinates",
    "Coordinates",
    "WORLD",
    33,
    tab="frame_chain",
    about=(
        "S3.1-cylindrical",
        "S3.1-atan2",
        "3.1",
        "cylindrical coordinates",
        "spherical coordinates",
        "polar coordinates",
        "azimuth",
        "atan2",
        "quadrant",
    ),
)
